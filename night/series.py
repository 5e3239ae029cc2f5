"""Series of the history as the terminal and the report show them: values, steps, and the commit that each step began with."""

import subprocess
from dataclasses import dataclass, field

from gate import change
from gate.files import ROOT
from gate.table import told_apart
from night import steps, store
from reports.numbers import number, unit

SHOWN = 60   # runs that the report shows
COST_SCATTER = 0.03   # of a cost, relative: a machine is never quieter
COST_SHORTEST = 3     # nights that a new cost must last


@dataclass
class Series:
    case: str
    name: str
    unit: str
    kind: str                      # value, cost
    places: list                   # indices into the list of nights
    values: list
    steps: list = field(default_factory=list)   # steps.Step, index into values

    @property
    def key(self):
        return f"{self.case}/{self.name}"

    def jump(self, step):
        """Relative size of a step; infinite from zero."""
        return abs(step.after - step.before) / abs(step.before) if step.before else float("inf")


def read(connection, nights, baselines=None):
    """Every series of these nights, with its steps. `baselines`: for the noise that was measured of a metric."""
    found = []
    for (case, name), (unit, kind, points) in sorted(store.values(connection, nights).items()):
        s = Series(case, name, unit, kind, [p for p, _ in points], [v for _, v in points])
        s.steps = steps.steps(s.values, floor(s, baselines or {}), COST_SHORTEST if kind == "cost" else 1)
        found.append(s)
    return found


def floor(series, baselines):
    """Least standard deviation that a value of the series may be thought to have."""
    largest = max(abs(v) for v in series.values)
    if series.kind == "cost":
        return max(COST_SCATTER * largest, 0.02 if series.unit == "s" else 1e6 if series.unit == "B" else 1e-300)
    accepted = baselines.get(series.case)
    metric = accepted.metrics.get(series.name) if accepted else None
    reference, spread = (metric.reference, metric.spread) if metric else (None, None)
    return max(change.allowance(largest, reference, series.unit, spread) / change.SPREADS, 1e-300)


def commits_between(before, after):
    """How many commits lie after `before` up to `after`; None where git does not know them."""
    done = subprocess.run(["git", "-C", str(ROOT), "rev-list", "--count", f"{before}..{after}"], capture_output=True, text=True)
    return int(done.stdout) if done.returncode == 0 and done.stdout.strip().isdigit() else None


def step_words(series, step, nights):
    """'0.51 → 0.48 since 1a2b3c4d (2026-11-22)', with how many commits may have done it when there are several."""
    after, before = (nights[series.places[step.index + d]] for d in (0, -1))
    tail = f" {unit(series.unit)}" if unit(series.unit) else ""
    relative = series.jump(step)
    size = f" ({'+' if step.after > step.before else ''}{number(100.0 * (step.after - step.before) / abs(step.before), 2)} %)" \
        if relative != float("inf") else ""
    count = commits_between(before.commit, after.commit)
    among = f", one of {count} commits after {before.commit[:8]}" if count and count > 1 else ""
    same = before.commit == after.commit
    since = f"on {after.started[:10]} without a new commit: the machine or its packages" if same else \
        f"since {after.commit[:8]} of {after.started[:10]}{among}"
    return f"{' → '.join(told_apart(step.before, step.after))}{tail}{size} {since}"


def sparkline(values, width=24):
    """The last `width` values as block characters; a flat series is a low line."""
    shown = values[-width:]
    low, high = min(shown), max(shown)
    if not high > low:
        return "▁" * len(shown)
    return "".join("▁▂▃▄▅▆▇█"[min(7, int(8.0 * (v - low) / (high - low)))] for v in shown)


def to_report(all_series, nights):
    """What the report reads as RUN/history.json, schema 1."""
    return {"schema": 1, "runs": [{"commit": n.commit, "started": n.started, "dirty": n.dirty, "tier": n.tier} for n in nights],
            "series": [{"case": s.case, "name": s.name, "unit": s.unit, "kind": s.kind, "places": s.places, "values": s.values,
                        "steps": [{"index": t.index, "before": t.before, "after": t.after, "words": step_words(s, t, nights)}
                                  for t in s.steps]} for s in all_series]}
