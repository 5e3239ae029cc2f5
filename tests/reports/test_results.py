"""Reading of result files: nothing is dropped, and no green is believed that contradicts itself."""

import copy

import pytest

from reports import results
from reports.results import ReportError, load
from tests.reports.sample import metric, result


def the_case(folder):
    run = load(folder)
    assert len(run.cases) == 1
    return run.cases[0]


def test_a_valid_result_keeps_its_verdict(run):
    for verdict, m in (("pass", metric("e", 0.5, [0, 1])), ("fail", metric("e", 2.0, [0, 1], "fail")),
                       ("error", metric("e", None, [0, 1], "error")),
                       ("known-gap", metric("e", 2.0, [0, 1], "known-gap"))):
        case = the_case(run(result("kernel/a", verdict, [m])))
        assert (case.verdict, case.faults) == (verdict, [])


@pytest.mark.parametrize("text, words", [
    ("", "not JSON"), ("{", "not JSON"), ('{"schema": NaN}', "NaN is not JSON"), ("[]", "does not follow the schema"),
    ('{"schema": 1}', "does not follow the schema"), ("\xff", "not UTF-8")])
def test_an_unreadable_result_is_an_error_with_the_message(run, text, words):
    folder = run()
    (folder / "kernel" / "broken").mkdir(parents=True)
    (folder / "kernel" / "broken" / "result.json").write_bytes(text.encode("latin-1"))
    case = the_case(folder)
    assert (case.id, case.family, case.verdict) == ("kernel/broken", "kernel", "error")
    assert words in case.reason


@pytest.mark.parametrize("change", [
    lambda r: r.pop("provenance"), lambda r: r.update(verdict="green"), lambda r: r["metrics"][0].update(value="1.0"),
    lambda r: r["metrics"][0].update(band=[0]), lambda r: r.update(surprise=1), lambda r: r.update(schema=2),
    lambda r: r.update(figures=[{"name": "f", "title": "f", "kind": "lines", "x": {"label": "x", "unit": "1"},
                                 "y": {"label": "y", "unit": "1"},
                                 "series": [{"label": "s", "role": "computed", "x": [1, "2"], "y": [1, 2]}]}])])
def test_a_result_against_the_schema_is_an_error(run, change):
    data = copy.deepcopy(result("kernel/a"))
    change(data)
    case = the_case(run(data))
    assert case.verdict == "error"
    assert "does not follow the schema" in case.reason


@pytest.mark.parametrize("metrics, words", [
    ([], "no metric passed"),
    ([metric("e", 1.0, None, "reported")], "no metric passed"),
    ([metric("e", 0.5, [0, 1]), metric("f", 2.0, [0, 1], "fail")], "f says fail"),
    ([metric("e", 2.0, [0, 1])], "outside its band"),
    ([metric("e", None, [0, 1])], "produced no number"),
    ([metric("e", 0.5, None)], "has no band"),
    ([metric("e", 0.5, [0, 1]), metric("f", None, [0, 1], "skipped")], "skipped without a reason"),
    ([metric("p", 5.0, [1.7, 2.3], norm="value", error=2.0)], "outside its band")])
def test_a_green_that_contradicts_itself_is_an_error(run, metrics, words):
    case = the_case(run(result("kernel/a", "pass", metrics)))
    assert case.verdict == "error"
    assert words in case.reason


def test_two_results_of_one_case_are_both_shown(run):
    folder = run(result("kernel/a"))
    (folder / "elsewhere").mkdir()
    (folder / "elsewhere" / "result.json").write_text((folder / "kernel/a/result.json").read_text())
    assert [c.verdict for c in load(folder).cases] == ["error", "pass"]


def test_an_announced_case_without_a_result_is_an_error(run):
    cases = load(run(result("kernel/a"), cases=["kernel/a", {"case": "kernel/lost"}])).cases
    assert [(c.id, c.verdict) for c in cases] == [("kernel/lost", "error"), ("kernel/a", "pass")]


def test_reds_come_first(run):
    verdicts = {"a": "pass", "b": "known-gap", "c": "fail", "d": "error", "e": "pass"}
    cases = load(run(*(result(f"kernel/{k}", v, [metric("m", 0.5 if v == "pass" else 2.0, [0, 1], v)]) for k,
                       v in verdicts.items()))).cases
    assert [c.id[-1] for c in cases] == ["d", "c", "b", "a", "e"]


def test_only_self_is_told_from_verification(run):
    own = metric("e", 0.5, [0, 1], class_="self")
    assert the_case(run(result("kernel/a", metrics=[own, metric("f", 1.0, None, "reported")]))).only_self
    assert not the_case(run(result("kernel/a", metrics=[own, metric("f", 0.5, [0, 1])]))).only_self


def test_a_folder_that_is_no_run_is_refused(tmp_path):
    with pytest.raises(ReportError, match="neither run.json nor a result.json"):
        load(tmp_path)
    with pytest.raises(ReportError, match="no such folder"):
        load(tmp_path / "nowhere")


def test_the_short_cut_for_numbers_agrees_with_the_schema():
    validator = results._validator()
    series = {"label": "s", "role": "computed", "x": [1, 2.5, None], "y": [1, 2, 3]}
    figure = {"name": "f", "title": "f", "kind": "lines", "x": {"label": "x", "unit": "1"}, "y": {"label": "y", "unit": "1"},
              "series": [series]}
    assert not list(validator.iter_errors(result("kernel/a", figures=[figure])))
    for wrong in (True, "1", [1], {}):
        series["y"] = [1, wrong, 3]
        assert list(validator.iter_errors(result("kernel/a", figures=[figure])))
