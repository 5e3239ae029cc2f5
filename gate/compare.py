"""A run against the baselines: every row, what is to blame, what is conceded."""

import datetime
import fnmatch
from dataclasses import dataclass, field

from gate import ledger, rules
from gate.blame import Blame, blame
from gate.rules import GREEN, RED, YELLOW, Row

TIERS = ("smoke", "quick", "nightly", "full")


@dataclass
class Comparison:
    rows: list                       # rules.Row, worst first
    blame: Blame
    concessions: list                # ledger.Concession that this run makes use of
    notes: list = field(default_factory=list)   # sentences about what was compared with what

    def count(self, colour=None, kind=None):
        return sum(1 for r in self.rows if (colour is None or r.colour == colour) and (kind is None or r.kind == kind))

    @property
    def colour(self):
        return RED if self.count(RED) or not self.rows else YELLOW if self.count(YELLOW) else GREEN

    @property
    def exit_code(self):
        """0 nothing red, 1 red, 3 a case ended as error. A run without a single metric is red."""
        return 3 if self.count(kind="error") else 1 if self.colour == RED else 0


def compare(run, baselines, entries, today=None, only_known=False):
    """`run`: reports.results.Run; `baselines`: case -> Baseline; `entries`: of the ledger. `only_known`: cases without a baseline
    and cases that did not run are no rows, for runs that nobody gates."""
    today = today or datetime.datetime.now(datetime.timezone.utc).date()
    rows, notes, changed_inputs = [], [], 0
    for case in run.cases:
        accepted = baselines.get(case.id)
        if only_known and accepted is None:
            continue
        rows += rows_of(case, accepted, entries, today)
        inputs = case.data.get("provenance", {}).get("inputs")
        if accepted and inputs and inputs != accepted.inputs:
            changed_inputs += 1
        if case.data.get("overrides"):
            notes.append(f"{case.id} ran with {', '.join(case.data['overrides'])}.")
    if changed_inputs:
        notes.append(f"{changed_inputs} case{'s' * (changed_inputs > 1)} with other input than accepted (case file, material, "
                     "data).")
    if not only_known:
        rows += [rules.lost(case, name, metric, "the case did not run") for case in missing(run, baselines)
                 for name, metric in baselines[case].metrics.items()]
    concessions = ledger.concessions(entries, [c.data for c in run.cases if c.data.get("metrics")], today)
    return Comparison(rules.order(rows), _blame(run, rows), concessions, notes)


def rows_of(case, accepted, entries, today):
    """Rows of one reports.results.Case; `accepted` its Baseline or None."""
    known = accepted.metrics if accepted else {}
    if case.faults or not case.data.get("metrics"):
        return [Row(case.id, "", RED, "error", case.reason or "it measured nothing", "error")]
    rows = [rules.row(case.id, m, known.get(m["name"]), ledger.standing(entries, case.id, m, today)) for m, _ in case.metrics]
    measured = {m["name"] for m, _ in case.metrics}
    rows += [rules.lost(case.id, name, metric, "the case does not measure it any more")
             for name, metric in known.items() if name not in measured]
    if case.verdict == "error" and not any(r.kind == "error" for r in rows):
        rows.append(Row(case.id, "", RED, "error", case.reason, "error"))
    return rows


def missing(run, baselines):
    """Accepted cases that a run of a tier should have run and did not know."""
    tier = run.data.get("tier")
    if tier not in TIERS:
        return []
    ran, only = {c.id for c in run.cases}, run.data.get("only") or ["*"]
    return sorted(case for case, b in baselines.items() if case not in ran and b.tier in TIERS[:TIERS.index(tier) + 1]
                  and any(fnmatch.fnmatchcase(case, glob) for glob in only))


def _blame(run, rows):
    touched = {r.case for r in rows if r.kind in rules.COMPUTED}
    compared = {r.case for r in rows if r.change}
    modules = {c.id: set(c.data.get("exercises", [])) for c in run.cases}
    return blame({case: modules.get(case, set()) for case in touched},
                 {case: modules[case] for case in compared - touched})
