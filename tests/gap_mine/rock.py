"""The mine's rock: spheres and clumps of two to four equal spheres, of continuous sizes, as arrays and in YADE.

Rock is kept as arrays, so that a bench can be stored and a scene be made of a part of it. YADE is imported by the
functions that need it: they run under `yade -x -n` alone.
"""
from dataclasses import dataclass, field

import numpy as np

# Members of a shape of n spheres of radius 1, about their middle.
SHAPES = {1: np.zeros((1, 3)),
          2: 0.75 * np.array([[-1.0, 0, 0], [1, 0, 0]]),
          3: 0.80 * np.array([[np.cos(a), np.sin(a), 0] for a in 2 * np.pi / 3 * np.arange(3)]),
          4: 0.55 * np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])}


def _union(members):
    """Volume of the union of spheres of radius 1 about members, m^3, within 0.3 %."""
    half = np.abs(members).max() + 1
    x = (np.stack(np.meshgrid(*[(np.arange(90) + 0.5) / 90 * 2 - 1] * 3), -1) * half).reshape(-1, 3)
    inside = (((x[:, None] - members) ** 2).sum(-1) < 1).any(1)
    return inside.mean() * (2 * half) ** 3


VOLUME = {n: _union(m) for n, m in SHAPES.items()}


@dataclass(frozen=True)
class Material:
    """Hertz-Mindlin contacts; the friction makes the pile's angle, the density the box's weight (calibrate.py)."""

    density: float = 3551.0      # of a rock, kg/m^3
    friction: float = 0.45       # rock on rock and on the ground
    steel: float = 0.45          # rock on the dipper
    young: float = 2e8           # Pa: soft, for the step; 0.2 MN presses two of the least rocks 28 mm together
    poisson: float = 0.2
    restitution: float = 0.3
    step: float = 1.6e-3         # s


@dataclass(frozen=True)
class Grading:
    """(least and largest diameter of equal volume [m], share of mass, {spheres: share of rocks})."""

    classes: tuple = ((0.68, 0.84, 0.37, {1: 0.5, 2: 0.5}),
                      (0.84, 1.04, 0.25, {2: 0.5, 3: 0.5}),
                      (1.04, 1.20, 0.38, {3: 0.4, 4: 0.6}))

    def draw(self, volume, rng):
        """Diameters and numbers of spheres of rocks of `volume` m^3 together, in an order of chance."""
        rocks = []
        for low, high, share, shapes in self.classes:
            left = share * volume
            while left > 0:
                d = low * (high / low) ** rng.random()
                left -= np.pi / 6 * d**3
                rocks.append((d, int(rng.choice(list(shapes), p=list(shapes.values())))))
        return [rocks[k] for k in rng.permutation(len(rocks))]

    def scaled(self, factor):
        return Grading(tuple((a * factor, b * factor, *rest) for a, b, *rest in self.classes))


@dataclass
class Rocks:
    """count (N,) spheres of each; radius (N,) of them; members: N arrays (count, 3) of centres in the world."""

    count: np.ndarray
    radius: np.ndarray
    members: list = field(default_factory=list)

    def __len__(self):
        return len(self.count)

    def centres(self):
        return np.array([m.mean(axis=0) for m in self.members]).reshape(-1, 3)

    def volumes(self):
        return np.array([VOLUME[n] for n in self.count]) * self.radius**3

    def take(self, which):
        which = np.flatnonzero(which) if np.asarray(which).dtype == bool else which
        return Rocks(self.count[which], self.radius[which], [self.members[k] for k in which])

    def moved(self, by):
        return Rocks(self.count, self.radius, [m + np.asarray(by, float) for m in self.members])

    def save(self, file):
        np.savez_compressed(file, count=self.count, radius=self.radius, members=np.concatenate(self.members))

    @classmethod
    def load(cls, file):
        data = np.load(file)
        ends = np.cumsum(data["count"])
        return cls(data["count"], data["radius"], np.split(data["members"], ends[:-1]))

    def surface(self, x, y):
        """Height of the rock's top at points (x, y), 0 where there is none."""
        centres, radius = np.concatenate(self.members), np.repeat(self.radius, self.count)
        top = np.zeros(len(x))
        for k, (px, py) in enumerate(zip(x, y)):
            left = radius**2 - (centres[:, 0] - px) ** 2 - (centres[:, 1] - py) ** 2
            under = left > 0
            if under.any():
                top[k] = (centres[under, 2] + np.sqrt(left[under])).max()
        return top

    def filled(self, points):
        """Share of points (n, 3) that lie in rock."""
        from scipy.spatial import cKDTree
        centres, radius = np.concatenate(self.members), np.repeat(self.radius, self.count)
        near = cKDTree(centres).query_ball_point(points, radius.max())
        return np.mean([any(((centres[k] - p) ** 2).sum() < radius[k] ** 2 for k in ks) for p, ks in zip(points, near)])


