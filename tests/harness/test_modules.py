"""What a case says it exercises: joined by what ran, and an error where it did not."""

import json
import re
import subprocess

from tests.harness.program import FURROW, ROOT, run


def exercised(tmp_path, case):
    assert run(FURROW, "run", case, "--no-report", "--out", tmp_path / "run").returncode == 0
    return set(json.loads((tmp_path / "run" / case / "result.json").read_text())["exercises"])


def test_what_ran_is_named_without_being_declared(tmp_path):
    found = exercised(tmp_path, "elastodynamics/gravity-column-symmetry")
    assert {"boundaries/gravity", "boundaries/damping", "particles/images", "materials/linear_elastic", "simulation"} <= found
    assert not {"boundaries/wall", "materials/j2_plastic", "schemes/reference_frame"} & found


def test_a_module_that_did_not_run_is_an_error(tmp_path):
    ended = run(FURROW.with_name("furrow-misbehaving"), "run", "misbehaving/declares-more", "--no-report", "--out",
                tmp_path / "run")
    assert ended.returncode == 3
    data = json.loads((tmp_path / "run/misbehaving/declares-more/result.json").read_text())
    assert data["verdict"] == "error" and "it exercises schemes/momentum, which has not run" in data["reason"]


def test_declared_names_are_those_of_modules_or_files():
    """A misspelt name would never be found not to have run."""
    header = (ROOT / "solver/modules.hpp").read_text()
    known = set(re.findall(r'"((?:materials|schemes|particles|boundaries|integrators)/\w+|simulation)"', header))
    assert len(known) > 20
    sources = subprocess.run(["git", "-C", str(ROOT), "ls-files", "verification", "validation", "harness"], capture_output=True,
                             text=True)
    wrong = []
    for name in sources.stdout.split():
        if name.endswith(".cpp"):
            for module in re.findall(r'exercises\("([^"]+)"\)', (ROOT / name).read_text()):
                there = any((ROOT / f"solver/{module}.{end}").exists() for end in ("hpp", "cpp"))
                if module not in known and not there:
                    wrong.append(f"{name}: {module}")
    assert wrong == []
