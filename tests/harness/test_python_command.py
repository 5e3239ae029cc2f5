"""Commands that are Python: the program becomes them, with its arguments, from any folder."""

import pytest

from tests.harness.program import FURROW, run


@pytest.mark.parametrize("command", ["gate", "bless", "noise", "nightly", "history", "defects", "figures"])
def test_help_comes_from_the_command_itself(tmp_path, command):
    ended = run(FURROW, command, "--help", cwd=tmp_path)
    assert ended.returncode == 0 and f"usage: ./furrow {command}" in ended.stdout and "Example: ./furrow" in ended.stdout
    assert command in run(FURROW, "--help").stdout


def test_arguments_and_exit_code_are_passed_on(tmp_path):
    ended = run(FURROW, "gate", "nowhere", cwd=tmp_path)
    assert ended.returncode == 2 and ended.stderr == "furrow: nowhere: no such folder\n"
    assert run(FURROW, "bless", "nowhere").returncode == 2


def test_a_folder_of_the_same_name_where_one_stands_is_not_mistaken_for_the_command(tmp_path):
    (tmp_path / "gate").mkdir()
    (tmp_path / "gate/__init__.py").write_text("raise SystemExit(9)")
    assert run(FURROW, "gate", "nowhere", cwd=tmp_path).returncode == 2


def test_another_order_of_particles_is_on_record_and_moves_round_off_alone(tmp_path):
    import json
    case = "elastodynamics/gravity-column-symmetry"
    values = {}
    for order in (0, 3):
        assert run(FURROW, "run", case, "--no-report", "--particle-order", order, "--out", tmp_path / str(order)).returncode == 0
        data = json.loads((tmp_path / str(order) / case / "result.json").read_text())
        assert data["provenance"]["particle_order"] == order
        values[order] = {m["name"]: m["value"] for m in data["metrics"]}
    assert values[0] != values[3]
    assert values[3] == pytest.approx(values[0], rel=1e-6, abs=1e-12)
