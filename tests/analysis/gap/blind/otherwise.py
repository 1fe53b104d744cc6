"""Each effect done another way than the catalogue does it: what the blind truths are made with.

A `made` effect changes the twin's case before it runs: f(case, folder, s) -> case. A `seen` effect changes
what drives and instruments show: f(signals, tonnes, s, rng) -> (signals, tonnes), with signals at 20 Hz,
forces in kN, tonnes a pass. s is in the catalogue's unit. Where an effect is a plain change of place, it cannot
be done otherwise; it then is a change of the rock's place where the catalogue moves the machine, or the like.
"""
import shutil
from pathlib import Path

import numpy as np
import yaml

from twin import changed, read_stl, write_stl

STEEL_KG_M3 = 7850.0
STUCK_KG_M3 = 2100.0
FLOOR_Z, FLOOR_X, HALF_WIDTH = -1.5, 3.9, 2.0  # of the dipper's cavity, in B


def _machine(case, folder, change):
    """The case with a changed copy of its machine file."""
    data = yaml.safe_load(open(case["machine"]["model"]))
    change(data)
    (folder / "machine.yaml").write_text(yaml.safe_dump(data, sort_keys=False))
    return changed(case, machine={"model": "machine.yaml"})


def _dipper(case, folder, move, mass_kg, at_z):
    """The case with its dipper's vertices moved (p -> p) and a mass added at (2, 0, at_z) in B."""
    corners = read_stl(case["bodies"]["dipper"])
    shutil.copy(Path(case["bodies"]["dipper"]).with_suffix(".yaml"), folder)
    write_stl(folder / "dipper.stl", np.array([[move(p.copy()) for p in facet] for facet in corners]))

    def heavier(data):
        d = data["dipper"]
        m, c = d["mass"]["value"], np.array(d["mass_center"]["value"])
        d["mass"]["value"] = float(m + mass_kg)
        d["mass_center"]["value"] = [float(x) for x in (m * c + mass_kg * np.array([2.0, 0.0, at_z])) / (m + mass_kg)]

    return _machine(changed(case, bodies={"dipper": "dipper.stl"}), folder, heavier)


def _on_floor(p):
    return abs(p[2] - FLOOR_Z) < 1e-3 and 0 < p[0] < FLOOR_X


def carry_back(case, folder, s):
    """A hump, highest in the middle, of the catalogue's mean thickness."""
    def move(p):
        if _on_floor(p):
            p[2] += 1.5 * s * (1 - (p[1] / HALF_WIDTH) ** 2)
        return p
    return _dipper(case, folder, move, STUCK_KG_M3 * s * FLOOR_X * 2 * HALF_WIDTH, FLOOR_Z + 0.5 * s)


def liners(case, folder, s):
    """Plates on floor and cheeks only, the floor's twice as thick as the cheeks'."""
    def move(p):
        if _on_floor(p):
            p[2] += 1.4 * s
        elif abs(abs(p[1]) - HALF_WIDTH) < 1e-3 and abs(p[2]) < 1.5 - 1e-3:
            p[1] -= np.sign(p[1]) * 0.7 * s
        return p
    area = 1.4 * FLOOR_X * 2 * HALF_WIDTH + 2 * 0.7 * FLOOR_X * 3.0
    return _dipper(case, folder, move, STEEL_KG_M3 * s * area, -0.8)


def worn_teeth(case, folder, s):
    """The outer teeth lose more than the inner ones."""
    def move(p):
        if p[0] > 4.3:
            p[0] -= s * (1.15 if abs(p[1]) > 0.7 else 0.8)
        return p
    return _dipper(case, folder, move, 0.0, 0.0)


def fines(case, folder, s):
    """Heavier rock that rolls a little more easily, in place of fines that ride with it."""
    voids = 1 - case["rock"]["bulk_density_kg_m3"] / case["rock"]["density_kg_m3"]
    gain = 1 + s * voids * 0.6 * case["rock"]["density_kg_m3"] / case["rock"]["bulk_density_kg_m3"]
    return changed(case, rock={"density_kg_m3": float(case["rock"]["density_kg_m3"] * gain)},
                   contact={"rolling_friction_sphere":
                            float(case["contact"]["rolling_friction_sphere"] * (1 - 0.1 * s))})


def friction_pair(case, folder, s):
    """Only the rocks slide more easily, by twice as much; the spheres keep their sliding friction."""
    c = case["contact"]
    return changed(case, contact={"friction_sphere_rock": float(max(0.05, c["friction_sphere_rock"] - 1.5 * s)),
                                  "friction_rock_rock": float(max(0.05, c["friction_rock_rock"] - 1.5 * s)),
                                  "rolling_friction_sphere": float(c["rolling_friction_sphere"] + s)})


def moist_cohesion(case, folder, s):
    """Rock sticks to steel as it does to rock; the catalogue has a third."""
    return changed(case, contact={"cohesion_Pa": float(0.9 * s), "adhesion_Pa": float(0.9 * s)})


def frozen_crust(case, folder, s):
    """Frozen through but for the toe, twice as weak in shear."""
    return changed(case, crust={"tensile_strength_Pa": float(s), "shear_ratio": 0.5, "above_m": 1.0})


def pile_height(case, folder, s):
    """Higher by the height, and its crest nearer: the scan missed both."""
    p = case["pile"]
    return changed(case, pile={"height_m": float(p["height_m"] + s), "crest_depth_m": float(p["crest_depth_m"] + 0.5)})


def collapsing_pile(case, folder, s):
    """Comes down as the dipper leaves the truck, not as it opens its door."""
    return changed(case, collapse={"height_m": float(s), "at_s": 17.0})


