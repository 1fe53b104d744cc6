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

from dipper_run.csv_text import stamp_text
from dipper_run.findings import Findings

from .channels import FACE, KNOWN, MASS, MOTION, RESPONSE, channels_in
from .face import LEAST_POINTS
from .face_warnings import face_warnings
from .force_warnings import force_warnings
from .mass_warnings import mass_warnings
from .number_table import read_table

PASS_COLUMNS = ("pass", "t_start_s", "t_end_s", MASS)
TRUCK = "truck"
PROFILE_COLUMNS = ("pass", "x_m", "z_m", "after", TRUCK)
FARTHEST_M = {"x_m": 200.0, "z_m": 100.0}  # of a face from the swing axis at ground level: beyond any shovel's
LEAST_SAMPLES = 10  # a pass with fewer readings cannot be cut into phases


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
    apart: dict = field(default_factory=dict)     # {(truck, pass, after): (x, m)}: heights at one x, farthest apart

    def seen_by(self, channels):
        """The same as a mine with these channels would have it: what it does not log is left out."""
        signals = {n: v for n, v in self.signals.items() if n in channels}
        faces = {} if FACE in channels else {"profiles": {}, "left": {}}
        return replace(self, channels={n: c for n, c in self.channels.items() if n in channels}, signals=signals,
                       time_s=self.time_s if signals else np.zeros(0), **faces)

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
        """What is legal in a folder's files and hardly ever meant, a line each."""
        return (*(f"{c.name}: sigma is 0: no instrument reads without an error of its own, and what it errs will be "
                  "taken for a gap" for c in self.channels.values() if c.role == RESPONSE and c.sigma == 0),
                *(f"{c.name}: role is response, but positions follow the measured motion in every run: not compared"
                  for c in self.channels.values() if c.role == RESPONSE and c.name in MOTION),
                *(mass_warnings(self.passes) if MASS in self.channels else ()),
                *([f"channels.yaml has no {MASS}, so the masses in passes.csv are not compared"]
                  if MASS not in self.channels and any(math.isfinite(p.truck_mass_t) for p in self.passes) else []),
                *force_warnings(self.time_s, self.signals), *face_warnings(self))

    def responses(self):
        """Names of the signals that answer to the rock, in a fixed order: forces."""
        return [n for n in KNOWN if n in self.signals and n not in MOTION]


def read_measured(folder, need_passes=1, simulated=False):
    """Reads a measured folder; throws BadInput with everything that is wrong with it.

    A run may end within a pass; of a `simulated` folder that pass is left out, in a mine's it is a fault.
    """
    folder = Path(folder)
    found = Findings()
    if not folder.is_dir():
        found.add(folder, 0, "folder", "not there", "name a folder with channels.yaml and passes.csv")
        found.raise_if_any()
    channels = channels_in(folder / "channels.yaml", found)
    zones = {}  # {(file, column of stamps): whether they have one}
    passes = _passes(folder / "passes.csv", channels, need_passes, zones, found)
    time_s, signals = _signals(folder / "signals.csv", channels, [] if simulated else passes, zones, found)
    _check_zones(zones, found)
    if not simulated and passes and all(p.truck_mass_t == 0 for p in passes):
        found.add(folder / "passes.csv", 0, MASS, "is 0 for every pass", "what each pass brought; of a shovel's own "
                  "monitor dipper import reads it with reads: dipper")
    if simulated and signals:
        passes = [p for p in passes if _readings(time_s, p) >= LEAST_SAMPLES]
    _optional_table(folder / "pile_angle.csv", ("pile", "angle_deg"), found)
    profiles, left, apart = _profiles(folder / "profile.csv", found)
    if FACE in channels and not profiles:
        found.add(folder / "profile.csv", 0, FACE, "declared in channels.yaml, but there are no faces",
                  "pass,x_m,z_m[,after][,truck]")
    found.raise_if_any()
    return Measured(channels, tuple(passes), time_s, signals, str(folder), profiles, left, apart)


def _passes(file, channels, need_passes, zones, found):
    if not file.is_file():
        found.add(file, 0, "file", "not there", ",".join(PASS_COLUMNS))
        return []
    need = PASS_COLUMNS if MASS in channels else PASS_COLUMNS[:3]
    table, lines, zoned = read_table(file, need, found, (*PASS_COLUMNS, TRUCK))
    zones.update({(file, name): zone for name, zone in zoned.items()})
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
            found.add(file, line, "t_end_s", f"is {stamp_text(end)}", f"after t_start_s, {stamp_text(start)}")
        if start < last_end:
            found.add(file, line, "t_start_s", f"is {stamp_text(start)}, before the last pass's end",
                      f"{stamp_text(last_end)} or later: passes must not overlap")
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


