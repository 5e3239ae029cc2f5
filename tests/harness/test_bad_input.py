"""Bad input: one clear message that names file, line, key and what would be right; exit code 2; nothing earlier is touched."""

import os
import subprocess
import tempfile

import pytest

from tests.harness.program import FURROW, MISBEHAVING, ROOT, run

CASE = """family = "misbehaving"
[sources.tests]
text = "a test"
[[case]]
name = "outside"
problem = "ends"
title = "t"
why = "w"
description = "d"
tier = "smoke"
parameters = { how = "good" }
resolution = { spacing = { value = [4, 2, 1], unit = "mm" }, h_over_dx = [1.2, 1.5] }
[[case.metric]]
name = "length"
symbol = "l"
unit = "mm"
class = "exact"
reference = { value = 1.0, standard_uncertainty = 0.0, source = "tests" }
norm = "absolute"
band = [-0.1, 0.1]
band_why = "Round-off."
"""


def refused(ended, *words):
    """One line on standard error with all the words, exit code 2."""
    assert ended.returncode == 2, ended.stdout + ended.stderr
    lines = ended.stderr.strip().splitlines()
    assert len(lines) == 1, ended.stderr
    for word in words:
        assert word in lines[0], lines[0]


def snapshot(folder):
    return {p: (p.stat().st_mtime_ns, p.read_bytes()) for p in folder.rglob("*") if p.is_file()}


@pytest.fixture
def case_file(tmp_path):
    """Runs the case above with one text replaced, into a folder that holds an earlier run; that run must stay as it was."""
    earlier = tmp_path / "earlier"
    (earlier / "misbehaving/outside").mkdir(parents=True)
    (earlier / "run.json").write_text("{}\n")
    (earlier / "misbehaving/outside/result.json").write_text("{}\n")
    before = snapshot(earlier)

    def changed(old, new, *arguments):
        assert CASE.count(old) == 1
        file = tmp_path / "case.toml"
        file.write_text(CASE.replace(old, new))
        line = CASE[: CASE.index(old)].count("\n") + 1
        ended = run(MISBEHAVING, "run", "--case-file", file, "--no-report", "--replace", "--out", earlier, *arguments)
        if ended.returncode == 2:
            assert snapshot(earlier) == before
        return ended, f"{file}:{line}: "

    return changed


def test_the_case_itself_is_right(case_file):
    ended, _ = case_file("Round-off", "Round-off still")
    assert ended.returncode == 0, ended.stderr


@pytest.mark.parametrize("old, new, words", [
    ('tier = "smoke"', 'tier = "smoke"; teir = 1', ()),
    ('title = "t"', 'titel = "t"', ("case[0].title: found nothing, expected text in quotes",)),
    ('how = "good"', 'how = "good", smothing = 1', ("parameters.smothing: unknown key", "known here: how")),
    ('band_why = "Round-off."', 'band_why = "Round-off."\nbnad = 1', ("metric[0].bnad: unknown key", "did you mean 'band'?")),
], ids=["not toml", "misspelt needed key", "unknown parameter", "unknown key of a metric"])
def test_unknown_key(case_file, old, new, words):
    ended, place = case_file(old, new)
    refused(ended, str(place).rsplit(":", 2)[0], *words)


def test_unknown_key_names_its_line(case_file):
    ended, place = case_file('why = "w"', 'whyy = "w"\nwhy = "w"')
    refused(ended, place, "case[0].whyy: unknown key, did you mean 'why'?", "known here: ")


def test_unknown_key_at_the_top_and_in_resolution(case_file):
    refused(case_file('family = "misbehaving"', 'family = "misbehaving"\nfamly = 1')[0],
            "famly: unknown key, did you mean 'family'?")
    refused(case_file("h_over_dx = [1.2, 1.5]", "h_over_dx = [1.2, 1.5], h_dx = 1")[0], "resolution.h_dx: unknown key")


