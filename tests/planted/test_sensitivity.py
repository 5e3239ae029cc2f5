"""The search for the smallest change that a case sees."""

import subprocess
from pathlib import Path

import pytest

from defects import sensitivity

ROOT = Path(__file__).resolve().parents[2]


def red_beyond(limits):
    asked = []

    def is_red(change, cases):
        asked.append((change, list(cases)))
        return {c: "metric" for c in cases if change > limits[c]}
    return is_red, asked


@pytest.mark.parametrize("limit", [0.17, 0.012, 3e-5])
def test_a_threshold_is_between_what_is_red_and_what_is_green(limit):
    is_red, asked = red_beyond({"a/dull": 0.25, "a/sharp": limit})
    smallest, green, case, metric = sensitivity.threshold(is_red, ["a/dull", "a/sharp"])
    assert green <= limit < smallest <= green * sensitivity.PRECISION and (case, metric) == ("a/sharp", "metric")
    assert len(asked) < 16 and (limit > 0.1 or asked[-1][1] == ["a/sharp"])


def test_what_nobody_sees_has_no_threshold_and_what_all_see_no_lower_end():
    assert sensitivity.threshold(lambda x, c: {}, ["a/b"]) == (None, sensitivity.LARGEST, "", "")
    smallest, green, _, _ = sensitivity.threshold(lambda x, c: {"a/b": "m"}, ["a/b"])
    assert smallest < 10.0 * sensitivity.SMALLEST and green == 0.0


def made(parameter="phi", tier="smoke", smallest=0.01):
    return sensitivity.Threshold(parameter, tier, "bodies", "up", smallest, 0.008, "a/b", "m", "c" * 40, "2026-01-31")


def test_the_record_keeps_what_was_not_sought_again(tmp_path):
    path = tmp_path / "sensitivity.json"
    sensitivity.write([made("c"), made("phi")], path)
    sensitivity.write([made("phi", smallest=0.02), made("phi", "quick")], path)
    found = sensitivity.read(path)
    assert [(t.parameter, t.tier, t.smallest) for t in found] == [("phi", "smoke", 0.02), ("phi", "quick", 0.01), ("c", "smoke", 0.01)]
    path.write_text("{")
    with pytest.raises(sensitivity.GateError, match="no record of sensitivity"):
        sensitivity.read(path)


def test_a_line_says_what_was_found():
    assert "0.01  a/b m" in sensitivity.line(made())
    assert "more than 30%" in sensitivity.line(sensitivity.Threshold("phi", "smoke", "bodies", "up", None, 0.3))


def test_factors_apply_and_are_those_of_the_parameters():
    patch = ROOT / "defects/factors.patch"
    assert subprocess.run(["git", "apply", "--check", str(patch)], cwd=ROOT).returncode == 0
    text = patch.read_text()
    assert [n for n in sensitivity.PARAMETERS if f'FURROW_FACTOR("{n}")' not in text] == []
