"""What the cells of a channel say, in its own unit: readings that are none, or not good ones, become NaN."""
import re

import numpy as np

from dipper_gap.readings.suspect import sentinels
from dipper_run.csv_text import (GROUPED, THOUSANDS, WITH_UNIT, decimal_number, find_decimal, parted_by,
                                 with_minus_first, without_unit)

from .units import DRIVES, SWITCH
from .phrases import LONGEST_SHOWN, some_names, some_rows

NOT_A_NUMBER = re.compile(r"[+-]?1\.#\w+")  # 1.#QNAN, -1.#IND: NaN as programs on Windows print it
SWITCH_WORDS = {**dict.fromkeys(("on", "open", "opened", "true", "yes"), "1"),
                **dict.fromkeys(("off", "closed", "shut", "false", "no"), "0")}
OPC_GOOD = (192, 255)       # OPC's quality, of 8 bits: these are good
OPC_UA_NOT_GOOD = 1 << 30   # OPC UA's status codes, of 32 bits: 0 is good, these are uncertain or bad
HEX = re.compile(r"0x[0-9a-f]+", re.IGNORECASE | re.ASCII)
TURN = (360.0, 90.0)  # deg, and how much a machine may swing between two rows or over a gap
WHOLE = re.compile(r"[+-]?\d+", re.ASCII)
LEAST_WHOLE = 100  # among whole numbers up to 1.234: they go on above 999
OTHER_MARK = {",": ".", ".": ","}


class CellReader:
    """Reads the cells of a log's channels with one decimal mark for all of them; that it is left open is a finding."""

    def __init__(self, what, cells, path, found):
        self._what = what
        known, file = {c.unit for c in what.channels.values()}, what.file
        marks = {ord(m): None for m in THOUSANDS[file.thousands]} if file.thousands in ("'", "space") else {}
        self._decimal, doubtful = find_decimal(without_unit(c, known).translate(marks) for c in cells)
        if file.decimal:
            self._decimal = file.decimal
        elif file.thousands in OTHER_MARK:
            self._decimal = OTHER_MARK[file.thousands]
        elif doubtful and not file.thousands:
            mark = self._decimal
            name = {",": "comma", ".": "point"}[mark]
            found.add(path, 0, "numbers", f"every {name} has three digits after it, as in '{doubtful}'",
                      f"say in the map whether it is a decimal {name}, file.decimal: \"{mark}\", or parts thousands, "
                      f"file.thousands: \"{mark}\"")

    def values(self, name, group, faults, notes):
        """Array of a channel of a layout.Group; faults (line, what, wrong, right) are appended."""
        channel, file = self._what.channels[name], self._what.file
        raw = np.full(len(group.lines), np.nan)
        for k, text in enumerate(group.cells[name]):
            if text.lower() in file.missing or NOT_A_NUMBER.fullmatch(text):
                continue
            if channel.switch:
                text = SWITCH_WORDS.get(text.lower(), text)
            value = decimal_number(without_unit(text, {channel.unit}), self._decimal, file.thousands)
            if value in file.missing_numbers:
                continue
            if value is None or channel.switch and not 0 <= value <= 1:
                faults.append((group.lines[k], channel.column, f"is '{text[:LONGEST_SHOWN]}'",
                               self._right(text, channel)))
            else:
                raw[k] = value
        parted = None if file.thousands or file.decimal else parted_thousands(group.cells[name])
        if parted and self._decimal in parted:
            at = group.lines[group.cells[name].index(parted)]
            faults.append((at, channel.column, f"is '{parted}', beside whole numbers up to 999",
                           f"{parted.replace(self._decimal, '')}, if that parts its thousands: in other columns it is "
                           f"the decimal mark; file.decimal: \"{self._decimal}\", if here, too"))
        if name in group.quality:
            self._leave_out_bad(name, group, raw, faults, notes)
        _warn_of_sentinels(name, channel, self._what.limits.get(name), group.lines, raw, notes)
        value = channel.slope * raw + channel.intercept
        return _unwrapped(value, group.lines, notes) if name == "swing" else value

    def _right(self, text, channel):
        if right := with_minus_first(without_unit(text, {channel.unit})):
            return f"{right}, if that is meant: a minus before the number"
        if channel.unit == SWITCH:
            return "0 or 1, or words such as open and closed, on and off, true and false"
        mark = parted_by(without_unit(text, {channel.unit}), self._decimal)
        if not mark and text.count(self._decimal) > 1:
            mark = self._decimal
        if mark:
            return f"file.thousands: \"{mark}\", if that parts its thousands"
        unit = WITH_UNIT.fullmatch(text)
        if unit and decimal_number(unit[1], self._decimal) is not None and unit[2] not in ("e", "E"):
            return f"a number in {channel.unit}, as the map says, or another unit in the map"
        return "a number" + (" with a decimal comma" if self._decimal == "," else "") + \
            "; if it means that there is no reading, list it under file.missing"

    def _leave_out_bad(self, name, group, raw, faults, notes):
        texts, channel, file = group.quality[name], self._what.channels[name], self._what.file
        bad = np.array([not self._good(t) for t in texts], bool) & np.isfinite(raw)
        status = next((t for t in texts if abs(_code(t) or 0) >= OPC_UA_NOT_GOOD), None)
        if status and not file.good:
            good = next((t for t in texts if _code(t) == 0), "0")
            faults.append((group.lines[texts.index(status)], channel.quality, f"is {status}, a status code of OPC UA",
                           f"0 is good there: file: {{good: ['{good}']}}, and more codes if they are good, too"))
        elif bad.any() and bad.sum() == np.isfinite(raw).sum():
            faults.append((group.lines[0], channel.quality, f"no reading of {name} is good: they are "
                           + some_names(sorted({t or "empty" for t in texts}), 4),
                           "list what says that one is under file.good"
                           + (" ('' for empty)" if "" in texts else "")))
        elif bad.any():
            bad_names = some_names(sorted({t or "empty" for t, b in zip(texts, bad) if b}), 4)
            lines = np.array(group.lines)[bad]
            notes.append(f"{name}: {some_rows(lines, 'reading')} with the quality {bad_names}, left out")
        raw[bad] = np.nan

    def _good(self, text):
        good = self._what.file.good
        if good:
            return text.lower() in good
        value = _code(text)
        return text.lower().startswith("good") or text.lower() in ("ok", "valid") or \
            (value is not None and OPC_GOOD[0] <= value <= OPC_GOOD[1])


