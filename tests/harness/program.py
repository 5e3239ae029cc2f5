"""The built programs, for tests that drive them from outside. FURROW_BUILD names another build folder than build/release."""

import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("FURROW_BUILD", ROOT / "build/release")).resolve()
FURROW = BUILD / "furrow-program"
MISBEHAVING = BUILD / "furrow-misbehaving"


def run(program, *arguments, cwd=None, environment=None):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=120, cwd=cwd,
                          env=os.environ | (environment or {}))
