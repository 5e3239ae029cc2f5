"""Who may include whom. The levels go from the bottom up; a room sees itself and the levels below it, never sideways or up."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

LEVELS = [
    ["solver/modules"],
    ["solver/tensor"],
    ["solver/smoothing", "solver/particles", "solver/materials"],
    ["solver/schemes", "solver/boundaries"],
    ["solver/body"],
    ["solver/integrators"],
    ["solver/simulation"],
    ["solver/coupled_simulation"],
    ["solver/io"],
    ["harness"],
    ["verification", "validation"],
]
EXACT = "reference/exact"   # the truth shares no code with the accused: it includes itself only, and only the cases include it


def room_of(path):
    """Room of a file or of an included path; None for the top level."""
    parts = Path(path).as_posix()
    for room in [EXACT] + [room for level in LEVELS for room in level]:
        if parts.startswith((room + "/", room + ".", room + "_")):   # body_forces.cpp is a part of body
            return room
    return None


def may_include(room, included):
    if room == included:
        return True
    if EXACT in (room, included):
        return room in LEVELS[-1] and included == EXACT
    level = {r: i for i, rooms in enumerate(LEVELS) for r in rooms}
    return level[included] < level[room]


def includes(file):
    """Quoted includes with their line numbers; every path is from the root."""
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        if match := re.match(r'\s*#\s*include\s*"([^"]+)"', line):
            yield number, match.group(1)


def sources():
    folders = ["solver", "harness", "reference", "verification", "validation"]
    return sorted(f for folder in folders for f in (ROOT / folder).rglob("*.[ch]pp"))


def faults_of(file, root=ROOT):
    place, room = file.relative_to(root).as_posix(), room_of(file.relative_to(root))
    if room is None:
        return [f"{place}: lies in no room"]
    faults = []
    for number, path in includes(file):
        included = room_of(path)
        if included is None:
            faults.append(f'{place}:{number}: includes "{path}", which is no path from the root into a room')
        elif not may_include(room, included):
            faults.append(f"{place}:{number}: {room} may not include {included}")
    return faults


def test_nothing_points_the_wrong_way():
    files = sources()
    assert len(files) > 20
    assert [fault for file in files for fault in faults_of(file)] == []


@pytest.mark.parametrize("place, line, fault", [
    ("solver/materials/elastic.hpp", '#include "harness/case.hpp"', "solver/materials may not include harness"),
    ("solver/particles/cells.hpp", '#include "solver/schemes/momentum.hpp"', "solver/particles may not include solver/schemes"),
    ("reference/exact/bar.cpp", '#include "solver/tensor/tensor.hpp"', "reference/exact may not include solver/tensor"),
    ("reference/exact/bar.cpp", '#include "harness/units.hpp"', "reference/exact may not include harness"),
    ("harness/gate.cpp", '#include "reference/exact/bar.hpp"', "harness may not include reference/exact"),
    ("harness/gate.cpp", '#include "verification/families.hpp"', "harness may not include verification"),
    ("verification/kernel/case.cpp", '#include "problems.hpp"', "no path from the root"),
    ("solver/helpers/x.hpp", "", "lies in no room"),
])
def test_a_wrong_include_is_found(tmp_path, place, line, fault):
    file = tmp_path / place
    file.parent.mkdir(parents=True)
    file.write_text(f"#pragma once\n{line}\n")
    faults = faults_of(file, tmp_path)
    assert len(faults) == 1 and fault in faults[0]


@pytest.mark.parametrize("place, line", [
    ("solver/simulation.cpp", '#include "solver/integrators/leapfrog.hpp"'),
    ("verification/kernel/case.cpp", '#include "reference/exact/kernels.hpp"'),
    ("verification/kernel/case.cpp", '#include "harness/case.hpp"'),
    ("reference/exact/bar.cpp", '#include "reference/exact/bar.hpp"'),
])
def test_a_right_include_is_let_through(tmp_path, place, line):
    file = tmp_path / place
    file.parent.mkdir(parents=True)
    file.write_text(f"#pragma once\n{line}\n")
    assert faults_of(file, tmp_path) == []
