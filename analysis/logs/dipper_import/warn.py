"""Input that is valid but probably a mistake: a line each that begins with "warning: "."""
import numpy as np

from .phrases import some_rows
from .units import CHANNELS, FORCES, TRUCK_MASS

# Far beyond any shovel's, where the map names no machine.
LARGEST = {"hoist_force": 8000.0, "crowd_force": 8000.0, TRUCK_MASS: 700.0}  # kN, kN, t
BEYOND_STALL = 1.5         # times what a drive can pull: strokes of the rope, errors of the instrument
PASS_S = (5.0, 300.0)      # of one pass; 20 to 60 s are usual
LEAST_LOAD_T = 2.0         # the fullest of all passes: less than a boulder
BEYOND_RATED = 1.3         # times the dipper's rated load: more than a heaped dipper's
MOSTLY_EMPTY = 0.5         # of the rows without a reading
LEAST_OF_STALL = 0.02      # of what a drive can pull: an empty dipper's weight alone is more
FEW = 3                    # readings
DROP = 0.2                 # of the usual force: a fall to next to nothing and back from more is no load's
SMALL = 0.02               # of the usual force: next to nothing
STUCK_ROWS = 10            # one force for as many readings,
STUCK_M = 5.0              # while rope and handle move by as much: no load does that


def warn_of_readings(rows, spans, what, notes):
    for name in (*FORCES, TRUCK_MASS):
        if name not in what.channels:
            continue
        _warn_of_size(name, rows, what, notes)
        if name in FORCES:
            _warn_of_empty(name, rows, notes)
            _warn_of_falls(name, rows, notes)
            if not what.channels[name].held:
                _warn_of_stuck(name, rows, notes)
    lengths = [b - a for a, b in spans]
    if lengths and not (PASS_S[0] <= np.median(lengths) <= PASS_S[1]):
        notes.append(f"warning: a pass takes {np.median(lengths):.4g} s, where 20 to 60 s are usual: is "
                     "time.format right?")


def warn_of_masses(masses, what, notes):
    """Of what the passes bring, t."""
    most = max(masses, default=0.0)
    if 0 < most < LEAST_LOAD_T:
        notes.append(f"warning: truck_mass: the fullest pass brings {most:.3g} t: wrong unit or scale?")
    if what.rated_load_t and most > BEYOND_RATED * what.rated_load_t:
        notes.append(f"warning: truck_mass: pass {masses.index(most) + 1} brings {most:.4g} t, more than "
                     f"{BEYOND_RATED:g} times the {what.rated_load_t:.4g} t that the machine's dipper is rated for: "
                     "wrong unit or scale?")


def _warn_of_empty(name, rows, notes):
    empty = ~np.isfinite(rows.values[name])
    if empty.mean() > MOSTLY_EMPTY:
        notes.append(f"warning: {name}: {int(empty.sum())} of {len(empty)} rows have no reading: "
                     f"channels.{name}.held: true, if it is written only as it changes")


def _warn_of_size(name, rows, what, notes):
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
    largest = np.nanmax(np.abs(value), initial=0.0, where=np.isfinite(value))
    if name in FORCES and 0 < largest < LEAST_OF_STALL * most / BEYOND_STALL:
        notes.append(f"warning: {name}: no reading is beyond {largest:.4g} {unit}, less than an empty dipper takes: "
                     "wrong unit, scale or mark of decimals?")


def _warn_of_falls(name, rows, notes):
    """Of a force that falls to 0, -1 or another small number, always the same, between readings of large forces: what
    loggers write while an instrument is away."""
    value = rows.values[name]
    there = np.flatnonzero(np.isfinite(value))
    usual = np.percentile(np.abs(value[there][value[there] != 0]), 95) if value[there].any() else 0.0
    lows, numbers = np.unique(value[there][np.abs(value[there]) <= SMALL * usual], return_counts=True)
    for low in lows[numbers >= FEW]:
        fallen, least = _falls(value, there, low, usual)
        if len(fallen) >= FEW:
            unit = CHANNELS[name].unit
            listed = "" if low == 0 else ", list the number under file.missing"
            notes.append(f"warning: {name}: {some_rows(rows.lines[fallen], 'reading')} of {low:.6g} {unit} between "
                         f"others of {least:.4g} {unit} and more: no readings? Leave such cells empty{listed}, or "
                         f"name the column that says which readings are good (channels.{name}.quality)")


def _warn_of_stuck(name, rows, notes):
    """Of a force other than 0 that does not change by a digit while rope and handle move: an instrument that is stuck,
    or at the end of its range."""
    there = np.flatnonzero(np.isfinite(rows.values[name]) & (rows.values[name] != 0))
    if not len(there):
        return
    value = rows.values[name][there]
    moved = sum(_way(rows.values[drive])[there] for drive in ("hoist", "crowd"))
    first = np.flatnonzero(np.diff(value, prepend=np.nan) != 0)
    last = np.append(first[1:], len(value)) - 1
    stuck = (last - first + 1 >= STUCK_ROWS) & (moved[last] - moved[first] >= STUCK_M)
    if stuck.any():
        longest = np.flatnonzero(stuck)[np.argmax((last - first)[stuck])]
        a, b = first[longest], last[longest]
        times = f"; {stuck.sum()} times, this one the longest" if stuck.sum() > 1 else ""
        notes.append(f"warning: {name}: {value[a]:.6g} {CHANNELS[name].unit} in all {b - a + 1} rows from line "
                     f"{rows.lines[there[a]]} to {rows.lines[there[b]]}, while hoist and crowd move by "
                     f"{moved[b] - moved[a]:.3g} m{times}: is the instrument stuck, or at the end of its range? Leave "
                     "such cells empty, or name the column that says which readings are good "
                     f"(channels.{name}.quality)")


def _way(position):
    """Length of the way up to each row; empty cells are passed over."""
    there = np.flatnonzero(np.isfinite(position))
    steps = np.abs(np.diff(position[there], prepend=position[there[:1]]))
    return np.interp(np.arange(len(position)), there, np.cumsum(steps)) if len(there) else np.zeros(len(position))


def _falls(value, there, low, usual):
    """Rows in which a value is `low` between others of more than DROP of the usual, and the least of these. A force
    that changes its sign from one row to the next may pass by any small number."""
    lows, others = there[value[there] == low], there[value[there] != low]
    if len(others) < FEW:
        return [], None
    at = np.searchsorted(others, lows)
    between = (at > 0) & (at < len(others))
    at = np.clip(at, 1, len(others) - 1)
    before, after = value[others[at - 1]], value[others[at]]
    beside = np.minimum(np.abs(before), np.abs(after))
    fallen = between & (beside > DROP * usual) & ((before * after > 0) | (low == 0))
    return lows[fallen], beside[fallen].min(initial=np.inf)
