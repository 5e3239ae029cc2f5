"""The ledger: who accepted what, when, at which commit, and why. One line of JSON an entry, never changed, only added to.

Kinds: `value` (a blessing of a case), `noise` (a measurement of noise), and the concessions `band` (a band was loosened) and
`known-gap` (a red is let through). A concession has an expiry; from that day on it is red until somebody records it anew, or
until the band is as tight as before and the gap is gone: that is seen in the results and needs no entry.
"""

import datetime
import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

from gate.baseline import FOLDER
from gate.files import ROOT, GateError, append_line
from gate.rules import Standing, is_looser

CONCESSIONS = ("band", "known-gap")
LEAVE = datetime.timedelta(days=183)   # of a concession whose expiry nobody states: half a year


@dataclass(frozen=True)
class Concession:
    kind: str
    case: str
    metric: str
    reason: str
    who: str
    date: str
    expires: str
    expired: bool


def path_in(folder=FOLDER):
    return Path(folder) / "ledger.jsonl"


def read(folder=FOLDER):
    """Entries in their order. GateError names the line that cannot be read."""
    path = path_in(folder)
    if not path.exists():
        return []
    entries = []
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
        if not line.strip():
            continue
        try:
            entry = json.loads(line)
            if not {"kind", "date", "who", "commit", "reason"} <= entry.keys():
                raise ValueError
            if entry["kind"] in CONCESSIONS:
                datetime.date.fromisoformat(entry["expires"])
        except (ValueError, AttributeError, KeyError, TypeError):
            raise GateError(f"{path}:{number}: no entry of the ledger. It is broken; 'git checkout -- {path}' brings back the "
                            "committed one") from None
        entries.append(entry)
    return entries


def add(entry, folder=FOLDER):
    append_line(path_in(folder), json.dumps(entry, ensure_ascii=False, allow_nan=False))


def entry(kind, who, commit, reason, **more):
    now = datetime.datetime.now(datetime.timezone.utc)
    return {"date": now.strftime("%Y-%m-%dT%H:%M:%SZ"), "kind": kind, "who": who, "commit": commit, "reason": reason, **more}


def who():
    """Name and address as git knows them; GateError when it knows none: an entry has an author."""
    def asked(key):
        return subprocess.run(["git", "-C", str(ROOT), "config", key], capture_output=True, text=True).stdout.strip()
    name, address = asked("user.name"), asked("user.email")
    if not name:
        raise GateError("git knows no user.name, and the ledger wants to know who accepts: git config user.name \"...\"")
    return f"{name} <{address}>" if address else name


def _last(entries):
    return {(e["kind"], e["case"], e["metric"]): e for e in entries if e["kind"] in CONCESSIONS}


def _holds(entry, metric):
    """Whether what the entry concedes is still made use of by this metric of a result."""
    if entry["kind"] == "known-gap":
        return metric["verdict"] == "known-gap"
    return is_looser(metric["band"], entry["before"])


def standing(entries, case, metric, today):
    """rules.Standing of a metric of result.json."""
    last = _last(entries)
    gap = last.get(("known-gap", case, metric["name"]))
    band = last.get(("band", case, metric["name"]))
    return Standing(gap is not None and today.isoformat() < gap["expires"],
                    band["expires"] if band and _holds(band, metric) and today.isoformat() >= band["expires"] else "")


def concessions(entries, results, today):
    """Every concession that the results (parsed result files) make use of, the first to expire first."""
    metrics = {(r["case"], m["name"]): m for r in results for m in r.get("metrics", [])}
    found = [Concession(kind, case, name, e["reason"], e["who"], e["date"][:10], e["expires"], today.isoformat() >= e["expires"])
             for (kind, case, name), e in _last(entries).items() if (case, name) in metrics and _holds(e, metrics[case, name])]
    return sorted(found, key=lambda c: (c.expires, c.case, c.metric))