def strewn(grading, volume, sites, rng):
    """Rocks of `volume` on sites (n, 3), in the sites' order, each turned by chance; sites must be far enough apart."""
    drawn = grading.draw(volume, rng)
    if len(drawn) > len(sites):
        raise ValueError(f"{len(drawn)} rocks for {len(sites)} sites: more sites")
    count = np.array([n for _, n in drawn])
    radius = np.array([0.5 * d * (np.pi * 4 / 3 / VOLUME[n]) ** (1 / 3) for d, n in drawn])
    members = []
    for n, r, site in zip(count, radius, sites):
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        members.append(site + r * SHAPES[n] @ (turn * np.sign(np.linalg.det(turn))).T)
    return Rocks(count, radius, members)


class Scene:
    """Rock and walls in YADE. Under `yade -x -n` only; one at a time."""

    def __init__(self, material, damping=0.0):
        import yade
        from yade import utils
        self.yade, self.utils, self.material = yade, utils, material
        self.O = yade.O  # noqa: E741
        self.O.reset()
        self.ids = []                    # of each rock: its clump, or its one sphere
        self._of_kind = {}
        self.steel = self._frict(7800, material.steel)
        self.ground = self._frict(2600, material.friction)
        self.slick = self._frict(2600, 0.0)
        self.newton = yade.NewtonIntegrator(damping=damping, gravity=(0, 0, -9.81))
        self.before, self.after = [], []
        self.O.dt = material.step

    def _frict(self, density, friction):
        m = self.material
        return self.O.materials.append(self.yade.FrictMat(young=m.young, poisson=m.poisson, density=float(density),
                                                          frictionAngle=float(np.arctan(friction))))

    def start(self):
        """Makes the engines, once all is in."""
        y, e = self.yade, self.material.restitution
        self.O.engines = [y.ForceResetter(),
                          y.InsertionSortCollider([y.Bo1_Sphere_Aabb(), y.Bo1_Facet_Aabb(), y.Bo1_Wall_Aabb()],
                                                  verletDist=0.06),
                          y.InteractionLoop([y.Ig2_Sphere_Sphere_ScGeom(), y.Ig2_Facet_Sphere_ScGeom(),
                                             y.Ig2_Wall_Sphere_ScGeom()],
                                            [y.Ip2_FrictMat_FrictMat_MindlinPhys(en=e, es=e)],
                                            [y.Law2_ScGeom_MindlinPhys_Mindlin()]),
                          *self.before, self.newton, *self.after]

    def wall(self, position, axis, material=None):
        return self.O.bodies.append(self.utils.wall(float(position), axis,
                                                    material=self.ground if material is None else material))

    def facets(self, corners, material):
        """Ids of facets (n, 3, 3) that stand where they are until their speeds are set."""
        return [self.O.bodies.append(self.utils.facet([tuple(map(float, p)) for p in c], fixed=True, material=material))
                for c in corners]

    def add(self, rocks, held=None):
        """Adds rocks; those `held` (N,) bool stay where they are."""
        held = np.zeros(len(rocks), bool) if held is None else held
        for n, r, members, still in zip(rocks.count, rocks.radius, rocks.members, held):
            if n not in self._of_kind:  # a member carries its part of the mass of the union
                self._of_kind[n] = self._frict(self.material.density * VOLUME[n] / (n * np.pi * 4 / 3),
                                               self.material.friction)
            spheres = [self.utils.sphere(tuple(map(float, p)), float(r), material=self._of_kind[n]) for p in members]
            one = self.O.bodies.append(spheres[0]) if n == 1 else self.O.bodies.appendClumped(spheres,
                                                                                              discretization=0)[0]
            if still:
                self.O.bodies[one].state.blockedDOFs = "xyzXYZ"
            self.ids.append((one, [one] if n == 1 else sorted(self.O.bodies[one].shape.members)))

    def rocks(self, like):
        """The rocks that were added, `like` them in kind, where they are now."""
        now = [np.array([self.O.bodies[k].state.pos for k in members]) for _, members in self.ids]
        return Rocks(like.count, like.radius, now)

    def remove(self, which):
        for k in sorted(np.flatnonzero(which), reverse=True):
            one, members = self.ids.pop(k)
            self.O.bodies.erase(one, True) if len(members) > 1 else self.O.bodies.erase(one)

    def speeds(self):
        """(N,) m/s of the rocks."""
        return np.array([np.linalg.norm(self.O.bodies[one].state.vel) for one, _ in self.ids])

    def run(self, seconds):
        self.O.run(max(1, int(round(seconds / self.O.dt))), True)
