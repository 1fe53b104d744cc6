"""The mine's shovel: planar kinematics and inverse dynamics, as in a textbook of statics.

Frames and signs are those of docs/frames.md: x out to the face, z up, in the boom's plane; the dipper's axes have
x from the door to the lip and z from the floor to the roof. Hoist is rope paid out [m], crowd is the handle pushed
out [m]. The hoist's force is the pull of both ropes together, the crowd's force pushes the handle out.

The dimensions and weights are what a mine reads off its machine's drawings and weighing slips, so they are the
model's (mbs/bucyrus495.yaml). What is the mine's own: how they are put together, the ropes (they have weight, and do
not stretch), the swing's pull on the arm, and the motion between the rows of the logger's table (a cubic spline).
"""
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

G = 9.81


@dataclass(frozen=True)
class Shovel:
    """Lengths in m, masses in kg; points are (x, z), of house, handle (along it from its end) or dipper."""

    sheave: tuple = (16.83, 18.43)
    sheave_radius: float = 1.2
    saddle: tuple = (9.2, 10.8)
    drum: tuple = (-1.5, 6.5)
    rope_length: float = 39.88        # from the drum to the bail at hoist 0
    rope_kg_m: float = 44.0           # both ropes
    reach: float = 7.75               # from the saddle to the handle's end at crowd 0
    handle_mass: float = 36e3
    handle_centre: float = -5.0
    handle_inertia: float = 3.7e5
    rake: float = np.radians(61.8)
    handle_end: tuple = (0.9, 1.9)    # in the dipper
    bail: tuple = (2.6, 1.9)
    dipper_mass: float = 42e3
    dipper_centre: tuple = (1.9, -0.1)
    dipper_inertia: float = 1.4e5
    hinge: tuple = (0.0, 1.5)
    door_mass: float = 8e3
    door_centre: tuple = (-0.1, -1.5)  # from the hinge, shut
    door_inertia: float = 6.1e3


def turned(angle, point):
    """A point (x, z) turned by `angle` from x towards z; both may be arrays over time: (2, ...)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * point[0] - s * point[1], s * point[0] + c * point[1]])


class Motion:
    """The logger's table of the four drives as smooth functions of time: a cubic spline, at rest at its ends."""

    def __init__(self, table):
        """table: (rows, 5), time_s, hoist_m, crowd_m, swing_deg, door_deg."""
        table = np.array(table, float)
        table[:, 3:] = np.radians(table[:, 3:])
        self.end = table[-1, 0]
        self._at = CubicSpline(table[:, 0], table[:, 1:], bc_type="clamped")

    @classmethod
    def read(cls, file):
        lines = [line for line in open(file).read().splitlines() if line and not line.startswith("#")]
        return cls([[float(x) for x in line.split(",")] for line in lines[1:]])

    def __call__(self, t, order=0):
        """(4, ...): hoist [m], crowd [m], swing [rad], door [rad], or their time derivative of that order."""
        inside = np.clip(t, 0.0, self.end)
        return np.moveaxis(self._at(inside, order), -1, 0)

    def passes(self):
        """[(start, dump, end)] in s: from one shutting of the door to the next; the dump begins as it opens."""
        t = np.arange(0.0, self.end, 0.005)
        is_open = (self(t)[3] > np.radians(1.0)).astype(int)
        opens, shuts = t[1:][np.diff(is_open) == 1], t[1:][np.diff(is_open) == -1]
        return list(zip(np.append(0.0, shuts[:-1]), opens, shuts))


def rope_run(shovel, bail):
    """Length [m] of the taut rope from drum over sheave to a bail (2, ...), the unit vector along it off the bail, and
    its free length [m].
    """
    r = shovel.sheave_radius
    a = np.array(shovel.drum) - shovel.sheave
    b = np.array([bail[0] - shovel.sheave[0], bail[1] - shovel.sheave[1]])
    la, lb = np.hypot(*a), np.hypot(*b)
    on_a = np.arctan2(a[1], a[0]) - np.arccos(r / la)      # where the rope from the drum meets the sheave
    on_b = np.arctan2(b[1], b[0]) + np.arccos(r / lb)      # and where it leaves for the bail
    free = np.sqrt(lb**2 - r**2)
    toward = (r * np.array([np.cos(on_b), np.sin(on_b)]) - b) / free
    return np.sqrt(la**2 - r**2) + r * np.mod(on_a - on_b, 2 * np.pi) + free, toward, free


