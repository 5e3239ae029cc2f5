"""The night in one screen of text, for mail or chat."""

import textwrap

from gate import table
from gate.rules import RED, YELLOW
from night.series import step_words
from reports.numbers import duration
from reports.results import VERDICTS

LINES, WIDTH = 24, 80


def text(run, comparison, all_series, nights, report, faults=()):
    """At most LINES lines of WIDTH columns: verdicts, what is red and yellow, what stepped tonight, cost."""
    count = {v: sum(c.verdict == v for c in run.cases) for v in VERDICTS}
    p = run.provenance
    head = [f"furrow {str(p.get('commit', 'unknown'))[:8]}{' (dirty)' if p.get('dirty') else ''}, "
            f"{run.data.get('tier', 'no tier')}, {str(p.get('started', ''))[:16].replace('T', ' ')}: {comparison.colour}",
            f"{len(run.cases)} cases: {count['pass']} pass, {count['fail']} fail, {count['error']} error, "
            f"{count['known-gap']} known gap", table.headline(comparison) + "."]
    cost = cost_words(run, all_series)
    wrong = [line for fault in faults for line in textwrap.wrap(f"furrow: {fault}", WIDTH)]
    tail = ([cost] if cost else []) + wrong + ([f"report: {report}"] if report else [])
    middle = _rows(comparison) + _tonight(all_series, nights)
    room = LINES - len(head) - len(tail)
    if len(middle) > room:
        middle = middle[:room - 1] + [f"and {len(middle) - room + 1} more; see the report"]
    return "\n".join(table.cut(line, WIDTH) if not line.startswith("report: ") else line for line in head + middle + tail)


def _rows(comparison):
    shown = [r for r in comparison.rows if r.colour in (RED, YELLOW)]
    lines = []
    for r in shown[:9]:
        name = f"{r.case} {r.metric}".strip()
        end = f"{table.moved_words(r)} {r.why or r.kind}".strip()
        lines.append(f"{table.MARKS[r.colour]:<6} {table.cut(name, max(20, WIDTH - 9 - len(end)))}  {end}")
    if len(shown) > 9:
        lines.append(f"       and {len(shown) - 9} more that moved")
    return lines + table.blame_lines(comparison)


def _tonight(all_series, nights):
    """Steps that began with the last night or were first seen in it."""
    lines = []
    for s in all_series:
        for step in s.steps:
            if s.places[step.index] == len(nights) - 1 or s.kind == "cost" and len(s.values) - step.index == 3:
                lines.append((s.kind, -s.jump(step), f"step   {s.key} {step_words(s, step, nights)}"))
    return [line for _, _, line in sorted(lines)]


def cost_words(run, all_series):
    wall, cpu = run.data.get("wall_s"), run.data.get("cpu_s")
    if wall is None or cpu is None:
        return ""
    earlier = next((s.values[:-1] for s in all_series if s.key == f"run-{run.data.get('tier')}/cpu_s"), [])
    usual = sorted(earlier)[len(earlier) // 2] if earlier else None
    return f"{duration(wall)} wall, {duration(cpu)} CPU" + (f" (usually {duration(usual)})" if usual else "")


