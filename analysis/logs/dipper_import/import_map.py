"""MAP.yaml: which column of a log is which channel, in what unit, and what the machine can do (docs/import.md)."""
import math
import re
from collections import Counter
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

import yaml

from dipper_run.csv_text import THOUSANDS, decimal_number, find_decimal, one_blank
from dipper_run.findings import Findings
from dipper_run.section import Section
from dipper_run.text_file import number, read_yaml

from .units import CHANNELS, DRIVES, FORCES, PERCENT, SWITCH, TRUCK_MASS, UNITS

DELIMITERS = {",": ",", ";": ";", "|": "|", "tab": "\t", "\\t": "\t", "\t": "\t"}
NUMBER_FORMATS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "ticks": 1e-7, "min": 60.0, "h": 3600.0,
                  "days": 86400.0}  # ticks of 100 ns: Windows and .NET
MISSING = ("", "-", "--", "---", "nan", "null", "none", "n/a", "na", "#n/a")
READS = ("total", "pass", "dipper")  # in the truck; what the last pass brought; the load in the dipper
LONGEST_GAP_S = 2.0
G = 9.81  # m/s^2
SAMPLE_S = 0.1


@dataclass(frozen=True)
class FileFormat:
    delimiter: str = None      # None: seen from the header
    decimal: str = None        # None: seen from the numbers
    thousands: str = ""        # a key of csv_text.THOUSANDS
    encoding: str = None       # None: UTF-8
    header_line: int = None    # None: the first line with the time's column
    data_line: int = None      # None: the line after the header
    missing: frozenset = frozenset(MISSING)
    missing_numbers: frozenset = frozenset()  # readings that are none, however they are written
    good: frozenset = frozenset()             # what says that a reading is good; empty: the usual words
    value: str = None          # of a log with a row a reading: the column of the readings


@dataclass(frozen=True)
class TimeFormat:
    columns: tuple
    format: str                # iso, a key of NUMBER_FORMATS, a pattern with %, or None: as the first row is
    clock_set_at: frozenset    # lines at which somebody set the logger's clock
    first: str                 # None, or a stamp: rows before it are left out
    last: str
    spread: bool               # rows of one stamp are spread evenly up to the next
    line: int                  # of `column` in the map


@dataclass(frozen=True)
class Channel:
    """value = slope * reading + intercept, in the channel's own unit."""

    column: str
    unit: str
    slope: float
    intercept: float
    switch: bool
    held: bool                 # a row without a reading has the last one before it
    quality: str               # None, or the column that says whether a reading is good
    time: str                  # None, or the column of its own time
    sigma: float               # of a reading, own unit; None: not given
    common_sigma: float
    reads: str                 # of a scale: one of READS
    line: int
    scaled: bool = False       # whether the map has a scale


@dataclass(frozen=True)
class Limits:
    """What a drive can do, in its own unit and seconds; infinite where nothing is known."""

    min: float = -math.inf
    max: float = math.inf
    speed: float = math.inf
    acceleration: float = math.inf


@dataclass(frozen=True)
class ImportMap:
    path: Path
    file: FileFormat
    time: TimeFormat
    channels: dict
    limits: dict = field(default_factory=dict)   # {drive: Limits}
    stall_kN: dict = field(default_factory=dict)  # {force: what the machine's drive can pull}, as far as it says so
    empty_kN: dict = field(default_factory=dict)  # {force: what an empty dipper takes}, as far as the machine says so
    rated_load_t: float = None                    # of the machine's dipper, as far as it says so
    longest_gap_s: float = LONGEST_GAP_S
    sample_s: float = SAMPLE_S

    def smooth(self):
        """The drives whose readings follow one another."""
        return [n for n in DRIVES if n in self.channels and not self.channels[n].switch]

    def measured(self):
        """Whether there is anything for a measured folder: a force or a mass."""
        return any(name in self.channels for name in (*FORCES, TRUCK_MASS))


def read_map(path):
    """Reads MAP.yaml; throws BadInput with everything that is wrong with it."""
    found = Findings()
    root = read_yaml(path, found, "a map with time, channels, ...")
    found.raise_if_any()
    top = Section(root, path, found)
    limits, forces = _limits(top, path)
    made = ImportMap(path, _file(top), _time(top), _channels(top), limits, *forces,
                     top.number("longest_gap_s", LONGEST_GAP_S, "seconds, above 0", allowed=lambda x: x > 0),
                     top.number("sample_s", SAMPLE_S, "seconds, above 0", allowed=lambda x: x > 0))
    top.end()
    _check_switches(made, found)
    if made.measured():
        _check_sigmas(made, found)
    found.raise_if_any()
    return made


def _whole(x):
    return x >= 1 and x == int(x)


