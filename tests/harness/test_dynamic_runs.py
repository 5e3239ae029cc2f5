"""Runs that move: threads and interruptions change no byte of what is left; what goes wrong is named, and nothing is lost."""

import json
import os
import resource
import shutil
import signal
import subprocess
import time

import h5py
import pytest

from tests.harness.program import FURROW, run

CASE = "elastodynamics/struck-bar"

# A confined bar flies against a wall: walls, symmetry planes, viscosity, a correction; half a second of one core.
BAR = """family = "elastodynamics"
[[case]]
name = "struck-bar"
problem = "bar_on_wall"
title = "A bar flies against a wall"
why = "Something has to move."
description = "For tests of the runner."
tier = "smoke"
parameters = { length = { value = 100, unit = "mm" }, impact_velocity = { value = 10, unit = "mm/s" }, density = { value = 1000, unit = "kg/m^3" }, young_modulus = { value = 2, unit = "MPa" }, poisson_ratio = 0.3, scheme = { kernel = "wendland_c2", correction = "linear", viscosity = { alpha = 0.3, beta = 0.6 } } }
resolution = { spacing = { value = [2.5], unit = "mm" }, h_over_dx = [1.3] }
[[case.metric]]
name = "impact_stress"
symbol = "sigma"
unit = "Pa"
class = "exact"
reference = { value = "computed", source = "elastic-waves" }
norm = "relative"
band = [-0.1, 0.1]
band_why = "For tests of the runner."
"""
for name, unit in (("contact_time", "s"), ("impulse", "Pa s"), ("rebound_velocity", "m/s")):
    BAR += f"""[[case.metric]]
name = "{name}"
symbol = "x"
unit = "{unit}"
class = "exact"
reference = {{ value = "computed", source = "elastic-waves" }}
norm = "relative"
reported = true
"""
BAR += """[[case.metric]]
name = "energy_imbalance"
symbol = "dE/E"
unit = "1"
class = "exact"
reference = { value = 0.0, standard_uncertainty = 0.0, source = "conservation" }
norm = "absolute"
reported = true
"""

# A plate takes its Courant number from the case.
PLATE = """family = "elastodynamics"
[[case]]
name = "wild-plate"
problem = "oscillating_plate"
title = "A plate with too long a step"
why = "What must diverge must be seen to."
description = "For tests of the runner."
tier = "smoke"
parameters = { length = { value = 200, unit = "mm" }, thickness = { value = 20, unit = "mm" }, clamp_length = { value = 50, unit = "mm" }, density = { value = 1000, unit = "kg/m^3" }, young_modulus = { value = 2, unit = "MPa" }, poisson_ratio = 0.3975, velocity_amplitude = 0.001, end_time = { value = 0.28, unit = "s" }, clamp = "layers", courant = 3.0, scheme = { kernel = "wendland_c2" } }
resolution = { spacing = { value = [5], unit = "mm" }, h_over_dx = [1.3] }
"""
for name, unit in (("period", "s"), ("amplitude", "1"), ("energy_imbalance", "1")):
    PLATE += f"""[[case.metric]]
name = "{name}"
symbol = "x"
unit = "{unit}"
class = "exact"
reference = {{ value = 1.0, standard_uncertainty = 0.0, source = "conservation" }}
norm = "absolute"
band = [-10, 10]
band_why = "For tests of the runner."
"""


@pytest.fixture
def bar(tmp_path):
    file = tmp_path / "bar.toml"
    file.write_text(BAR)
    return file


def start(case_file, folder, *arguments, **options):
    return run(FURROW, "run", "--case-file", case_file, "--no-report", "--out", folder, *arguments, **options)


def result(folder, case=CASE):
    return json.loads((folder / case / "result.json").read_text())


