"""The paper's figures: drawn from what there is; a folder without results is told, not drawn."""

from reports.paper import draw
from reports.paper.__main__ import main


def test_the_flow_of_the_program_is_that_of_its_time_loop():
    figure = draw.flow_of_program()
    words = [text.get_text() for text in figure.axes[0].texts]
    assert any(w.startswith("Kick to the middle") for w in words)
    assert any("Tool: hundreds" in w for w in words)
    assert any(w.startswith("Kick to the end") for w in words)


def test_table_1_tells_where_used_numbers_differ_from_printed_ones(tmp_path):
    table = draw.table_1(None).axes[0].tables[0]
    rows = [[table[r, c].get_text().get_text() for c in range(5)] for r in range(1, 1 + len(draw.PRINTED))]
    different = {row[1] for row in rows if row[4]}
    assert different == {"n", "C"}


def test_nothing_to_draw_is_said(tmp_path, capsys):
    assert main(["--run", str(tmp_path / "none"), "--out", str(tmp_path / "figures"), "--no-run"]) == 2
    assert "has no result" in capsys.readouterr().err
