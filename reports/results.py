"""Result files: read, validated, never dropped. What cannot be read or contradicts itself is a case with verdict `error`."""

import json
import math
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import jsonschema

from reports.margins import Margin, margin

SCHEMA_FILE = Path(__file__).resolve().parent.parent / "harness" / "schema" / "result-1.json"
VERDICTS = ("error", "fail", "known-gap", "pass")   # the order in which cases are shown: reds first
CLASSES = ("exact", "manufactured", "independent", "experiment", "published", "self")


class ReportError(Exception):
    """The report cannot be made at all; the message is for the person who asked for it."""


@dataclass
class Case:
    """One case of a run as the report shows it; `data` is the result file, or what could be read of it."""
    id: str
    folder: Path
    data: dict
    verdict: str
    faults: list = field(default_factory=list)   # why the report does not believe the file; then verdict is `error`
    page: str = ""                               # path of the case's page inside the report

    @property
    def family(self):
        return self.data.get("family") or self.id.split("/")[0]

    @property
    def title(self):
        title = self.data.get("title") or self.id
        return title[0].upper() + title[1:]

    @property
    def reason(self):
        """Why the case is not green: the report's own finding first, then the file's, then those of its metrics."""
        if self.faults:
            return " ".join(self.faults)
        if self.data.get("reason"):
            return self.data["reason"]
        if self.verdict == "pass":
            return ""
        return "; ".join(m["reason"] for m in self.data["metrics"] if m["verdict"] == self.verdict and m.get("reason"))

    @cached_property
    def metrics(self):
        """(metric, margin) in the file's order."""
        return [(m, margin_of(m)) for m in self.data.get("metrics", [])]

    @property
    def classes(self):
        gated = {m["class"] for m, _ in self.metrics if m["verdict"] not in ("reported", "skipped")}
        found = gated or {m["class"] for m, _ in self.metrics}
        return [c for c in CLASSES if c in found]

    @property
    def only_self(self):
        """Whether nothing but the project's own earlier results stands behind the verdict."""
        gated = {m["class"] for m, _ in self.metrics if m["verdict"] not in ("reported", "skipped")}
        return gated == {"self"}

    @property
    def worst(self):
        """The metric that decides: a red one without a number, else the one that uses most of its band; None without a gate."""
        gated = [(m, p) for m, p in self.metrics if m["verdict"] not in ("reported", "skipped")]
        return max(gated, key=lambda pair: (VERDICTS[::-1].index(pair[0]["verdict"]), severity(pair[1])), default=None)


@dataclass
class Run:
    folder: Path
    data: dict         # run.json, {} when it is missing or unreadable
    faults: list       # what is wrong with run.json
    cases: list        # reds first, then by name

    @property
    def provenance(self):
        """Of the run; when run.json has none, of the first case that has one."""
        candidates = [self.data.get("provenance"), self.data] + [c.data.get("provenance") for c in self.cases]
        return next((p for p in candidates if isinstance(p, dict) and "commit" in p), {})


def severity(m):
    return -1.0 if m is None or m.use is None else m.use


def gated_number(metric):
    """The number that the band speaks about: the value itself for norm `value`, the error for every other norm."""
    return metric["value"] if metric["norm"].split()[-1:] == ["value"] else metric["error"]


def margin_of(metric) -> Margin | None:
    if metric["band"] is None:
        return None
    return margin(gated_number(metric), metric["band"])


def _not_a_number(word):
    raise ValueError(f"{word} is not JSON; a result that is not finite is written as null")


def read_json(path):
    """Parsed JSON; ValueError with one sentence for anything that is not strict JSON in UTF-8."""
    try:
        return json.loads(path.read_text(encoding="utf-8"), parse_constant=_not_a_number)
    except UnicodeDecodeError as error:
        raise ValueError(f"not UTF-8: {error.reason} at byte {error.start}") from None
    except json.JSONDecodeError as error:
        raise ValueError(f"not JSON: {error.msg} at line {error.lineno}, column {error.colno}") from None


def _validator():
    """The schema's validator, with a short cut for long arrays of numbers, which are nearly all of a result file."""
    schema = json.loads(SCHEMA_FILE.read_text(encoding="utf-8"))
    schema.pop("$id", None)   # a relative id makes jsonschema look for the schema's own $defs outside the file
    plain = jsonschema.Draft202012Validator
    number = (int, float, type(None))

    def items(validator, items_schema, instance, parent):
        if isinstance(instance, list) and items_schema == {"$ref": "#/$defs/number_or_null"}:
            if all(type(x) in number for x in instance):
                return
        yield from plain.VALIDATORS["items"](validator, items_schema, instance, parent)

    return jsonschema.validators.extend(plain, {"items": items})(schema)


