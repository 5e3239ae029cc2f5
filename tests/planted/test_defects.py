"""Planted defects: their heads, that they apply, and who is said to have killed them."""

import dataclasses
import json
import math
import re
import subprocess
import sys
from pathlib import Path

import pytest

from defects import kills, patches
from defects.command import main
from gate import rules
from gate.files import GateError
from reports.kills import build
from tests.gate.made import case, run, with_value
from tests.reports.pages import Page

ROOT = Path(__file__).resolve().parents[2]
HEAD = "Wrong: a sign\nModule: schemes/momentum\nSubtle: no\n\ndiff --git a/x b/x\n--- a/x\n+++ b/x\n@@ -1 +1 @@\n-a\n+b\n"


def defect(tmp_path, text=HEAD, name="a-sign"):
    path = tmp_path / f"{name}.patch"
    path.write_text(text)
    return patches.read(path)


def test_every_patch_has_a_head_and_applies():
    found = patches.read_all()
    assert [f"{d.name}: {why}" for d in found if (why := patches.does_not_apply(d, ROOT))] == []
    wrong = [d for d in found if not d.right]
    assert len(wrong) >= 60 and sum(d.subtle for d in wrong) >= 20 and len(found) - len(wrong) >= 5
    modules = (ROOT / "solver/modules.hpp").read_text()
    few = {m for m in re.findall(r'"(\w+/\w+|simulation)"', modules) if sum(m in d.modules for d in wrong) < 3}
    assert few == set()
    assert len({d.wrong for d in found}) == len(found)


def test_no_two_defects_are_the_same_change():
    bodies = [d.path.read_text().partition("\n\n")[2] for d in patches.read_all()]
    assert len(set(bodies)) == len(bodies)


def test_a_head_is_read(tmp_path):
    found = defect(tmp_path, HEAD.replace("a sign", "a sign\n that goes on").replace("momentum", "momentum, simulation"))
    assert found.wrong == "a sign that goes on" and found.modules == ("schemes/momentum", "simulation") and not found.subtle
    assert found.touches({"simulation"}) and not found.touches({"schemes/xsph"})


@pytest.mark.parametrize("change, word", [
    (("Wrong: a sign\n", ""), "lacks 'Wrong"), (("Subtle: no", "Subtle: perhaps"), "yes or no"),
    (("Module", "Modul"), "expected one of"),
    (("Subtle: no", "Subtle: no\nSubtle: no"), "expected one of"), (("diff --git", "--git"), "come after the head")])
def test_a_broken_head_is_named(tmp_path, change, word):
    with pytest.raises(GateError, match=word):
        defect(tmp_path, HEAD.replace(*change))


def test_a_patch_that_does_not_apply_is_an_error(tmp_path, capsys):
    defect(tmp_path)
    assert main(["defects", "--check", "--patches", str(tmp_path)]) == 3
    assert "a-sign: does not apply" in capsys.readouterr().out
    assert main(["defects", "--check", "--only", "nothing*"]) == 2


def judged(tmp_path, clean, spoilt, tier="smoke"):
    places = [tmp_path / "clean", tmp_path / "spoilt"]
    [p.mkdir() for p in places]
    before = run(places[0], clean).cases[0]
    after = run(places[1], spoilt).cases[0] if spoilt else None
    return kills.seen(before, after, tier)


@pytest.mark.parametrize("spoilt, kind, by", [
    (case(), "bitwise", ""),
    (with_value(case(), 1.5), "away", "change"),
    (with_value(case(), 0.5), "toward", ""),
    (with_value(case(verdict="fail"), 2.5, verdict="fail"), "fail", "truth"),
    (with_value(case(verdict="error"), None, verdict="error"), "error", "truth"),
    (None, "error", "truth"),
])
def test_who_kills(tmp_path, spoilt, kind, by):
    kill = judged(tmp_path, case(), spoilt)
    assert (kill.kind, kill.by) == (kind, by)


def test_a_metric_that_fails_has_moved_as_well(tmp_path):
    assert judged(tmp_path, case(), with_value(case(verdict="fail"), 2.5, verdict="fail")).moved == pytest.approx(1.5)


