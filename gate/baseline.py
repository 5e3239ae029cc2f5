"""Baselines: what was accepted of a case, one file a case in reference/baselines/<family>/<case>.json.

A line a metric, so that a difference of two commits reads as a list of what moved. Numbers are the shortest decimals that give
the same bits again, so that equality can be asked. Beside values stand what a change is judged by: reference and its uncertainty,
band, the spread that was measured without a cause (noise) and from how many runs; and a few points of each curve, for the eye
alone.
"""

import json
import math
from dataclasses import asdict, dataclass, field
from pathlib import Path

from gate.files import ROOT, GateError, read_json, write_whole

FOLDER = ROOT / "reference" / "baselines"
SCHEMA = 1


@dataclass
class Accepted:
    """One metric as it was accepted."""
    value: float | None            # None for a metric that was skipped
    unit: str
    verdict: str                   # pass, known-gap, reported, skipped
    reference: float | None
    uncertainty: float | None      # standard, of the reference
    band: list | None
    spread: float | None = None    # largest less smallest value of the runs that measured noise; None: not measured
    runs: int = 0                  # how many these were
    reference_spread: float | None = None   # the same of a reference that is computed at run time


@dataclass
class Baseline:
    case: str
    tier: str
    commit: str
    date: str
    inputs: str                    # fingerprint of the instance and the files that it reads
    metrics: dict                  # name -> Accepted
    exercises: list = field(default_factory=list)
    curves: dict = field(default_factory=dict)   # figure -> {series -> {x, y}}


def path_of(case, folder=FOLDER):
    return Path(folder) / f"{case}.json"


def text_of(baseline):
    """The file's text: JSON with a line for each metric and each curve."""
    head = {k: getattr(baseline, k) for k in ("case", "tier", "commit", "date", "inputs", "exercises")}
    lines = [f' "schema": {SCHEMA},'] + [f" {json.dumps(k)}: {json.dumps(v)}," for k, v in head.items()]
    lines.append(' "metrics": {')
    lines += _joined(f"  {json.dumps(name)}: {json.dumps(asdict(m), allow_nan=False)}"
                     for name, m in sorted(baseline.metrics.items()))
    lines.append(' },')
    lines.append(' "curves": {')
    lines += _joined(f"  {json.dumps(figure)}: {{\n" + "\n".join(_joined(f"   {json.dumps(label)}: {json.dumps(points)}"
                                                                     for label, points in series.items())) + "\n  }"
                     for figure, series in baseline.curves.items())
    return "\n".join(["{", *lines, " }", "}"]) + "\n"


def _joined(lines):
    lines = list(lines)
    return [line + "," for line in lines[:-1]] + lines[-1:]


def write(baseline, folder=FOLDER):
    write_whole(path_of(baseline.case, folder), text_of(baseline))


def _number(x, place, none=True):
    if none and x is None:
        return
    if isinstance(x, bool) or not isinstance(x, (int, float)) or not math.isfinite(x):
        raise ValueError(f"{place} is {x!r}, no finite number")


def parse(data, case):
    """Baseline of parsed JSON; ValueError with one sentence when it is not one."""
    if not isinstance(data, dict) or data.get("schema") != SCHEMA:
        raise ValueError(f"no baseline of schema {SCHEMA}")
    if data.get("case") != case:
        raise ValueError(f"says that it is of {data.get('case')!r}")
    metrics = {}
    try:
        for name, entry in data["metrics"].items():
            accepted = Accepted(**entry)
            for key in ("value", "reference", "uncertainty", "spread", "reference_spread"):
                _number(getattr(accepted, key), f"{key} of {name}")
            if accepted.value is None and accepted.verdict != "skipped":
                raise ValueError(f"{name} has no value")
            if min(accepted.spread or 0.0, accepted.reference_spread or 0.0) < 0.0:
                raise ValueError(f"a spread of {name} is negative")
            metrics[name] = accepted
        return Baseline(case, data["tier"], data["commit"], data["date"], data["inputs"], metrics, data["exercises"],
                        data["curves"])
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"incomplete: {error}") from None


def read_all(folder=FOLDER):
    """case -> Baseline of every file. GateError names the first that cannot be used and how to get it back."""
    found = {}
    folder = Path(folder)
    for path in sorted(folder.rglob("*.json")):
        case = path.relative_to(folder).as_posix().removesuffix(".json")
        try:
            found[case] = parse(read_json(path), case)
        except ValueError as error:
            raise GateError(f"{path}: {error}. It is broken; 'git checkout -- {path}' brings back the accepted one") from None
        except OSError as error:
            raise GateError(f"{path}: cannot be read: {error.strerror}") from None
    return found
