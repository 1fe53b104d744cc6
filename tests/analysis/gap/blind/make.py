#!/usr/bin/python3
"""Makes the blind cases: runs the twin with each hidden effect, logs it as a mine would, seals the truths.

usage: make.py WORK FOLDER SECRET LIMITS      (DIPPER names the program)
       make.py WORK FOLDER SECRET LIMITS --runs-only

WORK keeps the twin's runs. SECRET is a text that decides every draw: which case is which, how strong, which
seeds, which noise. LIMITS is a JSON file {effect: detection limit or null}, from the model alone (analyse.py limits):
strengths are drawn and told as multiples of them. FOLDER gets measured/CASE, truth/CASE.yaml and sealed.csv.
"""
import hashlib
import json
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import yaml

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parents[3] / "analysis/gap"),
                str(HERE.parents[3] / "analysis/runs")]
import otherwise  # noqa: E402
import score  # noqa: E402
import twin  # noqa: E402
from dipper_gap.simulation.effects import read_catalogue  # noqa: E402
from dipper_gap.readings.measured import Channel, Measured, Pass, write_measured  # noqa: E402
from trucks import in_a_row  # noqa: E402

# A mine's instruments: load cells good to 2 % of their typical reading, a truck's scale to some per cent.
CHANNELS = {c.name: c for c in (
    Channel("truck_mass_t", "t", "response", 0.8, 1.0),
    Channel("hoist_m", "m", "driven", 0.005, 0.0),
    Channel("crowd_m", "m", "driven", 0.005, 0.0),
    Channel("swing_rad", "rad", "driven", 0.001, 0.0),
    Channel("hoist_force_kN", "kN", "response", 25.0, 15.0),
    Channel("crowd_force_kN", "kN", "response", 25.0, 15.0))}
TRUCKS = 4         # of each case, loaded by the same three passes
BASES = 16         # twin runs without an effect; instruments' effects are laid over them
MADE = 6           # of the effects that need runs of their own, chosen by lot, those that have a limit first
OWN_CASES = 8      # cases with runs of their own there is time for: the first by lot, of these and the others
TIMES = (0.5, 1.0, 2.0)  # of the detection limit
BELIEVED = 2.5     # of the prior's sd: a strong effect, where there is no limit
JITTER = 0.1       # of a strength, so that it is no round multiple
JOBS = int(os.environ.get("JOBS", "2"))
OUTSIDE = {"slippery_steel": 0.8, "clipped_cell": 1100.0, "cable_drag": 90.0, "scale_tare": 4.0}
PAIRS = (("crowd_friction", "truck_spillage"), ("hoist_drive_loss", "logger_offset"))
DECOYS = {"nuisances_shift": 1.5, "operator": 0.4}


@dataclass
class Plan:
    kind: str
    effects: dict = field(default_factory=dict)   # of the catalogue: what is scored
    done: dict = field(default_factory=dict)      # implementation: strength
    seeds: tuple = ()                             # a truck each
    plain: bool = False                           # those are runs without an effect: of the bases


def rng_of(secret, what):
    return np.random.default_rng(list(hashlib.sha256(f"{secret} {what}".encode()).digest()))


def draw(catalogue, limits, name, times, rng):
    """A strength of about `times` the limit, within bounds; as strong as its prior believes where there is no limit."""
    e = catalogue[name]
    sign = rng.choice([-1, 1]) if e.low < 0 < e.high else 1
    most = 0.9 * (e.high if sign > 0 else -e.low)
    if limits[name] is None:
        return float(sign * min(most, BELIEVED * e.scale))
    return float(sign * min(times * limits[name] * (1 + JITTER * rng.uniform(-1, 1)), most))


def times_limit(effects, limits):
    """Of the weakest of these effects {name: strength}; 0 where one has no limit."""
    return min((abs(s) / limits[n] if limits[n] else 0.0 for n, s in effects.items()), default=0.0)


