"""Figures 1 to 10 and Table 1. Each is drawn from result files alone and stamped with the cases that it shows."""

import re
import tomllib
from pathlib import Path

import matplotlib
import matplotlib.figure
import numpy as np

from reports.figures.style import COLOURS

ROOT = Path(__file__).resolve().parent.parent.parent
TIMES = (0.0, 0.7, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0)   # ms, those of the paper's figures, at 2 m/s
LIGHT = {name: light for name, light, _ in COLOURS.values()}
NAMES = {"table1": "Table 1 as published", "clay": "dry hard clay", "rock": "a fixed stone"}
FORMATS = ("png", "svg", "pdf")
matplotlib.rcParams.update({"svg.hashsalt": "furrow", "font.size": 9, "axes.edgecolor": LIGHT["muted"], "axes.linewidth": 0.8,
                            "xtick.color": LIGHT["muted"], "ytick.color": LIGHT["muted"], "text.color": LIGHT["ink"]})


def everything(cases, out, sets):
    """Draws all that the cases allow; yields the paths written."""
    yield from _save(table_1(cases), out, "table-1", list(cases.values())[:1])
    yield from _save(flow_of_program(), out, "figure-02-program", list(cases.values())[:1])
    for word in sets:
        main = cases.get(f"tillage/{word}-2.0")
        if main is None or not main.moments:
            continue
        for number, name, drawn in ((1, "interface", interface), (3, "model", model), (4, "deformation", deformation),
                                    (7, "plastic-strain", plastic_strain), (8, "displacement", displacement),
                                    (9, "velocity", velocity)):
            yield from _save(drawn(main, NAMES[word]), out, f"figure-{number:02d}-{name}-{word}", [main])
        yield from _save(deflection(main, NAMES[word]), out, f"figure-05-deflection-{word}", [main])
        steel = cases.get(f"tillage/{word}-steel-2.0")
        if steel:
            yield from _save(materials(main, steel, NAMES[word]), out, f"figure-06-materials-{word}", [main, steel])
        speeds = [case for v in ("0.5", "1.0", "2.0") if (case := cases.get(f"tillage/{word}-{v}"))]
        yield from _save(forces(speeds, NAMES[word]), out, f"figure-10-force-{word}", speeds)


def _save(figure, out, name, cases):
    figure.text(0.995, 0.004, "; ".join(case.stamp for case in cases), ha="right", va="bottom", fontsize=6, color=LIGHT["muted"])
    for kind in FORMATS:
        path = Path(out) / f"{name}.{kind}"
        figure.savefig(path, dpi=200, facecolor="white", metadata={"CreationDate": None} if kind == "pdf" else
                       {"Date": None} if kind == "svg" else None)
        yield path


def _panels(title, rows=4, columns=2, width=9.0, height=9.5):
    figure = matplotlib.figure.Figure(figsize=(width, height))
    figure.suptitle(title, fontsize=11, x=0.02, ha="left")
    axes = np.atleast_1d(figure.subplots(rows, columns)).ravel()
    figure.subplots_adjust(left=0.06, right=0.97, bottom=0.10, top=0.93, hspace=0.35, wspace=0.12)
    return figure, axes


def _shape(axes, words=""):
    axes.set_aspect("equal")
    axes.set_title(words, fontsize=8, loc="left", color=LIGHT["ink"])
    axes.set_xlabel("x [mm]", fontsize=7, labelpad=1)
    axes.set_ylabel("y [mm]", fontsize=7, labelpad=1)
    axes.tick_params(labelsize=7)


def _dots(axes, points, size, **look):
    return axes.scatter(1e3 * points[:, 0], 1e3 * points[:, 1], s=size, linewidths=0, rasterized=True, **look)


def _rigid(axes, case, tool):
    """The rigid part of the tool, as its outline moves with the clamp."""
    p = case.result["parameters"]
    rake, gap = np.radians(p["rake"]["value"]), p["gap"]["value"]
    length, thickness, free = p["blade_length"]["value"], p["thickness"]["value"], p["tool"]["free_length"]["value"]
    edge = np.array([p["soil_length"]["value"] + gap - 1e3 * case.speed * tool.time, p["soil_height"]["value"] - p["depth"]["value"]])
    u, back = np.array([np.cos(rake), np.sin(rake)]), np.array([np.sin(rake), -np.cos(rake)])
    corners = [edge + free * u, edge + free * u + thickness * back, edge + length * u + thickness * back, edge + length * u]
    axes.add_patch(matplotlib.patches.Polygon(corners, facecolor=LIGHT["grid"], edgecolor=LIGHT["muted"], linewidth=0.6))
    stone = p.get("stone")
    if stone:
        start = np.array([p["soil_length"]["value"] + gap, edge[1]])
        r = stone["radius"]["value"]
        centre = (start[0] - stone["ahead"]["value"], start[1] + stone["overlap"]["value"] - r)
        axes.add_patch(matplotlib.patches.Circle(centre, r, facecolor=LIGHT["muted"], edgecolor="none"))


