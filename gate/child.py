"""Running the program: a run that its caller's death ends too."""

import ctypes
import os
import signal
import subprocess

from gate.files import ROOT


def program():
    """The program that this command came from, or the entry script."""
    return os.environ.get("FURROW_PROGRAM") or str(ROOT / "furrow")


def _end_with_parent():
    set_death_signal = 1
    ctypes.CDLL(None).prctl(set_death_signal, signal.SIGTERM)


def run(arguments):
    """Exit code of the program; negative or 130 when it was stopped. It ends when this process does, even by kill -9, and leaves
    a run that can be resumed."""
    return subprocess.run([program(), *arguments], preexec_fn=_end_with_parent).returncode
