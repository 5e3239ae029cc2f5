"""The ledger of the paper's claims: verdicts follow from numbers of the run, and the ledger itself keeps its own rules."""

import pytest

from reports import claims, results
from reports.pages import build
from tests.reports.pages import Page
from tests.reports.sample import metric, result

TOOL = "tillage/table1-2.0"


def entry(**more):
    return {"id": "a", "place": "3.2", "statement": "It yields", "case": TOOL, "metric": "plastic_strain", "holds": [1e-3, float("inf")],
            "reason": "It does not", **more}


def judged(run, *entries, value=0.0, **more):
    folder = run(result(TOOL, family="tillage", metrics=[metric("plastic_strain", value, [-1.0, 1.0], **more)]))
    return claims.judge(list(entries), results.load(folder))


def test_a_number_outside_its_range_contradicts_and_one_inside_reproduces(run):
    out, within = judged(run, entry(), entry(id="b", holds=[0.0, 1e-12]))
    assert (out.verdict, out.number) == ("contradicted", 0.0)
    assert within.verdict == "reproduced"


def test_without_a_result_a_claim_is_open(run):
    one, other = judged(run, entry(case="tillage/table1-0.5"), entry(id="b", metric="no_such_metric"))
    assert one.verdict == other.verdict == "open"


def test_a_ratio_of_two_metrics(run):
    claim, = judged(run, entry(over=f"{TOOL}:plastic_strain", holds=[0.999, 1.001]), value=0.4)
    assert claim.verdict == "reproduced" and claim.number == 1.0


def test_a_ratio_over_zero_is_open(run):
    claim, = judged(run, entry(over="plastic_strain"), value=0.0)
    assert claim.verdict == "open"


def test_undetermined_names_what_is_missing(run):
    claim, = judged(run, {"id": "c", "place": "2.5", "statement": "It slides", "undetermined": "No friction is given."})
    assert claim.verdict == "undetermined" and claim.reason == "No friction is given."


@pytest.mark.parametrize("wrong, words", [
    ({"case": "tillage/clay-2.0"}, "changed inputs"),
    ({"over": "tillage/rock-2.0:peak_force"}, "changed inputs"),
    ({"holds": [1.0, 0.0]}, "range"),
    ({"statement": ""}, "statement is missing"),
    ({"quantity": "guess"}, "quantity"),
    ({"undetermined": "and yet"}, "undetermined"),
])
def test_a_ledger_that_breaks_its_rules_is_refused(wrong, words):
    with pytest.raises(claims.ClaimError, match=words):
        claims._check(entry(**wrong), set())


def test_the_ledger_has_its_claims_once_and_both_sides_of_the_contradiction():
    entries = claims.load()
    assert len(entries) >= 25
    by_id = {e["id"]: e for e in entries}
    assert len(by_id) == len(entries)
    assert by_id["elastic-at-2ms"]["metric"] == by_id["plastic-at-2ms"]["metric"]
    assert by_id["elastic-at-2ms"]["holds"][1] < by_id["plastic-at-2ms"]["holds"][0]


def test_the_page_links_to_the_case(run):
    folder = run(result(TOOL, family="tillage", metrics=[metric("plastic_strain", 0.0, [-1.0, 1.0])]))
    index = build(folder)
    page = Page((index.parent / "claims.html").read_text(encoding="utf-8"))
    assert "cases/tillage/table1-2.0.html" in {link for _, _, link in page.links}
    assert "claims.html" in index.read_text()
