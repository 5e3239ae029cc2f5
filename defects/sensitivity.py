"""The smallest change of each physical parameter that turns a case red, given to the solver alone: references keep theirs.

The program that has all switched defects takes each parameter times a factor from the environment as well (factors.patch). A change
is sought in either direction: from large to small by decades while something is red, then by bisection. Only what was red for a
larger change is run for a smaller one. Red is what the truth says, without any baseline.
"""

import datetime
import json
import math
from dataclasses import asdict, dataclass

from gate.compare import TIERS
from gate.files import ROOT, GateError, read_json, write_whole

FILE = ROOT / "reference" / "sensitivity.json"
LARGEST, SMALLEST, PRECISION = 0.3, 1e-9, 1.5   # of a relative change; the last is a ratio

SOLIDS = ("materials/linear_elastic", "materials/drucker_prager")
METAL = ("materials/johnson_cook",)
PARAMETERS = {   # name -> (modules, what it is)
    "phi": (("materials/drucker_prager",), "angle of friction"), "c": (("materials/drucker_prager",), "cohesion"),
    "A": (METAL, "Johnson-Cook: yield stress"), "B": (METAL, "Johnson-Cook: hardening"), "n": (METAL, "Johnson-Cook: exponent of hardening"),
    "C": (METAL, "Johnson-Cook: rate"), "m": (METAL, "Johnson-Cook: exponent of temperature"),
    "K": (SOLIDS, "bulk modulus"), "G": ((*SOLIDS, "materials/j2_plastic", *METAL), "shear modulus"),
    **{f"D{k}": (("materials/johnson_cook_damage",), f"Johnson-Cook damage: constant {k}") for k in range(1, 6)},
    "c0": (("materials/mie_grueneisen",), "bulk sound speed"), "S": (("materials/mie_grueneisen",), "slope of the Hugoniot"),
    "Gamma0": (("materials/mie_grueneisen",), "Grueneisen's constant"),
    "friction": (("boundaries/contact", "boundaries/wall"), "friction on tools, floors and walls"),
    "spacing": (("simulation",), "spacing that masses are made of"), "h_over_dx": (("simulation",), "smoothing length over spacing"),
}
SCOPES = {"point": lambda case: case.startswith("material-point/"), "bodies": lambda case: not case.startswith("material-point/")}


@dataclass
class Threshold:
    """The smallest change found of one parameter, in one direction, by cases of one scope up to a tier."""
    parameter: str
    tier: str
    scope: str
    direction: str            # up or down
    smallest: float | None    # relative change that is red; None: not even LARGEST is
    green: float              # relative change that is not; 0 where even SMALLEST is red
    case: str = ""            # that is red at `smallest`
    metric: str = ""
    commit: str = ""
    date: str = ""


def threshold(is_red, cases):
    """(smallest, green, case, metric) of is_red(change, cases) -> {case: metric} of those of the ids `cases` that are red."""
    change, red = LARGEST, is_red(LARGEST, cases)
    if not red:
        return None, LARGEST, "", ""
    low = 0.0
    while low == 0.0 and change / 10.0 >= SMALLEST:
        if less := is_red(change / 10.0, list(red)):
            change, red = change / 10.0, less
        else:
            low = change / 10.0
    while low and change / low > PRECISION:
        middle = math.sqrt(change * low)
        if less := is_red(middle, list(red)):
            change, red = middle, less
        else:
            low = middle
    return change, low, *min(red.items())


def seek(hunt, names, say):
    """Thresholds of these parameters, or of all, for each tier of the hunt and both scopes; `say` hears of each."""
    if unknown := [n for n in names if n not in PARAMETERS]:
        raise GateError(f"{unknown[0]}: no such parameter; there are {', '.join(PARAMETERS)}")
    clean, found = hunt.clean_of(hunt.switched), []
    for name in names or PARAMETERS:
        modules, _ = PARAMETERS[name]
        for k, tier in enumerate(hunt.tiers):
            for scope, belongs in SCOPES.items():
                cases = [c for c in clean.values() if c.data["tier"] in hunt.tiers[:k + 1] and belongs(c.id)
                         and any(m in c.data["exercises"] for m in modules)]
                if not any(c.data["tier"] == tier for c in cases):
                    continue   # nothing that a smaller tier has not said
                for direction, sign in (("up", 1.0), ("down", -1.0)):
                    def is_red(change, ids):
                        seen = hunt.look(hunt.switched, [clean[i] for i in ids], tier,
                                         {f"FURROW_FACTOR_{name}": repr(1.0 + sign * change)})
                        return {kill.case: kill.metric for kill in seen if kill.by == "truth"}
                    found.append(Threshold(name, tier, scope, direction, *threshold(is_red, [c.id for c in cases]), hunt.commit,
                                           datetime.date.today().isoformat()))
                    say(found[-1])
    return found


def read(path=FILE):
    """Thresholds of the record; empty without one. GateError when it cannot be read."""
    if not path.exists():
        return []
    try:
        data = read_json(path)
        if data["schema"] != 1:
            raise ValueError(f"schema {data['schema']!r}")
        return [Threshold(**t) for t in data["thresholds"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise GateError(f"{path}: no record of sensitivity: {error}; 'git checkout {path}' brings the last one back") from None


def write(found, path=FILE):
    """Adds to the record: what is found anew takes the place of what was known of the same parameter, tier, scope, direction."""
    def key(t):
        return list(PARAMETERS).index(t.parameter), TIERS.index(t.tier), t.scope, t.direction
    known = {key(t): t for t in (*(t for t in read(path) if t.parameter in PARAMETERS), *found)}
    lines = [f"  {json.dumps(asdict(known[k]), allow_nan=False)}" for k in sorted(known)]
    write_whole(path, '{\n "schema": 1,\n "thresholds": [\n' + ",\n".join(lines) + "\n ]\n}\n")


def line(t):
    size = f"more than {t.green:.0%}" if t.smallest is None else f"{t.smallest:.2g}" + ("" if t.green else " or less")
    by = f"  {t.case} {t.metric}" if t.case else ""
    return f"{t.parameter:<10} {t.tier:<8} {t.scope:<7} {t.direction:<5} {size:>14}{by}"
