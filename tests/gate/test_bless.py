"""Blessing, the ledger, noise: what is recorded, and what is refused before anything is written."""

import datetime
import json
import threading

import pytest

from gate import baseline, curves, ledger, noise
from gate.bless import bless
from gate.compare import compare
from gate.files import GateError
from tests.gate.made import TODAY, blessed, case, run, with_value
from tests.reports.sample import lines_figure, metric


def entries(folder):
    return [json.loads(line) for line in ledger.path_in(folder).read_text().splitlines()]


def gated(place, baselines, *cases, today=TODAY, **run_json):
    place.mkdir(exist_ok=True)
    return compare(run(place, *cases, **run_json), baseline.read_all(baselines), ledger.read(baselines), today)


def kinds(comparison):
    return [(r.metric, r.kind) for r in comparison.rows if r.colour == "red"]


def test_what_was_blessed_is_bitwise_the_same(tmp_path):
    draw = [0.1, 1 / 3, 2.0 ** -1074, 1.7976931348623157e308, -0.0, 123456789.12345679]
    data = case(metrics=[metric(f"m{i}", x, None, "reported") for i, x in enumerate(draw)] + [metric("gated", 0.1, [0, 1])])
    blessed(tmp_path / "run", data, baselines=tmp_path / "b")
    comparison = gated(tmp_path / "run", tmp_path / "b", data)
    assert {r.change for r in comparison.rows} == {"bitwise"} and comparison.exit_code == 0


def test_the_ledger_says_who_what_when_and_why(tmp_path):
    blessed(tmp_path / "run", case(), baselines=tmp_path / "b")
    blessed(tmp_path / "run", with_value(case(), 0.5), baselines=tmp_path / "b", reason="a sign in the viscous term")
    first, second = entries(tmp_path / "b")
    assert first["kind"] == second["kind"] == "value"
    assert second["moved"] == {"norm": [1.0, 0.5]}
    assert (second["reason"], second["who"], second["commit"]) == ("a sign in the viscous term", "A Tester <a@test>", "a" * 40)
    assert baseline.read_all(tmp_path / "b")["kernel/one"].metrics["norm"].value == 0.5


@pytest.mark.parametrize("data, word", [
    (case(provenance={"dirty": True}), "dirty tree"),
    (case(metrics=[metric("norm", 3.0, [0, 2], "fail")], verdict="fail"), "fails"),
    (case(metrics=[metric("norm", None, [0, 2], "error")], verdict="error"), "error"),
    (case(metrics=[metric("norm", 3.0, [0, 2], "pass")]), "outside its band"),   # says pass, and is not
    (case(overrides=["parameters.x=1"]), "parameters.x=1"),
    (case(provenance={"particle_order": 5}), "order of particles"),
    (case(provenance={"commit": "unknown"}), "commit"),
])
def test_refusals_write_nothing(tmp_path, data, word):
    place = tmp_path / "run"
    place.mkdir()
    good = case("kernel/good")
    with pytest.raises(GateError, match=word):
        bless(run(place, good, data), ["*"], "because", folder=tmp_path / "b", who="A")
    assert not list(tmp_path.glob("b/**/*.json*"))


@pytest.mark.parametrize("reason", ["", "  \n"])
def test_an_empty_reason_is_refused(tmp_path, reason):
    with pytest.raises(GateError, match="reason"):
        blessed(tmp_path, case(), baselines=tmp_path / "b", reason=reason)


def test_a_case_that_the_run_does_not_have_is_refused(tmp_path):
    with pytest.raises(GateError, match="no such case"):
        bless(run(tmp_path, case()), ["kernel/other"], "because", folder=tmp_path / "b", who="A")


def test_a_loosened_band_is_recorded_shown_and_red_from_the_day_it_expires(tmp_path):
    loose = case(metrics=[metric("norm", 1.0, [0.0, 9.0])])
    blessed(tmp_path / "run", case(), baselines=tmp_path / "b")
    assert kinds(gated(tmp_path / "run", tmp_path / "b", loose)) == [("norm", "band")]
    blessed(tmp_path / "run", loose, baselines=tmp_path / "b", reason="scatter of the new set", expires="2027-05-22")
    before = gated(tmp_path / "run", tmp_path / "b", loose, today=datetime.date(2027, 5, 21))
    assert kinds(before) == [] and [(c.kind, c.expires, c.expired) for c in before.concessions] == [("band", "2027-05-22", False)]
    after = gated(tmp_path / "run", tmp_path / "b", loose, today=datetime.date(2027, 5, 22))
    assert kinds(after) == [("norm", "band")] and after.concessions[0].expired
    tight = gated(tmp_path / "run", tmp_path / "b", case(), today=datetime.date(2027, 5, 22))
    assert kinds(tight) == [] and tight.concessions == []


