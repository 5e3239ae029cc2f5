"""Blessing: cases of a run become the baseline, with a reason on the ledger. What is red without a reason is never blessed."""

import datetime
import fnmatch

from gate import baseline, curves, ledger
from gate.baseline import FOLDER, Accepted, Baseline
from gate.files import GateError, locked
from gate.rules import is_looser


def bless(run, globs, reason, expires=None, folder=FOLDER, who=None):
    """Accepts the cases of `run` (reports.results.Run) that match. Returns sentences about what was recorded; GateError, before
    anything is written, when one of them may not be accepted."""
    reason = (reason or "").strip()
    if not reason:
        raise GateError("an empty reason; --reason says to a later reader why this number is the right one now")
    cases = _chosen(run, globs)
    for case in cases:
        _check(case)
    who = who or ledger.who()
    with locked(folder, "bless"):
        before = baseline.read_all(folder)
        ledger.read(folder)   # a ledger that cannot be read is not added to
        said = []
        for case in cases:
            said += _accept(case, before.get(case.id), reason, expires, folder, who)
    return said


def _chosen(run, globs):
    chosen = {}
    for glob in globs:
        found = [c for c in run.cases if fnmatch.fnmatchcase(c.id, glob)]
        if not found:
            example = f", such as {run.cases[0].id}" if run.cases else ""
            raise GateError(f"{glob}: the run has no such case; it ran {len(run.cases)}{example}")
        chosen |= {c.id: c for c in found}
    return list(chosen.values())


def _check(case):
    """GateError when the case may not become a baseline."""
    provenance = case.data.get("provenance", {})
    refusals = [
        (case.verdict == "error", f"it ended as error: {case.reason}"),
        (case.verdict == "fail", "it fails: make it pass, or record a known gap in its case file with cause and expiry"),
        (provenance.get("dirty", True), "it ran from a dirty tree, which no commit can give back: commit, run again"),
        (provenance.get("commit", "unknown") == "unknown", "nobody knows the commit that it ran from"),
        (bool(case.data.get("overrides")), f"it is not the case of its file: {', '.join(case.data.get('overrides', []))}"),
        (provenance.get("particle_order", 0) != 0, "it ran in another order of particles, which is for measuring noise"),
    ]
    for refused, why in refusals:
        if refused:
            raise GateError(f"{case.id}: {why}", 1)


def accepted_of(metric, before=None):
    """baseline.Accepted of a metric of result.json; noise is kept from the baseline before, for it belongs to the metric."""
    value = None if metric["verdict"] == "skipped" else metric["value"]
    kept = before if before is not None and before.unit == metric["unit"] else Accepted(None, "", "", None, None, None)
    return Accepted(value, metric["unit"], metric["verdict"], metric["reference"]["value"],
                    metric["reference"]["standard_uncertainty"], metric["band"], kept.spread, kept.runs, kept.reference_spread)


def _accept(case, before, reason, expires, folder, who):
    provenance, known = case.data["provenance"], before.metrics if before else {}
    metrics = {m["name"]: accepted_of(m, known.get(m["name"])) for m, _ in case.metrics}
    new = Baseline(case.id, case.data["tier"], provenance["commit"], provenance["started"][:10], provenance.get("inputs", ""),
                   metrics, sorted(case.data["exercises"]), curves.of(case.data))
    # The ledger first: a number without its reason must not be left behind by a kill; a reason without its number is harmless.
    said = []
    for entry, words in _entries(case, known, new, reason, expires, who):
        ledger.add(entry, folder)
        said.append(words)
    baseline.write(new, folder)
    return said


def _entries(case, known, new, reason, expires, who):
    moved = {name: [known[name].value, m.value] for name, m in new.metrics.items()
             if name in known and known[name].value != m.value}
    added = sorted(new.metrics.keys() - known.keys())
    gone = sorted(known.keys() - new.metrics.keys())
    yield (ledger.entry("value", who, new.commit, reason, case=case.id, moved=moved, added=len(added), gone=gone),
           f"{case.id}: {len(new.metrics)} metrics accepted, {len(moved)} of them moved, {len(added)} new, {len(gone)} gone")
    until = expires or (datetime.date.today() + ledger.LEAVE).isoformat()
    for metric, _ in case.metrics:
        name = metric["name"]
        if name in known and is_looser(metric["band"], known[name].band):
            yield (ledger.entry("band", who, new.commit, reason, case=case.id, metric=name, before=known[name].band,
                                after=metric["band"], expires=until), f"{case.id} {name}: loosened band, until {until}")
        if metric["verdict"] == "known-gap" and (name not in known or known[name].verdict != "known-gap" or expires):
            yield (ledger.entry("known-gap", who, new.commit, f"{reason}; {metric.get('reason', '')}".strip("; "), case=case.id,
                                metric=name, expires=until), f"{case.id} {name}: known gap, until {until}")
