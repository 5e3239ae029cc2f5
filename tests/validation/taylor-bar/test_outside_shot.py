"""A metal and a shot that the repository does not know, from a case file with its table and its material beside it."""

import json

import pytest

from tests.harness.program import FURROW, run

CASE = """
family = "taylor-bar"

[sources.our-gun]
text = "Shots of our own gun, 2026"

[[case]]
name = "our-metal-180"
problem = "shot"
title = "Our metal at 180 m/s"
why = "A new alloy must be as strong in a shot as its card says."
description = "A short rod, six particles across."
tier = "quick"
parameters = { set = "our-shots", shot = SPEED, material = "our-metal", scheme = { kernel = "wendland_c2", frame = "reference", bulk_viscosity = { linear = 0.06, quadratic = 1.2 }, hourglass_damping = 0.1 } }
resolution = { spacing = { value = [1.0], unit = "mm" }, h_over_dx = [1.3] }

[[case.metric]]
name = "final_length"
symbol = "L_f"
unit = "mm"
description = "length of the rod at rest"
class = "experiment"
reference = { value = "computed", source = "our-gun" }
norm = "relative"
band = [-0.05, 0.05]
band_why = "Two like shots of our gun differ by 2 %."
""" + "".join(f"""
[[case.metric]]
name = "{name}"
symbol = "x"
unit = "{unit}"
description = "reported"
class = "published"
reference = {{ source = "our-gun" }}
norm = "value"
reported = true
""" for name, unit in (("greatest_plastic_strain", "1"), ("highest_temperature", "K"), ("energy_imbalance", "1")))

TABLE = """temperature (K),impact_speed (m/s),length (mm),diameter (mm),final_length (mm),foot_diameter (mm),undeformed_length (mm),diameter_at_fifth (mm)
293,180,12,6,LENGTH,,,
200,181,12,6,LENGTH,,,
1600,182,12,6,LENGTH,,,
"""

SOURCE = """
source = "our-gun"
citation = "our own table"
class = "experiment"
uncertainty = "1 %"
licence = "ours"
"""


def constants(**values):
    return "".join(f'{key} = {{ value = {value}, unit = "{unit}", source = "our-card" }}\n' for key, (value, unit) in values.items())


def material(density=8000, poisson_ratio=0.3, melting=1500):
    return ('name = "Our metal"\nwhy = "Made up for this test."\nlaw = "johnson_cook"\n' +
            constants(density=(density, "kg/m^3")) + '[sources.our-card]\ntext = "Our card"\n[elasticity]\n' +
            constants(young_modulus=(150, "GPa"), poisson_ratio=(poisson_ratio, "1")) + "[strength]\n" +
            constants(A=(300, "MPa"), B=(200, "MPa"), n=(0.4, "1"), C=(0.01, "1"), m=(1.0, "1"), reference_rate=(1, "1/s"),
                      reference_temperature=(293, "K"), melting_temperature=(melting, "K")) + "[heating]\n" +
            constants(specific_heat=(400, "J/(kg K)"), taylor_quinney=(0.9, "1")))


@pytest.fixture
def shoot(tmp_path):
    """Runs the shot; returns the ended process and the result, {} where there is none."""
    def go(speed=180, length=10.0, **card):
        (tmp_path / "our-shots").mkdir(exist_ok=True)
        (tmp_path / "our-shots/data.csv").write_text(TABLE.replace("LENGTH", str(length)))
        (tmp_path / "our-shots/source.toml").write_text(SOURCE)
        (tmp_path / "our-metal.toml").write_text(material(**card))
        (tmp_path / "case.toml").write_text(CASE.replace("SPEED", str(speed)))
        ended = run(FURROW, "run", "--case-file", tmp_path / "case.toml", "--no-report", "--replace", "--out", tmp_path / "run")
        result = tmp_path / "run/taylor-bar/our-metal-180/result.json"
        return ended, json.loads(result.read_text()) if result.exists() else {}
    return go


def test_it_runs_to_a_verdict_that_its_own_table_decides(shoot):
    ended, result = shoot(length=12.0)
    assert ended.returncode == 1, ended.stdout + ended.stderr   # a rod that did not shorten at all
    assert result["verdict"] == "fail"
    length = result["metrics"][0]["value"]
    assert 9.0 < length < 11.5
    ended, result = shoot(length=round(length, 2))
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert result["verdict"] == "pass"
    assert result["metrics"][0]["reference"]["source"] == "our-gun"


def test_a_rod_colder_than_the_law_is_a_warning_in_the_report(shoot):
    ended, result = shoot(speed=181)
    assert result["verdict"] in ("pass", "fail"), ended.stderr
    assert any(note.startswith("Warning: the rod is at 200 K") for note in result["notes"])


@pytest.mark.parametrize("arguments, said", [
    ({"speed": 182}, "melts"),
    ({"speed": 500}, "180, 181, 182"),
    ({"density": -8000}, "density"),
    ({"poisson_ratio": 0.5}, "poisson_ratio"),
    ({"melting": 200}, "melting_temperature"),
])
def test_what_no_metal_is_and_no_gun_shot_is_refused_before_anything_runs(shoot, arguments, said):
    ended, result = shoot(**arguments)
    assert ended.returncode == 2, ended.stdout
    assert said in ended.stderr and not result
