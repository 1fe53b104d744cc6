"""Rows of a CSV as spreadsheets and loggers write it: other delimiters, decimal commas, quotes, time stamps."""
import csv
import re
from datetime import datetime, timezone

from .text_file import number

DELIMITERS = (";", "\t", "|", ",")  # a comma last: it may stand in a name, "Hoist, ft"
WITH_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?", re.ASCII)
GROUPED = re.compile(r"[+-]?[1-9]\d{0,2}([.,])\d{3}(\1\d{3})*", re.ASCII)  # thousands, or three decimals
BLANKS = "\u00a0\u2009\u202f"  # that part thousands, beside a blank
THOUSANDS = {",": ",", ".": ".", "'": "'\u2019", "space": " " + BLANKS}
MINUS = str.maketrans(dict.fromkeys("\u2212\u2010\u2011\u2012\u2013\u2014\ufe63\uff0d", "-"))  # of word processors
LINE_END = re.compile("\r*\n|\r|\x85|\u2028|\u2029")
SIGN = re.compile(r"([+-])[ \u00a0]+(?=[\d.,])")  # before a number, with blanks as accountants write it
MINUS_ELSEWHERE = re.compile(r"\((\d[\d.,' ]*)\)|(\d[\d.,' ]*)-", re.ASCII)  # (200.0), 200.0-
WITH_UNIT = re.compile(r"(.*\d[.,]?)\s*([^\d\s.,+'()#-]\D*)", re.DOTALL)
OTHER_NAMES = {name: unit for unit, names in {  # of units, in small letters
    "m": "metre metres meter meters", "mm": "millimetre millimetres", "cm": "centimetre centimetres",
    "ft": "feet foot", "in": "inch inches", "yd": "yard yards", "deg": "° º degree degrees", "rad": "radian radians",
    "rev": "revs revolutions turns", "kn": "kilonewton kilonewtons", "n": "newton newtons",
    "kip": "kips klbf kipf", "lbf": "lbsf", "tf": "tonnef", "kgf": "kp", "t": "tonne tonnes mt", "ton": "tons tn",
    "kg": "kgs",
    "lb": "lbs pound pounds", "klb": "klbs", "short ton": "short_ton short-ton short_tons ston stons st",
    "long ton": "long_ton long-ton long_tons", "%": "percent pct"}.items() for name in names.split()}
OTHER_NAMES.update({"short tons": "short ton", "us ton": "short ton", "us tons": "short ton", "long tons": "long ton",
                    "metric ton": "t", "metric tons": "t"})
STAMP = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d.*", re.ASCII)
FIRST_STAMP_S = 10 * 365 * 86400  # seconds since 1970: a clock that began at 0 has not run for ten years
LAST_STAMP_S = 253402300800       # the year 10000: milliseconds, more likely
SHEET_ERROR = re.compile(r"\s*#(N/A|VALUE!|DIV/0!|REF!|NUM!|NULL!|NAME\?)\s*([;\t|,]|$)", re.IGNORECASE)
SEPARATOR = re.compile(r"sep=.", re.IGNORECASE)  # a spreadsheet's first line, which is no header
LONGEST_QUOTE = 20  # lines: a quote that is still open then is a slip


def lines_of(text, header=None):
    """(number, line) of each line with more than blanks that is no # comment; that of the number `header` is none.
    Lines end as Windows, Unix or old Macs end them; quotes may hold line breaks, and the line then has the number of
    its first."""
    out, open_line, since = [], None, 0
    for i, line in enumerate(LINE_END.split(text), 1):
        if open_line is not None and i - since < LONGEST_QUOTE:
            line, at = f"{open_line} {line}", since
        elif line.strip() and (i == header or not is_comment(line)):
            at = i
        else:
            continue
        if _is_open(line):
            open_line, since = line, at
            continue
        open_line = None
        out.append((at, line))
    return out if open_line is None else [*out, (since, open_line)]


def is_comment(line):
    """Whether it begins with #, other than by a spreadsheet's word for no value."""
    return line.lstrip().startswith("#") and not SHEET_ERROR.match(line)


def _is_open(line):
    """Whether a quoted cell, which begins a cell, goes on in the next line."""
    return line.count('"') % 2 == 1 and re.search(r'(^|[;\t|,])\s*"', line) is not None