def parted_thousands(cells):
    """A cell such as 1,234 among others such as 705, where every cell with that mark has three digits after it: what
    parts thousands, not decimals; None where there is none."""
    grouped = next(filter(None, map(GROUPED.fullmatch, cells)), None)
    if grouped is None or not all(GROUPED.fullmatch(c) for c in cells if grouped[1] in c):
        return None
    whole = max((abs(int(c)) for c in cells if WHOLE.fullmatch(c)), default=0)
    return grouped[0] if LEAST_WHOLE <= whole < 1000 else None


def _code(text):
    """The number of a quality, as 192 or 0xC0; None where it is none."""
    return int(text, 16) if HEX.fullmatch(text) else decimal_number(text, ".")


def _unwrapped(swing, lines, notes):
    """A swing in deg that begins anew after a whole turn, as one that goes on."""
    there = np.flatnonzero(np.isfinite(swing))
    steps = np.diff(swing[there], prepend=swing[there[:1]])
    turns = np.where(np.abs(np.abs(steps) - TURN[0]) < TURN[1], np.sign(steps), 0.0)
    if turns.any():
        notes.append(f"swing: {some_rows(np.array(lines)[there[turns != 0]], 'step')} of a whole turn: it goes on from "
                     "there, without them")
        swing[there] -= TURN[0] * np.cumsum(turns)
    return swing


def _warn_of_sentinels(name, channel, limits, lines, raw, notes):
    """Warns of readings such as -9999 that stand far off their neighbours: loggers write them for "no reading". Those
    of a drive outside its limits are left out later on, and reported."""
    if name in DRIVES and limits is not None and np.isfinite([limits.min, limits.max]).all():
        return
    at = sentinels(raw)
    if len(at):
        notes.append(f"warning: {name}: {some_rows(np.array(lines)[at], 'reading')} of {raw[at[0]]:.6g} "
                     f"{channel.unit}, far off those beside it: if that means no reading, "
                     f"file: {{missing: [{raw[at[0]]:.12g}]}}")
