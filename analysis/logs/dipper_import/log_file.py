"""A logger's CSV as it stands: the time of each row and the reading of each channel, with the row's line."""
import re
from dataclasses import dataclass
from datetime import datetime

import numpy as np

from dipper_run.csv_text import (cells_of, decimal_number, find_decimal, find_delimiter, read_stamp,
                                 stamp_seconds)
from dipper_run.text_file import nearest, read_text

from .import_map import NUMBER_FORMATS

HEADER_WITHIN = 100  # lines: where the names of the columns are looked for
LONGEST_SHOWN = 40   # characters of a cell that is quoted
DATE = re.compile(r"%[dDjxcUWyYmbBGs]")  # what in a pattern says the day


@dataclass(frozen=True)
class Log:
    """Rows in the file's order. Channels in their own units (units.py); NaN where a row has no reading."""

    lines: np.ndarray    # 1-based
    stamp_s: np.ndarray  # by the logger's clock, from any zero
    stamps: list         # as written
    values: dict         # {channel: array}
    has_date: bool       # else the clock begins anew at midnight


def read_log(path, what, found, notes):
    """Reads a log as the map `what` says; None after a finding. `notes` takes what a user should know."""
    text = _text(path, what.file.encoding, found)
    if text is None:
        return None
    lines = [(i, line) for i, line in enumerate(text.split("\n"), 1)
             if line.strip() and not line.lstrip().startswith("#")]
    header = _find_header(lines, what)
    if header is None:
        found.add(path, what.file.header_line or 1, "file", "no line with names of columns",
                  "a header above the readings")
        return None
    header_line, names, delimiter = header
    place = _columns(what, names, path, header_line, found)
    if place is None:
        return None
    from_line = max(header_line + 1, what.file.data_line or 0)
    rows = _rows(path, [(i, cells_of(line, delimiter)) for i, line in lines if i >= from_line], names, delimiter, found,
                 notes)
    if not rows:
        if not found.all:
            found.add(path, header_line, "file", "no rows after the header", "readings")
        return None
    clock = _clock(path, what, rows, place["time"], found)
    if clock is None:
        return None
    rows = _cut(path, what, clock, rows, place["time"], found)
    faults = []
    stamps = [_stamp_text(cells, place["time"]) for _, cells in rows]
    stamp_s = np.array([np.nan if clock(t) is None else clock(t) for t in stamps], float)
    for k in np.flatnonzero(np.isnan(stamp_s)):
        faults.append((rows[k][0], "time", f"is '{stamps[k][:LONGEST_SHOWN]}'", f"as in the first row, '{stamps[0]}'"))
    values = _values(what, rows, place, faults)
    found.add_rows(path, faults)
    lines_of = np.array([i for i, _ in rows])
    form = what.time.format
    return Log(lines_of, stamp_s, stamps, values, not form or "%" not in form or bool(DATE.search(form)))


def _text(path, encoding, found):
    if encoding is None:
        text = read_text(path, found)
        if text is None:
            found.all[-1] += ", or name its encoding in the map: file: {encoding: utf-16}, or cp1252"
        return text
    try:
        return path.read_bytes().decode(encoding).lstrip("\ufeff")
    except OSError as e:
        found.add(path, 0, "file", f"cannot be read: {e.strerror}", "a file that may be read")
    except UnicodeDecodeError as e:
        found.add(path, 0, "encoding", f"is not {encoding}: {e.reason} at byte {e.start}", "another file.encoding")
    return None


def _find_header(lines, what):
    """(line, names, delimiter) of the header: the line given, else the first with the time's column, else the first
    with several cells; None without any."""
    if what.file.header_line:
        candidates = [(i, line) for i, line in lines if i == what.file.header_line]
    else:
        candidates = lines[:HEADER_WITHIN]
    split = []
    for i, line in candidates:
        delimiter = what.file.delimiter or find_delimiter(line)
        split.append((i, cells_of(line, delimiter), delimiter))
    with_time = (h for h in split if set(what.time.columns) <= set(h[1]))
    return next(with_time, None) or next((h for h in split if len(h[1]) > 1), None) or next(iter(split), None)


def _columns(what, names, path, header_line, found):
    """{channel: index}, and the indices of the time; None when a column is missing."""
    before = len(found.all)
    place = {}
    wanted = [("time", c, what.time.line) for c in what.time.columns]
    wanted += [(f"channels.{n}", c.column, c.line) for n, c in what.channels.items()]
    for key, column, line in wanted:
        if names.count(column) == 1:
            place.setdefault(key, []).append(names.index(column))
            continue
        if column in names:
            wrong, right = f"'{column}' is the name of {names.count(column)} columns", "names that differ"
        else:
            like = nearest(column, names)
            wrong = f"'{column}' is no column of {path.name} (line {header_line})"
            right = (f"'{like}', perhaps? " if like else "") + "it has " + ", ".join(f"'{n}'" for n in names if n)
        found.add(what.path, line, f"{key}.column", wrong, right)
    if len(found.all) > before:
        return None
    return {"time": place["time"], **{n: place[f"channels.{n}"][0] for n in what.channels}}


