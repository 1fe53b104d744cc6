"""A measured folder: what a mine's logger and truck scale say, or what a simulation would have shown them.

    channels.yaml  NAME: {unit, role: driven|response, sigma, common_sigma[, drift_sigma]}   for each channel used
    passes.csv     pass,t_start_s,t_end_s,truck_mass_t, and truck where the same passes were dug for several
    signals.csv    time_s and one column for each signal (optional: then only the masses are compared)

`sigma` is the standard deviation of one reading, `common_sigma` that of an error all readings share, and
`drift_sigma` that of what the shared error may have changed by since an earlier folder of the same instrument.
"""
import math
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from dipper_run.csv_text import (SEPARATOR, cells_of, decimal_number, find_decimal, find_delimiter, lines_of,
                                 parted_by, read_stamp, stamp_seconds)
from dipper_run.findings import Findings
from dipper_run.section import Section
from dipper_run.text_file import read_text, read_yaml

from .mass_warnings import mass_warnings
from .face import LEAST_POINTS

DRIVEN = "driven"
RESPONSE = "response"
CHANNEL_KEYS = "{unit, role, sigma, common_sigma}"
ASSUMED = Path(__file__).with_name("assumed_channels.yaml")
MOST_DRIFT = 1.415  # of common_sigma: two errors of that size differ by no more


@dataclass(frozen=True)
class Kind:
    """What a channel of this name must be: its unit, and a size no sound reading passes."""

    unit: str
    largest: float
    hint: str


# The largest values are far beyond any shovel's: they catch a wrong unit, not a strange pass.
KNOWN = {
    "truck_mass_t": Kind("t", 1000.0, "kg, perhaps? 1 t = 1000 kg"),
    "face_m": Kind("m", 1000.0, "mm, perhaps?"),
    "hoist_m": Kind("m", 100.0, "mm, perhaps?"),
    "crowd_m": Kind("m", 50.0, "mm, perhaps?"),
    "swing_rad": Kind("rad", 10.0, "degrees, perhaps? 1 rad = 57.3 deg"),
    "hoist_force_kN": Kind("kN", 1e5, "N, perhaps? 1 kN = 1000 N"),
    "crowd_force_kN": Kind("kN", 1e5, "N, perhaps? 1 kN = 1000 N"),
}
MASS = "truck_mass_t"
FACE = "face_m"  # heights of profile.csv
MOTION = ("hoist_m", "crowd_m", "swing_rad")
PASS_COLUMNS = ("pass", "t_start_s", "t_end_s", MASS)
TRUCK = "truck"
TIMES = ("time_s", "t_start_s", "t_end_s")
LONGEST_SHOWN = 40  # characters of a cell that is no number
FARTHEST_M = {"x_m": 200.0, "z_m": 100.0}  # of a face from the swing axis at ground level: beyond any shovel's
LEAST_SAMPLES = 10  # a pass with fewer readings cannot be cut into phases


@dataclass(frozen=True)
class Channel:
    name: str
    unit: str
    role: str
    sigma: float
    common_sigma: float
    drift_sigma: float = None  # None: not given


@dataclass(frozen=True)
class Pass:
    number: int
    t_start_s: float
    t_end_s: float
    truck_mass_t: float
    truck: int = 1


@dataclass(frozen=True)
class Measured:
    """`signals` holds one array a channel, as long as `time_s`; both are empty without signals.csv."""

    channels: dict
    passes: tuple
    time_s: np.ndarray
    signals: dict
    folder: str = ""
    profiles: dict = field(default_factory=dict)  # {(truck, pass): (x, z)}, x rising: the face before that pass
    left: dict = field(default_factory=dict)      # likewise what that pass left in the same plane, where it is given

    def seen_by(self, channels):
        """The same as a mine with these channels would have it: what it does not log is left out."""
        signals = {n: v for n, v in self.signals.items() if n in channels}
        return replace(self, channels={n: c for n, c in self.channels.items() if n in channels}, signals=signals,
                       time_s=self.time_s if signals else np.zeros(0))

    def trucks(self):
        """The passes of each truck, and the readings about them, as a folder of their own, in order."""
        numbers = dict.fromkeys(p.truck for p in self.passes)
        return [self._of(tuple(p for p in self.passes if p.truck == n)) for n in numbers]

    def _of(self, passes):
        first = max(0, np.searchsorted(self.time_s, passes[0].t_start_s) - 1)  # one reading before and after
        span = slice(first, np.searchsorted(self.time_s, passes[-1].t_end_s, side="right") + 1)
        signals = {n: v[span] for n, v in self.signals.items()}
        return replace(self, passes=passes, time_s=self.time_s[span], signals=signals)

    def questions(self):
        """What is legal in channels.yaml and passes.csv and hardly ever meant, a line each."""
        return (*(f"{c.name}: sigma is 0: no instrument reads without an error of its own, and what it errs will be "
                  "taken for a gap" for c in self.channels.values() if c.role == RESPONSE and c.sigma == 0),
                *(mass_warnings(self.passes) if MASS in self.channels else ()))

    def responses(self):
        """Names of the signals that answer to the rock, in a fixed order."""
        return [n for n in KNOWN if n in self.signals and self.channels[n].role == RESPONSE]


