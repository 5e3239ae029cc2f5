"""The bench measures what it says; that it runs and what it reports are tested, never how long anything takes."""

import json

from tests.harness.program import FURROW, run


def bench(*arguments):
    return run(FURROW, "bench", "--json", "--most", 10000, "--time", "0.01", *arguments)


def test_json_has_a_number_for_every_loop():
    result = bench("--filter", "/2d/.*threads:1/")
    assert result.returncode == 0, result.stderr
    benchmarks = {b["name"].split("/")[0]: b for b in json.loads(result.stdout)["benchmarks"]}
    assert set(benchmarks) == {"neighbour_build", "velocity_gradient", "momentum", "whole_step"}
    for name, b in benchmarks.items():
        assert b["bytes_per_particle"] > 100 and 15 < b["neighbours"] < 25 and b["time_per_pair"] > 0, name
    assert benchmarks["whole_step"]["particle_steps_per_s"] > 0


def test_a_filter_that_matches_nothing_is_an_error():
    result = bench("--filter", "nonsense")
    assert result.returncode == 2
    assert "nonsense" in result.stderr


def test_json_goes_into_a_file_as_well(tmp_path):
    file = tmp_path / "bench.json"
    result = bench("--filter", "momentum/2d/.*threads:1/", "--out", file)
    assert result.returncode == 0, result.stderr
    assert len(json.loads(file.read_text())["benchmarks"]) == 1
