"""A shovel made of a few formulas: plausible cycles at logger rate, effects as signatures, seeds, noise.

It stands in for the simulator (and, with noise, for the mine) where a test needs thousands of runs whose
truth is known. Motion is three_cycles.csv; forces are of the size the paper reports. Nothing here is
used outside tests.
"""
import functools
import pathlib
from dataclasses import replace

import numpy as np

from dipper_gap.readings.channels import Channel
from dipper_gap.readings.measured import Measured, Pass
from dipper_gap.readings.phases import find_phases

ROOT = pathlib.Path(__file__).resolve().parents[3]
MOTION = pathlib.Path(__file__).with_name("three_cycles.csv")
CYCLE_S = 48.0
G = 9.81e-3  # kN per kg

CHANNELS = {c.name: c for c in (
    Channel("truck_mass_t", "t", "response", 1.0, 2.0),
    Channel("hoist_m", "m", "driven", 0.01, 0.0),
    Channel("crowd_m", "m", "driven", 0.01, 0.0),
    Channel("swing_rad", "rad", "driven", 0.002, 0.0),
    Channel("hoist_force_kN", "kN", "response", 25.0, 15.0),
    Channel("crowd_force_kN", "kN", "response", 25.0, 15.0))}


@functools.lru_cache
def motion(rate_hz=1.0):
    rows = np.genfromtxt(MOTION, delimiter=",", comments="#", skip_header=3)
    t = np.arange(0.0, rows[-1, 0] + 1e-9, 1.0 / rate_hz)
    hoist, crowd, swing = (np.interp(t, rows[:, 0], rows[:, k]) for k in (1, 2, 3))
    return t, hoist, crowd, np.radians(swing)


@functools.lru_cache
def phase_index(rate_hz=1.0):
    """(pass, phase times) of the three cycles."""
    t, _, crowd, swing = motion(rate_hz)
    return find_phases(t, crowd, swing, [(CYCLE_S * k, CYCLE_S * (k + 1)) for k in range(3)])


def bump(t, a, b):
    """A smooth hill between a and b, 1 at its middle."""
    x = np.clip((t - a) / (b - a), 0, 1)
    return np.sin(np.pi * x) ** 2


def rise(t, a, b):
    x = np.clip((t - a) / (b - a), 0, 1)
    return x * x * (3 - 2 * x)


def smooth_noise(rng, t, scale_s):
    """Unit Gaussian noise, correlated over scale_s."""
    step = t[1] - t[0]
    x = rng.standard_normal(len(t) + 40)
    kernel = np.exp(-0.5 * ((np.arange(-20, 21) * step) / scale_s) ** 2)
    return np.convolve(x, kernel / np.sqrt((kernel**2).sum()), "valid")[:len(t)]


FACE_CHANNEL = Channel("face_m", "m", "response", 0.06, 0.04)
FACE_X = np.arange(12.0, 27.0, 0.25)


