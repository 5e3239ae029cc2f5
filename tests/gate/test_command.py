"""The commands from outside: exit codes, messages, files, and what is left when something goes wrong in the middle."""

import json
import os
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from gate import baseline, files, ledger
from gate.command import main
from tests.gate.made import blessed, case, run, with_value
from tests.reports.sample import metric

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def place(tmp_path):
    """A run of two cases that were blessed as they are."""
    (tmp_path / "run").mkdir()
    blessed(tmp_path / "run", case(), case("kernel/two"), baselines=tmp_path / "b")
    return tmp_path


def gate(place, *more):
    return main(["gate", str(place / "run"), "--no-report", "--baselines", str(place / "b"), *more])


def written(place, name):
    return (place / "run/gate" / name).read_text()


@pytest.mark.parametrize("data, code, words", [
    (case(), 0, "0 red, 0 yellow"),
    (with_value(case(), 1.5), 1, "moved away from the truth"),
    (with_value(case(), 0.5), 0, "1 yellow"),
    (with_value(case(verdict="fail"), 2.5, verdict="fail"), 1, "outside its band"),
    (with_value(case(verdict="error"), None, verdict="error", reason="the time step fell to zero"), 3,
     "the time step fell to zero"),
])
def test_exit_code_and_table(place, capsys, data, code, words):
    run(place / "run", data, case("kernel/two"))
    assert gate(place) == code
    assert words in capsys.readouterr().out
    assert json.loads(written(place, "gate.json"))["exit_code"] == code


def test_every_output_tells_the_same(place, capsys):
    run(place / "run", with_value(case(), 1.5), with_value(case("kernel/two"), 0.5), tier="smoke")
    assert gate(place) == 1
    data = json.loads(written(place, "gate.json"))
    assert [(r["case"], r["colour"], r["kind"], r["direction"]) for r in data["rows"]] == [
        ("kernel/one", "red", "away", "away"), ("kernel/two", "yellow", "toward", "toward")]
    assert data["blame"][0]["modules"] == ["schemes/momentum"]
    suites = ET.fromstring(written(place, "junit.xml"))
    assert (suites.get("tests"), suites.get("failures"), suites.get("errors"), suites.get("skipped")) == ("2", "1", "0", "1")
    assert "moved away from the truth" in suites.find(".//failure").get("message")
    summary = written(place, "summary.md")
    assert summary.startswith("## Gate: red") and "| red | kernel/one | norm | 1 | 1.5 |" in summary
    assert written(place, "annotations.txt").splitlines() == [
        "::error title=kernel/one norm::moved away from the truth 1 → 1.5 +50 %25",
        "::warning title=kernel/two norm::moved toward the truth 1 → 0.5 −50 %25"]
    assert set(json.loads(written(place, "curves.json"))) == {"kernel/one", "kernel/two"}


@pytest.mark.parametrize("width", [60, 80, 132])
def test_the_table_fits_the_terminal_and_never_loses_the_metric(place, capsys, monkeypatch, width):
    monkeypatch.setenv("COLUMNS", str(width))
    long = case("operators/a-case-with-a-very-long-name-of-many-words", metrics=[
        metric("a_metric_of_some_length", 1.23456789e-7, [0, 1e-6], unit="kg/m^3"), metric("other", 1.0, [0, 2])])
    blessed(place / "run", long, baselines=place / "b")
    run(place / "run", with_value(long, 2.3456789e-7), case(metrics=[metric("norm", 1.0, [0, 2]), metric("more", 1, [0, 2])]))
    gate(place)
    lines = [line for line in capsys.readouterr().out.splitlines() if not line.startswith("results:")]
    assert max(map(len, lines)) <= width
    assert any("a_metric_of_some_length" in line for line in lines)


def test_a_terminal_that_shows_links_is_led_to_the_curves(place, capsys, monkeypatch):
    run(place / "run", with_value(case(), 1.5), case("kernel/two"))
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    assert main(["gate", str(place / "run"), "--baselines", str(place / "b")]) == 1
    page = place / "run/report/cases/kernel/one.html"
    said = capsys.readouterr().out
    assert page.exists() and f"\033]8;;{page.resolve().as_uri()}#metrics\033\\" in said and said.count("\033]8;;\033\\") == 1


def test_a_tiny_move_is_shown_with_the_digits_that_moved(place, capsys):
    run(place / "run", with_value(case(), 1.0 + 1e-5), case("kernel/two"))
    gate(place)
    assert "1 → 1.00001" in capsys.readouterr().out