def computed(folder, case=CASE):
    """All files that the simulation itself has left, byte for byte."""
    files = {f.relative_to(folder / case): f.read_bytes() for f in (folder / case).rglob("*")
             if f.suffix in (".h5", ".vtkhdf")}
    assert {f.suffix for f in files} == {".h5", ".vtkhdf"}
    return files


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    (folder / "bar.toml").write_text(BAR)
    ended = start(folder / "bar.toml", folder / "run")
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return folder / "run"


def children_of(process):
    with open(f"/proc/{process.pid}/task/{process.pid}/children") as listed:
        return [int(child) for child in listed.read().split()]


def interrupted(bar, folder, how, rung="."):
    """A run that is stopped after its first checkpoint and well before its end; `how` gets the runner's process."""
    process = subprocess.Popen([FURROW, "run", "--case-file", bar, "--no-report", "--out", folder], stdout=subprocess.DEVNULL,
                               env=os.environ | {"FURROW_CHECKPOINT_INTERVAL": "0.02"})
    checkpoint = folder / CASE / rung / "checkpoint.h5"
    deadline = time.monotonic() + 60
    while not checkpoint.exists() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.002)
    how(process)
    process.wait(timeout=20)
    time.sleep(0.1)   # the case's own process dies with the runner
    assert checkpoint.exists(), "the run ended before it could be stopped"


def test_two_threads_leave_the_same_bytes_as_one(bar, tmp_path, uninterrupted):
    # Threads that wait sleep, for the machine may be busy.
    ended = start(bar, tmp_path / "two", "--threads", "2", environment={"OMP_WAIT_POLICY": "passive"})
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert computed(tmp_path / "two") == computed(uninterrupted)


@pytest.mark.parametrize("killed", ["runner", "case"])
def test_a_run_killed_on_its_way_is_resumed_to_the_same_bytes(bar, tmp_path, uninterrupted, killed):
    folder = tmp_path / "run"
    interrupted(bar, folder, lambda p: p.kill() if killed == "runner" else os.kill(children_of(p)[0], signal.SIGKILL))
    ended = start(bar, folder, "--resume")
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "Went on from a checkpoint" in " ".join(result(folder)["notes"])
    assert computed(folder) == computed(uninterrupted)
    assert result(folder)["metrics"] == result(uninterrupted)["metrics"]
    assert not (folder / CASE / "checkpoint.h5").exists()


def test_a_ladder_killed_on_its_second_rung_is_resumed_to_the_same_bytes(bar, tmp_path):
    bar.write_text(BAR.replace("value = [2.5]", "value = [5, 2.5]"))
    assert start(bar, tmp_path / "whole").returncode == 0
    interrupted(bar, tmp_path / "run", lambda process: process.kill(), "dx-2.5mm-h-1.3")
    assert start(bar, tmp_path / "run", "--resume").returncode == 0
    assert "Went on from a checkpoint" in " ".join(result(tmp_path / "run")["notes"])
    assert computed(tmp_path / "run") == computed(tmp_path / "whole")
    assert result(tmp_path / "run")["metrics"] == result(tmp_path / "whole")["metrics"]


def test_a_checkpoint_of_other_inputs_is_not_gone_on_from(bar, tmp_path):
    folder = tmp_path / "run"
    interrupted(bar, folder, lambda process: process.kill())
    bar.write_text(BAR.replace("value = 10, unit", "value = 11, unit"))
    ended = start(bar, folder, "--resume")
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert not any("checkpoint" in note for note in result(folder).get("notes", []))


