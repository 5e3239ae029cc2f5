"""The commands nightly and history: what they are asked, what they print, what they return."""

import argparse
import fnmatch
import json
import shutil
import sys
from pathlib import Path

from gate import baseline, ledger, outputs
from gate.command import build_report, exit_code, load, new_folder, run_tier
from gate.compare import TIERS, compare
from gate.files import GateError, locked, write_whole
from night import series, store, summary
from reports.numbers import duration, number, unit


def parser():
    main = argparse.ArgumentParser(prog="./furrow", add_help=False)
    commands = main.add_subparsers(dest="command", required=True)

    nightly = commands.add_parser("nightly", help="run the nightly tier, keep the history, report", epilog=(
        "Prints one screen of text for mail or chat. Exit codes as of gate: 0 nothing red, 1 red, 2 wrong usage or a broken "
        "baseline, 3 a case ended as error or the history could not be written, 130 interrupted. examples/nightly.cron runs it "
        "every night. Example: ./furrow nightly"))
    nightly.add_argument("--tier", choices=TIERS, default="nightly", help="tier to run (default: nightly)")
    nightly.add_argument("--only", action="append", default=[], metavar="GLOB", help="only cases whose id matches")
    nightly.add_argument("--out", type=Path, metavar="DIR", help="folder of the run (default: runs/<date>-<time>-nightly)")
    nightly.add_argument("--jobs", type=int, metavar="N", help="cases side by side")
    nightly.add_argument("--threads", type=int, metavar="N", help="threads of each case")
    nightly.add_argument("--resume", action="store_true", help="go on with the night in --out, which was cut short")
    nightly.add_argument("--no-report", action="store_true", help="leave the report out")

    history = commands.add_parser("history", help="what was measured, night by night", epilog=(
        "Without a name, the nights. With one, every series whose name <case>/<metric> or <case>/cpu_s matches: its course, "
        "its steps, and the first commit after each. Example: ./furrow history 'taylor-bar/*/final_length'"))
    history.add_argument("metric", nargs="?", metavar="METRIC", help="name of a series, or a pattern")
    history.add_argument("--steps", action="store_true", help="only series that stepped, the latest step first")
    history.add_argument("--last", type=int, default=series.SHOWN, metavar="N",
                         help=f"nights to look at (default: {series.SHOWN})")
    history.add_argument("--add", type=Path, nargs="+", metavar="RUN", help="add runs that are there to the history")
    history.add_argument("--json", action="store_true", help="as JSON")
    for command in (nightly, history):
        command.add_argument("--history", type=Path, default=store.FILE, metavar="FILE",
                             help="the SQLite file (default: runs/history.sqlite)")
        command.add_argument("--baselines", type=Path, default=baseline.FOLDER, help=argparse.SUPPRESS)
    return main


def nightly(arguments):
    baselines, entries = baseline.read_all(arguments.baselines), ledger.read(arguments.baselines)
    if arguments.resume and not arguments.out:
        raise GateError("--resume goes on with the night in --out DIR")
    faults = history_faults(arguments.history)
    for fault in faults:   # said before the hours of the run, and again after them: the run itself is worth having
        print(f"furrow: {fault}", file=sys.stderr)
    folder = arguments.out or new_folder("nightly")
    with locked(folder, "nightly"):
        arguments.quiet = True
        run_tier(arguments, folder, arguments.tier)
        run = load(folder)
        comparison = compare(run, baselines, entries)
        outputs.write(run, comparison, baselines)
        nights, found = [], []
        if not faults:
            try:
                nights, found = remember(run, arguments.history, baselines)
            except GateError as error:
                faults.append(str(error))
        report = None if arguments.no_report else build_report(folder, run)
        text = summary.text(run, comparison, found, nights, report, faults)
        write_whole(folder / "summary.txt", text + "\n")
    print(text)
    return max(comparison.exit_code, 3 if faults else 0)


def history_faults(path):
    try:
        with store.opened(path, create=True):
            return []
    except GateError as error:
        return [f"{error}. This night is not in it: './furrow history --add' its folder afterwards."]


