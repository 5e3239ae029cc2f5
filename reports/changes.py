"""What the gate wrote about a run: how each metric moved since the accepted baseline. Read from RUN/gate/; a run that nobody
compared has none of it."""

from dataclasses import dataclass, field

from reports import numbers
from reports.results import read_json

WORDS = {"bitwise": "the same bits", "within": "within noise", "toward": "toward the truth", "away": "away from the truth",
         "undecided": "moved, undecided", "error": "no number", "fail": "fails now", "new": "new", "lost": "lost",
         "gap": "gap without record", "band": "looser band", "known": "as accepted", "skipped": "skipped"}


@dataclass
class Changes:
    rows: list = field(default_factory=list)         # rows of gate.json, worst first
    colour: str = ""
    blame: list = field(default_factory=list)
    concessions: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    curves: dict = field(default_factory=dict)       # case -> {commit, date, figures}
    fault: str = ""

    def __post_init__(self):
        self._by_metric = {(r["case"], r["metric"]): r for r in self.rows}

    def __bool__(self):
        return bool(self.rows)

    def of(self, case, metric):
        return self._by_metric.get((case, metric))

    def count(self, **wanted):
        return sum(1 for r in self.rows if all(r[k] == v for k, v in wanted.items()))

    @property
    def moved(self):
        """Rows that are not green, worst first."""
        return [r for r in self.rows if r["colour"] != "green"]


def load(folder):
    """Changes of a run folder; empty where there was no comparison, with `fault` where its file cannot be read."""
    path = folder / "gate" / "gate.json"
    if not path.exists():
        return Changes()
    try:
        data = read_json(path)
        curves = folder / "gate" / "curves.json"
        return Changes(data["rows"], data["colour"], data["blame"], data["concessions"], data["notes"],
                       read_json(curves) if curves.exists() else {})
    except (ValueError, KeyError, TypeError, OSError) as error:
        return Changes(fault=f"gate.json: {error}")


def words(row):
    return WORDS.get(row["kind"], row["kind"])


def part(row):
    """Change over the accepted value, in percent with its sign; '' where there is none."""
    if row["change"] in (None, "bitwise") or not row["accepted"] or row["value"] is None:
        return ""
    relative = (row["value"] - row["accepted"]) / abs(row["accepted"])
    return f"{'+' if relative > 0.0 else ''}{numbers.number(100.0 * relative, 2)}\u202f%"


def overlaid(figure, accepted):
    """A figure of kind lines with the accepted curves under the computed ones. `accepted`: Changes.curves of the case, or
    None."""
    curves = (accepted or {}).get("figures", {}).get(figure["name"], {})
    old = [{"label": f"{s['label']}, accepted {accepted['commit'][:8]}", "role": "accepted", **curves[s["label"]]}
           for s in figure["series"] if s["role"] == "computed" and s["label"] in curves]
    return {**figure, "series": [*figure["series"], *old]} if old else figure
