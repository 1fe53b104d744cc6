#!/usr/bin/python3
"""Makes the blind cases: runs the twin with each hidden effect, logs it as a mine would, seals the truths.

usage: make.py WORK FOLDER SECRET LIMITS      (DIPPER names the program)
       make.py WORK FOLDER SECRET LIMITS --runs-only

WORK keeps the twin's runs. SECRET is a text that decides every draw: which case is which, how strong, which
seed, which noise. LIMITS is a JSON file {effect: detection limit}, from the model alone (analyse.py limits).
FOLDER gets measured/CASE, truth/CASE.yaml and sealed.csv.
"""
import hashlib
import json
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import yaml

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parents[2] / "analysis")]
import otherwise  # noqa: E402
import score  # noqa: E402
import twin  # noqa: E402
from gap.effects import read_catalogue  # noqa: E402
from gap.measured import Channel, Measured, Pass, write_measured  # noqa: E402

# A mine's instruments: load cells good to 2 % of their typical reading, a truck's scale to some per cent.
CHANNELS = {c.name: c for c in (
    Channel("truck_mass_t", "t", "response", 0.8, 1.0),
    Channel("hoist_m", "m", "driven", 0.005, 0.0),
    Channel("crowd_m", "m", "driven", 0.005, 0.0),
    Channel("swing_rad", "rad", "driven", 0.001, 0.0),
    Channel("hoist_force_kN", "kN", "response", 25.0, 15.0),
    Channel("crowd_force_kN", "kN", "response", 25.0, 15.0))}
BASES = 5          # twin runs without an effect; instruments' effects are laid over them
TIMES = (0.5, 1.0, 2.0)  # of the detection limit
JITTER = 0.1       # of a strength, so that it is no round multiple
JOBS = int(os.environ.get("JOBS", "2"))
OUTSIDE = {"slippery_steel": 0.8, "drifting_cell": 0.25, "crowd_cell_gain": -0.2}
PAIRS = (("crowd_friction", "scale_gain"), ("pile_height", "hoist_drive_loss"))
DECOYS = {"nuisances_shift": 1.5, "operator": 0.4}


@dataclass
class Plan:
    kind: str
    effects: dict = field(default_factory=dict)   # of the catalogue: what is scored
    done: dict = field(default_factory=dict)      # implementation: strength
    times: float = 0.0
    seed: int = 0
    base: int = -1                                # which of the bases; -1: a run of its own


def strengths(catalogue, limits, name, times, rng):
    """A strength of about `times` the limit, within bounds; the multiple it really is."""
    e = catalogue[name]
    sign = rng.choice([-1, 1]) if e.low < 0 < e.high else 1
    most = 0.9 * (e.high if sign > 0 else -e.low)
    size = min(times * limits[name] * (1 + JITTER * rng.uniform(-1, 1)), most)
    return float(sign * size), float(size / limits[name])


def plans(catalogue, limits, rng):
    """Every case, in an order of chance."""
    out = []

    def add(kind, names, times, scored=True):
        chosen = {n: strengths(catalogue, limits, n, times, rng) for n in names}
        real = min(t for _, t in chosen.values())
        strength = {n: s for n, (s, _) in chosen.items()}
        out.append(Plan(kind, strength if scored else {}, strength, real))

    for name in otherwise.MADE:
        add("effect", [name], rng.choice(TIMES[1:]))
    for name in otherwise.SEEN:
        for times in TIMES:
            add("effect", [name], times)
    for pair in PAIRS:
        add("pair", pair, 2.0)
    for name, s in OUTSIDE.items():
        out.append(Plan("outside", {}, {name: s}))
    for name, s in DECOYS.items():
        out.append(Plan("decoy", {}, {name: s}))
    out += [Plan("control") for _ in range(4)]
    controls = 0
    for p in out:
        made = [n for n in p.done if _made(n)]
        p.seed = int(rng.integers(5000, 10**6))
        if not made:
            p.base = controls if p.kind == "control" else int(rng.integers(BASES))
            controls += p.kind == "control"
    rng.shuffle(out)
    return out


def _made(name):
    return name in otherwise.MADE or name in ("slippery_steel", "nuisances_shift", "operator")


def run_of(plan, work, bases, program):
    if plan.base >= 0:
        return twin.run(twin.twin_case(), bases[plan.base], work / f"base-{bases[plan.base]}", program)
    made = [(n, s) for n, s in plan.done.items() if _made(n)]
    text = json.dumps([made, plan.seed])
    folder = work / hashlib.sha256(text.encode()).hexdigest()[:16]
    folder.mkdir(parents=True, exist_ok=True)
    case = twin.twin_case()
    for name, s in made:
        case = getattr(otherwise, name)(case, folder, s)
    return twin.run(case, plan.seed, folder, program)


def log(run_folder, plan, rng, program):
    """What the mine's logger and scale wrote: (Measured)."""
    signals, passes = twin.signals(run_folder, program)
    tonnes = passes[:, 3].copy()
    for name, s in plan.done.items():
        if not _made(name):
            signals, tonnes = getattr(otherwise, name)(signals, tonnes, s, rng)
    every = int(twin.RATE_HZ)
    keep = len(signals["time_s"]) // every * every
    mean = {n: v[:keep].reshape(-1, every).mean(axis=1) for n, v in signals.items()}
    time = signals["time_s"][:keep].reshape(-1, every)[:, -1]
    noisy = {n: mean[n] + rng.normal(0, c.common_sigma) + rng.normal(0, c.sigma, len(time))
             for n, c in CHANNELS.items() if n in mean}
    mass = CHANNELS["truck_mass_t"]
    tonnes = np.maximum(0.0, tonnes + rng.normal(0, mass.common_sigma) + rng.normal(0, mass.sigma, len(tonnes)))
    rows = tuple(Pass(int(p[0]), p[1], p[2], float(t)) for p, t in zip(passes, tonnes))
    return Measured(CHANNELS, rows, time, noisy)


def main(words):
    if len(words) not in (4, 5):
        print(__doc__, file=sys.stderr)
        return 2
    work, folder, secret = Path(words[0]).resolve(), Path(words[1]), words[2]
    limits = json.loads(Path(words[3]).read_text())
    program = os.environ.get("DIPPER", str(twin.ROOT / "build/release/bin/dipper"))
    rng = np.random.default_rng(list(hashlib.sha256(secret.encode()).digest()))
    todo = plans(read_catalogue(twin.ROOT / "analysis/effects"), limits, rng)
    bases = [int(s) for s in rng.integers(5000, 10**6, BASES)]
    with ThreadPoolExecutor(JOBS) as pool:  # those of one base once, before the others
        list(pool.map(lambda k: run_of(Plan("control", base=k), work, bases, program), range(BASES)))
        runs = list(pool.map(lambda p: run_of(p, work, bases, program), todo))
    if len(words) == 5:
        return 0
    for number, (plan, run) in enumerate(zip(todo, runs), 1):
        case = f"c{number:02d}"
        noise = np.random.default_rng([number, *hashlib.sha256(secret.encode()).digest()])
        write_measured(log(run, plan, noise, program), folder / "measured" / case)
        truth = {"kind": plan.kind, "effects": plan.effects, "implementation": plan.done,
                 "times_limit": round(plan.times, 3), "twin": twin.provenance(run),
                 "salt": hashlib.sha256(f"{secret} {number}".encode()).hexdigest()}
        (folder / "truth").mkdir(parents=True, exist_ok=True)
        (folder / "truth" / f"{case}.yaml").write_text(yaml.safe_dump(truth, sort_keys=False))
    print(f"{score.seal(folder)} truths sealed")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