def read_measured(folder, need_passes=1, simulated=False):
    """Reads a measured folder; throws BadInput with everything that is wrong with it.

    A run may end within a pass; of a `simulated` folder that pass is left out, in a mine's it is a fault.
    """
    folder = Path(folder)
    found = Findings()
    if not folder.is_dir():
        found.add(folder, 0, "folder", "not there", "name a folder with channels.yaml and passes.csv")
        found.raise_if_any()
    channels = _channels(folder / "channels.yaml", found)
    passes = _passes(folder / "passes.csv", channels, need_passes, found)
    time_s, signals = _signals(folder / "signals.csv", channels, [] if simulated else passes, found)
    if not simulated and passes and all(p.truck_mass_t == 0 for p in passes):
        found.add(folder / "passes.csv", 0, MASS, "is 0 for every pass", "what each pass brought; of a shovel's own "
                  "monitor dipper import reads it with reads: dipper")
    if simulated and signals:
        passes = [p for p in passes if _readings(time_s, p) >= LEAST_SAMPLES]
    _optional_table(folder / "pile_angle.csv", ("pile", "angle_deg"), found)
    profiles, left = read_profiles(folder / "profile.csv", found)
    if FACE in channels and not profiles:
        found.add(folder / "profile.csv", 0, FACE, "declared in channels.yaml, but there are no faces",
                  "pass,x_m,z_m[,after][,truck]")
    found.raise_if_any()
    return Measured(channels, tuple(passes), time_s, signals, str(folder), profiles, left)


def read_channels(file=ASSUMED):
    """{name: Channel} of a channels.yaml; throws BadInput. Without a file, of instruments as a mine may have them."""
    found = Findings()
    channels = _channels(Path(file), found)
    found.raise_if_any()
    return channels


def _channels(file, found):
    if not file.is_file():
        found.add(file, 0, "file", "not there",
                  f"list each channel as NAME: {CHANNEL_KEYS}")
        return {}
    section = Section(read_yaml(file, found, f"a map of channels, NAME: {CHANNEL_KEYS}"), file, found)
    channels = {name: _channel(section, name) for name in KNOWN if name in section}
    for name in section.keys():
        if name not in KNOWN:
            section.wrong(name, "unknown channel", "one of " + ", ".join(KNOWN))
    return {name: channels[name] for name in section.keys() if channels.get(name)}


def _channel(channels, name):
    """The Channel of a name; None where it is no map."""
    section, unit = channels.section(name, CHANNEL_KEYS), KNOWN[name].unit
    if not section:
        return None
    right = f"{unit}, in the values too"
    if (read_unit := section.text("unit", unit, right, needed=True)) != unit:
        section.wrong("unit", f"is {read_unit}", right)
    role = section.one_of("role", (DRIVEN, RESPONSE) if name in MOTION else (RESPONSE,), needed=True)
    sigma, common = (section.number(key, 0.0, f"a number in {unit}, 0 or more", needed=True, allowed=lambda x: x >= 0)
                     for key in ("sigma", "common_sigma"))
    drift = section.number("drift_sigma", None, f"a number in {unit}, 0 to {MOST_DRIFT - 0.005:g} times common_sigma",
                           allowed=lambda x: 0 <= x <= MOST_DRIFT * common)
    section.end()
    return Channel(name, unit, role, sigma, common, drift)


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


