"""Pages: one index, one page a case, written beside the old report and put in its place in one step."""

import ctypes
import errno
import multiprocessing
import os
import re
import shutil
from pathlib import Path
from urllib.parse import quote

import jinja2

from reports import changes, claims, kills, numbers, results, studies, summary, trends, validation, view
from reports.figures import history, ladder, lines, particles, snapshot

HERE = Path(__file__).resolve().parent
WORDS = {"pass": "pass", "fail": "fail", "error": "error", "known-gap": "known gap", "skipped": "skipped", "reported": "reported"}
CLASS_WORDS = {
    "exact": "closed form or quadrature to round-off",
    "manufactured": "manufactured solution",
    "independent": "a second, unrelated computation",
    "experiment": "measured in an experiment",
    "published": "numbers of another code or paper",
    "self": "own earlier result: shows change, verifies nothing",
}


class _Absent(jinja2.StrictUndefined):
    """An optional key of a result that is not there: false when asked, an error when printed."""

    __slots__ = ()
    __bool__ = jinja2.Undefined.__bool__


class Figure:
    """One figure of a page: what draws it, the file it goes to and what the page says about it."""

    def __init__(self, file, title, caption, alt, draw, arguments):
        self.file, self.title, self.caption, self.alt = file, title, caption, alt
        self.draw, self.arguments = draw, arguments
        self.fault = None   # why it could not be drawn


def build(folder, jobs=None):
    """Writes `folder`/report and returns the path of its index. ReportError when `folder` is not that of a run."""
    run = results.load(folder)
    target = run.folder / "report"
    _sweep(run.folder)
    work = run.folder / f".report-{os.getpid()}"
    work.mkdir()
    try:
        _write(run, work, jobs)
        _replace(work, target)
    finally:
        shutil.rmtree(work, ignore_errors=True)
    return target / "index.html"


def _sweep(root):
    """Removes what killed reports left behind."""
    for left in root.glob(".report-*"):
        process = left.name.removeprefix(".report-")
        if process.isdigit() and not Path(f"/proc/{process}").exists():
            shutil.rmtree(left, ignore_errors=True)


def _replace(new, target):
    """Puts folder `new` in the place of `target` in one step: the two are exchanged, and the old one is left as `new`."""
    if not target.exists():
        os.rename(new, target)
        return
    libc = ctypes.CDLL(None, use_errno=True)
    at_working_directory, exchange = -100, 2
    if libc.renameat2(at_working_directory, os.fsencode(new), at_working_directory, os.fsencode(target), exchange) == 0:
        return
    code = ctypes.get_errno()
    if code not in (errno.EINVAL, errno.ENOSYS):
        raise OSError(code, os.strerror(code), str(target))
    aside = new.with_name(new.name + "-old")   # a file system that cannot exchange: the old report is aside for one rename
    os.rename(target, aside)
    os.rename(new, target)
    shutil.rmtree(aside, ignore_errors=True)


def stamp(provenance):
    """'furrow 1a2b3c4d5e-dirty · 2026-01-31' of what the run's own files say."""
    commit = str(provenance.get("commit", "unknown commit"))
    commit = commit[:10] + ("-dirty" if provenance.get("dirty") else "")
    return f"furrow {commit} · {str(provenance.get('started', 'unknown date'))[:10]}"


def slug(text):
    return re.sub(r"[^A-Za-z0-9._-]+", "-", text).strip(".-") or "unnamed"


def assign_pages(cases):
    """Gives each case the path of its page inside the report."""
    taken = set()
    for case in cases:
        page = "cases/" + "/".join(slug(part) for part in case.id.split("/"))
        while page in taken:
            page += "-again"
        taken.add(page)
        case.page = page + ".html"


