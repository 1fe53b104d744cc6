"""The readings of one channel: what no machine can have done is left out, and holes are found."""
from dataclasses import dataclass, replace

import numpy as np

from .clock import goes_on
from .phrases import some_rows
from .units import CHANNELS

BEYOND = 0.1        # of a drive's range: a reading further outside is no reading
MOSTLY = 0.05       # of the readings: where more are outside, it is not the readings that are wrong
HOLE = 2.5          # intervals: from so many on there is a gap
TRIP_S = 1.0        # in less no door opens, empties the dipper and shuts
SPELL_S = 0.5       # over which a speed is looked at
NEIGHBOURS = 2      # rows to each side that a reading must agree with
FASTEST = {"hoist": 3.0, "crowd": 2.0, "swing": 40.0}  # m/s, m/s, deg/s, far beyond any shovel's, without limits


@dataclass(frozen=True)
class Readings:
    """Times, values and lines of the readings that are sound."""

    time_s: np.ndarray
    value: np.ndarray
    lines: np.ndarray
    kept: np.ndarray   # of the log's rows


def held_readings(rows, what, notes):
    """The rows with the last reading of a held channel where a row has none."""
    values = dict(rows.values)
    for name, channel in what.channels.items():
        empty = ~np.isfinite(values[name])
        if channel.held and empty.any():
            last = np.maximum.accumulate(np.where(empty, -1, np.arange(len(empty))))
            values[name] = np.where(last >= 0, values[name][last], before_first(values[name][~empty], channel))
            notes.append(f"{name}: {some_rows(rows.lines[empty & (last >= 0)])} without a reading have the last one "
                         "before (held)")
    return replace(rows, values=values)


def before_first(written, channel):
    """What a held channel has before the first reading that is written: nothing is known, but a switch that is written
    only as it changes had its other value."""
    if not channel.switch or not len(written) or (np.diff(written) == 0).any():
        return np.nan
    return 2 * channel.intercept + channel.slope - written[0]


def sound_readings(rows, name, channel, limits, what, path, found, notes):
    """Of the driven channel `name`; None after a finding. Gaps longer than the map bridges are findings."""
    unit = CHANNELS[name].unit
    value = rows.values[name]
    there = np.isfinite(value)
    if there.sum() < 5:
        found.add(path, int(rows.lines[0]), channel.column, f"{int(there.sum())} readings", "5 or more")
        return None
    outside = there & ~_within(value, limits)
    if outside.sum() > MOSTLY * there.sum():
        found.add(path, int(rows.lines[outside][0]), channel.column,
                  f"{name} is from {np.nanmin(value):.4g} to {np.nanmax(value):.4g} {unit}",
                  f"{limits.min:.4g} to {limits.max:.4g} {unit} (limits): unit, sign, scale or offset, perhaps?")
        return None
    _tell(outside, rows, name, value, f"outside the limits of {limits.min:.4g} to {limits.max:.4g} {unit}", notes)
    empty = ~there
    if empty.any():
        notes.append(f"{name}: {some_rows(rows.lines[empty])} without a reading")
    kept = there & ~outside
    speed = min(limits.speed, FASTEST.get(name, np.inf))
    share, top = _too_fast(rows.time_s[kept], value[kept], speed)
    if share > MOSTLY and not channel.switch:
        source = "limits" if speed == limits.speed else "no shovel's goes faster"
        found.add(path, int(rows.lines[kept][0]), channel.column,
                  f"{name} goes at up to {top:.4g} {unit}/s, {100 * share:.0f} % of the time faster than it can",
                  f"{speed:.4g} {unit}/s ({source}): unit or scale, or the unit of the time, perhaps?")
        return None
    if not channel.switch and np.isfinite(speed):
        jumps = np.zeros(len(value), bool)
        at = np.flatnonzero(kept)
        jumps[at[_out_of_reach(rows.time_s[at], value[at], speed)]] = True
        _tell(jumps, rows, name, value, f"out of reach of their neighbours at {speed:.4g} {unit}/s", notes)
        kept &= ~jumps
    if name == "door":
        lone = np.zeros(len(value), bool)
        at = np.flatnonzero(kept)
        lone[at[_lone(rows.time_s[at], value[at])]] = True
        _tell(lone, rows, name, value, "more than half the stroke off both beside them", notes)
        kept &= ~lone
    out = Readings(rows.time_s[kept], value[kept], rows.lines[kept], kept)
    _find_gaps(out, rows, name, what, path, found, notes)
    return out


def _within(value, limits):
    room = BEYOND * (limits.max - limits.min) if np.isfinite([limits.min, limits.max]).all() else 0.0
    with np.errstate(invalid="ignore"):
        return (value >= limits.min - room) & (value <= limits.max + room)


