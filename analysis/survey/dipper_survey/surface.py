"""The surface of a bench out of a cloud: one height a place, what floats over it left out, gaps filled.

Points are counted in cells of x, y and z, so that memory is that of the bench's box and not of the cloud. In each
column of cells the surface is the median of what lies up to LAYER_m over the column's lowest points: dust, a boom or
ropes over ground that is seen are left out by that. Columns in which only the machine or dust is seen stand off their
surroundings by a step along most of their edge; such islands are left out, too. What is not seen is filled linearly
between what is.
"""
from dataclasses import dataclass

import numpy as np
from scipy import interpolate, ndimage

CELL_m = 0.25           # no finer: rocks are larger
COARSEST = 4            # times CELL_m, for thin clouds
POINTS = 3              # a cell should have in the mean
BIN_m = 0.05            # of height
BELOW_m = 3.0           # under the ground that is looked at
LAYER_m = 1.0           # over a column's lowest points: a steep face within one column
SUPPORT_m = 0.25        # within which a column's lowest points have company, else they are noise
STEP_m = 1.0            # over what is round it: a machine, dust, or a boulder
OBJECT_m = 8.0          # wider is ground, whatever its sides are
REACH_m = 0.5           # over which what is round a place is looked for, and at least a cell
STEEP = 1.5             # height over distance at an edge: 56 degrees, and no heap of rock
NOWHERE_m = -1e6       # where nothing is seen
ATTACHED = 0.5          # of its edge without such a step: ground, a ridge or a heap
ROCK_m = 0.3            # over the ground: where the bench begins
TOE_SHARE = 0.1         # of the width that is rock at the toe
FACE = (0.2, 0.8)       # of the bench's height: between floor and crest
SEEN_SHARE = 0.1        # of the width that is seen at the rear


@dataclass(frozen=True)
class Box:
    """The part of W that is looked at: x from the shovel to the rear wall, |y| <= half_width, z up to the top; m."""

    x0: float
    x1: float
    half_width: float
    top: float


class Columns:
    """Counts of points over a grid of places (x, y), by height. A place stands in the middle of its column; the outer
    ones stand on the box's sides."""

    def __init__(self, box, cell_m):
        self.box = box
        self.x = np.linspace(box.x0, box.x1, max(2, round((box.x1 - box.x0) / cell_m) + 1))
        self.y = np.linspace(-box.half_width, box.half_width, max(2, round(2 * box.half_width / cell_m) + 1))
        self.step = np.array([self.x[1] - self.x[0], self.y[1] - self.y[0], BIN_m])
        self.low = np.array([box.x0, -box.half_width, -BELOW_m]) - [self.step[0] / 2, self.step[1] / 2, 0]
        shape = (len(self.x), len(self.y), int(np.ceil((box.top + BELOW_m) / BIN_m)))
        self.counts = np.zeros(shape, np.uint32)
        self.outside = 0  # over or under the box

    def add(self, points):
        """(n, 3) in W."""
        index = np.floor((points - self.low) / self.step)
        near = ((index[:, :2] >= 0) & (index[:, :2] < self.counts.shape[:2])).all(axis=1)
        index = index[near].astype(np.int64)
        inside = (index[:, 2] >= 0) & (index[:, 2] < self.counts.shape[2])
        self.outside += int((~inside).sum())
        flat = np.ravel_multi_index(index[inside].T, self.counts.shape)
        self.counts += np.bincount(flat, minlength=self.counts.size).reshape(self.counts.shape).astype(np.uint32)

    def z(self, bins):
        """Height of the lower end of a bin."""
        return bins * BIN_m - BELOW_m


@dataclass(frozen=True)
class Island:
    """Columns that stand off their surroundings: the machine, or dust; x and y in the middle, in W."""

    points: int
    area_m2: float
    x: float
    y: float
    off_m: float  # over the surface there; less than 0 under it


