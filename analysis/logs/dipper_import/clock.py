"""The rows of a log in order: what came late is sorted in, what came twice goes, a clock that was set is undone."""
from dataclasses import dataclass, replace

import numpy as np

from .import_map import NUMBER_FORMATS
from .phrases import some_rows
from .units import DRIVES

DAY_S = 86400.0
SHORTEST_S = 1e-3  # between two rows
TOGETHER_S = 5e-4  # between rows of one time: half of that, for a clock that errs
SLOWEST_S = 5.0    # between two rows in which a pass of 20 to 60 s is still seen,
ROOM = 1.5         # and of the interval, for the next row that comes late
DOUBLED = 1.5      # rows for each interval of the log: from so many on, two stretches lie over one another
ELSEWHERE = 1.5    # of the usual step: beyond the half of it by which goes_on lets a step differ, and noise
FAR_APART = 2.0    # times the largest usual step: so much no drive moves within one stamp
COARSE = 0.1       # of the interval: beyond it the last digit of the stamps spoils the speeds,
UNEVEN = 0.05      # where so many steps differ from the usual one,
IN_A_ROW = 20      # and so many of them add up to the same, but for a digit: rows lost by chance do not
DIGIT_S = 1e-5     # the least digit that is looked for
SAME_TIME = 0.05   # of the rows may share their time with another one that has other readings


@dataclass(frozen=True)
class Rows:
    """Rows by time, from 0, each time once."""

    time_s: np.ndarray
    lines: np.ndarray
    values: dict
    interval_s: float   # between two rows, the median
    first_stamp: str
    last_stamp: str


def order_rows(log, what, path, found, notes):
    """As the map `what` says. None after a finding."""
    index = downwards(log.stamp_s)
    stamp = log.stamp_s[index]
    if index[0] > 0:
        notes.append("the newest row stands first: read from the bottom up")
    steps = np.diff(stamp)
    if not (steps > 0).any():
        found.add(path, int(log.lines[0]), "time", "does not rise", "rows at two times or more")
        return None
    interval = float(np.median(steps[steps > 0]))
    if not SHORTEST_S <= interval <= what.longest_gap_s:
        _tell_interval(interval, log, what, path, found)
        return None
    if not what.time.spread and (coarse := _coarse_digit(steps, interval)):
        digit, mean = coarse
        found.add(path, int(log.lines[0]), "time", f"counts by {digit:.3g} s, too coarse for one row each "
                  f"{mean:.3g} s: its steps differ by that much in turn",
                  f"stamps to {COARSE * mean:.2g} s or better: more decimals, from the logger's own file")
        return None
    if _first_is_last(log, index, stamp, what, path, found):
        return None
    time = _merge(log, index, stamp, interval, what, path, found, notes)
    if found.all:
        return None
    order = np.argsort(time, kind="stable")
    late = index[time < np.maximum.accumulate(time)]
    kept = _each_time_once(log, index[order], time[order], path, found, notes)
    if kept is None:
        return None
    index, time = kept
    late = np.intersect1d(late, index)
    if len(late):
        notes.append(f"{some_rows(log.lines[late])}: out of order, sorted in")
    return Rows(time - time[0], log.lines[index], {n: v[index] for n, v in log.values.items()}, interval,
                log.stamps[index[0]], log.stamps[index[-1]])


