"""Files that are whole or not there, and locks: what is written survives a kill, a full disk and a second process."""

import contextlib
import errno
import fcntl
import json
import os
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


class GateError(Exception):
    """What the person who asked must know; `code` is the exit code."""

    def __init__(self, message, code=2):
        super().__init__(message)
        self.code = code


def write_whole(path, text):
    """Writes beside `path` and renames: afterwards there is the old file or the new one. GateError names file and cause."""
    path = Path(path)
    beside = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(beside, "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except OSError as error:
        with contextlib.suppress(OSError):
            beside.unlink(missing_ok=True)
        raise GateError(f"{path}: cannot be written: {error.strerror}; what was there before is still there", 3) from None


def append_line(path, line):
    """Adds one line in a single write. GateError where it cannot; then the file is as it was."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    data = (line + "\n").encode()
    descriptor = os.open(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o644)
    try:
        before = os.fstat(descriptor).st_size
        try:
            if os.write(descriptor, data) != len(data):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            os.fsync(descriptor)
        except OSError as error:
            os.ftruncate(descriptor, before)
            raise GateError(f"{path}: cannot be written: {error.strerror}; what was there before is still there", 3) from None
    finally:
        os.close(descriptor)


def read_json(path):
    """Parsed strict JSON; ValueError with one sentence otherwise."""
    def refuse(word):
        raise ValueError(f"{word} is not JSON")
    try:
        return json.loads(Path(path).read_text(encoding="utf-8"), parse_constant=refuse)
    except UnicodeDecodeError as error:
        raise ValueError(f"not UTF-8 at byte {error.start}") from None
    except json.JSONDecodeError as error:
        raise ValueError(f"not JSON: {error.msg} at line {error.lineno}, column {error.colno}") from None


@contextlib.contextmanager
def locked(folder, what):
    """Holds `folder` for this process; GateError when another one does. The lock goes with the process, however that ends."""
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = open(folder / ".lock", "a+", encoding="utf-8")
    except OSError as error:
        raise GateError(f"{folder}: cannot be used: {error.strerror}") from None
    with file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            file.seek(0)
            other = file.read().strip() or "another process"
            raise GateError(f"{folder}: {other} works there; try again when it has ended") from None
        file.truncate(0)
        file.write(f"{what}, process {os.getpid()}")
        file.flush()
        yield
        file.truncate(0)
