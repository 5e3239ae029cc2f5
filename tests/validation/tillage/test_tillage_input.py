"""Cuts that cannot be: each is refused with what stands there and what would be right."""

import pytest

from tests.harness.program import FURROW, run

CASE = "tillage/table1-2.0"


def tried(tmp_path, *assignments):
    return run(FURROW, "run", CASE, "--no-report", "--out", tmp_path / "run", *(a for s in assignments for a in ("--set", s)))


@pytest.mark.parametrize("assignment, words", [
    ("parameters.speed.value=0", "expected a speed to the left above 0"),
    ("parameters.tool.across=3", "expected 4 or more particles over the thickness"),
    ("parameters.gap.value=-0.5", "the blade would stand in the soil at the start"),
    ("parameters.gap.value=20", "the blade would not touch the soil"),
    ("parameters.depth.value=15", "expected less than the soil's height"),
    ("parameters.tool.free_length.value=24.75", "expected less than the blade's length"),
    ("parameters.contact.lennard_jones={ coefficient = 4, cut_off = 1, steep = 4, flat = 12 }", "the force would attract"),
])
def test_what_the_file_says_is_wrong(tmp_path, assignment, words):
    ended = tried(tmp_path, assignment)
    assert ended.returncode == 2, ended.stdout + ended.stderr
    assert words in ended.stderr, ended.stderr


@pytest.mark.parametrize("assignments, words", [
    (("parameters.gap.value=1.5",), "larger than the spacing"),
    (("parameters.gap.value=0", "parameters.relief.value=69", "parameters.rake.value=110"), "the blade stands in the soil at the start"),
])
def test_what_a_resolution_makes_wrong(tmp_path, assignments, words):
    ended = tried(tmp_path, *assignments)
    assert ended.returncode == 3, ended.stdout + ended.stderr
    assert words in ended.stdout + ended.stderr
