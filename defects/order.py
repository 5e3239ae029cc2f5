"""Which cases to ask first: those that tell soonest, by what they cost and how often they caught a defect of the same module."""

import collections

STARTUP = 0.25          # CPU seconds of a case that computes nothing
BATCHES = (2.0, 6.0)    # CPU seconds of the first batches; the rest of a tier is one more


class Past:
    """Kills so far, of this hunt."""

    def __init__(self):
        self.kills = collections.Counter()   # (case, module)

    def learn(self, defect, fate):
        self.kills.update((k.case, module) for k in fate.seen if k.by == "truth" for module in defect.modules)

    def hope(self, case, defect):
        return 0.2 + sum(self.kills[case.id, module] for module in defect.modules)


def cost(case):
    return STARTUP + case.data["cost"]["cpu_s"]


def batches(cases, past, defect):
    """Lists of cases (reports.results.Case, clean), to be run one list after the other until one catches the defect."""
    waiting = sorted(cases, key=lambda c: (cost(c) / past.hope(c, defect), c.id))
    found = []
    for budget in BATCHES:
        batch, spent = [], 0.0
        while waiting and (not batch or spent + cost(waiting[0]) <= budget):
            batch.append(waiting.pop(0))
            spent += cost(batch[-1])
        if batch:
            found.append(batch)
    return [*found, waiting] if waiting else found
