"""The times of a log's rows, over midnight too, and the part of them between time.from and time.to."""
import numpy as np

from .clock import DAY_S, downwards


def times_of(groups, clock, has_date):
    """Array of s for each layout.Group, NaN for what is no stamp. A clock without a date goes on after midnight."""
    times = [np.array([np.nan if t is None else t for t in map(clock, group.stamps)], float) for group in groups]
    if has_date:
        return times
    times = [_with_days(time) for time in times]
    starts = [np.nanmin(time) for time in times]  # of a channel that is first written after midnight, a day late
    return [time + DAY_S * np.round((starts[0] - start) / DAY_S) for time, start in zip(times, starts)]


def _with_days(time):
    index = downwards(time)
    out = np.empty_like(time)
    out[index] = time[index] + DAY_S * np.cumsum(np.append(False, np.diff(time[index]) < -DAY_S / 2))
    return out


def cut(path, what, clock, has_date, groups, times, found, notes):
    """(groups, times) of the rows within time.from and time.to; None after a finding."""
    keys = {"from": what.time.first, "to": what.time.last}
    ends = {key: clock(stamp) for key, stamp in keys.items() if stamp is not None}
    for key in (k for k, at in ends.items() if at is None):
        found.add(what.path, what.time.line, f"time.{key}", f"is '{keys[key]}'",
                  f"a stamp as in the log, '{groups[0].stamps[0]}'")
    if found.all or not ends:
        return None if found.all else (groups, times)
    begin, end = min(map(np.nanmin, times)), max(map(np.nanmax, times))
    if not has_date:  # the first such time of day in the log
        ends = {k: at + DAY_S * (at < begin and (k == "to" or at + DAY_S <= end)) for k, at in ends.items()}
    rows = [np.flatnonzero(np.isnan(t) | (t >= ends.get("from", -np.inf)) & (t <= ends.get("to", np.inf)))
            for t in times]
    if not all(map(len, rows)):
        found.add(what.path, what.time.line, "time.from", f"no row of {path.name} is within from and to",
                  f"stamps from '{groups[0].stamps[0]}' to '{groups[0].stamps[-1]}'")
        return None
    parts = [group.only(keep) for group, keep in zip(groups, rows)]
    whole, left = (len({line for group in some for line in group.lines}) for some in (groups, parts))
    notes.append(f"{' and '.join(f'time.{k}' for k in ends)}: {whole - left} of {whole} rows left out")
    return parts, [t[keep] for t, keep in zip(times, rows)]