def test_a_broken_baseline_is_named_and_nothing_runs(place, capsys):
    path = baseline.path_of("kernel/one", place / "b")
    whole = path.read_text()
    for broken in (whole[:len(whole) // 2], whole.replace('"value": 1.0', '"value": NaN'),
                   whole.replace('"value": 1.0', '"valu": 1.0'),
                   whole.replace("kernel/one", "kernel/eno"), "[]", "", whole.replace('"schema": 1', '"schema": 7')):
        path.write_text(broken)
        assert gate(place) == 2
        said = capsys.readouterr().err
        assert str(path) in said and "git checkout" in said and said.count("\n") == 1
    assert not (place / "run/gate").exists()


def test_a_broken_ledger_is_named_and_not_added_to(place, capsys):
    path = ledger.path_in(place / "b")
    path.write_text(path.read_text() + '{"kind": "val')
    assert gate(place) == 2
    assert f"{path}:3" in capsys.readouterr().err
    assert main(["bless", str(place / "run"), "*", "--reason", "x", "--baselines", str(place / "b")]) == 2
    assert path.read_text().endswith('"val')


def test_two_gates_in_one_folder(place, capsys):
    with files.locked(place / "run", "gate"):
        assert gate(place) == 2
    said = capsys.readouterr().err
    assert "gate, process" in said and "try again" in said
    assert gate(place) == 0


def test_a_lock_of_a_process_that_was_killed_holds_nobody_up(place):
    held = f"import sys, time; sys.path.insert(0, {str(ROOT)!r})\nfrom gate.files import locked\n" \
           f"with locked({str(place / 'run')!r}, 'gate'):\n  print('has it', flush=True); time.sleep(60)"
    process = subprocess.Popen([sys.executable, "-c", held], stdout=subprocess.PIPE)
    assert process.stdout.readline() == b"has it\n"
    assert gate(place) == 2
    process.kill()
    process.communicate()
    assert gate(place) == 0


def test_a_full_disk_leaves_baselines_and_ledger_as_they_were(place):
    before = {p: p.read_bytes() for p in (place / "b").rglob("*") if p.is_file() and p.name != ".lock"}
    run(place / "run", with_value(case(), 0.5), case("kernel/two"))
    script = ("import resource, signal, sys; signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
              "resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))\n"
              "from gate.command import main\nsys.exit(main(sys.argv[1:]))")
    ended = subprocess.run([sys.executable, "-c", script, "bless", str(place / "run"), "*", "--reason", "x", "--baselines",
                            str(place / "b")], capture_output=True, text=True, env=os.environ | {"PYTHONPATH": str(ROOT)})
    assert ended.returncode == 3, ended.stderr
    assert "cannot be written" in ended.stderr and "Traceback" not in ended.stderr
    assert {p: p.read_bytes() for p in (place / "b").rglob("*") if p.is_file() and p.name != ".lock"} == before
    assert not list(place.rglob("*.part"))


@pytest.mark.parametrize("words, said", [
    (["gate", "/nowhere"], "no such folder"),
    (["gate", ".", "--tier", "smoke"], "RUN is a run that is there"),
    (["bless", "/nowhere", "x", "--reason", "y"], "no such folder"),
    (["noise", "/nowhere", "--reason", "y"], "no such folder"),
])
def test_wrong_usage_is_exit_code_2_and_one_line(tmp_path, capsys, words, said):
    assert main([*words, "--baselines", str(tmp_path)]) == 2
    found = capsys.readouterr().err
    assert said in found and found.count("\n") == 1


def test_a_tier_is_run_and_its_failure_to_run_is_passed_on(tmp_path, capsys, monkeypatch):
    program = tmp_path / "program"
    program.write_text(f'#!/bin/sh\necho "$@" >> {tmp_path}/calls\nexit 2\n')
    program.chmod(0o755)
    monkeypatch.setenv("FURROW_PROGRAM", str(program))
    assert main(["gate", "--tier", "smoke", "--only", "kernel/*", "--out", str(tmp_path / "run"), "--baselines",
                 str(tmp_path / "b")]) == 2
    assert (tmp_path / "calls").read_text().split() == [
        "matrix", "--no-report", "--out", str(tmp_path / "run"), "--tier", "smoke", "--only", "kernel/*"]
    assert "nothing was run" in capsys.readouterr().err


def test_record_compares_only_what_has_a_baseline_and_is_never_red(place):
    run(place / "run", with_value(case(), 1.5), case("kernel/not-accepted"), tier="smoke")
    assert main(["record", str(place / "run"), "--baselines", str(place / "b")]) == 0
    assert [(r["case"], r["kind"]) for r in json.loads(written(place, "gate.json"))["rows"]] == [
        ("kernel/one", "away"), ("kernel/two", "bitwise")]


