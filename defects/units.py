"""A program with a defect in it, from as few compilations as are needed: the translation units whose code can differ are compiled
beside the clean ones, and linked in front of the clean libraries, which then give what is still missing. The clean build is left
as it is, so that nothing has to be mended.

A header that says what a soil is reaches nearly every unit, and few of them hold code of it. Which ones is read from line tables:
each unit that includes a changed header is once compiled with -g1, and it is affected if its object holds code of the header. A
header with numbers or functions that are folded at compile time leaves no line where it is used, as a kernel's normalisation; for
such a one it is enough that the object holds code of any header of the same folder.
"""

import concurrent.futures
import json
import os
import re
import shlex
import subprocess
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from gate.files import GateError

SOURCES = (".cpp", ".hpp")


@dataclass(frozen=True)
class Unit:
    source: str        # relative to the tree
    output: str        # its object, relative to the build folder
    command: tuple     # that compiles it, in the build folder


class Units:
    """Of a clean tree that is built: `folder` its root, `build` its build folder, `environment` and `jobs` of its compilers."""

    def __init__(self, folder, build, environment, jobs):
        self.folder, self.build, self.environment, self.jobs = Path(folder).resolve(), Path(build).resolve(), environment, jobs
        self.units = self._units()
        self.includes = self._includes()
        self._code = {}

    def _ninja(self, *words):
        return subprocess.run(["ninja", *words], cwd=self.build, capture_output=True, text=True, check=True).stdout

    def _units(self):
        wanted = set(self._ninja("-t", "inputs", "furrow-program").split())
        found = []
        for entry in json.loads((self.build / "compile_commands.json").read_text(encoding="utf-8")):
            words = tuple(shlex.split(entry["command"]))
            output = words[words.index("-o") + 1]
            if output in wanted:
                found.append(Unit(str(Path(entry["file"]).resolve().relative_to(self.folder)), output, words))
        return found

    def _includes(self):
        """output of a unit -> files of the tree that it reads, as the compiler said."""
        found, current = {}, None
        for line in self._ninja("-t", "deps").splitlines():
            if line and not line.startswith(" "):
                current = found.setdefault(line.split(":")[0], set())
            elif line.strip():
                path = Path(os.path.normpath(self.build / line.strip()))
                if path.is_relative_to(self.folder):
                    current.add(str(path.relative_to(self.folder)))
        return found

    def affected(self, files):
        """Units whose code may differ when these files of the tree change, which they have not yet; None where that is not to be
        said, as for a file that is no source. GateError when a clean unit does not compile."""
        if any(PurePosixPath(f).suffix not in SOURCES for f in files):
            return None
        readers = {u.output: u for u in self.units if self.includes.get(u.output, set()) & set(files) and u.source not in files}
        self._trace([u for u in readers.values() if u.output not in self._code])
        trace = {f: str(PurePosixPath(f).parent) if folds(self.folder / f) else PurePosixPath(f).name for f in files}
        return [u for u in self.units
                if u.source in files or u.output in readers and any(trace[f] in self._code[u.output]
                                                                    for f in self.includes[u.output] & set(files))]

    def _trace(self, units):
        """Learns whose code the objects of these units hold."""
        objects, why = self.compile(units, self.build.parent / "traces", ["-g1"])
        if why:
            raise GateError(f"the clean tree does not build: {why}", 3)
        for output, path in objects.items():
            words = ["readelf", "-p", ".debug_line_str", str(path)]
            self._code[output] = names_in(subprocess.run(words, capture_output=True, text=True, check=True, errors="replace").stdout)

    def compile(self, units, into, more=()):
        """Compiles `units` into the folder `into`, with `more` options: (output of each -> its object there, ''), or ({}, the
        first complaint)."""
        def one(unit):
            out = into / unit.output.replace("/", "-")
            words = list(unit.command)
            words[words.index("-o") + 1] = str(out)
            at = words.index("-c")
            words[at:at] = more
            return unit.output, out, complaint(words, self.build, self.environment)
        into.mkdir(parents=True, exist_ok=True)
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            results = list(pool.map(one, units))
        why = next((why for _, _, why in results if why), "")
        return ({}, why) if why else ({output: out for output, out, _ in results}, "")

    def link(self, objects, program):
        """Links `program` with these objects in the place of the clean ones; '' or the linker's first complaint."""
        words = [w for w in shlex.split(self._ninja("-t", "commands", "furrow-program").strip().splitlines()[-1])
                 if w not in (":", "&&") and w not in objects]
        at = words.index("-o")
        words[at + 1] = str(program)
        words[at:at] = [str(o) for o in objects.values()]
        return complaint(words, self.build)


def complaint(words, folder, environment=None):
    """Runs a compiler or linker; '' when it succeeded, else its first error."""
    done = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode == 0:
        return ""
    lines = (done.stdout + done.stderr).splitlines()
    first = next((k for k, line in enumerate(lines) if "error" in line.lower()), None)
    # a compiler shows the line of source below its complaint
    return "\n".join(lines[first:first + 2]) if first is not None else f"'{' '.join(words)[:200]}' failed"


def folds(header):
    """Whether a header holds numbers or functions that leave no line of code where they are used."""
    return header.exists() and re.search(r"\bconstexpr (double|int|bool|auto|Real)\b", header.read_text(encoding="utf-8")) is not None


def names_in(text):
    """Names of files, and folders of the tree, among the strings of a line table (readelf -p .debug_line_str)."""
    strings = re.findall(r"^\s*\[\s*[0-9a-f]+\]\s+(\S+)$", text, re.M)
    folders = (re.search(r"/((?:solver|harness|reference|verification|validation)(?:/[\w-]+)*)$", s) for s in strings)
    return {s for s in strings if "/" not in s} | {found[1] for found in folders if found}
