"""The phases of a pass, from the driven signals alone.

Swing tells digging from carrying; the stroke of the crowd divides the dig:

    approach   until the crowd has made APPROACH of its stroke
    penetrate  until it has made PENETRATE of it: the teeth go in at the toe
    fill       until it is out, up to FILL: the dipper goes up the face
    breakout   until the swing has begun
    swing      until it is over; from SWING_BEGUN to SWING_OVER of its range
    dump       while it rests there
    return     from the moment it leaves, to the pass's end

The shovel faces the rock where it is when the crowd is nearly all out; swing is the turn away from there. A
pass may begin while it still swings back, and need not end at the same heading.

Boundaries are times at which a signal, taken as straight between readings, crosses its limit: they do not
jump with the logger's clock. A phase that does not occur, or takes no time, is left out.
"""
import numpy as np

PHASES = ("approach", "penetrate", "fill", "breakout", "swing", "dump", "return")
DIG = PHASES[:3]
APPROACH, PENETRATE, FILL = 0.10, 0.45, 0.97
SWING_BEGUN, SWING_OVER = 0.05, 0.97
LEAST_SWING_RAD = 0.1


def crossing(t, x, level, rising=True):
    """First time at which x, straight between readings, is at or past `level`; None if never."""
    past = x >= level if rising else x <= level
    if not past.any():
        return None
    k = int(np.argmax(past))
    if k == 0:
        return float(t[0])
    return float(t[k - 1] + (t[k] - t[k - 1]) * (level - x[k - 1]) / (x[k] - x[k - 1]))


def find_phases(time_s, crowd_m, swing_rad, t_start_s, t_end_s):
    """{phase: (start, end)} of one pass, in s; times in order, without gaps."""
    inside = (time_s >= t_start_s) & (time_s <= t_end_s)
    t, crowd, swing = time_s[inside], crowd_m[inside], swing_rad[inside]
    out = int(np.argmax(crowd >= crowd.min() + FILL * (crowd.max() - crowd.min())))
    turned = np.abs(swing - swing[out])
    top = turned[out:].max()
    facing = turned <= SWING_BEGUN * top if top > LEAST_SWING_RAD else np.ones(len(t), bool)
    begin = out - int(np.argmin(facing[out::-1])) + 1 if not facing[:out].all() else 0
    marks = _dig(t[begin:], crowd[begin:], facing[begin:]) + _carry(t[out:], turned[out:], top)
    times = [float(t[0])] + [m if m is not None else float(t[-1]) for m in marks] + [float(t[-1])]
    times = np.maximum.accumulate(times)
    return {phase: (a, b) for phase, a, b in zip(PHASES, times[:-1], times[1:]) if b - a > 1e-9}


def _dig(t, crowd, facing):
    """Ends of approach, penetrate and fill."""
    last = len(facing) if facing.all() else int(np.argmin(facing))
    t, crowd = t[:last], crowd[:last]
    out = int(np.argmax(crowd))
    start = int(np.argmin(crowd[:out + 1]))
    stroke = crowd[out] - crowd[start]
    return [crossing(t[start:], crowd[start:], crowd[start] + f * stroke)
            for f in (APPROACH, PENETRATE, FILL)]


def _carry(t, turned, top):
    """Starts of swing, dump and return."""
    if top <= LEAST_SWING_RAD:
        return [None, None, None]
    over = SWING_OVER * top
    there = int(np.argmax(turned > over))
    return [crossing(t, turned, SWING_BEGUN * top), crossing(t, turned, over),
            crossing(t[there:], turned[there:], over, False)]
