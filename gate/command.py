"""The commands gate, bless and noise: what they are asked, what they print, what they return."""

import argparse
import datetime
import os
import shutil
import sys
from pathlib import Path

from reports import results

from gate import baseline, child, ledger, noise, outputs, table
from gate.bless import bless as accept
from gate.compare import TIERS, compare
from gate.files import ROOT, GateError, locked


def parser():
    main = argparse.ArgumentParser(prog="./furrow", add_help=False)
    commands = main.add_subparsers(dest="command", required=True)

    gate = commands.add_parser("gate", help="compare a run with the accepted baselines", epilog=(
        "Exit codes: 0 nothing red, 1 red, 2 wrong usage or a broken baseline, 3 a case ended as error. Red: a metric outside "
        "its band that was inside when accepted, a move away from the truth, a new or lost metric, an error, a loosened band or "
        "known gap that the ledger does not record or whose time is over. A move toward the truth, or one that no reference can "
        "judge, is yellow: it asks for a blessing. Example: ./furrow gate --tier smoke"))
    gate.add_argument("run", nargs="?", type=Path, metavar="RUN", help="folder of a run; without it, the tier is run")
    gate.add_argument("--tier", choices=TIERS, default=None, help="tier to run (default: quick)")
    gate.add_argument("--only", action="append", default=[], metavar="GLOB", help="only cases whose id matches")
    gate.add_argument("--out", type=Path, metavar="DIR", help="folder of the run that is made")
    gate.add_argument("--jobs", type=int, metavar="N", help="cases side by side")
    gate.add_argument("--threads", type=int, metavar="N", help="threads of each case")
    gate.add_argument("--resume", action="store_true", help="go on with the run in --out")
    gate.add_argument("--all", action="store_true", help="show green rows too, and every row")
    gate.add_argument("--no-report", action="store_true", help="leave the report out")
    gate.add_argument("--quiet", action="store_true", help="print the last line alone")

    bless = commands.add_parser("bless", help="accept cases of a run as baselines", epilog=(
        "Refused: a case that failed or ended as error, a run from a dirty tree, an empty reason. A loosened band or a new known "
        "gap is recorded with its expiry. Example: ./furrow bless runs/latest 'kernel/*' --reason 'closed "
        "form corrected, see commit'"))
    bless.add_argument("run", type=Path, metavar="RUN", help="folder of a run")
    bless.add_argument("cases", nargs="+", metavar="CASE", help="ids of cases, or patterns")
    bless.add_argument("--reason", required=True, metavar="TEXT", help="why these numbers are the right ones now")
    bless.add_argument("--expires", type=_day, metavar="DATE", help="of a loosened band or known gap (default: in half a year)")

    measure = commands.add_parser("noise", help="measure how far metrics move without a cause", epilog=(
        "Takes two or more runs of one commit that are equally right (other compiler, optimisation, --particle-order) and keeps "
        "each metric's spread with its baseline. Example: ./furrow noise runs/a runs/b runs/c --reason 'g++ and "
        "clang++, two orders'"))
    measure.add_argument("runs", nargs="+", type=Path, metavar="RUN", help="folders of runs")
    measure.add_argument("--reason", required=True, metavar="TEXT", help="what the runs differ in")

    record = commands.add_parser("record")   # for the runner: what a report says about the baseline, never red
    record.add_argument("run", type=Path)
    for command in (gate, bless, measure, record):
        command.add_argument("--baselines", type=Path, default=baseline.FOLDER, help=argparse.SUPPRESS)
    return main


def _day(text):
    try:
        return datetime.date.fromisoformat(text).isoformat()
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no date such as 2027-05-22") from None


def load(folder):
    try:
        return results.load(folder)
    except results.ReportError as error:
        raise GateError(str(error)) from None