def test_a_corrupt_checkpoint_is_named_and_nothing_is_lost(bar, tmp_path, uninterrupted):
    folder = tmp_path / "run"
    interrupted(bar, folder, lambda process: process.kill())
    checkpoint = folder / CASE / "checkpoint.h5"
    content = bytearray(checkpoint.read_bytes())
    content[len(content) // 2] ^= 1
    checkpoint.write_bytes(content)
    before = computed(folder)
    ended = start(bar, folder, "--resume")
    assert ended.returncode == 3
    reason = result(folder)["reason"]
    assert "checkpoint.h5" in reason and "is damaged" in reason and "remove it, and the case begins anew" in reason
    assert computed(folder) == before
    checkpoint.unlink()
    assert start(bar, folder, "--resume").returncode == 0
    assert computed(folder) == computed(uninterrupted)


def test_a_courant_number_of_3_is_stopped_with_time_particle_field_and_the_last_good_state(tmp_path):
    file, folder, case = tmp_path / "plate.toml", tmp_path / "run", "elastodynamics/wild-plate"
    file.write_text(PLATE)
    ended = start(file, folder)
    assert ended.returncode == 3
    reason = result(folder, case)["reason"]
    assert reason.startswith("t = ") and " particle " in reason and "last-good.vtkhdf" in reason
    assert any(field in reason for field in ("acceleration", "velocity", "stress", "density", "position"))
    with h5py.File(folder / case / "last-good.vtkhdf") as snapshot:
        assert snapshot["VTKHDF/NumberOfPoints"][0] > 100
    with h5py.File(folder / case / "history.h5") as history:
        assert len(history["time"]) >= 1


def limited(bytes_a_file):
    """For a child: no file longer than this, and no signal for it, so that writing fails as on a full disk."""
    def set_limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_a_file, bytes_a_file))
    return set_limit


def test_a_file_that_cannot_be_written_is_named_and_nothing_is_lost(bar, tmp_path):
    folder = tmp_path / "run"
    size = 40_000   # a result fits, a history without rows fits, a snapshot does not
    ended = subprocess.run([FURROW, "run", "--case-file", bar, "--no-report", "--out", folder], capture_output=True, text=True,
                           timeout=60, preexec_fn=limited(size))
    assert ended.returncode == 3, ended.stdout + ended.stderr
    reason = result(folder)["reason"]
    assert "snapshot-0000.vtkhdf" in reason and "cannot write: File too large" in reason
    assert not list(folder.rglob("*.part"))


def can_mount(folder):
    script = f"mount -t tmpfs -o size=64k none {folder}"
    return subprocess.run(["unshare", "--mount", "--map-root-user", "sh", "-c", script], capture_output=True).returncode == 0


def test_a_full_disk_is_named_and_earlier_results_stay(bar, tmp_path):
    disk = tmp_path / "disk"
    disk.mkdir()
    if not shutil.which("unshare") or not can_mount(disk):
        pytest.skip("no file system can be mounted here; the test above fills a file instead")
    # A disk with room for records and a history but not for all snapshots; the program and what it says stay outside.
    script = (f"mount -t tmpfs -o size=320k none {disk} && {FURROW} run --case-file {bar} --no-report --out {disk}/run; code=$?; "
              f"cp -r {disk}/run {tmp_path}/kept; exit $code")
    ended = subprocess.run(["unshare", "--mount", "--map-root-user", "sh", "-c", script], capture_output=True, text=True,
                           timeout=60)
    assert ended.returncode == 3, ended.stdout + ended.stderr
    kept = tmp_path / "kept"
    said = ended.stdout + ended.stderr + (json.dumps(result(kept)) if (kept / CASE / "result.json").exists() else "")
    assert "No space left on device" in said
    assert json.loads((kept / "run.json").read_text())["cases"] == [CASE]
    for snapshot in (kept / CASE).glob("*.vtkhdf"):
        with h5py.File(snapshot) as whole:
            assert "VTKHDF" in whole
    assert not list(kept.rglob("*.vtkhdf.part"))


def test_a_checkpoint_interval_that_is_none_is_refused(bar, tmp_path):
    ended = start(bar, tmp_path / "run", environment={"FURROW_CHECKPOINT_INTERVAL": "often"})
    assert ended.returncode == 2
    assert 'FURROW_CHECKPOINT_INTERVAL: found "often", expected seconds' in ended.stderr
