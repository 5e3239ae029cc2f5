"""What it would take for soil to break the paper's tool: runs that are stored in reference/studies.json with the commit and the day
of each, because none of them fits into a night. `python3 -m reports.studies STUDY RUNDIR...` stores the tillage results of runs."""

import argparse
import datetime
import json
import math
import sys
import tomllib
from pathlib import Path

from reports.results import ReportError, read_json

FILE = Path(__file__).resolve().parent.parent / "reference" / "studies.json"
STUDIES = {
    "cohesion": "Soil: how cohesive it must be",
    "overlap": "A fixed stone of 4 mm radius: how far it must stand in the tool's way",
    "across": "Resolution of the fracture: particles across the tool",
}
METRICS = ("plastic_strain", "greatest_moment", "yield_time", "fracture_time", "fracture_deflection", "peak_force", "last_over_peak",
           "greatest_deflection", "failed_particles")
UNITS = {"MPa": 1e6, "kPa": 1e3, "Pa": 1.0, "mm": 1e-3, "m": 1.0, "m/s": 1.0}


def hinge(yield_stress, thickness):
    """Moments per width (N) of a plate in plane strain that yields at its outer fibre, and that has become a hinge."""
    limit = 2.0 / math.sqrt(3.0) * yield_stress * thickness**2 / 4.0
    return limit / 1.5, limit


def _si(quantity):
    return quantity["value"] * UNITS[quantity["unit"]]


def entry(study, result):
    """What is kept of a result: inputs of the study, metrics, where it comes from."""
    p = result["parameters"]
    tool = p["tool"]
    row = {"study": study, "case": result["case"], "speed": _si(p["speed"]), "travel": _si(p["travel"]),
           "free_length": _si(tool["free_length"]), "across": tool["across"], "tool": tool["material"],
           "friction": p.get("friction", 0.0), "cohesion": _cohesion(p),
           "overlap": _si(p["stone"]["overlap"]) if "stone" in p else None,
           "verdict": result["verdict"], "cpu": result["cost"]["cpu_s"], "commit": result["provenance"]["commit"],
           "dirty": result["provenance"]["dirty"],
           "date": result["provenance"]["started"][:10], "metrics": {}}
    for m in result["metrics"]:
        if m["name"] in METRICS and m.get("value") is not None:
            row["metrics"][m["name"]] = {"value": m["value"], "unit": m["unit"]}
    return row


def _cohesion(parameters):
    for change in parameters.get("material_set", []):
        path, _, value = change.partition("=")
        if path.strip() == "strength.cohesion":
            return _si(tomllib.loads(f"c = {value}")["c"])
    file = FILE.parent / "materials" / f"{parameters['material']}.toml"
    return _si(tomllib.loads(file.read_text(encoding="utf-8"))["strength"]["cohesion"])


def _key(row):
    return (row["study"], row["case"], row["cohesion"] or 0.0, row["overlap"] or 0.0, row["across"], row["free_length"], row["tool"],
            row["friction"], row["travel"])


def load(file=None):
    """Stored runs, in the order of their study and inputs; none where there is no file."""
    try:
        data = read_json(file or FILE)
    except FileNotFoundError:
        return []
    if data.get("schema") != 1:
        raise ReportError(f"{file or FILE}: not a record of studies of schema 1")
    return sorted(data["runs"], key=_key)


def store(study, folders, file=None):
    """Adds results of run folders; a run with the same inputs takes the place of the earlier one. Returns how many."""
    rows = {_key(row): row for row in load(file)}
    found = 0
    for folder in folders:
        for path in sorted(Path(folder).glob("tillage/*/result.json")):
            result = read_json(path)
            if result["verdict"] == "error":
                raise ReportError(f"{path}: the run ended as error and says nothing")
            row = entry(study, result)
            rows[_key(row)] = row
            found += 1
    if not found:
        raise ReportError(f"no result of the family tillage below {', '.join(map(str, folders))}")
    text = json.dumps({"schema": 1, "runs": sorted(rows.values(), key=_key)}, indent=1)
    (file or FILE).write_text(text + "\n", encoding="utf-8")
    return found