def remember(run, path, baselines):
    """Adds the run to the history and writes RUN/history.json. Returns (nights, series)."""
    with store.opened(path, create=True) as connection:
        added = store.add(connection, run)
        nights = store.nights(connection, series.SHOWN)
        found = series.read(connection, nights, baselines) if any(n.id == added for n in nights) else []
    ran = {c.id for c in run.cases}
    of_run = [s for s in found if s.case in ran or s.case.startswith("run")]
    write_whole(run.folder / "history.json", json.dumps(series.to_report(of_run, nights), allow_nan=False) + "\n")
    return nights, of_run


def history(arguments):
    if arguments.last < 1:
        raise GateError(f"--last {arguments.last}: expected 1 or more")
    if arguments.add:
        runs = [load(folder) for folder in arguments.add]
        with store.opened(arguments.history, create=True) as connection:
            for run in runs:
                store.add(connection, run)
        print(f"{len(runs)} run{'s' * (len(runs) > 1)} added to {arguments.history}")
        return 0
    baselines = baseline.read_all(arguments.baselines)
    with store.opened(arguments.history) as connection:
        nights = store.nights(connection, arguments.last)
        if not arguments.metric and not arguments.steps:
            counts = [store.verdicts(connection, n.id) for n in nights]
            print(json.dumps([vars(n) | {"cases": c} for n, c in zip(nights, counts)], indent=1) if arguments.json
                  else the_nights(nights, counts))
            return 0
        found = series.read(connection, nights, baselines)
    chosen = [s for s in found if fnmatch.fnmatchcase(s.key, arguments.metric or "*") and (s.steps or not arguments.steps)]
    if not chosen:
        if arguments.steps and not arguments.metric:
            print(f"nothing stepped in {len(nights)} nights")
            return 0
        raise GateError(f"{arguments.metric}: no series of this name{' stepped' if arguments.steps else ''}; "
                        "names are <case>/<metric>, patterns are allowed")
    if arguments.steps:
        chosen.sort(key=lambda s: (-s.places[s.steps[-1].index], -s.jump(s.steps[-1]), s.key))
    if arguments.json:
        print(json.dumps(series.to_report(chosen, nights), indent=1))
    else:
        print("\n".join(course(s, nights) for s in chosen))
        if len(chosen) == 1:
            print(one_by_one(chosen[0], nights))
    return 0


def the_nights(nights, counts):
    """A line a night, the latest last."""
    lines = [f"{'began':<16}  {'commit':<9} {'tier':<8} {'pass':>5} {'fail':>5} {'error':>5} {'gap':>4}  {'CPU':>12}  folder"]
    for n, c in zip(nights, counts):
        began = n.started[:16].replace("T", " ")
        lines.append(f"{began:<16}  {n.commit[:8]}{'*' if n.dirty else ' '} {n.tier or '':<8} {c.get('pass', 0):>5} "
                     f"{c.get('fail', 0):>5} {c.get('error', 0):>5} {c.get('known-gap', 0):>4}  {duration(n.cpu_s):>12}  {n.folder}")
    return "\n".join(lines + (["* dirty tree"] if any(n.dirty for n in nights) else []))


def course(s, nights):
    """Name, sparkline and last value of a series, and a line a step."""
    tail = f" {unit(s.unit)}" if unit(s.unit) else ""
    room = max(20, shutil.get_terminal_size((100, 24)).columns - 44)
    lines = [f"{s.key:<{room}}  {series.sparkline(s.values)}  {number(s.values[-1], 6)}{tail}"]
    return "\n".join(lines + [f"  step {series.step_words(s, step, nights)}" for step in s.steps])


def one_by_one(s, nights):
    return "\n".join(f"  {nights[p].started[:16].replace('T', ' ')}  {nights[p].commit[:8]}  {v!r}"
                     for p, v in zip(s.places, s.values))


def main(words):
    arguments = parser().parse_args(words)
    return exit_code(lambda: {"nightly": nightly, "history": history}[arguments.command](arguments))