def _coarse_digit(steps, interval):
    """(last digit of the stamps, mean step), s, where it is coarse and an even clock was cut to it; None else. Whole
    seconds at 1 Hz are even; where rows are lost, the sums of some steps differ by chance."""
    counts = np.round(steps[(steps > 0) & (steps < 4 * interval)] / DIGIT_S).astype(int)
    digit = int(np.gcd.reduce(counts))
    if digit * DIGIT_S <= COARSE * interval or len(counts) < 2 * IN_A_ROW or \
            np.mean(counts != np.median(counts)) < UNEVEN:
        return None
    sums = np.convolve(counts // digit, np.ones(IN_A_ROW, int), "valid")
    even = np.mean(np.abs(sums - np.median(sums)) <= 1) > 0.9
    return (digit * DIGIT_S, counts.mean() * DIGIT_S) if even else None


def _tell_interval(interval, log, what, path, found):
    """Finding about rows too far apart to see a dig, or closer than any logger's: the unit of the time, mostly."""
    found.add(path, int(log.lines[0]), "time", f"is one row each {interval:.3g} s",
              f"{SHORTEST_S:g} to {what.longest_gap_s:g} s (longest_gap_s)" + _other_unit(interval, what, log.unit)
              + (f"; longest_gap_s: {ROOM * interval:.2g}, if the logger is as slow" if what.longest_gap_s < interval
                 <= SLOWEST_S else ""))


def _other_unit(interval, what, unit):
    if unit is None:
        return ""
    now = NUMBER_FORMATS[unit]
    better = [f"{u}: {interval / now * size:.3g} s" for u, size in NUMBER_FORMATS.items()
              if SHORTEST_S <= interval / now * size <= what.longest_gap_s]
    return f"; another unit of numbers in time.format, perhaps? {', '.join(better)}" if better else ""


def downwards(stamp):
    """Row numbers, turned round where the newest row stands first."""
    index, steps = np.arange(len(stamp)), np.diff(stamp)
    return index[::-1] if (steps < 0).sum() > (steps > 0).sum() else index


def spread_stamps(log):
    """The log with the rows of one stamp spread up to the next."""
    index, stamp = downwards(log.stamp_s), np.empty_like(log.stamp_s)
    stamp[index] = _spread(log.stamp_s[index])
    return replace(log, stamp_s=stamp)


def _spread(stamp):
    """Rows of one stamp, evenly up to the next; those of the last one as those of the one before."""
    starts = np.flatnonzero(np.append(True, np.diff(stamp) != 0))
    counts = np.diff(np.append(starts, len(stamp)))
    steps = np.diff(stamp[starts]) / counts[:-1]
    steps = np.append(steps, steps[-1:] if len(steps) else 0.0)
    steps[steps < 0] = np.median(steps[steps > 0]) if (steps > 0).any() else 0.0
    return stamp + np.repeat(steps, counts) * (np.arange(len(stamp)) - np.repeat(starts, counts))


def _first_is_last(log, index, stamp, what, path, found):
    """Whether the first row is long after all others, a finding: it would hide every later setting of the clock."""
    first, second = (int(line) for line in log.lines[index[:2]])
    after = stamp[0] - stamp[1:].max()
    if after <= what.longest_gap_s or second in what.time.clock_set_at:
        return False
    found.add(path, first, "time", f"is {after:.6g} s after all other rows: its stamp is wrong, or the clock was set",
              f"a stamp before that of line {second}, or time.clock_set_at: [{second}]")
    return True


def goes_on(values, drives, rows, intervals=np.inf):
    """Whether each drive goes from the second to the third of four rows as between the first two and the last two, and
    one of them moves so fast that it had gone elsewhere in so many `intervals`: no time has passed there."""
    rows, moves = list(rows), False
    if len(rows) != 4:
        return False
    for name in drives:
        all_of_it = values[name]
        if rows[0] < 0 or rows[-1] >= len(all_of_it) or not np.isfinite(all_of_it[rows]).all():
            return False
        before, across, after = np.diff(all_of_it[rows])
        usual = np.nanpercentile(np.abs(np.diff(all_of_it)), 90)
        if abs(across - 0.5 * (before + after)) > 0.5 * usual:
            return False
        moves |= abs(before) > 0.2 * usual and abs(before + after) / 2 * (intervals - 1) > ELSEWHERE * usual
    return moves


def _merge(log, index, stamp, interval, what, path, found, notes):
    """The time of each row when every setting of the clock is undone.

    Where the stamps step back, either rows come late, and fit between those before them; or the clock was set back.
    Then its second count of the same minutes lies over the first, and there are twice the rows there should be; or it
    was set to before the log, and the drives go on as if nothing had happened.
    """
    line, clock_set_at = log.lines[index], what.time.clock_set_at
    time = stamp.copy()
    shift = 0.0
    unknown = sorted(set(clock_set_at) - set(line[1:].tolist()))
    if unknown:
        found.add(path, 0, "time.clock_set_at", f"has {', '.join(map(str, unknown))}, where no row with a time begins",
                  f"lines of rows after the first, {int(line[1])} to {int(line[-1])}" if len(line) > 1 else "no line")
    starts = np.flatnonzero(np.append(True, (np.diff(stamp) < 0) | np.isin(line[1:], list(clock_set_at))))
    for start, end in zip(starts, np.append(starts[1:], len(stamp))):
        time[start:end] += shift
        if start == 0:
            continue
        known, new = time[:start], time[start:end]
        last = known.max()
        declared = int(line[start]) in clock_set_at
        if new[-1] < known.min():
            set_back = goes_on(log.values, what.smooth(), index[max(start - 2, 0):start + 2])
        else:
            set_back = new[0] < last and _doubled(log, index, known, new, last, interval)
        if declared or set_back:
            by = last + interval - new[0]
            if log.joined:
                was = log.stamps[index[np.argmax(known)]]
                found.add(path, int(line[start]), "time", f"the clock is set {'back' if by > 0 else 'forward'}, and "
                          "channels have times of their own, which are joined by their stamps",
                          f"a part of the log: time.to before '{log.stamps[index[start]]}', or time.from after '{was}'")
                break
            notes.append(f"the clock is set {'back' if by > 0 else 'forward'} by {abs(by):.6g} s at line {line[start]}"
                         f"{' (clock_set_at)' if declared else ''}: that row is taken to follow the one before by "
                         f"{interval:.3g} s")
            shift += by
            time[start:end] += by
    return time


def _doubled(log, index, known, new, last, interval):
    first = max(new[0], known.min())
    old_rows = np.flatnonzero(known >= first)
    new_rows = np.flatnonzero((new >= first) & (new <= last))
    at = {}
    for k in old_rows:
        at.setdefault(round(known[k], 6), []).append(index[k])
    again = sum(any(_same(log, a, index[len(known) + k]) for a in at.get(round(new[k], 6), ())) for k in new_rows)
    return len(old_rows) + len(new_rows) - again > DOUBLED * ((last - first) / interval + 1)


def _same(log, a, b):
    return all(v[a] == v[b] or (np.isnan(v[a]) and np.isnan(v[b])) for v in log.values.values())


def _far_apart(log, index, keep, first, other):
    """Whether a drive at one time is further apart than it goes from one time to the next: two machines in one log."""
    for name in (n for n in DRIVES if n in log.values):
        value = log.values[name][index]
        apart = np.abs(value[other] - value[first[other]])
        steps = np.abs(np.diff(value[keep]))
        if np.isfinite(apart).any() and np.isfinite(steps).any() and \
                np.nanmedian(apart) > FAR_APART * np.nanpercentile(steps, 95):
            return True
    return False


def _each_time_once(log, index, time, path, found, notes):
    """(index, time) without rows whose time has been seen; None after a finding."""
    keep = np.append(True, np.diff(time) > TOGETHER_S)
    first = np.maximum.accumulate(np.where(keep, np.arange(len(time)), 0))
    again = np.flatnonzero(~keep)
    same = [k for k in again if _same(log, index[first[k]], index[k])]
    other = sorted(set(again) - set(same))
    if len(other) > SAME_TIME * len(time):
        found.add(path, int(log.lines[index[other[0]]]), "time",
                  f"{len(other)} of {len(time)} rows have the time of another row, and other readings",
                  "one machine's rows: those of one stamp are far apart" if _far_apart(log, index, keep, first, other)
                  else "a time with fractions of a second, or time.same_stamp: spread (evenly up to the next stamp)")
        return None
    for rows, words in ((same, "twice in the file, left out"),
                        (other, "at the time of another row, with other readings, left out")):
        if rows:
            notes.append(f"{some_rows(log.lines[index[rows]])}: {words}")
    return index[keep], time[keep]
