"""The ledger of the paper's claims: reference/paper-claims.toml against the results of a run."""

import math
import tomllib
from dataclasses import dataclass
from pathlib import Path

FILE = Path(__file__).resolve().parent.parent / "reference" / "paper-claims.toml"
VERDICTS = ("reproduced", "contradicted", "undetermined", "open")
DEMONSTRATIONS = ("tillage/clay-", "tillage/rock-")   # changed inputs: whatever happens there says nothing of the paper


class ClaimError(ValueError):
    """The ledger itself is wrong; the message names the claim."""


@dataclass
class Claim:
    id: str
    place: str
    statement: str
    verdict: str
    reason: str
    case: object = None            # of the run, for the link
    case_id: str = ""
    metric: str = ""
    number: float | None = None
    unit: str = ""
    holds: tuple | None = None


def load(file=FILE):
    with open(file, "rb") as stream:
        entries = tomllib.load(stream).get("claim", [])
    seen = set()
    for entry in entries:
        _check(entry, seen)
    return entries


def _check(entry, seen):
    name = entry.get("id", "without id")
    missing = [key for key in ("id", "place", "statement") if not entry.get(key)]
    if missing:
        raise ClaimError(f"claim {name}: {missing[0]} is missing")
    if name in seen:
        raise ClaimError(f"claim {name} stands there twice")
    seen.add(name)
    if "undetermined" in entry:
        if "case" in entry:
            raise ClaimError(f"claim {name}: undetermined, and yet a case decides it")
        return
    for key in ("case", "metric", "holds", "reason"):
        if key not in entry:
            raise ClaimError(f"claim {name}: {key} is missing, or else undetermined")
    if entry.get("quantity", "value") not in ("value", "error", "magnitude of error"):
        raise ClaimError(f"claim {name}: quantity must be value, error or magnitude of error")
    low, high = entry["holds"]
    if not low <= high:
        raise ClaimError(f"claim {name}: holds must be a range")
    if any(case.startswith(DEMONSTRATIONS) for case in (entry["case"], entry.get("over", ""))):
        raise ClaimError(f"claim {name}: a demonstration with changed inputs decides no claim of the paper")


def _metric(case, name):
    return next((m for m, _ in case.metrics if m["name"] == name), None) if case and not case.faults else None


def _number(metric, quantity):
    if metric is None:
        return None
    number = metric["value"] if quantity == "value" else metric["error"]
    if number is None or not math.isfinite(number):
        return None
    return abs(number) if quantity == "magnitude of error" else number


def judge(entries, run):
    """Every claim with its verdict; `open` where the run has no result that could decide it."""
    cases = {case.id: case for case in run.cases}
    found = []
    for entry in entries:
        claim = Claim(entry["id"], entry["place"], entry["statement"], "undetermined", entry.get("undetermined", ""))
        found.append(claim)
        if "undetermined" in entry:
            continue
        claim.reason, claim.holds = entry["reason"], tuple(entry["holds"])
        claim.case_id, claim.metric = entry["case"], entry["metric"]
        claim.case = cases.get(claim.case_id)
        quantity = entry.get("quantity", "value")
        metric = _metric(claim.case, claim.metric)
        claim.number = _number(metric, quantity)
        claim.unit = metric["unit"] if metric and (quantity == "value" or "relative" not in metric["norm"]) else "1"
        if "over" in entry:
            case, _, name = entry["over"].rpartition(":")
            below = _number(_metric(cases.get(case or claim.case_id), name), "value")
            claim.number = claim.number / below if claim.number is not None and below else None
            claim.unit = "1"
        if claim.number is None:
            claim.verdict = "open"
        else:
            claim.verdict = "reproduced" if claim.holds[0] <= claim.number <= claim.holds[1] else "contradicted"
    return found


def counts(claims):
    return {verdict: sum(c.verdict == verdict for c in claims) for verdict in VERDICTS}
