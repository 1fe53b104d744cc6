#!/usr/bin/python3
"""Do signatures of the case in screening/ hold in finer rock? Rank correlation with the twin's, cell by cell.

usage: finer.py WORK [RUNS]      WORK as of make.py: its base-* runs; RUNS of them (3)
"""
import subprocess
import sys
from pathlib import Path

import numpy as np
from scipy.stats import spearmanr

from analyse import CASE, program, read_catalogue, simulator
from dipper_gap.readings.features import TIME
from dipper_gap.readings.measured import read_measured
from dipper_gap.simulation.simulator import request
from dipper_gap.readings.vectors import Vectors, indices_of
from make import CHANNELS

EFFECTS = ("crowd_friction", "hoist_drive_loss", "logger_offset")
HOW = {"crowd_friction": "replay", "hoist_drive_loss": "replay", "logger_offset": "observe"}


def finer(run, name, strength):
    """A base run seen with an effect, or without one (None)."""
    if name is None:
        return read_measured(run / "observed", simulated=True)
    out = run.parent / f"{name}-{strength:g}"
    if not out.exists():
        set_ = f"effects.{name}={strength}" if HOW[name] == "replay" else f"observation.lag_s={strength}"
        side = ["--side", "mbs"] if HOW[name] == "replay" else []
        subprocess.run([program(), HOW[name], run, *side, "--set", set_, "--out", out], check=True, capture_output=True)
    return read_measured(out, simulated=True)


def main(words):
    if len(words) not in (1, 2):
        print(__doc__, file=sys.stderr)
        return 2
    bases = sorted(Path(words[0]).glob("base-*/run"))[:int(words[1]) if len(words) == 2 else 3]
    catalogue = read_catalogue(CASE)
    sim = simulator(catalogue)
    seeds = range(1, 1 + len(bases))
    plain = sim.run([request({}, s, catalogue) for s in seeds])
    vectors = Vectors(CHANNELS, (1, 2, 3), plain)

    def shift(before, after):
        rows = [(vectors.of_run(a), vectors.of_run(b)) for a, b in zip(after, before)]
        cells = [c for c in vectors.cells if all(c in view[0] for pair in rows for view in pair)]
        return cells, np.mean([a[1][indices_of(cells, a[0])] - b[1][indices_of(cells, b[0])] for a, b in rows], axis=0)

    print("| effect | strength | cells | rank correlation, all cells | cells that move by half an instrument's sd |")
    print("|---|---|---|---|---|")
    for name in EFFECTS:
        s = catalogue[name].reference()
        coarse_cells, coarse = shift(plain, sim.run([request({name: s}, k, catalogue) for k in seeds]))
        fine_cells, fine = shift([finer(b, None, 0) for b in bases], [finer(b, name, s) for b in bases])
        cells = [c for c in coarse_cells if c in set(fine_cells) and c.channel != TIME]
        x, y = coarse[indices_of(cells, coarse_cells)], fine[indices_of(cells, fine_cells)]
        sd = np.sqrt(np.diag(vectors.own) + (vectors.common**2).sum(axis=0))[indices_of(cells, vectors.cells)]
        moves = np.abs(x) > 0.5 * sd
        print(f"| {name} | {s:g} {catalogue[name].unit} | {len(cells)} | {spearmanr(x / sd, y / sd)[0]:.2f} | "
              f"{spearmanr((x / sd)[moves], (y / sd)[moves])[0]:.2f} of {moves.sum()} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
