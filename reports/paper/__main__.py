"""python3 -m reports.paper figures [--run RUNDIR] [--out DIR] [--force]: what ./furrow figures hands over to."""

import argparse
import os
import subprocess
import sys
from pathlib import Path

from reports.paper import data, draw

CASES = [f"tillage/{name}" for name in
         ("table1-2.0", "table1-1.0", "table1-0.5", "table1-steel-2.0", "clay-2.0", "clay-1.0", "clay-0.5", "clay-steel-2.0",
          "rock-2.0", "rock-1.0", "rock-0.5", "rock-steel-2.0")]
SETS = ("table1", "clay", "rock")


def main(arguments):
    parser = argparse.ArgumentParser(prog="./furrow figures", description="Draws the paper's Table 1 and figures 1 to 10 as PNG, SVG "
                                     "and PDF, running the cases that are missing.",
                                     epilog="Example: ./furrow figures --run runs/latest --out figures")
    parser.add_argument("--run", type=Path, default=Path("runs/figures"), metavar="DIR",
                        help="folder of results; cases missing there are run into it (default: runs/figures)")
    parser.add_argument("--out", type=Path, default=Path("figures"), metavar="DIR", help="where figures go (default: figures)")
    parser.add_argument("--only", nargs="+", choices=SETS, default=SETS, help="soils: the paper's, hard clay, a stone")
    parser.add_argument("--no-run", action="store_true", help="draw what there is and run nothing")
    given = parser.parse_args(arguments)
    wanted = [case for case in CASES if case.split("/")[1].split("-")[0] in given.only]
    missing = [case for case in wanted if data.load(given.run, case) is None]
    if missing and not given.no_run:
        program = os.environ.get("FURROW_PROGRAM", "./furrow")
        print(f"running {', '.join(missing)}", file=sys.stderr)
        began = (given.run / "run.json").exists()
        code = subprocess.call([program, "run", *missing, "--out", str(given.run), *(["--resume"] if began else [])])
        if code not in (0, 1):
            return code
    cases = {case: found for case in wanted if (found := data.load(given.run, case))}
    if not cases:
        print(f"figures: {given.run} has no result of {', '.join(wanted)}", file=sys.stderr)
        return 2
    absent = [case for case in wanted if case not in cases]
    given.out.mkdir(parents=True, exist_ok=True)
    for path in draw.everything(cases, given.out, given.only):
        print(path)
    if absent:
        print(f"figures: without {', '.join(absent)}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[2:] if sys.argv[1:2] == ["figures"] else sys.argv[1:]))
