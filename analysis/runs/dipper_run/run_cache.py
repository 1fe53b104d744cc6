"""Entries of the cache: whole or not there, written by one process at a time, never used when damaged.

An entry is a folder with a manifest of the SHA-256 sums of its files, written last. A damaged entry is moved aside, and
made again. The rules are those of common/cache_entry.hpp.
"""
import errno
import fcntl
import hashlib
import json
import os
import socket
import sys
import time
from contextlib import contextmanager
from pathlib import Path

from .file_hash import sha256_of
from .findings import BadInput

ENTRY_MANIFEST = "manifest.json"
# flock's errors on a file system without locks (Lustre without -o flock, NFS without lockd; common/file_lock.cpp).
NO_LOCKS = (errno.ENOSYS, errno.ENOLCK, errno.EOPNOTSUPP, errno.EINVAL)
WAIT_S = 0.5  # between looks at an entry that another process makes


def cache_folder(kind):
    """Where entries of a kind ("gap", "study") are: where the program has its cache. Raises BadInput."""
    base, home = (os.environ.get(name) for name in ("XDG_CACHE_HOME", "HOME"))
    if not base and not home:
        raise BadInput(["no place for runs that can be used again: neither XDG_CACHE_HOME nor HOME is set; "
                        "set XDG_CACHE_HOME to a folder for them"])
    return (Path(base).absolute() if base else Path(home) / ".cache") / "dipper" / kind


def entry_of(cache, checked, *what):
    """The folder of an entry in `cache`, named by all that decides what is in it.

    `checked` is what `dipper check --json` prints for the case: hashes of the case with all its files and
    of the program's sources. `what` is the rest.
    """
    text = "\n".join([checked["case_hash"], checked["source_hash"], *map(str, what)])
    return cache / hashlib.sha256(text.encode()).hexdigest()[:24]


@contextmanager
def locked(entry, stopped):
    """Waits while another process makes the same, or until stopped(). Yields the lock, a file beside the entry, which
    a run under way shares: it holds as long as either lives."""
    entry.parent.mkdir(parents=True, exist_ok=True)
    with open(entry.with_name(entry.name + ".lock"), "w") as lock:
        held = None
        while not stopped():
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                time.sleep(WAIT_S)
            except OSError as e:
                if e.errno not in NO_LOCKS:
                    raise
                held = _make_held(Path(lock.name + ".held"))
                if held:
                    break
                time.sleep(WAIT_S)
        try:
            yield lock
        finally:
            if held:
                held.unlink(missing_ok=True)


def _make_held(held):
    """The file that holds where the file system has no locks, or None while another has it (common/file_lock.hpp)."""
    host = socket.gethostname()
    for _ in range(2):
        try:
            with open(held, "x") as f:
                f.write(f"{host} {os.getpid()}\n")
            return held
        except FileExistsError:
            pass
        try:
            owner, pid = held.read_text().split()
            if owner != host:
                return None
            os.kill(int(pid), 0)
            return None
        except ProcessLookupError:  # killed: what it has left keeps nobody out
            held.unlink(missing_ok=True)
        except (OSError, ValueError):
            return None
    return None


def seal(entry, facts):
    """Makes a folder an entry: `facts` (a dict) and the sums of its files, on the disk before the manifest is."""
    sums = {}
    for file in _files(entry):
        sums[str(file.relative_to(entry))] = sha256_of(file)
        _to_disk(file)
    part = entry / (ENTRY_MANIFEST + ".part")
    part.write_text(json.dumps({**facts, "sha256": sums}, indent=1) + "\n")
    _to_disk(part)
    os.replace(part, entry / ENTRY_MANIFEST)
    _to_disk(entry)


def facts(entry):
    """What was said of a sound entry; None where there is none. A damaged one is moved aside."""
    try:
        text = (entry / ENTRY_MANIFEST).read_text()
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError):
        text = ""
    try:
        kept = json.loads(text)
        sums = dict(kept["sha256"])
    except (ValueError, KeyError, TypeError):
        return _move_aside(entry, ENTRY_MANIFEST)
    there = {str(file.relative_to(entry)) for file in _files(entry)}
    for name, expected in sums.items():
        if name not in there or sha256_of(entry / name) != expected:
            return _move_aside(entry, name)
    return kept


def _move_aside(entry, name):
    number = 1
    while (aside := entry.with_name(f"{entry.name}.damaged-{number}")).exists():
        number += 1
    try:
        os.rename(entry, aside)
    except FileNotFoundError:  # another process has
        return None
    print(f"{entry / name} has changed since it was written; moved to {aside}, made again", file=sys.stderr, flush=True)
    return None


def _files(entry):
    return [f for f in sorted(entry.rglob("*")) if f.is_file() and not f.name.startswith(ENTRY_MANIFEST)]


def _to_disk(path):
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