def test_a_known_gap_is_recorded_and_expires(tmp_path):
    gap = case(metrics=[metric("norm", 3.0, [0.0, 2.0], "known-gap", reason="truncated support")], verdict="known-gap")
    blessed(tmp_path / "run", case(), baselines=tmp_path / "b")
    assert kinds(gated(tmp_path / "run", tmp_path / "b", gap)) == [("norm", "gap")]
    blessed(tmp_path / "run", gap, baselines=tmp_path / "b", reason="shown by the ladder", expires="2027-05-22")
    assert entries(tmp_path / "b")[-1]["reason"] == "shown by the ladder; truncated support"
    assert kinds(gated(tmp_path / "run", tmp_path / "b", gap)) == []
    assert kinds(gated(tmp_path / "run", tmp_path / "b", gap, today=datetime.date(2027, 6, 1))) == [("norm", "gap")]


def test_lost_cases_count_in_the_tiers_that_the_run_has(tmp_path):
    blessed(tmp_path / "all", case(), case("kernel/gone"), baselines=tmp_path / "b")
    one = tmp_path / "one"
    assert kinds(gated(one, tmp_path / "b", case(), tier="smoke")) == [("norm", "lost")]
    assert kinds(gated(one, tmp_path / "b", case(), tier="smoke", only=["kernel/o*"])) == []
    assert kinds(gated(one, tmp_path / "b", case())) == []


def test_a_case_that_left_no_result_is_an_error_and_exit_code_3(tmp_path):
    blessed(tmp_path / "run", case(), case("kernel/two"), baselines=tmp_path / "b")
    (tmp_path / "run/kernel/two/result.json").write_text("{")
    from reports import results
    comparison = compare(results.load(tmp_path / "run"), baseline.read_all(tmp_path / "b"), [], TODAY)
    assert comparison.exit_code == 3 and comparison.rows[0].case == "kernel/two"


def test_a_run_of_nothing_is_red(tmp_path):
    assert gated(tmp_path / "run", tmp_path / "b").exit_code == 1


def test_noise_is_the_spread_of_equally_right_runs_and_survives_a_blessing(tmp_path):
    blessed(tmp_path / "base", case(), baselines=tmp_path / "b")
    runs = []
    for i, value in enumerate((1.0, 1.01, 0.98)):
        place = tmp_path / f"run{i}"
        place.mkdir()
        runs.append(run(place, with_value(case(provenance={"particle_order": i}), value)))
    assert noise.record(runs, "three orders", tmp_path / "b", who="A") == (1, 0)
    assert entries(tmp_path / "b")[-1]["kind"] == "noise"
    kept = baseline.read_all(tmp_path / "b")["kernel/one"].metrics["norm"]
    assert kept.spread == pytest.approx(0.03) and kept.runs == 3
    assert noise.record(runs[:2], "two of them", tmp_path / "b", who="A") == (0, 0)   # three found more
    assert baseline.read_all(tmp_path / "b")["kernel/one"].metrics["norm"].runs == 3
    assert gated(tmp_path / "base", tmp_path / "b", with_value(case(), 1.08)).rows[0].kind == "within"
    assert gated(tmp_path / "base", tmp_path / "b", with_value(case(), 1.10)).rows[0].kind == "away"
    blessed(tmp_path / "base", with_value(case(), 0.9), baselines=tmp_path / "b")
    assert baseline.read_all(tmp_path / "b")["kernel/one"].metrics["norm"].runs == 3


@pytest.mark.parametrize("changes, word", [
    ([{}], "two runs"), ([{}, {"dirty": True}], "dirty"), ([{}, {"commit": "b" * 40}], "one commit")])
def test_noise_of_runs_that_cannot_be_compared_is_refused(tmp_path, changes, word):
    runs = []
    for i, change in enumerate(changes):
        place = tmp_path / str(i)
        place.mkdir()
        runs.append(run(place, case(provenance=change), provenance=change))
    with pytest.raises(GateError, match=word):
        noise.record(runs, "why", tmp_path / "b", who="A")


def test_two_who_bless_at_once_lose_nothing(tmp_path):
    names = [f"kernel/c{i}" for i in range(8)]
    place = tmp_path / "run"
    place.mkdir()
    made = run(place, *(case(n) for n in names))
    refused = []

    def accept(name):
        while True:
            try:
                return bless(made, [name], "because", folder=tmp_path / "b", who="A")
            except GateError as error:
                refused.append(str(error))

    threads = [threading.Thread(target=accept, args=(n,)) for n in names]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert sorted(baseline.read_all(tmp_path / "b")) == names
    assert sorted(e["case"] for e in entries(tmp_path / "b")) == names
    assert all("try again" in r for r in refused)


def test_curves_are_few_and_keep_their_ends():
    data = case(figures=[{**lines_figure(), "name": f"f{i}"} for i in range(9)])
    kept = curves.of(data)
    series = [s for figure in kept.values() for s in figure.values()]
    assert len(series) == curves.MOST_SERIES and all(len(s["x"]) == len(s["y"]) <= curves.POINTS for s in series)
    assert (series[0]["x"][0], series[0]["x"][-1]) == (0.0, 2.0)
    broken = curves.of(case(figures=[{**lines_figure(),
                                      "series": [{"label": "a", "role": "computed", "x": [0, 1], "y": [None, 1]}]}]))
    assert broken["profile"]["a"]["y"] == [None, 1.0]
