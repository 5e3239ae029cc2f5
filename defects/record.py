"""What is known of each defect: reference/kills.json, a line a defect, with the commit and the day at which it was planted. A hunt
adds what it found; what it did not run stays as it was found last."""

import datetime
import json
import math
from dataclasses import asdict, dataclass, field, fields

from gate.compare import TIERS
from gate.files import ROOT, GateError, read_json, write_whole

FILE = ROOT / "reference" / "kills.json"


@dataclass
class Entry:
    """One defect as it was planted last. `wrong` to `equivalent` are its head's, so that a page needs no patch."""
    state: str                # as of kills.Fate
    tier: str                 # that killed it, or the largest that ran; "" of an error
    case: str                 # that killed it first, and the metric that was worst there, why, and how far it moved
    metric: str
    kind: str
    moved: float | str | None
    smoke: float | str | None   # largest move of a smoke metric (kills.size_of); None where none moved
    ran: int                  # cases that ran until then
    kinds: dict = field(default_factory=dict)   # of a right change: how many metrics were bitwise, within, ...
    hash: str = ""            # of the patch
    commit: str = ""
    date: str = ""
    wrong: str = ""
    modules: tuple = ()
    subtle: bool = False
    source: str = ""
    equivalent: str = ""


def read(path=FILE):
    """name -> Entry; empty where there is no record. GateError when it cannot be read."""
    if not path.exists():
        return {}
    try:
        data = read_json(path)
        if data["schema"] != 1:
            raise ValueError(f"schema {data['schema']!r}")
        known = {f.name for f in fields(Entry)}
        return {name: Entry(**{k: v for k, v in entry.items() if k in known}) for name, entry in data["defects"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise GateError(f"{path}: not a record of planted defects: {error}; 'git checkout {path}' brings the last one back") from None


def write(entries, path=FILE):
    lines = [f"  {json.dumps(name)}: {json.dumps(asdict(entry), allow_nan=False)}" for name, entry in sorted(entries.items())]
    write_whole(path, '{\n "schema": 1,\n "defects": {\n' + ",\n".join(lines) + "\n }\n}\n")


def entry_of(fate, defect, tiers):
    """Entry of a fate that was just found with these tiers."""
    by = {"killed": "truth", "changed": "change"}.get(fate.state)
    killer = next((k for k in fate.seen if k.by == by and by and k.tier == fate.tier), None)
    return Entry(
        state=fate.state, tier="" if fate.state == "error" else fate.tier or tiers[-1],
        case=killer.case if killer else "", metric=killer.metric if killer else "",
        kind=killer.kind if killer else fate.reason, moved=finite(killer.moved if killer else None),
        smoke=finite(fate.largest_smoke_move), ran=len(fate.seen),
        kinds=fate.kinds if defect.right else {}, hash=fate.hash, commit=fate.commit, date=datetime.date.today().isoformat(),
        wrong=defect.wrong, modules=defect.modules, subtle=defect.subtle, source=defect.source, equivalent=defect.equivalent)


def finite(x):
    return None if x is None else x if math.isfinite(x) else "infinite"


def is_dead(entry, defect, tier):
    """Whether the record says that this very patch is killed by the truth at `tier` or below."""
    return (entry is not None and entry.hash == defect.hash and entry.state == "killed"
            and TIERS.index(entry.tier) <= TIERS.index(tier))


def merged(known, found, defects, tiers):
    """`known` with what a hunt with these tiers found (fates); entries of defects that are no more are left out. A survivor of a
    small tier does not take the place of what a larger one said of the same patch."""
    patches = {d.name: d for d in defects}
    result = {name: entry for name, entry in known.items() if name in patches}
    for fate in found:
        entry, before = entry_of(fate, patches[fate.name], tiers), result.get(fate.name)
        larger = (before is not None and before.hash == entry.hash and before.state in ("killed", "changed", "survived")
                  and entry.state in ("changed", "survived") and TIERS.index(before.tier) > TIERS.index(tiers[-1]))
        if not larger:
            result[fate.name] = entry
    return result
