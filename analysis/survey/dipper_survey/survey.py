"""A cloud in a file to the surface of a case's bench: two times through the file, in parts."""
from dataclasses import dataclass

import numpy as np

from dipper_run.findings import BadInput, Findings

from .cloud import open_cloud
from .elsewhere import may_be
from .surface import CELL_m, COARSEST, Box, Columns, NoSurface, cell_for, find_surface

MOST_CELLS = 2e7   # of counts: 80 MB, and some times that while they are evaluated
TOP_m = 1.0        # of the box over the highest point
STEPS_m = (100, 50, 10, 5, 1, 0.5, 0.25, 0.125)  # to which exports round coordinates
DEEP_m = 1.0       # under the ground: no floor
FLOOR_m = 0.25     # of the scanned floor off the ground: the elevation is doubtful
TURNED_deg = 15.0  # of the face's rise off the dig's direction: the azimuth is doubtful
FLAT_deg, STEEP_deg = 15.0, 60.0  # of a face: blasted rock rests at 30 to 45
LOW_m = 1.0        # a bench lower than that over a long way from its toe on is a floor that slopes
LOW_LONG_m = 4.0
BEHIND_TOE_m = 2.0
ZEROS = 0.002      # of the points over the bench: more that are exactly 0 are no measurements


@dataclass(frozen=True)
class Looked:
    """What a first look at a cloud showed."""

    points: int
    none: int            # rows without numbers: nothing came back
    low: np.ndarray      # least and largest coordinates in the file, in W, m
    high: np.ndarray
    local_low: np.ndarray
    local_high: np.ndarray
    on_bench: int        # over the box, from the ground up
    under: int           # under that, deeper than any floor is scanned
    top: float           # highest point over the box
    steps: tuple         # of x, y and z in the file; 0: none that shows
    spread: float        # points over the box that, evenly spread, would leave as many places without one


@dataclass(frozen=True)
class Survey:
    surface: object      # surface.Surface
    looked: Looked
    kind: str
    notes: list


def survey(path, site, box, to_rear=False):
    """The Survey of a cloud's file over a Box of W; BadInput. What `dipper survey` makes, and what gives a measured
    folder's profile.csv its sections (`Survey.surface.section`)."""
    found = Findings()
    cloud = open_cloud(path, found)
    found.raise_if_any()
    looked = look(cloud, site, box)
    if looked.on_bench == 0:
        raise BadInput([_nothing_there(path, cloud, looked, site, box)])
    if looked.under > looked.on_bench:
        raise BadInput([f"{path}: cloud: {looked.under:,} of its points are more than {DEEP_m:g} m under the ground of "
                        f"the case, z = 0, and {looked.on_bench:,} over it; is site.origin_m's elevation another?"])
    box = Box(box.x0, box.x1, box.half_width, float(min(box.top, max(looked.top, 0) + TOP_m)))
    cell = max(cell_for(looked.spread, box), *(min(s, 1.0) for s in looked.steps[:2]))
    while (box.x1 - box.x0) * 2 * box.half_width / cell ** 2 * (box.top + 3) / 0.05 > MOST_CELLS:
        cell *= 1.1
    columns, zero_x = Columns(box, cell), []
    for part in cloud.parts():
        part = part[np.isfinite(part).all(axis=1)]
        local = site.to_world(part)
        columns.add(local)
        zero_x.append(local[(part[:, 2] == 0) & _over(box, local), 0])
    try:
        surface = find_surface(columns, to_rear)
    except NoSurface as e:
        raise BadInput([f"{path}: face: {e}; in W the cloud has {_span(looked.local_low, looked.local_high)}",
                        *(f"{path}: cloud: {note}" for note in _steps(looked))]) from e
    return Survey(surface, looked, cloud.kind, [
        *cloud.notes, *_warnings(looked, surface, cell), *_warn_of_zeros(np.concatenate(zero_x), looked, surface)])


def look(cloud, site, box):
    """The Looked of a cloud."""
    points = none = on_bench = under = 0
    low, high = np.full(6, np.inf), np.full(6, -np.inf)
    top, steps = -np.inf, None
    places = _Places(box)
    for part in cloud.parts():
        sound = np.isfinite(part).all(axis=1)
        points, none = points + len(part), none + int((~sound).sum())
        part = part[sound]
        if not len(part):
            continue
        both = np.hstack([part, site.to_world(part)])
        low, high = np.minimum(low, both.min(axis=0)), np.maximum(high, both.max(axis=0))
        there = _over(box, both[:, 3:])
        under += int((_beside(box, both[:, 3:]) & (both[:, 5] <= -DEEP_m)).sum())
        on_bench += int(there.sum())
        if there.any():
            top = max(top, float(both[there, 5].max()))
            mine = tuple(_step(column) for column in part[there].T)
            steps = mine if steps is None else tuple(map(min, steps, mine))
            places.add(both[there, 3:5])
    return Looked(points, none, low[:3], high[:3], low[3:], high[3:], on_bench, under, top, steps or (0, 0, 0),
                  min(on_bench, places.spread()))


