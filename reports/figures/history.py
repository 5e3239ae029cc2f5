"""Time series of a case: one figure for each unit, so that quantities that can be compared share an axis."""

import h5py
import numpy as np

from reports.figures import lines
from reports.numbers import prefixed

MOST_CURVES = 6   # in one figure


def groups(path):
    """[(unit, [names])] of the series in a history file, at most MOST_CURVES together. OSError or KeyError for another file."""
    found = {}
    with h5py.File(path, "r") as file:
        length = len(file["time"])
        order = [n if isinstance(n, str) else n.decode() for n in file.attrs.get("columns", [])]   # HDF5 itself sorts by alphabet
        for name in sorted(file, key=lambda n: order.index(n) if n in order else len(order)):
            item = file[name]
            if name != "time" and isinstance(item, h5py.Dataset) and item.ndim == 1 and len(item) == length:
                found.setdefault(_unit(item), []).append(name)
    return [(unit, names[i:i + MOST_CURVES]) for unit, names in found.items() for i in range(0, len(names), MOST_CURVES)]


def draw(path, unit, names, stamp):
    with h5py.File(path, "r") as file:
        time, time_unit = np.asarray(file["time"], dtype=float), _unit(file["time"]) or "s"
        series = {name: np.asarray(file[name], dtype=float) for name in names}
    step = max(1, len(time) // 2000)   # more points than pixels help nobody
    factor, time_unit = prefixed(float(np.nanmax(np.abs(time), initial=0.0)), time_unit)
    largest = max((float(np.nanmax(np.abs(v[np.isfinite(v)]), initial=0.0)) for v in series.values()), default=0.0)
    scale, shown_unit = prefixed(largest, unit)
    words = [name.replace("_", " ") for name in names]
    return lines.draw({
        "title": "History of " + ", ".join(words), "kind": "lines",
        "x": {"label": "time", "unit": time_unit},
        "y": {"label": words[0] if len(words) == 1 else _common(words), "unit": shown_unit},
        "series": [{"label": word, "role": "computed", "x": list(factor * time[::step]), "y": list(scale * series[name][::step])}
                   for word, name in zip(words, names)],
    }, stamp)


def _common(words):
    """The last word that all names share ('energy' of kinetic and elastic energy), else nothing that would mislead."""
    tails = {word.split()[-1] for word in words}
    return tails.pop() if len(tails) == 1 else "quantity"


def _unit(dataset):
    value = dataset.attrs.get("unit", "")
    return value.decode() if isinstance(value, bytes) else str(value)
