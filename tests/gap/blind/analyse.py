#!/usr/bin/python3
"""Runs `dipper gap` on the blind cases, which sees their measured folders and nothing else.

usage: analyse.py limits FILE           the model's own detection limits, {effect: strength}
       analyse.py run FOLDER OUT [CASE ...]   results into FOLDER/results, reports into OUT
       analyse.py nulls COUNT FILE      how often nothing is called something, COUNT times over
"""
import json
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path[:0] = [str(HERE), str(HERE.parent), str(ROOT / "analysis")]
from gap.__main__ import cache_folder, program  # noqa: E402
from gap.effects import read_catalogue  # noqa: E402
from gap.isolability import DETECTION_D, isolability  # noqa: E402
from gap.simulator import DipperSimulator, request  # noqa: E402
from gap.workflow import FRESH_FROM, FRESH_SEEDS, Workflow  # noqa: E402
from make import CHANNELS  # noqa: E402

CASE = ROOT / "cases/screening"


def simulator(catalogue):
    return DipperSimulator(CASE, catalogue, program(), cache_folder())


def as_mine(run, rng):
    """A run as the instruments of CHANNELS would have logged it."""
    noisy = {n: v + rng.normal(0, CHANNELS[n].common_sigma) + rng.normal(0, CHANNELS[n].sigma, len(v))
             for n, v in run.signals.items()}
    mass = CHANNELS["truck_mass_t"]
    shared = rng.normal(0, mass.common_sigma)
    passes = tuple(replace(p, truck_mass_t=max(0.0, p.truck_mass_t + shared + rng.normal(0, mass.sigma)))
                   for p in run.passes)
    return replace(run, channels=CHANNELS, signals=noisy, passes=passes)


def limits():
    catalogue = read_catalogue(ROOT / "analysis/effects")
    sim = simulator(catalogue)
    mine = as_mine(sim.run([request({}, 1, catalogue)])[0], np.random.default_rng(0))
    flow = Workflow(mine, sim, catalogue, 1, lambda text: None)
    flow.prepare()
    table = isolability(flow.out.training.signatures, flow.out.training.covariance)
    # Where none is within the bounds: as d grows with a small strength.
    beyond = table.strengths * DETECTION_D / table.d
    return {n: float(limit if np.isfinite(limit) else abs(b))
            for n, limit, b in zip(table.names, table.limits, beyond)}, table


def run(folder, out, cases):
    for case in cases or sorted(p.name for p in (folder / "measured").iterdir()):
        words = [program(), "gap", str(CASE), "--measured", str(folder / "measured" / case), "--out", str(out / case)]
        status = subprocess.run(words).returncode
        if status != 0:
            return status
        (folder / "results" / case).mkdir(parents=True, exist_ok=True)
        shutil.copy(out / case / "gap.json", folder / "results" / case / "gap.json")
    return 0


def nulls(count, file):
    """Fresh runs of the model itself, each seen through `count` / 5 draws of the instruments' noise."""
    catalogue = read_catalogue(ROOT / "analysis/effects")
    sim = simulator(catalogue)
    seeds = [1 + FRESH_FROM + k for k in range(FRESH_SEEDS)]
    runs = sim.run([request({}, s, catalogue) for s in seeds])
    rng = np.random.default_rng(20)
    flow = Workflow(as_mine(runs[0], rng), sim, catalogue, 1, lambda text: None)
    flow.prepare()
    prepared = flow.out
    with open(file, "w") as f:
        f.write("case,verdict,omnibus_p\n")
        for k in range(count):
            y = flow.features(as_mine(runs[k % len(runs)], rng))
            flow.out = replace(prepared, training=replace(prepared.training, y=y[prepared.training.at]))
            flow.look()
            f.write(f"seed {seeds[k % len(runs)]} noise {k // len(runs)},{flow.out.verdict.verdict},"
                    f"{flow.out.disagreement.omnibus_p:.4f}\n")


def main(words):
    if words[:1] == ["limits"] and len(words) == 2:
        found, table = limits()
        for name, strength, d in zip(table.names, table.strengths, table.d):
            print(f"{name:20} limit {found[name]}, d {d:.1f} at {strength:.3g}")
        Path(words[1]).write_text(json.dumps(found, indent=1) + "\n")
        return 0
    if words[:1] == ["run"] and len(words) >= 3:
        return run(Path(words[1]), Path(words[2]), words[3:])
    if words[:1] == ["nulls"] and len(words) == 3:
        nulls(int(words[1]), Path(words[2]))
        return 0
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
