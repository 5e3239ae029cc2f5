"""A run folder with one case of every kind the report must show. To look at one: python3 tests/reports/sample.py DIR [COPIES]."""

import copy
import json
import math
import sys
from pathlib import Path

import h5py
import numpy as np

PROVENANCE = {"commit": "4f1c2d9ab03e77aa51c0de4f1c2d9ab03e77aa51", "dirty": True, "compiler": "GNU 12.2.0",
              "flags": "-O3 -Wall -Wextra -march=native", "threads": 1, "cpu": "Example CPU @ 2.0 GHz",
              "packages": {"libgsl-dev": "2.7.1", "libeigen3-dev": "3.4.0"}, "started": "2026-01-31T14:05:00Z"}
COST = {"wall_s": 3.21, "cpu_s": 3.1, "steps": 1200, "particles": 4096, "particle_steps_per_s": 1.6e6, "peak_rss_bytes": 52428800}


def metric(name, value, band, verdict="pass", norm="absolute", unit="1", class_="exact", reference=0.0, uncertainty=0.0,
           source="closed form", error=None, symbol=None, **more):
    return {"name": name, "symbol": symbol or name[0].upper(), "unit": unit, "value": value, "class": class_,
            "reference": {"value": reference, "standard_uncertainty": uncertainty, "source": source},
            "error": value if error is None else error, "norm": norm, "band": band, "verdict": verdict, **more}


def ladder(state="asymptotic", order=1.98, stderr=0.03, h=1.2, scale=1.0, floor=0.0, **more):
    spacing = [0.04, 0.02, 0.01, 0.005, 0.0025]
    return {"h_over_dx": h, "kind": "error", "spacing": spacing, "value": [scale * (dx**2 + floor) for dx in spacing],
            "order": order, "order_stderr": stderr, "state": state, "gci": 0.004, "extrapolated": scale * floor, **more}


def result(case, verdict="pass", metrics=None, **more):
    return {"schema": 1, "case": case, "family": case.split("/")[0], "title": f"Title of {case}", "why": f"Why {case} is here.",
            "tier": "smoke", "verdict": verdict,
            "metrics": [metric("integral_error", 1.3e-12, [0, 1e-10])] if metrics is None else metrics,
            "cost": COST, "provenance": PROVENANCE, "exercises": ["smoothing/cubic_spline"], "files": {}, **more}


def lines_figure():
    x = [i / 60 for i in range(121)]
    kernel = [(1 - 1.5 * q * q + 0.75 * q**3) if q < 1 else 0.25 * (2 - q) ** 3 for q in x]
    return {"name": "profile", "title": "Kernel over distance", "caption": "The curve and its closed form.", "kind": "lines",
            "x": {"label": "r/h", "unit": "1"}, "y": {"label": "W/W(0)", "unit": "1"},
            "series": [{"label": "cubic spline", "role": "computed", "x": x, "y": kernel},
                       {"label": "closed form", "role": "reference", "x": x, "y": kernel}]}


def scatter_figure():
    return {"name": "length", "title": "Final length over impact speed", "kind": "points", "x": {"label": "speed", "unit": "m/s"},
            "y": {"label": "final length", "unit": "mm"},
            "series": [{"label": "furrow", "role": "computed", "x": [130, 146, 190], "y": [21.5, 20.1, 16.4]},
                       {"label": "Johnson & Cook", "role": "experiment", "x": [130, 146, 190], "y": [21.6, 20.3, 16.2],
                        "uncertainty": [0.1, 0.1, None]},
                       {"label": "other code", "role": "published", "x": [130, 190], "y": [21.9, 16.6]},
                       {"label": "rigid limit", "role": "bound", "x": [130, 190], "y": [23.0, 23.0]}]}


