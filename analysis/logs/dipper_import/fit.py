"""A drive's curve through its readings: as smooth as their scatter asks, within the limits of the machine.

The curve is a smoothing spline whose strength is found by generalised cross-validation (scipy's make_smoothing_spline).
Where that asks more of the drive than it can do, rows within position, speed and acceleration take its place that are
within half the readings' scatter of it, or as near as they can be, and change their acceleration least: a linear
programme.
"""
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicHermiteSpline, make_smoothing_spline
from scipy.optimize import linprog
from scipy.sparse import bmat, diags, identity

ROUNDS = 8        # of drawing the speed in until the curve between the rows keeps it, too
MOST = 1000       # readings that are cross-validated
TOLERANCE = 1e-4  # of the largest acceleration: the rows are rounded when written


@dataclass(frozen=True)
class Fit:
    value: np.ndarray     # a row each
    speed: float          # largest, of the curve between the rows too
    acceleration: float   # largest, of the rows: second difference by the square of their interval
    limited: bool         # whether a limit had to be drawn in
    change: np.ndarray    # curve less reading, a reading each


def off(change):
    """(index, size) of the largest change, and the root mean square of all."""
    worst = int(np.abs(change).argmax())
    return worst, float(abs(change[worst])), float(np.sqrt(np.mean(change ** 2)))


def fit_drive(readings, grid, limits, switch):
    """The curve of a drive at the times `grid`, evenly spaced from rest to rest. ValueError: none keeps the limits."""
    target, scatter = _switched(readings, grid, limits) if switch else _smoothed(readings, grid)
    step = grid[1] - grid[0]
    value, speed_most = target, limits.speed
    for _ in range(ROUNDS):
        curve = motion_curve(grid, value)
        speed, acceleration = top_speed(curve), top_acceleration(value, step)
        if speed <= limits.speed and acceleration <= limits.acceleration * (1 + TOLERANCE) and \
                limits.min <= value.min() and value.max() <= limits.max:
            return Fit(value, speed, acceleration, value is not target, curve(readings.time_s) - readings.value)
        if value is not target:
            speed_most *= min(1.0, limits.speed / speed) * 0.999
        value = _nearest_within(target, 0.5 * scatter, step, limits, speed_most)
    raise ValueError("no curve within the limits was found")


def motion_curve(time, value):
    """The curve between the rows of a motion.csv, as machine/motion.hpp has it."""
    step, d = np.diff(time), np.diff(value) / np.diff(time)
    slope = np.zeros(len(value))
    parabola = (step[1:] * d[:-1] + step[:-1] * d[1:]) / (step[:-1] + step[1:])
    most = 3 * np.minimum(np.abs(d[:-1]), np.abs(d[1:]))
    slope[1:-1] = np.where(d[:-1] * d[1:] > 0, np.clip(parabola, -most, most), 0)
    return CubicHermiteSpline(time, value, slope)


def top_speed(curve):
    """The largest there is: at the rows, or where the acceleration goes through 0 between two."""
    step, (c3, c2, c1, _) = np.diff(curve.x), curve.c
    between = np.clip(np.divide(-c2, 3 * c3, out=np.zeros_like(c2), where=c3 != 0), 0, step)
    return float(max(np.abs(c1 + s * (2 * c2 + s * 3 * c3)).max() for s in (0, between, step)))


def top_acceleration(value, step):
    """Of the rows, at rest before and after them. The curve between two rows may turn three times as fast."""
    return float(np.abs(np.diff(np.pad(value, 1, mode="edge"), 2)).max() / step ** 2)


def _smoothed(readings, grid):
    """Rows, and the root mean square of what the readings are off them."""
    strength = _strength(readings.time_s, readings.value) if len(readings.time_s) > MOST else None
    spline = make_smoothing_spline(readings.time_s, readings.value, lam=strength)
    return spline(grid), float(np.sqrt(np.mean((spline(readings.time_s) - readings.value) ** 2)))


def _strength(time, value):
    """The smoothing that cross-validation finds for the MOST readings in a row that move most; for a long log it would
    take minutes. A smoothing spline f has y - f = strength * (jump of its third derivative) at each reading, where the
    sum of squares and the integral of its squared second derivative are in balance: all but the strength is known."""
    went = np.append(0, np.cumsum(np.abs(np.diff(value))))
    start = int(np.argmax(went[MOST - 1:] - went[:len(went) - MOST + 1]))
    t, y = time[start:start + MOST], value[start:start + MOST]
    spline = make_smoothing_spline(t, y)
    jump = np.diff(spline.derivative(3)(0.5 * (t[:-1] + t[1:])), prepend=0, append=0)
    return max(0.0, float((y - spline(t)) @ jump / (jump @ jump)))


def _switched(readings, grid, limits):
    """Steps, later by half of what a stroke takes, so that the curve sets out when the switch is thrown. A stroke that
    has begun is finished: a shorter pulse, as of a trip wire, opens the door as far as a longer one."""
    stroke = np.ptp(readings.value)
    takes = stroke / limits.speed + limits.speed / limits.acceleration
    if limits.speed ** 2 > limits.acceleration * stroke:  # never at full speed
        takes = 2 * np.sqrt(stroke / limits.acceleration)
    begins = grid - takes / 2
    value = readings.value[np.maximum(np.searchsorted(readings.time_s, begins, side="right") - 1, 0)]
    thrown, until = 1 + np.flatnonzero(np.diff(readings.value)), -np.inf
    for k, start, end in zip(thrown, readings.time_s[thrown], readings.time_s[thrown[1:]]):
        if end - start < takes and start >= until:
            until = start + takes + grid[1] - grid[0]
            value[(begins >= start) & (begins < until)] = readings.value[k]
    return value, 0.0


def _nearest_within(target, free, step, limits, speed):
    """Rows that keep the limits, at rest before and after them, with the least sum of what they are further than `free`
    off `target` and of what their second difference changes by."""
    n = len(target)
    first = diags([-1.0, 1.0], [0, 1], shape=(n - 1, n))
    second = diags([1.0, -2.0, 1.0], [-1, 0, 1], shape=(n, n)).tolil()
    second[0, 0] = second[-1, -1] = -1.0
    second = second.tocsr()
    third = first @ second
    blocks, right = [], []
    for matrix, most in ((first, speed * step), (second, limits.acceleration * step ** 2)):
        if np.isfinite(most):
            for sign in (1.0, -1.0):
                blocks.append([sign * matrix, None, None])
                right.append(np.full(matrix.shape[0], most))
    for sign in (1.0, -1.0):
        blocks.append([sign * identity(n), -identity(n), None])  # u >= |x - target| - free
        right.append(sign * target + free)
        blocks.append([sign * third, None, -identity(n - 1)])    # w >= |third difference|
        right.append(np.zeros(n - 1))
    low, high = (None if np.isinf(x) else x for x in (limits.min, limits.max))
    found = linprog(np.append(np.zeros(n), np.ones(2 * n - 1)), bmat(blocks, format="csr"), np.concatenate(right),
                    bounds=[(low, high)] * n + [(0, None)] * (2 * n - 1), method="highs")
    if found.status != 0:
        raise ValueError(found.message)
    return np.clip(found.x[:n], limits.min, limits.max)  # the solver's own tolerance is 1e-7