def read_table(file, need, found, allowed=None):
    """Columns of numbers by name, and the line of each row; unreadable cells are findings.

    Columns parted by semicolons or tabs may have decimal commas. A column of TIMES may hold ISO 8601 stamps: they
    become seconds since 1970.
    """
    header_line, header, rows, delimiter = _rows(file, found)
    if not header:
        return {}, []
    for name in need:
        if name not in header:
            found.add(file, header_line, name, "column missing", "header: " + ",".join(need))
    twice = sorted({name for name in header if header.count(name) > 1})
    for name in twice:
        found.add(file, header_line, name, "column given twice", "keep one")
    if twice:
        return {}, []
    for name in header:
        if allowed is not None and name not in allowed:
            found.add(file, header_line, name, "unknown channel",
                      "declare it in channels.yaml, as one of " + ", ".join(KNOWN))
    faults = [(line, "row", f"{len(row)} values", _right_number(len(row), len(header), delimiter))
              for line, row in rows if len(row) != len(header)]
    lines = [line for line, _ in rows]
    rows = [(row + [""] * len(header))[:len(header)] for _, row in rows]
    decimal, doubtful = find_decimal(cell for row in rows for cell in row)
    if doubtful and decimal == ",":
        line, name = next((i, n) for i, row in zip(lines, rows) for n, cell in zip(header, row) if cell == doubtful)
        faults.append((line, name, f"is '{doubtful}', and every comma in the file has three digits after it: it may "
                       "part thousands", "write decimals with a point, and nothing between thousands"))
    values = {}
    for name, cells in zip(header, zip(*rows) if rows else [()] * len(header)):
        read = _stamps if name in TIMES and cells and read_stamp(cells[0]) else _numbers
        values[name] = read(name, cells, lines, decimal, faults)
    broken = {line for line, what, _, _ in faults if what == "row"}  # what stands in their cells means nothing
    faults = [f for f in faults if f[1] == "row" or f[0] not in broken]
    found.add_rows(file, faults)
    return values, lines


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


def _passes(file, channels, need_passes, found):
    if not file.is_file():
        found.add(file, 0, "file", "not there", ",".join(PASS_COLUMNS))
        return []
    need = PASS_COLUMNS if MASS in channels else PASS_COLUMNS[:3]
    table, lines = read_table(file, need, found)
    if not all(name in table for name in need):
        return []
    masses = table.get(MASS, np.full(len(lines), math.nan))
    trucks = table.get(TRUCK, np.ones(len(lines)))
    passes, last_end, last_number, last_truck = [], -math.inf, 0, 0
    for line, truck, index, start, end, mass in zip(lines, trucks, table["pass"], table["t_start_s"],
                                                    table["t_end_s"], masses):
        if truck != last_truck:
            last_number = 0
        if not (math.isfinite(index) and math.isfinite(truck)):
            continue  # the table has reported it
        if not (truck == int(truck) and truck >= max(1, last_truck)):
            found.add(file, line, TRUCK, f"is {truck:g}", "rising whole numbers from 1, a new one for each load")
        if index != int(index) or index <= last_number:
            found.add(file, line, "pass", f"is {index:g}", "whole numbers that rise, from 1"
                      + ("" if TRUCK in table else f"; a column {TRUCK} tells loads apart"))
        if not end > start:
            found.add(file, line, "t_end_s", f"is {end:g}", f"after t_start_s, {start:g}")
        if start < last_end:
            found.add(file, line, "t_start_s", f"is {start:g}, before the last pass's end",
                      f"{last_end:g} or later: passes must not overlap")
        if mass < 0:
            found.add(file, line, MASS, f"is {mass:g}", "0 or more")
        passes.append(Pass(int(index), float(start), float(end), float(mass), int(truck)))
        last_end, last_number, last_truck = end, index, truck
    first = [p.number for p in passes if p.truck == passes[0].truck]
    for truck in dict.fromkeys(p.truck for p in passes):
        numbers = [p.number for p in passes if p.truck == truck]
        if numbers != first:
            found.add(file, 0, f"truck {truck}", f"has passes {_list(numbers)}",
                      f"{_list(first)}, as truck {passes[0].truck}; leave out a truck loaded otherwise")
    if len(first) < need_passes:
        found.add(file, 0, "passes", f"{len(first)} found", f"{need_passes} or more are needed")
    return passes


def _list(numbers):
    return ", ".join(map(str, numbers))


def _signals(file, channels, passes, found):
    declared = [n for n in channels if n not in (MASS, FACE)]
    if not file.is_file():
        if declared:
            found.add(file, 0, "file", "not there, but channels.yaml declares " + ", ".join(declared),
                      "time_s," + ",".join(declared))
        return np.zeros(0), {}
    table, lines = read_table(file, ["time_s"] + declared, found, {"time_s"} | set(declared))
    if "time_s" not in table or not lines:
        return np.zeros(0), {}
    for name in MOTION:
        if name not in declared:
            found.add(file, 0, name, "not declared in channels.yaml",
                      "the phases of a pass are found from hoist, crowd and swing")
    time = table["time_s"]
    back = np.flatnonzero(np.diff(time) <= 0)  # no time at all has been reported
    found.add_rows(file, [(lines[k + 1], "time_s", f"is {time[k + 1]:g} after {time[k]:g}", "later times only")
                          for k in back])
    if passes and np.isfinite(time).all() and not any(_readings(time, p) for p in passes[1:] or passes):
        found.add(file, 0, "time_s", f"goes from {min(time):.10g} to {max(time):.10g} s, and passes.csv from "
                  f"{passes[0].t_start_s:.10g} to {passes[-1].t_end_s:.10g} s",
                  "seconds, or time stamps, of one clock in both files")
        passes = []
    for p in passes:
        inside = _readings(time, p)
        if inside < LEAST_SAMPLES:
            found.add(file, 0, "time_s", f"{inside} readings within pass {p.number} "
                      f"({p.t_start_s:g} to {p.t_end_s:g} s)", f"{LEAST_SAMPLES} or more")
    return time, {n: table[n] for n in declared if n in table}


