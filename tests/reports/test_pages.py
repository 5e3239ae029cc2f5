"""The pages: counts equal the files, links hold, nothing comes from outside, the old report is replaced in one step."""

import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from urllib.parse import unquote

import pytest

from reports import pages as report_pages
from reports.pages import build
from reports.results import VERDICTS, load
from tests.reports import sample
from tests.reports.pages import Page
from tests.reports.sample import ladder, metric, result

ROOT = Path(__file__).resolve().parents[2]


def every_page(report):
    return {path: Page(path.read_text(encoding="utf-8")) for path in report.rglob("*.html")}


def page_of(report, case):
    return Page((report / "cases" / f"{case}.html").read_text(encoding="utf-8"))


def test_counts_equal_the_files(built):
    folder, cases, report = built
    index = (report / "index.html").read_text()
    expected = dict.fromkeys(VERDICTS, 0)
    for data in cases.values():
        expected[data["verdict"]] += 1
    expected["error"] += 2   # the two broken files
    tiles = dict(re.findall(r'data-verdict="([a-z-]+)">\s*<svg.*?</svg><b>(\d+)</b>', index))
    assert {v: int(n) for v, n in tiles.items()} == expected
    page = Page(index)
    rows = [a for a in page.all("tr") if "data-verdict" in a]
    assert {v: sum(r["data-verdict"] == v for r in rows) for v in VERDICTS} == expected
    metrics = [m for data in cases.values() for m in data["metrics"]]
    assert f"{len(metrics)} metrics: {sum(m['verdict'] == 'pass' for m in metrics)} in their band" in page.text
    families = {data["family"] for data in cases.values()}
    assert {r["data-family"] for r in rows} == families


def test_broken_files_are_shown_as_errors(built):
    _, _, report = built
    index = Page((report / "index.html").read_text())
    assert "result.json is not JSON" in index.text
    assert "does not follow the schema" in index.text
    for case in ("kernel/cut-off", "kernel/wrong-schema"):
        page = page_of(report, case)
        assert page.all("span", "verdict")[0]["class"].split()[1] == "error"
        assert "result.json" in page.text


def test_pages_are_well_formed_and_every_link_holds(built):
    _, cases, report = built
    pages = every_page(report)
    assert len(pages) == 1 + len(cases) + 2 + 1   # the index, two that are broken, the planted defects
    for path, page in pages.items():
        assert len(page.ids) == len(set(page.ids)), f"{path}: an id twice"
        for tag, key, link in page.links:
            if link.startswith("https://doi.org/"):
                assert (tag, key) == ("a", "href")
                continue
            place, _, fragment = link.partition("#")
            target = (path.parent / unquote(place)).resolve() if place else path
            assert target.is_file(), f"{path}: {link}"
            assert report in target.parents, f"{path}: {link} leaves the report"
            if fragment and target.suffix == ".html":
                assert fragment in pages[target].ids, f"{path}: {link}"
            if fragment and target.suffix != ".html":
                pytest.fail(f"{path}: {link}")


def test_nothing_is_asked_from_the_network(built):
    _, _, report = built
    for path in report.rglob("*"):
        if path.suffix in (".css", ".js", ".svg"):
            text = re.sub(r'xmlns(:\w+)?="[^"]*"', "", path.read_text(encoding="utf-8"))
            text = re.sub(r"<metadata>.*?</metadata>|data:image/png;base64,[\w+/=\s]+", "", text, flags=re.DOTALL)
            assert not re.search(r"https?:|//\w|@import|fetch\(|XMLHttpRequest",
                                 re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE)), path
    for path, page in every_page(report).items():
        for tag, key, link in page.links:
            assert not re.match(r"(\w+:)?//", link) or (tag == "a" and link.startswith("https://doi.org/")), f"{path}: {link}"


def test_figures_are_well_formed_stamped_and_the_same_every_time(built, tmp_path):
    folder, _, report = built
    figures = sorted(report.rglob("figures/**/*.svg"))
    assert figures
    for figure in figures:
        text = figure.read_text(encoding="utf-8")
        assert ElementTree.fromstring(text).tag.endswith("svg")
        assert "furrow 4f1c2d9ab0-dirty · 2026-01-31" in text
        assert not re.search(r"#0[0-9]0[0-9]0[0-9]\b", re.sub(r"<style>.*?</style>", "",
                                                              text)), f"{figure}: a colour that no theme knows"
    again = tmp_path / "again"
    sample.write(again)
    second = build(again, jobs=1).parent
    for figure in figures:
        assert (second / figure.relative_to(report)).read_bytes() == figure.read_bytes()


def test_what_a_title_holds_stays_text(built):
    _, cases, report = built
    page = page_of(report, "kernel/unicode")
    assert "Näherung für ∇W ≈ Σ V ∇W <b>&amp;</b> „Größe“ 勾配" in page.text
    assert "<script>alert(1)</script>" in page.text
    assert len(page.all("script")) == 1