@dataclass(frozen=True)
class Surface:
    """z[i, j] in m over the ground at x[i], y[j] of W, from the toe to the rear wall."""

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    filled: np.ndarray      # bool: not seen, z is between what is
    columns: Columns
    first: int              # of columns.x that x[0] is
    islands: list
    above: int              # points left out over the surface
    floor_m: float          # median height of what is seen in front of the toe; NaN: nothing
    hole_m2: float          # the largest part that is filled

    @property
    def face_deg(self):
        """(angle of the face, direction of its rise, positive to the left of x): of the plane that fits best between
        FACE of its height."""
        x, y = np.meshgrid(self.x, self.y, indexing="ij")
        low, high = (share * np.quantile(self.z, 0.95) for share in FACE)
        on_it = (self.z > low) & (self.z < high)
        if on_it.sum() < 3:
            return 90.0, 0.0
        terms = np.column_stack([x[on_it], y[on_it], np.ones(on_it.sum())])
        (along, across, _), *_ = np.linalg.lstsq(terms, self.z[on_it], rcond=None)
        return float(np.degrees(np.arctan(np.hypot(along, across)))), float(np.degrees(np.arctan2(across, along)))

    def section(self, share=0.5):
        """(n, 2) of x and z along the dig: at each x the height that `share` of the width is not above."""
        return np.column_stack([self.x, np.quantile(self.z, share, axis=1)])


class NoSurface(ValueError):
    """What is wrong with the cloud, and what would be right."""


def cell_for(points, box):
    """Side of a column in m for that many points over the box."""
    area = (box.x1 - box.x0) * 2 * box.half_width
    return float(np.clip(np.sqrt(POINTS * area / max(points, 1)), CELL_m, COARSEST * CELL_m))


def find_surface(columns, to_rear=False):
    """The Surface of the columns; NoSurface where there is none. `to_rear`: up to the box's end, seen or not."""
    height, seen = column_heights(columns)
    if seen.sum() < 4:
        raise NoSurface("hardly a point is on the bench; a cloud of the face")
    kept, islands = leave_out_islands(columns, height, seen)
    z = fill(height, kept, columns.step)
    first, last, floor = find_bench(columns, z, kept, to_rear)
    part = slice(first, last + 1)
    filled = ~kept[part]
    bench = np.maximum(z[part], 0.0)
    holes, n = ndimage.label(filled)
    hole = np.bincount(holes[holes > 0]).max() * columns.step[0] * columns.step[1] if n else 0.0
    return Surface(columns.x[part], columns.y, bench, filled, columns, first, islands,
                   count_above(columns, z, first, last), floor, float(hole))


def column_heights(columns):
    """(z, seen) of each column."""
    n = columns.counts.shape[2]
    total = columns.counts.cumsum(axis=2, dtype=np.int32)
    points = total[..., -1]

    def up_to(bins):  # points below the upper end of each column's bin
        return np.take_along_axis(total, np.clip(bins, 0, n - 1)[..., None], 2)[..., 0]

    width = round(SUPPORT_m / BIN_m)
    company = total[..., np.minimum(np.arange(n) + width - 1, n - 1)] - total + columns.counts
    need = np.where(points >= 5, np.maximum(2, np.ceil(0.05 * points)), 1)
    low = ((columns.counts > 0) & (company >= need[..., None])).argmax(axis=2)
    before = np.where(low > 0, up_to(low - 1), 0)
    half = before + (up_to(low + round(LAYER_m / BIN_m) - 1) - before) / 2
    at = (total >= half[..., None]).argmax(axis=2)
    below = np.where(at > 0, up_to(at - 1), 0)
    share = (half - below) / np.maximum(up_to(at) - below, 1)
    return columns.z(at + share), points > 0


def leave_out_islands(columns, height, seen):
    """(columns that are kept, islands that are not)."""
    around = fill(height, seen, columns.step)
    spikes = seen & (np.abs(around - ndimage.median_filter(around, 5, mode="nearest")) > STEP_m)
    kept = seen & ~spikes
    z = fill(height, kept, columns.step)
    bumps = z - _opened(z, columns.step) > STEP_m
    # From the highest that is seen beside each place, of what is no bump, up to what is one cell farther in.
    cell = float(columns.step[:2].mean())
    reach = max(1, round(REACH_m / cell))
    beside = ndimage.maximum_filter(np.where(kept & ~bumps, z, NOWHERE_m), 2 * reach + 1, mode="nearest")
    inner = ndimage.maximum_filter(np.where(bumps, z, NOWHERE_m), 3, mode="nearest")
    attached = inner - beside < max(STEP_m, STEEP * (reach + 1) * cell)
    points = columns.counts.sum(axis=2)
    labels, _ = ndimage.label(bumps, np.ones((3, 3)))
    found = []
    for k, at in enumerate(ndimage.find_objects(labels), 1):
        at = tuple(slice(max(0, part.start - 1), part.stop + 1) for part in at)  # with the sides of what stands there
        bump = labels[at] == k
        edge = bump & ~ndimage.binary_erosion(bump, border_value=1) & kept[at]
        if not edge.any() or attached[at][edge].mean() >= ATTACHED:
            continue
        found.append((at, ndimage.binary_dilation(bump, np.ones((3, 3))) & kept[at]))
    for at, whole in found:
        kept[at] &= ~whole
    found += _blobs(spikes)
    left = fill(height, kept, columns.step)
    return kept, sorted((_island(columns, points, height - left, at, whole) for at, whole in found if whole.any()),
                        key=lambda i: -i.area_m2)


