"""What the templates ask for: words and small graphics made from one metric, one case or one value."""

import datetime
import re

from markupsafe import Markup

from reports import numbers


def _in_percent(metric):
    """Relative errors whose band is wide enough to be read in percent."""
    ends = [abs(e) for e in metric["band"] or [] if e]
    return "relative" in metric["norm"] and bool(ends) and max(ends) >= 1e-3


def _band_unit(metric):
    return "1" if "relative" in metric["norm"] else metric["unit"]


def error_words(metric):
    if metric["error"] is None or metric["norm"].split()[-1:] == ["value"] and "relative" not in metric["norm"]:
        return "–"   # the band is on the value itself
    if _in_percent(metric):
        return f"{numbers.number(100.0 * metric['error'], 3)}\u202f%"
    return numbers.quantity(metric["error"], _band_unit(metric))


def band_words(metric):
    if _in_percent(metric):
        return numbers.band(metric["band"], "%", 100.0)
    return numbers.band(metric["band"], _band_unit(metric))


def signed(part):
    """A relative deviation in percent with its sign; a dash where there is none."""
    return "–" if part is None else f"{'+' if part > 0.0 else ''}{numbers.number(100.0 * part, 2)}\u202f%"


def share(part):
    """A relative uncertainty in percent; a dash where there is none."""
    return "–" if part is None else f"{numbers.number(100.0 * part, 2)}\u202f%"


def bar(margin, verdict):
    """Small graphic: the band as a track between its ends, a mark where the number lies, outside it where it is outside."""
    if margin is None or margin.band == (None, None):
        return Markup("")
    low, high = margin.band
    left, right, middle = (18.0, 102.0, 8.0) if low != high else (60.0, 60.0, 8.0)
    parts = [f'<rect class="track" x="{left if low is not None else 2:g}" y="{middle - 3:g}" '
             f'width="{(right if high is not None else 118) - (left if low is not None else 2):g}" height="6" rx="3"/>']
    for end, x in ((low, left), (high, right)):
        if end is not None:
            parts.append(f'<line class="end" x1="{x:g}" x2="{x:g}" y1="1.5" y2="14.5"/>')
    place = margin.place
    if place is None:
        parts.append('<text class="none" x="60" y="11.6" text-anchor="middle">no number</text>')
        said = "no number"
    else:
        x = left + place * (right - left) if low != high else 60.0 * place / 0.5
        x = min(115.0, max(5.0, x))
        out = "" if margin.inside else " out"
        shape = f'<circle class="mark" cx="{x:.1f}" cy="{middle:g}" r="4"/>' if margin.inside else \
            f'<path class="mark" d="M{x - 4:.1f} {middle - 4:g}l8 8m0 -8l-8 8"/>'
        parts.append(f'<g class="at{out}">{shape}</g>')
        said = f"{'inside' if margin.inside else 'outside'} its band" + \
            (f", {numbers.percent(margin.use)} of it used" if margin.use is not None else "")
    return Markup(f'<svg class="bar" viewBox="0 0 120 16" role="img" aria-label="{said}"><title>{said}</title>'
                  f'{"".join(parts)}</svg>')


def flatten(parameters, prefix=""):
    """Parameters as rows (key, text): numbers with units in one cell, tables under dotted keys."""
    for key, value in parameters.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict) and set(value) == {"value", "unit"}:
            yield name, _plain(value["value"], value["unit"])
        elif isinstance(value, dict):
            yield from flatten(value, name + ".")
        elif isinstance(value, list) and value and all(isinstance(v, dict) for v in value):
            for i, item in enumerate(value):
                yield from flatten(item, f"{name}[{i}].")
        else:
            yield name, _plain(value)


def _plain(value, unit="1"):
    shown = ", ".join(_plain(v) for v in value) if isinstance(value, list) else \
        numbers.number(value, 8) if isinstance(value, (int, float)) else str(value)
    tail = numbers.unit(unit)
    return f"{shown}\u202f{tail}" if tail else shown


def spacing_words(metric):
    """'at Δx = 1 mm, h/Δx = 1.2' for a metric of one resolution."""
    at = metric.get("at", {})
    parts = []
    if at.get("spacing"):
        factor, unit = numbers.prefixed(at["spacing"], "m")
        parts.append(f"Δx = {numbers.quantity(factor * at['spacing'], unit)}")
    if at.get("h_over_dx"):
        parts.append(f"h/Δx = {numbers.number(at['h_over_dx'])}")
    return "at " + ", ".join(parts) if parts else ""


def common_rung(case):
    """The words of spacing_words where they are the same for every metric of the case, so that they are said once; else ''."""
    found = {spacing_words(m) for m, _ in case.metrics}
    return found.pop() if len(found) == 1 else ""


def expiry(case, run):
    """(date, whether the run was later) of a known gap that states 'expires 2026-12-31' or 'until 2026-12-31' in its reason."""
    match = re.search(r"\b(?:expir\w*|until|expiry:?)\s+(?:on\s+)?(\d{4}-\d{2}-\d{2})", case.reason)
    if not match:
        return None, False
    started = str(run.provenance.get("started", ""))[:10]
    return match.group(1), bool(started) and started > match.group(1)


def when(text):
    """An ISO time as '31 January 2026, 14:05'; anything else as it is."""
    try:
        moment = datetime.datetime.fromisoformat(str(text).replace("Z", "+00:00"))
    except ValueError:
        return str(text)
    zone = " UTC" if moment.utcoffset() == datetime.timedelta(0) else ""
    return f"{moment.day} {moment:%B %Y, %H:%M}{zone}"