def test_an_order_stands_with_its_state(built):
    _, _, report = built
    page = page_of(report, "operators/gradient-sine")
    for words in ("1.98 ± 0.03 asymptotic: ", "0.31 ± 0.20 plateau: ", "– oscillatory: "):
        assert words in page.text
    (image,) = [a for a in page.all("img") if "ladder-gradient_error" in a["src"]]
    assert "order 1.98 ± 0.03, asymptotic" in image["alt"]


def test_a_number_that_is_missing_is_never_a_number(built):
    _, _, report = built
    page = page_of(report, "operators/diverged")
    assert "no number" in page.text
    assert "No finite number at step 311" in page.text
    assert not re.search(r"\b(nan|None|null|undefined)\b", page.text)


def test_known_gap_shows_reason_and_expiry(built):
    _, _, report = built
    index = Page((report / "index.html").read_text())
    assert "Truncated support at the edge, shown by the ladder" in index.text
    assert {"datetime": "2026-06-30"} in index.all("time")


def test_an_expired_gap_says_so(run):
    gap = result("kernel/a", "known-gap", [metric("e", 2.0, [0, 1], "known-gap")], reason="Cause; expires 2025-12-31.")
    assert "expired 2025-12-31" in Page(build(run(gap)).read_text()).text


def test_a_self_green_is_never_called_verification(built):
    _, _, report = built
    page = page_of(report, "column-collapse/unchanged")
    assert "unchanged, not verified" in page.text
    assert "self-only" in page.all("span", "verdict")[0]["class"]


def test_a_case_page_tells_what_it_must(built):
    _, _, report = built
    page = page_of(report, "taylor-bar/copper-190")
    for words in ("A bar hits a rigid wall.", "16.21 ± 0.10", "0.56\u202f%", "± 3\u202f%", "speed=190 m/s",
                  "Johnson, G. R. & Cook, W. H.", "doi:10.1000/example",
                  "experiment", "no probe at this resolution", "GNU 12.2.0", "Last snapshot, t = 80\u202fµs",
                  "First snapshot, t = 0\u202f", "History of length"):
        assert words.replace("\u202f", " ") in page.text.replace("\u202f", " "), words
    sources = [a["src"] for a in page.all("img")]
    assert "snapshot-last" in sources[0]
    assert [a for a in page.all("a") if a.get("rel") == "prev"]


def test_an_order_carries_its_ladder_and_is_drawn_once(run):
    data = result("kernel/a", metrics=[metric("p", 1.98, [1.7, 2.3], norm="value", ladders=[ladder()]),
                                       metric("e", 1e-5, [0, 1e-4], norm="L2 relative", ladders=[ladder()])])
    images = [a["src"] for a in page_of(build(run(data)).parent, "kernel/a").all("img")]
    assert ["ladder-e" in i for i in images] == [True]


def test_a_resolution_that_all_metrics_share_is_said_once(run):
    at = {"spacing": 0.001, "h_over_dx": 1.2}
    page = page_of(build(run(result("kernel/a", metrics=[metric("e", 0.1, [0, 1], at=at),
                                                         metric("f", 0.1, [0, 1], at=at)]))).parent, "kernel/a")
    assert page.text.count("at Δx") == 1


def test_an_interrupted_run_and_kept_results_are_told(run):
    kept = result("kernel/a", provenance={**sample.PROVENANCE, "commit": "0123456789abcdef", "started": "2026-01-02T03:04:05Z"})
    text = Page(build(run(kept, state="interrupted", cases=["kernel/a", "kernel/b"])).read_text()).text
    assert "The run was interrupted" in text
    assert "kept from 0123456789, 2 January 2026, 03:04 UTC" in text
    assert "it left no result.json" in text


def test_a_snapshot_shows_the_quantity_that_varies(built):
    _, _, report = built
    first, last = ((report / "figures/taylor-bar/copper-190" / f"snapshot-{n}.vtkhdf.svg").read_text() for n in ("first", "last"))
    assert "|velocity|, m/s" in first and "plastic strain" not in first
    assert "plastic strain" in last


def test_a_history_keeps_the_order_of_its_columns(built):
    _, _, report = built
    text = page_of(report, "taylor-bar/copper-190").text
    assert text.index("History of length") < text.index("History of kinetic energy, elastic energy")


def test_no_baseline_is_said(built):
    _, _, report = built
    assert "No baseline accepted yet." in Page((report / "index.html").read_text()).text


def test_worst_error_leads(run):
    index = Page(build(run(result("kernel/a", metrics=[metric("small", 0.1, [0, 1]), metric("large", 0.9, [0, 1])]),
                           result("kernel/b", "fail", [metric("outside", 3.0, [0, 1], "fail")]))).read_text())
    start = index.text.index("Worst error against its band")
    said = index.text[start:index.text.index("Since the baseline")]
    assert said.index("outside") < said.index("large") < said.index("small")
    assert "300\u202f%" in index.text or "300 %" in said


def test_a_run_without_cases_is_red(run):
    index = Page(build(run()).read_text())
    assert "No case has a result." in index.text
    assert index.all("section", "red")


def test_a_missing_or_broken_run_json_is_said(run):
    folder = run(result("kernel/a"))
    (folder / "run.json").unlink()
    assert "run.json is missing" in Page(build(folder).read_text()).text
    (folder / "run.json").write_text("{")
    assert "run.json: not JSON" in Page(build(folder).read_text()).text