def _signals(file, channels, passes, zones, found):
    declared = [n for n in channels if n not in (MASS, FACE)]
    if not file.is_file():
        if declared:
            found.add(file, 0, "file", "not there, but channels.yaml declares " + ", ".join(declared),
                      "time_s," + ",".join(declared))
        return np.zeros(0), {}
    table, lines, zoned = read_table(file, ["time_s"] + declared, found, ("time_s", *declared),
                                     "declare it in channels.yaml, as one of " + ", ".join(KNOWN))
    zones.update({(file, name): zone for name, zone in zoned.items()})
    if len(set(zones.values())) > 1:
        passes = []  # hours apart: what that leads to is no fault of its own
    if "time_s" not in table or not lines:
        if "time_s" in table:
            found.add(file, 0, "file", "has no readings", "a row for each; without signals.csv, and without its "
                      "channels in channels.yaml, masses alone are compared")
        return np.zeros(0), {}
    for name in MOTION:
        if name not in declared:
            found.add(file, 0, name, "not declared in channels.yaml",
                      "the phases of a pass are found from hoist, crowd and swing")
    time = table["time_s"]
    back = np.flatnonzero(np.diff(time) <= 0)  # no time at all has been reported
    found.add_rows(file, [(lines[k + 1], "time_s", f"is {stamp_text(time[k + 1])} after {stamp_text(time[k])}",
                           "later times only")
                          for k in back])
    if passes and np.isfinite(time).all() and not any(_readings(time, p) for p in passes[1:] or passes):
        found.add(file, 0, "time_s", f"goes from {stamp_text(min(time))} to {stamp_text(max(time))}, and passes.csv "
                  f"from {stamp_text(passes[0].t_start_s)} to {stamp_text(passes[-1].t_end_s)}",
                  "seconds, or time stamps, of one clock in both files")
        passes = []
    for p in passes:
        inside = _readings(time, p)
        if inside < LEAST_SAMPLES:
            found.add(file, 0, "time_s", f"{inside} readings within pass {p.number} "
                      f"({stamp_text(p.t_start_s)} to {stamp_text(p.t_end_s)})", f"{LEAST_SAMPLES} or more")
    return time, {n: table[n] for n in declared if n in table}


def _check_zones(zones, found):
    """Stamps without a zone count as UTC: beside others with one they may be hours off."""
    with_zone, without = ([key for key, zone in zones.items() if zone == has] for has in (True, False))
    if with_zone and without:
        (file, column), (other, name) = without[0], with_zone[0]
        found.add(file, 0, column, f"has stamps without a zone, and {name} of {other.name} has stamps with one",
                  "a zone, such as Z or +02:00, in all or in none")


def _readings(time, p):
    return int(np.sum((time >= p.t_start_s) & (time <= p.t_end_s)))


def _profiles(file, found):
    """profiles, left and apart of Measured, of a profile.csv; {} where there is none. Of heights at one x the mean."""
    out, left, apart = {}, {}, {}
    if not file.is_file():
        return out, left, apart
    table, lines, _ = read_table(file, ("pass", "x_m", "z_m"), found, PROFILE_COLUMNS)
    if not lines or any(name not in table for name in ("pass", "x_m", "z_m")):
        return out, left, apart
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
        if not len(at):
            continue  # no numbers, which the table has reported
        x, column = np.unique(table["x_m"][at], return_inverse=True)
        if len(x) < LEAST_POINTS:
            found.add(file, lines[at[0]], "x_m", f"{len(x)} points of pass {key[1]:g}", f"{LEAST_POINTS} or more")
        truck, number = (int(k) if np.isfinite(k) else 0 for k in key)
        z, height = np.bincount(column, table["z_m"][at]) / np.bincount(column), _heights(column, table["z_m"][at])
        (left if is_after else out)[truck, number] = x, z
        if height.any():
            apart[truck, number, int(is_after == 1)] = float(x[height.argmax()]), float(height.max())
    return out, left, apart


def _heights(column, z):
    """From the lowest z of each column to its highest."""
    low, high = np.full((2, column.max() + 1), [[np.inf], [-np.inf]])
    np.minimum.at(low, column, z)
    np.maximum.at(high, column, z)
    return high - low


def _optional_table(file, columns, found):
    if file.is_file():
        read_table(file, columns, found, columns)


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
                f.write(",".join([f"{t:.6f}".removesuffix("000")] + [f"{v[k]:.4f}" for v in m.signals.values()]) + "\n")