def _sequence(case, title, colour, label, soil_coloured=True, zoom=None, top=None):
    figure, axes = _panels(title)
    times = [t * 1e-3 * 2.0 / case.speed for t in TIMES]
    shown = [case.moment(t) for t in times]
    values = [colour(soil, tool) for soil, tool in shown]
    high = top if top is not None else max(float(v.max()) for v in values) or 1.0
    for panel, (soil, tool), value in zip(axes, shown, values):
        _rigid(panel, case, tool)
        if soil_coloured:
            drawn = _dots(panel, soil.position, 5, c=value, cmap="viridis", vmin=0.0, vmax=high)
            _dots(panel, tool.position, 1.5, color=LIGHT["c2"])
        else:
            _dots(panel, soil.position, 5, color=LIGHT["grid"])
            drawn = _dots(panel, tool.position, 3, c=value, cmap="viridis", vmin=0.0, vmax=high)
            failed = tool.damage >= 1.0
            _dots(panel, tool.position[failed], 4, color=LIGHT["c2"])
        _shape(panel, f"t = {1e3 * soil.time:.1f} ms")
        if zoom:
            zoom(panel, tool)
    bar = figure.add_axes([0.3, 0.045, 0.4, 0.012])
    figure.colorbar(drawn, cax=bar, orientation="horizontal")
    bar.tick_params(labelsize=7)
    bar.set_title(label, fontsize=7, pad=2)
    return figure


def plastic_strain(case, name):
    return _sequence(case, f"Figure 7. Cumulative plastic strain of the soil: {name}", lambda soil, _: soil.plastic_strain,
                     "equivalent plastic strain [1]")


def displacement(case, name):
    return _sequence(case, f"Figure 8. Displacement of soil particles: {name}",
                     lambda soil, _: 1e3 * np.linalg.norm(soil.position - soil.start, axis=1), "displacement [mm]")


def deformation(case, name):
    def zoom(panel, tool):
        x, y = 1e3 * tool.position[:, 0], 1e3 * tool.position[:, 1]
        panel.set_xlim(x.min() - 6, x.max() + 6)
        panel.set_ylim(y.min() - 3, y.max() + 3)
    return _sequence(case, f"Figure 4. Deformation of the tool: {name}", lambda _, tool: 1e-6 * tool.stress,
                     "von Mises stress of the tool [MPa]; failed particles in orange", soil_coloured=False, zoom=zoom)


