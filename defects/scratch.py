"""Scratch trees: copies of one commit. In one of them nearly all defects are planted at once, behind switches (switches.py). In the
other, which is built as it is, a defect that cannot be switched is applied, what it changes is compiled beside the clean objects,
and the tree is mended. One compiler cache serves them all."""

import contextlib
import os
import re
import shutil
import subprocess
from pathlib import Path

from defects import switches
from defects.units import Units, complaint
from gate.files import ROOT, GateError


def _git(cwd, *words):
    return subprocess.run(["git", *words], cwd=cwd, capture_output=True, text=True)


class Tree:
    """Of the project in ROOT, in a folder of its build/."""

    def __init__(self, commit="HEAD", jobs=None, name="defects"):
        self.root, self.folder, self.jobs = ROOT, ROOT / "build" / name, jobs or os.cpu_count() or 1
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

    def run(self, words, **environment):
        """Exit code of the tree's own program."""
        return subprocess.run([str(self.program), *words], cwd=self.folder, env=os.environ | environment,
                              stdout=subprocess.DEVNULL).returncode


class SwitchedTree(Tree):
    """With all defects in it that can be switched on by the environment, and with parameters that it takes factors for."""

    factors = Path(__file__).with_name("factors.patch")

    def __init__(self, commit="HEAD", jobs=None):
        super().__init__(commit, jobs, "switched")
        self.base = {}      # texts of the files that take factors, before anything is planted
        self.numbers = {}   # of the defects that are in it, by name
        self.left = {}      # of an earlier hunt: file -> (text, time)

    def plant(self, defects):
        """Builds the program with what can be planted of `defects`, number -> Defect; what spoils the compilation is taken out
        again. '' or the compiler's first complaint that names no defect."""
        known = {n: (d.name, d.path.read_text(encoding="utf-8").partition("\n\n")[2]) for n, d in defects.items()}
        while True:
            files, planted, _ = switches.plan(known, self._clean_text)
            self.numbers = {known[n][0]: n for n in planted}
            if not planted:
                return ""
            self._write({**self.base, **files, switches.HEADER: switches.HEADER_TEXT})
            if not (why := self.build()):
                return ""
            guilty = {int(n) for n in re.findall(r"furrow::planted\((\d+)\)", why)}
            if not guilty & planted:
                return why
            known = {n: known[n] for n in known.keys() - guilty}

    def prepare(self):
        """As of any tree, but files keep their texts, so that what is planted again is not compiled again."""
        before = {f: (self.folder / f).read_text(encoding="utf-8") for f in self._changed()}
        times = {f: (self.folder / f).stat().st_mtime_ns for f in before}
        super().prepare()
        self.left = {f: (text, times[f]) for f, text in before.items()}
        if not self.factors.exists():
            return
        if (done := _git(self.folder, "apply", str(self.factors))).returncode != 0:
            raise GateError(f"{self.factors.name}: does not apply: {(done.stderr.strip().splitlines() or [''])[-1]}", 3)
        self.base = {f: (self.folder / f).read_text(encoding="utf-8") for f in self._changed()}
        _git(self.folder, "checkout", "-q", "--", ".")

    def _changed(self):
        shown = _git(self.folder, "status", "--porcelain", "--untracked-files=all") if (self.folder / ".git").exists() else None
        names = [line[3:] for line in shown.stdout.splitlines()] if shown else []
        return [n for n in names if n.endswith((".cpp", ".hpp")) and (self.folder / n).is_file()]

    def _write(self, files):
        for name, text in files.items():
            place = self.folder / name
            if not place.exists() or place.read_text(encoding="utf-8") != text:
                place.write_text(text, encoding="utf-8")
                if self.left.get(name, ("", 0))[0] == text:
                    os.utime(place, ns=(self.left[name][1],) * 2)

    def _clean_text(self, file):
        if file in self.base:
            return self.base[file]
        shown = _git(self.folder, "show", f"{self.commit}:{file}")
        return shown.stdout if shown.returncode == 0 else None
