"""A truck's cycle from its stored digs: what the drives of the mine's machine do, before any instrument.

A dig's wrench is DEM's; between digs the load is carried, dumped and the empty dipper brought back by statics. What
is hidden in the machine or in the load (effects.py) is laid over here, by a Hidden.
"""
import json
from dataclasses import dataclass, field

import numpy as np

from rock import Material
from shovel import Arm, Motion, Shovel, drive_forces

RATE_HZ = 20.0
G = 9.81
WEIGHED_S = 0.8       # before the end of a dig: the dipper is clear of the rock, and its load is weighed
DUMP_S = 1.5          # a load takes to fall, from the opening of the door
LOAD_CENTRE = (1.9, -0.2)  # of a load in the dipper, where the dig's end does not show it


@dataclass
class Dig:
    """A stored dig: table as dig.py has it, and the face before and after it."""

    table: np.ndarray
    face: np.ndarray
    seed: int = 0

    @classmethod
    def load(cls, folder, number):
        """A dig that was made before the last calibration of the density is scaled to it (effects.rock_density)."""
        made = json.loads((folder / "run.json").read_text())
        table = np.loadtxt(folder / f"pass_{number}.csv.gz", delimiter=",", skiprows=1)
        table[:, 1:8] *= Material().density * made["keys"]["density"] / made["material"]["density"]
        return cls(table, np.loadtxt(folder / f"face_{number}.csv", delimiter=",", skiprows=1), int(folder.name))

    def weight(self):
        """Mean force [N] along the dipper's x and z and moment [N m] about its origin, at the end of the dig."""
        late = self.table[:, 0] > self.table[-1, 0] - WEIGHED_S
        return self.table[late][:, [1, 3, 5]].mean(axis=0)


@dataclass
class Cycle:
    """At RATE_HZ: drives and forces of one truck, and the tonnes of each pass."""

    time_s: np.ndarray
    drives: np.ndarray       # (4, n): hoist m, crowd m, swing rad, door rad
    forces: np.ndarray       # (2, n): hoist, crowd, N
    load_kg: np.ndarray      # (n,) that rides in the dipper outside the digs
    passes: list             # (start, dump, end) s
    dumped_kg: np.ndarray    # what fell from the dipper over the truck, a pass
    arm: object


@dataclass
class Hidden:
    """What may differ in machine and load; each function gets and gives back arrays."""

    shovel: Shovel = field(default_factory=Shovel)
    heavier: float = 1.0                 # all rock
    stuck_kg: tuple = (0.0, 0.0, 0.0)    # in the dipper from each pass on
    lost_kg: tuple = (0.0, 0.0, 0.0)     # of each pass's load, for lack of room
    leak_per_s: float = 0.0              # of the load, from the end of the dig to the dump
    kept: float = 0.0                    # of a load, after the dump
    slope_rad: float = 0.0               # of the ground the machine stands on, nose up


def dig_spans(digs, motion):
    """(begin, end) in s of each dig's table, on the truck's clock."""
    return [(34.0 * k + d.table[0, 0], 34.0 * k + d.table[-1, 0]) for k, d in enumerate(digs)]


def cycle(digs, motion, hidden=None):
    """The truck of these digs, one a pass."""
    hidden = hidden or Hidden()
    t = np.arange(0.5 / RATE_HZ, motion.end, 1 / RATE_HZ)  # a reading is the mean about it
    arm = Arm(hidden.shovel, motion, t)
    rock, load = np.zeros((3, len(t))), np.zeros(len(t))
    dumped = []
    for k, (d, (begin, end), (start, dump, shut)) in enumerate(zip(digs, dig_spans(digs, motion), motion.passes())):
        digging = (t >= begin) & (t <= end)
        at = d.table[:, 0] + 34.0 * k
        # y is left, so a moment that lifts is about -y
        wrench = hidden.heavier * np.array([np.interp(t[digging], at, s * d.table[:, c])
                                            for c, s in ((1, 1.0), (3, 1.0), (5, -1.0))])
        held = hidden.heavier * np.hypot(*d.weight()[:2]) / G
        lost = min(hidden.lost_kg[k], held)
        share = np.interp(t[digging], at, d.table[:, 7]) / max(d.table[-1, 7], 1.0)
        rock[:, digging] = wrench
        load[digging] -= lost * share      # what there was no room for
        load[digging] += hidden.stuck_kg[k]
        carried = (t > end) & (t <= dump)
        load[carried] = (held - lost) * np.exp(-hidden.leak_per_s * (t[carried] - end)) + hidden.stuck_kg[k]
        there = (held - lost) * np.exp(-hidden.leak_per_s * (dump - end))
        after = np.clip((t - dump) / DUMP_S, 0, 1)
        falls = (t > dump) & (t < (34.0 * (k + 1) + 0.5 if k + 1 < len(digs) else np.inf))
        load[falls] = there * (1 - (1 - hidden.kept) * (3 * after**2 - 2 * after**3)[falls]) + hidden.stuck_kg[k]
        dumped.append(there * (1 - hidden.kept))
    forces = drive_forces(arm, rock, load, LOAD_CENTRE, hidden.slope_rad)
    return Cycle(t, motion(t), forces, load, motion.passes(), np.array(dumped), arm)


def motion_of(case):
    return Motion.read(case / "motion.csv")