class Arm:
    """Where handle and dipper are at times t, in the boom's plane."""

    def __init__(self, shovel, motion, t):
        self.shovel, self.t = shovel, np.atleast_1d(np.asarray(t, float))
        self.hoist, self.crowd, self.swing, self.door = motion(self.t)
        self.pitch = self._pitch()
        self.out = np.array([np.cos(self.pitch), np.sin(self.pitch)])
        self.end = np.array(shovel.saddle)[:, None] + (shovel.reach + self.crowd) * self.out
        self.tilt = self.pitch + shovel.rake                # of the dipper's x axis above the level
        self.origin = self.end - turned(self.tilt, shovel.handle_end)

    def _pitch(self):
        """Of the handle, by bisection: the higher it is, the shorter is the rope."""
        s = self.shovel
        low, high = np.full_like(self.t, -np.pi / 2), np.full_like(self.t, np.radians(25))
        for _ in range(50):
            pitch = 0.5 * (low + high)
            end = (np.array(s.saddle) + ((s.reach + self.crowd) * np.array([np.cos(pitch), np.sin(pitch)])).T).T
            offset = np.array(s.bail) - np.array(s.handle_end)
            long = rope_run(s, end + turned(pitch + s.rake, offset))[0] > s.rope_length + self.hoist
            low, high = np.where(long, pitch, low), np.where(long, high, pitch)
        return 0.5 * (low + high)

    def point(self, place):
        """(2, n): a point of the dipper in the boom's plane."""
        return self.origin + turned(self.tilt, place)

    def pose(self, i):
        """Origin (3,) and axes (3, 3, columns) of the dipper in the world at time t[i]."""
        c, s = np.cos(self.swing[i]), np.sin(self.swing[i])
        house = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        ct, st = np.cos(self.tilt[i]), np.sin(self.tilt[i])
        tilt = np.array([[ct, 0, -st], [0, 1, 0], [st, 0, ct]])
        return house @ np.array([self.origin[0, i], 0.0, self.origin[1, i]]), house @ tilt


def moment(arm, force):
    """About y, positive lifts: x towards z."""
    return arm[0] * force[1] - arm[1] * force[0]


def drive_forces(arm, rock, load_kg, load_centre, slope=0.0):
    """Pull of the hoist and push of the crowd [N] by inverse dynamics, (2, n).

    arm: an Arm over evenly spaced times. rock: (3, n) what the rock does to the dipper in the boom's plane: force along
    the dipper's x and z [N] and moment about its origin [N m], positive lifts. load_kg (n,) and load_centre (2,) in the
    dipper: a load that rides with it. slope: rad, of the ground the machine stands on, nose up.
    """
    s, t = arm.shovel, arm.t
    saddle = np.array(s.saddle)[:, None]

    def rate(x):
        return np.gradient(x, t, axis=-1)
    spin = rate(rate(arm.pitch))
    turn = rate(arm.swing)
    hinge = arm.point(s.hinge)
    door = hinge + turned(arm.tilt - arm.door, s.door_centre)
    bail = arm.point(s.bail)
    _, toward, free = rope_run(s, bail)
    bodies = [(s.handle_mass, arm.end + s.handle_centre * arm.out, s.handle_inertia),
              (s.dipper_mass, arm.point(s.dipper_centre), s.dipper_inertia),
              (s.door_mass, door, s.door_inertia),
              (np.asarray(load_kg), arm.point(load_centre), 0.0),
              (0.5 * s.rope_kg_m * free, bail, 0.0)]       # half of the free rope hangs on the bail
    lift, push = np.zeros_like(t), np.zeros_like(t)
    for mass, at, inertia in bodies:
        still = rate(rate(at))
        still[0] -= turn**2 * at[0]                          # towards the swing's axis
        still[0] += G * np.sin(slope)
        still[1] += G * np.cos(slope)
        need = mass * still
        lift += moment(at - saddle, need) + inertia * spin
        push += (need * arm.out).sum(axis=0)
    force = turned(arm.tilt, rock[:2])
    lift -= moment(arm.origin - saddle, force) + rock[2]
    push -= (force * arm.out).sum(axis=0)
    pull = np.maximum(0.0, lift / moment(bail - saddle, toward))  # ropes do not push
    return np.array([pull, push - pull * (toward * arm.out).sum(axis=0)])


def with_rake(shovel, degrees):
    return replace(shovel, rake=shovel.rake + np.radians(degrees))
