"""From the rows of a log to what is written: the motion, and what a mine's instruments have measured of it."""
from dataclasses import dataclass

import numpy as np

from dipper_gap.readings.channels import DRIVEN, KNOWN, MASS, MOTION, RESPONSE, Channel
from dipper_gap.readings.measured import LEAST_SAMPLES, Measured, Pass
from dipper_gap.readings.phases import planned_passes

from .warn import warn_of_readings, warn_of_masses
from .warn_drives import warn_of_drives
from .fit import fit_drive
from .masses import truck_masses
from .phrases import some_rows
from .readings import held_readings, row_gaps, sound_readings
from .units import CHANNELS, DRIVES, FORCES, TRUCK_MASS


@dataclass(frozen=True)
class Imported:
    rows: object        # clock.Rows
    readings: dict      # {drive: readings.Readings}
    fits: dict          # {drive: fit.Fit}
    grid: np.ndarray    # s, the rows of motion.csv
    gaps: list          # (start, end) without rows
    spans: tuple        # (start, end) in s of the passes that end with a dump
    measured: object    # dipper_gap.readings.measured.Measured, or None


def build(rows, what, path, found, notes):
    """None after a finding."""
    gaps = row_gaps(rows, what, path, found, notes)
    rows = held_readings(rows, what, notes)
    readings = {name: sound_readings(rows, name, what.channels[name], what.limits[name], what, path, found, notes)
                for name in DRIVES}
    if found.all:
        return None
    end = rows.time_s[-1]
    if end < 2 * what.sample_s:
        found.add(path, int(rows.lines[0]), "time", f"{end:g} s of log", "more than two of sample_s")
        return None
    grid = what.sample_s * np.arange(int(np.floor(end / what.sample_s + 1e-9)) + 1)
    fits = {}
    for name in DRIVES:
        try:
            fits[name] = fit_drive(readings[name], grid, what.limits[name], what.channels[name].switch)
        except ValueError as e:
            found.add(what.path, what.channels[name].line, f"channels.{name}", str(e), "limits that the log can keep")
    if found.all:
        return None
    spans = planned_passes(grid, np.radians(fits["door"].value))
    if not spans:
        notes.append("no pass: the door never opens")
    elif spans[0][0] > grid[0]:
        notes.append(f"warning: the log begins with the door open: what it dumps until {spans[0][0]:.4g} s "
                     "belongs to no pass")
    warn_of_drives(readings, fits, grid, spans, what, notes)
    warn_of_readings(rows, spans, what, notes)
    measured = _measured(rows, readings, fits, grid, spans, what, path, found, notes) if what.measured() else None
    return None if found.all else Imported(rows, readings, fits, grid, gaps, spans, measured)


def motion_text(made, what, source):
    """motion.csv (docs/motion.md)."""
    lines = [f"# Made of {source} by dipper import, with {what.path.name}.",
             "time_s,hoist_m,crowd_m,swing_deg,door_deg"]
    columns = [made.fits[name].value for name in DRIVES]
    for k, t in enumerate(made.grid):
        lines.append(f"{t:.9f}".rstrip("0").rstrip(".") + "," + ",".join(f"{c[k] + 0.0:.6f}" for c in columns))
    return "\n".join(lines) + "\n"


def _measured(rows, readings, fits, grid, spans, what, path, found, notes):
    """The log's own readings, not the curves; rows in which a channel has no sound one are left out."""
    names = [n for n in CHANNELS if CHANNELS[n].measured and n in what.channels and n != TRUCK_MASS]
    whole = np.all([readings[n].kept if n in readings else np.isfinite(rows.values[n]) for n in names], axis=0)
    if (~whole).any():
        notes.append(f"signals.csv: {some_rows(rows.lines[~whole])} in which a channel has no reading, left out")
    if not spans:
        found.add(path, 0, "passes", "none ends with a dump",
                  "a door that opens, or no forces and masses in the map")
        return None
    signals = {CHANNELS[n].measured: rows.values[n][whole] * CHANNELS[n].factor for n in names}
    _check_sizes(signals, rows.lines[whole], what, path, found)
    _check_readings(rows, whole, spans, path, found)
    masses = [np.nan] * len(spans)
    if TRUCK_MASS in what.channels:
        masses = truck_masses(rows, fits, grid, spans, what, path, found, notes)
        warn_of_masses(masses, what, notes)
    channels = {}
    for n in (*names, *([TRUCK_MASS] if TRUCK_MASS in what.channels else [])):
        kind, channel = CHANNELS[n], what.channels[n]
        channels[kind.measured] = Channel(kind.measured, kind.measured.rsplit("_", 1)[1],
                                          DRIVEN if kind.measured in MOTION else RESPONSE,
                                          channel.sigma * kind.factor, channel.common_sigma * kind.factor)
    if not any(n in channels for n in (MASS, *(CHANNELS[f].measured for f in FORCES))):
        return None
    passes = tuple(Pass(k + 1, a, b, m) for k, ((a, b), m) in enumerate(zip(spans, masses)))
    return Measured(channels, passes, rows.time_s[whole], signals)


def _check_sizes(signals, lines, what, path, found):
    """Findings about readings that no measured folder may have (dipper_gap)."""
    for name, column in ((what.channels[n].column, n) for n in what.channels):
        kind = KNOWN.get(CHANNELS[column].measured)
        values = signals.get(CHANNELS[column].measured, np.zeros(0))
        found.add_rows(path, [(int(lines[k]), name, f"{column} is {values[k]:g} {kind.unit}",
                               f"{kind.largest:g} {kind.unit} at most: another unit, or a text of file.missing")
                              for k in np.flatnonzero(np.abs(values) > kind.largest)] if kind else [])


def _check_readings(rows, whole, spans, path, found):
    """Finding about the first pass with too few readings to be cut into phases."""
    for number, (start, end) in enumerate(spans, 1):
        inside = (rows.time_s >= start) & (rows.time_s <= end)
        if (whole & inside).sum() < LEAST_SAMPLES:
            found.add(path, int(rows.lines[np.argmax(inside)]), "time",
                      f"{(whole & inside).sum()} rows with a reading of every channel within pass {number} "
                      f"({start:.4g} to {end:.4g} s)",
                      f"{LEAST_SAMPLES} or more: rows more often; held: true for channels that are "
                      "written only as they change; or a map of their own for times of their own (channels.NAME.time)")
            return