def test_a_move_is_a_share_of_the_truth_or_of_one_where_that_is_zero():
    row = rules.Row("kernel/one", "norm", rules.RED, "fail", "", value=2e-3, accepted=1e-3)
    assert kills.size_of(row, {"reference": {"value": 0.0}}) == pytest.approx(1e-3)
    assert kills.size_of(row, {"reference": {"value": 0.01}}) == pytest.approx(0.1)
    row = dataclasses.replace(row, unit="N")
    assert kills.size_of(row, {"reference": {"value": 0.0}}) == pytest.approx(1.0)
    assert kills.size_of(dataclasses.replace(row, value=None), {"reference": {"value": 0.0}}) == math.inf


def test_what_fails_on_the_clean_tree_proves_nothing(tmp_path):
    failing = with_value(case(verdict="fail"), 2.5, verdict="fail")
    assert judged(tmp_path, failing, with_value(failing, 9.0)).by == ""


def kill(tier="smoke", by="truth", moved=0.1):
    return kills.Kill("kernel/one", tier, "norm", {"truth": "fail", "change": "away", "": "within"}[by], by, moved)


def test_fates(tmp_path):
    one, tiers = defect(tmp_path), ("smoke", "quick")
    assert kills.fate(one, [kill("smoke", ""), kill("quick")], tiers, "c").tier == "quick"
    assert kills.fate(one, [kill("smoke", "change"), kill("quick", "change")], tiers, "c").state == "changed"
    assert kills.fate(one, [kill("smoke", "", None)], tiers, "c").state == "survived"
    assert kills.fate(one, [], tiers, "c").state == "survived"
    assert kills.fate(one, [], (*tiers, "nightly"), "c").state == "error"
    equivalent = defect(tmp_path, HEAD.replace("Subtle: no", "Subtle: no\nEquivalent: nobody reads it"), "equivalent")
    assert kills.fate(equivalent, [kill("smoke", "", None)], tiers, "c").state == "equivalent"
    assert kills.fate(equivalent, [kill("smoke", "", 0.1)], tiers, "c").state == "error"


def test_a_right_change_must_not_be_red(tmp_path):
    right = defect(tmp_path, HEAD.replace("Wrong: a sign", "Right: another order"))
    assert right.right
    assert kills.fate(right, [kill("smoke", ""), kill("quick", "")], ("smoke", "quick"), "c").state == "passed"
    for by in ("truth", "change"):
        assert "a right change is red" in kills.fate(right, [kill("smoke", by)], ("smoke",), "c").reason


def test_rates_count_a_tier_with_those_below_it(tmp_path):
    one = defect(tmp_path)
    found = [kills.fate(one, [kill("smoke")], ("smoke", "quick"), "c"),
             kills.fate(one, [kill("smoke", ""), kill("quick")], ("smoke", "quick"), "c"),
             kills.fate(one, [kill("smoke", "change")], ("smoke", "quick"), "c"),
             kills.fate(one, [kill("smoke", "", None)], ("smoke", "quick"), "c")]
    assert kills.rates(found, ("smoke", "quick")) == {"smoke": (1, 2, 4), "quick": (2, 3, 4)}


def test_a_fate_is_read_as_it_was_written(tmp_path):
    fate = kills.fate(defect(tmp_path), [kill(moved=math.inf), kill("quick", "", None)], ("smoke", "quick"), "c")
    assert kills.from_json(json.loads(json.dumps(kills.to_json(fate), allow_nan=False))) == fate


