"""What the stamps of a log's rows say, in seconds."""
import re
from datetime import datetime

import numpy as np

from dipper_run.csv_text import decimal_number, find_decimal, read_stamp, stamp_seconds

from .cells import OTHER_MARK, parted_thousands
from .import_map import NUMBER_FORMATS
from .phrases import LONGEST_SHOWN

DATE = re.compile(r"%[dDjxcUWyYmbBGs]")  # what in a pattern says the day
READINGS_WITHIN = 20  # lines after the header: where the first readings are looked for, for a hint
SINCE_1970_S = (3e8, 1e10)  # 1979 to 2286: a number beyond it is no count of seconds
COMPACT = re.compile(r"(19|20)\d\d(0[1-9]|1[0-2])([0-2]\d|3[01])[0-2]\d[0-5]\d[0-5]\d(\.\d+)?")  # 20260314061200.2
FRACTION = re.compile(r"[.,: ](\d{1,3})(?=\D*$)")  # of a second, at the end of a stamp
FEW_STAMPS = 0.5  # of the rows: so few different ones of a number with an exponent have lost their digits
TICKS = ((1.2e17, 1.5e17), (6.2e17, 6.8e17))  # of 100 ns since 1601 and since the year 1: 1981 and later


def find_clock(path, what, group, found):
    """Function from a stamp's text to seconds, None where it is none; None after a finding."""
    line, first, form = group.lines[0], group.stamps[0], what.time.format
    number = lambda text: _number(text, what.file)
    if form is None:
        form = "iso" if read_stamp(first) else "s" if number(first) is not None else None
    if form is None:
        later = _first_that(group, lambda t: read_stamp(t) or number(t) is not None)
        found.add(path, line, "time", f"is '{first[:LONGEST_SHOWN]}', neither ISO 8601 nor a number",
                  later or "write its pattern in the map, such as time: {format: '%d.%m.%Y %H:%M:%S'}")
        return None
    if form in NUMBER_FORMATS:
        if what.time.format is None and number(first) > SINCE_1970_S[1]:
            found.add(path, line, "time", f"is {first}, which is no count of seconds",
                      _other_count(first, number(first)))
            return None
        if _lacks_digits(path, what, group, found):
            return None
        unit = NUMBER_FORMATS[form]
        zero = number(first)
        clock = lambda text: None if number(text) is None else (number(text) - (zero or 0.0)) * unit
    elif form == "iso":
        zoned = read_stamp(first)
        clock = lambda text: _iso(text, zoned is not None and zoned.tzinfo is not None)
    else:
        clock = lambda text: _local(text, form)
    if clock(first) is None:
        found.add(path, line, "time", f"is '{first[:LONGEST_SHOWN]}', not as time.format says",
                  _first_that(group, lambda t: clock(t) is not None) or form)
        return None
    if form == "iso" or "%f" in form:
        if at := _unpadded(group.stamps, clock):
            found.add(path, group.lines[at], "time", f"is '{group.stamps[at]}', before the row above as it stands, and "
                      "the digits after its last mark differ in number from row to row",
                      "milliseconds with zeros before them (.050 for 50)")
            return None
    return clock


def _lacks_digits(path, what, group, found):
    """Finding about numbers whose thousands are parted, or whose last digits a spreadsheet has cut off."""
    stamps, first = group.stamps, group.stamps[0]
    parted = parted_thousands(stamps)
    mark = "," if "," in (parted or "") else "."
    if parted and mark != what.file.thousands:
        found.add(path, group.lines[stamps.index(parted)], "time", f"is '{parted}', beside numbers without its mark",
                  f"file.thousands: \"{mark}\", if that parts its thousands")
        return True
    if "e" in first.lower() and len(set(stamps)) < FEW_STAMPS * len(stamps):
        found.add(path, group.lines[0], "time", f"is {first}, as many rows: its last digits are lost",
                  "numbers with all their digits: a spreadsheet cuts them; give the logger's own file")
        return True
    return False


def _unpadded(stamps, clock):
    """The first row that goes back because its milliseconds lack the zeros before them: .50 after .0 is 50 ms; None
    where more rows go back when they are read so."""
    fractions = [FRACTION.search(stamp) for stamp in stamps]
    if len({len(m[1]) for m in fractions if m}) < 2:
        return None
    read = [(k, m[1], time) for k, m in enumerate(fractions) if m and (time := clock(stamps[k])) is not None]
    rows, digits, time = zip(*read) if read else ((), (), ())
    in_ms = np.array(time) + [1e-3 * int(d) - float(f"0.{d}") for d in digits]
    back, back_in_ms = ([np.flatnonzero(sign * np.diff(t) < -1e-9) for sign in (1, -1)] for t in (time, in_ms))
    back = min(back, key=len)
    return rows[back[0] + 1] if len(back) > len(min(back_in_ms, key=len)) else None


def _other_count(text, value):
    if COMPACT.fullmatch(text):
        return "its pattern in the map, time.format: '%Y%m%d%H%M%S" + (".%f'" if "." in text else "'")
    return _unit_since_1970(value)


def _unit_since_1970(value):
    units = [u for u, size in NUMBER_FORMATS.items() if SINCE_1970_S[0] <= value * size <= SINCE_1970_S[1]]
    if any(a <= value <= b for a, b in TICKS):
        units = ["ticks"]
    return "its unit in the map, " + (f"time.format: {units[0]}, perhaps" if units else
                                      f"time.format: one of {', '.join(NUMBER_FORMATS)}")


def _first_that(group, is_stamp):
    """What to write where units or descriptions stand between the header and the readings; None where they do not."""
    for line, stamp in list(zip(group.lines, group.stamps))[1:READINGS_WITHIN]:
        if is_stamp(stamp):
            return f"if the readings begin at line {line}, file.data_line: {line}"
    return None


def _number(text, file):
    """A number's own marks hold, unless the map says what parts thousands."""
    decimal = file.decimal or OTHER_MARK.get(file.thousands) if file.thousands else None
    return decimal_number(text, decimal or find_decimal([text])[0], file.thousands)


def _iso(text, zoned):
    stamp = read_stamp(text)
    return None if stamp is None or (stamp.tzinfo is not None) != zoned else stamp_seconds(stamp)


def _local(text, form):
    try:
        return stamp_seconds(datetime.strptime(text, form))
    except ValueError:
        return None


def unit_of_time(form, stamps):
    """The unit of numbers; None of other stamps."""
    if form is None and stamps and not read_stamp(stamps[0]):
        return "s"
    return form if form in NUMBER_FORMATS else None


def warn_of_row_numbers(what, stamps, notes):
    """Warns of times such as 0, 1, 2, ... that the map does not call seconds; a clock's are so since 1970."""
    if what.time.format is not None or len(stamps) < 3 or read_stamp(stamps[0]):
        return
    first = _number(stamps[0], what.file)
    if first < SINCE_1970_S[0] and all(_number(text, what.file) == first + k for k, text in enumerate(stamps)):
        notes.append(f"warning: the time is {stamps[0]}, {stamps[1]}, {stamps[2]}, ... in every row, taken as seconds: "
                     "is it the row's number? time.format: s, if not")


def has_date(form):
    return not form or "%" not in form or bool(DATE.search(form))
