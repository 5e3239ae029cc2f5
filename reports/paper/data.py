"""What a figure needs of one case: its result, its history, and soil and tool at the moment of each snapshot."""

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np


@dataclass
class Particles:
    time: float
    position: np.ndarray     # (n, 2), m
    start: np.ndarray        # (n, 2), m
    velocity: np.ndarray
    plastic_strain: np.ndarray
    damage: np.ndarray
    stress: np.ndarray       # von Mises, Pa
    volume: np.ndarray       # per width, m^2


@dataclass
class Case:
    id: str
    folder: Path
    result: dict

    @property
    def stamp(self):
        made = self.result["provenance"]
        return f"{self.id} · furrow {made['commit'][:10]}{'-dirty' if made.get('dirty') else ''} · {made['started'][:10]}"

    @property
    def speed(self):
        return self.result["parameters"]["speed"]["value"]

    @cached_property
    def history(self):
        with h5py.File(self.folder / "history.h5", "r") as file:
            return {name: np.asarray(file[name]) for name in file}

    def figure(self, name):
        return next((f for f in self.result.get("figures", []) if f["name"] == name), None)

    @cached_property
    def moments(self):
        """(soil, tool) of every snapshot, in time; the soil without its walls."""
        found = []
        for soil in sorted(self.folder.glob("snapshot-*.vtkhdf")):
            tool = soil.with_name(soil.name.replace("snapshot", "tool"))
            if tool.exists():
                found.append((read(soil), read(tool)))
        size = self.result["parameters"]
        length, height = (size[key]["value"] * 1e-3 for key in ("soil_length", "soil_height"))
        for soil, _ in found:
            inside = (soil.start[:, 0] > 0) & (soil.start[:, 0] < length) & (soil.start[:, 1] > 0) & (soil.start[:, 1] < height)
            for key in ("position", "start", "velocity", "plastic_strain", "damage", "stress", "volume"):
                setattr(soil, key, getattr(soil, key)[inside])
        return found

    def moment(self, time):
        """The snapshot nearest to a time, s."""
        return min(self.moments, key=lambda pair: abs(pair[0].time - time))


def read(path):
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        fields = root["PointData"]
        s = np.asarray(fields["stress"])
        shear = s[:, 1] ** 2 + s[:, 2] ** 2 + s[:, 5] ** 2
        mises = np.sqrt(0.5 * ((s[:, 0] - s[:, 4]) ** 2 + (s[:, 4] - s[:, 8]) ** 2 + (s[:, 8] - s[:, 0]) ** 2) + 3.0 * shear)
        return Particles(float(root["FieldData/time"][0]), np.asarray(root["Points"])[:, :2],
                         np.asarray(fields["reference_position"])[:, :2], np.asarray(fields["velocity"])[:, :2],
                         np.asarray(fields["plastic_strain"]), np.asarray(fields["damage"]), mises,
                         np.asarray(fields["mass"]) / np.asarray(fields["density"]))


def load(run, case):
    """The case of a run's folder, or None where it has no usable result."""
    folder = Path(run) / case
    try:
        result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    if result.get("verdict") == "error" or not (folder / "history.h5").exists():
        return None
    return Case(case, folder, result)
