"""The folder that a command's answer goes to."""
import os

from .findings import BadInput


def check_writable(folder):
    """BadInput when the folder cannot be made or written into: for before the work is done. Makes nothing."""
    nearest = next(p for p in (folder.absolute(), *folder.absolute().parents) if p.exists())
    why = "Permission denied" if nearest.is_dir() else f"{nearest} is a file"
    if not nearest.is_dir() or not os.access(nearest, os.W_OK | os.X_OK):
        raise BadInput([f"{folder}: cannot be written ({why}); choose another --out"])
