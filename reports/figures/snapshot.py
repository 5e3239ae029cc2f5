"""A picture of a VTKHDF snapshot: particles at their positions, coloured by the quantity that tells most."""

import h5py
import numpy as np

from reports.figures import particles
from reports.numbers import prefixed, with_unit

TELLING = ("plastic_strain", "accumulated_plastic_strain", "equivalent_plastic_strain", "von_mises", "mises_stress", "velocity",
           "speed",
           "stress", "pressure", "damage", "temperature", "density")   # in the order in which they are preferred


def draw(path, stamp):
    """`path`: a VTKHDF file of an UnstructuredGrid of vertices. OSError or KeyError where it is not one."""
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        points = np.asarray(root["Points"], dtype=float)
        data = root.get("PointData", {})
        name, values = _most_telling(data)
        unit = _text(data[name].attrs.get("unit", "")) if name else ""
    extent = np.ptp(points, axis=0) if len(points) else np.zeros(3)
    across, up = sorted(np.argsort(extent, kind="stable")[::-1][:2])
    depth = ({0, 1, 2} - {across, up}).pop()
    order = np.argsort(points[:, depth], kind="stable")   # what lies nearer to the eye is painted later
    label = (name or "").replace("_", " ")
    if values is not None:
        values, label = _scalar(values, label)
        values = values[order]
    factor, length = prefixed(float(np.abs(points).max(initial=0.0)), "m")
    if values is not None and unit in ("m", "s", "Pa"):
        scale, unit = prefixed(float(np.nanmax(np.abs(values), initial=0.0)), unit)
        values = scale * values
    names = tuple(with_unit("xyz"[i], length) for i in (across, up))
    return particles.cloud(factor * points[order, across], factor * points[order, up], values, names, with_unit(label, unit), [],
                           stamp,
                           f"Particles of {path.name}")


def time(path):
    """Simulated time of a snapshot in s; None when the file does not tell."""
    try:
        with h5py.File(path, "r") as file:
            return float(file["VTKHDF/FieldData/time"][0])
    except (OSError, KeyError, IndexError):
        return None


def _most_telling(data):
    """(name, values) of the first field in the order of TELLING that is not the same everywhere; any field when all are."""
    names = [n for n in TELLING if n in data] + sorted(n for n in data if n not in TELLING and n not in ("id", "position"))
    for name in names:
        values = np.asarray(data[name], dtype=float)
        if len(values) and np.ptp(values, axis=0).max() > 0.0:
            return name, values
    return (names[0], np.asarray(data[names[0]], dtype=float)) if names else (None, None)


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def _scalar(values, label):
    """Vectors by magnitude, stresses (six or nine components) by von Mises' equivalent."""
    if values.ndim == 1:
        return values, label
    values = values.reshape(len(values), -1)
    if values.shape[1] in (6, 9):
        xx, yy, zz = (values[:, i] for i in ((0, 1, 2) if values.shape[1] == 6 else (0, 4, 8)))
        shear = (values[:, 3:] if values.shape[1] == 6 else values[:, [1, 2, 5]]) ** 2
        return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * shear.sum(axis=1)), f"von Mises {label}"
    return np.linalg.norm(values, axis=1), f"|{label}|"