def figures_of(case, provenance, accepted=None):
    """(ladders by metric name, time series, snapshots, own figures) of a case, each a Figure. `accepted`: curves of the baseline,
    where the case has moved away from it."""
    mark = stamp(provenance)
    base = "figures/" + case.page.removeprefix("cases/").removesuffix(".html")
    taken = set()

    def file(name):
        path = f"{base}/{slug(name)}"
        while path in taken:
            path += "-again"
        taken.add(path)
        return path + ".svg"

    convergence, shown = {}, []
    by_source = sorted((m for m, _ in case.metrics), key=lambda m: any(m["value"] in (s["order"], s["extrapolated"]) for s in ladder.ladders_of(m)))
    for metric in by_source:   # an observed order or a limit carries the ladder that it is read from: that is drawn once
        steps = [s for s in ladder.ladders_of(metric) if s not in shown]
        if steps:
            shown += steps
            said = "; ".join(ladder.name(s) for s in steps)
            name = numbers.words(metric["name"])
            convergence[metric["name"]] = Figure(
                file(f"ladder-{metric['name']}"), f"Convergence of {name}", "",
                f"Convergence of {name} over particle spacing. {said}.", ladder.draw, (metric, mark))
    own = []
    for data in case.data.get("figures", []):
        what = ", ".join(f"{s['label']} ({s['role']})" for s in data["series"])
        if data["kind"] == "lines":
            data = changes.overlaid(data, accepted)
        draw = particles.draw if data["kind"] == "particles" else lines.draw
        own.append(Figure(file(data["name"]), data["title"], data.get("caption", ""),
                          f"{data['title']}. {data['y']['label']} over {data['x']['label']}: {what}.", draw, (data, mark)))
    series, files = [], case.data.get("files", {})
    if "history" in files:
        path = case.folder / files["history"]
        try:
            for i, (unit, names) in enumerate(history.groups(path)):
                words = ", ".join(numbers.words(n) for n in names)
                series.append(Figure(file(f"history-{i + 1}"), f"History of {words}", "", f"{words} over time.", history.draw,
                                     (path, unit, names, mark)))
        except (OSError, KeyError) as error:
            broken = Figure("", "Time series", "", "", None, ())
            broken.fault = f"{files['history']} could not be read: {error}"
            series.append(broken)
    pictures = []
    found = files.get("snapshots", [])
    for name, word in ((found[-1], "Last" if len(found) > 1 else "The"),
                       *([(found[0], "First")] if len(found) > 1 else [])) if found else ():
        moment = snapshot.time(case.folder / name)
        factor, unit = numbers.prefixed(moment or 1.0, "s")
        at = f", t = {numbers.quantity(factor * moment, unit)}" if moment is not None else ""
        pictures.append(Figure(file(f"snapshot-{name}"), f"{word} snapshot{at}", name, f"Particles of snapshot {name}{at}.",
                               snapshot.draw,
                               (case.folder / name, mark)))
    return convergence, series, pictures, own


def _draw(task):
    draw, arguments, path = task
    try:
        text = draw(*arguments)
    except (OSError, KeyError, ValueError, TypeError, OverflowError) as error:   # bad data spoils its own figure alone
        return f"{type(error).__name__}: {error}"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return None