def _file(top):
    s = top.section("file")
    delimiter = s.one_of("delimiter", tuple(DELIMITERS))
    encoding = s.text("encoding", right="such as utf-8, utf-16, cp1252")
    if encoding and not _is_of_text(encoding):
        s.wrong("encoding", f"is {encoding}", "such as utf-8, utf-16, cp1252")
    header = s.number("header_line", right="a line, from 1", allowed=_whole)
    data = s.number("data_line", right="a line, from 1", allowed=_whole)
    missing, decimal = s.texts("missing", "texts that stand for no reading"), s.one_of("decimal", (".", ","))
    thousands = s.one_of("thousands", tuple(THOUSANDS), "")
    if thousands and thousands == decimal:
        s.wrong("thousands", f"is {thousands}, as file.decimal", "another mark than the decimal one")
    good, value = s.texts("good", "texts that say a reading is good"), _column(s, "value")
    s.end()
    numbers = (decimal_number(m, find_decimal([m])[0]) for m in missing)
    return FileFormat(DELIMITERS.get(delimiter), decimal, thousands, encoding, header and int(header),
                      data and int(data), frozenset(MISSING) | {m.lower() for m in missing},
                      frozenset(n for n in numbers if n is not None), frozenset(g.lower() for g in good), value)


def _is_of_text(encoding):
    """Whether Python knows it, as letters in bytes: not hex, base64 or rot13, which read bytes as bytes."""
    try:
        b"0".decode(encoding)
    except LookupError:
        return False
    except ValueError:  # half a letter of utf-16
        pass
    return True


def _column(section, key):
    """A column's name, or None."""
    name = section.text(key, right="a column's name")
    return name and one_blank(name)


def _time(top):
    s = top.section("time")
    if "time" not in top:
        top.wrong("time", "missing", "{column, format}: where the time of a row stands")
    columns = s.texts("column", "a column's name, or two: [date, time]", needed=bool(s))
    form = s.text("format", right=_formats())
    if form and "%" not in form and form != "iso" and form not in NUMBER_FORMATS:
        s.wrong("format", f"is {form}", _formats())
    elif form and (fault := _twice(form)):
        s.wrong("format", *fault)
    lines = s.numbers("clock_set_at", "lines of the log") or []
    first, last = (s.text(key, right="a stamp as in the log") for key in ("from", "to"))
    spread = s.one_of("same_stamp", ("first", "spread"), "first") == "spread"
    s.end()
    return TimeFormat(tuple(map(one_blank, columns)), form, frozenset(int(x) for x in lines), first, last, spread,
                      s.line_of("column"))


def _twice(form):
    """(what is wrong, what would be right) of a pattern that says a part of the time twice; None of others."""
    try:
        datetime.strptime("", form)
    except re.error:
        code, count = Counter(re.findall("%(.)", form)).most_common(1)[0]
        return (f"has %{code} twice" if count > 1 else f"is {form}, which says a part of the time twice",
                {"m": "%M is minutes", "M": "%m is the month"}.get(code, "each part of the time once"))
    except ValueError:  # "" is no such stamp
        pass
    return None


def _formats():
    return f"iso, one of {', '.join(NUMBER_FORMATS)}, or a pattern such as '%d.%m.%Y %H:%M:%S.%f'"


def _channels(top):
    section = top.section("channels")
    channels = {name: _channel(section, name) for name in CHANNELS if section.get(name) is not None}
    section.end()
    for name in DRIVES:
        if name not in section:
            section.wrong(name, "missing", f"name its column: motion.csv has {', '.join(DRIVES)}")
    _check_columns(section, channels)
    return channels


def _check_columns(section, channels):
    first = {}
    for name, channel in channels.items():
        other = first.setdefault(channel.column, name)
        if other != name and channel.column:
            section.wrong(name, f"has the column '{channel.column}', as {other}", "a column of its own")


def _channel(channels, name):
    kind, s = CHANNELS[name], channels.section(name)
    units = kind.units() + [PERCENT] + ([SWITCH] if name == "door" else [])
    column = s.text("column", "", "a column's name", needed=True)
    unit = s.one_of("unit", units, kind.unit, needed=True)
    sign = s.number("sign", 1.0, "1 or -1", allowed=lambda x: abs(x) == 1)
    scale = s.number("scale", 1.0, "a number other than 0", allowed=lambda x: x != 0)
    offset = s.number("offset", 0.0, f"a number in {unit}, added after sign and scale")
    low, per_unit = 0.0, UNITS.get(unit, ("", 1.0))[1]
    if unit in (PERCENT, SWITCH):
        ends = s.numbers("range", f"[a, b]: the {kind.unit} at {'0 and 100 %' if unit == PERCENT else '0 and 1'}",
                         needed=True)
        if ends and len(ends) == 2 and ends[0] != ends[1]:
            low, per_unit = ends[0], (ends[1] - ends[0]) / (100.0 if unit == PERCENT else 1.0)
        elif ends:
            s.wrong("range", f"is {', '.join(f'{x:g}' for x in ends)}", "two numbers that differ")
    elif s.get("range") is not None:
        s.wrong("range", f"with the unit {unit}", "only with % or switch")
    sigma, common = (s.number(key, default, f"a number in {unit}, 0 or more", allowed=lambda x: x >= 0)
                     for key, default in (("sigma", None), ("common_sigma", 0.0)))
    reads = s.one_of("reads", READS, needed=True) if name == TRUCK_MASS else None
    held = s.one_of("held", ("true", "false"), "true" if unit == SWITCH else "false") == "true"
    quality, time = _column(s, "quality"), _column(s, "time")
    s.end()
    return Channel(one_blank(column), unit, per_unit * sign * scale, low + per_unit * offset, unit == SWITCH, held,
                   quality, time, None if sigma is None else sigma * abs(per_unit),
                   common * abs(per_unit), reads, s.line, "scale" in s)