def _number(row, name):
    metric = row["metrics"].get(name)
    return metric["value"] if metric else None


def yields(row):
    return (_number(row, "plastic_strain") or 0.0) > 0.0


def breaks(row):
    return (_number(row, "failed_particles") or 0.0) > 0.0


def threshold(rows, by, happens):
    """(largest input at which it does not happen, smallest at which it does), either None; None both where inputs cross."""
    no, yes = [r[by] for r in rows if not happens(r)], [r[by] for r in rows if happens(r)]
    low, high = max(no, default=None), min(yes, default=None)
    return (low, high) if low is None or high is None or low < high else (None, None)


LADDER = ("yield_time", "fracture_time", "fracture_deflection", "peak_force")   # whose uncertainty the page gives


def numerical_uncertainty(across, values):
    """(uncertainty relative to the finest value, order) of values at so many particles across, coarse to fine; order None where
    none can be had. Three values that converge steadily: Roache's grid convergence index with a safety factor of 1.25 for an
    observed order of 0.5 to 2.1, and 3 up to an order of 4. Else three times their range, as for all ladders here (Eca & Hoekstra,
    J. Comput. Phys. 262 (2014) 104-130); None for less than two values."""
    if len(values) < 2:
        return None, None
    fallback = 3.0 * (max(values) - min(values)) / abs(values[-1])
    if len(values) != 3 or (values[1] - values[0]) * (values[2] - values[1]) <= 0.0:
        return fallback, None
    h1, h2, h3 = (1.0 / n for n in across)
    ratio = (values[1] - values[0]) / (values[2] - values[1])

    def off(p):
        return (h1**p - h2**p) / (h2**p - h3**p) - ratio   # grows with p
    low, high = 0.5, 4.0
    if off(low) > 0.0 or off(high) < 0.0:
        return fallback, None
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if off(middle) < 0.0 else (low, middle)
    left = abs(values[2] - values[1]) * h3**low / (h2**low - h3**low)   # from the finest to the limit
    return (1.25 if low <= 2.1 else 3.0) * left / abs(values[2]), low


def ladders(rows):
    """For each case with two resolutions or more: name -> (finest value, unit, relative uncertainty, order)."""
    cases = {}
    for r in rows:
        cases.setdefault(r["case"].split("-across-")[0], []).append(r)
    found = []
    for case, own in cases.items():
        own.sort(key=lambda r: r["across"])
        numbers = {}
        for name in LADDER:
            known = [(r["across"], r["metrics"][name]) for r in own if name in r["metrics"]]
            share, order = numerical_uncertainty([n for n, _ in known], [m["value"] for _, m in known])
            if share is not None:
                numbers[name] = (known[-1][1]["value"], known[-1][1]["unit"], share, order)
        if numbers:
            found.append({"case": case, "across": [r["across"] for r in own], "numbers": numbers})
    return found


def page(rows, today=None):
    """What the page shows: a group a study, its rows with their age, and for the first two their thresholds."""
    today = today or datetime.date.today()
    groups = []
    for name, title in STUDIES.items():
        own = [dict(r, age=(today - datetime.date.fromisoformat(r["date"])).days) for r in rows if r["study"] == name]
        if not own:
            continue
        by = name if name != "across" else None
        same = {}
        for r in own:
            same.setdefault((r["tool"], r["free_length"], r["friction"]), []).append(r)
        limits = [{"tool": key[0], "free_length": key[1], "friction": key[2],
                   "yields": threshold(of, by, yields), "breaks": threshold(of, by, breaks)}
                  for key, of in same.items()] if by else []
        groups.append({"name": name, "title": title, "rows": own, "limits": limits,
                       "ladders": ladders(own) if name == "across" else []})
    return groups


def main():
    parser = argparse.ArgumentParser(prog="python3 -m reports.studies", description=__doc__)
    parser.add_argument("study", choices=STUDIES)
    parser.add_argument("runs", type=Path, nargs="+", metavar="RUNDIR")
    arguments = parser.parse_args()
    try:
        print(f"{store(arguments.study, arguments.runs)} stored in {FILE}")
    except (ReportError, OSError, KeyError) as error:
        print(f"reports.studies: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
