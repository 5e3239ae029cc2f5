"""Who killed a defect: each metric of a spoilt run against the clean one, by the rules of the gate."""

import collections
import math
from dataclasses import asdict, dataclass, field

from gate import rules
from gate.bless import accepted_of

# By the truth: a metric left its band or gave no number, which needs no baseline. By the change: it moved away from the truth,
# and only somebody who knows the number from before can see it.
TRUTH, CHANGE = ("error", "fail", "lost"), ("away", "gap", "band", "new")


@dataclass
class Kill:
    """What a case saw of a defect: its worst metric."""
    case: str
    tier: str
    metric: str
    kind: str
    by: str               # truth, change or '' for a case that moved without being red, or not at all
    moved: float | None   # its largest move (size_of); None where nothing moved
    kinds: dict = field(default_factory=dict)   # how many metrics are of which kind


@dataclass
class Fate:
    """What became of a defect."""
    name: str
    state: str                # killed, changed (only the change detector saw it), survived, equivalent, passed (right), error
    reason: str = ""          # of an error
    tier: str = ""            # smallest tier that killed it by the truth, or by the change
    hash: str = ""
    commit: str = ""
    looked: str = ""          # largest tier that was asked for
    largest_smoke_move: float | None = None   # of any metric of the smoke tier (size_of); None where none moved
    seen: list = field(default_factory=list)  # Kill of each case that ran
    seconds: float = 0.0      # wall time, building and running

    @property
    def kinds(self):
        """How many metrics of all cases that ran are of which kind."""
        return dict(sum((collections.Counter(k.kinds) for k in self.seen), collections.Counter()))


def seen(clean, spoilt, tier, noise=None):
    """Kill of one case; `clean`, `spoilt`: reports.results.Case; `noise`: the case's Baseline, for measured spreads, or None."""
    rows = _rows(clean, spoilt, noise)
    worst = rules.order(rows)[0]
    by = "truth" if worst.kind in TRUTH else "change" if worst.kind in CHANGE else ""
    metrics = {m["name"]: m for m, _ in spoilt.metrics} if spoilt else {}
    kinds = dict(collections.Counter(r.kind for r in rows))
    return Kill(clean.id, tier, worst.metric, worst.kind, by, largest_move(rows, metrics), kinds)


def _rows(clean, spoilt, noise):
    if spoilt is None or spoilt.faults or not spoilt.data.get("metrics"):
        return [rules.Row(clean.id, "", rules.RED, "error", spoilt.reason if spoilt else "it did not run", "error")]
    known = noise.metrics if noise else {}
    accepted = {m["name"]: accepted_of(m, known.get(m["name"])) for m, _ in clean.metrics}
    rows = []
    for metric, _ in spoilt.metrics:
        before = accepted.get(metric["name"])
        if before is not None and before.verdict in ("fail", "error"):
            continue   # red on the clean tree: it proves nothing
        rows.append(rules.row(clean.id, metric, before, rules.Standing(gap=before is not None and before.verdict == "known-gap")))
    measured = {m["name"] for m, _ in spoilt.metrics}
    rows += [rules.lost(clean.id, name, m, "not measured") for name, m in accepted.items() if name not in measured]
    return rows or [rules.Row(clean.id, "", rules.GREEN, "skipped", "nothing of the clean case is green")]


def largest_move(rows, metrics):
    """Size of the largest move that is not round-off; infinite where a number is gone; None where nothing moved. `metrics`: those
    of the spoilt run by name."""
    if any(r.kind in ("error", "lost") for r in rows):
        return math.inf
    return max((size_of(r, metrics[r.metric]) for r in rows if r.change == "moved" or r.kind == "fail"), default=None)


def size_of(row, metric):
    """A move as a share of the truth. Where that is zero a number without a unit is a share already, of an energy or a field; one
    with a unit has its clean value alone to be held against."""
    if row.value is None or row.accepted is None:
        return math.inf
    whole = abs(metric["reference"]["value"] or 0.0) or (1.0 if row.unit == "1" else abs(row.accepted))
    return abs(row.value - row.accepted) / whole if whole else math.inf


def fate(defect, kills, tiers, commit):
    """Fate from what each case saw, tier by tier."""
    result = Fate(defect.name, "survived", hash=defect.hash, commit=commit, looked=tiers[-1], seen=kills)
    for by, state in (("truth", "killed"), ("change", "changed")):
        found = [t for t in tiers if any(k.tier == t and k.by == by for k in kills)]
        if found:
            result.state, result.tier = state, found[0]
            break
    smoke = [k.moved for k in kills if k.tier == "smoke" and k.moved is not None]
    result.largest_smoke_move = max(smoke, default=None)
    if defect.right:
        red = [k for k in kills if k.by]
        result.state = "error" if red else "passed"
        result.reason = f"a right change is red: {red[0].case} {red[0].metric} {red[0].kind}" if red else ""
        result.tier = ""
    elif defect.equivalent:
        if any(k.by or k.moved for k in kills):
            result.state, result.reason = "error", "said to be equivalent, and moves numbers"
        else:
            result.state = "equivalent"
    if not kills:   # a larger tier may have one; when there is none, that is an error
        result.state = "error" if set(tiers) & {"nightly", "full"} else "survived"
        result.reason = f"no case exercises {' or '.join(defect.modules)}"
    return result


def rates(fates, tiers):
    """tier -> (killed by the truth, seen at all, defects that can be killed) counting each tier with those below it."""
    alive = [f for f in fates if f.state in ("killed", "changed", "survived")]
    rank = {t: i for i, t in enumerate(tiers)}

    def first(f, kinds):
        return min((rank[k.tier] for k in f.seen if k.by in kinds), default=len(tiers))
    return {t: (sum(first(f, ("truth",)) <= i for f in alive), sum(first(f, ("truth", "change")) <= i for f in alive), len(alive))
            for t, i in rank.items()}


def to_json(fate):
    data = asdict(fate)
    for entry in (data, *data["seen"]):
        for key in ("moved", "largest_smoke_move"):
            if entry.get(key) is not None and not math.isfinite(entry[key]):
                entry[key] = "infinite"
    return data


def from_json(data):
    def number(x):
        return math.inf if x == "infinite" else x
    kills = [Kill(**{**k, "moved": number(k["moved"])}) for k in data["seen"]]
    return Fate(**{**data, "seen": kills, "largest_smoke_move": number(data["largest_smoke_move"])})
