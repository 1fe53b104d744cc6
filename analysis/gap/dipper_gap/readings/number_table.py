"""A CSV of numbers and times, as the files of a measured folder are."""
import math

import numpy as np

from dipper_run.csv_text import (SEPARATOR, cells_of, decimal_number, find_decimal, find_delimiter, lines_of,
                                 parted_by, read_stamp, stamp_seconds, without_unit)
from dipper_run.text_file import nearest, read_text

from .channels import KNOWN

TIMES = ("time_s", "t_start_s", "t_end_s")
LONGEST_SHOWN = 40  # characters of a cell that is no number


def _rows(file, found):
    """Line and cells of the header, and of each row that is not empty, of a CSV; `#` starts a comment line."""
    text = read_text(file, found)
    if text is None:
        return 0, [], [], ","
    lines = lines_of(text)
    if lines and SEPARATOR.fullmatch(lines[0][1].strip()):
        del lines[0]
    if not lines:
        found.add(file, 1, "file", "empty", "a header and a row a reading")
        return 0, [], [], ","
    delimiter = find_delimiter(lines[0][1])
    (header_line, header), *rows = [(i, cells_of(line, delimiter)) for i, line in lines]
    named = max((k for k, name in enumerate(header, 1) if name), default=0)
    rows = [(i, cells[:named] if not any(cells[named:]) else cells) for i, cells in rows if any(cells)]
    return header_line, header[:named], rows, delimiter


def read_table(file, need, found, allowed=None, right=None):
    """Columns of numbers by name, the line of each row, and {column of stamps: whether they have a zone}; unreadable
    cells are findings.

    Columns parted by semicolons or tabs may have decimal commas, and numbers their unit behind them. A column of TIMES
    may hold ISO 8601 stamps: they become seconds since 1970. Columns that are not `allowed` are findings, `right`
    says what to do about them.
    """
    header_line, header, rows, delimiter = _rows(file, found)
    if not header:
        return {}, [], {}
    for name in need:
        if name not in header:
            found.add(file, header_line, name, "column missing", "header: " + ",".join(need))
    twice = sorted({name for name in header if header.count(name) > 1})
    for name in twice:
        found.add(file, header_line, name, "column given twice", "keep one")
    if twice:
        return {}, [], {}
    for name in header:
        if allowed is not None and name not in allowed:
            like = nearest(name, allowed)
            found.add(file, header_line, name, "unknown column",
                      (f"{like}, perhaps? " if like else "") + (right or "one of " + ", ".join(allowed)))
    faults = [(line, "row", f"{len(row)} values", _right_number(len(row), len(header), delimiter))
              for line, row in rows if len(row) != len(header)]
    lines = [line for line, _ in rows]
    units = [{_unit_of(name)} for name in header]
    rows = [[without_unit(cell, unit) for cell, unit in zip(row + [""] * len(header), units)] for _, row in rows]
    decimal, doubtful = find_decimal(cell for row in rows for cell in row)
    if doubtful and decimal == ",":
        line, name = next((i, n) for i, row in zip(lines, rows) for n, cell in zip(header, row) if cell == doubtful)
        faults.append((line, name, f"is '{doubtful}', and every comma in the file has three digits after it: it may "
                       "part thousands", "write decimals with a point, and nothing between thousands"))
    values, zones = {}, {}
    for name, cells in zip(header, zip(*rows) if rows else [()] * len(header)):
        stamp = read_stamp(cells[0]) if name in TIMES and cells else None
        if stamp:
            zones[name] = stamp.tzinfo is not None
        values[name] = (_stamps if stamp else _numbers)(name, cells, lines, decimal, faults)
    broken = {line for line, what, _, _ in faults if what == "row"}  # what stands in their cells means nothing
    faults = [f for f in faults if f[1] == "row" or f[0] not in broken]
    found.add_rows(file, faults)
    return values, lines, zones


def _unit_of(name):
    """Of a column, by its channel or else its name: t of truck_mass_t."""
    return KNOWN[name].unit if name in KNOWN else name.rpartition("_")[2]


def _right_number(has, needs, delimiter):
    hint = ": with decimal commas, part the columns by semicolons" if delimiter == "," and has > needs else ""
    return f"{needs}, as in the header{hint}"


def _numbers(name, cells, lines, decimal, faults):
    right = "a finite number" + (" with a decimal comma, as elsewhere in the file" if decimal == "," else "")
    column = []
    for line, text in zip(lines, cells):
        value = decimal_number(text, decimal)
        if value is None:
            faults.append((line, name, f"is '{text[:LONGEST_SHOWN]}'",
                           right + (", without marks of thousands" if parted_by(text, decimal) else "")))
            value = math.nan
        elif name in KNOWN and abs(value) > KNOWN[name].largest:
            faults.append((line, name, f"is {value:g}", f"in {KNOWN[name].unit} ({KNOWN[name].hint})"))
        column.append(value)
    return np.array(column)


def _stamps(name, cells, lines, _, faults):
    stamps = [read_stamp(text) for text in cells]
    column = []
    for line, text, stamp in zip(lines, cells, stamps):
        sound = stamp is not None and (stamp.tzinfo is None) == (stamps[0].tzinfo is None)
        if not sound:
            faults.append((line, name, f"is '{text[:LONGEST_SHOWN]}'",
                           f"a time stamp as in the first row, '{cells[0]}'"))
        column.append(stamp_seconds(stamp) if sound else math.nan)
    return np.array(column)
