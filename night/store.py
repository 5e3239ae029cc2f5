"""The history: one SQLite file with every metric and cost of every run that was added.

A run is added in one transaction of a write-ahead log: after a kill it is there or it is not. Two nights at once wait for each
other.
"""

import contextlib
import math
import sqlite3
import time
from dataclasses import dataclass
from pathlib import Path

from gate.files import ROOT, GateError

FILE = ROOT / "runs" / "history.sqlite"
VERSION = 1
PATIENCE = 60.0   # s that one writer waits for another

TABLES = """
CREATE TABLE runs (id INTEGER PRIMARY KEY, folder TEXT NOT NULL, commit_id TEXT NOT NULL, dirty INTEGER NOT NULL,
  started TEXT NOT NULL, tier TEXT, exit_code INTEGER, compiler TEXT, flags TEXT, cpu TEXT, threads INTEGER,
  wall_s REAL, cpu_s REAL, UNIQUE (folder, commit_id, started));
CREATE TABLE cases (run INTEGER NOT NULL REFERENCES runs ON DELETE CASCADE, case_id TEXT NOT NULL, verdict TEXT NOT NULL,
  inputs TEXT, wall_s REAL, cpu_s REAL, steps INTEGER, particles INTEGER, peak_rss_bytes INTEGER,
  PRIMARY KEY (run, case_id)) WITHOUT ROWID;
CREATE TABLE metrics (run INTEGER NOT NULL REFERENCES runs ON DELETE CASCADE, case_id TEXT NOT NULL, metric TEXT NOT NULL,
  unit TEXT NOT NULL, value REAL, error REAL, verdict TEXT NOT NULL, PRIMARY KEY (run, case_id, metric)) WITHOUT ROWID;
CREATE INDEX metrics_by_name ON metrics (case_id, metric, run);
"""
COSTS = ("cpu_s", "peak_rss_bytes")   # of a case; wall time says more about the machine's other work than about the code
UNITS = {"cpu_s": "s", "peak_rss_bytes": "B"}


@dataclass(frozen=True)
class Night:
    """A run of the history, without what it measured."""
    id: int
    folder: str
    commit: str
    dirty: bool
    started: str
    tier: str | None
    exit_code: int | None
    wall_s: float | None
    cpu_s: float | None


def broken(path, error):
    return GateError(f"{path}: the history is broken ({error}); it was left as it is. Move it away, and "
                     "'./furrow history --add RUN...' builds a new one from the folders of runs", 3)


@contextlib.contextmanager
def opened(path=FILE, create=False):
    """A connection; GateError where there is no history, or one that cannot be used."""
    path = Path(path)
    if not path.exists() and not create:
        raise GateError(f"{path}: there is no history yet; './furrow nightly' or './furrow history --add RUN' begins one")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        connection = sqlite3.connect(path, timeout=PATIENCE, isolation_level=None)
    except (OSError, sqlite3.Error) as error:
        raise GateError(f"{path}: cannot be opened: {error}", 3) from None
    try:
        with contextlib.closing(connection):
            connection.execute("PRAGMA foreign_keys = ON")
            _log_ahead(connection)
            connection.execute("PRAGMA synchronous = FULL")
            _prepare(connection, path)
            yield connection
    except sqlite3.OperationalError as error:
        raise GateError(f"{path}: cannot be used: {error}; what was there before is still there", 3) from None
    except sqlite3.DatabaseError as error:
        raise broken(path, error) from None


def _log_ahead(connection):
    """Puts the file under a write-ahead log. For this alone SQLite does not wait where another holds a lock to write."""
    end = time.monotonic() + PATIENCE
    while True:
        try:
            connection.execute("PRAGMA journal_mode = WAL")
            return
        except sqlite3.OperationalError as error:
            if error.sqlite_errorcode & 0xFF != sqlite3.SQLITE_BUSY or time.monotonic() > end:
                raise
        time.sleep(0.02)


def _prepare(connection, path):
    (fault,) = connection.execute("PRAGMA quick_check(1)").fetchone()
    if fault != "ok":
        raise broken(path, fault.splitlines()[-1])
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    if version == 0:
        with _writing(connection):
            if connection.execute("PRAGMA user_version").fetchone() == (0,):   # nobody else was faster
                for statement in TABLES.split(";"):
                    connection.execute(statement)
                connection.execute(f"PRAGMA user_version = {VERSION}")
    elif version != VERSION:
        raise GateError(f"{path}: a history of version {version}, this is furrow of version {VERSION}")


