"""The command defects: plants each wrong in a scratch tree and sees which case notices."""

import argparse
import collections
import fnmatch
import json
import shutil
import time
from pathlib import Path

from defects import kills, order, patches, record, scratch, sensitivity
from defects.scratch import SwitchedTree, Tree
from gate import baseline
from gate.command import exit_code
from gate.compare import TIERS
from gate.files import ROOT, GateError, locked, read_json, write_whole
from gate.table import cut
from reports import results
from reports.numbers import number

OUT = ROOT / "runs" / "defects"
TREES = scratch.ROOT / "build"   # the scratch trees lie there: one hunt at a time
WORDS = {"killed": "killed", "changed": "seen by its change alone", "survived": "SURVIVED", "equivalent": "equivalent",
         "passed": "passed", "error": "ERROR"}


def parser():
    main = argparse.ArgumentParser(prog="./furrow", add_help=False)
    command = main.add_subparsers(dest="command", required=True).add_parser(
        "defects", help="plant defects and see what catches them", epilog=(
            "Each patch in tests/defects/ is applied to a copy of the commit, built, and the cases that exercise what it touches "
            "are run, tier by tier and those first that are quick to tell, until one is red. Killed: a metric left its band. Seen "
            "by its change alone: only a baseline tells. Exit codes: 0 none survived, 1 one did, 2 wrong usage, 3 a patch does not apply or compile, or nobody "
            "exercises it. Example: ./furrow defects --only 'momentum-*' --tier quick"))
    command.add_argument("--only", action="append", default=[], metavar="GLOB", help="only defects whose name matches")
    command.add_argument("--tier", choices=TIERS, default="nightly", help="largest tier to run (default: nightly)")
    command.add_argument("--cases", action="append", default=[], metavar="GLOB", help="only cases whose id matches")
    command.add_argument("--alone", action="store_true",
                         help="compile each of them alone: less work than one program with all where there are few")
    command.add_argument("--alive", action="store_true", help="only defects that reference/kills.json does not know as killed")
    command.add_argument("--subtle", action="store_true", help="only defects that are said to be subtle")
    command.add_argument("--whole", action="store_true",
                         help="run all that the smoke tier has, to see how far its metrics move")
    command.add_argument("--resume", action="store_true", help="keep what was found for the same patch and commit")
    command.add_argument("--record", action="store_true", help="write what is found to reference/kills.json")
    command.add_argument("--commit", default="HEAD", help="commit to plant them in (default: HEAD)")
    command.add_argument("--out", type=Path, default=OUT, metavar="DIR", help="folder of the kill matrix (default: runs/defects)")
    command.add_argument("--jobs", type=int, metavar="N", help="compilers and cases side by side (default: as many as cores)")
    command.add_argument("--sensitivity", nargs="*", metavar="NAME", default=None,
                         help="instead: the smallest change of these parameters, or of all, that a case sees")
    command.add_argument("--check", action="store_true", help="only see whether every patch applies")
    command.add_argument("--patches", type=Path, default=patches.FOLDER, help=argparse.SUPPRESS)
    return main


def chosen(arguments):
    found = patches.read_all(arguments.patches)
    wanted = [d for d in found if matches(d.name, arguments.only)]
    if not wanted:
        raise GateError(f"none of {len(found)} defects has such a name; 'ls {arguments.patches}' shows them")
    if arguments.subtle:
        wanted = [d for d in wanted if d.subtle]
    if arguments.alive:
        known = record.read()
        wanted = [d for d in wanted if not d.right and not record.is_dead(known.get(d.name), d, arguments.tier)]
    return wanted


def matches(name, globs):
    return not globs or any(fnmatch.fnmatchcase(name, g) for g in globs)


def check(wanted):
    """Says which patches do not apply to the working tree, and how many there are of each module."""
    stale = [(d, why) for d in wanted if (why := patches.does_not_apply(d, ROOT))]
    for d, why in stale:
        print(f"{d.name}: does not apply: {why}")
    count = collections.Counter(m for d in wanted if not d.right for m in d.modules)
    print("\n".join(f"{n:>4}  {module}" for module, n in sorted(count.items())))
    right = sum(d.right for d in wanted)
    print(f"{len(wanted) - right} defects, {sum(d.subtle for d in wanted)} of them subtle; {right} right changes; "
          f"{len(stale)} do not apply")
    return 3 if stale else 0


