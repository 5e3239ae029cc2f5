"""Predicted over measured: what all comparisons with experiments of a run say together, by material and quantity.

Bias and scatter as fire-model validation guides state them (K. McGrattan, B. Toman: Quantifying the predictive uncertainty of
complex numerical models, Metrologia 48 (2011) 173): with r = predicted/measured of each point, its mean of ln r and variance, and
the experiments' relative standard uncertainty u, the model's relative standard deviation is sqrt(var(ln r) - u^2) and its bias
factor exp(mean(ln r) + half of that variance). The numerical part comes from ladders of spacing and stands apart.
"""

import math
from dataclasses import dataclass, field

from reports import numbers
from reports.figures import ladder


@dataclass
class Point:
    case: object
    measured: float
    predicted: float
    uncertainty: float           # standard, of the measured value
    unit: str
    grid: float | None = None    # relative numerical uncertainty, where the ladder states one
    limit: float | None = None   # value at vanishing spacing: extrapolated, else the finest of the ladder


@dataclass
class Group:
    quantity: str
    material: str
    points: list = field(default_factory=list)

    def _logs(self, value):
        return [math.log(value(p) / p.measured) for p in self.points if value(p) is not None]

    @property
    def experiment(self):
        """Root mean square of the experiments' relative standard uncertainties."""
        return math.sqrt(sum((p.uncertainty / p.measured) ** 2 for p in self.points) / len(self.points))

    @property
    def scatter(self):
        """Relative standard deviation of the model, the experiments' part taken off; None for fewer than two points."""
        logs = self._logs(lambda p: p.predicted)
        if len(logs) < 2:
            return None
        mean = sum(logs) / len(logs)
        return math.sqrt(max(0.0, sum((x - mean) ** 2 for x in logs) / (len(logs) - 1) - self.experiment**2))

    @property
    def bias(self):
        """Bias less one: 0.02 is a model that predicts 2 % too much in the mean."""
        logs = self._logs(lambda p: p.predicted)
        return math.exp(sum(logs) / len(logs) + 0.5 * (self.scatter or 0.0) ** 2) - 1.0

    @property
    def bias_at_limit(self):
        """Bias of the points with a ladder at vanishing spacing, less one: the model's own; None where there is none."""
        logs = self._logs(lambda p: p.limit)
        if not logs:
            return None
        return math.exp(sum(logs) / len(logs) + 0.5 * (self.scatter or 0.0) ** 2) - 1.0

    @property
    def grid(self):
        """Largest relative numerical uncertainty of the points that state one."""
        return max((p.grid for p in self.points if p.grid is not None), default=None)


def groups(run):
    """Every metric of the run that compares a length, time, force, ... with one measured value, by quantity and material."""
    found = {}
    for case in run.cases:
        if case.faults:
            continue
        material = case.data.get("parameters", {}).get("material")
        for metric, _ in case.metrics:
            reference = metric["reference"]["value"] if metric.get("reference") else None
            value = metric["value"]
            if metric["class"] != "experiment" or "relative" not in metric["norm"] or not isinstance(material, str):
                continue
            if not (_positive(reference) and _positive(value)):
                continue
            point = Point(case, reference, value, metric["reference"].get("standard_uncertainty") or 0.0, metric["unit"])
            for steps in ladder.ladders_of(metric)[:1]:
                point.grid = steps.get("gci")
                point.limit = steps.get("extrapolated") or (value if point.grid is not None else None)
            found.setdefault((metric["name"], material), Group(metric["name"], material)).points.append(point)
    return [found[key] for key in sorted(found)]


def _positive(value):
    return isinstance(value, (int, float)) and math.isfinite(value) and value > 0.0


def figures(all_groups):
    """A scatter a quantity: data for a figure of kind points, one series a material, with the line of agreement."""
    by_quantity = {}
    for group in all_groups:
        by_quantity.setdefault(group.quantity, []).append(group)
    drawn = []
    for quantity, members in by_quantity.items():
        points = [p for g in members for p in g.points]
        low = 0.9 * min(min(p.measured, p.predicted) for p in points)
        high = 1.05 * max(max(p.measured, p.predicted) for p in points)
        unit, u = points[0].unit, max(g.experiment for g in members)
        series = [{"label": g.material, "role": "computed", "x": [p.measured for p in g.points],
                   "y": [p.predicted for p in g.points]} for g in members]
        series.append({"label": "agreement", "role": "reference", "x": [low, high], "y": [low, high]})
        for factor, label in ((1.0 - 2.0 * u, "two standard uncertainties of the experiment"), (1.0 + 2.0 * u, "")):
            series.append({"label": label, "role": "bound", "x": [low, high], "y": [factor * low, factor * high]})
        name = numbers.words(quantity)
        drawn.append({"name": quantity, "title": f"{name[0].upper()}{name[1:]}: predicted over measured", "kind": "points",
                      "caption": f"{len(points)} comparisons with experiments.",
                      "x": {"label": f"measured {name}", "unit": unit}, "y": {"label": f"predicted {name}", "unit": unit},
                      "series": series})
    return drawn
