"""Which modules a red gate points to: the smallest set that covers the cases that moved and spares those that did not.

Each case exercises modules. If a set of modules is to blame, every case that is red must exercise one of them, and a case that
exercises one and did not move speaks against it, though weakly: it may be blind to what is wrong. So a set costs SPARING for
every module in it and one for every unmoved case it touches, and the cheapest set that covers all reds is named: exactly, by
branch and bound, up to MOST_GROUPS modules that can be told apart; greedily beyond. Modules that the same cases exercise cannot
be told apart and are named together. Of sets of equal cost the smaller is taken, then the first in the alphabet.
"""

from dataclasses import dataclass

SPARING = 3        # unmoved cases that must be spared before one more module is worth naming
MOST_GROUPS = 40


@dataclass(frozen=True)
class Suspect:
    modules: tuple      # names that cannot be told apart
    covers: int         # red cases that exercise them
    spares: int         # unmoved cases that do not
    touches: int        # unmoved cases that do


@dataclass(frozen=True)
class Blame:
    suspects: tuple
    unexplained: tuple  # red cases that declare no module


def blame(reds, greens):
    """`reds`, `greens`: case -> set of modules. The cheapest covering set, the one that covers most first."""
    unexplained = tuple(sorted(case for case, modules in reds.items() if not modules))
    reds = {case: set(modules) for case, modules in reds.items() if modules}
    groups = _groups(reds, greens)
    chosen = _exact(groups, set(reds)) if len(groups) <= MOST_GROUPS else _greedy(groups, set(reds))
    suspects = [Suspect(names, len(covered), len(greens) - len(touched), len(touched)) for names, covered, touched in chosen]
    return Blame(tuple(sorted(suspects, key=lambda s: (-s.covers, s.touches, s.modules))), unexplained)


def _groups(reds, greens):
    """[(names, red cases, green cases)] of modules that some red case exercises; those of equal cases are one group. A group that
    covers no more than another one does and touches at least as much can never be better, and is left out."""
    by_cases = {}
    for module in sorted(set().union(*reds.values()) if reds else ()):
        key = (frozenset(c for c, m in reds.items() if module in m), frozenset(c for c, m in greens.items() if module in m))
        by_cases.setdefault(key, []).append(module)
    groups = [(tuple(names), covered, touched) for (covered, touched), names in by_cases.items()]
    return [a for a in groups if not any(b is not a and a[1] <= b[1] and a[2] >= b[2] and (a[1], a[2]) != (b[1], b[2])
                                         for b in groups)]


def _cost(chosen):
    touched = set().union(*(g[2] for g in chosen)) if chosen else set()
    return (SPARING * len(chosen) + len(touched), len(chosen), tuple(sorted(g[0] for g in chosen)))


def _greedy(groups, wanted):
    chosen, missing = [], set(wanted)
    while missing:
        best = max(groups, key=lambda g: (len(g[1] & missing) / (SPARING + len(g[2])), [-ord(c) for c in g[0][0]]))
        chosen.append(best)
        missing -= best[1]
    return chosen


def _exact(groups, wanted):
    best = _greedy(groups, wanted)
    best_cost = _cost(best)

    def extend(chosen, missing):
        nonlocal best, best_cost
        cost = _cost(chosen)
        if not missing:
            if cost < best_cost:
                best, best_cost = chosen, cost
            return
        if cost[0] + SPARING > best_cost[0]:
            return
        case = min(missing, key=lambda c: (sum(c in g[1] for g in groups), c))   # the case with the fewest ways to be covered
        for group in groups:
            if case in group[1]:
                extend([*chosen, group], missing - group[1])

    extend([], set(wanted))
    return best
