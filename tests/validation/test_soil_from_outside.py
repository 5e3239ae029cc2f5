"""A soil and a geometry from outside the repository run to a verdict; a soil or a geometry that cannot be is refused, by name."""

import json

import pytest

from tests.harness.program import FURROW, run

SOIL = """name = "Loess of a reader"
law = "drucker_prager"
density = { value = 1500, unit = "kg/m^3", source = "my-report" }
cone = "plane_strain"
[sources.my-report]
text = "A reader's own report"
[elasticity]
young_modulus = { value = 0.5, unit = "MPa", source = "my-report" }
poisson_ratio = { value = 0.3, unit = "1", source = "my-report" }
[strength]
friction_angle = { value = 28, unit = "deg", source = "my-report" }
cohesion = { value = 0, unit = "kPa", source = "my-report" }
dilation_angle = { value = 0, unit = "deg", source = "my-report" }
"""

CASE = """family = "column-collapse"
[sources.my-report]
text = "A reader's own report"
[[case]]
name = "my-heap"
problem = "granular_column"
title = "A heap of a reader"
why = "A soil that nobody here has seen."
description = "A column of 200 x 120 mm."
tier = "quick"
parameters = { material = "my-soil", left = { value = 0, unit = "mm" }, bottom = { value = 0, unit = "mm" }, width = { value = 200, unit = "mm" }, height = { value = 120, unit = "mm" }, floor_length = { value = 800, unit = "mm" }, end_time = { value = 0.9, unit = "s" }, scheme = { density = "constant", least_span = 0.1, viscosity = { alpha = 0.1, beta = 0 } } }
resolution = { spacing = { value = [20], unit = "mm" }, h_over_dx = [1.5] }
"""

METRICS = [("run_out", "[0.1, 3.0]"), ("run_out_between_laws", None), ("height", None), ("rest_time", None), ("late_motion", "[0.0, 0.01]"),
           ("volume_change", "[-0.01, 0.01]"), ("energy_imbalance", "[-0.02, 0.02]")]


def metric(name, band):
    gate = f'band = {band}\nband_why = "A reader\'s own."' if band else "reported = true"
    value = 'value = "computed", ' if name in ("run_out", "height") else ""
    return (f'[[case.metric]]\nname = "{name}"\nsymbol = "m"\nunit = "1"\nclass = "experiment"\nreference = {{ {value}source = "my-report" }}\n'
            f'norm = "value"\n{gate}\n')


@pytest.fixture
def outside(tmp_path):
    """Runs the case with one text of soil or case replaced."""
    def changed(old="", new=""):
        texts = {"my-soil.toml": SOIL, "case.toml": CASE + "".join(metric(*m) for m in METRICS)}
        assert not old or sum(text.count(old) for text in texts.values()) == 1
        for name, text in texts.items():
            (tmp_path / name).write_text(text.replace(old, new) if old else text)
        return run(FURROW, "run", "--case-file", tmp_path / "case.toml", "--no-report", "--replace", "--out", tmp_path / "run"), tmp_path
    return changed


def test_it_runs_to_a_verdict(outside):
    ended, folder = outside()
    assert ended.returncode == 0, ended.stdout + ended.stderr
    result = json.loads((folder / "run/column-collapse/my-heap/result.json").read_text())
    assert result["verdict"] == "pass"
    measured = {m["name"]: m["value"] for m in result["metrics"]}
    assert set(measured) == {name for name, _ in METRICS}
    assert 0.1 < measured["run_out"] < 3.0


def test_a_gate_holds_the_soil_until_it_is_gone(outside):
    def measured(gate):
        ended, folder = outside("end_time = {", f"{gate}end_time = {{")
        assert ended.returncode in (0, 1), ended.stdout + ended.stderr   # what it runs to is a reader's band, not this test's
        result = json.loads((folder / "run/column-collapse/my-heap/result.json").read_text())
        return {m["name"]: m["value"] for m in result["metrics"]}

    released = measured("")
    held = measured('gate_speed = { value = 1, unit = "mm/s" }, ')
    lifted = measured('gate_speed = { value = 1, unit = "m/s" }, ')
    assert held["run_out"] < 0.1 * released["run_out"]
    assert 0.5 * released["run_out"] < lifted["run_out"] < 1.5 * released["run_out"]   # what runs out under a gate runs thinner
    assert all(abs(run["energy_imbalance"]) < 0.02 for run in (released, held, lifted))


@pytest.mark.parametrize("old, new, words", [
    ("value = 28, unit", "value = 60, unit", ("friction_angle", "found 60 deg", "at least 0 and less than 60 deg")),
    ("value = 28, unit", "value = -3, unit", ("friction_angle", "found -3 deg", "at least 0 and less than 60 deg")),
    ("cohesion = { value = 0,", "cohesion = { value = -1,", ("cohesion", "found -1 kPa")),
    ("dilation_angle = { value = 0,", "dilation_angle = { value = 30,", ("dilation_angle", "found 30 deg", "at most the angle of friction of 28 deg")),
    ('law = "drucker_prager"\n', 'law = "drucker_pragr"\n', ("law", "drucker_prager")),
    ("left = { value = 0,", "left = { value = -20,", ("left", "found -0.02 m", "overlap the wall")),
    ("bottom = { value = 0,", "bottom = { value = -20,", ("bottom", "found -0.02 m", "overlap the floor")),
    ("floor_length = { value = 800,", "floor_length = { value = 100,", ("floor_length", "ends under the column")),
    ("end_time = {", "k0 = 0.2, end_time = {", ("k0", "found 0.2", "inside the yield surface")),
    ("end_time = {", "k0 = 5, end_time = {", ("k0", "found 5", "inside the yield surface")),
], ids=["phi 60", "phi negative", "cohesion", "psi above phi", "law", "wall", "floor", "floor length", "K0 active", "K0 passive"])
def test_what_cannot_be_is_refused(outside, old, new, words):
    ended, folder = outside(old, new)
    assert ended.returncode == 2, ended.stdout + ended.stderr
    lines = ended.stderr.strip().splitlines()
    assert len(lines) == 1, ended.stderr
    for word in words:
        assert word in lines[0], lines[0]
    assert not (folder / "run").exists()