def _rows(path, rows, names, delimiter, found, notes):
    """Rows of the header's length: empty cells at the end, a header within the file and a last row cut short are no
    fault."""
    sound, faults, repeated = [], [], []
    for line, cells in rows:
        if cells == names:
            repeated.append(line)
            continue
        while len(cells) > len(names) and not cells[-1]:
            cells = cells[:-1]
        if len(cells) == len(names):
            sound.append((line, cells))
        elif line == rows[-1][0] and len(cells) < len(names):
            notes.append(f"line {line}, the last, is cut short: left out")
        else:
            commas = delimiter == "," and len(cells) > len(names)
            faults.append((line, "row", f"{len(cells)} cells", f"{len(names)}, as in the header"
                           + (": with decimal commas, semicolons part the columns" if commas else "")))
    found.add_rows(path, faults)
    if repeated:
        notes.append(f"{some_rows(repeated)}: the header again, left out")
    return sound


def _stamp_text(cells, places):
    return " ".join(cells[p] for p in places)


def _clock(path, what, rows, places, found):
    """Function from a stamp's text to seconds, None where it is none; None after a finding."""
    line, cells = rows[0]
    first, form = _stamp_text(cells, places), what.time.format
    if form is None:
        form = "iso" if read_stamp(first) else "s" if _number(first) is not None else None
    if form is None:
        found.add(path, line, "time", f"is '{first[:LONGEST_SHOWN]}', neither ISO 8601 nor a number",
                  "write its pattern in the map, such as time: {format: '%d.%m.%Y %H:%M:%S'}")
        return None
    if form in NUMBER_FORMATS:
        unit = NUMBER_FORMATS[form]
        zero = _number(first)
        clock = lambda text: None if _number(text) is None else (_number(text) - (zero or 0.0)) * unit
    elif form == "iso":
        zoned = read_stamp(first)
        clock = lambda text: _iso(text, zoned is not None and zoned.tzinfo is not None)
    else:
        clock = lambda text: _local(text, form)
    if clock(first) is None:
        found.add(path, line, "time", f"is '{first[:LONGEST_SHOWN]}', not as time.format says", form)
        return None
    return clock


def _number(text):
    return decimal_number(text, find_decimal([text]))


def _iso(text, zoned):
    stamp = read_stamp(text)
    return None if stamp is None or (stamp.tzinfo is not None) != zoned else stamp_seconds(stamp)


def _local(text, form):
    try:
        return stamp_seconds(datetime.strptime(text, form))
    except ValueError:
        return None


def _cut(path, what, clock, rows, places, found):
    """The rows within time.from and time.to."""
    ends = []
    for key, stamp, open_end in (("from", what.time.first, -np.inf), ("to", what.time.last, np.inf)):
        at = open_end if stamp is None else clock(stamp)
        if at is None:
            found.add(what.path, what.time.line, f"time.{key}", f"is '{stamp}'",
                      f"a stamp as in the log, '{_stamp_text(rows[0][1], places)}'")
            return rows
        ends.append(at)
    if ends == [-np.inf, np.inf]:
        return rows
    times = [clock(_stamp_text(cells, places)) for _, cells in rows]
    kept = [row for row, t in zip(rows, times) if t is None or ends[0] <= t <= ends[1]]
    if not kept:
        found.add(what.path, what.time.line, "time.from", f"no row of {path.name} is within from and to",
                  f"stamps from '{_stamp_text(rows[0][1], places)}' to '{_stamp_text(rows[-1][1], places)}'")
        return rows
    return kept


def _values(what, rows, place, faults):
    cells = {name: [row[place[name]] for _, row in rows] for name in what.channels}
    decimal = what.file.decimal or find_decimal(c for column in cells.values() for c in column)
    right = "a number" + (" with a decimal comma" if decimal == "," else "") + \
        "; if it means that there is no reading, list it under file.missing"
    values = {}
    for name, channel in what.channels.items():
        column = np.full(len(rows), np.nan)
        for k, text in enumerate(cells[name]):
            if text.lower() in what.file.missing:
                continue
            value = decimal_number(text, decimal)
            if value is None:
                faults.append((rows[k][0], channel.column, f"is '{text[:LONGEST_SHOWN]}'", right))
            else:
                column[k] = channel.slope * value + channel.intercept
        values[name] = column
    return values


def some_rows(lines, what="row", most=5):
    """How many, and which: "7 rows (lines 3, 4, 5, 9, 12 and 2 more)"."""
    lines = sorted(int(i) for i in lines)
    more = f" and {len(lines) - most} more" if len(lines) > most else ""
    s = "s" if len(lines) > 1 else ""
    return f"{len(lines)} {what}{s} (line{s} {', '.join(map(str, lines[:most]))}{more})"
