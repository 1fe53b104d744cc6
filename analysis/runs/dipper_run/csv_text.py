"""Rows of a CSV as spreadsheets and loggers write it: other delimiters, decimal commas, quotes, time stamps."""
import csv
import re
from datetime import datetime, timezone

from .text_file import number

DELIMITERS = (";", "\t", "|", ",")  # a comma last: it may stand in a name, "Hoist, ft"
WITH_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?", re.ASCII)
STAMP = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d.*", re.ASCII)


def find_delimiter(header):
    """What parts the names of a header line."""
    bare = re.sub(r'"[^"]*"', "", header)
    return next((d for d in DELIMITERS if d in bare), ",")


def cells_of(line, delimiter):
    """The cells of a line, without quotes and the blanks round them."""
    if '"' in line:
        try:
            read = csv.reader([line.rstrip("\r")], delimiter=delimiter, skipinitialspace=True)
            return [c.strip() for c in next(read)]
        except csv.Error:  # a carriage return within the line
            pass
    return [c.strip() for c in line.split(delimiter)]


def find_decimal(cells):
    """"," where a cell is a number with a decimal comma, else "."."""
    return "," if any(WITH_DECIMAL_COMMA.fullmatch(c) for c in cells if "," in c) else "."


def decimal_number(text, decimal):
    """The finite number of a text; None when it says none. With decimal commas a point is no part of a number."""
    if decimal == ",":
        return None if "." in text else number(text.replace(",", "."))
    return number(text)


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
