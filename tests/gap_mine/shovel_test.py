"""The mine's machine against what is known without it: geometry, virtual work, a weight, and who may import whom."""
import ast
import sys
from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))
from cycle import Dig, Hidden, cycle  # noqa: E402
from effects import DRIVES, LOGGED, MACHINE, NUISANCE, OUTSIDE, CATALOGUE, RUN, crowd_friction  # noqa: E402
from instruments import second_means, truck_log  # noqa: E402
from shovel import G, Arm, Motion, Shovel, drive_forces, rope_run  # noqa: E402

MOTION = Motion.read(ROOT / "cases/screening/motion.csv")
OWN = {f.stem for f in HERE.glob("*.py")}
LOAD_KG = 60e3


def a_dig(seconds=13.6, kg=LOAD_KG, number=0):
    """A dig in which the dipper has `kg` at (1.9, -0.2) from the first, carried without rock around it."""
    t = np.arange(0.5, seconds, 0.048)
    arm = Arm(Shovel(), MOTION, t + 34.0 * number)
    down = -kg * G * np.array([np.sin(arm.tilt), np.cos(arm.tilt)])          # in the dipper's axes
    lift = 1.9 * down[1] + 0.2 * down[0]
    z = np.zeros_like(t)
    table = np.c_[t, down[0], z, down[1], z, -lift, z, np.full_like(t, kg), z]
    return Dig(table, np.c_[np.arange(12, 27, 0.5), np.zeros(30), np.zeros(30)])


def test_the_rope_is_as_long_as_asked_at_every_drive():
    arm = Arm(Shovel(), MOTION, np.linspace(0, MOTION.end, 200))
    long = rope_run(arm.shovel, arm.point(arm.shovel.bail))[0]
    assert np.allclose(long, arm.shovel.rope_length + arm.hoist, atol=1e-9)


def test_the_rope_over_the_sheave_is_the_shortest_way_round_it():
    """Against a path of many straight pieces outside the sheave, made by hand: tangent, arc, tangent."""
    s, bail = Shovel(), np.array([20.0, 5.0])
    length, toward, free = rope_run(s, bail)
    arc = np.linspace(0, 2 * np.pi, 200001)
    ring = np.array(s.sheave)[:, None] + s.sheave_radius * np.array([np.cos(arc), np.sin(arc)])
    to_bail, to_drum = np.hypot(*(ring - bail[:, None])), np.hypot(*(ring - np.array(s.drum)[:, None]))
    tangent = np.sqrt(((bail - s.sheave) ** 2).sum() - s.sheave_radius**2)
    assert free == pytest.approx(tangent)
    assert abs(toward @ (bail + free * toward - s.sheave)) < 1e-9             # it leaves the sheave at right angles
    assert length > to_drum.min() + to_bail.min()
    assert bail[0] + free * toward[0] > s.sheave[0]                          # over the sheave, down on its far side


def test_the_teeth_are_where_the_plan_has_them():
    """cases/screening/plan.yaml: the first cut starts at (13.1, 0.4); lift_m ends at (21.3, 15.2)."""
    arm = Arm(Shovel(), MOTION, [0.0, 18.0])
    tips = arm.point((4.6, -1.5))
    assert np.allclose(tips[:, 0], (13.1, 0.4), atol=0.01) and np.allclose(tips[:, 1], (21.3, 15.2), atol=0.01)


