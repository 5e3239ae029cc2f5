"""Noise: how far each metric moves without a cause. Measured from runs of one commit that are equally right: other compilers,
other optimisation, other orders of particles. Its spread, largest less smallest, is kept with the baseline; a change may be three
times that (gate.change)."""

import math

from gate import baseline, ledger
from gate.baseline import FOLDER
from gate.files import GateError, locked


def variant(run):
    """What a run differs from others in, in words."""
    p = run.provenance
    order = p.get("particle_order", 0)
    return f"{p.get('compiler', '?')} {p.get('flags', '?')}, threads {p.get('threads', '?')}, particle order {order}"


def spreads(runs):
    """case -> metric -> (spread, runs, spread of the reference). GateError when the runs are not of one clean commit; a case
    counts with the runs that have it, and is left out with fewer than two, or where an input differs."""
    commits = {str(r.provenance.get("commit", "unknown")) for r in runs}
    if len(runs) < 2:
        raise GateError("noise is a difference: it takes two runs or more")
    if len(commits) != 1 or "unknown" in commits:
        raise GateError(f"noise is measured at one commit, found {', '.join(sorted(c[:10] for c in commits))}")
    for run in runs:
        if run.provenance.get("dirty", True):
            raise GateError(f"{run.folder}: ran from a dirty tree")
    found = {}
    for run in runs:
        for case in run.cases:
            if case.data.get("metrics") and not case.faults and not case.data.get("overrides"):
                found.setdefault(case.id, []).append(case)
    result = {}
    for case, members in found.items():
        if len(members) < 2 or len({m.data["provenance"].get("inputs") for m in members}) != 1:
            continue
        values = {}
        for member in members:
            for metric, _ in member.metrics:
                value = metric["value"]
                if isinstance(value, (int, float)) and math.isfinite(value) and metric["verdict"] != "skipped":
                    values.setdefault(metric["name"], []).append((value, metric["reference"]["value"]))
        result[case] = {name: (_spread([v for v, _ in both]), len(both), _spread([r for _, r in both]))
                        for name, both in values.items() if len(both) >= 2}
    return result


def _spread(values):
    """Largest less smallest; None where one of them is missing."""
    return None if None in values else max(values) - min(values)


def record(runs, reason, folder=FOLDER, who=None):
    """Writes measured spreads into the baselines and a line on the ledger; what more runs have found of a metric stands. Returns
    (metrics measured, metrics still without)."""
    measured = spreads(runs)
    who = who or ledger.who()
    count = without = 0
    with locked(folder, "noise"):
        ledger.read(folder)
        everything = baseline.read_all(folder)
        touched = {}
        for case, accepted in everything.items():
            for name, metric in accepted.metrics.items():
                found = measured.get(case, {}).get(name)
                if found and found[1] >= metric.runs and metric.value is not None:
                    metric.spread, metric.runs, metric.reference_spread = found
                    count += 1
                    touched[case] = accepted
                elif metric.value is not None and metric.spread is None:
                    without += 1
        if touched:
            ledger.add(ledger.entry("noise", who, str(runs[0].provenance["commit"]), reason, cases=len(touched), metrics=count,
                                    variants=sorted(variant(r) for r in runs)), folder)
        for accepted in touched.values():
            baseline.write(accepted, folder)
    return count, without