def draw_all(figures, root, jobs):
    """Draws every figure below `root`, in up to `jobs` processes."""
    todo = [f for f in figures if f.draw]
    tasks = [(f.draw, f.arguments, root / f.file) for f in todo]
    jobs = min(jobs or min(2, os.cpu_count() or 1), max(1, len(tasks) // 8))
    if jobs == 1:
        faults = [_draw(task) for task in tasks]
    else:
        with multiprocessing.get_context("fork").Pool(jobs) as pool:
            faults = pool.map(_draw, tasks, chunksize=4)
    for figure, fault in zip(todo, faults):
        figure.fault = fault


def _write(run, work, jobs):
    assign_pages(run.cases)
    since, course = changes.load(run.folder), trends.load(run.folder)
    defects = kills.load()
    drawn = {case.page: figures_of(case, case.data.get("provenance") or run.provenance, since.curves.get(case.id))
             for case in run.cases}
    compared = validation.groups(run)
    # A run without the family that is about the paper's own case has no page of its claims.
    ledger = claims.judge(claims.load(), run) if any(case.family == "tillage" for case in run.cases) else []
    taken = studies.page(studies.load()) if ledger else []
    scatter = [Figure(f"figures/validation/{slug(data['name'])}.svg", data["title"], data["caption"],
                      f"{data['y']['label']} over {data['x']['label']}.", lines.draw, (data, stamp(run.provenance)))
               for data in validation.figures(compared)]
    draw_all([*scatter, *(f for c, s, p, o in drawn.values() for f in (*c.values(), *s, *p, *o))], work, jobs)
    shutil.copytree(HERE / "assets", work / "assets")

    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE / "templates"), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=_Absent)
    environment.filters.update(number=numbers.number, unit=numbers.unit, symbol=numbers.symbol, words=numbers.words,
                               prose=numbers.prose, size=numbers.size, percent=numbers.percent, path=lambda p: quote(p))
    environment.globals.update(
        words=WORDS, class_words=CLASS_WORDS, verdicts=results.VERDICTS, classes=results.CLASSES, states=numbers.STATES,
        with_uncertainty=numbers.with_uncertainty, order=numbers.order, quantity=numbers.quantity, with_unit=numbers.with_unit,
        duration=numbers.duration, ladders_of=ladder.ladders_of, band_words=view.band_words, error_words=view.error_words,
        bar=view.bar, flatten=view.flatten, expiry=view.expiry, when=view.when, spacing_words=view.spacing_words,
        common_rung=view.common_rung, change_words=changes.words, change_part=changes.part,
        sparkline=trends.sparkline, trend_name=trends.name, trend_last=trends.last,
        is_number=lambda x: isinstance(x, (int, float)) and not isinstance(x, bool))
    common = {"run": run, "provenance": run.provenance, "stamp": stamp(run.provenance), "summary": summary.summarise(run),
              "compared": compared, "changes": since, "trends": course, "ledger": ledger, "taken": taken, "defects": defects}
    (work / "index.html").write_text(environment.get_template("index.html").render(root="", **common), encoding="utf-8")
    if since:
        (work / "changes.html").write_text(environment.get_template("changes.html").render(
            root="", pages={case.id: case.page for case in run.cases}, **common), encoding="utf-8")
    if course:
        (work / "trends.html").write_text(environment.get_template("trends.html").render(
            root="", pages={case.id: case.page for case in run.cases}, **common), encoding="utf-8")
    if compared:
        (work / "validation.html").write_text(environment.get_template("validation.html").render(
            root="", groups=compared, figures=scatter, signed=view.signed, share=view.share, **common), encoding="utf-8")
    if ledger:
        (work / "claims.html").write_text(environment.get_template("claims.html").render(
            root="", claims=ledger, counts=claims.counts(ledger), **common), encoding="utf-8")
    if taken:
        (work / "what-it-would-take.html").write_text(environment.get_template("studies.html").render(
            root="", groups=taken, hinge=studies.hinge(324e6, 1.5e-3), **common), encoding="utf-8")
    if defects:
        (work / "defects.html").write_text(environment.get_template("defects.html").render(
            root="", defect_tiers=kills.TIERS[:3], fates=kills.WORDS, fate_colours=kills.COLOURS, fate_moved=kills.moved, **common),
            encoding="utf-8")
    page = environment.get_template("case.html")
    for i, case in enumerate(run.cases):
        convergence, series, pictures, own = drawn[case.page]
        lead = next((f for f, d in zip(own, case.data.get("figures", [])) if d["kind"] == "particles"), None)
        lead = lead or next(iter(pictures), None) or next(iter(own), None)
        path = work / case.page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(page.render(
            root="../" * case.page.count("/"), case=case, convergence=convergence, series=series, lead=lead,
            others=[f for f in (*pictures, *own) if f is not lead], previous=run.cases[i - 1] if i else None,
            following=run.cases[i + 1] if i + 1 < len(run.cases) else None, position=i + 1, **common), encoding="utf-8")