def faults_of(data):
    """Sentences about what in a valid result contradicts its own verdict; a green that means nothing is not shown as green."""
    faults = []
    metrics = data["metrics"]
    if data["verdict"] == "pass" and not any(m["verdict"] == "pass" for m in metrics):
        faults.append("The result says pass, but no metric passed.")
    for m in metrics:
        if data["verdict"] == "pass" and m["verdict"] in ("fail", "error", "known-gap"):
            faults.append(f"The result says pass, but its metric {m['name']} says {m['verdict']}.")
        if m["verdict"] == "pass":
            number = gated_number(m)
            if m["band"] is None:
                faults.append(f"Metric {m['name']} says pass, but has no band.")
            elif number is None or not math.isfinite(number):
                faults.append(f"Metric {m['name']} says pass, but produced no number.")
            elif not margin_of(m).inside:
                faults.append(f"Metric {m['name']} says pass, but {number:.4g} is outside its band.")
        if m["verdict"] == "skipped" and not m.get("reason"):
            faults.append(f"Metric {m['name']} was skipped without a reason.")
    return faults


def _load_case(path, root, validator):
    folder = path.parent
    expected = folder.relative_to(root).as_posix()
    expected = root.name if expected == "." else expected
    try:
        data = read_json(path)
    except ValueError as error:
        return Case(expected, folder, {}, "error", [f"result.json is {error}." if str(error).startswith("not")
                                                    else f"result.json: {error}."])
    problem = jsonschema.exceptions.best_match(validator.iter_errors(data))
    if problem is not None:
        place = "/".join(str(p) for p in problem.absolute_path) or "the top level"
        message = problem.message if len(problem.message) <= 300 else problem.message[:300] + "…"
        kept = {key: data[key] for key in ("title", "why", "family") if isinstance(data, dict) and isinstance(data.get(key), str)}
        return Case(expected, folder, kept, "error", [f"result.json does not follow the schema, at {place}: {message}."])
    faults = faults_of(data)
    return Case(data["case"], folder, data, "error" if faults else data["verdict"], faults)


def _expected_cases(run_data):
    """Ids that run.json announces, so that a case which left no file is still shown."""
    announced = run_data.get("cases", [])
    if not isinstance(announced, list):
        return []
    ids = [c if isinstance(c, str) else c.get("case", c.get("id")) if isinstance(c, dict) else None for c in announced]
    return [i for i in ids if isinstance(i, str)]


def load(folder):
    """Reads a run folder. ReportError when it is not one: no run.json and not a single result.json."""
    root = Path(folder)
    if not root.is_dir():
        raise ReportError(f"{root}: no such folder")
    data, faults = {}, []
    run_file = root / "run.json"
    if run_file.exists():
        try:
            data = read_json(run_file)
            if not isinstance(data, dict):
                data, faults = {}, ["run.json is not an object."]
        except ValueError as error:
            faults.append(f"run.json: {error}.")
    else:
        faults.append("run.json is missing: the run did not come to its end.")

    if data.get("state") in ("running", "interrupted"):
        faults.append("The run was interrupted: cases that did not come to their turn are shown as error.")
    own = {"report"}
    paths = sorted(p for p in root.rglob("result.json")
                   if not any(part in own or part.startswith(".") for part in p.relative_to(root).parts[:1]))
    if not paths and not run_file.exists():
        raise ReportError(f"{root}: not the folder of a run, it has neither run.json nor a result.json")

    validator = _validator()
    cases = [_load_case(path, root, validator) for path in paths]
    seen = {}
    for case in cases:
        if case.id in seen:
            case.faults.append(f"{seen[case.id]} claims to be the same case.")
            case.verdict = "error"
        seen.setdefault(case.id, case.folder.relative_to(root).as_posix())
    for missing in _expected_cases(data):
        if missing not in seen:
            cases.append(Case(missing, root / missing, {}, "error", ["The run announced this case, but it left no result.json."]))
            seen[missing] = missing
    cases.sort(key=lambda c: (VERDICTS.index(c.verdict), c.id))
    return Run(root, data, faults, cases)
