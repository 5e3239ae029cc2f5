"""Particles in their places, coloured by one quantity, on equal axes."""

import math

import matplotlib.colors
import numpy as np

from reports.figures import style
from reports.numbers import prefixed, with_unit

VECTOR_LIMIT = 400   # more particles than this are one picture inside the SVG: a tenth of the time and of the bytes

# blue for negative, orange for positive, a grey between them that is seen on light and on dark paper
SIGNED = matplotlib.colors.LinearSegmentedColormap.from_list("signed", ["#0b3c6f", "#4f8fc0", "#cbcfd0", "#df8648", "#7f2704"])


def draw(data, stamp):
    """`data`: a figure of kind particles as in result.json; several series share axes and colours."""
    series = [s for s in data["series"] if s["x"]]
    x = np.concatenate([np.array(style.finite(s["x"])) for s in series]) if series else np.zeros(0)
    y = np.concatenate([np.array(style.finite(s["y"])) for s in series]) if series else np.zeros(0)
    coloured = bool(series) and all(s.get("colour") for s in series)
    quantity = np.concatenate([np.array(style.finite(s["colour"])) for s in series]) if coloured else None
    lengths = [np.abs(v[np.isfinite(v)]).max(initial=0.0) for v in (x, y)]
    x_unit, y_unit = data["x"]["unit"], data["y"]["unit"]
    factor, unit = prefixed(max(lengths), x_unit) if x_unit == y_unit else (1.0, x_unit)
    axes_labels = (with_unit(data["x"]["label"], unit), with_unit(data["y"]["label"], unit if factor != 1.0 else y_unit))
    colour_label = style.axis_label(data["colour"]) if coloured and data.get("colour") else ""
    groups = [] if coloured else [(s["label"], s["role"], len(s["x"])) for s in series]
    return cloud(factor * x, factor * y, quantity, axes_labels, colour_label, groups, stamp, data["title"])


def cloud(x, y, quantity, axes_labels, colour_label, groups, stamp, title):
    """Dots as large as the particles lie apart. `groups`: (label, role, count) of uncoloured series in the points' order."""
    there = np.isfinite(x) & np.isfinite(y)
    if not there.any():
        figure, axes = style.canvas(plot_height=80.0)
        axes.set_axis_off()
        axes.text(0.5, 0.5, "no particle has a finite position", transform=axes.transAxes, ha="center", color=style.MUTED)
        return style.save(figure, stamp, title)
    x_range, y_range = _padded(x[there]), _padded(y[there])
    wide = style.WIDTH - 62.0 - 16.0
    aspect = (y_range[1] - y_range[0]) / (x_range[1] - x_range[0])
    height = min(300.0, max(90.0, wide * aspect))
    scale = min(wide / (x_range[1] - x_range[0]), height / (y_range[1] - y_range[0]))   # pixels a unit
    for limits, pixels in ((x_range, wide), (y_range, height)):
        spare = 0.5 * (pixels / scale - (limits[1] - limits[0]))
        limits[0] -= spare
        limits[1] += spare
    named = [g for g in groups if g[0]]
    rows = len(named) if len(named) > 1 else 0
    figure, axes = style.canvas(plot_height=height, legend_rows=rows, bottom=44.0 + (46.0 if quantity is not None else 0.0))
    axes.grid(False)
    axes.set_xlim(*x_range)
    axes.set_ylim(*y_range)

    apart = _spacing(x[there], y[there]) * scale
    area = min(120.0, max(0.8, ((0.96 if apart > 6.0 else 1.3) * apart) ** 2))   # small ones overlap, to read as a body
    raster = len(x) > VECTOR_LIMIT
    common = dict(s=area, linewidths=0.0, rasterized=raster)
    if quantity is not None:
        finite = quantity[np.isfinite(quantity)]
        low, high = (finite.min(), finite.max()) if finite.size else (0.0, 1.0)
        signed = low < 0.0 < high and min(-low, high) > 0.05 * max(-low, high)
        bound = max(-low, high)
        drawn = axes.scatter(x, y, c=quantity, cmap=SIGNED if signed else "viridis", vmin=-bound if signed else low,
                             vmax=bound if signed else high, plotnonfinite=False, **common)
        lost = there & ~np.isfinite(quantity)
        if lost.any():
            axes.scatter(x[lost], y[lost], color=style.CYCLE[1], marker="x", s=max(area, 16.0), linewidths=1.0)
            colour_label += f"  (×: {lost.sum()} without a finite number)"
        total = figure.get_figheight() * 72.0
        bar = figure.add_axes([62.0 / style.WIDTH, (17.0 + 20.0) / total, wide / style.WIDTH, 9.0 / total])
        colours = figure.colorbar(drawn, cax=bar, orientation="horizontal")
        colours.outline.set_visible(False)
        style.linear_axis(bar.xaxis, *bar.get_xlim())
        bar.tick_params(colors=style.MUTED, labelsize=10.5, length=2.5, width=0.7, pad=2)
        if colour_label:
            bar.annotate(colour_label, xy=(0, 1), xycoords="axes fraction", xytext=(0, 3), textcoords="offset points", ha="left",
                         va="bottom", color=style.INK, fontsize=11)
    else:
        start, indices = 0, {}
        for label, role, count in groups or [("", "computed", len(x))]:
            index = indices[role] = indices.get(role, -1) + 1
            look = style.look(role, index, len(groups))
            axes.scatter(x[start:start + count], y[start:start + count], color=look["color"], label=label or None, **common)
            start += count
    for axis, limits in ((axes.xaxis, x_range), (axes.yaxis, y_range)):
        style.linear_axis(axis, *limits, most=7 if axis is axes.xaxis else max(2, min(7, int(height / 35.0))))
    style.labels(axes, *axes_labels)
    if rows:
        style.legend(figure, axes, columns=1)
    return style.save(figure, stamp, title)


def _padded(values):
    low, high = float(values.min()), float(values.max())
    pad = 0.04 * (high - low) or 0.5 * abs(low) or 0.5
    return [low - pad, high + pad]


def _spacing(x, y):
    """Typical distance of neighbours: the median of nearest distances over a sample of the points."""
    if len(x) < 2:
        return 1.0
    sample = np.linspace(0, len(x) - 1, min(len(x), 120)).astype(int)
    squares = (x[sample, None] - x[None, :]) ** 2 + (y[sample, None] - y[None, :]) ** 2
    squares[squares == 0.0] = math.inf
    nearest = np.sqrt(squares.min(axis=1))
    nearest = nearest[np.isfinite(nearest)]
    return float(np.median(nearest)) if nearest.size else 1.0
