"""The runner: whatever happens to one case is red, says why, and costs only that case."""

import json
import signal
import subprocess
import time
import xml.etree.ElementTree as ET

import jsonschema
import pytest

from tests.harness.program import FURROW, MISBEHAVING, ROOT, run

SCHEMA = json.loads((ROOT / "harness/schema/result-1.json").read_text())


def result(folder, case):
    return json.loads((folder / "misbehaving" / case / "result.json").read_text())


def children_of(process):
    with open(f"/proc/{process.pid}/task/{process.pid}/children") as listed:
        return [int(child) for child in listed.read().split()]


def alive(process):
    """Runs still; one that has ended and waits to be collected does not."""
    try:
        with open(f"/proc/{process}/stat") as stat:
            return stat.read().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


@pytest.fixture(scope="module")
def everything(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run") / "all"
    ended = run(MISBEHAVING, "matrix", "--tier", "smoke", "--jobs", "2", "--no-report", "--out", folder)
    return folder, ended


def test_the_run_ends_as_error_and_every_case_has_a_valid_result(everything):
    folder, ended = everything
    assert ended.returncode == 3, ended.stderr
    announced = json.loads((folder / "run.json").read_text())["cases"]
    for case in announced:
        data = json.loads((folder / case / "result.json").read_text())
        jsonschema.Draft202012Validator(SCHEMA).validate(data)
        assert data["case"] == case
    assert len(announced) == 17


@pytest.mark.parametrize("case, verdict, reason", [
    ("good", "pass", ""),
    ("too-long", "fail", ""),
    ("throws", "error", "the time step fell to zero"),
    ("aborts", "error", "killed by signal 6"),
    ("killed", "error", "killed by signal 9"),
    ("leaves", "error", "it left no result"),
    ("half-result", "error", "it left no result"),
    ("never-ends", "error", "ran longer than its time limit of 1.5 s"),
    ("measures-nan", "error", "length: no finite number"),
    ("measures-nothing", "error", "the code does not measure it"),
    ("measures-more", "error", "the code measures 'width', which the case file does not name"),
    ("measures-twice", "error", "measured twice"),
    ("measures-seconds", "error", 'measured in "s" (dimension s), but the case file says "mm" (dimension m)'),
    ("skips", "error", "no metric of the case was gated"),
    ("skips-silently", "error", "skipped without a reason"),
    ("no-metric", "error", "the case has no metric"),
    ("declares-more", "error", "says that it exercises schemes/momentum, which has not run"),
])
def test_verdict_and_reason(everything, case, verdict, reason):
    data = result(everything[0], case)
    assert data["verdict"] == verdict
    assert reason in data.get("reason", "")
    assert all(m["verdict"] != "pass" for m in data["metrics"]) or verdict == "pass" or case == "measures-more"


def test_junit_has_a_test_case_for_each_metric(everything):
    folder, _ = everything
    suites = ET.parse(folder / "junit.xml").getroot()
    assert int(suites.get("failures")) == 1
    assert len(suites.findall("testsuite")) == 17
    good = next(s for s in suites if s.get("name") == "misbehaving/good")
    assert [c.get("name") for c in good.findall("testcase")] == ["length"]
    assert good.find("testcase/failure") is None and good.find("testcase/error") is None
    aborts = next(s for s in suites if s.get("name") == "misbehaving/aborts")
    assert "signal 6" in aborts.find("testcase/error").get("message")


def test_provenance_is_whole(everything):
    provenance = json.loads((everything[0] / "run.json").read_text())["provenance"]
    for key in ("commit", "dirty", "compiler", "flags", "threads", "cpu", "packages", "started", "program"):
        assert provenance[key] not in ("", None), key
    assert result(everything[0], "good")["provenance"]["inputs"]


def test_a_red_metric_alone_is_exit_code_1_and_none_is_0(tmp_path):
    assert run(MISBEHAVING, "run", "misbehaving/too-long", "--no-report", "--out", tmp_path / "a").returncode == 1
    assert run(MISBEHAVING, "run", "misbehaving/good", "--no-report", "--out", tmp_path / "b").returncode == 0


def test_quiet_prints_nothing(tmp_path):
    ended = run(MISBEHAVING, "run", "misbehaving/good", "misbehaving/aborts", "--no-report", "--quiet", "--out", tmp_path / "run")
    assert (ended.stdout, ended.stderr) == ("", "")


def test_resume_keeps_what_is_whole_and_runs_the_rest(tmp_path):
    cases = ["misbehaving/good", "misbehaving/too-long", "misbehaving/aborts"]
    arguments = ["run", *cases, "--no-report", "--out", tmp_path / "run"]
    run(MISBEHAVING, *arguments)
    good = tmp_path / "run/misbehaving/good/result.json"
    too_long = tmp_path / "run/misbehaving/too-long/result.json"
    before = good.stat().st_mtime_ns
    too_long.write_text('{"schema": 1, "case": "misb')
    ended = run(MISBEHAVING, *arguments, "--resume")
    assert ended.returncode == 3
    assert "(1 kept from before)" in ended.stdout
    assert good.stat().st_mtime_ns == before
    assert json.loads(too_long.read_text())["verdict"] == "fail"


def test_resume_runs_again_what_a_changed_material_file_describes(tmp_path):
    blocks = (ROOT / "verification/material-point/cases.toml").read_text().split("[[case]]")
    assert 'material = "6061-t6"' in blocks[1]
    block = blocks[1].replace('name = "johnson-cook-slow-{path}"', 'name = "beside-{path}"')
    (tmp_path / "case.toml").write_text('family = "material-point"\n[[case]]' + block)
    material = tmp_path / "6061-t6.toml"   # a material beside the case file comes before the project's own
    material.write_bytes((ROOT / "reference/materials/6061-t6.toml").read_bytes())
    arguments = ["run", "--case-file", tmp_path / "case.toml", "material-point/beside-tension", "--no-report", "--out",
                 tmp_path / "run"]
    assert run(FURROW, *arguments).returncode == 0
    assert "(1 kept from before)" in run(FURROW, *arguments, "--resume").stdout
    material.write_text(material.read_text() + "# looked at again\n")
    assert "kept from before" not in run(FURROW, *arguments, "--resume").stdout
    assert "(1 kept from before)" in run(FURROW, *arguments, "--resume").stdout


def test_an_earlier_run_is_not_overwritten_by_accident(tmp_path):
    arguments = ["run", "misbehaving/good", "--no-report", "--out", tmp_path / "run"]
    run(MISBEHAVING, *arguments)
    before = (tmp_path / "run/run.json").read_text()
    ended = run(MISBEHAVING, *arguments)
    assert ended.returncode == 2
    assert "--resume" in ended.stderr and "--replace" in ended.stderr
    assert (tmp_path / "run/run.json").read_text() == before
    assert run(MISBEHAVING, *arguments, "--replace").returncode == 0


def test_an_interrupt_stops_the_children_and_keeps_what_is_done(tmp_path):
    folder = tmp_path / "run"
    process = subprocess.Popen([MISBEHAVING, "run", "misbehaving/good", "misbehaving/never-ends", "--jobs", "2", "--no-report",
                                "--out", folder, "--set", "time_limit.value=60"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    done = folder / "misbehaving/good/result.json"
    deadline = time.monotonic() + 20
    while not done.exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    time.sleep(0.2)
    children = children_of(process)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=20)
    assert process.returncode == 130
    assert json.loads(done.read_text())["verdict"] == "pass"
    assert json.loads((folder / "run.json").read_text())["state"] == "interrupted"
    assert (folder / "junit.xml").exists()
    assert not (folder / "misbehaving/never-ends/result.json").exists()
    assert children
    assert not any(alive(child) for child in children)


def test_a_run_that_is_killed_leaves_whole_results_no_children_and_can_be_resumed(tmp_path):
    folder = tmp_path / "run"
    cases = ["misbehaving/good", "misbehaving/never-ends", "--no-report", "--out", folder]
    process = subprocess.Popen([MISBEHAVING, "run", *cases, "--jobs", "2"], stdout=subprocess.DEVNULL)
    done = folder / "misbehaving/good/result.json"
    deadline = time.monotonic() + 20
    while not done.exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    children = children_of(process)
    process.kill()
    process.wait(timeout=20)
    assert json.loads(done.read_text())["verdict"] == "pass"
    deadline = time.monotonic() + 10
    while any(alive(child) for child in children) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not any(alive(child) for child in children)

    ended = run(MISBEHAVING, "run", *cases, "--resume")
    assert ended.returncode == 3
    assert "(1 kept from before)" in ended.stdout
    assert json.loads((folder / "run.json").read_text())["state"] == "finished"


def test_a_report_that_fails_is_said_and_is_exit_code_3(tmp_path):
    ended = run(MISBEHAVING, "run", "misbehaving/good", "--out", tmp_path / "run", environment={"PYTHONHOME": "/nonexistent"})
    assert ended.returncode == 3
    assert "the report failed" in ended.stderr
    assert json.loads((tmp_path / "run/run.json").read_text())["exit_code"] == 3
