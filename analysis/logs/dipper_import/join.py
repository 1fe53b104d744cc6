"""Channels that were logged at times of their own, brought to those of one drive."""
from dataclasses import replace

import numpy as np

from .readings import before_first
from .units import DRIVES

MOSTLY = 0.5  # of a channel's times that are within those of the drives


def join(logs, what, notes):
    """One log of several (log_file.Log): at the times of the drive with the most readings. Between two readings no
    further apart than the map bridges a channel is a straight line; a held one keeps its last."""
    if len(logs) == 1:
        return logs[0]
    base = max(logs, key=lambda g: (any(n in DRIVES for n in g.values), len(g.lines)))
    values = dict(base.values)
    for log in logs:
        if log is not base:
            _warn_of_other_times(log, base, notes)
            for name, value in log.values.items():
                values[name] = _at(base.stamp_s, log.stamp_s, value, what.channels[name], what.longest_gap_s)
    joined = ", ".join(n for log in logs if log is not base for n in log.values)
    notes.append(f"{joined}: logged at times of their own, taken at those of "
                 + next(n for n in base.values if n in DRIVES))
    order = [n for n in what.channels if n in values]
    return replace(base, values={n: values[n] for n in order}, joined=True)


def _warn_of_other_times(log, base, notes):
    """Of channels most of whose times are before or after those of the drive."""
    first, last = np.nanmin(base.stamp_s), np.nanmax(base.stamp_s)
    stamps = log.stamp_s[np.isfinite(log.stamp_s)]
    inside = (stamps >= first) & (stamps <= last)
    if len(stamps) and inside.mean() < MOSTLY:
        ahead = stamps.min() - first
        notes.append(f"warning: {', '.join(log.values)}: logged from {abs(ahead):.0f} s "
                     f"{'after' if ahead > 0 else 'before'} the drives' first time, "
                     f"{100 * inside.mean():.0f} % of it within theirs: another time zone, or a wrong clock?")


def _at(times, stamp_s, value, channel, longest_gap_s):
    there = np.isfinite(value) & np.isfinite(stamp_s)
    if not there.any():
        return np.full(len(times), np.nan)
    order = np.argsort(stamp_s[there], kind="stable")
    t, v = stamp_s[there][order], value[there][order]
    before = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(t) - 1)
    if channel.held:
        return np.where(times >= t[0], v[before], before_first(v, channel))
    after = np.clip(np.searchsorted(t, times, side="left"), 0, len(t) - 1)
    near = (times >= t[0]) & (times <= t[-1]) & (t[after] - t[before] <= longest_gap_s)
    return np.where(near, np.interp(times, t, v), np.nan)
