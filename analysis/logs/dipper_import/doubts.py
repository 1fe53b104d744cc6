"""Readings that are legal and hardly ever meant: each is a line that begins with "warning: "."""
import numpy as np

from .phrases import some_rows
from .units import CHANNELS, FORCES, TRUCK_MASS

# Far beyond any shovel's, where the map names no machine.
LARGEST = {"hoist_force": 8000.0, "crowd_force": 8000.0, TRUCK_MASS: 700.0}  # kN, kN, t
BEYOND_STALL = 1.5         # times what a drive can pull: strokes of the rope, errors of the instrument
PASS_S = (5.0, 300.0)      # of one pass; 20 to 60 s are usual


def doubt(rows, spans, what, notes):
    for name in (*FORCES, TRUCK_MASS):
        if name in what.channels:
            _doubt_size(name, rows, what, notes)
    lengths = [b - a for a, b in spans]
    if lengths and not (PASS_S[0] <= np.median(lengths) <= PASS_S[1]):
        notes.append(f"warning: a pass takes {np.median(lengths):.4g} s, where 20 to 60 s are usual: is "
                     "time.format right?")


def _doubt_size(name, rows, what, notes):
    value, unit = rows.values[name], CHANNELS[name].unit
    most = BEYOND_STALL * what.stall_kN[name] if name in what.stall_kN else LARGEST[name]
    least = -most if name == "crowd_force" else -0.25 * most  # a rope cannot push, a load does not lift
    with np.errstate(invalid="ignore"):
        beyond = (value > most) | (value < least)
    if beyond.any():
        source = f"{BEYOND_STALL:g} times its stall force" if name in what.stall_kN else "more than any shovel's"
        notes.append(f"warning: {name}: {some_rows(rows.lines[beyond], 'reading')} beyond {least:.4g} to {most:.4g} "
                     f"{unit} ({source}); the first is {value[beyond][0]:.6g} {unit}: wrong unit, sign or scale, or "
                     "no reading (file.missing)?")
