"""A cloud in a file to the surface of a case's bench: two times through the file, in parts."""
from dataclasses import dataclass

import numpy as np

from dipper_run.findings import BadInput, Findings

from .cloud import open_cloud
from .site import Site
from .surface import CELL_m, Box, Columns, NoSurface, cell_for, find_surface

MOST_CELLS = 2e7   # of counts: 80 MB, and some times that while they are evaluated
TOP_m = 1.0        # of the box over the highest point
STEPS_m = (100, 50, 10, 5, 1, 0.5, 0.25, 0.125)  # to which exports round coordinates
DEEP_m = 1.0       # under the ground: no floor
FLOOR_m = 0.25     # of the scanned floor off the ground: the elevation is doubtful


@dataclass(frozen=True)
class Looked:
    """What a first look at a cloud told."""

    points: int
    none: int            # rows without numbers: nothing came back
    low: np.ndarray      # least and largest coordinates in the file, in W, m
    high: np.ndarray
    local_low: np.ndarray
    local_high: np.ndarray
    on_bench: int        # over the box, from the ground up
    under: int           # under that, deeper than any floor is scanned
    swapped: int         # the same with the first two coordinates exchanged
    top: float           # highest point over the box
    steps: tuple         # of x, y and z in the file; 0: none that shows


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
        raise BadInput([_nothing_there(path, looked, site, box)])
    if looked.under > looked.on_bench:
        raise BadInput([f"{path}: cloud: {looked.under:,} of its points are more than {DEEP_m:g} m under the ground of "
                        f"the case, z = 0, and {looked.on_bench:,} over it; is site.origin_m's elevation another?"])
    box = Box(box.x0, box.x1, box.half_width, float(min(box.top, max(looked.top, 0) + TOP_m)))
    cell = max(cell_for(looked.on_bench, box), *(min(s, 1.0) for s in looked.steps[:2]))
    while (box.x1 - box.x0) * 2 * box.half_width / cell ** 2 * (box.top + 3) / 0.05 > MOST_CELLS:
        cell *= 1.1
    columns = Columns(box, cell)
    for part in cloud.parts():
        columns.add(site.to_world(part[np.isfinite(part).all(axis=1)]))
    try:
        surface = find_surface(columns, to_rear)
    except NoSurface as e:
        raise BadInput([f"{path}: face: {e}"]) from e
    return Survey(surface, looked, cloud.kind, [*cloud.notes, *_doubts(looked, surface, cell)])


def look(cloud, site, box):
    """The Looked of a cloud."""
    points = none = on_bench = under = swapped = 0
    low, high = np.full(6, np.inf), np.full(6, -np.inf)
    top, steps = -np.inf, None
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
        swapped += int(_over(box, site.to_world(part[:, [1, 0, 2]])).sum())
    return Looked(points, none, low[:3], high[:3], low[3:], high[3:], on_bench, under, swapped, top, steps or (0, 0, 0))


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


def _nothing_there(path, looked, site, box):
    said = (f"{path}: cloud: none of its {looked.points:,} points is over the bench, x {box.x0:g} to {box.x1:g} m, y "
            f"{-box.half_width:g} to {box.half_width:g} m, z {-DEEP_m:g} to {box.top:g} m in W; ")
    if looked.points == looked.none:
        return said + "no row has three numbers that are finite"
    said += (f"in the file it has {_span(looked.low, looked.high)}, in W "
             f"{_span(looked.local_low, looked.local_high)}; ")
    if looked.swapped:
        return said + (f"with the first two columns exchanged {looked.swapped:,} points are there: name them in a "
                       "header, northing,easting,elevation")
    extent = float((looked.high - looked.low).max())
    if extent > 2e3:
        return said + f"it is {extent:.0f} m wide: is it in millimetres? The coordinates are to be in metres"
    if site == Site():
        return said + ("say where W lies in the mine's coordinates: site.origin_m and site.azimuth_deg in the case, or "
                       "--origin and --azimuth")
    return said + ("is site.origin_m (easting, northing, elevation) or site.azimuth_deg another? Are x, y and z the "
                   "first columns of the file, or named in a header?")


def _doubts(looked, surface, cell):
    notes = []
    for axis, step in zip(("x", "y", "heights"), looked.steps):
        if step:
            notes.append(f"warning: {axis} stand{'s' * (axis != 'heights')} in steps of {step:g} m: a grid, or "
                         "coordinates that an export has rounded (single precision, too few digits)")
    if abs(surface.floor_m) > FLOOR_m:
        notes.append(f"warning: the floor in front of the toe is at z = {surface.floor_m:.2f} m, and the case's ground "
                     f"at 0: is the elevation in site.origin_m right? {abs(surface.floor_m):.2f} m "
                     f"{'more' if surface.floor_m > 0 else 'less'} would level it")
    share = surface.filled.mean()
    if share > 0.3:
        notes.append(f"warning: {100 * share:.0f} % of the bench is not seen and filled from what is: scan it from "
                     "another place as well, or make pile.width_m less")
    if cell > 2 * CELL_m:
        notes.append(f"warning: the cloud is thin: {looked.on_bench:,} points over the bench give a height each "
                     f"{cell:.2g} m")
    return notes