def velocity(case, name):
    figure, axes = _panels(f"Figure 9. Velocity: {name}")
    for panel, t in zip(axes, TIMES):
        soil, tool = case.moment(t * 1e-3 * 2.0 / case.speed)
        _rigid(panel, case, tool)
        step = max(1, len(soil.position) // 700)
        for body, pick in ((soil, slice(None, None, step)), (tool, slice(None, None, 6))):
            speed = np.linalg.norm(body.velocity[pick], axis=1)
            drawn = panel.quiver(1e3 * body.position[pick, 0], 1e3 * body.position[pick, 1], body.velocity[pick, 0],
                                 body.velocity[pick, 1], speed, cmap="viridis", clim=(0.0, 1.5 * case.speed),
                                 scale=30.0 * case.speed, width=0.002)
        _shape(panel, f"t = {1e3 * soil.time:.1f} ms")
    bar = figure.add_axes([0.3, 0.045, 0.4, 0.012])
    figure.colorbar(drawn, cax=bar, orientation="horizontal")
    bar.tick_params(labelsize=7)
    bar.set_title("speed [m/s]", fontsize=7, pad=2)
    return figure


def interface(case, name):
    soil, tool = case.moment(1e-3 * 2.0 / case.speed)
    figure, (panel,) = _panels(f"Figure 1. Particles near the interface: {name}", 1, 1, 6.0, 5.0)
    _dots(panel, soil.position, 60, color=LIGHT["c5"], label="soil")
    _dots(panel, tool.position, 12, color=LIGHT["c1"], label="tool")
    spacing = case.result["parameters"]["thickness"]["value"] / case.result["parameters"]["tool"]["across"]
    face = tool.position[np.argsort(np.abs(tool.start[:, 1] - np.median(tool.start[:, 1])))[:6]]
    near = face[np.argmin(face[:, 0])]
    distance = np.linalg.norm(soil.position - near, axis=1)
    centre = 1e3 * soil.position[np.argmin(distance)]
    dx = 1e3 * np.sqrt(np.median(soil.volume))
    panel.add_patch(matplotlib.patches.Circle(centre, 3.0 * dx, fill=False, edgecolor=LIGHT["ink"], linewidth=1.0))
    panel.annotate("support 2 h of a particle of soil", centre + (0, 3.0 * dx), fontsize=7, ha="center", va="bottom")
    panel.set_xlim(centre[0] - 6, centre[0] + 6)
    panel.set_ylim(centre[1] - 5, centre[1] + 5)
    _shape(panel, f"t = {1e3 * soil.time:.1f} ms; particles of the tool {spacing:g} mm apart. Bodies meet by contact; sums do not mix them")
    panel.legend(loc="upper right", fontsize=7, frameon=False)
    return figure


def model(case, name):
    soil, tool = case.moments[0]
    figure, (panel, detail) = _panels(f"Figure 3. Model: {name}", 1, 2, 9.0, 4.0)
    _rigid(panel, case, tool)
    _dots(panel, soil.position, 4, color=LIGHT["c5"])
    _dots(panel, tool.position, 1.5, color=LIGHT["c1"])
    p = case.result["parameters"]
    _shape(panel, f"(a) soil {p['soil_length']['value']:g} x {p['soil_height']['value']:g} mm, rake {p['rake']['value']:g} deg, depth {p['depth']['value']:g} mm")
    _rigid(detail, case, tool)
    _dots(detail, tool.position, 6, color=LIGHT["c1"])
    _shape(detail, f"(b) tool {p['blade_length']['value']:g} x {p['thickness']['value']:g} mm: rigid above (grey), {p['tool']['free_length']['value']:g} mm free")
    return figure


def _curves(title):
    figure = matplotlib.figure.Figure(figsize=(6.5, 4.2))
    figure.suptitle(title, fontsize=11, x=0.02, ha="left")
    axes = figure.add_axes([0.12, 0.15, 0.84, 0.74])
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.grid(True, color=LIGHT["grid"])
    return figure, axes


def deflection(case, name):
    figure, axes = _curves(f"Figure 5. Deflection of the tool's end: {name}")
    h = case.history
    axes.plot(1e3 * h["time"], 1e3 * h["tip_deflection"], color=LIGHT["c1"], label="computed")
    if name == NAMES["table1"]:
        axes.plot(1e3 * h["time"], 1e3 * h["beam_deflection"], color=LIGHT["muted"], linewidth=0.7, label="cantilever under the same forces")
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("deflection [mm]")
    axes.legend(frameon=False)
    return figure


def materials(aluminium, steel, name):
    figure, axes = _curves(f"Figure 6. Aluminium and steel: {name}")
    for case, word, colour in ((aluminium, "aluminium", "c1"), (steel, "steel 4340", "c2")):
        axes.plot(1e3 * case.history["time"], 1e3 * case.history["tip_deflection"], color=LIGHT[colour], label=word)
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("deflection of the end [mm]")
    axes.legend(frameon=False)
    return figure


def forces(cases, name):
    figure = matplotlib.figure.Figure(figsize=(6.5, 2.9 * len(cases) + 0.5))
    figure.suptitle(f"Figure 10. Cutting force: {name}", fontsize=11, x=0.02, ha="left")
    for k, (case, axes) in enumerate(zip(cases, np.atleast_1d(figure.subplots(len(cases), 1)).ravel())):
        force, stages = case.figure("force"), case.figure("stages")
        for series, colour in zip(force["series"], ("c1", "c3")):
            axes.plot(1e3 * np.array(series["x"]), series["y"], color=LIGHT[colour], linewidth=0.6, alpha=0.7, label=series["label"])
        for series in stages["series"] if stages else []:
            x, y = 1e3 * np.array(series["x"]), np.array(series["y"])
            if series["label"] == "mean":
                axes.plot(x, y, color=LIGHT["ink"], linewidth=1.4, label="magnitude, mean over 0.5 mm of travel")
            else:
                axes.annotate(series["label"], (x.mean(), y.max()), fontsize=7, ha="center", va="bottom", color=LIGHT["c2"])
                axes.axvspan(x[0], x[1], color=LIGHT["c2"], alpha=0.05 + 0.05 * (k % 2))
        axes.set_title(f"{case.speed:g} m/s", loc="left", fontsize=8)
        axes.set_xlabel("time [ms]", fontsize=8)
        axes.set_ylabel("force per width [N/m]", fontsize=8)
        axes.legend(frameon=False, fontsize=7)
    figure.tight_layout(rect=(0, 0.02, 1, 0.97))
    return figure


def flow_of_program():
    """The phases of a step as the time loop itself names them: the comments of Simulation::step, the coupled step's calls."""
    text = (ROOT / "solver" / "simulation.cpp").read_text(encoding="utf-8")
    body = text[text.index("::step(double end)"):text.index("::run_until")]
    phases = [line.strip().removeprefix("// ") for line in body.splitlines() if line.strip().startswith("//")]
    phases = [re.sub(r"\s+", " ", p) for p in phases]
    after = next((k for k, p in enumerate(phases) if p.startswith("Viscosity")), len(phases) - 1)
    inner = "Tool: hundreds of such steps to the same time, under contact forces that are held; then contact of soil and tool"
    steps = ["Set up soil, tool, contact", *phases[:after + 1], inner, *phases[after + 1:], "Energy, history, snapshot; next step"]
    figure = matplotlib.figure.Figure(figsize=(6.5, 0.75 * len(steps) + 0.8))
    figure.suptitle("Figure 2. Flow of the program", fontsize=11, x=0.02, ha="left")
    axes = figure.add_axes([0.02, 0.03, 0.96, 0.9])
    axes.set_axis_off()
    axes.set_xlim(0, 1)
    axes.set_ylim(-len(steps) + 0.5, 0.5)
    for k, words in enumerate(steps):
        axes.text(0.5, -k, words, ha="center", va="center", fontsize=8, wrap=True,
                  bbox=dict(boxstyle="round,pad=0.4", facecolor="white", edgecolor=LIGHT["c2"] if words == inner else LIGHT["c1"]))
        if k:
            axes.annotate("", (0.5, -k + 0.28), (0.5, -k + 0.72), arrowprops=dict(arrowstyle="->", color=LIGHT["muted"]))
    return figure


PRINTED = {("soil", "density"): "1540 kg/m^3", ("soil", "strength.cohesion"): "5 kPa", ("soil", "strength.friction_angle"): "28 deg",
           ("soil", "elasticity.bulk_modulus"): "1.5 MPa", ("soil", "elasticity.shear_modulus"): "0.9 MPa",
           ("tool", "density"): "2800 kg/m^3", ("tool", "elasticity.shear_modulus"): "26 GPa", ("tool", "strength.melting_temperature"): "925 K",
           ("tool", "heating.specific_heat"): "875 J/(kg K)", ("tool", "strength.A"): "324 MPa", ("tool", "strength.B"): "114 MPa",
           ("tool", "strength.n"): "0.002 1", ("tool", "strength.C"): "0.42 1", ("tool", "strength.m"): "1.34 1"}


def table_1(_):
    rows = []
    for (material, key), printed in PRINTED.items():
        with open(ROOT / "reference" / "materials" / f"{material}.toml", "rb") as file:
            entry = tomllib.load(file)
        for part in key.split("."):
            entry = entry[part]
        used = f"{entry['value']:g} {entry['unit']}"
        rows.append((material, key.split(".")[-1].replace("_", " "), printed.removesuffix(" 1"), used.removesuffix(" 1"), "" if used == printed else "differs"))
    figure = matplotlib.figure.Figure(figsize=(7.0, 0.28 * len(rows) + 1.2))
    figure.suptitle("Table 1. Material parameters: printed, and used", fontsize=11, x=0.02, ha="left")
    axes = figure.add_axes([0.02, 0.06, 0.96, 0.84])
    axes.set_axis_off()
    table = axes.table(rows, colLabels=("material", "property", "printed", "used", ""), loc="center", cellLoc="left", edges="horizontal")
    table.auto_set_font_size(False)
    table.set_fontsize(8)
    return figure
