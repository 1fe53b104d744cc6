#!/usr/bin/python3
"""Runs `dipper gap` on the blind cases, which sees their measured folders and nothing else.

usage: analyse.py limits FILE           the model's own detection limits, {effect: strength}
       analyse.py run FOLDER OUT [CASE ...]   results into FOLDER/results, reports into OUT
       analyse.py nulls COUNT FILE      how often nothing is called something, COUNT times over
"""
import json
import os
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
from gap.isolability import isolability  # noqa: E402
from gap.simulator import DipperSimulator, request  # noqa: E402
from gap.workflow import Workflow  # noqa: E402
from make import CHANNELS  # noqa: E402

CASE = ROOT / "cases/screening"
FRESH = 2000  # first of the seeds whose runs play the mine in a null: none that an analysis has


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
    return {n: (float(limit) if np.isfinite(limit) else None) for n, limit in zip(table.names, table.limits)}, table


def run(folder, out, cases):
    for case in cases or sorted(p.name for p in (folder / "measured").iterdir()):
        words = [program(), "gap", str(CASE), "--measured", str(folder / "measured" / case), "--out", str(out / case)]
        status = subprocess.run(words).returncode
        if status != 0:
            return status
        (folder / "results" / case).mkdir(parents=True, exist_ok=True)
        shutil.copy(out / case / "gap.json", folder / "results" / case / "gap.json")
    return 0