def run(effects=None, seed=0, rate_hz=1.0, spread=1.0, faces=False):
    """One noise-free observed folder in memory; `effects` {name: strength}, `spread` scales the seeds'; with `faces`
    surveyed before and after each pass."""
    e = dict(effects or {})
    rng = np.random.default_rng([seed, 77])
    t, hoist_m, crowd_m, swing = motion(rate_hz)
    v_hoist, v_crowd = np.gradient(hoist_m, t), np.gradient(crowd_m, t)
    hoist, crowd = np.zeros_like(t), np.zeros_like(t)
    passes, carried, before, left = [], 0.0, {}, {}
    hoist_wobble = 1 + 0.05 * spread * smooth_noise(rng, t, 1.5)
    crowd_wobble = 1 + 0.09 * spread * smooth_noise(rng, t, 1.5) + 0.4 * (hoist_wobble - 1)
    for k, ph in enumerate(phase_index(rate_hz)):
        start = CYCLE_S * k
        pen, fill, out = ph["penetrate"], ph["fill"], ph["breakout"]
        dump = ph["dump"]
        here = (t >= start) & (t <= start + CYCLE_S)
        deep = 1 + 0.015 * spread * rng.standard_normal()
        deep *= 1.0 - e.get("no_rock", 0.0)
        stand = e.get("standoff", 0.0) + e.get("standoff_scan", 0.0)
        deep *= 1 - 0.25 * stand
        high = e.get("pile_height", 0.0) * (0.2 if k == 0 else 1.0) * (1.0 if k != 1 else 0.6)
        load = 80.0 * deep * (1 + 0.07 * high) * (1 + 0.01 * spread * rng.standard_normal())
        load *= 1 + e.get("density", 0.0)
        load *= 1 - 0.004 * e.get("worn_teeth", 0.0) - 0.012 * e.get("liners", 0.0)
        load *= 1 + e.get("fines", 0.0)
        load -= carried
        stuck = e.get("carry_back", 0.0)
        filled = rise(t, pen[0], fill[1] + 0.5)
        slow = 1.0 + 0.5 * e.get("cohesion", 0.0)
        emptied = rise(t, dump[0], dump[0] + 2.5 * slow)
        in_dipper = carried * (1 - filled) + (load + carried) * filled * (1 - emptied) + stuck * emptied
        carried = stuck
        push = bump(t, pen[0] - 0.5, pen[1] + 4.0)
        lift = bump(t, pen[1] - 1.0, out[1])
        wet = e.get("cohesion", 0.0)
        rub = e.get("friction_pair", 0.0) + 0.3 * e.get("friction_line", 0.0)
        crust = e.get("crust", 0.0) * 0.55**k
        dig_crowd = 650 * deep * crowd_wobble * (push * (1 + 0.10 * wet + 0.8 * rub)
                                                 + 0.45 * lift * (1 + 0.06 * wet + 0.25 * rub))
        dig_crowd = dig_crowd + push * (9.0 * e.get("worn_teeth", 0.0) - 3.0 * e.get("rake", 0.0))
        dig_crowd = dig_crowd + crust * 260 * bump(t, pen[0], pen[0] + 0.6 * (pen[1] - pen[0]))
        dig_hoist = 750 * deep * hoist_wobble * lift * (1 + 0.07 * wet + 0.9 * rub + 0.03 * high)
        dig_hoist = dig_hoist + 160 * crust * bump(t, pen[1] - 1, pen[1] + 2) + 16 * lift * e.get("rake", 0.0)
        dig_crowd, dig_hoist = (e.get("resists", 1.0) * x for x in (dig_crowd, dig_hoist))
        load_hoist = in_dipper * 1e3 * G * (1 + e.get("density", 0.0) * 0)
        tare = 48e3 * G + e.get("liners", 0.0) * 1e3 * G
        hoist[here] = (0.9 * (tare + load_hoist) + dig_hoist)[here]
        lean = 0.35 + 0.1 * np.sin(swing)
        crowd[here] = (dig_crowd - lean * (tare + load_hoist) * 0.5)[here]
        mass = load * (1 + 0.004 * spread * rng.standard_normal())
        mass += 0.15 * 0.5 * e.get("rake", 0.0)
        if k == 2:
            mass -= e.get("truck_spillage", 0.0)
        mass *= 1 + e.get("scale_gain", 0.0)
        if faces:
            before[1, k + 1], left[1, k + 1] = _faces(e, np.random.default_rng([seed, 78, k]), spread, load)
        passes.append(Pass(k + 1, start, start + CYCLE_S, mass))
    unknown = e.get("outside", 0.0)  # no effect of the catalogue: a brake that drags while swinging and back
    hoist = hoist + 60 * unknown * (np.abs(np.gradient(swing, t)) > 0.02)
    crowd = crowd - 45 * unknown * (np.abs(np.gradient(swing, t)) > 0.02)
    # Others that no catalogue has: a bent handle, which drags the more the farther it is out; a cable that pulls by the
    # house's angle; a cell whose zero is off.
    crowd = crowd + e.get("bent_handle", 0.0) * np.tanh(v_crowd / 0.05) * (crowd_m - crowd_m.min())
    crowd = crowd + e.get("cable", 0.0) * swing
    hoist = hoist + e.get("zero", 0.0)
    crowd = crowd + e.get("crowd_friction", 0.0) * np.tanh(v_crowd / 0.05)
    hoist = hoist * (1 + e.get("hoist_loss", 0.0) * np.tanh(-v_hoist / 0.1))
    lag = e.get("logger_offset", 0.0)
    stretch = e.get("rope_stretch", 0.0)
    if lag or stretch:
        hoist = np.interp(t - lag - stretch * hoist / 1500, t, hoist)
        crowd = np.interp(t - lag, t, crowd)
    signals = {"hoist_m": hoist_m, "crowd_m": crowd_m, "swing_rad": swing,
               "hoist_force_kN": hoist, "crowd_force_kN": crowd}
    if not faces:
        return Measured(dict(CHANNELS), tuple(passes), t, signals)
    return Measured({**CHANNELS, "face_m": FACE_CHANNEL}, tuple(passes), t, signals, "", before, left)


def _faces(e, rng, spread, load):
    """(x, z) of a face before a pass and after it: 37 degrees, 8.5 m, and what `load` t of rock in place (1.9 t/m3,
    4 m wide, a fifth of it run in again) leave of it."""
    toe = 13.5 - e.get("standoff", 0.0) - e.get("standoff_scan", 0.0) + 0.05 * spread * rng.standard_normal()
    height = 8.5 + e.get("pile_height", 0.0) + 0.05 * spread * rng.standard_normal()
    z = np.clip((FACE_X - toe) * np.tan(np.radians(37 + 1.5 * e.get("cohesion", 0.0))), 0, height)
    area = load / (1.9 * (1 + e.get("density", 0.0)) * (1 + 0.8 * e.get("fines", 0.0)) * 4) * 0.8
    area *= 1 + 0.02 * spread * rng.standard_normal()
    cut = np.clip(z, 0, 7) * bump(FACE_X, toe, toe + 9)
    return (FACE_X, z), (FACE_X, z - cut * area / (cut.sum() * (FACE_X[1] - FACE_X[0])))


def with_noise(m, seed, channels=None, drives=False):
    """The mine's view of a noise-free folder: own noise on each reading, one shared error a channel; with `drives` the
    driven channels have theirs too, which moves the phases besides."""
    channels = channels or CHANNELS
    rng = np.random.default_rng([seed, 99])
    signals = {}
    for name, v in m.signals.items():
        c = channels[name]
        noise = c.sigma * rng.standard_normal(len(v)) + c.common_sigma * rng.standard_normal()
        signals[name] = v + (noise if drives or c.role == "response" else 0.0)
    scale = channels["truck_mass_t"]
    shared = scale.common_sigma * rng.standard_normal()
    passes = tuple(replace(p, truck_mass_t=p.truck_mass_t + shared + scale.sigma * rng.standard_normal())
                   for p in m.passes)
    if not m.profiles:
        return Measured(dict(channels), passes, m.time_s, signals)
    level = FACE_CHANNEL.common_sigma * rng.standard_normal()
    point = FACE_CHANNEL.sigma * np.sqrt(2)  # two points in half a metre
    seen = ({at: (x, z + level + point * rng.standard_normal(len(z))) for at, (x, z) in faces.items()}
            for faces in (m.profiles, m.left))
    return Measured({**channels, "face_m": FACE_CHANNEL}, passes, m.time_s, signals, "", *seen)