@pytest.mark.parametrize("old, new, words", [
    ('value = [4, 2, 1], unit = "mm"', 'value = [4, 2, 1], unit = "MPa"',
     ("resolution.spacing.unit", 'found "MPa"', "dimension Pa", 'expected a unit of dimension m, such as "mm"')),
    ('value = [4, 2, 1], unit = "mm"', 'value = [4, 2, 1], unit = "furlong"',
     ("resolution.spacing.unit", '"furlong"', "no unit that furrow knows")),
    ('value = [4, 2, 1], unit = "mm"', "value = [4, 2, 1]", ("resolution.spacing", "found no unit", 'such as "mm"')),
    ('unit = "mm"\nclass', 'unit = "furlong"\nclass', ("metric[0].unit", '"furlong"', "expected a unit that furrow knows")),
], ids=["dimension", "unknown", "missing", "metric"])
def test_wrong_unit(case_file, old, new, words):
    ended, place = case_file(old, new)
    refused(ended, place, *words)


@pytest.mark.parametrize("old, new, words", [
    ('title = "t"', "title = 3", ("case[0].title: found 3, expected text in quotes",)),
    ("value = 1.0, s", 'value = "1.0", s', ('reference.value: found "1.0", expected one of "computed"',)),
    ("band = [-0.1, 0.1]", "band = 0.1", ("metric[0].band: found 0.1, expected a list of numbers",)),
    ("band = [-0.1, 0.1]", "band = [-0.1, nan]", ("metric[0].band[1]: found nan, expected a number",)),
    ("h_over_dx = [1.2, 1.5]", 'h_over_dx = ["1.2"]',
     ('resolution.h_over_dx[0]: found "1.2", expected a number, between 0.8 and 4',)),
    ("[[case]]", "[case]", ("case: found ", "expected an array of tables, [[case]]")),
], ids=["text", "number", "list", "nan", "list of texts", "table"])
def test_wrong_type(case_file, old, new, words):
    ended, place = case_file(old, new)
    if old == "[[case]]":   # then [[case.metric]] is still right TOML, below one table
        place = str(place).rsplit(":", 2)[0]
    refused(ended, place, *words)


def test_missing_file(tmp_path):
    refused(run(MISBEHAVING, "run", "--case-file", tmp_path / "none.toml"),
            str(tmp_path / "none.toml"), "found no such file, expected a TOML file")


def test_a_folder_is_no_case_file(tmp_path):
    refused(run(MISBEHAVING, "run", "--case-file", tmp_path), str(tmp_path), "found no regular file, expected a TOML file")


@pytest.mark.parametrize("spacing", ["-1", "0", "nan", "inf"])
def test_spacing_that_is_not_positive(case_file, spacing):
    ended, place = case_file("value = [4, 2, 1]", f"value = [4, 2, {spacing}]")
    refused(ended, place, "resolution.spacing.value[2]", f"found {spacing}, expected a number, positive")


@pytest.mark.parametrize("ratio", ["0.79", "-1.2", "4.01"])
def test_h_over_dx_outside_its_range(case_file, ratio):
    ended, place = case_file("h_over_dx = [1.2, 1.5]", f"h_over_dx = [1.2, {ratio}]")
    refused(ended, place, f"resolution.h_over_dx[1]: found {ratio}, expected a number, between 0.8 and 4")


def test_band_with_its_ends_swapped(case_file):
    ended, place = case_file("band = [-0.1, 0.1]", "band = [0.1, -0.1]")
    refused(ended, place, "metric[0].band: found [0.1, -0.1], expected the lower end first, [-0.1, 0.1]")


def test_band_that_cannot_fail(case_file):
    ended, place = case_file("band = [-0.1, 0.1]", "band = [-inf, inf]")
    refused(ended, place, "metric[0].band: found two open ends, expected at least one number")


