"""python3 -m reports RUNDIR: writes RUNDIR/report/ from RUNDIR/run.json and every result.json below RUNDIR."""

import argparse
import sys
from pathlib import Path

from reports.pages import build
from reports.results import ReportError


def main():
    parser = argparse.ArgumentParser(prog="python3 -m reports", description=__doc__,
                                     epilog="example: python3 -m reports runs/latest")
    parser.add_argument("run", type=Path, metavar="RUNDIR", help="folder of a run")
    parser.add_argument("--jobs", type=int, default=None, metavar="N", help="processes that draw figures (default: up to 2)")
    parser.add_argument("--quiet", action="store_true", help="print nothing when it went well")
    arguments = parser.parse_args()
    if arguments.jobs is not None and arguments.jobs < 1:
        parser.error("--jobs must be 1 or more")
    try:
        index = build(arguments.run, jobs=arguments.jobs)
    except ReportError as error:
        print(f"reports: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"reports: {error.filename}: {error.strerror}" if error.filename else f"reports: {error}", file=sys.stderr)
        return 2
    if not arguments.quiet:
        print(index)
    return 0


if __name__ == "__main__":
    sys.exit(main())
