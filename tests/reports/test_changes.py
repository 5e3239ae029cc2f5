"""What the report says of the baseline: counts and rows are those of gate.json, old curves lie under new ones."""

import copy
import json

import pytest

from gate.command import main
from reports import changes
from reports.pages import build
from tests.gate.made import blessed, case, run, with_value
from tests.reports.pages import Page
from tests.reports.sample import lines_figure, metric


@pytest.fixture
def compared(tmp_path):
    """The report of a run in which one metric moved away, one toward the truth, one not at all."""
    one = case(figures=[lines_figure()], metrics=[metric("norm", 1.0, [0, 2]), metric("other", 1.0, [0, 2])])
    (tmp_path / "run").mkdir()
    blessed(tmp_path / "run", one, case("kernel/two"), baselines=tmp_path / "b")
    moved = copy.deepcopy(one)
    moved["figures"][0]["series"][0]["y"] = [1.1 * y for y in moved["figures"][0]["series"][0]["y"]]
    run(tmp_path / "run", with_value(moved, 1.5), with_value(case("kernel/two"), 0.5))
    assert main(["gate", str(tmp_path / "run"), "--no-report", "--baselines", str(tmp_path / "b")]) == 1
    return tmp_path / "run", build(tmp_path / "run").parent


def test_the_first_page_counts_what_moved(compared):
    folder, report = compared
    counts = json.loads((folder / "gate/gate.json").read_text())["counts"]
    page = Page((report / "index.html").read_text())
    assert f"{counts['red']} red, {counts['yellow']} yellow" in page.text
    assert "1 metrics the same bits, 0 within noise, 2 moved" in page.text
    assert "changes.html" in [a["href"] for a in page.all("a")]


def test_every_move_is_a_row_with_a_link_to_its_case(compared):
    folder, report = compared
    rows = [r for r in json.loads((folder / "gate/gate.json").read_text())["rows"] if r["colour"] != "green"]
    page = Page((report / "changes.html").read_text())
    assert len(page.all("tr", "red")) + len(page.all("tr", "yellow")) == len(rows) == 2
    assert {"cases/kernel/one.html#metrics", "cases/kernel/two.html#metrics"} <= {a["href"] for a in page.all("a")}
    assert "schemes/momentum" in page.text and "toward the truth" in page.text


def test_a_case_page_says_where_each_metric_went(compared):
    page = Page((compared[1] / "cases/kernel/one.html").read_text())
    assert "away from the truth +50\u202f% from 1" in page.text.replace("+50 %", "+50\u202f%")
    assert "the same bits" in page.text


def test_the_accepted_curve_lies_under_the_new_one(compared):
    drawn = (compared[1] / "figures/kernel/one/profile.svg").read_text()
    assert "cubic spline, accepted aaaaaaaa" in drawn
    assert "accepted" not in (compared[1] / "figures/kernel/one/profile.svg").read_text().replace("accepted aaaaaaaa", "")


def test_without_a_comparison_nothing_is_claimed(tmp_path):
    report = build(run(tmp_path, case()).folder).parent
    assert "No baseline accepted yet." in Page((report / "index.html").read_text()).text
    assert not (report / "changes.html").exists()
    assert "Since the baseline" not in Page((report / "cases/kernel/one.html").read_text()).text


@pytest.mark.parametrize("text", ["{", "[]", '{"rows": 3}', '{"schema": 1}'])
def test_a_broken_comparison_is_said_and_spoils_nothing_else(tmp_path, text):
    folder = run(tmp_path, case()).folder
    (folder / "gate").mkdir()
    (folder / "gate/gate.json").write_text(text)
    assert "gate.json" in changes.load(folder).fault
    assert "gate.json" in Page(build(folder).read_text()).text
