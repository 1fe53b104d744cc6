"""What is legal in the forces of signals.csv and hardly ever meant."""
import numpy as np

from dipper_run.csv_text import stamp_text

from .suspect import falls, pushes, sentinels, stuck

MOST_KN = 20000.0  # strokes of mines made by another code go up to 13000
LEAST_KN = {"hoist_force_kN": 100.0, "crowd_force_kN": 50.0}  # the largest of all: less than an empty dipper takes


def force_warnings(time_s, signals):
    """Questions about forces, a line each."""
    return [f"{name}: {words}" for name in LEAST_KN if name in signals
            for words in _of_force(name, signals[name], time_s, signals)]


def _of_force(name, force, time_s, signals):
    largest = np.abs(force).max(initial=0.0)
    if largest < LEAST_KN[name]:
        yield f"{largest:.4g} kN at most, less than an empty dipper takes: is it in kN, and is the instrument on?"
    odd = np.union1d(np.flatnonzero(np.abs(force) > MOST_KN), sentinels(force))
    if len(odd):
        yield f"{_readings(odd, time_s)} such as {force[odd[0]]:g} kN: are these no readings, or in another unit?"
    elif name == "hoist_force_kN" and pushes(force):
        yield "its largest forces are negative, and a rope only pulls: is its sign right?"
    for low, rows, least in falls(force):
        yield (f"{_readings(rows, time_s)} of {low:g} kN between others of {least:.4g} kN and more: are these no "
               "readings?")
    if {"hoist_m", "crowd_m"} <= signals.keys() and (found := stuck(force, signals["hoist_m"], signals["crowd_m"])):
        a, b, count, way, _ = found
        yield (f"{force[a]:g} kN in all {count} readings from {stamp_text(time_s[a])} to {stamp_text(time_s[b])}, "
               f"while hoist and crowd move by {way:.3g} m: is the instrument stuck, or at the end of its range?")


def _readings(rows, time_s):
    return f"{len(rows)} reading{'s' if len(rows) > 1 else ''} from {stamp_text(time_s[rows[0]])}"
