"""A scratch tree: a copy of one commit that is built, spoilt by a patch, built again and mended. One compiler cache serves them
all, and only what a patch changes is compiled."""

import contextlib
import os
import shutil
import subprocess

from gate.files import ROOT, GateError


def _git(cwd, *words):
    return subprocess.run(["git", *words], cwd=cwd, capture_output=True, text=True)


class Tree:
    """Of the project in ROOT, in its build/defects."""

    def __init__(self, commit="HEAD", jobs=None):
        self.root, self.folder, self.jobs = ROOT, ROOT / "build" / "defects", jobs or os.cpu_count() or 1
        known = _git(self.root, "rev-parse", commit)
        if known.returncode != 0:
            raise GateError(f"{commit}: no commit of this repository")
        self.commit = known.stdout.strip()

    @property
    def program(self):
        return self.folder / "build" / "release" / "furrow-program"

    def prepare(self):
        """Brings the tree to its commit, whatever was left in it, and keeps what was built."""
        if (self.folder / ".git").exists():
            for words in (("reset", "-q", "--hard", self.commit), ("clean", "-q", "-fd", "-e", "build")):
                if _git(self.folder, *words).returncode != 0:
                    shutil.rmtree(self.folder)
                    break
        if not (self.folder / ".git").exists():
            self.folder.parent.mkdir(parents=True, exist_ok=True)
            done = _git(self.root, "clone", "-q", "--shared", "--no-checkout", str(self.root), str(self.folder))
            if done.returncode == 0:
                done = _git(self.folder, "checkout", "-q", "--detach", self.commit)
            if done.returncode != 0:
                raise GateError(f"{self.folder}: no scratch tree: {done.stderr.strip()}", 3)

    def build(self):
        """'' when the program was built, else the compiler's last words."""
        environment = os.environ | {"CCACHE_BASEDIR": str(self.folder.parent), "CCACHE_NOHASHDIR": "1"}
        for words in (["cmake", "--preset", "release"],
                      ["cmake", "--build", "--preset", "release", "--target", "furrow-program", "-j", str(self.jobs)]):
            if words[1] == "--preset" and (self.folder / "build/release/build.ninja").exists():
                continue
            done = subprocess.run(words, cwd=self.folder, env=environment, capture_output=True, text=True)
            if done.returncode != 0:
                lines = [line for line in (done.stdout + done.stderr).splitlines() if "error" in line.lower()]
                return (lines or [f"'{' '.join(words)}' failed"])[0]
        return ""

    @contextlib.contextmanager
    def spoilt(self, defect):
        """The tree with the defect in it; mended afterwards."""
        patch = str(defect.path.resolve())
        done = _git(self.folder, "apply", patch)
        if done.returncode != 0:
            raise GateError(f"{defect.name}: does not apply: {(done.stderr.strip().splitlines() or [''])[-1]}", 3)
        try:
            yield
        finally:
            _git(self.folder, "checkout", "-q", "--", ".")
            _git(self.folder, "clean", "-q", "-fd", "-e", "build")

    def run(self, words):
        """Exit code of the tree's own program."""
        return subprocess.run([str(self.program), *words], cwd=self.folder, stdout=subprocess.DEVNULL).returncode