def particles_figure(n=20):
    x = [0.001 * (i % n) for i in range(n * n)]
    y = [0.001 * (i // n) for i in range(n * n)]
    return {"name": "particles", "title": "Jittered lattice", "caption": "Deviation of Σ V W from one.", "kind": "particles",
            "x": {"label": "x", "unit": "m"}, "y": {"label": "y", "unit": "m"}, "colour": {"label": "Σ V W − 1", "unit": "1"},
            "series": [{"label": "inside", "role": "computed", "x": x, "y": y,
                        "colour": [math.sin(900 * a) * math.cos(700 * b) for a, b in zip(x, y)]}]}


def write_history(path):
    with h5py.File(path, "w") as file:
        time = np.linspace(0.0, 8e-5, 400)
        for name, unit, values in (("time", "s", time), ("kinetic_energy", "J", 60 * np.exp(-time / 2e-5)),
                                   ("elastic_energy", "J", 9 * (1 - np.exp(-time / 2e-5))), ("length", "m", 0.0254 - 120 * time)):
            file.create_dataset(name, data=values).attrs["unit"] = unit
        file.attrs["columns"] = ["time", "length", "kinetic_energy", "elastic_energy"]


def write_snapshot(path, time, n=48):
    x, y = np.meshgrid(np.linspace(0, 0.0254, 3 * n), np.linspace(-0.0038, 0.0038, n))
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = (1, 0)
        root.create_dataset("Points", data=np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)]))
        data = root.create_group("PointData")
        strain = 1e4 * time * np.exp(-x.ravel() / 0.006) * (1 - 0.3 * (y.ravel() / 0.0038) ** 2)   # none at first
        data.create_dataset("plastic_strain", data=strain).attrs["unit"] = "1"
        data.create_dataset("velocity", data=np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()]) * -6e3).attrs["unit"] = "m/s"
        root.create_group("FieldData").create_dataset("time", data=[time]).attrs["unit"] = "s"


CITATION = {"key": "johnson-cook-1983", "doi": "10.1000/example",
            "text": "Johnson, G. R. & Cook, W. H. A constitutive model and data for metals subjected to large strains, high "
                    "strain rates and high temperatures. Proc. 7th Int. Symp. on Ballistics, 541–547 (1983)."}


