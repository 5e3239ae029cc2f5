"""The smallest set of modules that covers what moved and spares what did not."""

import itertools
import random

from gate import blame as module
from gate.blame import SPARING, blame


def names(found):
    return {s.modules for s in found.suspects}


def test_one_module_that_all_reds_share_and_no_green_has():
    found = blame({"a": {"x", "y"}, "b": {"x", "z"}}, {"c": {"y", "z"}})
    assert names(found) == {("x",)}
    assert (found.suspects[0].covers, found.suspects[0].touches, found.suspects[0].spares) == (2, 0, 1)


def test_the_module_of_every_case_is_spared_by_the_greens():
    greens = {f"g{i}": {"simulation"} for i in range(9)}
    assert names(blame({"a": {"simulation", "x"}, "b": {"simulation", "y"}}, greens)) == {("x",), ("y",)}


def test_one_blind_green_does_not_acquit():
    assert names(blame({"a": {"x", "y"}, "b": {"x", "z"}}, {"c": {"x"}})) == {("x",)}


def test_modules_that_cannot_be_told_apart_are_named_together():
    assert names(blame({"a": {"x", "y"}}, {"c": {"z"}})) == {("x", "y")}


def test_a_red_without_modules_is_said():
    found = blame({"a": set(), "b": {"x"}}, {})
    assert found.unexplained == ("a",) and names(found) == {("x",)}
    assert blame({}, {"c": {"x"}}).suspects == ()


def cost(chosen, greens):
    modules = set(chosen)
    return SPARING * len(modules) + sum(bool(modules & m) for m in greens.values())


def test_no_set_of_modules_is_cheaper():
    draw = random.Random(11)
    letters = "abcdefg"
    for _ in range(200):
        reds = {f"r{i}": set(draw.sample(letters, draw.randint(1, 4))) for i in range(draw.randint(1, 5))}
        greens = {f"g{i}": set(draw.sample(letters, draw.randint(1, 4))) for i in range(draw.randint(0, 8))}
        found = [s.modules[0] for s in blame(reds, greens).suspects]
        assert all(m & set(found) for m in reds.values())
        best = min(cost(c, greens) for n in range(1, 8) for c in itertools.combinations(letters, n)
                   if all(m & set(c) for m in reds.values()))
        assert cost(found, greens) == best


def test_greedy_covers_too_and_order_of_cases_does_not_matter(monkeypatch):
    reds = {f"r{i}": {f"m{i}", f"m{i + 1}"} for i in range(6)}
    assert names(blame(reds, {})) == names(blame(dict(reversed(reds.items())), {}))
    monkeypatch.setattr(module, "MOST_GROUPS", 0)
    chosen = {n for s in blame(reds, {}).suspects for n in s.modules}
    assert all(m & chosen for m in reds.values())
