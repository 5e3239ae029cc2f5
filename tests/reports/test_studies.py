"""What it would take: stored runs keep their inputs and their origin, thresholds follow from them, and the page shows both."""

import datetime
import json

import pytest

from reports import claims, results, studies
from reports.pages import build
from tests.reports.pages import Page
from tests.reports.sample import metric, result

TODAY = datetime.date(2026, 11, 30)


def tool_run(cohesion=600, tool="tool", free_length=22, **numbers):
    made = result("tillage/clay-2.0", family="tillage", metrics=[
        metric("plastic_strain", numbers.get("plastic_strain", 0.1), [-1.0, 1.0]),
        metric("failed_particles", numbers.get("failed", 0.0), [-1.0, 100.0]),
        metric("greatest_moment", 105.2, [0.0, 1e3], unit="N")])
    made["parameters"] = {"speed": {"value": 2, "unit": "m/s"}, "travel": {"value": 14, "unit": "mm"}, "material": "hard-clay",
                          "material_set": [f'strength.cohesion={{ value = {cohesion}, unit = "kPa", source = "x" }}'],
                          "tool": {"material": tool, "free_length": {"value": free_length, "unit": "mm"}, "across": 6}}
    made["provenance"] = dict(made["provenance"], started="2026-11-23T04:27:07Z")
    return made


@pytest.fixture
def stored(tmp_path):
    def store(*runs):
        file = tmp_path / "studies.json"
        for k, one in enumerate(runs):
            place = tmp_path / f"run{k}" / "tillage" / "clay-2.0"
            place.mkdir(parents=True, exist_ok=True)
            (place / "result.json").write_text(json.dumps(one))
            studies.store("cohesion", [tmp_path / f"run{k}"], file)
        return file
    return store


def test_a_stored_run_keeps_inputs_numbers_and_origin(stored):
    row, = studies.load(stored(tool_run()))
    assert (row["cohesion"], row["free_length"], row["across"], row["tool"]) == (6e5, 0.022, 6, "tool")
    assert row["metrics"]["greatest_moment"] == {"value": 105.2, "unit": "N"} and row["date"] == "2026-11-23"


def test_the_same_inputs_take_the_place_of_the_earlier_run(stored):
    rows = studies.load(stored(tool_run(), tool_run(plastic_strain=0.3), tool_run(cohesion=300)))
    assert [(r["cohesion"], r["metrics"]["plastic_strain"]["value"]) for r in rows] == [(3e5, 0.1), (6e5, 0.3)]


def test_a_run_that_ended_as_error_is_not_stored(stored):
    with pytest.raises(results.ReportError, match="says nothing"):
        stored(dict(tool_run(), verdict="error"))


def test_thresholds_lie_between_runs(stored):
    rows = studies.load(stored(tool_run(300, plastic_strain=0.0), tool_run(400, plastic_strain=0.01), tool_run(600, failed=2.0)))
    group, = studies.page(rows, TODAY)
    limits, = group["limits"]
    assert limits["yields"] == (3e5, 4e5) and limits["breaks"] == (4e5, 6e5)
    assert [r["age"] for r in group["rows"]] == [7, 7, 7]


def test_thresholds_that_cross_and_sides_without_runs(stored):
    rows = studies.load(stored(tool_run(300, plastic_strain=0.1), tool_run(400, plastic_strain=0.0)))
    limits, = studies.page(rows, TODAY)[0]["limits"]
    assert limits["yields"] == (None, None) and limits["breaks"] == (4e5, None)


def test_each_tool_and_free_length_has_thresholds_of_its_own(stored):
    rows = studies.load(stored(tool_run(300, plastic_strain=0.0), tool_run(300, free_length=15), tool_run(300, tool="4340-steel")))
    assert len(studies.page(rows, TODAY)[0]["limits"]) == 3


def test_the_uncertainty_of_values_that_converge_is_that_of_their_fit():
    across = (6, 8, 12)
    for order, safety in ((1.0, 1.25), (2.0, 1.25), (3.0, 3.0)):
        values = [5.0 + 40.0 * n**-order for n in across]
        share, found = studies.numerical_uncertainty(across, values)
        assert found == pytest.approx(order, abs=1e-4)
        assert share == pytest.approx(safety * (values[-1] - 5.0) / values[-1], rel=1e-3)


def test_the_uncertainty_of_values_that_do_not_converge_is_three_times_their_range():
    assert studies.numerical_uncertainty((6, 8, 12), (4.0, 5.0, 4.5)) == (pytest.approx(3.0 / 4.5), None)
    assert studies.numerical_uncertainty((6, 8, 12), (4.0, 4.1, 4.5)) == (pytest.approx(1.5 / 4.5), None)   # ever faster
    assert studies.numerical_uncertainty((6, 8), (4.0, 5.0)) == (pytest.approx(0.6), None)
    assert studies.numerical_uncertainty((6,), (4.0,)) == (None, None)


def test_resolutions_of_a_case_are_a_ladder():
    rows = [{"case": f"tillage/rock-2.0{tail}", "across": n, "metrics": {"fracture_time": {"value": t, "unit": "ms"}}}
            for tail, n, t in (("-across-8", 8, 4.0), ("", 6, 4.1))]
    ladder, = studies.ladders(rows)
    assert ladder["case"] == "tillage/rock-2.0" and ladder["across"] == [6, 8]
    assert ladder["numbers"]["fracture_time"] == (4.0, "ms", pytest.approx(0.075), None)


def test_the_hinge_of_a_plate():
    first, limit = studies.hinge(324e6, 1.5e-3)
    assert limit == pytest.approx(210.4, abs=0.1) and first == pytest.approx(140.3, abs=0.1)


def test_without_a_record_there_is_no_page(run, stored, monkeypatch):
    monkeypatch.setattr(claims, "load", lambda *_: [{"id": "a", "place": "1", "statement": "S", "undetermined": "why"}])
    folder = run(result("tillage/table1-2.0", family="tillage", metrics=[metric("m", 0.0, [-1.0, 1.0])]))
    monkeypatch.setattr(studies, "FILE", folder / "none.json")
    build(folder)
    assert not (folder / "report/what-it-would-take.html").exists()
    monkeypatch.setattr(studies, "FILE", stored(tool_run(300, plastic_strain=0.0), tool_run(400)))
    build(folder)
    page = Page((folder / "report/what-it-would-take.html").read_text())
    assert "It yields between 300 and 400 kPa" in page.text and "does not break up to 400 kPa" in page.text
    assert "what-it-would-take.html" in (folder / "report/index.html").read_text()