def results():
    """case id -> result."""
    found = [
        result("kernel/cubic-spline-2d", title="Cubic spline, two dimensions",
               description="A kernel must integrate to one.\n\nHere it is done by quadrature.",
               metrics=[metric("integral_error", 1.3e-12, [0, 1e-10], symbol="|\u222bW dV - 1|",
                               band_why="round-off of the quadrature"),
                        metric("derivative_error", 4.2e-10, [0, 1e-9], norm="Linf relative", symbol="e_W'",
                               band_why="round-off of the quadrature"),
                        metric("smallest_value", 0.0, [0, None], norm="value", symbol="min W"),
                        metric("neighbours", 12.5, None, "reported", norm="value")],
               figures=[lines_figure()], notes=["The largest deviation lies at r/h = 1."],
               parameters={"kernel": "cubic_spline", "smoothing_length": {"value": 1.2, "unit": "mm"},
                           "ratios": [1.0, 1.2, 2.0]}),
        result("kernel/\u200bunicode".replace("\u200b", ""), title="Näherung für ∇W ≈ Σ V ∇W <b>&amp;</b> „Größe“ 勾配",
               why="Every sign a title may hold: <script>alert(1)</script> & \" '."),
        result("operators/gradient-sine", title="Gradient of a sine on a square lattice",
               description="The gradient of a smooth field.",
               metrics=[metric("gradient_error", 3.4e-3, [0, 0.01], norm="L2 relative", class_="manufactured", symbol="e_2",
                               ladders=[ladder(), ladder("plateau", 0.31, 0.2, 1.0, 2.0, 3e-4),
                                        ladder("oscillatory", None, None, 1.5)]),
                        metric("gradient_order", 1.98, [1.7, 2.3], norm="value", class_="manufactured", symbol="p",
                               at={"spacing": 0.001, "h_over_dx": 1.2},
                               reference=2.0, error=-0.02),
                        metric("sound_speed", 1002.0, [-0.01, 0.01], norm="relative", unit="m/s", reference=1000.0,
                               uncertainty=1.0, error=0.002,
                               class_="independent", symbol="c_0",
                               ladder={**ladder(kind="value", order=1.1), "value": [950.0, 985.0, 996.0, 1000.0, 1002.0],
                                       "extrapolated": 1003.0})],
               figures=[particles_figure()],
               tables=[{"name": "norms", "title": "Norms over h/Δx",
                        "columns": [{"label": "lattice", "unit": "1"}, {"label": "L2", "unit": "1/m"}],
                        "rows": [[f"lattice {i}", 10.0**-i] for i in range(1, 30)] + [["none", None]]}]),
        result("operators/failing", "fail", title="Momentum in the form that does not conserve it",
               reason="The error lies outside its band.",
               metrics=[metric("momentum_error", 2.4e-10, [0, 1e-12], "fail", symbol="|Σ m a|", unit="N"),
                        metric("order", 1.2, [1.7, 2.3], "fail", norm="value"),
                        metric("spin_error", 1e-15, [0, 1e-12])]),
        result("operators/diverged", "error", title="A case that produced NaN",
               reason="No finite number at step 311: velocity of particle 17.",
               metrics=[metric("energy_error", None, [0, 1e-3], "error", norm="relative")]),
        result("operators/edges", "known-gap", title="Free surface without correction",
               reason="Truncated support at the edge, shown by the ladder; recorded 2026-01-05, expires 2026-06-30.",
               metrics=[metric("edge_error", 0.21, [0, 0.05], "known-gap", norm="L2 relative")]),
        result("taylor-bar/copper-190", title="Copper bar at 190 m/s", tier="smoke", citations=[CITATION],
               description="A bar hits a rigid wall.", overrides=["speed=190 m/s"],
               metrics=[metric("final_length", 16.3, [-0.03, 0.03], norm="relative", unit="mm", class_="experiment",
                               reference=16.21, uncertainty=0.1, source="johnson-cook-1983", error=0.0056, symbol="L_f"),
                        metric("impact_stress", 1.2e9, None, "skipped", norm="value", unit="Pa",
                               reason="no probe at this resolution")],
               figures=[scatter_figure()], files={"history": "history.h5", "snapshots": ["first.vtkhdf", "last.vtkhdf"]}),
        result("column-collapse/unchanged", title="Own earlier result",
               metrics=[metric("run_out", 0.412, [-1e-12, 1e-12], norm="relative", unit="m", class_="self", reference=0.412,
                               error=0.0)]),
    ]
    return {r["case"]: r for r in found}


def write(folder, copies=0):
    """Writes the run; `copies` more of the richest cases make it as large as a real one. Returns the results by case id."""
    folder = Path(folder)
    cases = results()
    for i in range(copies):
        source = copy.deepcopy(cases[("operators/gradient-sine", "kernel/cubic-spline-2d")[i % 2]])
        source["case"] += f".{i}"
        if i % 2:
            source["figures"] = [{**lines_figure(), "name": f"profile-{k}"} for k in range(6)]
        cases[source["case"]] = source
    for case, data in cases.items():
        place = folder / case
        place.mkdir(parents=True, exist_ok=True)
        (place / "result.json").write_text(json.dumps(data, ensure_ascii=False), encoding="utf-8")
        if "history" in data["files"]:
            write_history(place / "history.h5")
        for i, name in enumerate(data["files"].get("snapshots", [])):
            write_snapshot(place / name, 8e-5 * i)
    run = {"schema": 1, "tier": "smoke", "cases": sorted(cases), "jobs": 2, "wall_s": 14.2, "cpu_s": 25.0,
           "provenance": PROVENANCE}
    (folder / "run.json").write_text(json.dumps(run), encoding="utf-8")
    return cases


if __name__ == "__main__":
    write(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 0)
