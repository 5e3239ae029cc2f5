"""A scratch tree: a copy of one commit that is built once; then each defect is applied, what it changes is compiled beside the
clean objects, and the tree is mended. One compiler cache serves them all."""

import contextlib
import os
import shutil
import subprocess

from defects.units import Units, complaint
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
        self.built = self.folder / "build" / "release"
        self.program = self.built / "furrow-program"
        self.units = None
        self.environment = os.environ | {"CCACHE_BASEDIR": str(self.folder.parent), "CCACHE_NOHASHDIR": "1"}

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
        """Builds the whole program; '' or the compiler's first complaint."""
        for words in (["cmake", "--preset", "release"],
                      ["cmake", "--build", "--preset", "release", "--target", "furrow-program", "-j", str(self.jobs)]):
            if words[1] == "--preset" and (self.built / "build.ninja").exists():
                continue
            if why := complaint(words, self.folder, self.environment):
                return why
        self.program = self.built / "furrow-program"
        return ""

    @contextlib.contextmanager
    def spoilt(self, defect):
        """The tree with the defect in it, built: yields '' or the compiler's first complaint. Mended afterwards."""
        patch = str(defect.path.resolve())
        files = [line.split("\t")[2] for line in _git(self.folder, "apply", "--numstat", patch).stdout.splitlines()]
        if (self.built / "compile_commands.json").exists() and self.units is None:
            self.units = Units(self.folder, self.built, self.environment, self.jobs)
        units = self.units.affected(files) if self.units else None
        before = {f: os.stat(self.folder / f).st_mtime_ns for f in files if (self.folder / f).exists()}
        done = _git(self.folder, "apply", patch)
        if done.returncode != 0:
            raise GateError(f"{defect.name}: does not apply: {(done.stderr.strip().splitlines() or [''])[-1]}", 3)
        try:
            yield self.build() if units is None else self._build_beside(units)
        finally:
            _git(self.folder, "checkout", "-q", "--", ".")
            _git(self.folder, "clean", "-q", "-fd", "-e", "build")
            if units is None:   # the clean objects are gone
                self.build()
            else:
                for name, moment in before.items():
                    os.utime(self.folder / name, ns=(moment, moment))
            self.program = self.built / "furrow-program"

    def _build_beside(self, units):
        beside = self.folder / "build" / "spoilt"
        shutil.rmtree(beside, ignore_errors=True)
        objects, why = self.units.compile(units, beside)
        self.program = beside / "furrow-program"
        return why or self.units.link(objects, self.program)

    def run(self, words):
        """Exit code of the tree's own program."""
        return subprocess.run([str(self.program), *words], cwd=self.folder, stdout=subprocess.DEVNULL).returncode
