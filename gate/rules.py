"""What is red, what is yellow, what is green: one row for each metric, from the result and from what was accepted."""

import math
from dataclasses import dataclass

from gate.change import AWAY, BITWISE, MOVED, TOWARD, WITHIN, change

RED, YELLOW, GREEN = "red", "yellow", "green"

# Why a row is red, worst first; the order of the table.
KINDS = ("error", "fail", "away", "lost", "new", "gap", "band", "toward", "undecided", "known", "within", "bitwise", "skipped")
COMPUTED = ("error", "fail", "away", "toward", "undecided")   # kinds that the code under test causes, unlike those of bookkeeping


@dataclass(frozen=True)
class Row:
    case: str
    metric: str
    colour: str
    kind: str                       # one of KINDS
    why: str
    verdict: str | None = None      # accuracy, of this run; None for a lost metric
    accepted_verdict: str | None = None
    change: str | None = None       # bitwise, within, moved; None where there is nothing to compare
    direction: str | None = None
    value: float | None = None
    accepted: float | None = None
    unit: str = "1"
    allowance: float | None = None
    noise_measured: bool = False
    weight: float = 0.0             # how large the move is, in half-widths of its band or relative to the old value

    @property
    def relative(self):
        """Change over the accepted value; None where that is zero or missing."""
        if self.value is None or not self.accepted:
            return None
        return (self.value - self.accepted) / abs(self.accepted)


def lost(case, name, accepted, why):
    return Row(case, name, RED, "lost", why, None, accepted.verdict, accepted=accepted.value, unit=accepted.unit)


@dataclass(frozen=True)
class Standing:
    """What the ledger says of a metric today."""
    gap: bool = False               # its known gap is recorded and has not expired
    band_expired: str = ""          # the day on which leave for its loosened band ended


def row(case, metric, accepted, standing=Standing()):
    """Row of a metric of result.json. `accepted`: its baseline.Accepted, or None."""
    name, verdict, unit = metric["name"], metric["verdict"], metric["unit"]
    value = metric["value"]
    finite = isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    said = {"case": case, "metric": name, "verdict": verdict, "unit": unit, "value": value if finite else None,
            "accepted_verdict": accepted.verdict if accepted else None, "accepted": accepted.value if accepted else None}
    reason = metric.get("reason", "")
    if verdict == "error" or not finite and verdict != "skipped":
        return Row(colour=RED, kind="error", why=reason or "no finite number", **said)
    if verdict == "fail" and (accepted is None or accepted.verdict != "fail"):
        return Row(colour=RED, kind="fail", why=reason or "outside its band", weight=_weight(metric, accepted, finite), **said)
    if accepted is None:
        return Row(colour=RED, kind="new", why="no baseline: nobody has accepted it yet", **said)
    if accepted.unit != unit:
        return Row(colour=RED, kind="lost", why=f"was in {accepted.unit!r}, is in {unit!r}", **{**said, "accepted": None})
    if verdict == "skipped":
        if accepted.verdict == "skipped":
            return Row(colour=GREEN, kind="skipped", why=reason, **said)
        return Row(colour=RED, kind="lost", why=f"skipped: {reason or 'no reason is given'}", **said)
    if accepted.value is None:
        return Row(colour=RED, kind="new", why="was skipped when the baseline was accepted", **said)
    if verdict == "known-gap" and not standing.gap:
        return Row(colour=RED, kind="gap", why="a known gap that the ledger does not record, or whose record has expired", **said)
    if is_looser(metric["band"], accepted.band):
        return Row(colour=RED, kind="band", why=f"band was {_words(accepted.band)}, is {_words(metric['band'])}; the ledger "
                   "does not say why", **said)
    if standing.band_expired:
        return Row(colour=RED, kind="band", why=f"leave for its loosened band ended on {standing.band_expired}", **said)

    reference = metric["reference"]
    moved = change(value, accepted, metric["norm"], reference["value"], reference["standard_uncertainty"])
    said |= {"change": moved.kind, "direction": moved.direction, "allowance": moved.allowance, "noise_measured": moved.measured,
             "weight": _weight(metric, accepted, finite)}
    if moved.kind == MOVED:
        if moved.direction == AWAY:
            return Row(colour=RED, kind="away", why="moved away from the truth", **said)
        if moved.direction == TOWARD:
            return Row(colour=YELLOW, kind="toward", why="moved toward the truth", **said)
        return Row(colour=YELLOW, kind="undecided", why=moved.why, **said)
    kind = "known" if verdict in ("known-gap", "fail") else {BITWISE: "bitwise", WITHIN: "within"}[moved.kind]
    return Row(colour=GREEN, kind=kind, why="", **said)


def _weight(metric, accepted, finite):
    """Size of a move for sorting: in half-widths of the band where it is closed, else relative to the accepted value."""
    if not finite:
        return math.inf
    if accepted is None or accepted.value is None:
        return 0.0
    moved = abs(metric["value"] - accepted.value)
    if "relative" in metric["norm"] and metric["norm"].split()[-1:] != ["value"]:
        moved = moved / abs(metric["reference"]["value"]) if metric["reference"]["value"] else moved
    low, high = metric["band"] or (None, None)
    if low is not None and high is not None and high > low:
        return moved / (0.5 * (high - low))
    return abs(metric["value"] - accepted.value) / abs(accepted.value) if accepted.value else (math.inf if moved else 0.0)


def is_looser(band, than):
    """Whether `band` lets something through that `than` stops; None is no gate at all, a None end is open."""
    if than is None:
        return False
    if band is None:
        return True
    low = -math.inf if band[0] is None else band[0]
    high = math.inf if band[1] is None else band[1]
    return low < (-math.inf if than[0] is None else than[0]) or high > (math.inf if than[1] is None else than[1])


def _words(band):
    if band is None:
        return "no gate"
    return "[{}, {}]".format(*("open" if end is None else f"{end:g}" for end in band))


def order(rows):
    """Worst first."""
    return sorted(rows, key=lambda r: ({RED: 0, YELLOW: 1, GREEN: 2}[r.colour], KINDS.index(r.kind), -r.weight, r.case, r.metric))