def _limits(top, path):
    s = top.section("limits")
    machine = s.text("machine", right="a machine's file, such as ../../mbs/bucyrus495.yaml")
    known, forces = _machine_limits(s, path.parent / machine) if machine else ({}, ({}, {}, None))
    out = {}
    for name in DRIVES:
        own = s.section(name)
        unit = CHANNELS[name].unit
        values = dict(known.get(name, {}))
        for key in ("min", "max"):
            values[key] = own.number(key, values.get(key), f"a number in {unit}")
        for key, per in (("speed", "s"), ("acceleration", "s^2")):
            values[key] = own.number(key, values.get(key), f"a number in {unit}/{per}, above 0",
                                     allowed=lambda x: x > 0)
        own.end()
        out[name] = Limits(**{k: v for k, v in values.items() if v is not None})
        if out[name].min >= out[name].max:
            own.wrong("min", f"is {out[name].min:g}", f"below max, {out[name].max:g}")
    s.end()
    return out, forces


def _machine_limits(section, file):
    """{drive: {min, max, speed}} of a machine's file, and (what its drives can pull and what its empty dipper takes,
    {force: kN}; the dipper's rated load, t), as far as it says so."""
    try:
        data = yaml.safe_load(file.read_text())
        limits = data["limits"]
    except (OSError, UnicodeDecodeError, yaml.YAMLError, KeyError, TypeError):
        section.wrong("machine", f"{file} cannot be read, or has no limits",
                      "a machine's file, seen from the map's folder")
        return {}, ({}, {}, None)
    out = {}
    for name in DRIVES:
        for key in ("min", "max", "speed"):
            entry = limits.get(f"{name}_{key}")
            if entry is None:
                continue
            unit = str(entry.get("unit", "")).removesuffix("/s") if isinstance(entry, dict) else ""
            value = number(str(entry.get("value"))) if unit in CHANNELS[name].units() else None
            if value is None:
                section.wrong("machine", f"{file}: limits.{name}_{key} is {entry}",
                              f"{{value, unit}} with a unit of {CHANNELS[name].quantity}")
                continue
            out.setdefault(name, {})[key] = value * UNITS[unit][1]
    dipper = data.get("dipper")
    return out, (_stall_forces(data.get("drives")), _empty_forces(dipper, data.get("door")),
                 _in_own_unit(_entry(dipper, "rated_load")))


def _stall_forces(drives):
    out = {}
    for name in FORCES:
        value = _in_own_unit(_entry(drives, name.replace("force", "stall")))
        if value is not None:
            out[name] = value
    return out


def _empty_forces(dipper, door):
    """The ropes carry the dipper and its door, and a part of the handle."""
    masses = [_in_own_unit(_entry(part, "mass")) for part in (dipper, door)]
    return {} if None in masses else {"hoist_force": G * sum(masses)}


def _entry(section, key):
    return section.get(key) if isinstance(section, dict) else None


def _in_own_unit(entry):
    """The value of {value, unit} in m, deg, kN or t; None where there is none."""
    value = number(str(entry.get("value"))) if isinstance(entry, dict) else None
    return None if value is None or entry.get("unit") not in UNITS else value * UNITS[entry["unit"]][1]


def _check_switches(made, found):
    for name, channel in made.channels.items():
        limits = made.limits.get(name)
        if channel.switch and not (math.isfinite(limits.speed) and math.isfinite(limits.acceleration)):
            found.add(made.path, channel.line, f"channels.{name}", "is a switch, and its speed is not given",
                      f"limits.{name}: {{speed, acceleration}}, in {CHANNELS[name].unit}/s and /s^2")


def _check_sigmas(made, found):
    for name, channel in made.channels.items():
        if CHANNELS[name].measured and channel.sigma is None:
            found.add(made.path, channel.line, f"channels.{name}.sigma", "missing",
                      "how much one reading errs, in the column's unit: for the measured folder (docs/gap.md)")
