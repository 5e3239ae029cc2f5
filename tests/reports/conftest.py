import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from reports.pages import build  # noqa: E402

from tests.reports import sample  # noqa: E402


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """A run with one case of every kind and two broken files: (folder of the run, results by case id, folder of its report)."""
    folder = tmp_path_factory.mktemp("run")
    cases = sample.write(folder)
    for name, text in (("kernel/cut-off", '{"schema": 1, "case": "kernel/cut-o'),
                       ("kernel/wrong-schema", '{"schema": 1, "title": "Half a result"}')):
        (folder / name).mkdir(parents=True)
        (folder / name / "result.json").write_text(text)
    return folder, cases, build(folder).parent


@pytest.fixture
def run(tmp_path):
    """An empty folder and a function that writes results into it."""
    def write(*results, **run_json):
        import json
        for data in results:
            place = tmp_path / data["case"]
            place.mkdir(parents=True, exist_ok=True)
            (place / "result.json").write_text(json.dumps(data))
        (tmp_path / "run.json").write_text(json.dumps({"provenance": sample.PROVENANCE, **run_json}))
        return tmp_path
    return write
