#!/usr/bin/python3
"""Runs `dipper gap` on the sealed set, which sees the measured folders and nothing else.

usage: analyse.py run FOLDER OUT [CASE ...]   results into FOLDER/results, reports into OUT
       analyse.py nulls COUNT FILE            how often trucks of the same mine are called changed, COUNT times over

DIPPER names the program. `nulls` draws four trucks of now and four of before from the digs that the mine has stored,
with nothing hidden, each through its own instruments' errors (tests/gap_mine).
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[4]
sys.path[:0] = [str(ROOT / name) for name in ("analysis/gap", "analysis/runs", "tests/gap_mine")]
import make  # noqa: E402
from dipper_gap.__main__ import usable  # noqa: E402
from dipper_gap.readings.measured import read_measured  # noqa: E402
from dipper_gap.simulation.effects import read_catalogue  # noqa: E402
from dipper_gap.simulation.simulator import DipperSimulator  # noqa: E402
from dipper_gap.workflow import Runner, compare, learn_and_predict, look, make_plan  # noqa: E402
from dipper_run.program import program  # noqa: E402
from dipper_run.run_cache import cache_folder  # noqa: E402
from instruments import Errors, write_folder  # noqa: E402
from shovel import Motion  # noqa: E402

CASE = Path("cases/screening")  # in ROOT


def run(folder, out, cases):
    for case in cases or sorted(p.name for p in (folder / "measured").iterdir()):
        words = [program(), "gap", CASE, "--measured", folder / "measured" / case, "--out", out / case]
        if (folder / "reference" / case).is_dir():
            words += ["--reference", folder / "reference" / case]
        status = subprocess.run(words, cwd=ROOT).returncode  # messages then name no folder of this machine
        if status != 0:
            return status
        (folder / "results" / case).mkdir(parents=True, exist_ok=True)
        shutil.copy(out / case / "gap.json", folder / "results" / case / "gap.json")
    return 0


def nulls(count, file):
    simulator = DipperSimulator(ROOT / CASE, read_catalogue(ROOT / CASE), program(), cache_folder("gap"))
    catalogue, _ = usable(simulator.catalogue, simulator)
    plan = make_plan(catalogue, make.TRUCKS, 1, simulator.takes_a_run)
    runner = Runner(simulator, catalogue, lambda text: None)
    base, motion = make.complete(ROOT / "tests/gap_mine/runs/base"), Motion.read(ROOT / CASE / "motion.csv")
    with open(file, "w") as f, tempfile.TemporaryDirectory() as work:
        f.write("case,verdict,omnibus_p\n")
        for k in range(count):
            rng = make.rng_of("nulls", str(k))
            errors, folders = Errors.draw(rng), []
            for half, seen in zip(make.halves(base, rng), (errors, errors.moved(rng))):
                folders.append(Path(work) / f"{k}-{len(folders)}")
                write_folder(folders[-1], make.drawn_trucks(half, rng), {}, motion, seen, rng)
            measured, before = map(read_measured, folders)
            model, prediction = learn_and_predict(plan, measured, before, runner)
            seen = look(model, prediction, *compare(model, prediction, measured), runner)
            f.write(f"draw {k},{seen.verdict.verdict},{seen.disagreement.omnibus_p:.4f}\n")
            f.flush()


def main(words):
    if words[:1] == ["run"] and len(words) >= 3:
        return run(Path(words[1]).resolve(), Path(words[2]).resolve(), words[3:])
    if words[:1] == ["nulls"] and len(words) == 3:
        nulls(int(words[1]), Path(words[2]))
        return 0
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
