"""Curves and points: what was computed over what it is compared with, with uncertainty bars."""

import math

from reports.figures import style
from reports.numbers import label


def draw(data, stamp):
    """`data`: a figure of kind lines or points as in result.json."""
    series = [s for s in data["series"] if s["x"]]
    names = [label(s["label"]) for s in series]
    columns = style.columns_for(names) if names else 1
    shown = list(dict.fromkeys(n for n in names if n))
    figure, axes = style.canvas(legend_rows=style.legend_rows(len(shown), columns) if len(shown) > 1 else 0)
    log_x, log_y = data["x"].get("log", False), data["y"].get("log", False)
    lost = 0

    counts, indices = {}, {}
    for s in series:
        counts[s["role"]] = counts.get(s["role"], 0) + 1
    for s in series:
        index = indices[s["role"]] = indices.get(s["role"], -1) + 1
        look = style.look(s["role"], index, counts[s["role"]])
        x, y = style.finite(s["x"]), style.finite(s["y"])
        if data["kind"] == "points" and s["role"] == "computed":
            look["linestyle"] = "None"
        few = len(x) <= 40
        if data["kind"] == "lines" and s["role"] in ("computed", "published") and not few:
            look["markevery"] = max(1, len(x) // 12) if counts[s["role"]] > 1 else None
            if counts[s["role"]] == 1:
                look["marker"] = "None"
        look.setdefault("markersize", 4.2 if few or data["kind"] == "lines" else 3.0)
        if log_y:
            lost += sum(1 for v in y if v <= 0.0)
            y = [v if v > 0.0 else math.nan for v in y]
        bars = style.finite(s.get("uncertainty") or [])
        if bars and any(b > 0.0 for b in bars):
            look.pop("markevery", None)
            axes.errorbar(x, y, yerr=bars, capsize=2.5, elinewidth=1.0, capthick=1.0, ecolor=look["color"],
                          label=label(s["label"]), **{k: v for k, v in look.items()})
        else:
            axes.plot(x, y, label=label(s["label"]), **look)

    if not any(math.isfinite(v) for line in axes.lines for v in line.get_ydata()):
        style.empty(axes, "no number above zero" if lost else "no finite number")
    else:
        if log_x:
            axes.set_xscale("log")
        if log_y:
            axes.set_yscale("log")
        finish(axes, log_x, log_y)
    y_label = style.axis_label(data["y"]) + (f"  ({lost} zero or negative values not shown)" if lost else "")
    style.labels(axes, style.axis_label(data["x"]), y_label)
    if len(shown) > 1:
        style.legend(figure, axes, columns, shown)
    return style.save(figure, stamp, data["title"])


def finish(axes, log_x, log_y):
    """Ticks for what the axes finally show; a flat curve gets a range wide enough to see that it is flat."""
    low, high = axes.get_ylim()
    if not log_y and math.isfinite(high) and high - low < 1e-12 * max(abs(low), abs(high), 1e-300):
        axes.set_ylim(low - 0.5 * abs(low or 1.0), high + 0.5 * abs(high or 1.0))
    for axis, log, limits in ((axes.xaxis, log_x, axes.get_xlim()), (axes.yaxis, log_y, axes.get_ylim())):
        (style.log_axis if log else style.linear_axis)(axis, *limits)