def plans(catalogue, limits, bases, rng):
    """Every case, in an order of chance."""
    out = []

    def add(kind, names, times):
        chosen = {n: draw(catalogue, limits, n, times, rng) for n in names}
        out.append(Plan(kind, chosen, chosen))

    lot = sorted(rng.permutation(sorted(otherwise.MADE)), key=lambda n: limits[n] is None)
    for k, name in enumerate(lot[:MADE]):
        add("effect", [str(name)], TIMES[1:][k % 2])
    for name in otherwise.SEEN:
        for times in TIMES if limits[name] is not None else TIMES[-1:]:
            add("effect", [name], times)
    for pair in PAIRS:
        add("pair", pair, 2.0)
    for name, s in OUTSIDE.items():
        out.append(Plan("outside", {}, {name: s}))
    for name, s in DECOYS.items():
        out.append(Plan("decoy", {}, {name: s}))
    out += [Plan("control") for _ in range(BASES // TRUCKS)]
    controls = iter(rng.permutation(bases).reshape(-1, TRUCKS))  # no run in two of them
    for p in out:
        p.plain = not any(_made(n) for n in p.done)
        if p.kind == "control":
            chosen = next(controls)
        else:
            chosen = rng.choice(bases, TRUCKS, replace=False) if p.plain else rng.integers(5000, 10**6, TRUCKS)
        p.seeds = tuple(int(x) for x in chosen)
    rng.shuffle(out)
    own = [p for p in out if not p.plain]
    return [p for p in out if p.plain or p in own[:OWN_CASES]]


def _made(name):
    return name in otherwise.MADE or name in ("slippery_steel", "nuisances_shift", "operator")


def run_of(plan, seed, work, program):
    """The twin's run for one truck of a case."""
    if plan.plain:
        return twin.run(twin.twin_case(), seed, work / f"base-{seed}", program)
    made = [(n, s) for n, s in plan.done.items() if _made(n)]
    folder = work / hashlib.sha256(json.dumps([made, seed]).encode()).hexdigest()[:16]
    folder.mkdir(parents=True, exist_ok=True)
    case = twin.twin_case()
    for name, s in made:
        case = getattr(otherwise, name)(case, folder, s)
    return twin.run(case, seed, folder, program)


def log(run_folder, plan, rng, program):
    """What one truck's passes look like to logger and scale without errors of their own: (Measured)."""
    signals, passes = twin.signals(run_folder, program)
    tonnes = passes[:, 3].copy()
    for name, s in plan.done.items():
        if not _made(name):
            signals, tonnes = getattr(otherwise, name)(signals, tonnes, s, rng)
    every = int(twin.RATE_HZ)
    keep = len(signals["time_s"]) // every * every
    mean = {n: v[:keep].reshape(-1, every).mean(axis=1) for n, v in signals.items() if n in CHANNELS}
    time = signals["time_s"][:keep].reshape(-1, every)[:, -1]
    rows = tuple(Pass(int(p[0]), p[1], p[2], float(t)) for p, t in zip(passes, tonnes))
    return Measured(CHANNELS, rows, time, mean)


def as_mine(runs, rng):
    """Runs as one folder, a truck each, through the instruments of CHANNELS."""
    shared = {n: rng.normal(0, c.common_sigma) for n, c in CHANNELS.items()}
    mass, seen = CHANNELS["truck_mass_t"], []
    for m in runs:
        signals = {n: m.signals[n] + shared[n] + rng.normal(0, c.sigma, len(m.time_s))
                   for n, c in CHANNELS.items() if n != mass.name}
        passes = tuple(replace(p, truck_mass_t=max(0.0, p.truck_mass_t + shared[mass.name] + rng.normal(0, mass.sigma)))
                       for p in m.passes)
        seen.append(replace(m, channels=CHANNELS, signals=signals, passes=passes))
    return in_a_row(seen)


def main(words):
    if len(words) not in (4, 5):
        print(__doc__, file=sys.stderr)
        return 2
    work, folder, secret = Path(words[0]).resolve(), Path(words[1]), words[2]
    limits = json.loads(Path(words[3]).read_text())
    program = os.environ.get("DIPPER", str(twin.ROOT / "build/release/bin/dipper"))
    bases = rng_of(secret, "bases").integers(5000, 10**6, BASES)
    todo = plans(read_catalogue(twin.SCREENING), limits, bases, rng_of(secret, "plans"))
    asked = {(p.plain or f"{i}", s): (p, s) for i, p in enumerate(todo) for s in p.seeds}  # a base's run once
    with ThreadPoolExecutor(JOBS) as pool:
        list(pool.map(lambda ps: run_of(*ps, work, program), asked.values()))
    if len(words) == 5:
        return 0
    for number, plan in enumerate(todo, 1):
        case, rng = f"c{number:02d}", rng_of(secret, f"noise {number}")
        runs = [run_of(plan, s, work, program) for s in plan.seeds]
        write_measured(as_mine([log(r, plan, rng, program) for r in runs], rng), folder / "measured" / case)
        truth = {"kind": plan.kind, "effects": plan.effects, "implementation": plan.done,
                 "times_limit": round(times_limit(plan.effects, limits), 3), "twin": [twin.provenance(r) for r in runs],
                 "salt": hashlib.sha256(f"{secret} {number}".encode()).hexdigest()}
        (folder / "truth").mkdir(parents=True, exist_ok=True)
        (folder / "truth" / f"{case}.yaml").write_text(yaml.safe_dump(truth, sort_keys=False))
    print(f"{score.seal(folder)} truths sealed")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
