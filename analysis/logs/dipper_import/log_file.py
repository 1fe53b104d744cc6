"""A logger's CSV as it stands: the time of each row and the reading of each channel, with the row's line."""
from collections import Counter
from dataclasses import dataclass

import numpy as np

from dipper_run.csv_text import DELIMITERS, LINE_END, cells_of, find_delimiter, is_comment, lines_of, one_blank
from dipper_run.text_file import read_bytes, text_of

from .cells import CellReader
from .clock import spread_stamps
from .join import join
from .layout import find_layout, unnamed_qualities
from .part import cut, times_of
from .phrases import LONGEST_SHOWN, some_rows
from .stamps import find_clock, has_date, unit_of_time, warn_of_row_numbers

HEADER_WITHIN = 1000  # lines: where a header without the time's column is guessed at


@dataclass(frozen=True)
class Log:
    """Rows in the file's order. Channels in their own units (units.py); NaN where a row has no reading."""

    lines: np.ndarray    # 1-based
    stamp_s: np.ndarray  # by the logger's clock, from any zero
    stamps: list         # as written
    values: dict         # {channel: array}
    unit: str = None     # of numbers, a key of NUMBER_FORMATS; None: stamps
    joined: bool = False  # whether channels had times of their own


def read_log(path, what, found, notes):
    """Reads a log as the map `what` says; None after a finding. `notes` takes what a user should know."""
    text = _text(path, what.file.encoding, found)
    if text is None:
        return None
    lines = lines_of(text, what.file.header_line)
    header = _find_header(lines, what)
    if behind_mark := header and _header_as_comment(text, header, what):
        found.add(path, behind_mark, "file", "begins with #, as comments do, and has the names of columns",
                  f"file.header_line: {behind_mark}, if it is the header")
        return None
    if header is None:
        found.add(path, what.file.header_line or 1, "file", "no line with names of columns",
                  "a header above the readings")
        return None
    header_line, names, delimiter = header
    from_line = max(header_line + 1, what.file.data_line or 0)
    cells = [(i, cells_of(line, delimiter)) for i, line in lines if i > header_line]
    rows = _rows(path, [row for row in cells if row[0] >= from_line], names, delimiter, found, notes)
    if rows and rows[-1][0] == lines[-1][0] and text.endswith(lines[-1][1]) and text[-1] not in ' \t"':
        rows = _without_open_end(rows, names, what, notes)
    between = [row for row in cells if row[0] < from_line]
    groups = find_layout(what, path, header_line, names, between, rows, found, notes)
    if groups is None or found.all:
        return None
    if not groups[0].lines:
        found.add(path, header_line, "file", "no rows after the header", "readings")
        return None
    clock = find_clock(path, what, groups[0], found)
    if clock is None:
        return None
    unnamed_qualities(what, names, rows, notes)
    reader = CellReader(what, [cell for g in groups for column in g.cells.values() for cell in column], path, found)
    if found.all:
        return None
    dated = has_date(what.time.format)
    parts = cut(path, what, clock, dated, groups, times_of(groups, clock, dated), found, notes)
    if parts is None:
        return None
    faults, logs = [], []
    for group, stamp_s in zip(*parts):
        for k in np.flatnonzero(np.isnan(stamp_s)):
            faults.append((group.lines[k], "time", f"is '{group.stamps[k][:LONGEST_SHOWN]}'",
                           f"as in the first row, '{groups[0].stamps[0]}'"))
        values = {name: reader.values(name, group, faults, notes) for name in group.cells}
        logs.append(Log(np.array(group.lines, int), stamp_s, group.stamps, values,
                        unit_of_time(what.time.format, group.stamps)))
    found.add_rows(path, faults)
    if found.all:
        return None
    warn_of_row_numbers(what, groups[0].stamps, notes)
    return join([spread_stamps(log) for log in logs] if what.time.spread else logs, what, notes)


