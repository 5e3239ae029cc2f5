"""The kill matrix as a page: planted defects against the cases that ran on them. Reads DIR/kills.json, writes DIR/page/."""

import shutil
from pathlib import Path

import jinja2

from reports import numbers
from reports.results import ReportError, read_json

HERE = Path(__file__).resolve().parent
WORDS = {"killed": "killed", "changed": "change alone", "survived": "survived", "equivalent": "equivalent",
         "passed": "right, passed", "error": "error"}
COLOURS = {"killed": "green", "changed": "yellow", "survived": "red", "equivalent": "", "passed": "green", "error": "red"}


def build(folder):
    """Writes the page and returns its path. ReportError when there is no kill matrix."""
    folder = Path(folder)
    try:
        data = read_json(folder / "kills.json")
        defects, tiers = data["defects"], data["tiers"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ReportError(f"{folder}: no kill matrix: {error}") from None
    page = folder / "page"
    page.mkdir(exist_ok=True)
    shutil.copytree(HERE / "assets", page / "assets", dirs_exist_ok=True)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE / "templates"), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    cases = sorted({k["case"] for d in defects for k in d["seen"] if k["by"]})
    order = {"error": 0, "survived": 1, "changed": 2, "killed": 3, "equivalent": 4, "passed": 5}
    (page / "index.html").write_text(environment.get_template("kills.html").render(
        defects=sorted(defects, key=lambda d: (order[d["state"]], d["modules"], d["name"])), tiers=tiers, rates=data["rates"],
        commit=data["commit"],
        cases=cases, words=WORDS, colours=COLOURS, moved=moved, number=numbers.number, root=""), encoding="utf-8")
    return page / "index.html"


def moved(x):
    """A relative move in words."""
    if x is None:
        return ""
    return "no number" if x == "infinite" else f"{numbers.number(100.0 * x, 2)}\u202f%"
