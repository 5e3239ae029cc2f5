"""Synthetic runs: results as the runner writes them, with what a test is about set by hand."""

import copy
import datetime
import json

from gate.baseline import Accepted
from gate.bless import bless
from reports import results
from tests.reports.sample import PROVENANCE, metric, result

TODAY = datetime.date(2026, 11, 22)
CLEAN = {**PROVENANCE, "dirty": False, "commit": "a" * 40, "inputs": "0123", "particle_order": 0}


def accepted(value=1.0, reference=0.0, spread=None, unit="1", verdict="pass", uncertainty=0.0, band=(0.0, 2.0), runs=0):
    return Accepted(value, unit, verdict, reference, uncertainty, list(band) if band else None, spread, runs)


def case(name="kernel/one", metrics=None, verdict="pass", exercises=("schemes/momentum",), **more):
    provenance = {**CLEAN, **more.pop("provenance", {})}
    return result(name, verdict, [metric("norm", 1.0, [0.0, 2.0])] if metrics is None else metrics, exercises=list(exercises),
                  provenance=provenance, **more)


def run(folder, *cases, **run_json):
    """Writes a run folder and reads it as the gate does."""
    for data in cases:
        place = folder / data["case"]
        place.mkdir(parents=True, exist_ok=True)
        (place / "result.json").write_text(json.dumps(data))
    head = {"schema": 1, "cases": [c["case"] for c in cases], "provenance": {**CLEAN, **run_json.pop("provenance", {})},
            **run_json}
    (folder / "run.json").write_text(json.dumps(head))
    return results.load(folder)


def blessed(folder, *cases, baselines, reason="first", **options):
    return bless(run(folder, *cases), ["*"], reason, folder=baselines, who="A Tester <a@test>", **options)


def with_value(data, value, **changes):
    """The same case with another value of its first metric."""
    data = copy.deepcopy(data)
    data["metrics"][0] |= {"value": value, "error": value, **changes}
    return data
