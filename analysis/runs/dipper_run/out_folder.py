"""The folder that a command's answer goes to."""
import os
from pathlib import Path

from .findings import BadInput


def out_folder(given, name):
    """The folder given as --out, else runs/NAME."""
    return given or Path("runs") / name


def make_cache(folder):
    """Makes the folder of a cache; BadInput when it cannot be made or written into."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        why = "" if os.access(folder, os.W_OK | os.X_OK) else "Permission denied"
    except OSError as e:
        why = e.strerror
    if why:
        raise BadInput([f"{folder}: cannot be written ({why}); set XDG_CACHE_HOME to a folder that can be written"])


def check_not_over(inputs, outputs):
    """BadInput where an output would overwrite an input; `inputs`: {what it is: file}."""
    for what, file in inputs.items():
        for out in outputs:
            if os.path.realpath(out) == os.path.realpath(file) or os.path.exists(out) and os.path.exists(file) and \
                    os.path.samefile(out, file):
                raise BadInput([f"--out: {out} is {what}; choose another --out"])


def check_writable(folder):
    """BadInput when the folder cannot be made or written into: for before the work is done. Makes nothing."""
    # A link to nothing is there; what lies in a folder that cannot be looked into is not.
    nearest = next(p for p in (folder.absolute(), *folder.absolute().parents) if os.path.lexists(p))
    folders = os.path.isdir(nearest)
    why = "Permission denied" if folders else f"{nearest} is not a folder"
    if not folders or not os.access(nearest, os.W_OK | os.X_OK):
        raise BadInput([f"{folder}: cannot be written ({why}); choose another --out"])
