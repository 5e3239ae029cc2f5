"""The report in a real browser, opened from disk at desktop and phone width: what it says equals the result files, its table
sorts and filters, its links lead somewhere, nothing is asked from another machine, and the console stays silent."""

import json
import os

import pytest

from gate.command import main
from reports.pages import build
from tests.browser import driver
from tests.gate.made import blessed, case, run, with_value
from tests.reports import sample

pytestmark = pytest.mark.skipif(not os.path.exists(driver.PROGRAM), reason="needs Debian's chromium and chromium-driver")
VISIBLE = ("return [...document.querySelectorAll('table.cases tbody tr')].filter(r => !r.hidden)"
           ".map(r => r.cells[1].dataset.value)")


@pytest.fixture(scope="module", params=[(1280, 900), (390, 844)], ids=["desktop", "phone"])
def browser(request):
    found = driver.Browser(*request.param)
    yield found
    found.close()


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    return sample.write(folder), build(folder).parent


@pytest.fixture(autouse=True)
def silent_and_alone(browser):
    yield
    assert browser.console() == []
    assert [url for url in browser.requests() if not url.startswith(("file://", "data:"))] == []


def fits(browser):
    return browser.run("return document.documentElement.scrollWidth <= window.innerWidth")


def test_the_first_page_says_what_the_files_say(browser, report):
    cases, folder = report
    browser.open(folder / "index.html")
    tiles = browser.run("return Object.fromEntries([...document.querySelectorAll('a.tile')].map(t => "
                        "[t.dataset.verdict, Number(t.querySelector('b').textContent)]))")
    assert tiles == {v: sum(c["verdict"] == v for c in cases.values()) for v in ("pass", "fail", "error", "known-gap")}
    assert sorted(browser.run(VISIBLE)) == sorted(cases)
    assert fits(browser)


def test_the_table_sorts_both_ways(browser, report):
    browser.open(report[1] / "index.html")
    for direction in ("ascending", "descending"):
        browser.run("document.querySelectorAll('table.cases thead th')[1].querySelector('button').click()")
        shown = browser.run(VISIBLE)
        assert shown == sorted(shown, reverse=direction == "descending")
        assert browser.run("return document.querySelectorAll('table.cases thead th')[1].getAttribute('aria-sort')") == direction


def test_the_table_filters_by_text_verdict_and_tile(browser, report):
    cases, folder = report
    browser.open(folder / "index.html")
    browser.type("input[type=search]", "gradient")
    assert browser.run(VISIBLE) == ["operators/gradient-sine"]
    browser.run("document.querySelector('form.filters button[type=reset]').click()")
    browser.run("document.querySelector('a.tile[data-verdict=fail]').click()")
    assert browser.run(VISIBLE) == [c for c, d in cases.items() if d["verdict"] == "fail"]
    assert "1 of" in browser.run("return document.getElementById('shown').textContent")


def test_a_link_leads_to_a_case_and_keys_lead_on(browser, report):
    cases, folder = report
    browser.open(folder / "index.html")
    browser.run("[...document.querySelectorAll('table.cases a')].find(a => a.href.endsWith('copper-190.html')).click()")
    assert browser.title.startswith("pass: taylor-bar/copper-190")
    value = browser.run("return document.querySelector('table.metrics tbody tr').textContent")
    assert "16.3" in value and fits(browser)
    assert browser.run("return [...document.images].every(i => i.complete && i.naturalWidth > 0)")
    browser.press("u")
    assert browser.run("return location.pathname").endswith("index.html")


def test_what_moved_is_there_and_sorts(browser, tmp_path):
    (tmp_path / "run").mkdir()
    cases = [case(f"kernel/c{i}") for i in range(5)]
    blessed(tmp_path / "run", *cases, baselines=tmp_path / "b")
    run(tmp_path / "run", *(with_value(c, 1.1 + 0.1 * i) for i, c in enumerate(cases)))
    assert main(["gate", str(tmp_path / "run"), "--no-report", "--baselines", str(tmp_path / "b")]) == 1
    browser.open(build(tmp_path / "run").parent / "changes.html")
    rows = "return [...document.querySelectorAll('table.changes tbody tr')].map(r => r.cells[1].dataset.value)"
    worst_first = [r["case"] for r in json.loads((tmp_path / "run/gate/gate.json").read_text())["rows"]]
    assert browser.run(rows) == worst_first
    browser.run("document.querySelectorAll('table.changes thead th')[1].querySelector('button').click()")
    assert browser.run(rows) == sorted(worst_first) and fits(browser)
    browser.run("document.querySelector('table.changes a').click()")
    assert "kernel/c" in browser.title
