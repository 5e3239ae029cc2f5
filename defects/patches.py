"""Patches in tests/defects/: a head of `Key: value` lines, an empty line, then the difference.

  Wrong: what is wrong, in a sentence             (required, or:)
  Right: why nothing that matters changes         (a change that is right and must not be red: no defect, but the gate's own test)
Module: schemes/momentum, simulation            (required; as in results' `exercises`: cases that exercise one of them are run;
                                                   `harness/...`: all cases are)
  Subtle: yes                                     (required: yes or no; yes: no smoke metric moves by more than 5 % of its truth)
  Source: the paper's Eq. 21                      (optional: who printed or made this wrong)
  Equivalent: why no number can change            (optional: the defect cannot be caught, and this is the proof)

A line that begins with a space goes on with the one before.
"""

import hashlib
import subprocess
from dataclasses import dataclass
from pathlib import Path

from gate.files import ROOT, GateError

FOLDER = ROOT / "tests" / "defects"
KEYS = {"Wrong", "Right", "Module", "Subtle", "Source", "Equivalent"}


@dataclass(frozen=True)
class Defect:
    name: str
    path: Path
    wrong: str
    modules: tuple
    subtle: bool
    source: str
    equivalent: str
    hash: str        # of the difference: its head may be put better
    right: bool = False

    reach: int = 0   # how far it reaches: 0 sources alone, 1 a header, 2 what is no source, such as the build itself

    def touches(self, exercises):
        """Whether a case with these modules is one that may catch it."""
        return any(m.startswith("harness") or m in exercises for m in self.modules)


def read(path):
    """A Defect; GateError names what its head lacks."""
    text = path.read_text(encoding="utf-8")
    head, _, difference = text.partition("\n\n")
    fields, last = {}, None
    for number, line in enumerate(head.splitlines(), 1):
        if line.startswith(" ") and last:
            fields[last] += " " + line.strip()
            continue
        key, colon, value = line.partition(": ")
        if not colon or key not in KEYS or key in fields:
            raise GateError(f"{path}:{number}: expected one of {', '.join(sorted(KEYS))}, once each, and found {line[:60]!r}")
        fields[key], last = value.strip(), key
    right = "Right" in fields
    if right:
        fields = {"Subtle": "no", "Wrong": fields["Right"], **fields}
    for key in ("Wrong", "Module", "Subtle"):
        if not fields.get(key):
            raise GateError(f"{path}: its head lacks '{key}: ...'")
    if fields["Subtle"] not in ("yes", "no"):
        raise GateError(f"{path}: Subtle is yes or no, and not {fields['Subtle']!r}")
    if not difference.startswith("diff --git "):
        raise GateError(f"{path}: an empty line and 'diff --git ...' come after the head")
    return Defect(path.stem, path, fields["Wrong"], tuple(m.strip() for m in fields["Module"].split(",")),
                  fields["Subtle"] == "yes",
                  fields.get("Source", ""), fields.get("Equivalent", ""), hashlib.sha256(difference.encode()).hexdigest(), right,
                  reach_of(difference))


def reach_of(difference):
    suffixes = {Path(line.removeprefix("+++ b/")).suffix for line in difference.splitlines() if line.startswith("+++ ")}
    return 0 if suffixes <= {".cpp"} else 1 if suffixes <= {".cpp", ".hpp"} else 2


def read_all(folder=FOLDER):
    return [read(path) for path in sorted(Path(folder).glob("*.patch"))]


def does_not_apply(defect, tree):
    """Why the patch does not apply to `tree`; '' when it does."""
    done = subprocess.run(["git", "apply", "--check", str(defect.path.resolve())], cwd=tree, capture_output=True, text=True)
    return "" if done.returncode == 0 else (done.stderr.strip().splitlines() or ["git apply failed"])[-1]
