"""One dig of the mine in YADE: the dipper is led along the motion through a bench, what the rock does is kept."""
import numpy as np

import dipper_box
from bench import boxed
from rock import Scene
from shovel import Arm

BEGIN_S, END_S = 0.5, 13.6        # of a pass, by the plan: before the teeth meet rock, after the dipper is clear of it
ACTIVE_M, HELD_M = 3.7, 4.8       # beside the boom's plane: rock that moves, rock that is held; beyond it is left out
DEEP_M, FLOOR_M = 2.9, 4.0        # the same below the surveyed face, normal to it
LED_STEPS, LOG_S, LOOK_S = 5, 0.048, 0.24   # steps a lead; s a row of forces, and a look at where the rock is


def parts(rocks, heading, outline):
    """(moves, held): which rocks a dig at this heading can move, and which hold those."""
    c = rocks.centres()
    beside = np.abs(np.cos(heading) * c[:, 1] - np.sin(heading) * c[:, 0])
    deep = np.cos(outline.angle) * ((c[:, 0] - outline.toe) * np.tan(outline.angle) - c[:, 2])
    moves = (beside < ACTIVE_M) & (deep < DEEP_M)
    return moves, ~moves & (beside < HELD_M) & (deep < FLOOR_M)


class Led:
    """Leads facets along poses, exactly: each gets the speeds that bring it to its next place."""

    def __init__(self, scene, arm, first_s):
        self.scene, self.arm, self.first_s = scene, arm, first_s
        self.dt = LED_STEPS * scene.O.dt
        corners = dipper_box.facets()
        origin, axes = arm.pose(0)
        self.ids = scene.facets(origin + corners @ axes.T, scene.steel)
        states = [scene.O.bodies[k].state for k in self.ids]
        self.local = np.array([axes.T @ (np.array(s.pos) - origin) for s in states])
        self.pose, self.k = (origin, axes), 0
        self.sums, self.steps, self.rows = np.zeros(6), 0, []

    def lead(self):
        """Sets the speeds for the next LED_STEPS steps."""
        self.read()
        self.k += 1
        origin, axes = self.arm.pose(min(self.k, len(self.arm.t) - 1))
        turn = axes @ self.pose[1].T
        angle = np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1))
        axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
        spin = axis / 2 / self.dt if angle < 1e-7 else axis / (2 * np.sin(angle)) * angle / self.dt
        aim = origin + self.local @ axes.T
        spin = self.scene.yade.Vector3(*spin)
        for k, to in zip(self.ids, aim):
            state = self.scene.O.bodies[k].state
            state.vel = self.scene.yade.Vector3(*((to - np.array(state.pos)) / self.dt))
            state.angVel = spin
        self.pose = (origin, axes)

    def read(self):
        """Adds the wrench of the rock about the dipper's origin, in its axes, to the mean of the row."""
        force, torque = np.zeros(3), np.zeros(3)
        origin, axes = self.pose
        for k in self.ids:
            f = np.array(self.scene.O.forces.f(k))
            if f.any():
                force += f
                arm = np.array(self.scene.O.bodies[k].state.pos) - origin
                torque += np.array(self.scene.O.forces.t(k)) + np.cross(arm, f)
        self.sums += np.r_[axes.T @ force, axes.T @ torque]
        self.steps += 1
        now = self.k * self.dt
        if now >= LOG_S * (len(self.rows) + 1) - 1e-9:
            self.rows.append(np.r_[self.first_s + now, self.sums / self.steps])
            self.sums[:], self.steps = 0.0, 0

    def inside(self, rocks):
        origin, axes = self.pose
        return dipper_box.holds((rocks.centres() - origin) @ axes)


def dig(rocks, material, outline, shovel, motion, start_s, log=print, end_s=END_S):
    """Digs one pass through `rocks`. Returns (table, rocks left, notes).

    table: (n, 9) time in the pass [s]; force of the rock on the dipper [N] and moment about its origin [N m] in its
    axes, means over LOG_S; mass of the rock in the dipper by place [kg] and share of the rock that is faster than
    0.1 m/s, both straight between looks.
    """
    heading = float(motion(start_s + 2.0)[2])
    t = start_s + BEGIN_S + np.arange(0, end_s - BEGIN_S + 0.5, LED_STEPS * material.step)
    arm = Arm(shovel, motion, t)
    origin, axes = arm.pose(0)
    members, radius = np.concatenate(rocks.members), np.repeat(rocks.radius, rocks.count)
    owner = np.repeat(np.arange(len(rocks)), rocks.count)
    cleared = np.zeros(len(rocks), bool)  # rubble where the dipper comes down, which a dozer takes away
    cleared[owner[dipper_box.meets((members - origin) @ axes, radius)]] = True
    rocks = rocks.take(~cleared)
    moves, held = parts(rocks, heading, outline)
    near = np.flatnonzero(moves | held)
    scene = Scene(material)
    boxed(scene, outline)
    scene.add(rocks.take(near), held[near])
    led = Led(scene, arm, BEGIN_S)
    scene.before = [scene.yade.PyRunner(command="LED.lead()", iterPeriod=LED_STEPS, initRun=True)]
    import builtins
    builtins.LED = led
    scene.start()
    like, place = rocks.take(near), []
    while led.first_s + led.k * led.dt < end_s:
        scene.run(LOOK_S)
        inside = led.inside(scene.rocks(like))
        place.append([led.first_s + led.k * led.dt, float((like.volumes() * inside).sum() * material.density),
                      float((scene.speeds() > 0.1).mean())])
    table, place = np.array(led.rows), np.array(place)
    table = np.c_[table, *(np.interp(table[:, 0], place[:, 0], place[:, k]) for k in (1, 2))]
    now, inside = scene.rocks(like), led.inside(scene.rocks(like))
    left = rocks.take(np.flatnonzero(~(moves | held)))
    stay = now.take(~inside)
    all_rocks = type(rocks)(np.r_[left.count, stay.count], np.r_[left.radius, stay.radius], left.members + stay.members)
    notes = {"cleared": int(cleared.sum()), "moving": int(moves.sum()), "held": int(held.sum()),
             "load_rocks": int(inside.sum())}
    log(f"dig at {np.degrees(heading):.0f} deg: {notes}, {table[-1, 7] / 1e3:.1f} t by place")
    return table, all_rocks, notes
