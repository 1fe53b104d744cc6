"""Point clouds in files: x y z as text, PLY and LAS, in parts, so that memory does not grow with their number."""
import re
from dataclasses import dataclass
from typing import Callable

from dipper_run.text_file import BOM, no_text

from .las import open_las
from .ply import open_ply
from .text_cloud import open_text

NOT_READ = (  # begins with, what it is, what to do
    (b"ASTM-E57", "an E57", "export it as LAS, PLY or text"),
    (b"# .PCD", "a PCD", "export it as LAS, PLY or text"),
    (b"\xff\xfe", "UTF-16", "save it as plain text in UTF-8"),
    (b"\xfe\xff", "UTF-16", "save it as plain text in UTF-8"),
    (b"solid ", "an STL", "it is a mesh already: crop it and name it in pile.profile (docs/rock.md)"),
    (b"II*\0", "a TIFF", "export the heights as x y z text or LAS"),
    (b"MM\0*", "a TIFF", "export the heights as x y z text or LAS"),
    (b"ncols", "a grid of heights", "export it as x y z text or LAS"),
    (b"OFF", "an OFF", "export its vertices as x y z text or PLY"),
)
OBJ = re.compile(rb"(?:[ \t]*(?:#[^\n]*)?\r?\n)*(?:v|vn|vt|o|g|mtllib|usemtl)[ \t]")
DXF = re.compile(rb"\s*(?:999\s*\n[^\n]*\n\s*)?0\s*\n\s*SECTION\b")


@dataclass(frozen=True)
class Cloud:
    """A cloud that was found readable. `parts()` yields arrays (n, 3) of float64 in the file's coordinates, and may be
    called again; it raises BadInput where the file turns out to be broken."""

    parts: Callable
    kind: str           # "LAS 1.2", "PLY", "text"
    notes: tuple = ()   # what a user should know


def open_cloud(path, found):
    """The Cloud of a file; None after a finding."""
    try:
        with open(path, "rb") as file:
            head = file.read(1 << 16)
    except OSError as e:
        found.add(path, 0, "file", f"cannot be read: {e.strerror}", "a point cloud: text, CSV, PLY or LAS")
        return None
    for begins, what, right in NOT_READ:
        if head.startswith(begins):
            found.add(path, 0, "file", f"is {what}", right)
            return None
    for begins, what in ((OBJ, "an OBJ"), (DXF, "a DXF")):
        if begins.match(head.removeprefix(BOM)):
            found.add(path, 0, "file", f"is {what}", "export its vertices as x y z text or PLY, with all their digits")
            return None
    other = no_text(head)
    if other:
        found.add(path, 0, "file", *other)
        return None
    if not head:
        found.add(path, 0, "file", "is empty", "a point cloud: text, CSV, PLY or LAS")
        return None
    if head.startswith(b"LASF"):
        opened = open_las(path, found)
    elif head[:3].lower() == b"ply" and head[3:4].isspace():
        opened = open_ply(path, found)
    else:
        opened = open_text(path, found)
    return opened and Cloud(*opened)
