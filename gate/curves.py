"""A few points of what a case computed, kept with its baseline so that the report can lay the accepted curve under the new one.

Kept small on purpose: figures of kind `lines` alone, at most MOST_SERIES computed series a case, POINTS points each, four digits.
They are for the eye; no verdict rests on them.
"""

import math

POINTS = 24
MOST_SERIES = 6


def of(result):
    """figure -> {series -> {"x": [...], "y": [...]}} of a parsed result file."""
    kept, count = {}, 0
    for figure in result.get("figures", []):
        if figure["kind"] != "lines":
            continue
        for series in figure["series"]:
            if series["role"] != "computed" or not series["x"] or count == MOST_SERIES:
                continue
            count += 1
            chosen = _chosen(len(series["x"]))
            kept.setdefault(figure["name"], {})[series["label"]] = {
                axis: [_short(series[axis][i]) for i in chosen] for axis in ("x", "y")}
    return kept


def _chosen(n):
    """Indices of about evenly spaced points, both ends among them."""
    if n <= POINTS:
        return range(n)
    return [round(i * (n - 1) / (POINTS - 1)) for i in range(POINTS)]


def _short(x):
    return float(f"{x:.4g}") if isinstance(x, (int, float)) and math.isfinite(x) else None
