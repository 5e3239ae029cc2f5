"""What a gate leaves in RUN/gate/: gate.json for programs, JUnit, a summary in Markdown, annotations for a merge request,
curves."""

import json
from xml.sax.saxutils import quoteattr

from reports.numbers import number, unit

from gate import table
from gate.files import write_whole
from gate.rules import GREEN, RED, YELLOW

MOST_ANNOTATED = 50   # more than a merge request shows


def write(run, comparison, baselines):
    folder = run.folder / "gate"
    write_whole(folder / "gate.json", json.dumps(data_of(run, comparison), indent=1, ensure_ascii=False, allow_nan=False) + "\n")
    write_whole(folder / "junit.xml", junit(comparison))
    write_whole(folder / "summary.md", markdown(run, comparison))
    write_whole(folder / "annotations.txt", "".join(line + "\n" for line in annotations(comparison)))
    moved = {r.case for r in comparison.rows if r.change == "moved"}
    kept = {case: {"commit": baselines[case].commit, "date": baselines[case].date, "figures": baselines[case].curves}
            for case in sorted(moved) if case in baselines}
    write_whole(folder / "curves.json", json.dumps(kept, allow_nan=False) + "\n")


def data_of(run, comparison):
    """The comparison as JSON, schema 1; numbers that are missing are null."""
    rows = [{"case": r.case, "metric": r.metric, "colour": r.colour, "kind": r.kind, "why": r.why, "verdict": r.verdict,
             "accepted_verdict": r.accepted_verdict, "change": r.change, "direction": r.direction, "value": r.value,
             "accepted": r.accepted, "unit": r.unit, "allowance": r.allowance, "noise_measured": r.noise_measured}
            for r in comparison.rows]
    return {"schema": 1, "colour": comparison.colour, "exit_code": comparison.exit_code,
            "commit": run.provenance.get("commit"), "tier": run.data.get("tier"),
            "counts": {colour: comparison.count(colour) for colour in (RED, YELLOW, GREEN)},
            "changes": {kind: sum(1 for r in comparison.rows if r.change == kind) for kind in ("bitwise", "within", "moved")},
            "rows": rows,
            "blame": [{"modules": s.modules, "covers": s.covers, "touches": s.touches, "spares": s.spares}
                      for s in comparison.blame.suspects],
            "concessions": [vars(c) for c in comparison.concessions], "notes": comparison.notes}


def _clean(text):
    return "".join(c for c in text if c >= " " or c in "\t\n")


def junit(comparison):
    """A test suite a case, a test case a metric; red is a failure (an error where there is no number), yellow is skipped."""
    by_case = {}
    for r in comparison.rows:
        by_case.setdefault(r.case, []).append(r)
    suites = []
    for case, rows in sorted(by_case.items()):
        tests = []
        for r in rows:
            words = quoteattr(_clean(" ".join(part for part in (r.why, table.numbers_of(r), table.moved_words(r)) if part)))
            inner = {RED: f"<{'error' if r.kind == 'error' else 'failure'} type={quoteattr(r.kind)} message={words}/>",
                     YELLOW: f"<skipped message={words}/>", GREEN: ""}[r.colour]
            name = quoteattr(_clean(r.metric or "case"))
            tests.append(f"  <testcase classname={quoteattr(_clean(case))} name={name}>{inner}</testcase>")
        suites.append(f" <testsuite name={quoteattr(_clean(case))} {_totals(rows)}>\n" + "\n".join(tests) + "\n </testsuite>")
    return (f'<?xml version="1.0" encoding="UTF-8"?>\n<testsuites name="furrow gate" {_totals(comparison.rows)}>\n'
            + "\n".join(suites) + "\n</testsuites>\n")


def _totals(rows):
    errors = sum(r.kind == "error" for r in rows)
    return (f'tests="{len(rows)}" failures="{sum(r.colour == RED for r in rows) - errors}" errors="{errors}" '
            f'skipped="{sum(r.colour == YELLOW for r in rows)}"')


def markdown(run, comparison):
    """A summary for a merge request: the sentence, the worst rows, what they point to, what is conceded."""
    def cell(text):
        return text.replace("|", "\\|").replace("<", "&lt;")
    shown = [r for r in comparison.rows if r.colour != GREEN]
    commit = str(run.provenance.get("commit", "unknown"))[:10]
    lines = [f"## Gate: {comparison.colour}", "", f"{table.headline(comparison)}. Commit `{commit}`"
             f"{', dirty tree' if run.provenance.get('dirty') else ''}, tier {run.data.get('tier', 'of its own')}.", ""]
    if shown:
        lines += ["| | case | metric | accepted | now | change | why |", "| --- | --- | --- | ---: | ---: | ---: | --- |"]
        for r in shown[:table.MOST_ROWS]:
            old, new = ("–" if x is None else f"{number(x, 6)} {unit(r.unit)}".strip() for x in (r.accepted, r.value))
            lines.append("| " + " | ".join([r.colour, cell(r.case), cell(r.metric), old, new, table.moved_words(r),
                                            cell(r.why)]) + " |")
        if len(shown) > table.MOST_ROWS:
            lines.append(f"\nand {len(shown) - table.MOST_ROWS} more.")
        lines.append("")
    lines += [cell(line).strip() + "  " for line in table.blame_lines(comparison)]
    if comparison.concessions:
        lines += ["", "On the ledger:", ""]
        lines += [f"- {c.kind} {cell(c.case)} `{c.metric}` until {c.expires}{' (**expired**)' if c.expired else ''}: "
                  f"{cell(c.reason)}" for c in comparison.concessions]
    lines += ["", *comparison.notes]
    return "\n".join(lines).rstrip() + "\n"


def annotations(comparison):
    """Workflow commands that a build server turns into remarks at the case file of the family (GitHub's form)."""
    lines = []
    for r in comparison.rows:
        if r.colour == GREEN or len(lines) == MOST_ANNOTATED:
            break
        title = _escaped(f"{r.case} {r.metric}".strip(), ",:")
        text = _escaped(" ".join(part for part in (r.why, table.numbers_of(r), table.moved_words(r)) if part))
        lines.append(f"::{'error' if r.colour == RED else 'warning'} title={title}::{text}")
    return lines


def _escaped(text, more=""):
    for sign in "%\r\n" + more:
        text = text.replace(sign, f"%{ord(sign):02X}")
    return text
