"""Convergence over the resolution ladder: one curve for each h/dx, a slope to compare with, and order and state in the legend."""

import math

from reports.figures import style
from reports.numbers import order, prefixed, with_unit, words


def ladders_of(metric):
    return metric.get("ladders") or ([metric["ladder"]] if metric.get("ladder") else [])


def name(ladder):
    """'h/Δx 1.2: order 1.98 ± 0.03, asymptotic'."""
    head = f"h/Δx {ladder['h_over_dx']:g}: " if ladder.get("h_over_dx") else ""
    shown = order(ladder)
    return head + (f"order {shown}, " if shown != "–" else "") + ladder["state"]


def draw(metric, stamp):
    """`metric`: a metric with `ladder` or `ladders`. Errors on log-log axes; values that tend to a limit on a linear y axis."""
    ladders = ladders_of(metric)
    is_error = all(l.get("kind", "error") == "error" for l in ladders)
    spacings = [dx for l in ladders for dx in l["spacing"] if dx > 0.0]
    factor, unit = prefixed(max(spacings), "m") if spacings else (1.0, "m")
    figure, axes = style.canvas(plot_height=230.0, legend_rows=len(ladders) + (0 if is_error else 1))

    points = []
    for i, ladder in enumerate(ladders):
        look = style.look("computed", i, len(ladders))
        x = [factor * dx for dx in ladder["spacing"]]
        y = style.finite(ladder["value"])
        if is_error:
            y = [abs(v) if v != 0.0 else math.nan for v in y]
            points += [(a, b, ladder["state"]) for a, b in zip(x, y) if math.isfinite(b) and a > 0.0]
        axes.plot(x, y, label=name(ladder), markersize=5, **look)
        if not is_error and ladder["state"] == "asymptotic" and ladder["extrapolated"] is not None:
            limit, finest = ladder["extrapolated"], min(x)
            axes.plot([finest, max(x)], [limit, limit], color=look["color"], linewidth=1.0, linestyle=(0, (2, 2)), zorder=2)
            if ladder["gci"]:
                axes.errorbar([finest], [y[x.index(finest)]], yerr=[abs(ladder["gci"] * y[x.index(finest)])], color=look["color"],
                              capsize=4, elinewidth=1.0, zorder=3)
    reference = metric["reference"]["value"]
    if not is_error and reference is not None:
        axes.axhline(reference, label="reference", **{k: v for k, v in style.look("reference", 0, 1).items() if k != "marker"})

    if is_error and not points:
        zero = all(v == 0.0 for l in ladders for v in l["value"])
        style.empty(axes, "every error is exactly zero" if zero else "no finite number")
    else:
        axes.set_xscale("log")
        shown = sorted({factor * dx for dx in spacings})
        if shown:
            axes.set_xlim(shown[0] / 1.25, shown[-1] * 1.25)
        _spacing_ticks(axes, shown)
        if is_error:
            axes.set_yscale("log")
            _slope(axes, points, ladders)
            low, high = min(p[1] for p in points), max(p[1] for p in points)
            if high < 10.0 * low:
                axes.set_ylim(low / 3.0, high * 3.0)
            style.log_axis(axes.yaxis, *axes.get_ylim())
        else:
            style.linear_axis(axes.yaxis, *axes.get_ylim())
    quantity = words(metric["name"])
    unit_shown = metric["unit"] if not is_error or "relative" not in metric["norm"] else "1"
    style.labels(axes, with_unit("particle spacing Δx", unit), with_unit(quantity, unit_shown))
    style.legend(figure, axes, columns=1)
    return style.save(figure, stamp, f"Convergence of {metric['name']}")


def _spacing_ticks(axes, spacings):
    """A tick at each spacing that was run, thinned so that labels never touch."""
    import matplotlib.ticker as ticker
    kept = []
    for dx in spacings:
        if not kept or dx > 1.22 * kept[-1]:
            kept.append(dx)
    axes.xaxis.set_major_locator(ticker.FixedLocator(kept))
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda v, _: f"{v:.3g}"))
    axes.xaxis.set_minor_locator(ticker.NullLocator())


def _slope(axes, points, ladders):
    """A triangle below the curves with the whole slope nearest to the observed one (2 where no state allows an order)."""
    if len(points) < 2:
        return
    orders = [l["order"] for l in ladders if l["state"] == "asymptotic" and l["order"] is not None]
    slope = min(6, max(1, round(orders[0]))) if orders else 2
    points = [p for p in points if p[2] != "round-off"] or points
    x_low, x_high = min(p[0] for p in points), max(p[0] for p in points)
    if x_high <= x_low:
        return
    a = math.sqrt(x_low * x_high)
    b = a * min(2.0, (x_high / x_low) ** 0.4)
    below = [p[1] for p in points if a / 1.3 <= p[0] <= b * 1.3] or [p[1] for p in points]
    y_a = min(below) / 2.5 / (b / a) ** slope
    y_b = y_a * (b / a) ** slope
    axes.fill([a, b, b], [y_a, y_a, y_b], facecolor=style.GRID, edgecolor=style.MUTED, linewidth=0.9, zorder=1)
    axes.annotate(str(slope), xy=(b, math.sqrt(y_a * y_b)), xytext=(4, 0), textcoords="offset points", color=style.MUTED,
                  fontsize=11, va="center")
    axes.annotate("1", xy=(math.sqrt(a * b), y_a), xytext=(0, -3), textcoords="offset points", color=style.MUTED, fontsize=11,
                  ha="center", va="top")
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, y_a / 2.5), high)
