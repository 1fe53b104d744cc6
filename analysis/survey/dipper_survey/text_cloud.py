"""Point clouds as text: x y z, a point a line, with a header or without, as CSV or between blanks."""
import io
import re

import numpy as np

from dipper_run.csv_text import WITH_DECIMAL_COMMA, cells_of, decimal_number, find_decimal
from dipper_run.findings import BadInput
from dipper_run.text_file import BOM, number

PART = 1 << 23           # bytes
HEAD = 1 << 16           # bytes in which the first point is looked for
EAST, NORTH = ("east", "easting", "rechtswert", "utmx"), ("north", "northing", "hochwert", "utmy")
HEIGHT = ("z", "h", "height", "elev", "elevation", "rl", "level", "altitude", "alt", "hoehe")
# Names of x, y and z. The first three that are all there count: beside X,Y,Z a column N is a number.
FAMILIES = ((("x",), ("y",), ("z",)), (EAST, NORTH, HEIGHT), (("e",), ("n",), HEIGHT),
            (("x", "e", *EAST), ("y", "n", *NORTH), HEIGHT))
NONE = ("nan", "-nan", "inf", "-inf", "+inf")  # as scanners write that nothing came back
OTHER_UNITS = ("ft", "feet", "foot", "usft", "ftus", "us-ft", "ft-us", "mm", "cm", "km", "in", "inch", "deg", "dd")
UNIT = re.compile(r"[(\[]\s*([a-z-]+)\.?\s*[)\]]|_([a-z-]+)$|\s([a-z-]+)$")  # E (ft), east_ft, Elev ft
FEET = re.compile(r"(?<![a-z])(ft|feet|foot)(?![a-z])")
BRACKETS = re.compile(r"[(\[](.*)[)\]]")
DEGREES = ("lon", "long", "longitude", "lat", "latitude")
PARTED = re.compile(r"[+-]?\d{1,3}([,'\u2019\u00a0 ]\d{3})+(\.\d+)?", re.ASCII)  # thousands
SHOWN = 60


class Table:
    """How the points stand in the lines."""

    def __init__(self, delimiter, decimal, columns, first, cells, returns):
        self.delimiter, self.decimal = delimiter, decimal  # delimiter None: blanks
        self.columns = columns    # of x, y and z
        self.first = first        # 1-based line of the first point
        self.cells = cells        # a line has
        self.returns = returns    # whether lines end by CR alone


def open_text(path, found):
    """(parts, kind, notes) of cloud.Cloud; None after a finding."""
    table = _find_table(path, found)
    return table and (lambda: _parts(path, table), "text", ())


def _find_table(path, found):
    with open(path, "rb") as file:
        head = file.read(HEAD)
    if b"\0" in head:
        found.add(path, 0, "file", "is neither text nor PLY nor LAS", "a point cloud: x y z as text, CSV, PLY or LAS")
        return None
    whole = len(head) < HEAD
    text = head.removeprefix(BOM).decode("latin-1")
    returns = "\n" not in text
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    lines = lines if whole else lines[:-1]
    header = words = None
    counts = 0  # lines of one number: a .pts has one, of how many points follow
    for i, line in enumerate(lines, 1):
        bare = line.strip().lstrip("#/").strip()
        if not bare:
            continue
        delimiter, cells = _split(bare)
        comment = line.lstrip().startswith(("#", "//"))
        if comment or sum(map(_is_number, cells)) < min(3, len(cells)):
            if len(cells) >= 3 and _columns(cells):
                header = (i, cells)
            elif len(cells) >= 3 and not comment:
                words = (i, cells)
            continue
        if len(cells) == 1:
            counts += 1
            continue
        if counts > 1:
            found.add(path, 1, "file", "is a PTX, whose points are in the scanner's own frame",
                      "export it as x y z, PLY or LAS in the mine's coordinates")
            return None
        return _table_from(path, lines, i, delimiter, cells, header or words, returns, found)
    parted = next((c for d in ";\t|," for line in lines for c in cells_of(line, d) if PARTED.fullmatch(c)), None)
    if parted:
        found.add(path, 1, "numbers", f"'{parted}' has its thousands parted", "coordinates with nothing between their "
                  "thousands")
        return None
    found.add(path, 1, "file", f"no line of three numbers, it begins with '{text.strip()[:SHOWN]}'",
              "a point cloud: x y z a line, or a header and a CSV")
    return None


def _table_from(path, lines, first, delimiter, cells, names, returns, found):
    if len(cells) < 3:
        found.add(path, first, "point", f"is '{lines[first - 1].strip()[:SHOWN]}'", "x, y and z")
        return None
    shown = [c for line in lines[first - 1:] if line.strip() for c in cells_in(line.strip(), delimiter)]
    decimal, doubtful = find_decimal(shown) if delimiter != "," else (".", None)
    if doubtful:
        found.add(path, first, "numbers", f"every comma has three digits after it, as in '{doubtful}'",
                  "whether it is a decimal comma or parts thousands is open: write the coordinates with points")
        return None
    columns = [0, 1, 2]
    if names:
        line, words = names
        places = _columns(words)
        if places is None:
            degrees = any(w.lower().split("(")[0].strip() in DEGREES for w in words)
            found.add(path, line, "header", "has " + ", ".join(f"'{w[:20]}'" for w in words[:8]),
                      "columns called x, y, z, or easting, northing, elevation" +
                      (", in metres of the mine's grid: project the degrees to it" if degrees else ""))
            return None
        for axis, of_axis in zip("xyz", places):
            if len(of_axis) > 1:
                found.add(path, line, "header", f"has {len(of_axis)} columns for {axis}: "
                          + ", ".join(f"'{words[c][:20]}'" for c in of_axis), "one: give the others other names")
                return None
        columns = [of_axis[0] for of_axis in places]
        units = [cells_in(text.strip(), delimiter) for text in lines[line:first - 1]]
        for at, row in [(line, words), *enumerate(units, line + 1)]:
            other = next((unit for c in columns if c < len(row) and (unit := _other_unit(row[c], row is words))), None)
            if other:
                found.add(path, at, "header", f"says '{other}'", "coordinates in metres: convert them")
                return None
        if len(words) != len(cells):
            found.add(path, first, "point", f"has {len(cells)} cells, the header {len(words)} names",
                      "a cell a name" + ("; with decimal commas, semicolons part the columns"
                                         if delimiter == "," else ""))
            return None
    elif len(cells) > 3 and _counts_up(lines[first - 1:], delimiter):
        found.add(path, first, "point", "the first column counts the points", "a header that says which columns are x, "
                  "y and z, such as number,easting,northing,elevation")
        return None
    return Table(delimiter, decimal, columns, first, len(cells), returns)


