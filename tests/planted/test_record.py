"""What is known of each defect, and the page that shows it."""

import datetime
import json

import pytest

from defects import kills, patches, record
from gate.files import GateError
from reports import kills as page
from tests.planted.test_defects import HEAD, defect, kill

TIERS = ("smoke", "quick")


def fate(one, *seen, tiers=TIERS):
    return kills.fate(one, list(seen), tiers, "c" * 40)


def test_a_record_is_read_as_it_was_written(tmp_path):
    one, path = defect(tmp_path), tmp_path / "kills.json"
    entries = {one.name: record.entry_of(fate(one, kill("smoke", ""), kill("quick")), one, TIERS)}
    record.write(entries, path)
    assert record.read(path)[one.name].case == "kernel/one" and record.read(path)[one.name].tier == "quick"
    assert record.read(tmp_path / "none.json") == {}
    path.write_text('{"schema": 2, "defects": {}}')
    with pytest.raises(GateError, match="not a record"):
        record.read(path)


def test_a_small_tier_does_not_forget_what_a_larger_one_found(tmp_path):
    one = defect(tmp_path)
    larger = record.merged({}, [fate(one, kill("smoke", ""))], [one], TIERS)
    assert larger[one.name].state == "survived" and larger[one.name].tier == "quick"
    assert record.merged(larger, [fate(one, kill("smoke", ""))], [one], ("smoke",)) == larger
    assert record.merged(larger, [fate(one, kill("smoke"))], [one], ("smoke",))[one.name].state == "killed"
    assert record.merged(larger, [], [], TIERS) == {}


def test_only_the_very_patch_is_dead(tmp_path):
    one = defect(tmp_path)
    known = record.entry_of(fate(one, kill("quick")), one, TIERS)
    assert record.is_dead(known, defect(tmp_path, HEAD.replace("a sign", "the same, in other words")), "quick")
    assert record.is_dead(known, one, "quick") and not record.is_dead(known, one, "smoke") and not record.is_dead(None, one, "quick")
    assert not record.is_dead(known, defect(tmp_path, HEAD.replace("+b", "+c")), "quick")


def test_the_report_knows_rates_age_and_what_has_changed(tmp_path):
    folder, path = tmp_path / "patches", tmp_path / "kills.json"
    folder.mkdir()
    made = {n: defect(folder, HEAD, n) for n in ("dead", "later", "alive", "other", "new")}
    fates = {"dead": (kill(),), "later": (kill("smoke", ""), kill("quick")), "alive": (kill("smoke", ""),), "other": (kill(),)}
    record.write({n: record.entry_of(fate(made[n], *seen), made[n], TIERS) for n, seen in fates.items()}, path)
    (folder / "other.patch").write_text(HEAD.replace("+b", "+c"))
    found = page.load(path, folder, datetime.date.today() + datetime.timedelta(days=3))
    assert found.rate("smoke") == page.Rate(1, 1, 3, 3, 0) and found.rate("quick") == page.Rate(2, 2, 3, 2, 0)
    assert found.rate("nightly") == page.Rate(2, 2, 3, 0, 1)
    assert found.unknown == ["new"] and [e["name"] for e in found.entries if e["stale"]] == ["other"]
    assert {e["age"] for e in found.entries} == {3} and found.entries[0]["name"] == "alive"
    path.write_text("{")
    assert "kills.json" in page.load(path, folder).fault and not page.load(tmp_path / "none.json", folder)


def test_a_tier_at_which_nothing_was_run_has_no_rate():
    assert page.Rate(2, 2, 3, 0, 1).words(2) == "not run"
    assert page.Rate(2, 2, 4, 1, 1).words(2) == "at least 2, 50 %" and page.Rate(2, 2, 4, 2, 0).words(2) == "2, 50 %"
    assert page.Rate(4, 4, 4, 0, 0).words(4) == "4, 100 %"   # nothing was left to run


def test_the_hash_of_the_report_is_that_of_the_hunt():
    one = patches.read_all()[0]
    assert page.hash_of(one.path.read_text()) == one.hash
    assert json.loads(json.dumps(one.modules)) == list(one.modules)


def test_no_defect_is_called_subtle_that_moved_a_smoke_metric_by_more_than_5_percent():
    known = record.read()
    assert [d.name for d in patches.read_all() if d.subtle and d.name in known and (known[d.name].smoke == "infinite"
                                                                                     or (known[d.name].smoke or 0.0) > 0.05)] == []
    assert sum(d.subtle for d in patches.read_all()) >= 20