def _readings(time, p):
    return int(np.sum((time >= p.t_start_s) & (time <= p.t_end_s)))


def read_profiles(file, found):
    """{(truck, pass): (x, z)} of the faces before passes, and of what passes left, of a profile.csv; each with x
    rising; {} where there is none."""
    out, left = {}, {}
    if not file.is_file():
        return out, left
    table, lines = read_table(file, ("pass", "x_m", "z_m"), found)
    if not lines or any(name not in table for name in ("pass", "x_m", "z_m")):
        return out, left
    found.add_rows(file, [(line, name, f"is {value:g}", f"within {most:g} m of the swing axis at ground level: in the "
                           "mine's coordinates, or in mm, perhaps?")
                          for name, most in FARTHEST_M.items() for line, value in zip(lines, table[name])
                          if abs(value) > most])
    trucks, after = table.get(TRUCK, np.ones(len(lines))), table.get("after", np.zeros(len(lines)))
    for line, is_after in zip(lines, after):
        if is_after not in (0, 1) and np.isfinite(is_after):
            found.add(file, line, "after", f"is {is_after:g}", "0: the face before the pass, 1: after it")
    for line, truck, number in zip(lines, trucks, table["pass"]):
        if np.isfinite(truck + number) and not (truck == int(truck) >= 1 and number == int(number) >= 1):
            found.add(file, line, "pass", f"is {number:g} of truck {truck:g}", "whole numbers from 1")
    for *key, is_after in dict.fromkeys(zip(trucks.tolist(), table["pass"].tolist(), after.tolist())):
        at = np.flatnonzero((trucks == key[0]) & (table["pass"] == key[1]) & (after == is_after))
        x, first = np.unique(table["x_m"][at], return_index=True)
        if len(at) and len(x) < LEAST_POINTS:
            found.add(file, lines[at[0]], "x_m", f"{len(x)} points of pass {key[1]:g}", f"{LEAST_POINTS} or more")
        (left if is_after else out)[tuple(int(k) if np.isfinite(k) else 0 for k in key)] = (x, table["z_m"][at][first])
    return out, left


def _optional_table(file, columns, found):
    if file.is_file():
        read_table(file, columns, found)


def write_measured(m, folder):
    """Writes `m` as a measured folder (tests, stored truths)."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "channels.yaml", "w") as f:
        for c in m.channels.values():
            drift = "" if c.drift_sigma is None else f", drift_sigma: {c.drift_sigma:g}"
            f.write(f"{c.name}: {{unit: {c.unit}, role: {c.role}, sigma: {c.sigma:g}, "
                    f"common_sigma: {c.common_sigma:g}{drift}}}\n")
    weighed = MASS in m.channels
    with open(folder / "passes.csv", "w") as f:
        f.write(",".join((PASS_COLUMNS if weighed else PASS_COLUMNS[:3]) + (TRUCK,)) + "\n")
        for p in m.passes:
            mass = f",{p.truck_mass_t:.3f}" if weighed else ""
            f.write(f"{p.number},{p.t_start_s:.3f},{p.t_end_s:.3f}{mass},{p.truck}\n")
    if m.profiles:
        with open(folder / "profile.csv", "w") as f:
            f.write("pass,x_m,z_m,after,truck\n")
            for after, faces in enumerate((m.profiles, m.left)):
                for (truck, number), (xs, zs) in faces.items():
                    f.writelines(f"{number},{x:.3f},{z:.3f},{after},{truck}\n" for x, z in zip(xs, zs))
    if m.signals:
        with open(folder / "signals.csv", "w") as f:
            f.write(",".join(["time_s"] + list(m.signals)) + "\n")
            for k, t in enumerate(m.time_s):
                f.write(",".join([f"{t:.3f}"] + [f"{v[k]:.4f}" for v in m.signals.values()]) + "\n")
