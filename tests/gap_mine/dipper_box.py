"""The mine's dipper: plates of 0.15 m and five teeth, of the same struck volume as the model's, 42 m^3."""
import numpy as np

DEPTH, ROOF, HALF_WIDTH, HALF_HEIGHT, PLATE, TOOTH = 4.0, 3.0, 2.0, 1.5, 0.15, 0.6


def prism(outline, along):
    """Facets (n, 3, 3) of a convex outline (k, 3) drawn out along a vector."""
    a = np.array(outline, float)
    b = a + along
    k = len(a)
    facets = [[p[0], p[i], p[i + 1]] for p in (a, b) for i in range(1, k - 1)]
    for i in range(k):
        j = (i + 1) % k
        facets += [[a[i], a[j], b[j]], [a[i], b[j], b[i]]]
    return np.array(facets)


def facets():
    """(n, 3, 3) in the dipper's axes: origin in the middle of the rear plane, x to the lip, z to the roof."""
    w, h, p = HALF_WIDTH, HALF_HEIGHT, PLATE
    floor = [(0, -w, -h), (DEPTH, -w, -h), (DEPTH, w, -h), (0, w, -h)]
    roof = [(0, -w, h), (ROOF, -w, h), (ROOF, w, h), (0, w, h)]
    door = [(0, -w, -h), (0, w, -h), (0, w, h), (0, -w, h)]
    parts = [prism(floor, (0, 0, -p)), prism(roof, (0, 0, p)), prism(door, (-p, 0, 0))]
    for side in (-1, 1):
        cheek = [(0, side * w, -h), (DEPTH, side * w, -h), (ROOF, side * w, h), (0, side * w, h)]
        parts.append(prism(cheek, (0, side * p, 0)))
    for y in (-1.7, -0.85, 0.0, 0.85, 1.7):
        parts.append(prism([(DEPTH, y - 0.16, -h), (DEPTH + TOOTH, y - 0.16, -h - 0.6 * p), (DEPTH, y - 0.16, -h - p)],
                           (0, 0.32, 0)))
    return np.concatenate(parts)


def struck_volume():
    """m^3, up to the plane through the lip and the roof's edge."""
    return 2 * HALF_WIDTH * 2 * HALF_HEIGHT * 0.5 * (DEPTH + ROOF)


def holds(p):
    """Which points (n, 3), in the dipper's axes, lie in it or in the heap before it."""
    front = DEPTH + 0.8 - 0.33 * (p[:, 2] + HALF_HEIGHT)
    return ((p[:, 0] > -0.1) & (p[:, 0] < np.maximum(front, ROOF)) & (np.abs(p[:, 1]) < HALF_WIDTH + 0.1)
            & (p[:, 2] > -HALF_HEIGHT - 0.1) & (p[:, 2] < HALF_HEIGHT + 1.2))


def meets(spheres, radius, gap=0.05):
    """Which spheres (n, 3), (n,) would touch the box that the dipper fills."""
    x, y, z = spheres.T
    r = radius + gap
    return ((x > -PLATE - r) & (x < DEPTH + TOOTH + r) & (np.abs(y) < HALF_WIDTH + PLATE + r)
            & (np.abs(z) < HALF_HEIGHT + PLATE + r))
