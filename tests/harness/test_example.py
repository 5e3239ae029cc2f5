"""The worked example of the README: it is the file in examples/, it runs to a verdict, and a wrong digit in its table turns it red."""

import json
import math
import tomllib

import pytest

from tests.harness.program import FURROW, ROOT, run

EXAMPLE = ROOT / "examples/wave-speed-wendland-c4.toml"
CASE = "operators/wave-speed-wendland-c4"


def slope(q):
    """dW/dq of Wendland's C4 in the plane, (1-r)^6 (1 + 6 r + 35/3 r^2) with r = q/2, for h = 1."""
    r = q / 2.0
    return -9.0 / (4.0 * math.pi) * 28.0 / 3.0 * r * (1.0 + 5.0 * r) * (1.0 - r) ** 5 if r < 1.0 else 0.0


def lattice_sum(ratio, weight):
    """Sum of -dW/dx weight(x) over a square lattice of unit spacing, h = ratio."""
    reach = range(-math.ceil(2.0 * ratio), math.ceil(2.0 * ratio) + 1)
    return -sum(slope(math.hypot(i, j) / ratio) / ratio**3 * i / math.hypot(i, j) * weight(i) for i in reach for j in reach if i or j)


def verdict_of(case_file, folder):
    ended = run(FURROW, "run", "--case-file", case_file, "--no-report", "--out", folder)
    return ended, json.loads((folder / CASE / "result.json").read_text())


def test_it_passes_on_both_metrics(tmp_path):
    ended, result = verdict_of(EXAMPLE, tmp_path / "run")
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert result["verdict"] == "pass"
    assert {m["name"]: m["verdict"] for m in result["metrics"]} == {"wave_speed": "pass", "gradient_norm": "pass"}


def test_a_case_may_be_named_behind_its_file(tmp_path):
    ended = run(FURROW, "run", "--case-file", EXAMPLE, CASE, "--no-report", "--out", tmp_path / "run")
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.parametrize("right, wrong, red", [("0.90734", "0.90735", "wave_speed"), ("0.998327", "0.998328", "gradient_norm")])
def test_one_wrong_digit_is_red(tmp_path, right, wrong, red):
    text = EXAMPLE.read_text()
    assert text.count(right) == 1
    (tmp_path / "case.toml").write_text(text.replace(right, wrong))
    ended, result = verdict_of(tmp_path / "case.toml", tmp_path / "run")
    assert ended.returncode == 1, ended.stdout + ended.stderr
    assert [m["name"] for m in result["metrics"] if m["verdict"] == "fail"] == [red]


def test_its_table_is_the_sum_that_it_cites():
    parameters = tomllib.loads(EXAMPLE.read_text())["case"][0]["parameters"]
    assert [row["h_over_dx"] for row in parameters["rows"]] == [1.4, 1.8]
    for row in parameters["rows"]:
        for waves, speed in zip(parameters["waves"], row["speed"], strict=True):
            k = 2.0 * math.pi * waves / parameters["cells"]
            assert speed == round(lattice_sum(row["h_over_dx"], lambda x: math.sin(k * x) / k), 5)
        assert row["gradient_norm"] == round(lattice_sum(row["h_over_dx"], lambda x: x), 6)


def test_the_readme_shows_it_whole():
    assert EXAMPLE.read_text() in (ROOT / "README.md").read_text()