@contextlib.contextmanager
def _writing(connection):
    connection.execute("BEGIN IMMEDIATE")
    try:
        yield
    except BaseException:
        with contextlib.suppress(sqlite3.Error):
            connection.execute("ROLLBACK")
        raise
    connection.execute("COMMIT")


def _finite(x):
    return float(x) if isinstance(x, (int, float)) and not isinstance(x, bool) and math.isfinite(x) else None


def add(connection, run):
    """Adds a run (reports.results.Run), in place of what was there of the same run. Returns its id. GateError for one that is no
    night: with changed input, or in another order of particles."""
    p, head = run.provenance, run.data
    if head.get("overrides") or p.get("particle_order", 0) != 0:
        raise GateError(f"{run.folder}: ran with changed input or another order of particles, and is no part of the history")
    key = (run.folder.resolve().name, str(p.get("commit", "unknown")), str(p.get("started", "unknown")))
    with _writing(connection):
        connection.execute("DELETE FROM runs WHERE folder = ? AND commit_id = ? AND started = ?", key)
        number = connection.execute(
            "INSERT INTO runs (folder, commit_id, started, dirty, tier, exit_code, compiler, flags, cpu, threads, wall_s, cpu_s) "
            "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
            (*key, int(bool(p.get("dirty", True))), head.get("tier"), head.get("exit_code"), p.get("compiler"), p.get("flags"),
             p.get("cpu"), p.get("threads"), _finite(head.get("wall_s")), _finite(head.get("cpu_s")))).lastrowid
        for case in run.cases:
            cost = case.data.get("cost", {})
            connection.execute("INSERT OR REPLACE INTO cases VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", (
                number, case.id, case.verdict, case.data.get("provenance", {}).get("inputs"), _finite(cost.get("wall_s")),
                _finite(cost.get("cpu_s")), cost.get("steps"), cost.get("particles"), cost.get("peak_rss_bytes")))
            for metric, _ in case.metrics:
                connection.execute("INSERT OR REPLACE INTO metrics VALUES (?, ?, ?, ?, ?, ?, ?)", (
                    number, case.id, metric["name"], metric["unit"], _finite(metric["value"]), _finite(metric["error"]),
                    metric["verdict"]))
    return number


def nights(connection, last=None):
    """Runs in the order in which they began, at most the `last` ones."""
    rows = connection.execute("SELECT id, folder, commit_id, dirty, started, tier, exit_code, wall_s, cpu_s FROM runs "
                              "ORDER BY started DESC, id DESC LIMIT ?", (-1 if last is None else last,)).fetchall()
    return [Night(r[0], r[1], r[2], bool(r[3]), *r[4:]) for r in reversed(rows)]


def verdicts(connection, run):
    """verdict -> number of cases of a run."""
    return dict(connection.execute("SELECT verdict, count(*) FROM cases WHERE run = ? GROUP BY verdict", (run,)).fetchall())


def values(connection, runs):
    """(case, name) -> (unit, kind, [(place in `runs`, value)]) of every metric and cost of these runs; kind is value or cost."""
    place = {night.id: i for i, night in enumerate(runs)}
    found = {}
    marks = ",".join("?" * len(place))
    for run, case, name, unit, value in connection.execute(
            f"SELECT run, case_id, metric, unit, value FROM metrics WHERE run IN ({marks}) AND value IS NOT NULL", list(place)):
        found.setdefault((case, name), (unit, "value", []))[2].append((place[run], value))
    for name in COSTS:
        for run, case, value in connection.execute(
                f"SELECT run, case_id, {name} FROM cases WHERE run IN ({marks}) AND {name} IS NOT NULL", list(place)):
            found.setdefault((case, name), (UNITS[name], "cost", []))[2].append((place[run], value))
    for run in runs:
        if run.cpu_s is not None:
            whole = (f"run-{run.tier}" if run.tier else "run", "cpu_s")
            found.setdefault(whole, ("s", "cost", []))[2].append((place[run.id], run.cpu_s))
    return {key: (unit, kind, sorted(points)) for key, (unit, kind, points) in found.items()}
