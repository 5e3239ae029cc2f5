"""Step detection: finds what stepped, where it stepped, and leaves noise alone."""

import itertools
import math
import random

import pytest

from night.steps import scatter, steps


def places(x, floor=1e-12, shortest=1):
    return [s.index for s in steps(x, floor, shortest)]


def test_one_step_of_numbers_without_noise():
    found = steps([1.0] * 7 + [1.001] * 5, 1e-9)
    assert [s.index for s in found] == [7]
    assert found[0].before == pytest.approx(1.0) and found[0].after == pytest.approx(1.001)


@pytest.mark.parametrize("before, after", [(1, 1), (1, 5), (9, 1)])
def test_a_step_is_seen_with_the_first_value_after_it(before, after):
    assert places([2.0] * before + [3.0] * after) == [before]


def test_up_and_down_again_are_two_steps_and_a_spike_is_none_where_it_may_not_be():
    x = [1.0] * 6 + [2.0] + [1.0] * 6
    assert places(x) == [6, 7]
    assert places(x, shortest=3) == []
    assert places([1.0] * 6 + [2.0] * 6, shortest=3) == [6]


def test_what_lies_below_the_floor_is_no_step():
    assert places([1.0] * 6 + [1.001] * 6, floor=0.01) == []
    assert places([1.0] * 6 + [1.2] * 6, floor=0.01) == [6]


@pytest.mark.parametrize("x", [[], [1.0], [1.0, 1.0], [0.0] * 50])
def test_flat_and_short_series_have_none(x):
    assert places(x) == []


def test_noise_alone_seldom_has_a_step():
    draw = random.Random(3)
    false = sum(bool(places([draw.gauss(10.0, 1.0) for _ in range(60)], shortest=3)) for _ in range(300))
    assert false <= 9


def test_a_step_of_five_deviations_in_noise_is_found_near_its_place():
    draw = random.Random(4)
    hits = 0
    for _ in range(100):
        x = [draw.gauss(0.0, 1.0) + (5.0 if i >= 30 else 0.0) for i in range(60)]
        hits += any(abs(p - 30) <= 1 for p in places(x, shortest=3))
    assert hits >= 97


def test_no_other_cuts_cost_less():
    draw = random.Random(5)
    for _ in range(30):
        x = [draw.choice((0.0, 4.0, 9.0)) + draw.gauss(0.0, 1.0) for _ in range(8)]
        sigma, penalty = max(scatter(x), 0.5), 4.0 * math.log(8)

        def cost(cuts):
            edges = [0, *cuts, 8]
            parts = [x[a:b] for a, b in zip(edges, edges[1:])]
            return penalty * len(cuts) + sum(sum((v - sum(p) / len(p)) ** 2 for v in p) for p in parts) / sigma**2
        best = min(cost(c) for n in range(8) for c in itertools.combinations(range(1, 8), n))
        assert cost(places(x, floor=0.5)) == pytest.approx(best)


def test_scatter_does_not_see_steps():
    draw = random.Random(6)
    x = [draw.gauss(0.0, 2.0) + 100.0 * (i // 50) for i in range(200)]
    assert scatter(x) == pytest.approx(2.0, rel=0.25)


@pytest.mark.parametrize("x, floor", [([1.0, math.nan], 1.0), ([1.0, math.inf], 1.0), ([1.0, 2.0], 0.0)])
def test_what_is_no_number_is_refused(x, floor):
    with pytest.raises(ValueError):
        steps(x, floor)


def test_a_step_far_above_the_floor_leaves_no_false_ones_beside_it():
    x = [0.49437812345678] * 12 + [0.49437812345678 * 1.01] * 8
    assert places(x, floor=1e-16) == [12]
