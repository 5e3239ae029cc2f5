"""Every rule of red and yellow, one by one."""

import math

import pytest

from gate.rules import GREEN, RED, YELLOW, Standing, is_looser, order, row
from tests.gate.made import accepted
from tests.reports.sample import metric


def judged(value=1.0, before="same", band=(0.0, 2.0), standing=Standing(), verdict="pass", **more):
    before = accepted() if before == "same" else before
    return row("kernel/one", metric("norm", value, list(band) if band else None, verdict, **more), before, standing)


def found(r):
    return r.colour, r.kind


def test_the_same_bits_are_green():
    assert found(judged()) == (GREEN, "bitwise")


def test_within_noise_is_green():
    assert found(judged(1.02, accepted(spread=0.01))) == (GREEN, "within")


def test_a_move_away_from_the_truth_is_red_even_inside_the_band():
    assert found(judged(1.1)) == (RED, "away")


def test_a_move_toward_the_truth_is_yellow():
    assert found(judged(0.9)) == (YELLOW, "toward")


def test_a_move_that_nobody_can_judge_is_yellow():
    assert found(judged(0.9, accepted(reference=None), norm="value", reference=None)) == (YELLOW, "undecided")


def test_a_failure_is_red_and_a_failure_that_was_accepted_is_judged_by_its_move():
    assert found(judged(2.5, verdict="fail")) == (RED, "fail")
    assert found(judged(2.5, None, verdict="fail")) == (RED, "fail")
    before = accepted(2.5, verdict="fail")
    assert found(judged(2.5, before, verdict="fail")) == (GREEN, "known")
    assert found(judged(2.6, before, verdict="fail")) == (RED, "away")


@pytest.mark.parametrize("value", [None, math.nan, math.inf, -math.inf, True, "1.0"])
def test_what_is_no_finite_number_is_an_error_whatever_its_verdict(value):
    for verdict in ("pass", "reported", "known-gap", "error", "fail"):
        assert found(judged(value, verdict=verdict)) == (RED, "error")


def test_an_error_is_red_even_with_a_number():
    assert found(judged(1.0, verdict="error", reason="measured twice")) == (RED, "error")


def test_a_new_metric_is_red():
    assert found(judged(before=None)) == (RED, "new")
    assert found(judged(before=accepted(None, verdict="skipped"))) == (RED, "new")


def test_a_metric_that_is_now_skipped_is_lost_and_one_that_always_was_is_not():
    assert found(judged(None, verdict="skipped", reason="no probe")) == (RED, "lost")
    assert found(judged(None, accepted(None, verdict="skipped"), verdict="skipped", reason="no probe")) == (GREEN, "skipped")


def test_another_unit_is_another_metric():
    assert found(judged(unit="mm")) == (RED, "lost")


def test_a_known_gap_is_red_unless_the_ledger_records_it():
    before = accepted(verdict="known-gap")
    assert found(judged(verdict="known-gap", before=before)) == (RED, "gap")
    assert found(judged(verdict="known-gap", before=before, standing=Standing(gap=True))) == (GREEN, "known")


def test_a_loosened_band_is_red_and_so_is_one_whose_leave_has_ended():
    assert found(judged(band=(0.0, 3.0))) == (RED, "band")
    assert found(judged(band=None, verdict="reported")) == (RED, "band")
    assert found(judged(band=(0.0, 1.5))) == (GREEN, "bitwise")
    assert found(judged(standing=Standing(band_expired="2026-01-01"))) == (RED, "band")


@pytest.mark.parametrize("band, than, looser", [
    ([0, 1], [0, 1], False), ([0, 2], [0, 1], True), ([-1, 1], [0, 1], True), ([0, None], [0, 1], True),
    ([None, 1], [0, 1], True),
    ([0, 1], [0, None], False), (None, [0, 1], True), ([0, 1], None, False), (None, None, False), ([0, None], [0, None], False)])
def test_looser(band, than, looser):
    assert is_looser(band, than) == looser


def test_the_worst_come_first_and_among_equals_the_largest_move():
    small, large, error = judged(1.1), judged(1.5), judged(None, verdict="error")
    fail, yellow, green = judged(2.5, verdict="fail"), judged(0.5), judged()
    assert order([green, yellow, small, fail, large, error]) == [error, fail, large, small, yellow, green]
