"""One look for every figure: sizes, roles, axes, stamp, and colours that follow the reader's light or dark page.

Figures are drawn with placeholder colours; saving replaces them by CSS variables, so that one SVG serves light, dark and print.
"""

import io
import math
import re

import matplotlib

matplotlib.use("svg")
import matplotlib.figure  # noqa: E402
import matplotlib.ticker  # noqa: E402

from reports.numbers import SUPERSCRIPTS, number, with_unit  # noqa: E402

FONTS = "'Helvetica Neue', Helvetica, 'Segoe UI', Roboto, 'Noto Sans', 'Nimbus Sans', Arial, sans-serif"
WIDTH = 460.0   # of every figure, in CSS pixels; heights follow from the content

# placeholder -> (variable, light, dark). The hues are Okabe and Ito's, darkened or lightened to keep contrast on both papers.
COLOURS = {
    "#010101": ("ink", "#1d2329", "#e8e5de"),
    "#020202": ("muted", "#5f6870", "#9ba4ac"),
    "#030303": ("grid", "#e4e1d9", "#30363c"),
    "#040404": ("paper", "#ffffff", "#1c2024"),
    "#050501": ("c1", "#0a6aa8", "#5db5ee"),
    "#050502": ("c2", "#c8511b", "#f0925e"),
    "#050503": ("c3", "#00805f", "#3fc79f"),
    "#050504": ("c4", "#9c4f86", "#dc98c6"),
    "#050505": ("c5", "#9a7400", "#e3bd4e"),
    "#050506": ("c6", "#4a4fa8", "#a3a7f0"),
    "#050507": ("c7", "#7b5a3c", "#c9a584"),
    "#050508": ("c8", "#3b8c99", "#7fcfdb"),
}
INK, MUTED, GRID, PAPER = "#010101", "#020202", "#030303", "#040404"
CYCLE = [c for c in COLOURS if c.startswith("#0505")]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "h"]
DASHES = ["-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (6, 2, 1.5, 2)), (0, (8, 2)), (0, (3, 1.5)), (0, (1, 2.5)),
          (0, (5, 1.5, 1, 1.5, 1, 1.5))]
REFERENCE_DASHES = [(0, (5, 2.5)), (0, (1.5, 2)), (0, (7, 2, 1.5, 2)), (0, (10, 3))]

matplotlib.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "furrow", "font.family": "DejaVu Sans", "font.size": 11.5,
    "mathtext.default": "regular", "path.simplify": True, "path.simplify_threshold": 0.2, "axes.unicode_minus": True,
})


def look(role, index, count):
    """Line and marker of the index-th series of a role. Computed: solid colours; the others look the same in every figure."""
    if role == "computed":
        turn = index // len(CYCLE)   # a second turn through the colours comes with other dashes and open markers
        return dict(color=CYCLE[index % len(CYCLE)], linestyle=DASHES[(index + 3 * turn) % len(DASHES)] if count > 4 else "-",
                    marker=MARKERS[index % len(MARKERS)], fillstyle="none" if turn % 2 else "full", linewidth=1.7, zorder=3)
    if role == "reference":
        return dict(color=INK, linestyle=REFERENCE_DASHES[index % len(REFERENCE_DASHES)], marker="None", linewidth=1.25, zorder=4)
    if role == "experiment":
        return dict(color=INK, linestyle="None", marker=MARKERS[index % len(MARKERS)], fillstyle="none", markeredgewidth=1.3,
                    zorder=5)
    if role == "accepted":   # of an earlier commit: wide and pale, so that a new curve that has not moved lies on it
        return dict(color=GRID, linestyle="-", marker="None", linewidth=5.0, zorder=1.5, solid_capstyle="butt")
    if role == "published":
        return dict(color=CYCLE[3 + index % 2 * 4], linestyle=(0, (3, 2)), marker=MARKERS[(index + 3) % len(MARKERS)],
                    fillstyle="none", linewidth=1.2, zorder=4)
    return dict(color=MUTED, linestyle=(0, (1, 1.6)), marker="None", linewidth=1.2, zorder=2)


def canvas(plot_height=225.0, legend_rows=0, left=62.0, right=16.0, top=30.0, bottom=44.0, caption_rows=0):
    """A figure of fixed width with one axes of the given height in pixels, and room below for a legend and for the stamp."""
    legend = 15.0 * legend_rows + (4.0 if legend_rows else 0.0)
    height = top + plot_height + bottom + legend + 17.0
    figure = matplotlib.figure.Figure(figsize=(WIDTH / 72.0, height / 72.0), dpi=72)
    axes = figure.add_axes([left / WIDTH, (bottom + legend + 17.0) / height, (WIDTH - left - right) / WIDTH,
                            plot_height / height])
    dress(axes)
    return figure, axes


def dress(axes):
    axes.set_facecolor("none")
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(MUTED)
        axes.spines[side].set_linewidth(0.8)
    axes.tick_params(colors=MUTED, labelcolor=MUTED, labelsize=11, length=3.5, width=0.8)
    axes.grid(True, color=GRID, linewidth=0.8)
    axes.set_axisbelow(True)


