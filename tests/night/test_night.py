"""The history and the night: what is remembered, and that no kill, no second night, no full disk and no broken file loses it."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from gate.files import GateError
from night import series, store, summary
from night.command import main
from tests.gate.made import blessed, case, run, with_value
from tests.reports.sample import COST, metric

ROOT = Path(__file__).resolve().parents[2]


def night(folder, value=1.0, cpu=3.0, day=1, commit=None, **more):
    """A run folder of one case as a night leaves it."""
    folder.mkdir(parents=True, exist_ok=True)
    p = {"commit": commit or f"{day:040x}", "started": f"2026-11-{day:02d}T02:00:00Z"}
    data = with_value(case(provenance=p, cost={**COST, "cpu_s": cpu}), value)
    return run(folder, data, provenance=p, tier="nightly", exit_code=0, wall_s=cpu, cpu_s=cpu, **more)


def filled(path, *values, cpu=None):
    with store.opened(path, create=True) as connection:
        for i, value in enumerate(values):
            store.add(connection, night(path.parent / f"n{i}", value, (cpu or [3.0] * len(values))[i], i + 1))
    return path


def read(path):
    with store.opened(path) as connection:
        nights = store.nights(connection)
        return nights, {s.key: s for s in series.read(connection, nights)}


def test_every_metric_and_cost_is_kept_to_the_bit(tmp_path):
    values = [0.1, 1 / 3, 5e-324, 1.7976931348623157e308]
    nights, found = read(filled(tmp_path / "h", *values))
    assert found["kernel/one/norm"].values == values
    assert found["kernel/one/cpu_s"].values == [3.0] * 4 and found["kernel/one/cpu_s"].kind == "cost"
    assert found["run-nightly/cpu_s"].values == [3.0] * 4
    assert [n.commit for n in nights] == [f"{d:040x}" for d in range(1, 5)]


def test_a_run_that_is_added_twice_is_there_once(tmp_path):
    path = filled(tmp_path / "h", 1.0, 2.0)
    with store.opened(path) as connection:
        store.add(connection, night(tmp_path / "n1", 2.5, day=2))
    nights, found = read(path)
    assert len(nights) == 2 and found["kernel/one/norm"].values == [1.0, 2.5]


def test_a_number_that_is_missing_is_a_hole_and_not_zero(tmp_path):
    path = filled(tmp_path / "h", 1.0, None, 2.0)
    assert (read(path)[1]["kernel/one/norm"].places, read(path)[1]["kernel/one/norm"].values) == ([0, 2], [1.0, 2.0])


def test_a_step_names_the_first_commit_after_it(tmp_path):
    path = filled(tmp_path / "h", 1.0, 1.0, 1.0, 1.5, 1.5, cpu=[3.0, 3.1, 2.9, 3.0, 3.1])
    nights, found = read(path)
    (step,) = found["kernel/one/norm"].steps
    words = series.step_words(found["kernel/one/norm"], step, nights)
    assert words == "1 → 1.5 (+50 %) since 00000000 of 2026-11-04"
    assert nights[found["kernel/one/norm"].places[step.index]].commit == f"{4:040x}"
    assert found["kernel/one/cpu_s"].steps == []


def test_a_cost_that_lasts_is_a_step(tmp_path):
    _, found = read(filled(tmp_path / "h", *[1.0] * 10, cpu=[3.0, 3.1, 2.9, 3.0, 3.1, 3.0, 4.5, 4.4, 4.6, 4.5]))
    assert [s.index for s in found["kernel/one/cpu_s"].steps] == [6]


def test_a_step_without_a_commit_blames_none(tmp_path):
    with store.opened(tmp_path / "h", create=True) as connection:
        for day, value in ((1, 1.0), (2, 2.0)):
            store.add(connection, night(tmp_path / str(day), value, day=day, commit="c" * 40))
    nights, found = read(tmp_path / "h")
    s = found["kernel/one/norm"]
    assert "without a new commit" in series.step_words(s, s.steps[0], nights)


def test_what_is_no_night_is_refused(tmp_path):
    with store.opened(tmp_path / "h", create=True) as connection, pytest.raises(GateError, match="no part of the history"):
        store.add(connection, night(tmp_path / "n", overrides=["parameters.x=1"]))


WRITER = """
import sys
sys.path.insert(0, {root!r})
from pathlib import Path
from night import store
from reports import results
run = results.load({folder!r})
print("ready", flush=True)
with store.opened({path!r}, create=True) as connection:
    for i in range({count}):
        run.provenance["started"] = "{name}-%04d" % i
        store.add(connection, run)
        print(i, flush=True)
