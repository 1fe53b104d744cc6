"""The mine's bench: rock strewn over an outline taller than it, that falls, settles and is trimmed to it."""
from dataclasses import dataclass

import numpy as np

from rock import Scene, strewn

COLUMNS = 5      # that the rock falls in
OVERFILL = 0.67  # rock, of the outline's volume, before it is trimmed
PROUD_M = 0.25   # centres of rock may stand so far above the outline: the surface lies at it in the mean


@dataclass(frozen=True)
class Outline:
    """The surveyed face [m], as the model has it (cases/screening): what a mine's survey gives to both."""

    toe: float = 13.5
    height: float = 8.5
    width: float = 20.0
    crest: float = 2.0
    angle: float = np.radians(35.0)

    @property
    def rear(self):
        return self.toe + self.height / np.tan(self.angle) + self.crest

    def top(self, x):
        return np.clip((x - self.toe) * np.tan(self.angle), 0.0, self.height)

    def volume(self):
        return self.width * self.height * (0.5 * self.height / np.tan(self.angle) + self.crest)


def boxed(scene, outline):
    """Ground with friction; planes without it at the sides and the rear."""
    scene.wall(0.0, 2)
    for y in (-0.5, 0.5):
        scene.wall(y * outline.width, 1, scene.slick)
    scene.wall(outline.rear, 0, scene.slick)


def settled_bench(material, grading, outline, seed, log=print):
    """Rocks at rest in the outline. Curtains hang down to it while the rock falls, so that it does not run out."""
    rng = np.random.default_rng([seed, 1])
    largest = max(c[1] for c in grading.classes)
    pitch = 1.16 * largest
    ny = int(outline.width / pitch)
    fronts = np.linspace(outline.toe, outline.rear, COLUMNS + 1)[:-1]
    column = (outline.rear - outline.toe) / COLUMNS
    x = np.concatenate([fronts + 0.5 * (column - pitch), fronts + 0.5 * (column + pitch)])
    x, y, k = np.meshgrid(x, -outline.width / 2 + (np.arange(ny) + 0.5) * outline.width / ny, np.arange(60),
                          indexing="ij")
    sites = np.stack([x, y, 0.55 * largest + 0.98 * pitch * k], -1).reshape(-1, 3)
    behind = fronts[np.searchsorted(fronts, sites[:, 0]) - 1] + 0.6 * column
    sites = sites[np.argsort(sites[:, 2] / outline.top(behind) + 0.05 * rng.random(len(sites)))]
    rocks = strewn(grading, OVERFILL * outline.volume(), sites, rng)
    scene = Scene(material, damping=0.3)
    boxed(scene, outline)
    half, top = outline.width / 2, 80.0
    curtains = []
    for front in fronts:
        a, b, c, d = ((front, s * half, z) for s, z in ((-1, float(outline.top(front))), (1, float(outline.top(front))),
                                                        (1, top), (-1, top)))
        curtains += scene.facets(np.array([[a, b, c], [a, c, d]]), scene.slick)
    scene.add(rocks)
    scene.start()
    for seconds, damping in ((3.4, 0.3), (1.2, 0.2), (0.4, 0.0)):
        scene.newton.damping = damping
        scene.run(seconds)
        c = scene.rocks(rocks).centres()
        above = (c[:, 2] > outline.top(c[:, 0]) + PROUD_M) | (c[:, 0] < outline.toe)
        log(f"bench of seed {seed}: {len(rocks)} rocks, {above.sum()} above the outline, 19 of 20 slower than "
            f"{np.percentile(scene.speeds(), 95):.3f} m/s")
        scene.remove(above)
        rocks = rocks.take(~above)
        for k in curtains:
            scene.O.bodies.erase(k)
        curtains = []
    return scene.rocks(rocks)


def section(rocks, heading, reach=(12.0, 27.0), step=0.5, half_width=2.0):
    """(n, 2): the median over a lane of the height of the rock [m], in the boom's plane at a heading."""
    out = np.arange(reach[0], reach[1], step)
    across = np.linspace(-half_width, half_width, 9)
    c, s = np.cos(heading), np.sin(heading)
    x, y = np.meshgrid(out, across, indexing="ij")
    top = rocks.surface((c * x - s * y).ravel(), (s * x + c * y).ravel()).reshape(x.shape)
    return np.c_[out, np.median(top, axis=1)]