def test_missing_files_are_said_on_the_page(run):
    data = result("kernel/a", files={"history": "gone.h5", "snapshots": ["gone.vtkhdf"]})
    text = Page((build(run(data)).parent / "cases/kernel/a.html").read_text()).text
    assert "gone.h5 could not be read" in text
    assert "could not be drawn" in text


def test_odd_figures_do_not_spoil_a_report(run):
    def figure(name, x, y, kind="lines", log=False, **more):
        return {"name": name, "title": name, "kind": kind, "x": {"label": "x", "unit": "1", "log": log},
                "y": {"label": "y", "unit": "1", "log": log},
                "series": [{"label": "s", "role": "computed", "x": x, "y": y, **more}]}
    data = result("kernel/a", figures=[
        figure("empty", [], []), figure("nothing finite", [None], [None]), figure("flat", [1, 2], [3.0, 3.0]),
        figure("zeros on log", [1, 2], [0.0, 0.0], log=True),
        figure("same name", [1], [1]), figure("same name", [1], [2]), figure("unequal", [1, 2, 3], [1]),
        figure("one particle", [0.0], [0.0], "particles"),
        figure("no particle", [None], [0.0], "particles"), figure("lost colours", [0.0, 1.0], [0.0, 1.0], "particles",
                                                                  colour=[None, 1.0]),
        {**figure("none", [1], [1]), "series": []}],
        metrics=[metric("e", 0.1, [0, 1], ladder={**ladder("undetermined", None, None), "value": [None, None, None, None, None],
                                                  "gci": None, "extrapolated": None}),
                 metric("z", 0.0, [0, 1], ladder={**ladder("round-off", None, None), "value": [0.0] * 5})])
    report = build(run(data)).parent
    page = page_of(report, "kernel/a")
    assert page.text.count("could not be drawn") == 1   # unequal lengths cannot be drawn
    for image in page.all("img"):
        ElementTree.parse((report / "cases/kernel" / image["src"]).resolve())


def test_the_old_report_is_replaced_in_one_step(run, monkeypatch):
    folder = run(result("kernel/a"))
    report = build(folder).parent
    first = (report / "index.html").read_text()
    (report / "left-over.txt").write_text("of the old report")

    def killed(*_):
        raise KeyboardInterrupt
    monkeypatch.setattr(report_pages, "_replace", killed)
    with pytest.raises(KeyboardInterrupt):
        build(run(result("kernel/a"), result("kernel/b")))
    assert (report / "index.html").read_text() == first
    monkeypatch.undo()

    seen = []
    replace = report_pages._replace

    def watched(new, target):
        assert (new / "index.html").is_file() and (target / "left-over.txt").is_file()   # both whole until the one call
        replace(new, target)
        seen.append((target / "index.html").read_text())
        assert not (target / "left-over.txt").exists()
    monkeypatch.setattr(report_pages, "_replace", watched)
    build(folder)
    assert "kernel/b" in seen[0]
    assert sorted(p.name for p in folder.iterdir()) == ["kernel", "report", "run.json"]


def test_what_a_killed_report_left_is_swept(run):
    folder = run(result("kernel/a"))
    child = subprocess.Popen([sys.executable, "-c", ""])
    child.wait()
    dead, alive = folder / f".report-{child.pid}", folder / ".report-1"
    dead.mkdir(), alive.mkdir()
    build(folder)
    assert not dead.exists() and alive.exists()


def test_several_processes_draw_the_same(run):
    data = [result(f"kernel/{i}", figures=[{**sample.lines_figure(), "name": f"f{k}"} for k in range(6)]) for i in range(4)]
    folder = run(*data)
    one = {p.name: p.read_bytes() for p in build(folder, jobs=1).parent.rglob("*.svg")}
    two = {p.name: p.read_bytes() for p in build(folder, jobs=2).parent.rglob("*.svg")}
    assert one == two


def call(*arguments):
    return subprocess.run([sys.executable, "-m", "reports", *map(str, arguments)], cwd=ROOT, capture_output=True, text=True,
                          timeout=120)


def test_command_line(run, tmp_path):
    folder = run(result("kernel/a"))
    done = call(folder)
    assert (done.returncode, done.stdout.strip()) == (0, str(folder / "report" / "index.html"))
    assert call("--quiet", folder).stdout == ""
    for wrong, words in ((tmp_path / "nowhere", "no such folder"), (tmp_path / "kernel" / "empty", "neither run.json")):
        if "neither" in words:
            wrong.mkdir()
        failed = call(wrong)
        assert failed.returncode == 2
        assert words in failed.stderr and failed.stderr.count("\n") == 1


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_read_only_folder_is_refused(run):
    folder = run(result("kernel/a"))
    folder.chmod(0o555)
    try:
        failed = call(folder)
    finally:
        folder.chmod(0o755)
    assert failed.returncode == 2 and failed.stderr.count("\n") == 1


def test_the_run_is_not_read_from_its_own_report(built):
    folder, cases, _ = built
    assert len(load(folder).cases) == len(cases) + 2
