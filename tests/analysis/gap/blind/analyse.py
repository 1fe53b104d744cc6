#!/usr/bin/python3
"""Runs `dipper gap` on the blind cases, which sees their measured folders and nothing else.

usage: analyse.py limits CASE FILE [EFFECT ...]  a case's own detection limits, {effect: strength}
       analyse.py run FOLDER OUT [CASE ...]   results into FOLDER/results, reports into OUT
       analyse.py nulls COUNT FILE      how often nothing is called something, COUNT times over
"""
import functools
import json
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[3]
sys.path[:0] = [str(HERE), str(HERE.parent), str(ROOT / "analysis/gap"),
                str(ROOT / "analysis/runs")]
from dipper_run.run_cache import cache_folder  # noqa: E402
from dipper_run.program import program  # noqa: E402
from dipper_gap.__main__ import usable  # noqa: E402
from dipper_gap.decision.decide import OMNIBUS_P, decide  # noqa: E402
from dipper_gap.simulation.effects import read_catalogue  # noqa: E402
from dipper_gap.statistics.localise import localise  # noqa: E402
from dipper_gap.statistics.match import match  # noqa: E402
from dipper_gap.statistics.null import find_tails, make_runs, phase_labels, root  # noqa: E402
from dipper_gap.simulation.simulator import DipperSimulator  # noqa: E402
from dipper_gap.model import compare, learn, predict  # noqa: E402
from dipper_gap.simulation.plan import FRESH_FROM, make_plan  # noqa: E402
from dipper_gap.workflow import Runner, look  # noqa: E402
from make import TRUCKS, as_mine  # noqa: E402
from twin import SCREENING as CASE  # noqa: E402

MINES, NAMED_IN = 8, 7      # the limit is where so many of the simulated mines are named
STEPS, FINER = 14, 1.35     # strengths tried: from the effect's bound down
NULL_SEEDS = 12


def simulator(catalogue, case=CASE):
    return DipperSimulator(case, catalogue, program(), cache_folder("gap"))


def prepared(runs, case=CASE):
    """What is known of mines of TRUCKS trucks, one of which is made of these seeds: (Model, its mine, Runner)."""
    made_by = simulator(read_catalogue(case), case)
    catalogue, _ = usable(made_by.catalogue, made_by)
    runner = Runner(made_by, catalogue, lambda text: None)
    mine = as_mine(runner.run({}, runs), np.random.default_rng(0))
    plan = make_plan(catalogue, TRUCKS, 1)
    folders = runner.simulator.run(plan.requests(), runner.say)
    return learn(plan, dict(zip(plan.requests(), folders)), mine), mine, runner


def simulated_mines(b, at, count, rng):
    """Residuals (count, n) of mines like the baseline b, at these cells: trucks and seeds with the tails these have."""
    tails, labels, seed, noise = find_tails(b), phase_labels(b.cells), root(b.seed), root(b.noise)
    out = []
    for _ in range(count):
        made = make_runs(seed, b.trucks + b.seeds, tails, labels, rng)
        out.append(made[:b.trucks].mean(axis=0) - made[b.trucks:].mean(axis=0)
                   + noise @ rng.standard_normal(len(b.mean)))
    return np.array(out)[:, at]


def limits(case, names):
    """{effect: strength from which NAMED_IN of MINES simulated mines are named; None where none within bounds is}.

    The mines are the model's own, on the side of the upper bound; naming is without the confirmation on the hold-out.
    """
    model, mine, runner = prepared(range(1, TRUCKS + 1), case)
    prediction = predict(model, runner.catalogue, model.scatter(mine))
    part, null = compare(model, prediction, mine)[0], prediction.null
    mines = simulated_mines(prediction.baseline, part.at, MINES, np.random.default_rng(1))

    def named(residual, name):
        if localise(residual, part.baseline, null, prediction.directions).omnibus_p >= OMNIBUS_P:
            return False
        m = match(residual, part.covariance, part.signatures, part.baseline, largest=2)
        v = decide(0.0, m, part.signatures, part.covariance, part.plain, residual, part.baseline, null)
        return v.verdict == "named" and v.effect == name

    found = {}
    for s in part.signatures:
        if names and s.name not in names:
            continue
        top = 0.95 * (s.effect.high if s.effect.high > 0 else s.effect.low)
        needed = []
        for k, mine in enumerate(mines):
            g = s.g + root(s.spread) @ np.random.default_rng([2, k]).standard_normal(len(s.g))
            low, high = -1, STEPS  # of the scale top / FINER^(STEPS - 1 - step)
            while high - low > 1:
                step = (low + high) // 2
                if named(mine + top * FINER ** (step + 1.0 - STEPS) * g, s.name):
                    high = step
                else:
                    low = step
            needed.append(abs(top) * FINER ** (high + 1.0 - STEPS) if high < STEPS else np.inf)
        limit = sorted(needed)[NAMED_IN - 1]
        found[s.name] = float(limit) if np.isfinite(limit) else None
        print(f"{s.name:18} named from", " ".join(f"{x:.3g}" for x in sorted(needed)), flush=True)
    return found


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
    """Fresh runs of the model itself, TRUCKS of NULL_SEEDS at a time, each through its own instruments' noise."""
    seeds = [1 + FRESH_FROM + k for k in range(NULL_SEEDS)]
    model, _, runner = prepared(seeds[:TRUCKS])
    predicted = functools.lru_cache(None)(lambda scatter: predict(model, runner.catalogue, scatter))
    runs, rng = runner.run({}, seeds), np.random.default_rng(20)
    with open(file, "w") as f:
        f.write("case,verdict,omnibus_p\n")
        for _ in range(count):
            chosen = sorted(rng.choice(NULL_SEEDS, TRUCKS, replace=False))
            mine = as_mine([runs[k] for k in chosen], rng)
            prediction = predicted(model.scatter(mine))
            seen = look(model, prediction, *compare(model, prediction, mine), runner)
            f.write(f"seeds {' '.join(str(seeds[k]) for k in chosen)},{seen.verdict.verdict},"
                    f"{seen.disagreement.omnibus_p:.4f}\n")


def main(words):
    if words[:1] == ["limits"] and len(words) >= 3:
        Path(words[2]).write_text(json.dumps(limits(Path(words[1]), words[3:]), indent=1) + "\n")
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
