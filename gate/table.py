"""The comparison on a terminal: the worst first, no line wider than the window."""

from reports.numbers import number, unit

from gate.rules import GREEN, RED, YELLOW

MARKS = {RED: "RED", YELLOW: "yellow", GREEN: "green"}
COLOURS = {RED: "\033[31m", YELLOW: "\033[33m", GREEN: "\033[32m"}
MOST_ROWS = 20
TWO_LINES_BELOW = 100   # columns


def cut(text, width):
    """At most `width` columns; what is cut away leaves a mark."""
    return text if len(text) <= width else text[:max(0, width - 1)] + "…"


def numbers_of(row):
    """'16.31 → 16.35 mm', '16.31 mm → nothing'."""
    if row.value is None and row.accepted is None:
        return ""
    tail = f" {unit(row.unit)}" if unit(row.unit) else ""
    if row.value is None or row.accepted is None:
        old, new = ("nothing" if x is None else number(x) for x in (row.accepted, row.value))
    else:
        old, new = told_apart(row.accepted, row.value)
    return f"{old} → {new}{tail}"


def told_apart(a, b, digits=4):
    """Both numbers with as many digits as it takes to see that they differ."""
    digits = next((d for d in range(digits, 18) if number(a, d) != number(b, d)), digits)
    return number(a, digits), number(b, digits)


def moved_words(row):
    """'+0.3 %', a tiny change '+3e−14 %'; nothing for what did not change or has no size to compare with."""
    part = row.relative
    if part is None or not row.change or row.change == "bitwise":
        return ""
    return f"{'+' if part > 0 else ''}{number(100.0 * part, 2)} %"


def headline(comparison):
    kinds = {k: comparison.count(kind=k) for k in ("bitwise", "within")}
    moved = sum(1 for r in comparison.rows if r.change == "moved")
    return (f"{comparison.count(RED)} red, {comparison.count(YELLOW)} yellow, {comparison.count(GREEN)} green: "
            f"{kinds['bitwise']} bitwise the same, {kinds['within']} within noise, {moved} moved")


def blame_lines(comparison):
    blame = comparison.blame
    if not blame.suspects and not blame.unexplained:
        return []
    lines = ["What moved points to:"] if blame.suspects else []
    for s in blame.suspects:
        lines.append(f"  {' or '.join(s.modules)}: in {s.covers} of the cases that moved, and in {s.touches} of "
                     f"{s.touches + s.spares} that did not")
    if blame.unexplained:
        lines.append(f"  {len(blame.unexplained)} moved and name no module: {', '.join(blame.unexplained[:3])}"
                     f"{' …' if len(blame.unexplained) > 3 else ''}")
    return lines


def table(comparison, width=100, all_rows=False, colour=False, pages=None):
    """Text of at most `width` columns: rows that are not green (all of them with `all_rows`, else the worst), then what they
    point to, then what is conceded. `pages`: case -> address of its page with old and new curves, for a terminal that shows
    links."""
    shown = [(r, 1) for r in comparison.rows] if all_rows else _folded([r for r in comparison.rows if r.colour != GREEN])
    left_out = 0 if all_rows else sum(n for _, n in shown[MOST_ROWS:])
    shown = shown if all_rows else shown[:MOST_ROWS]
    cells = [(MARKS[r.colour], r.case + (f" {r.metric}" if r.metric else ""), numbers_of(r), moved_words(r),
              (r.why or r.kind) + (f" (and {n - 1} more of its metrics)" if n > 1 else "")) for r, n in shown]
    lay = _wide if width >= TWO_LINES_BELOW else _narrow
    lines = []
    for (row, _), texts in zip(shown, lay(shown, cells, width)):
        mark = MARKS[row.colour]
        texts = list(texts)
        if pages and row.case in pages:
            texts[0] = texts[0][:len(mark)] + _linked(texts[0][len(mark):], pages[row.case])
        if colour:
            texts[0] = COLOURS[row.colour] + texts[0][:len(mark)] + "\033[0m" + texts[0][len(mark):]
        lines += texts
    if left_out:
        lines.append(f"and {left_out} more; --all shows them")
    lines += [cut(line, width) for line in blame_lines(comparison)]
    open_ones = comparison.concessions
    if open_ones:
        first = open_ones[0]
        lines.append(cut(f"{len(open_ones)} concession{'s' * (len(open_ones) > 1)} on the ledger; the next ends on "
                         f"{first.expires}: {first.case} {first.metric}", width))
    lines += [cut(note, width) for note in comparison.notes]
    lines.append(cut(headline(comparison), width))
    return "\n".join(lines)


def _linked(text, address):
    """The words between the blanks of `text` as a link (OSC 8); terminals that do not know links show the words."""
    blank = len(text) - len(text.lstrip())
    return f"{text[:blank]}\033]8;;{address}\033\\{text[blank:]}\033]8;;\033\\"


def _wide(shown, cells, width):
    """One line a row."""
    widths = [max((len(c[i]) for c in cells), default=0) for i in range(5)]
    fixed = widths[0] + widths[3] + 8
    widths[2] = min(widths[2], max(12, (width - fixed) // 3))
    name_width = min(widths[1], max(20, (width - fixed - widths[2]) * 3 // 5))
    for (row, _), (mark, name, old_new, moved, why) in zip(shown, cells):
        yield [cut("  ".join([mark.ljust(widths[0]), _name(row, name, name_width), cut(old_new, widths[2]).ljust(widths[2]),
                              moved.rjust(widths[3]), why]).rstrip(), width)]


def _narrow(shown, cells, width):
    """Two lines a row: what it is, and below what it did."""
    for (row, _), (mark, name, old_new, moved, why) in zip(shown, cells):
        yield [f"{mark:<6}  {_name(row, name, width - 8).rstrip()}",
               cut("        " + "  ".join(part for part in (old_new, moved, why) if part), width)]


def _name(row, name, width):
    """The metric is what tells rows apart: where both do not fit, the case is cut in front of it."""
    if len(name) <= width or not row.metric:
        return cut(name, width).ljust(width)
    room = width - len(row.metric) - 1
    return f"{cut(row.case, room)} {row.metric}" if room >= 8 else cut(name, width)


def _folded(rows):
    """Rows of one case that are red for the same reason of bookkeeping (new, lost, error) as one."""
    folded = []
    for row in rows:
        if folded and row.kind in ("new", "lost", "error") and (folded[-1][0].case, folded[-1][0].kind, folded[-1][0].why) == (
                row.case, row.kind, row.why):
            folded[-1] = (folded[-1][0], folded[-1][1] + 1)
        else:
            folded.append((row, 1))
    return folded