def _other_unit(text, in_name):
    """The unit in a column's name, or in the row below it, where that is not the metre; None else."""
    text = text.lower().strip()
    inside = BRACKETS.search(text)
    if feet := FEET.search(inside[1] if inside else "" if in_name else text):
        return feet[0]
    named = UNIT.search(text)
    unit = next(filter(None, named.groups()), "") if named else "" if in_name else text
    return unit if unit in OTHER_UNITS else None


def _counts_up(lines, delimiter):
    """Whether the first column is n, n + 1, n + 2, ...: of whole numbers, and from 0 or 1 or beside two columns with
    decimals, for a grid of points may count metres."""
    rows = [cells_in(line.strip(), delimiter) for line in lines[:100] if line.strip()]
    read = [number(row[0]) for row in rows]
    counts = len(read) > 2 and None not in read and read == [read[0] + i for i in range(len(read))]
    return counts and (read[0] in (0, 1) or all(row[0].isdigit() for row in rows) and all(
        any("." in c or "," in c for c in column) for column in list(zip(*rows))[1:3]))


def _columns(words):
    """Where x, y and z stand among the names of a header, a list each; None where they do not."""
    plain = ["".join(ch for ch in w.lower().split("(")[0].split("[")[0] if ch.isalnum() or ch == "_").removesuffix("_m")
             for w in words]
    found = ([[i for i, w in enumerate(plain) if w in names] for names in family] for family in FAMILIES)
    return next(filter(all, found), None)


def _split(line):
    """(delimiter, cells) of a line; None: blanks part them."""
    for d in (";", "\t", "|"):
        if d in line:
            return d, cells_of(line, d)
    words = line.split()
    if len(words) >= 3 and all(_is_number(w) for w in words):
        return None, words
    if "," in line:
        return ",", cells_of(line, ",")
    return None, words


def cells_in(line, delimiter):
    return line.split() if delimiter is None else cells_of(line, delimiter)


def _is_number(text):
    return number(text) is not None or text.lower() in NONE or WITH_DECIMAL_COMMA.fullmatch(text) is not None


def _parts(path, table):
    line = 1
    with open(path, "rb") as file:
        rest = b""
        while True:
            read = file.read(PART)
            data = rest + (read.removeprefix(BOM) if line == 1 and not rest else read)
            if table.returns:
                data = data.replace(b"\r", b"\n")
            if read:
                end = data.rfind(b"\n") + 1
                if end == 0 and len(data) > 4 * PART:
                    raise BadInput([f"{path}:{line}: point: a line of {len(data)} characters; x y z a line"])
                data, rest = data[:end], data[end:]
            if line < table.first and data:
                skipped = min(table.first - line, data.count(b"\n"))
                for _ in range(skipped):
                    data = data[data.find(b"\n") + 1:]
                line += skipped
            if data.strip():
                yield _points(path, data, line, table)
            line += data.count(b"\n")
            if not read:
                return


def _points(path, data, line, table):
    if table.decimal == ",":
        if table.delimiter != "," and b"." in data:
            _tell_line(path, data, line, table)
        data = data.replace(b",", b".")
    try:
        points = np.loadtxt(io.BytesIO(data), delimiter=table.delimiter, usecols=table.columns, ndmin=2, comments="#",
                            quotechar='"')
    except ValueError:
        _tell_line(path, data, line, table)
        raise BadInput([f"{path}:{line}: points: cannot be read from here on; x y z a line"]) from None
    return points


def _tell_line(path, data, line, table):
    """Raises BadInput for the first line that is no point."""
    for i, row in enumerate(data.decode("latin-1").split("\n"), line):
        row = row.split("#")[0].strip()
        cells = cells_in(row, table.delimiter)
        if not row:
            continue
        if len(cells) < max(table.columns) + 1:
            raise BadInput([f"{path}:{i}: point: has {len(cells)} cells, '{row[:SHOWN]}'; {table.cells}, as the first"])
        for c in table.columns:
            if not cells[c]:
                raise BadInput([f"{path}:{i}: point: a cell is empty, '{row[:SHOWN]}'; a coordinate, or nan, or no "
                                "such row"])
            if decimal_number(cells[c], table.decimal) is None and cells[c].lower() not in NONE:
                raise BadInput([f"{path}:{i}: point: '{cells[c][:SHOWN]}' is no number; a coordinate in m, with "
                                "nothing between its thousands, and a header where x y z are not the first columns"])