class Hunt:
    def __init__(self, arguments):
        self.out, self.resume, self.jobs, self.only = arguments.out, arguments.resume, arguments.jobs, arguments.cases
        self.whole, self.apart = arguments.whole, arguments.alone
        self.tiers = TIERS[:TIERS.index(arguments.tier) + 1]
        self.switched = SwitchedTree(arguments.commit, arguments.jobs)
        self.alone = Tree(arguments.commit, arguments.jobs)
        self.all = patches.read_all(arguments.patches)
        self.noise = baseline.read_all()
        self.past = order.Past()
        self.clean = {}   # folder of a tree -> its clean cases by id

    @property
    def commit(self):
        return self.alone.commit

    def words(self):
        return ["--no-report", "--quiet"] + (["--jobs", str(self.jobs)] if self.jobs else [])

    def prepare(self, wanted):
        """Plants what can be switched, unless each is to be compiled alone."""
        if self.apart:
            return
        self.switched.prepare()
        names = {d.name for d in wanted if not d.right}
        if why := self.switched.plant({n: d for n, d in enumerate(self.all, 1) if d.name in names}):
            raise GateError(f"the tree with all defects does not build: {why}", 3)

    def clean_of(self, tree):
        """Cases of the clean program of a tree, by id; it is run when first asked."""
        if tree.folder not in self.clean:
            folder = self.out / f"clean-{tree.folder.name}"
            if not (self.resume and self._same_commit(folder)):
                shutil.rmtree(folder, ignore_errors=True)
            # --resume knows by the program's own bytes what may be kept
            tree.run(["matrix", "--tier", self.tiers[-1], "--out", str(folder.resolve()), *self.words(),
                      *(word for glob in self.only for word in ("--only", glob)), *(["--resume"] if folder.exists() else [])])
            found = {c.id: c for c in results.load(folder).cases if c.data.get("metrics")} if folder.exists() else {}
            if not found:
                raise GateError("the clean tree ran no case", 3)
            self.clean[tree.folder] = found
        return self.clean[tree.folder]

    def _same_commit(self, folder):
        try:
            return read_json(folder / "run.json")["provenance"]["commit"] == self.commit
        except (OSError, ValueError, KeyError, TypeError):
            return False

    def judge(self, defect):
        """Fate of one defect."""
        if number := self.switched.numbers.get(defect.name):
            fate = self.fate_in(self.switched, defect, FURROW_DEFECT=str(number))
        else:
            fate = self.judge_alone(defect)
        self.past.learn(defect, fate)
        return fate

    def judge_alone(self, defect):
        """Fate of a defect that is compiled alone. The tree is clean before and after."""
        def error(reason):
            return kills.Fate(defect.name, "error", reason.splitlines()[0], hash=defect.hash, commit=self.commit)
        if self.alone.folder not in self.clean:
            self.alone.prepare()
            if why := self.alone.build():
                raise GateError(f"the clean tree does not build: {why}", 3)
            self.clean_of(self.alone)
        if why := patches.does_not_apply(defect, self.alone.folder):
            return error(f"does not apply: {why}")
        with self.alone.spoilt(defect) as why:
            return error(f"does not compile: {why}") if why else self.fate_in(self.alone, defect)

    def fate_in(self, tree, defect, **environment):
        """Fate of a defect that the program of `tree` has, or has with this environment."""
        seen = []
        for tier in self.tiers:
            cases = [c for c in self.clean_of(tree).values() if c.data["tier"] == tier and defect.touches(c.data["exercises"])]
            whole = defect.right or defect.equivalent or self.whole and tier == "smoke"
            for batch in [cases] if whole and cases else order.batches(cases, self.past, defect):
                seen += self.look(tree, batch, tier, environment)
                if not defect.right and any(k.by == "truth" for k in seen):
                    break
            if not defect.right and any(k.by == "truth" for k in seen):
                break
        return kills.fate(defect, seen, self.tiers, self.commit)

    def look(self, tree, cases, tier, environment):
        """What these cases see of the defect that is planted."""
        folder = self.out / "spoilt"
        shutil.rmtree(folder, ignore_errors=True)
        code = tree.run(["run", *(c.id for c in cases), "--out", str(folder.resolve()), *self.words()], **environment)
        if code not in (0, 1, 3):   # nothing was run: that is no kill
            raise GateError(f"the program of {tree.folder} ended with {code}: '{tree.program} run {cases[0].id}' shows why", 3)
        ran = {c.id: c for c in results.load(folder).cases} if folder.exists() else {}
        found = [kills.seen(c, ran.get(c.id), tier, self.noise.get(c.id)) for c in cases]
        shutil.rmtree(folder, ignore_errors=True)
        return found


