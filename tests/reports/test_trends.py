"""Trends in the report: a line for each series, steps named, nothing where no night wrote a history."""

import json
import re

import pytest

from night import series, store
from reports import trends
from reports.pages import build
from tests.gate.made import case, run, with_value
from tests.reports.pages import Page


@pytest.fixture
def nights(tmp_path):
    """Six nights of one case that stepped in the fourth; the report of the last."""
    values = [1.0, 1.0, 1.0, 1.5, 1.5, 1.5]
    for day, value in enumerate(values, 1):
        folder = tmp_path / f"n{day}"
        folder.mkdir()
        p = {"commit": f"{day:x}" * 40, "started": f"2026-11-{day:02d}T02:00:00Z"}
        last = run(folder, with_value(case(provenance=p), value), provenance=p, tier="nightly", wall_s=3.0, cpu_s=3.0)
        with store.opened(tmp_path / "h", create=True) as connection:
            store.add(connection, last)
            found = store.nights(connection)
            all_series = series.read(connection, found)
    (last.folder / "history.json").write_text(json.dumps(series.to_report(all_series, found)))
    return build(last.folder).parent


def test_the_trend_page_names_the_first_commit_after_a_step(nights):
    page = Page((nights / "trends.html").read_text())
    assert "1 → 1.5 (+50 %) since 44444444 of 2026-11-04" in page.text
    assert "6 nights" in page.text and "What stepped" in page.text
    assert "trends.html" in [a["href"] for a in Page((nights / "index.html").read_text()).all("a")]


def test_every_metric_has_its_line_on_the_page_of_its_case(nights):
    page = Page((nights / "cases/kernel/one.html").read_text())
    lines = page.all("svg", "spark")
    assert [line["aria-label"] for line in lines] == ["6 nights, last 1.5, 1 step", "6 nights, last 3.1 s, no step"]


def test_a_hole_is_left_open_and_a_flat_line_is_drawn():
    series = {"case": "a", "name": "m", "unit": "1", "kind": "value", "places": [0, 1, 3, 4], "values": [2.0] * 4, "steps": []}
    drawn = str(trends.sparkline(series, [{}] * 5))
    assert re.search(r'd="M[\d. ]+L[\d. ]+M[\d. ]+L[\d. ]+"', drawn)
    assert "nan" not in drawn and trends.sparkline(None, []) == ""
    one = {**series, "places": [0], "values": [1.0]}
    assert "circle" in trends.sparkline(one, [{}])


def test_without_nights_nothing_is_claimed(tmp_path):
    report = build(run(tmp_path, case()).folder).parent
    assert not (report / "trends.html").exists()
    assert "Trends" not in Page((report / "index.html").read_text()).text


@pytest.mark.parametrize("text", ["{", "[]", '{"runs": [], "series": [{"case": "a"}]}',
                                  '{"runs": [], "series": [{"case": "a", "name": "b", "places": [0, 1], "values": [1]}]}'])
def test_a_broken_history_is_said(tmp_path, text):
    folder = run(tmp_path, case()).folder
    (folder / "history.json").write_text(text)
    assert trends.load(folder).fault
    assert "history.json" in Page(build(folder).read_text()).text
