"""A face whose height is known everywhere, scanned with a shovel and dust in the way, in a mine's coordinates."""
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]

ORIGIN = (512345.2, 7443210.9, 182.4)
AZIMUTH = 37.0
TOE, HEIGHT, SLOPE = 13.0, 9.0, 38.0  # m, m, deg


def height(x, y):
    """z of the ground in W: a floor, a face whose toe wanders with y, a bench behind it."""
    face = (x - TOE - 0.4 * np.sin(y / 2)) * np.tan(np.radians(SLOPE))
    return np.clip(face, 0, HEIGHT + 0.05 * (x - 25))


def to_mine(points, origin=ORIGIN, azimuth=AZIMUTH):
    """W -> easting, northing, elevation, written down anew: by the bearing of each point."""
    bearing = np.radians(azimuth) - np.arctan2(points[:, 1], points[:, 0])
    reach = np.hypot(points[:, 0], points[:, 1])
    return np.column_stack([origin[0] + reach * np.sin(bearing), origin[1] + reach * np.cos(bearing),
                            origin[2] + points[:, 2]])


def ground(n, rng, x=(-15, 32), y=(-20, 20)):
    p = np.column_stack([rng.uniform(*x, n), rng.uniform(*y, n)])
    return np.column_stack([p, height(*p.T) + rng.normal(0, 0.03, n)])


def box_points(n, rng, low, high):
    """On the sides and the top of a box, as a scanner sees a machine."""
    low, high = np.array(low, float), np.array(high, float)
    p = rng.uniform(low, high, (n, 3))
    side = rng.integers(0, 5, n)
    for axis, end in ((0, low), (0, high), (1, low), (1, high), (2, high)):
        at = side == [(0, "l"), (0, "h"), (1, "l"), (1, "h"), (2, "h")].index((axis, "l" if end is low else "h"))
        p[at, axis] = end[axis]
    return p


def scene(n=60_000, seed=1, shovel=True, dust=True):
    """(n', 3) in W: the ground with what hides it taken away, the shovel at the origin with its dipper before the face,
    dust over the bench."""
    rng = np.random.default_rng(seed)
    points = ground(n, rng)
    parts = []
    if shovel:
        house, dipper = ((-8, -5, 0.5), (5, 5, 9)), ((15.0, -1.8, 5.0), (18.5, 1.8, 8.5))
        for low, high in (house, dipper):
            inside = ((points[:, :2] > low[:2]) & (points[:, :2] < high[:2])).all(axis=1)
            points = points[~inside]
            parts.append(box_points(n // 30, rng, low, high))
        handle = rng.uniform(0, 1, (n // 100, 1)) * [[10.5, 0, -3.5]] + [[5, 0.6, 9]]
        parts.append(handle + rng.normal(0, 0.15, handle.shape))
    if dust:
        parts.append(rng.uniform((14, -6, 4), (26, 6, 14), (n // 100, 3)))
        parts.append(rng.uniform((10, -6, -9), (26, 6, -2), (20, 3)))  # mirrored echoes
    points = np.vstack([points, *parts])
    return points[rng.permutation(len(points))]