def labels(axes, x, y):
    """x label below; y label above the axis, upright, where it can be read without turning the head."""
    axes.set_xlabel(x, color=INK, fontsize=11.5, labelpad=5)
    axes.annotate(y, xy=(0, 1), xycoords="axes fraction", xytext=(-50, 11), textcoords="offset points", color=INK, fontsize=11.5,
                  ha="left", va="bottom")


def _decade(value, _=None):
    if value <= 0.0:
        return ""
    exponent = math.log10(value)
    if abs(exponent - round(exponent)) > 1e-6:
        return ""
    exponent = round(exponent)
    plain = {-2: "0.01", -1: "0.1", 0: "1", 1: "10", 2: "100", 3: "1000"}
    return plain.get(exponent, "10" + str(exponent).translate(SUPERSCRIPTS))


def log_axis(axis, low, high):
    """Decades as ticks; where less than two decades are seen, 1-2-5 with plain numbers."""
    decades = math.log10(high / low) if high > low > 0.0 else 1.0
    if decades < 0.5:
        axis.set_major_locator(matplotlib.ticker.MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]))
        axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: number(v, 3)))
    elif decades < 2.0:
        axis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: number(v, 2)))
    else:
        axis.set_major_locator(matplotlib.ticker.LogLocator(base=10.0 ** max(1, math.ceil(decades / 7.0)), numticks=20))
        axis.set_major_formatter(matplotlib.ticker.FuncFormatter(_decade))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())   # minor ticks are half the time of a drawing


def linear_axis(axis, low=0.0, high=1.0, most=7):
    """At most `most` ticks with plain numbers; a range that is very large or small gets its power of ten on each tick."""
    axis.set_major_locator(matplotlib.ticker.MaxNLocator(most, steps=[1, 2, 2.5, 5, 10]))
    span = high - low
    largest = max(abs(low), abs(high))
    digits = 4
    if span > 0.0 and largest > 0.0:
        digits = 2 + max(2, math.ceil(math.log10(largest / span)))   # so that no two ticks read the same
    if digits > 5:
        axis.set_major_formatter(matplotlib.ticker.ScalarFormatter(useOffset=True))
        axis.get_offset_text().set(x=1.0, ha="right", color=MUTED)   # away from the label of the axis
    else:
        axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: number(0.0 if abs(v) < 1e-9 * span else v, digits)))


def legend_rows(count, columns=2):
    return math.ceil(count / columns)


def legend(figure, axes, columns=2, order=None):
    """Legend below the plot, where it never covers data. `columns` as given to legend_rows; `order`: names in reading order."""
    handles, names = axes.get_legend_handles_labels()
    if not handles:
        return
    if order:
        found = dict(zip(names, handles))
        names = [name for name in order if name in found]
        handles = [found[name] for name in names]
    height = figure.get_figheight() * 72.0
    drawn = figure.legend(handles, names, loc="lower left", bbox_to_anchor=(8.0 / WIDTH, 14.0 / height), ncol=columns,
                          frameon=False,
                          fontsize=11, handlelength=2.2, columnspacing=1.4, labelspacing=0.35, borderpad=0.2, handletextpad=0.6)
    for text in drawn.get_texts():
        text.set_color(INK)


def columns_for(names):
    """Two columns of legend when the names are short enough for half the width."""
    return 2 if len(names) > 1 and max(len(n) for n in names) <= 28 else 1


def empty(axes, words):
    """Says in an empty plot why it is empty."""
    axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", va="center", color=MUTED)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(matplotlib.ticker.NullLocator())


def finite(values):
    return [math.nan if v is None else float(v) for v in values]


def save(figure, stamp, title):
    """SVG text with themed colours, a title for screen readers and the stamp (commit, date) in the corner."""
    height = figure.get_figheight() * 72.0
    figure.text(1.0 - 6.0 / WIDTH, 5.0 / height, stamp, ha="right", va="bottom", fontsize=9, color=MUTED)
    figure.patch.set_facecolor(PAPER)
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Title": title, "Creator": None})
    return _theme(buffer.getvalue())


def _theme(svg):
    svg = svg[svg.index("<svg"):]
    svg = re.sub(r'width="([\d.]+)pt"', r'width="\1"', svg, count=1)
    svg = re.sub(r'height="([\d.]+)pt"', r'height="\1"', svg, count=1)
    svg = re.sub(r"#0[0-9]0[0-9]0[0-9]", lambda m: f"var(--{COLOURS[m.group()][0]})" if m.group() in COLOURS else m.group(), svg)
    svg = svg.replace("'DejaVu Sans'", FONTS.replace('"', "'"))
    light = "".join(f"--{name}:{colour};" for name, colour, _ in COLOURS.values())
    dark = "".join(f"--{name}:{colour};" for name, _, colour in COLOURS.values())
    style = f"<style>:root{{{light}}}@media screen and (prefers-color-scheme:dark){{:root{{{dark}}}}}</style>"
    end = svg.index(">") + 1
    return '<?xml version="1.0" encoding="utf-8"?>\n' + svg[:end] + style + svg[end:]


def axis_label(axis):
    return with_unit(axis["label"], axis["unit"])