def test_source_that_is_not_in_the_bibliography(case_file):
    ended, place = case_file('source = "tests"', 'source = "test"')
    refused(ended, place, 'reference.source: found "test", expected a key of the bibliography', 'did you mean "tests"?')


def test_unknown_family_problem_and_word(case_file):
    refused(case_file('family = "misbehaving"', 'family = "misbehavin"')[0], ":1: family: ", 'did you mean "misbehaving"?')
    refused(case_file('problem = "ends"', 'problem = "begins"')[0], ":6: case[0].problem: ", 'expected one of "ends"')
    refused(case_file('class = "exact"', 'class = "exactly"')[0], ":17: case[0].metric[0].class: ", 'did you mean "exact"?')


def test_wrong_words_in_set(case_file):
    same = ("Round-off", "Round-off still")
    refused(case_file(*same, "--set", "parameters.hwo=good")[0],
            "--set parameters.hwo=good: case[0].parameters.hwo: unknown key, did you mean 'how'?")
    refused(case_file(*same, "--set", "resolution.h_over_dx=[0.5]")[0],
            "--set resolution.h_over_dx=[0.5]: ", "found 0.5", "between 0.8 and 4")
    refused(case_file(*same, "--set", "band=[0,1]")[0], "expected a key below parameters or resolution, or time_limit")
    refused(case_file(*same, "--set", "nonsense")[0], "expected KEY=VALUE")


def test_unknown_case():
    refused(run(FURROW, "run", "kernel/continuous-cubic-spine-2d"),
            "kernel/continuous-cubic-spine-2d: found no case of this name",
            "did you mean 'kernel/continuous-cubic-spline-2d'?")
    refused(run(FURROW, "matrix", "--only", "kernel/nothing*"), "found no case in tier quick that matches")
    refused(run(FURROW, "list", "--family", "kernels"), "found no family of this name, did you mean 'kernel'?")


def test_wrong_usage_is_exit_code_2_too():
    for arguments in (["matrix", "--tier", "nightlly"], ["run"], ["frobnicate"], [], ["matrix", "--jobs", "0"], ["report"]):
        ended = run(FURROW, *arguments)
        assert ended.returncode == 2, arguments
        assert ended.stderr, arguments


def test_output_folder_below_a_file(tmp_path):
    (tmp_path / "file").write_text("earlier\n")
    refused(run(MISBEHAVING, "run", "misbehaving/good", "--out", tmp_path / "file/run"),
            "--out ", "Not a directory", "expected a folder that can be made")
    assert (tmp_path / "file").read_text() == "earlier\n"


def test_output_folder_that_is_read_only():
    """/proc cannot be written by anybody, root included."""
    refused(run(MISBEHAVING, "run", "misbehaving/good", "--out", "/proc/tty/run"),
            "--out /proc/tty/run", "expected a folder that can be made")
    refused(run(MISBEHAVING, "run", "misbehaving/good", "--out", "/proc/tty"),
            "--out /proc/tty", "found a folder that cannot be written")


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may drop to another user")
def test_output_folder_of_somebody_else():
    nobody = {"user": 65534, "group": 65534, "extra_groups": []}
    if subprocess.run([MISBEHAVING, "list"], capture_output=True, **nobody).returncode != 0:
        pytest.skip("the project lies where no other user may read")
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        os.chmod(folder, 0o555)
        ended = subprocess.run([MISBEHAVING, "run", "misbehaving/good", "--out", folder], capture_output=True, text=True,
                               **nobody)
        refused(ended, f"--out {folder}: found a folder that cannot be written", "Permission denied", "expected one that can")


def test_help_of_every_command_has_an_example():
    for command in ("list", "run", "matrix", "report", "bench"):
        ended = run(FURROW, command, "--help")
        assert ended.returncode == 0
        assert "Example: ./furrow " + command in ended.stdout
    ended = run(ROOT / "furrow", "test", "--help")
    assert ended.returncode == 0
    assert "Example: ./furrow test" in ended.stdout