def test_drives_put_in_the_power_that_the_machine_takes_up():
    """Hoist and crowd do the work of lifting, of speeding up and of the swing: d/dt (kinetic + potential), to 1 %."""
    t = np.arange(1.0, 12.0, 0.005)                                          # before the swing
    s = Shovel(rope_kg_m=0.0)
    arm = Arm(s, MOTION, t)
    pull, push = drive_forces(arm, np.zeros((3, len(t))), np.full(len(t), LOAD_KG), (1.9, -0.2))
    rate = lambda x: np.gradient(x, t, axis=-1)
    power = -pull * rate(arm.hoist) + push * rate(arm.crowd)
    door = arm.point(s.hinge) + np.array([np.cos(arm.tilt) * -0.1 + np.sin(arm.tilt) * 1.5,
                                          np.sin(arm.tilt) * -0.1 - np.cos(arm.tilt) * 1.5])
    energy = 0.5 * (s.handle_inertia + s.dipper_inertia + s.door_inertia) * rate(arm.pitch) ** 2
    for m, p in ((s.handle_mass, arm.end + s.handle_centre * arm.out), (s.dipper_mass, arm.point(s.dipper_centre)),
                 (s.door_mass, door), (LOAD_KG, arm.point((1.9, -0.2)))):
        energy = energy + 0.5 * m * (rate(p) ** 2).sum(axis=0) + m * G * p[1]
    inner = slice(20, -20)
    assert np.abs(power - rate(energy))[inner].max() < 0.01 * np.abs(power[inner]).max()


def test_a_carried_load_is_weighed_and_what_leaks_is_lost():
    digs = [a_dig(number=k) for k in range(3)]
    plain, leaky = cycle(digs, MOTION), cycle(digs, MOTION, Hidden(leak_per_s=-np.log(0.9) / 6.7))
    assert np.allclose(plain.dumped_kg, LOAD_KG, rtol=1e-3)
    assert np.allclose(leaky.dumped_kg / plain.dumped_kg, 0.9, atol=0.003)
    empty = cycle([a_dig(kg=0.0)] * 3, MOTION)
    swing = (plain.time_s > 14) & (plain.time_s < 20)
    dug = (plain.time_s > 9) & (plain.time_s < 13)  # statics carry on from where the dig's own wrench ends
    extra = plain.forces[0] - empty.forces[0]
    assert np.all(extra[swing] > 250e3)
    assert abs(extra[dug][-1] - extra[swing][0]) < 0.1 * extra[dug][-1]


def test_an_empty_cycle_takes_the_forces_that_a_multibody_code_has():
    """empty_cycle.csv: `dipper run cases/screening --no-rock`, observed at 1 Hz. Ropes here have weight, there not."""
    seen = np.loadtxt(HERE / "empty_cycle.csv", delimiter=",", skiprows=2)
    digs = [a_dig(kg=0.0)] * 3
    time, means = second_means(truck_log(digs, MOTION, {})[0])
    assert np.allclose(time, seen[:, 0])
    for name, column, within in (("hoist_m", 1, 0.003), ("crowd_m", 2, 0.003), ("hoist_force_kN", 3, 12),
                                 ("crowd_force_kN", 4, 8)):
        assert np.abs(means[name] - seen[:, column]).max() < within, name


def test_friction_turns_with_the_crowd_and_costs_what_is_asked():
    c = cycle([a_dig()] * 3, MOTION)
    more = crowd_friction(c, c.forces, 80.0)[1] - c.forces[1]
    v = np.gradient(c.drives[1], c.time_s)
    assert np.allclose(more[v > 0.4], 80e3, rtol=0.05) and np.allclose(more[v < -0.4], -80e3, rtol=0.05)
    assert np.abs(more).max() <= 80e3 * 1.001


def test_every_effect_is_of_one_set_and_is_done_somewhere():
    done = {*RUN, *MACHINE, *DRIVES, *LOGGED}
    assert done == {*CATALOGUE, *OUTSIDE, *NUISANCE}
    assert len(done) == len(RUN) + len(MACHINE) + len(DRIVES) + len(LOGGED) == len((*CATALOGUE, *OUTSIDE, *NUISANCE))


def imports(file):
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            yield from (a.name.split(".")[0] for a in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield "." * node.level + (node.module or "").split(".")[0]


def test_the_mine_shares_no_line_with_dipper():
    """It imports the standard library, NumPy, SciPy, YADE and itself; and nothing of Dipper's imports it."""
    allowed = {*sys.stdlib_module_names, *OWN, "numpy", "scipy", "yade", "pytest", "yaml"}
    for file in HERE.glob("*.py"):
        assert set(imports(file)) <= allowed, file
    for file in (ROOT / "analysis").rglob("*.py"):
        assert not set(imports(file)) & (OWN - {"shovel_test"}), file
        assert "gap_mine" not in file.read_text(), file
