"""Predicted over measured: bias and scatter of synthetic points whose bias and scatter are known."""

import json
import math

import pytest

from reports import results, validation
from reports.pages import build
from tests.reports import sample
from tests.reports.pages import Page
from tests.reports.sample import metric, result


def comparison(case, value, reference=20.0, uncertainty=0.0, material="ofhc-copper", **more):
    return result(case, parameters={"material": material},
                  metrics=[metric("final_length", value, [-0.5, 0.5], norm="relative", unit="mm", class_="experiment",
                                  reference=reference, uncertainty=uncertainty, error=value / reference - 1.0, **more)])


def test_a_model_that_is_always_five_percent_long_has_that_bias_and_no_scatter(run):
    folder = run(*(comparison(f"taylor-bar/rod-{i}", 1.05 * length, length) for i, length in enumerate((10.0, 20.0, 40.0))))
    group, = validation.groups(results.load(folder))
    assert group.bias == pytest.approx(0.05, abs=1e-12)
    assert group.scatter == pytest.approx(0.0, abs=1e-9)
    assert group.bias_at_limit is None


def test_scatter_of_the_experiment_is_taken_off(run):
    spread = (0.97, 1.0, 1.03)
    folder = run(*(comparison(f"taylor-bar/rod-{i}", 20.0 * r, 20.0, 0.2) for i, r in enumerate(spread)))
    group, = validation.groups(results.load(folder))
    logs = [math.log(r) for r in spread]
    mean = sum(logs) / 3
    variance = sum((x - mean) ** 2 for x in logs) / 2
    assert group.scatter == pytest.approx(math.sqrt(variance - 0.01**2), rel=1e-12)
    assert group.experiment == pytest.approx(0.01)
    assert group.bias == pytest.approx(math.exp(mean + 0.5 * (variance - 0.01**2)) - 1.0, rel=1e-12)


def test_the_ladder_separates_the_spacing_from_the_model(run):
    steps = {"kind": "value", "spacing": [0.002, 0.001, 0.0005], "value": [24.0, 22.0, 21.5], "order": 2.0, "order_stderr": None,
             "state": "asymptotic", "gci": 0.01, "extrapolated": 21.0}
    folder = run(*(comparison(f"taylor-bar/rod-{i}", 21.5, 20.0, ladder=steps) for i in range(2)))
    group, = validation.groups(results.load(folder))
    assert group.bias == pytest.approx(0.075)
    assert group.bias_at_limit == pytest.approx(0.05)
    assert group.grid == pytest.approx(0.01)


def test_a_ladder_without_a_limit_counts_with_its_finest_value(run):
    steps = {"kind": "value", "spacing": [0.002, 0.001, 0.0005], "value": [20.9, 21.1, 21.0], "order": None, "order_stderr": None,
             "state": "oscillatory", "gci": 0.02, "extrapolated": None}
    folder = run(comparison("taylor-bar/rod-0", 21.0, 20.0, ladder=steps), comparison("taylor-bar/rod-1", 30.0, 20.0))
    group, = validation.groups(results.load(folder))
    assert group.grid == pytest.approx(0.02)
    assert group.bias_at_limit == pytest.approx(1.05 * math.exp(0.5 * group.scatter**2) - 1.0)


def test_materials_and_quantities_are_kept_apart_and_others_left_out(run):
    other = comparison("taylor-bar/other", 21.0, material="6061-t6")
    exact = result("kernel/exact", metrics=[metric("integral", 1.0, [0.9, 1.1], norm="relative", reference=1.0)])
    missing = comparison("taylor-bar/none", 21.0)
    missing["metrics"][0].update(value=None, error=None, verdict="error")
    missing["verdict"] = "error"
    folder = run(comparison("taylor-bar/rod", 21.0), other, exact, missing)
    assert [(g.material, len(g.points)) for g in validation.groups(results.load(folder))] == [("6061-t6", 1), ("ofhc-copper", 1)]


def test_the_page_shows_every_comparison_and_the_index_leads_to_it(run):
    folder = run(comparison("taylor-bar/rod-0", 21.0), comparison("taylor-bar/rod-1", 19.0))
    report = build(folder).parent
    page = Page((report / "validation.html").read_text(encoding="utf-8"))
    assert [v for _, _, v in page.links if v.startswith("cases/")] == [f"cases/taylor-bar/rod-{i}.html" for i in range(2)]
    assert (report / "figures/validation/final_length.svg").exists()
    assert any(v == "validation.html" for _, _, v in Page((report / "index.html").read_text(encoding="utf-8")).links)


def test_a_run_without_experiments_has_no_such_page(run):
    report = build(run(result("kernel/exact"))).parent
    assert not (report / "validation.html").exists()
    assert json.loads((report.parent / "run.json").read_text())["provenance"] == sample.PROVENANCE
