"""Drives that a map reads the wrong way, and readings no drive can make: a line each that begins with "warning: "."""
import numpy as np

from dipper_gap.readings.suspect import stretches

from .fit import off
from .phrases import leave_out, longest_of
from .readings import FASTEST
from .units import CHANNELS, PERCENT, SWITCH, UNITS

DOOR_DEG = 5.0       # a door whose largest angle is less is never seen to open
OPEN = 0.5           # of its largest angle, and of the log: a door is shut while the dipper digs and swings
FEW = 3              # readings
JUMP = 1.2           # times what a drive can do from one reading to the next, for a clock that errs,
NOISE = 6            # and times the readings' scatter
FAR_OFF = {"hoist": 0.3, "crowd": 0.3, "swing": 3.0}   # m, m, deg, of a reading off its curve,
ALL_OFF = 1 / 3      # of that, as the root mean square of all: no curve of these readings
TIMES_RMS = 10       # and so many times the root mean square of what all are off
SELDOM = 0.1         # of the steps: a drive that jumps more often is logged in steps
LITTLE = 0.02        # of a drive's range: passes take most of it
WITHIN = 0.2         # of the crowd's stroke: as much farther out than in the other passes, a log begins in a dig
USUAL_RANGE = {"hoist": 12.0, "crowd": 5.0, "swing": 180.0}  # m, m, deg, of a drive without limits


def warn_of_drives(readings, fits, grid, spans, what, notes):
    _warn_of_door(fits["door"].value, what.channels["door"], notes)
    if what.channels["door"].switch:
        _warn_of_throws(readings["door"].value, spans, notes)
    for name in USUAL_RANGE:
        said = len(notes)
        _warn_of_jumps(name, readings[name], what, notes)
        if len(notes) == said:
            _warn_of_far_off(name, readings[name], fits[name].change, what.channels[name], notes)
        if len(notes) == said:
            _warn_of_all_far_off(name, readings[name], fits[name], notes)
        if spans:
            _warn_of_little(name, readings[name].value, what, notes)
    _warn_of_start(fits["crowd"].value, grid, spans, notes)


def _warn_of_throws(value, spans, notes):
    """Of a switch of the door that opens more often, or less, than passes end with a dump."""
    is_open = value > value.min() + OPEN * np.ptp(value)
    opens = int(np.sum(is_open[1:] & ~is_open[:-1]))
    if opens > len(spans):
        notes.append(f"warning: door: its switch opens {opens} times, and {len(spans)} passes end with a dump: does it "
                     "say something else as well?")


def _warn_of_door(value, channel, notes):
    """Of a door that is open as the log begins, or most of the time: its ends are exchanged, mostly."""
    most = value.max()
    is_open = value > OPEN * most
    if most < DOOR_DEG or not (is_open[0] or is_open.mean() > OPEN):
        return
    full = channel.slope * {PERCENT: 100.0, SWITCH: 1.0}.get(channel.unit, 0.0)
    key = (f"range: [{channel.intercept + full:g}, {channel.intercept:g}]" if full else
           f"sign: {-np.sign(channel.slope):g}, and an offset")
    notes.append(f"warning: door: it is at {value[0]:.3g} deg as the log begins, and open for "
                 f"{100 * is_open.mean():.0f} % of the time: is it shut there? channels.door.{key}, if its ends are "
                 "exchanged")


def _warn_of_start(crowd, time_s, spans, notes):
    """Of a log that begins within a dig, where the crowd is farther out than other passes begin. Phases are shares of
    a pass's stroke (analysis/signals/phases.hpp), so those of the first pass are then wrong."""
    lowest, stroke = [], []
    for start, end in spans:
        inside = crowd[(time_s >= start) & (time_s <= end)]
        before = inside[:np.argmax(inside) + 1]
        lowest.append(before.min())
        stroke.append(inside.max() - before.min())
    if len(spans) > 1 and lowest[0] - np.median(lowest[1:]) > WITHIN * np.median(stroke[1:]):
        notes.append(f"warning: pass 1 begins at {spans[0][0]:.4g} s with the crowd {lowest[0]:.3g} m out, the others "
                     f"with {np.median(lowest[1:]):.3g} m: does the log begin within its dig? Its phases are then "
                     f"wrong. A time.from after {spans[0][1]:.4g} s leaves it out")


def _warn_of_jumps(name, readings, what, notes):
    """Of a drive that keeps one value, and comes to it or leaves it faster than it can go: no reading, or a stuck one.
    Where most steps are such, the log has a reading less often than a row."""
    time, value, limit = readings.time_s, readings.value, min(what.limits[name].speed, FASTEST[name])
    if what.channels[name].held:
        return
    steps = np.abs(np.diff(value))
    jumps = steps > JUMP * limit * np.diff(time) + NOISE * np.median(np.abs(np.diff(value, 2)))
    first, last = stretches(value)
    before, after = np.append(False, jumps)[first], np.append(jumps, False)[last]
    odd = (last - first + 1 >= FEW) & (before | after)
    if not odd.any() or jumps.sum() > SELDOM * (steps > 0).sum():
        return
    a, b = max(zip(first[odd], last[odd]), key=lambda s: s[1] - s[0])
    unit = CHANNELS[name].unit
    notes.append(f"warning: {name}: {value[a]:.6g} {unit} in all {b - a + 1} rows from line {readings.lines[a]} to "
                 f"{readings.lines[b]}, beside readings that the drive cannot reach from there at {limit:.4g} {unit}/s"
                 f"{longest_of(odd.sum())}: no readings, or stuck ones? {leave_out(name)}")


def _warn_of_far_off(name, readings, change, channel, notes):
    """Of a reading that the curve leaves far aside: too few for a stretch, and too near for the drive's speed."""
    worst, largest, rms = off(change)
    if channel.held or largest <= max(FAR_OFF[name], TIMES_RMS * rms):
        return
    unit = CHANNELS[name].unit
    notes.append(f"warning: {name}: {readings.value[worst]:.6g} {unit} at line {readings.lines[worst]} is "
                 f"{largest:.3g} {unit} off the curve, and all are {rms:.2g} {unit} off it (rms): no reading? "
                 f"{leave_out(name)}")


def _warn_of_all_far_off(name, readings, fit, notes):
    """Of a curve that is far from most of its readings."""
    worst, largest, rms = off(fit.change)
    if rms > ALL_OFF * FAR_OFF[name]:
        unit = CHANNELS[name].unit
        why = "its limits hold it there: is its offset, unit or scale right, and are the limits the machine's?" \
            if fit.limited else "coarse readings, or those of two machines?"
        notes.append(f"warning: {name}: the curve is {rms:.2g} {unit} (rms) off the readings, and "
                     f"{largest:.3g} {unit} at line {readings.lines[worst]}: {why}")


def _warn_of_little(name, value, what, notes):
    """Of a drive that takes next to nothing of its range over whole passes."""
    limits, channel, unit = what.limits[name], what.channels[name], CHANNELS[name].unit
    whole = limits.max - limits.min
    whole = whole if np.isfinite(whole) else USUAL_RANGE[name]
    went = np.ptp(value)
    if went >= LITTLE * whole:
        return
    now = UNITS.get(channel.unit, ("", 1.0))[1]
    likely = [u for u in CHANNELS[name].units() if LITTLE * whole <= went / now * UNITS[u][1] <= whole]
    notes.append(f"warning: {name}: all its readings are within {went:.3g} {unit}, of a range of {whole:.4g} {unit}, "
                 f"over whole passes: another unit{' (' + ', '.join(likely) + ')' if likely else ''}, a scale, or a "
                 "column that says something else?")