def _too_fast(time, value, speed):
    """Share of the readings after which a drive goes faster than at `speed`, over SPELL_S; its 99th percentile."""
    at = np.searchsorted(time, time + SPELL_S)
    there = np.flatnonzero(at < len(time))
    if not len(there):
        return 0.0, 0.0
    went = np.abs(value[at[there]] - value[there]) / (time[at[there]] - time[there])
    return float(np.mean(went > 1.1 * speed)), float(np.percentile(went, 99))


def _out_of_reach(time, value, speed):
    """Whether a reading is further from the median of its neighbours than the drive can have gone; those at the ends
    have theirs to one side."""
    first = np.clip(np.arange(len(value)) - NEIGHBOURS, 0, max(0, len(value) - 2 * NEIGHBOURS - 1))
    at = np.minimum(first[:, None] + np.arange(2 * NEIGHBOURS + 1), len(value) - 1)
    reach = speed * (time[at[:, -1]] - time[at[:, 0]])
    return np.abs(value - np.median(value[at], axis=1)) > reach


def _lone(time, value):
    """Whether a door's reading is more than half the stroke off both beside it. Where most openings are such, the log
    has the pulse that trips the door."""
    steps, odd = np.diff(value), np.zeros(len(value), bool)
    far = np.abs(steps) > np.ptp(value) / 2
    odd[1:-1] = far[:-1] & far[1:] & (steps[:-1] * steps[1:] < 0) & (time[2:] - time[:-2] < TRIP_S)
    is_open = value[~odd] > (value[~odd].min() + value[~odd].max()) / 2
    return odd & (odd.sum() <= np.sum(is_open[1:] & ~is_open[:-1]))


def _tell(which, rows, name, value, why, notes):
    if which.any():
        notes.append(f"{name}: {some_rows(rows.lines[which], 'reading')} {why}, left out; the first is "
                     f"{value[which][0]:.4g}")


def _find_gaps(kept, rows, name, what, path, found, notes):
    """Holes in the readings of a channel. What is missing of all of them, whole rows, is reported once (row_gaps)."""
    too_long = []
    for k in np.flatnonzero(np.diff(kept.time_s) > HOLE * rows.interval_s):
        a, b = kept.lines[k], kept.lines[k + 1]
        length = kept.time_s[k + 1] - kept.time_s[k]
        if _row_gap_within(rows, kept.time_s[k], kept.time_s[k + 1]) >= length - 1e-9:
            continue
        if length > what.longest_gap_s:
            too_long.append((length, a, b))
        else:
            notes.append(f"{name}: no reading for {length:.3g} s, between lines {a} and {b}: bridged")
    if too_long:
        length, a, b = max(too_long)
        more = f", and {len(too_long) - 1} such gaps more" if len(too_long) > 1 else ""
        found.add(path, int(a), what.channels[name].column, f"no reading for {length:.4g} s, up to line {b}{more}",
                  f"{what.longest_gap_s:g} s at most (longest_gap_s): channels.{name}.held: true if it is written only "
                  "as it changes; else choose a part with time.from and time.to")


def _row_gap_within(rows, start, end):
    inside = rows.time_s[(rows.time_s >= start) & (rows.time_s <= end)]
    return float(np.diff(inside).max()) if len(inside) > 1 else 0.0


def row_gaps(rows, what, path, found, notes):
    """(start, end) in s of each stretch without rows; those too long to bridge are findings."""
    gaps, alone = [], {0: rows.lines[0], len(rows.lines) - 2: rows.lines[-1]}
    for k in np.flatnonzero(np.diff(rows.time_s) > HOLE * rows.interval_s):
        start, end = float(rows.time_s[k]), float(rows.time_s[k + 1])
        a, b = sorted((int(rows.lines[k]), int(rows.lines[k + 1])))
        gaps.append((start, end))
        set_forward = goes_on(rows.values, what.smooth(), range(k - 1, k + 3), (end - start) / rows.interval_s)
        hint = f"the drives go on as if no time had passed: was the clock set? time.clock_set_at: [{b}]"
        if end - start <= what.longest_gap_s:
            gap = f"gap of {end - start:.3g} s between lines {a} and {b}"
            notes.append(f"{gap}: bridged")
            if set_forward:
                notes.append(f"warning: {gap}: {hint}")
            continue
        found.add(path, a, "time", f"nothing for {end - start:.6g} s, up to line {b}",
                  f"{what.longest_gap_s:g} s at most (longest_gap_s); choose a part with time.from and time.to"
                  + (f"; {hint}" if set_forward else "")
                  + (f"; line {alone[k]} stands alone there: is its stamp wrong?" if k in alone else ""))
    return gaps