"""


def writer(tmp_path, name, count):
    folder = tmp_path / "run"
    night(folder)
    return subprocess.Popen([sys.executable, "-c", WRITER.format(root=str(ROOT), folder=str(folder), path=str(tmp_path / "h"),
                                                                 name=name, count=count)], stdout=subprocess.PIPE, text=True)


def test_a_night_waits_for_one_that_has_just_made_the_file(tmp_path):
    path = tmp_path / "h"
    other = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
    other.execute("BEGIN IMMEDIATE")
    threading.Timer(0.3, other.execute, ["COMMIT"]).start()
    with store.opened(path, create=True) as connection:
        assert connection.execute("PRAGMA journal_mode").fetchone() == ("wal",)
    other.close()


def test_two_nights_at_once_both_arrive(tmp_path):
    both = [writer(tmp_path, name, 40) for name in "ab"]
    assert [p.wait(timeout=60) for p in both] == [0, 0]
    [p.stdout.close() for p in both]
    nights, found = read(tmp_path / "h")
    assert len(nights) == 80 and len(found["kernel/one/norm"].values) == 80


@pytest.mark.slow
def test_kill_9_in_the_middle_leaves_whole_runs_only(tmp_path):
    for i in range(12):
        process = writer(tmp_path, f"w{i}", 1000)
        process.stdout.readline()
        time.sleep(0.01 * i)
        process.send_signal(signal.SIGKILL)
        said = process.communicate()[0].split()
        nights, found = read(tmp_path / "h") if said else ([], {})
        if said:
            mine = [n for n in nights if n.started.startswith(f"w{i}-")]
            assert len(mine) in (len(said), len(said) + 1)   # what was said to be there is there
            assert len(found["kernel/one/norm"].values) == len(nights)
    assert len(read(tmp_path / "h")[0]) > 0


@pytest.mark.parametrize("spoil", [
    lambda p: p.write_bytes(b"not a database" * 100),
    lambda p: p.write_bytes(p.read_bytes()[:5000]),
    lambda p: p.write_bytes(p.read_bytes()[:4096] + b"\0" * 4096 + p.read_bytes()[8192:]),
])
def test_a_broken_history_is_said_and_left_as_it_is(tmp_path, capsys, spoil):
    path = filled(tmp_path / "h", 1.0, 2.0)
    for extra in tmp_path.glob("h-*"):
        extra.unlink()
    spoil(path)
    before = path.read_bytes()
    assert main(["history", "--history", str(path)]) == 3
    said = capsys.readouterr().err
    assert "the history is broken" in said and "history --add" in said and said.count("\n") == 1
    assert path.read_bytes() == before


def test_no_history_and_one_of_another_version_are_said(tmp_path, capsys):
    assert main(["history", "--history", str(tmp_path / "h")]) == 2
    assert "no history yet" in capsys.readouterr().err
    with sqlite3.connect(tmp_path / "h") as connection:
        connection.execute("PRAGMA user_version = 99")
    assert main(["history", "--history", str(tmp_path / "h")]) == 2
    assert "version 99" in capsys.readouterr().err


def test_a_full_disk_leaves_what_was_there(tmp_path):
    path = filled(tmp_path / "h", 1.0, 2.0)
    script = ("import resource, signal, sys; signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
              f"resource.setrlimit(resource.RLIMIT_FSIZE, ({path.stat().st_size + 100},) * 2)\n"
              "from night.command import main\nsys.exit(main(sys.argv[1:]))")
    many = [case(f"kernel/c{i}", metrics=[metric(f"m{k}", 1.0, [0, 2]) for k in range(40)]) for i in range(60)]
    (tmp_path / "big").mkdir()
    run(tmp_path / "big", *many)
    ended = subprocess.run([sys.executable, "-c", script, "history", "--history", str(path), "--add", str(tmp_path / "big")],
                           capture_output=True, text=True, env=os.environ | {"PYTHONPATH": str(ROOT)})
    assert ended.returncode == 3, ended.stdout + ended.stderr
    assert "Traceback" not in ended.stderr and ended.stderr.count("\n") == 1
    assert read(path)[1]["kernel/one/norm"].values == [1.0, 2.0]


# --- the whole night, with a program that stands in for the runner

@pytest.fixture
def place(tmp_path, monkeypatch):
    """A stand-in for the program: `matrix ... --out DIR` copies a prepared run there; baselines of that run are blessed."""
    prepared = tmp_path / "prepared"
    night(prepared)
    blessed(tmp_path / "accepted", case(), baselines=tmp_path / "b")
    program = tmp_path / "program"
    program.write_text(f"#!{sys.executable}\nimport shutil, sys\nout = sys.argv[sys.argv.index('--out') + 1]\n"
                       f"shutil.copytree({str(prepared)!r}, out, dirs_exist_ok=True)\n")
    program.chmod(0o755)
    monkeypatch.setenv("FURROW_PROGRAM", str(program))
    return tmp_path


@pytest.fixture(autouse=True)
def make_accepted(tmp_path):
    (tmp_path / "accepted").mkdir()


def go(place, name, *more):
    return main(["nightly", "--out", str(place / name), "--history", str(place / "h"), "--baselines", str(place / "b"), *more])


def test_a_night_runs_compares_remembers_and_reports(place, capsys):
    assert go(place, "n1") == 0
    said = capsys.readouterr().out
    assert "1 cases: 1 pass" in said and "1 bitwise the same" in said and "report: " in said
    assert (place / "n1/report/index.html").exists() and (place / "n1/summary.txt").read_text() == said
    nights, found = read(place / "h")
    assert len(nights) == 1 and found["kernel/one/norm"].values == [1.0]
    assert json.loads((place / "n1/history.json").read_text())["series"]


def test_a_night_that_moved_away_is_red_and_says_what_stepped(place, capsys):
    go(place, "n1", "--no-report")
    night(place / "prepared", 1.5, day=2)
    capsys.readouterr()
    assert go(place, "n2", "--no-report") == 1
    said = capsys.readouterr().out
    assert "RED" in said and "step   kernel/one/norm 1 → 1.5 (+50 %) since 00000000" in said


def test_the_summary_fits_one_screen(tmp_path):
    names = [f"operators/a-case-with-a-name-that-goes-on-{i}" for i in range(60)]
    cases = [case(n, metrics=[metric("norm_of_something", 1.0, [0, 2])]) for n in names]
    blessed(tmp_path / "accepted", *cases, baselines=tmp_path / "b")
    for i, value in enumerate((1.0, 1.5)):
        folder = tmp_path / f"n{i}"
        folder.mkdir()
        moved = run(folder, *(with_value(c, value) for c in cases), tier="nightly", wall_s=60.0, cpu_s=100.0,
                    provenance={"started": f"2026-11-0{i + 1}T02:00:00Z"})
        with store.opened(tmp_path / "h", create=True) as connection:
            store.add(connection, moved)
            nights = store.nights(connection)
            found = series.read(connection, nights)
    from gate import baseline
    from gate.compare import compare
    text = summary.text(moved, compare(moved, baseline.read_all(tmp_path / "b"), []), found, nights, None)
    assert len(text.splitlines()) <= summary.LINES and max(map(len, text.splitlines())) <= summary.WIDTH
    assert "60 red" in text and "step" in text and "min" in text.splitlines()[-1]


def test_a_broken_history_does_not_cost_the_night(place, capsys):
    (place / "h").write_bytes(b"no database" * 100)
    assert go(place, "n1", "--no-report") == 3
    said = capsys.readouterr()
    assert "the history is broken" in said.err and "the history is broken" in " ".join(said.out.split())
    assert (place / "n1/gate/gate.json").exists() and (place / "h").read_bytes().startswith(b"no database")
    (place / "h").rename(place / "aside")
    assert main(["history", "--history", str(place / "h"), "--add", str(place / "n1")]) == 0
    assert read(place / "h")[1]["kernel/one/norm"].values == [1.0]


def test_two_nights_in_one_folder(place, capsys):
    from gate.files import locked
    with locked(place / "n1", "nightly"):
        assert go(place, "n1") == 2
    assert "nightly, process" in capsys.readouterr().err


def test_a_killed_night_ends_its_run_and_can_be_resumed(place):
    """kill -9 of the night: the runner below it gets a signal to stop, and a later --resume goes on in the same folder."""
    slow = place / "slow"
    slow.write_text(f"#!{sys.executable}\nimport os, sys, time, shutil\nout = sys.argv[sys.argv.index('--out') + 1]\n"
                    f"if '--resume' in sys.argv:\n  shutil.copytree({str(place / 'prepared')!r}, out, dirs_exist_ok=True)\n"
                    "  sys.exit(0)\n"
                    f"open({str(place / 'pid')!r}, 'w').write(str(os.getpid()))\ntime.sleep(60)\n")
    slow.chmod(0o755)
    arguments = [sys.executable, "-m", "night", "nightly", "--out", str(place / "n1"), "--history", str(place / "h"),
                 "--baselines",
                 str(place / "b"), "--no-report"]
    environment = os.environ | {"PYTHONPATH": str(ROOT), "FURROW_PROGRAM": str(slow)}
    process = subprocess.Popen(arguments, env=environment)
    deadline = time.monotonic() + 20
    while not (place / "pid").exists() or not (place / "pid").read_text():
        assert time.monotonic() < deadline
        time.sleep(0.02)
    child = int((place / "pid").read_text())
    process.kill()
    process.wait()
    while time.monotonic() < deadline and Path(f"/proc/{child}/stat").exists() and \
            Path(f"/proc/{child}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z":
        time.sleep(0.02)
    assert not Path(f"/proc/{child}").exists() or Path(f"/proc/{child}/stat").read_text().rsplit(")", 1)[1].split()[0] == "Z"
    ended = subprocess.run([*arguments, "--resume"], env=environment, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    assert len(read(place / "h")[0]) == 1


def test_history_on_the_terminal(tmp_path, capsys):
    path = filled(tmp_path / "h", 1.0, 1.0, 1.5)
    assert main(["history", "--history", str(path)]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 4
    assert main(["history", "--history", str(path), "kernel/one/norm"]) == 0
    said = capsys.readouterr().out
    assert "▁▁█" in said and "1 → 1.5 (+50 %) since 00000000" in said and "2026-11-03 02:00  00000000  1.5" in said
    assert main(["history", "--history", str(path), "--steps"]) == 0
    assert capsys.readouterr().out.startswith("kernel/one/norm")
    assert main(["history", "--history", str(path), "kernel/other/*"]) == 2
    assert main(["history", "--history", str(path), "--json", "kernel/one/norm"]) == 0


