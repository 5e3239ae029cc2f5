"""The course of metrics and costs over the nights, as the night wrote it beside the run (RUN/history.json): sparklines and
steps."""

import math
from dataclasses import dataclass, field

from markupsafe import Markup, escape

from reports import numbers
from reports.results import read_json

WIDTH, HEIGHT, EDGE = 96.0, 22.0, 3.0
COST_WORDS = {"cpu_s": "CPU time", "peak_rss_bytes": "peak memory"}


@dataclass
class Trends:
    nights: list = field(default_factory=list)     # {commit, started, dirty, tier} of each night, oldest first
    series: list = field(default_factory=list)
    fault: str = ""

    def __post_init__(self):
        self._by_name = {(s["case"], s["name"]): s for s in self.series}

    def __bool__(self):
        return bool(self.series)

    def of(self, case, name):
        return self._by_name.get((case, name))

    @property
    def stepped(self):
        """Series with steps, the latest step first."""
        return sorted((s for s in self.series if s["steps"]),
                      key=lambda s: (-s["places"][s["steps"][-1]["index"]], s["kind"], s["case"], s["name"]))


def load(folder):
    """Trends of a run folder; empty for a run that is part of no history, with `fault` where its file cannot be read."""
    path = folder / "history.json"
    if not path.exists():
        return Trends()
    try:
        data = read_json(path)
        for s in data["series"]:
            if len(s["places"]) != len(s["values"]) or not all(math.isfinite(v) for v in s["values"]):
                raise ValueError(f"{s['case']} {s['name']} is not a series")
        return Trends(data["runs"], data["series"])
    except (ValueError, KeyError, TypeError, OSError) as error:
        return Trends(fault=f"history.json: {error}")


def name(series):
    words = COST_WORDS if series["kind"] == "cost" else {}
    return words.get(series["name"], numbers.words(series["name"]))


def last(series):
    if series["name"] == "peak_rss_bytes":
        return numbers.size(series["values"][-1])
    if series["kind"] == "cost":
        return numbers.duration(series["values"][-1])
    return numbers.quantity(series["values"][-1], series["unit"])


def sparkline(series, nights):
    """A small line over the nights, a tick where it stepped, a dot on the last night; holes are left open."""
    if not series or not series["values"]:
        return Markup("")
    values, places = series["values"], series["places"]
    low, high = min(values), max(values)
    span = high - low

    def x(place):
        return EDGE + (WIDTH - 2 * EDGE) * (place / (len(nights) - 1) if len(nights) > 1 else 1.0)

    def y(value):
        return HEIGHT - EDGE - (HEIGHT - 2 * EDGE) * ((value - low) / span if span > 0.0 and math.isfinite(span) else 0.5)

    path, previous = "", None
    for place, value in zip(places, values):
        path += f"{'L' if previous is not None and place == previous + 1 else 'M'}{x(place):.1f} {y(value):.1f}"
        previous = place
    ticks = "".join(f'<line class="step" x1="{at:.1f}" x2="{at:.1f}" y1="1" y2="{HEIGHT - 1:g}"/>'
                    for at in (x(places[s["index"]]) for s in series["steps"]))
    count = len(series["steps"])
    said = f"{len(values)} nights, last {last(series)}" + (f", {count} step{'s' if count > 1 else ''}" if count else ", no step")
    return Markup(f'<svg class="spark" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="img" aria-label="{escape(said)}">'
                  f'<title>{escape(said)}</title>'
                  f'{ticks}<path d="{path}"/><circle cx="{x(places[-1]):.1f}" cy="{y(values[-1]):.1f}" r="2.4"/></svg>')
