"""Runs the program `dipper` and reads what it prints."""
import json
import os
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]


class ProgramFailed(RuntimeError):
    """The program did not answer; the message is its own."""


def program():
    """$DIPPER, which `dipper gap` sets to itself; else this tree's, else the one on the path."""
    built = ROOT / "build/release/bin/dipper"
    return os.environ.get("DIPPER") or (str(built) if built.exists() else shutil.which("dipper") or "dipper")


def ask(*words, given=None, of=None):
    """The JSON that `dipper WORDS` prints; `given` is its standard input, as JSON. `of`: another than `program()`."""
    return json.loads(output_of(*words, given=given, of=of))


def output_of(*words, given=None, of=None):
    """What `dipper WORDS` prints; `given` is its standard input, as JSON."""
    of = of or program()
    try:
        made = subprocess.run([of, *map(str, words)], input=None if given is None else json.dumps(given),
                              capture_output=True, text=True)
    except OSError as e:
        raise ProgramFailed(f"{of}: {e.strerror}; build it, or set DIPPER to it") from e
    if made.returncode != 0:
        raise ProgramFailed(made.stderr.strip())
    return made.stdout


def check_json(case, *words, of=None):
    """What `dipper check --json` prints for a case: findings; without errors also hash, size, values."""
    of = of or program()
    try:
        made = subprocess.run([of, "check", "--json", str(case), *words], capture_output=True, text=True)
        return json.loads(made.stdout)
    except OSError as e:
        raise ProgramFailed(f"{of}: {e.strerror}; build it, or set DIPPER to it") from e
    except ValueError as e:
        raise ProgramFailed(made.stderr.strip() or f"{of} check --json: {e}") from e