def _text(path, encoding, found):
    data = read_bytes(path, found)
    if data is None:
        return None
    if encoding is None:
        text = text_of(data, path, found)
        if text is None:
            found.all[-1] += ", or name its encoding in the map: file: {encoding: utf-16}, or cp1252"
        return text
    try:
        return data.decode(encoding).lstrip("\ufeff")
    except ValueError as e:  # of punycode and idna no UnicodeDecodeError
        why = f"{e.reason} at byte {e.start}" if isinstance(e, UnicodeDecodeError) else str(e)
        found.add(path, 0, "encoding", f"is not {encoding}: {why}", "another file.encoding")
    return None


def _find_header(lines, what):
    """(line, names, delimiter) of the header: the line given, else of those with the time's column the first with
    the most of the channels, else the first of as many cells as most lines have; None without any."""
    delimiters = [what.file.delimiter] if what.file.delimiter else DELIMITERS
    if what.file.header_line:
        marked = any(column.startswith("#") for column in what.time.columns)
        lines = [(i, line if marked else line.lstrip("\ufeff #")) for i, line in lines if i == what.file.header_line]
    wanted = {*what.time.columns, *(c.column for c in what.channels.values())}
    need = [word for column in what.time.columns for word in column.split()]
    best, known = None, 0
    for i, line in lines:
        if not all(word in line for word in need):
            continue
        split = [(names_of(line, d), d) for d in delimiters]
        names, delimiter = max(split, key=lambda s: len(wanted & set(s[0])))
        if set(what.time.columns) <= set(names) and len(wanted & set(names)) > known:
            best, known = (i, names, delimiter), len(wanted & set(names))
        if known == len(wanted):
            break
    if best:
        return best
    split = []
    for i, line in lines[:HEADER_WITHIN]:
        delimiter = what.file.delimiter or find_delimiter(line)
        split.append((i, names_of(line, delimiter), delimiter))
    usual = Counter(len(names) for _, names, _ in split if len(names) > 1).most_common(1)
    return next((s for s in split if usual and len(s[1]) == usual[0][0]), None) or next(iter(split), None)


def _header_as_comment(text, header, what):
    """Line of a # comment that has the names of the time's columns and a channel's, where the header lacks the former;
    None else."""
    if set(what.time.columns) <= set(header[1]):
        return None
    plain = lambda name: name.lstrip("#").strip()
    times, channels = {plain(c) for c in what.time.columns}, {c.column for c in what.channels.values()}
    for i, line in enumerate(LINE_END.split(text)[:HEADER_WITHIN], 1):
        for d in DELIMITERS if is_comment(line) else ():
            names = {plain(name) for name in names_of(line, d)}
            if times <= names and channels & names:
                return i
    return None


def names_of(line, delimiter):
    return [one_blank(name) for name in cells_of(line, delimiter)]


def _rows(path, rows, names, delimiter, found, notes):
    """Rows of the header's length: empty rows, empty cells at the end, a header within the file and a last row cut
    short are no fault."""
    sound, faults, repeated = [], [], []
    for line, cells in rows:
        if not any(cells):
            continue
        if [one_blank(c) for c in cells] == names:
            repeated.append(line)
            continue
        length = len(cells)
        while len(cells) > len(names) and not cells[-1]:
            cells = cells[:-1]
        moved = len(cells) < length and not names[-1] and cells[-1]  # a cell too many, before an empty last column
        if len(cells) == len(names) and not moved:
            sound.append((line, cells))
        elif line == rows[-1][0] and length < len(names):
            notes.append(f"line {line}, the last, is cut short: left out")
        else:
            commas = delimiter == "," and length > len(names)
            faults.append((line, "row", f"{length} cells", f"{len(names)}, as in the header"
                           + (": with decimal commas, separate the columns by semicolons" if commas else "")))
    found.add_rows(path, faults)
    if repeated:
        notes.append(f"{some_rows(repeated)}: the header again, left out")
    return sound


def _without_open_end(rows, names, what, notes):
    """The rows of a file without a line end: the digits of its last cell may be cut short."""
    line, cells = rows[-1]
    if not cells[-1]:
        return rows
    times = {*what.time.columns, *(channel.time for channel in what.channels.values())}
    left = "it" if names[-1] in times else "its last cell"
    notes.append(f"line {line}, the last, has no line end, and may be cut short: {left} is left out")
    return rows[:-1] if left == "it" else [*rows[:-1], (line, [*cells[:-1], ""])]