def run_tier(arguments, folder, tier):
    """Runs the tier into `folder`; GateError when nothing has run."""
    command = ["matrix", "--no-report", "--out", str(folder), "--tier", tier]
    for glob in arguments.only:
        command += ["--only", glob]
    for name in ("jobs", "threads"):
        if getattr(arguments, name):
            command += [f"--{name}", str(getattr(arguments, name))]
    command += ["--resume"] * arguments.resume + ["--quiet"] * arguments.quiet
    code = child.run(command)
    if code == 130 or code < 0:
        raise GateError(f"the run was interrupted; './furrow {arguments.command} --resume --out {folder}' goes on with it", 130)
    if code not in (0, 1, 3):
        raise GateError("nothing was run, so that nothing can be compared", code)


def build_report(folder, run):
    from reports.pages import assign_pages, build   # what takes a second to import is not for those who want no figures
    report = build(folder)
    assign_pages(run.cases)
    return report


def new_folder(name):
    """A folder below runs/ that nobody else has; it is made."""
    for attempt in range(100):
        folder = ROOT / "runs" / f"{datetime.datetime.now():%Y%m%d-%H%M%S}-{name}{f'-{attempt}' if attempt else ''}"
        try:
            folder.mkdir(parents=True)
            return folder
        except FileExistsError:
            continue
        except OSError as error:
            raise GateError(f"{folder}: cannot be made: {error.strerror}", 3) from None
    raise GateError(f"{folder}: is there already")


def gate(arguments):
    baselines, entries = baseline.read_all(arguments.baselines), ledger.read(arguments.baselines)
    if arguments.run and (arguments.tier or arguments.out or arguments.resume):
        raise GateError("RUN is a run that is there; --tier, --out and --resume are for one that is made")
    if arguments.run and not arguments.run.is_dir():
        raise GateError(f"{arguments.run}: no such folder")
    folder = arguments.run or arguments.out or new_folder("gate")
    with locked(folder, "gate"):
        if not arguments.run:
            run_tier(arguments, folder, arguments.tier or "quick")
        run = load(folder)
        comparison = compare(run, baselines, entries)
        outputs.write(run, comparison, baselines)
        report = None if arguments.no_report else build_report(folder, run)
    if os.environ.get("GITHUB_ACTIONS") == "true":
        print("\n".join(outputs.annotations(comparison)))
    if arguments.quiet:
        print(table.headline(comparison))
    else:
        width = shutil.get_terminal_size((100, 24)).columns
        tty = sys.stdout.isatty()
        pages = {c.id: f"{(report.parent / c.page).resolve().as_uri()}#metrics" for c in run.cases} if tty and report else None
        print(table.table(comparison, width, arguments.all, tty, pages))
        print(f"{'report: ' + str(report) if report else 'results: ' + str(run.folder / 'gate')}")
    return comparison.exit_code


def bless(arguments):
    for sentence in accept(load(arguments.run), arguments.cases, arguments.reason, arguments.expires, arguments.baselines):
        print(sentence)
    return 0


def measure(arguments):
    count, without = noise.record([load(folder) for folder in arguments.runs], arguments.reason, arguments.baselines)
    print(f"noise of {count} metrics measured from {len(arguments.runs)} runs; {without} accepted metrics are still without")
    return 0 if count else 1


def record(arguments):
    run = load(arguments.run)
    baselines = baseline.read_all(arguments.baselines)
    comparison = compare(run, baselines, ledger.read(arguments.baselines), only_known=True)
    outputs.write(run, comparison, baselines)
    return 0


def exit_code(command, of_report=2):
    """What `command()` returns; or the code of the error that it ends in, which is said in one line. `of_report`: the code where
    result files cannot be read."""
    try:
        return command()
    except GateError as error:
        print(f"furrow: {error}", file=sys.stderr)
        return error.code
    except results.ReportError as error:
        print(f"furrow: {error}", file=sys.stderr)
        return of_report
    except KeyboardInterrupt:
        return 130


def main(words):
    arguments = parser().parse_args(words)
    commands = {"gate": gate, "bless": bless, "noise": measure, "record": record}
    return exit_code(lambda: commands[arguments.command](arguments))