def _opened(z, step):
    """Without what is narrower than OBJECT_m in x or y and higher than both its sides; slopes stay."""
    size = [2 * int(np.ceil(OBJECT_m / s / 2)) + 1 for s in step[:2]]
    wide = np.pad(z, [(n, n) for n in size], mode="edge")
    opened = ndimage.grey_opening(wide, size)
    return opened[size[0]:-size[0], size[1]:-size[1]]


def _blobs(mask):
    labels, _ = ndimage.label(mask, np.ones((3, 3)))
    return [(at, labels[at] == k) for k, at in enumerate(ndimage.find_objects(labels), 1)]


def _island(columns, points, off, at, whole):
    i, j = np.nonzero(whole)
    cell = float(columns.step[0] * columns.step[1])
    return Island(int(points[at][whole].sum()), cell * len(i), float(columns.x[at[0]][i].mean()),
                  float(columns.y[at[1]][j].mean()), float(np.quantile(off[at][whole], 0.75)))


def fill(height, kept, step):
    """Heights everywhere: linear between the kept places, and beyond them as at the nearest."""
    if kept.all():
        return height.copy()
    places = np.argwhere(kept) * step[:2]
    out = height.copy()
    missing = np.argwhere(~kept)
    at = missing * step[:2]
    z = np.full(len(at), np.nan)
    if len(np.unique(places[:, 0])) > 1 and len(np.unique(places[:, 1])) > 1:
        z = interpolate.LinearNDInterpolator(places, height[kept])(at)
    far = np.isnan(z)
    if far.any():
        z[far] = interpolate.NearestNDInterpolator(places, height[kept])(at[far])
    out[tuple(missing.T)] = z
    return out


def find_bench(columns, z, kept, to_rear):
    """(first, last) of columns.x: from just before the rock's foot to the rear, and the floor's height before it."""
    z = z.copy()
    z[:int(np.argmax(kept.mean(axis=1) >= SEEN_SHARE))] = 0.0  # not seen before the face: ground
    labels, n = ndimage.label(z > ROCK_m)
    at_shovel = np.isin(range(1, n + 1), labels[0])
    if n == 0:
        raise NoSurface(f"no rock: nothing is more than {ROCK_m} m over the ground, the highest is at z = "
                        f"{z.max():.2f} m; the elevation of the ground for the third number of site.origin_m")
    if at_shovel.all():
        raise NoSurface(f"no toe: rock or what looks like it is {z[0].min():.2f} m or more over the ground right from x"
                        f" = {columns.x[0]:.2f} m, the shovel's place; the ground's elevation for the third "
                        "number of site.origin_m, or a cloud that the shovel does not hide")
    volume = np.where(at_shovel, 0, ndimage.sum_labels(z, labels, range(1, n + 1)))
    bench = labels == 1 + int(np.argmax(volume))
    share = bench.mean(axis=1)
    first = int(np.argmax(share >= min(TOE_SHARE, share.max())))
    last = len(columns.x) - 1
    if not to_rear:
        last = int(np.flatnonzero(kept.mean(axis=1) >= SEEN_SHARE).max(initial=0))
    before = kept[:first] & ~bench[:first]
    floor = float(np.median(z[:first][before])) if before.any() else float("nan")
    if last - first < 2:
        raise NoSurface(f"the bench is seen from x = {columns.x[first]:.2f} m to {columns.x[last]:.2f} m only; "
                        "a face of some metres")
    return first - 1, last, floor


def count_above(columns, z, first, last):
    """Points of the bench more than LAYER_m over all of the surface round them: dust, ropes, a boom."""
    local = ndimage.maximum_filter(z, 3)[first:last + 1] + LAYER_m
    from_bin = np.clip(np.ceil((local + BELOW_m) / BIN_m).astype(int), 0, columns.counts.shape[2])
    over = np.arange(columns.counts.shape[2]) >= from_bin[..., None]
    return int(columns.counts[first:last + 1][over].sum())
