"""The folder that a command's answer goes to."""
import os
from pathlib import Path

from .findings import BadInput


def out_folder(given, name):
    """The folder given as --out, else runs/NAME."""
    return given or Path("runs") / name


OTHER_CACHE = "set XDG_CACHE_HOME to a folder that can be written"


def check_writable(folder, remedy="choose another --out"):
    """BadInput when the folder cannot be made or written into: for before the work is done. Makes nothing."""
    # A link to nothing is there; what lies in a folder that cannot be looked into is not.
    nearest = next(p for p in (folder.absolute(), *folder.absolute().parents) if os.path.lexists(p))
    folders = os.path.isdir(nearest)
    why = "Permission denied" if folders else f"{nearest} is no folder"
    if not folders or not os.access(nearest, os.W_OK | os.X_OK):
        raise BadInput([f"{folder}: cannot be written ({why}); {remedy}"])
