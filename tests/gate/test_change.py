"""The change verdict: bits, noise, direction, and nothing that is not a number."""

import math
import random

import pytest

from gate.change import AWAY, BITWISE, MOVED, ROUND_OFF, TOWARD, UNDECIDED, WITHIN, allowance, change, truth_of
from tests.gate.made import accepted


def judged(new, old=1.0, norm="absolute", reference=0.0, uncertainty=0.0, old_reference=None, spread=0.0, unit="1", band=(0.0, 1e-12)):
    before = accepted(old, reference if old_reference is None else old_reference, spread, unit, band=band)
    return change(new, before, norm, reference, uncertainty)


def test_equal_bits_and_only_they_are_bitwise():
    assert judged(1.0).kind == BITWISE
    assert judged(math.nextafter(1.0, 2.0)).kind == WITHIN
    assert judged(-0.0, 0.0).kind == WITHIN


@pytest.mark.parametrize("moved, kind", [(2.9, WITHIN), (-2.9, WITHIN), (3.1, MOVED), (-3.1, MOVED)])
def test_three_measured_spreads_are_within(moved, kind):
    assert judged(1.0 + 0.01 * moved, spread=0.01).kind == kind


@pytest.mark.parametrize("norm, width", [("absolute", 4.0), ("relative", 4.0 / 3.0)])
def test_a_millionth_of_the_band_is_within(norm, width):
    band = [-0.5 * width, 0.5 * width]
    assert judged(3.0 + 3.9e-6, 3.0, norm, 3.0, band=band).kind == WITHIN
    assert judged(3.0 + 4.1e-6, 3.0, norm, 3.0, band=band).kind == MOVED
    assert judged(3.0 + 3.9e-6, 3.0, norm, 3.0, band=[0.0, math.inf]).kind == MOVED   # a millionth of 3
    assert judged(3.0 + 2.9e-6, 3.0, norm, 3.0, band=None).kind == WITHIN


def test_an_error_of_round_off_behind_a_wide_band_may_grow_a_hundredfold():
    assert judged(9e-11, 1e-12, band=(-0.005, 0.005)).kind == WITHIN
    assert judged(2e-10, 1e-12, band=(-0.005, 0.005)).kind == MOVED
    assert judged(1e-5 + 9e-9, 1e-5, band=(-0.005, 0.005)).kind == WITHIN   # a millionth of the band, where that is less
    assert judged(1e-5 + 2e-8, 1e-5, band=(-0.005, 0.005)).kind == MOVED


def test_without_measured_noise_round_off_alone_is_within():
    assert judged(1.0 + 0.5 * ROUND_OFF).kind == WITHIN
    assert judged(1.0 + 2.0 * ROUND_OFF).kind == MOVED
    assert not change(1.0, accepted(spread=None), "absolute", 0.0, 0.0).measured


def test_round_off_is_that_of_the_scale():
    assert allowance(1e-15, 0.0, "1", None) == ROUND_OFF            # an error of pure numbers is one of numbers of size 1
    assert allowance(1e-15, 0.0, "m", None) == ROUND_OFF * 1e-15    # with a unit nobody knows the size but the value
    assert allowance(16.3, 16.2, "mm", None) == ROUND_OFF * 16.3


@pytest.mark.parametrize("old, new, reference, direction", [
    (1.0, 0.9, 0.0, TOWARD), (1.0, 1.1, 0.0, AWAY), (-1.0, -0.9, 0.0, TOWARD), (-1.0, -1.1, 0.0, AWAY),
    (1.0, 2.5, 2.0, TOWARD), (1.0, 3.5, 2.0, AWAY), (1.0, 3.0, 2.0, UNDECIDED),   # as far as before on the other side
    (1.0, -0.9, 0.0, TOWARD), (1.0, -1.1, 0.0, AWAY),
])
def test_direction_is_the_distance_from_the_truth(old, new, reference, direction):
    found = judged(new, old, reference=reference)
    assert (found.kind, found.direction) == (MOVED, direction)


@pytest.mark.parametrize("old, new, direction", [
    (16.30, 16.35, UNDECIDED),    # both within two standard uncertainties of 16.21
    (16.30, 16.50, AWAY), (16.50, 16.30, TOWARD), (16.60, 16.50, TOWARD)])
def test_an_uncertain_reference_cannot_tell_two_numbers_that_it_covers(old, new, direction):
    assert judged(new, old, "relative", 16.21, 0.1).direction == direction


def test_the_truth_of_an_error_norm_without_reference_is_zero_and_of_a_bare_value_unknown():
    assert truth_of(None, "L2 relative value") == 0.0
    assert truth_of(None, "value") is None
    assert truth_of(2.0, "value") == 2.0
    assert judged(0.5, norm="value", reference=None).direction == UNDECIDED


def test_a_reference_that_moved_is_said_even_when_the_value_did_not():
    found = judged(1.0, reference=2.0, old_reference=2.1)
    assert (found.kind, found.direction, found.why) == (MOVED, UNDECIDED, "the reference itself changed")
    assert judged(1.0, reference=2.0, old_reference=math.nextafter(2.0, 3.0)).kind == BITWISE


def test_a_reference_that_is_computed_may_move_within_its_own_noise():
    before = accepted(1.0, 2.0)
    before.reference_spread = 1e-9
    assert change(1.0, before, "absolute", 2.0 + 2.9e-9, 0.0).kind == BITWISE
    assert change(1.0, before, "absolute", 2.0 + 3.1e-9, 0.0).kind == MOVED
    assert change(1.0, before, "absolute", None, 0.0).kind == MOVED


@pytest.mark.parametrize("new, old", [(math.nan, 1.0), (math.inf, 1.0), (-math.inf, 1.0), (1.0, math.nan), (1.0, math.inf)])
def test_what_is_not_finite_is_never_judged(new, old):
    with pytest.raises(ValueError):
        judged(new, old)


def test_a_move_is_never_green_and_within_never_exceeds_its_allowance():
    draw = random.Random(7)
    for _ in range(2000):
        old, spread = draw.gauss(0, 1), abs(draw.gauss(0, 0.01))
        new = old + draw.choice((0.0, 1e-14, 0.005, 0.05, 1.0)) * draw.gauss(0, 1)
        found = judged(new, old, spread=spread, reference=draw.choice((0.0, 0.3, None)), norm="value")
        assert (found.kind == MOVED) == (abs(new - old) > found.allowance)
        assert (found.direction is not None) == (found.kind == MOVED)
