"""Text and numbers of a user's files, with each fault found at its line."""
import math
import re
from difflib import get_close_matches

import yaml

BOM = b"\xef\xbb\xbf"
UTF_16 = (b"\xff\xfe", b"\xfe\xff")
# As the program reads numbers (common/numbers.hpp): Python's float() takes 1_000 and digits of other scripts, too.
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
RIGHT = "save it as plain text in UTF-8"
SHEETS = (b"xl/workbook", b"xl/worksheets", b"application/vnd.oasis.opendocument.spreadsheet")  # in a ZIP

# What begins as no text, what it is, and what would be right. The program's own reader knows the same
# (common/csv_table.cpp); tests/common/tables.jsonl holds both to it.
HDF5 = b"\x89HDF\r\n\x1a\n"  # or after a block of its writer's own
HDF5_IS = "is HDF5", "save its channels as CSV"
NO_TEXTS = (
    (HDF5, *HDF5_IS),
    (b"MATLAB 7.3 MAT-file", *HDF5_IS),
    (b"MATLAB 5.0 MAT-file", "is a MAT file of MATLAB", "save its channels as CSV"),
    (b"CDF\x01", "is NetCDF", "save its channels as CSV"),
    (b"CDF\x02", "is NetCDF", "save its channels as CSV"),
    (b"CDF\x05", "is NetCDF", "save its channels as CSV"),
    (b"MDF     ", "is MDF, of a measurement system", "save its channels as CSV"),
    (b"TDSm", "is TDMS, of a measurement system", "save its channels as CSV"),
    (b"PAR1\x15", "is Parquet", "save its table as CSV"),
    (b"SQLite format 3", "is a database of SQLite", "save its table as CSV"),
    (b"\xd0\xcf\x11\xe0", "is a spreadsheet (.xls), or another document of an office program", "save its sheet as CSV"),
    (b"{\\rtf", "is RTF, of a word processor", "save it as plain text in UTF-8"),
    (b"%PDF", "is a PDF", "a table as CSV"),
    (b"\x1f\x8b", "is compressed by gzip", "unpack it with gunzip"),
    (b"BZh91AY&SY", "is compressed by bzip2", "unpack it with bunzip2"),
    (b"\xfd7zXZ", "is compressed by xz", "unpack it with unxz"),
    (b"\x28\xb5\x2f\xfd", "is compressed by Zstandard", "unpack it with unzstd"),
    (b"7z\xbc\xaf\x27\x1c", "is an archive of 7-Zip", "unpack it"),
)


def no_text(data):
    """(what it is, what would be right) of a file that is no text, by how it begins; None of any other."""
    for begin, *other in NO_TEXTS:
        if data.startswith(begin):
            return tuple(other)
    at = 512
    while at < len(data):
        if data.startswith(HDF5, at):
            return HDF5_IS
        at *= 2
    if data.startswith(b"PK\x03\x04"):
        if any(part in data for part in SHEETS):
            return "is a spreadsheet", "save its sheet as CSV"
        return "is a ZIP", "unpack it"
    if data.removeprefix(BOM)[:64].lstrip().lower().startswith((b"<html", b"<!doctype", b"<table", b"<?xml", b"<meta")):
        return "is HTML or XML, which some programs save as .xls", "save its table as CSV"
    return None


def read_bytes(file, found):
    """What a file holds; None after a finding: it cannot be read, or begins as what is no text."""
    try:
        data = file.read_bytes()
    except OSError as e:
        found.add(file, 0, "file", f"cannot be read: {e.strerror}", "a file that may be read")
        return None
    other = no_text(data)
    if other:
        found.add(file, 0, "file", *other)
        return None
    return data


def read_text(file, found):
    """The text of a file, without a byte-order mark; None after a finding."""
    data = read_bytes(file, found)
    return None if data is None else text_of(data, file, found)


def text_of(data, file, found):
    """The text that bytes in UTF-8 say, without a byte-order mark; None after a finding."""
    if data.startswith(UTF_16):
        found.add(file, 1, "encoding", "is UTF-16", RIGHT)
        return None
    if b"\0" in data:
        found.add(file, _line(data, data.index(b"\0")), "encoding", "a zero byte: not text, or UTF-16", RIGHT)
        return None
    data = data[len(BOM):] if data.startswith(BOM) else data
    try:
        return data.decode()
    except UnicodeDecodeError as e:
        found.add(file, _line(data, e.start), "encoding", f"byte 0x{data[e.start]:02X} is not UTF-8", RIGHT)
        return None


def _line(data, at):
    return data.count(b"\n", 0, at) + 1


def read_yaml(file, found, what):
    """The root node of a YAML map; None after a finding, which says that `what` belongs there."""
    text = read_text(file, found)
    if text is None:
        return None
    try:
        root = yaml.compose(text)
    except yaml.YAMLError as e:
        mark = getattr(e, "problem_mark", None)
        found.add(file, mark.line + 1 if mark else 0, "YAML", getattr(e, "problem", None) or e.reason, what)
        return None
    except RecursionError:
        found.add(file, 0, "YAML", "lists within lists without end", what)
        return None
    if not isinstance(root, yaml.MappingNode):
        found.add(file, 1, "YAML", "not a map", what)
        return None
    return root


def said(node):
    """What a YAML node says, in words that fit after `is`."""
    if isinstance(node, yaml.SequenceNode):
        return "a list"
    return "a map" if isinstance(node, yaml.MappingNode) else node.value


def number(text):
    """The finite number a text says; None when it says none."""
    if not isinstance(text, str) or not NUMBER.fullmatch(text.strip()):
        return None
    value = float(text)
    return value if math.isfinite(value) else None


def nearest(word, words):
    """The one of `words` that is most like `word`, or None."""
    lower = {w.lower(): w for w in words}
    found = get_close_matches(word.lower(), lower, 1, 0.5)
    return lower[found[0]] if found else None