STAND_IN = """#!{python}
# Stands in for cmake: builds a program that measures what the file `x` says.
import sys, os
os.makedirs("build/release", exist_ok=True)
text = open("x").read().strip()
if text == "broken":
    print("x:1: error: no such word"); sys.exit(1)
open("build/release/build.ninja", "w").close()
open("build/release/furrow-program", "w").write('''#!{python}
import sys
sys.path.insert(0, {root!r})
from pathlib import Path
from tests.gate.made import case, run, with_value
out = Path(sys.argv[sys.argv.index("--out") + 1]); out.mkdir(parents=True, exist_ok=True)
value = dict(clean=1.0, wrong=9.0, moved=1.5, same=1.0, lost=None)["%s"]
if value is None:
    sys.exit(2)
c = case("kernel/one", provenance=dict(commit="%s"))
verdict = "fail" if value > 2 else "pass"
run(out, with_value(dict(c, verdict=verdict), value, verdict=verdict), provenance=dict(commit="%s"))
''' % (text, *[os.popen("git rev-parse HEAD").read().strip()] * 2))
os.chmod("build/release/furrow-program", 0o755)
"""


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A repository of one file `x`, a compiler that stands in, and defects that change it."""
    from defects import command, scratch
    home = tmp_path / "home"
    home.mkdir()
    (home / "x").write_text("clean\n")
    for words in (["init", "-q"], ["add", "."], ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "x"]):
        subprocess.run(["git", *words], cwd=home, check=True)
    tools = tmp_path / "tools"
    tools.mkdir()
    (tools / "cmake").write_text(STAND_IN.format(python=sys.executable, root=str(ROOT)))
    (tools / "cmake").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tools}:/usr/bin:/bin")
    monkeypatch.setattr(scratch, "ROOT", home)
    monkeypatch.setattr(scratch.SwitchedTree, "factors", tmp_path / "none")
    monkeypatch.setattr(command, "TREES", home / "build")
    monkeypatch.setattr(command.baseline, "read_all", dict)
    folder = tmp_path / "patches"
    folder.mkdir()

    def plant(name, word, head=HEAD, old="clean"):
        change = f"diff --git a/x b/x\n--- a/x\n+++ b/x\n@@ -1 +1 @@\n-{old}\n+{word}\n"
        (folder / f"{name}.patch").write_text(head.partition("\n\n")[0] + "\n\n" + change)

    def hunt(*more):
        return main(["defects", "--tier", "smoke", "--out", str(tmp_path / "out"), "--patches", str(folder), *more])
    return plant, hunt, tmp_path


def fates(place):
    return {p.stem: json.loads(p.read_text())["state"] for p in (place / "out/fates").glob("*.json")}


def test_a_hunt_kills_sees_loses_and_reports(project, capsys):
    plant, hunt, place = project
    plant("killed", "wrong"), plant("changed", "moved"), plant("survives", "same")
    assert hunt() == 1
    said = capsys.readouterr().out
    assert fates(place) == {"killed": "killed", "changed": "changed", "survives": "survived"}
    assert "smoke: 33.3 % killed by the truth, 66.7 % seen at all, of 3" in said
    page = Page((place / "out/page/index.html").read_text())
    assert "1 of 3 defects killed, 1 survived" in page.text and "seen" not in page.all("tr")[0]
    assert (place / "home/build/defects/x").read_text() == "clean\n"


def test_what_does_not_apply_or_compile_is_an_error_and_stops_nothing(project, capsys):
    plant, hunt, place = project
    plant("stale", "wrong", old="something else"), plant("unbuilt", "broken"), plant("killed", "wrong")
    assert hunt() == 3
    assert fates(place) == {"stale": "error", "unbuilt": "error", "killed": "killed"}
    assert "does not compile: x:1: error: no such word" in capsys.readouterr().out


def test_a_program_that_ran_nothing_killed_nothing(project, capsys):
    plant, hunt, place = project
    plant("lost", "lost")
    assert hunt() == 3
    assert fates(place) == {} and "ended with 2" in capsys.readouterr().err


def test_a_hunt_goes_on_where_it_was_cut_short(project, capsys):
    plant, hunt, place = project
    plant("a", "wrong"), plant("b", "wrong")
    assert hunt() == 0
    marked = place / "out/fates/a.json"
    marked.write_text(marked.read_text().replace('"kernel/one"', '"kept/from-before"'))
    (place / "out/fates/b.json").write_text('{"name": "b", "sta')   # no kill leaves such a thing; a bad disk may
    assert hunt("--resume") == 0
    assert "kept/from-before" in marked.read_text() and fates(place)["b"] == "killed"
    plant("a", "moved")
    assert hunt("--resume") == 0 and fates(place)["a"] == "changed"


def test_without_a_matrix_there_is_no_page(tmp_path):
    from reports.results import ReportError
    with pytest.raises(ReportError):
        build(tmp_path)