class _Places:
    """Which squares of CELL_m a cloud has points in. Duplicates and the lines of a scanner are many points on few
    places, and their number does not tell how fine a surface they give."""

    def __init__(self, box):
        self.low = np.array([box.x0, -box.half_width])
        wide = CELL_m * COARSEST
        n = [max(1, int(np.ceil(length / wide))) for length in (box.x1 - box.x0, 2 * box.half_width)]
        self.taken = np.zeros([COARSEST * k for k in n], bool)

    def add(self, points):
        i, j = np.minimum((points - self.low) // CELL_m, np.array(self.taken.shape) - 1).astype(int).T
        self.taken[i, j] = True

    def spread(self):
        """Of points spread evenly, n a square in the mean, a share exp(-n) of the squares is empty: Poisson."""
        nx, ny = (k // COARSEST for k in self.taken.shape)
        shares = self.taken.reshape(nx, COARSEST, ny, COARSEST).mean(axis=(1, 3))
        share = shares[shares > 0].mean() if shares.any() else 0.0
        return float(-np.log(1 - share) * self.taken.size) if share < 1 else np.inf


def _beside(box, local):
    return (local[:, 0] >= box.x0) & (local[:, 0] <= box.x1) & (np.abs(local[:, 1]) <= box.half_width)


def _over(box, local):
    return _beside(box, local) & (local[:, 2] > -DEEP_m) & (local[:, 2] <= box.top)


def _step(values):
    """The largest of STEPS_m whose multiples all of the values are, where they differ; else 0."""
    if len(values) < 10 or np.ptp(values) == 0:
        return 0

    def fits(step):
        return np.ptp(values) >= step and (np.abs(values / step - np.round(values / step)) < 1e-6).all()

    return next(filter(fits, STEPS_m), 0)


def _span(low, high):
    return ", ".join(f"{axis} {a:.1f} to {b:.1f}" for axis, a, b in zip("xyz", low, high))


def _nothing_there(path, cloud, looked, site, box):
    said = (f"{path}: cloud: none of its {looked.points:,} points is over the bench, x {box.x0:g} to {box.x1:g} m, y "
            f"{-box.half_width:g} to {box.half_width:g} m, z {-DEEP_m:g} to {box.top:g} m in W; ")
    if looked.points == looked.none:
        return said + "no row has three numbers that are finite"
    said += (f"in the file it has {_span(looked.low, looked.high)}, in W "
             f"{_span(looked.local_low, looked.local_high)}; ")
    return said + may_be(cloud, looked, site, lambda points: _over(box, points))


def _steps(looked):
    """The message on coordinates in steps."""
    return [f"{axis} stand{'s' * (axis != 'heights')} in steps of {step:g} m: a grid, or coordinates that an export "
            "has rounded (single precision, too few digits)"
            for axis, step in zip(("x", "y", "heights"), looked.steps) if step]


def _warn_of_zeros(x, looked, surface):
    """Of points within the bench whose elevation is exactly 0 in the file, at `x`."""
    within = int((x > surface.x[0] + BEHIND_TOE_m).sum())
    if within > ZEROS * looked.on_bench:
        yield (f"warning: {within:,} points more than {BEHIND_TOE_m:g} m behind the toe have an elevation of exactly "
               "0: no data? The surface has a hole there; leave them out")


def _warnings(looked, surface, cell):
    notes = [f"warning: {note}" for note in _steps(looked)]
    if abs(surface.floor_m) > FLOOR_m:
        notes.append(f"warning: the floor in front of the toe is at z = {surface.floor_m:.2f} m, and the case's ground "
                     f"at 0: is the elevation in site.origin_m right? {abs(surface.floor_m):.2f} m "
                     f"{'more' if surface.floor_m > 0 else 'less'} would level it")
    share = surface.filled.mean()
    if share > 0.3:
        notes.append(f"warning: {100 * share:.0f} % of the bench is not seen and filled from what is: scan it from "
                     "another place as well, or make pile.width_m less")
    if cell > 2 * CELL_m:
        notes.append(f"warning: the cloud is thin or uneven: {looked.on_bench:,} points over the bench give a height "
                     f"each {cell:.2g} m")
    angle, turned = surface.face_deg
    if abs(turned) > TURNED_deg:
        notes.append(f"warning: the face rises {abs(turned):.0f} degrees to the {'left' if turned > 0 else 'right'} of "
                     "the dig: is site.azimuth_deg clockwise from grid north?")
    if angle > STEEP_deg or angle < FLAT_deg:
        notes.append(f"warning: the face stands at {angle:.0f} degrees, and blasted rock rests at 30 to 45: are the "
                     "elevations in another unit than easting and northing?")
    high = np.flatnonzero(np.median(surface.z, axis=1) > LOW_m)
    low_m = surface.x[high[0] if len(high) else -1] - surface.x[0]
    if low_m > LOW_LONG_m:
        notes.append(f"warning: the bench is less than {LOW_m:g} m high over its first {low_m:.1f} m: does the floor "
                     "slope? The case's ground is level, and what is over it becomes rock")
    return notes