def rake_offset(case, folder, s):
    """No other way: the dipper sits turned on its handle."""
    return changed(case, machine={"rake_angle_deg": float(case["machine"]["rake_angle_deg"] + s)})


def standoff(case, folder, s):
    """The rock is nearer, in place of the shovel; the truck stays with the shovel."""
    return changed(case, pile={"toe_x_m": float(case["pile"]["toe_x_m"] - s)})


def rope_stretch(case, folder, s):
    """More of the rope is elastic, up to all of it; beyond that its modulus is lower."""
    def softer(data):
        rope = data["rope"]
        whole = float(rope["elastic_fraction"]["value"]) * (1 + s)
        rope["elastic_fraction"]["value"] = float(min(1.0, whole))
        rope["axial_stiffness"]["value"] = float(rope["axial_stiffness"]["value"]) / max(1.0, whole)
    return _machine(case, folder, softer)


# --- seen: no rock runs anew ------------------------------------------------------------------------

def _speed(signals, name):
    return np.gradient(signals[name], signals["time_s"])


def crowd_friction(signals, tonnes, s, rng):
    """Stribeck and viscous parts beside Coulomb's."""
    v = _speed(signals, "crowd_m")
    size = 0.9 + 0.25 * np.exp(-(v / 0.1) ** 2) + 0.15 * np.abs(v)
    return {**signals, "crowd_force_kN": signals["crowd_force_kN"] + s * size * np.tanh(v / 0.02)}, tonnes


def hoist_drive_loss(signals, tonnes, s, rng):
    """Sheaves lose by tension, the drum by a constant of 40 kN at most; lowering gives less back."""
    v = -_speed(signals, "hoist_m")  # hauling in
    t = signals["hoist_force_kN"]
    lost = (s * np.abs(t) + 200.0 * s) * np.tanh(v / 0.03) * np.where(v > 0, 1.0, 0.85)
    return {**signals, "hoist_force_kN": t + lost}, tonnes


def truck_spillage(signals, tonnes, s, rng):
    """Lumps of 1.5 t fall until the part is gone."""
    out = tonnes.copy()
    out[-1] -= 1.5 * np.round(s * out[-1] / 1.5)
    return signals, out


def scale_gain(signals, tonnes, s, rng):
    """The gain, and a reading in steps of half a tonne."""
    return signals, np.round(2 * tonnes * (1 + s)) / 2


def logger_offset(signals, tonnes, s, rng):
    """Late by s on average: the clock of the force logger also drifts by 0.1 s over the truck."""
    t = signals["time_s"]
    late = s + 0.1 * (t / t[-1] - 0.5)
    return {**signals, **{n: np.interp(t - late, t, signals[n]) for n in ("hoist_force_kN", "crowd_force_kN")}}, tonnes


MADE = {f.__name__: f for f in (carry_back, liners, worn_teeth, fines, friction_pair, moist_cohesion, frozen_crust,
                                pile_height, collapsing_pile, rake_offset, standoff, rope_stretch)}
SEEN = {f.__name__: f for f in (crowd_friction, hoist_drive_loss, truck_spillage, scale_gain, logger_offset)}


# --- outside the catalogue --------------------------------------------------------------------------

def slippery_steel(case, folder, s):
    """Polished steel: friction of rock on dipper 0.53 -> 0.53 (1 - s)."""
    return changed(case, contact={"friction_dipper": float(case["contact"]["friction_dipper"] * (1 - s))})


def clipped_cell(signals, tonnes, s, rng):
    """The hoist's load cell shows nothing above s kN: its amplifier is at its end."""
    return {**signals, "hoist_force_kN": np.minimum(signals["hoist_force_kN"], s)}, tonnes


def cable_drag(signals, tonnes, s, rng):
    """A cable pulls the handle back, by s kN when the shovel is turned by one radian from where it digs."""
    turned = np.abs(signals["swing_rad"] - signals["swing_rad"][np.argmax(signals["crowd_m"])])
    return {**signals, "crowd_force_kN": signals["crowd_force_kN"] + s * turned}, tonnes


def scale_tare(signals, tonnes, s, rng):
    """The scale weighs the pass before the truck has come to rest on it: s tonnes too little in each."""
    return signals, tonnes - s


# --- decoys -----------------------------------------------------------------------------------------

def nuisances_shift(case, folder, s):
    """Density and friction line, each s of its prior's standard deviations off."""
    c = case["contact"]
    return changed(case, rock={"density_kg_m3": float(case["rock"]["density_kg_m3"] * (1 + 0.01 * s))},
                   contact={"rolling_friction_sphere": float(c["rolling_friction_sphere"] + 0.01 * s),
                            "friction_sphere_sphere": float(c["friction_sphere_sphere"] - 0.01 * s),
                            "friction_sphere_rock": float(c["friction_sphere_rock"] - 0.01 * s),
                            "friction_rock_rock": float(c["friction_rock_rock"] - 0.01 * s)})


def operator(case, folder, s):
    """Another hand on the levers: the swing lags and leads by up to s seconds, the path of the teeth is kept."""
    source = open(case["machine"]["motion"]).read().splitlines()
    head = [line for line in source if line.startswith("#")]
    names, *rows = [line.split(",") for line in source if not line.startswith("#")]
    table = np.array(rows, float)
    t, at = table[:, 0], names.index("swing_deg")
    # 0 at each pass's begin and end, so that every lane is dug where it was
    table[:, at] = np.interp(t - s * np.sin(np.pi * (t % 25.0) / 25.0) ** 2, t, table[:, at])
    lines = [",".join(names)] + [",".join([f"{r[0]:.2f}"] + [f"{x:.4f}" for x in r[1:]]) for r in table]
    (folder / "motion.csv").write_text("\n".join(head + lines) + "\n")
    return changed(case, machine={"motion": "motion.csv"})