def find_delimiter(header):
    """What parts the names of a header line."""
    bare = re.sub(r'"[^"]*"', "", header)
    return next((d for d in DELIMITERS if d in bare), ",")


def cells_of(line, delimiter):
    """The cells of a line, without quotes and the blanks round them."""
    if '"' in line:
        try:
            return [c.strip() for c in next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))]
        except csv.Error:
            pass
    return [c.strip() for c in line.split(delimiter)]


def one_blank(name):
    """A column's name with a blank for each stretch of blanks and line breaks."""
    return " ".join(name.split())


def find_decimal(cells):
    """(decimal, doubtful) of the numbers among cells: "," or ".", and a cell that leaves it open, or None. `943,981` is
    943.981 or 943981; a number such as 0,5 or 1234,5 in any cell settles it."""
    sure, grouped = set(), {}
    for cell in cells:
        cell = plain_sign(cell)
        if m := GROUPED.fullmatch(cell):
            grouped.setdefault(m[1], cell)
        elif "," in cell:
            sure.update("," if WITH_DECIMAL_COMMA.fullmatch(cell) else "")
        elif "." in cell and number(cell) is not None:
            sure.add(".")
    decimal = "," if "," in sure or (not sure and "," in grouped) else "."
    return decimal, None if sure else grouped.get(decimal)


def decimal_number(text, decimal, thousands=""):
    """The finite number of a text; None when it says none. With decimal commas a point is no part of a number.
    `thousands`, a key of THOUSANDS, may part whole groups of three digits before the decimals."""
    text = plain_sign(text)
    if thousands:
        text = _ungrouped(text, decimal, THOUSANDS[thousands])
    if decimal == ",":
        return None if "." in text else number(text.replace(",", "."))
    return number(text)


def without_unit(text, units):
    """The text without a unit behind its number, where that is one of `units`."""
    if not text or text[-1].isdigit():
        return text
    m = WITH_UNIT.fullmatch(text)
    return m[1].strip() if m and unit_name(m[2]) in {u.lower() for u in units} else text


def unit_name(text):
    """A unit's usual name in small letters, by any of its names."""
    name = one_blank(text).lower().removesuffix(".")
    return OTHER_NAMES.get(name, name)


def plain_sign(text):
    """The text with its minus as - and without blanks after a sign."""
    return SIGN.sub(r"\1", text.translate(MINUS).strip(), count=1)


def with_minus_first(text):
    """-200.0 for (200.0) and 200.0-, None for any other text."""
    m = MINUS_ELSEWHERE.fullmatch(text.translate(MINUS))
    return m and f"-{(m[1] or m[2]).strip()}"


def _ungrouped(text, decimal, marks):
    """Thousands by threes, or in India by twos before the last three: 9,43,981."""
    whole, point, rest = text.partition(decimal)
    mark = f"[{re.escape(marks)}]"
    if not re.fullmatch(rf"[+-]?(\d{{1,3}}({mark}\d{{3}})+|\d{{1,2}}({mark}\d\d)+{mark}\d{{3}})", whole, re.ASCII):
        return text
    return re.sub(f"[{re.escape(marks)}]", "", whole) + point + rest


def parted_by(text, decimal):
    """What parts the thousands of a text that is no number otherwise, a key of THOUSANDS; None where nothing does."""
    return next((mark for mark in THOUSANDS if mark != decimal
                 and decimal_number(text, decimal, mark) is not None), None)


def read_stamp(text):
    """An ISO 8601 date with a time as a datetime, or None."""
    if not STAMP.fullmatch(text):
        return None
    try:
        return datetime.fromisoformat(text.replace(",", "."))
    except ValueError:
        return None


def stamp_seconds(stamp):
    """Seconds since 1970 of a datetime; one without a zone counts as UTC."""
    return (stamp if stamp.tzinfo else stamp.replace(tzinfo=timezone.utc)).timestamp()


def stamp_text(seconds):
    """Seconds since 1970 as an ISO 8601 stamp in UTC; a clock that began at 0 stays in seconds."""
    if not FIRST_STAMP_S <= seconds < LAST_STAMP_S:
        return f"{seconds:g} s"
    return datetime.fromtimestamp(seconds, timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
