"""Readings that are hardly any: what loggers write for none, and what no shovel's force does. `dipper import` asks the
same of a log."""
import numpy as np

# What loggers write for "no reading": 9s, the ends of 16 and 32 bit numbers and these with a decimal point put in.
SENTINELS = {s * float(n) for n in ("999", "9999", "99999", "999999") for s in (1, -1)} | \
    {-999.25, -2147483648.0, 2147483647.0} | {n / d for n in (-32768, 32767, 65535) for d in (1, 10, 100, 1000)}
SPIKE = 0.2       # of the range of all other readings: so far off its neighbours, a 9999 is no reading
FEW = 3           # readings
DROP = 0.2        # of the usual force: a fall to next to nothing and back from more is no load's
SMALL = 0.02      # of the usual force: next to nothing
STUCK_ROWS = 10   # one force for as many readings,
STUCK_M = 5.0     # while rope and handle move by as much: no load does that
PULLED = 95       # per cent of the readings, up to which a rope's pull is looked at


def sentinels(value):
    """Rows in which a number such as -9999 stands far off its neighbours."""
    there = np.flatnonzero(np.isfinite(value))
    like = np.isin(value[there], list(SENTINELS)) | (np.abs(value[there]) >= 1e30)
    others = there[~like]
    if not like.any() or len(others) < 2:
        return there[:0]
    before = np.clip(np.searchsorted(others, there[like]) - 1, 0, len(others) - 1)
    after = np.clip(before + 1, 0, len(others) - 1)
    odd = value[there[like]]
    off = np.minimum(np.abs(odd - value[others[before]]), np.abs(odd - value[others[after]]))
    return there[like][off > SPIKE * max(np.ptp(value[others]), 1e-9)]


def pushes(force):
    """Whether the largest forces of a rope, which can only pull, are negative: by its sign, mostly."""
    there = force[np.isfinite(force)]
    return len(there) > 0 and bool(np.percentile(there, PULLED) < -np.percentile(there, 100 - PULLED))


def falls(force):
    """[(low, rows, least)] of a force that falls to 0, -1 or another small number, always the same, between readings of
    `least` and more: what loggers write while an instrument is away."""
    there = np.flatnonzero(np.isfinite(force))
    usual = np.percentile(np.abs(force[there][force[there] != 0]), 95) if force[there].any() else 0.0
    lows, numbers = np.unique(force[there][np.abs(force[there]) <= SMALL * usual], return_counts=True)
    out = [(low, *_falls_to(force, there, low, usual)) for low in lows[numbers >= FEW]]
    return [fall for fall in out if len(fall[1]) >= FEW]


def _falls_to(force, there, low, usual):
    """Rows in which a force is `low` between others of more than DROP of the usual, and the least of these. A force
    that changes its sign from one row to the next may pass by any small number."""
    lows, others = there[force[there] == low], there[force[there] != low]
    if len(others) < FEW:
        return [], None
    at = np.searchsorted(others, lows)
    between = (at > 0) & (at < len(others))
    at = np.clip(at, 1, len(others) - 1)
    before, after = force[others[at - 1]], force[others[at]]
    beside = np.minimum(np.abs(before), np.abs(after))
    fallen = between & (beside > DROP * usual) & ((before * after > 0) | (low == 0))
    return lows[fallen], beside[fallen].min(initial=np.inf)


def stuck(force, hoist, crowd):
    """(first row, last row, readings, m, how often) of the longest stretch in which a force other than 0 does not
    change by a digit while rope and handle move: an instrument that is stuck, or at the end of its range; or None."""
    there = np.flatnonzero(np.isfinite(force) & (force != 0))
    if not len(there):
        return None
    value, moved = force[there], (_way(hoist) + _way(crowd))[there]
    first, last = stretches(value)
    found = (last - first + 1 >= STUCK_ROWS) & (moved[last] - moved[first] >= STUCK_M)
    if not found.any():
        return None
    longest = np.flatnonzero(found)[np.argmax((last - first)[found])]
    a, b = first[longest], last[longest]
    return there[a], there[b], b - a + 1, moved[b] - moved[a], int(found.sum())


def stretches(value):
    """First and last rows of the stretches in which a value does not change by a digit."""
    first = np.flatnonzero(np.diff(value, prepend=np.nan) != 0)
    return first, np.append(first[1:], len(value)) - 1


def _way(position):
    """Length of the way up to each row; empty cells are passed over."""
    there = np.flatnonzero(np.isfinite(position))
    steps = np.abs(np.diff(position[there], prepend=position[there[:1]]))
    return np.interp(np.arange(len(position)), there, np.cumsum(steps)) if len(there) else np.zeros(len(position))
