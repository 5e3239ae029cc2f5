"""A folder with the files that the hidden test cases of furrow-tests write."""
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
PROGRAM = pathlib.Path(os.environ.get("FURROW_TESTS", ROOT / "build" / "release" / "furrow-tests"))


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("files")
    environment = {**os.environ, "FURROW_TEST_FOLDER": str(path)}
    run = subprocess.run([PROGRAM, "[.write-files]"], env=environment, capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
    return path
