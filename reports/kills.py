"""Planted defects as pages: the kill matrix of one hunt (reads DIR/kills.json, writes DIR/page/), and in every report what is known
of each defect since it was planted last (reads reference/kills.json)."""

import datetime
import hashlib
import shutil
from dataclasses import dataclass, field
from pathlib import Path

import jinja2

from reports import numbers
from reports.results import ReportError, read_json

HERE = Path(__file__).resolve().parent
RECORD = HERE.parent / "reference" / "kills.json"
PATCHES = HERE.parent / "tests" / "defects"
TIERS = ("smoke", "quick", "nightly", "full")
ALIVE = ("changed", "survived")
WORDS = {"killed": "killed", "changed": "change alone", "survived": "survived", "equivalent": "equivalent",
         "passed": "right, passed", "error": "error"}
COLOURS = {"killed": "green", "changed": "yellow", "survived": "red", "equivalent": "", "passed": "green", "error": "red"}


def build(folder):
    """Writes the page and returns its path. ReportError when there is no kill matrix."""
    folder = Path(folder)
    try:
        data = read_json(folder / "kills.json")
        defects, tiers = data["defects"], data["tiers"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ReportError(f"{folder}: no kill matrix: {error}") from None
    page = folder / "page"
    page.mkdir(exist_ok=True)
    shutil.copytree(HERE / "assets", page / "assets", dirs_exist_ok=True)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE / "templates"), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    cases = sorted({k["case"] for d in defects for k in d["seen"] if k["by"]})
    order = {"error": 0, "survived": 1, "changed": 2, "killed": 3, "equivalent": 4, "passed": 5}
    (page / "index.html").write_text(environment.get_template("kills.html").render(
        defects=sorted(defects, key=lambda d: (order[d["state"]], d["modules"], d["name"])), tiers=tiers, rates=data["rates"],
        commit=data["commit"],
        cases=cases, words=WORDS, colours=COLOURS, moved=moved, number=numbers.number, root=""), encoding="utf-8")
    return page / "index.html"


def moved(x):
    """A relative move in words."""
    if x is None:
        return ""
    return "no number" if x == "infinite" else f"{numbers.number(100.0 * x, 2)}\u202f%"


@dataclass(frozen=True)
class Rate:
    """How many of the defects a tier kills, as far as it was run."""
    killed: int    # by the truth
    seen: int      # at all
    planted: int
    ran: int       # how many met the cases of this very tier: the others had been killed below it, or wait
    waiting: int   # alive, and not run at this tier

    @property
    def known(self):
        """Whether anything is known of the tier that the one below it has not said."""
        return self.ran > 0 or self.waiting == 0

    def words(self, n):
        """`n` defects as a share of those planted; a bound where some that are alive were not run."""
        if not self.known or not self.planted:
            return "not run"
        return f"{'at least ' if self.waiting else ''}{n}, {numbers.number(100.0 * n / self.planted, 3)} %"


@dataclass
class Record:
    """What is known of the defects that stand in the repository now."""
    entries: list = field(default_factory=list)    # of reference/kills.json with name, stale (the patch is another now) and age
    unknown: list = field(default_factory=list)    # names of patches that were never planted
    fault: str = ""

    def __bool__(self):
        return bool(self.entries)

    @property
    def wrong(self):
        """Entries of defects that can be caught, whose patch is the one that was planted."""
        return [e for e in self.entries if e["state"] in ("killed", *ALIVE) and not e["stale"]]

    @property
    def right(self):
        return [e for e in self.entries if e["state"] == "passed" or e["kinds"]]

    def rate(self, tier):
        """Rate at this tier and those below it, which it contains."""
        def within(e):
            return TIERS.index(e["tier"]) <= TIERS.index(tier)
        killed = [e for e in self.wrong if e["state"] == "killed" and within(e)]
        changed = [e for e in self.wrong if e["state"] == "changed" and within(e)]
        alive = [e for e in self.wrong if TIERS.index(e["tier"]) >= TIERS.index(tier)]
        waiting = [e for e in self.wrong if e["state"] in ALIVE and TIERS.index(e["tier"]) < TIERS.index(tier)]
        return Rate(len(killed), len(killed) + len(changed), len(self.wrong), len(alive), len(waiting))

    @property
    def alive(self):
        return [e for e in self.wrong if e["state"] in ALIVE]


def hash_of(patch):
    """Of the difference alone, which comes after the head and an empty line."""
    return hashlib.sha256(patch.partition("\n\n")[2].encode()).hexdigest()


def load(file=RECORD, folder=PATCHES, today=None):
    """Record of a repository; empty without a file, with `fault` where it cannot be read."""
    if not file.exists():
        return Record()
    try:
        data = read_json(file)["defects"]
        today = today or datetime.date.today()
        hashes = {p.stem: hash_of(p.read_text(encoding="utf-8")) for p in sorted(folder.glob("*.patch"))}
        entries = [entry | {"name": name, "stale": hashes[name] != entry["hash"],
                            "age": (today - datetime.date.fromisoformat(entry["date"])).days}
                   for name, entry in data.items() if name in hashes]
        order = {"error": 0, "survived": 1, "changed": 2, "killed": 3, "equivalent": 4, "passed": 5}
        entries.sort(key=lambda e: (order[e["state"]], -TIERS.index(e["tier"]) if e["tier"] else 0, e["modules"], e["name"]))
        return Record(entries, [n for n in hashes if n not in data])
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        return Record(fault=f"{file.name}: {error}")