def kept(path, defect, commit, tier):
    """The fate that an earlier hunt found for the same patch and commit; None when it has to be found again: what lived through a
    smaller tier has not been looked at with this one."""
    try:
        found = kills.from_json(read_json(path))
    except (OSError, ValueError, KeyError, TypeError):
        return None
    known = found.hash == defect.hash and found.commit == commit and found.state != "error"
    far_enough = found.state == "killed" or found.looked in TIERS and TIERS.index(found.looked) >= TIERS.index(tier)
    return found if known and far_enough else None


def hunt(arguments, wanted):
    with locked(arguments.out, "defects"), locked(TREES, "defects"):
        state = Hunt(arguments)
        fates = arguments.out / "fates"
        if not arguments.resume:
            shutil.rmtree(fates, ignore_errors=True)
        state.prepare(wanted)
        found = []
        wanted = sorted(wanted, key=lambda d: (d.name not in state.switched.numbers, d.reach, d.name))   # most answers come soon
        for i, defect in enumerate(wanted, 1):
            path = fates / f"{defect.name}.json"
            fate = kept(path, defect, state.commit, state.tiers[-1]) if arguments.resume else None
            if fate is None:
                began = time.monotonic()
                fate = state.judge(defect)
                fate.seconds = round(time.monotonic() - began, 1)
                write_whole(path, json.dumps(kills.to_json(fate), indent=1) + "\n")
            else:
                state.past.learn(defect, fate)
            found.append(fate)
            if arguments.record:   # at once: a hunt may be ended before its end
                record.write(record.merged(record.read(), [fate], state.all, state.tiers))
            print(cut(f"{i:>3}/{len(wanted)}  {line(fate)}", 130), flush=True)
        write_whole(arguments.out / "kills.json", json.dumps(matrix(found, wanted, state)) + "\n")
    from reports.kills import build
    print(summary(found, wanted, state.tiers))
    print(f"kill matrix: {build(arguments.out)}")
    return 3 if any(f.state == "error" for f in found) else 1 if any(f.state == "survived" for f in found) else 0


def sensitive(arguments):
    with locked(arguments.out, "defects"), locked(TREES, "defects"):
        state = Hunt(arguments)
        state.prepare(state.all)
        found = sensitivity.seek(state, arguments.sensitivity, lambda t: print(sensitivity.line(t), flush=True))
        if arguments.record:
            sensitivity.write(found)
    return 0


def line(fate):
    killers = [k for k in fate.seen if k.by == ("truth" if fate.state == "killed" else "change")]
    by = ""
    if killers and fate.state in ("killed", "changed"):
        by = f" at {fate.tier} by {killers[0].case} {killers[0].metric}"
        by += f" and {len(killers) - 1} more" if len(killers) > 1 else ""
    return f"{WORDS[fate.state]:<10}  {fate.name}{by}{': ' + fate.reason if fate.reason else ''}"


def matrix(found, wanted, state):
    """What reports.kills reads, schema 1."""
    return {"schema": 1, "commit": state.commit, "tiers": list(state.tiers), "rates": kills.rates(found, state.tiers),
            "defects": [kills.to_json(f) | {"wrong": d.wrong, "modules": d.modules, "subtle": d.subtle, "source": d.source,
                                            "equivalent": d.equivalent} for f, d in zip(found, wanted)]}


def summary(found, wanted, tiers):
    count = collections.Counter(f.state for f in found)
    lines = [", ".join(f"{count[s]} {WORDS[s]}" for s in WORDS if count[s]) + f" of {len(found)}"]
    for tier, (truth, any_, alive) in kills.rates(found, tiers).items():
        if alive:
            lines.append(f"{tier:>8}: {number(100.0 * truth / alive, 3)} % killed by the truth, "
                         f"{number(100.0 * any_ / alive, 3)} % seen at all, of {alive}")
    wrong = [f.name for f, d in zip(found, wanted) if d.subtle and (f.largest_smoke_move or 0.0) > 0.05]
    if wrong:
        lines.append(f"not subtle after all (a smoke metric moved by more than 5 %): {', '.join(wrong)}")
    return "\n".join(lines)


def main(words):
    arguments = parser().parse_args(words)

    def command():
        if arguments.sensitivity is not None:
            return sensitive(arguments)
        wanted = chosen(arguments)
        return check(wanted) if arguments.check else hunt(arguments, wanted)
    return exit_code(command, of_report=3)
