#!/usr/bin/env -S yade -x -n -j1
"""Loads one truck of the mine: a bench and three digs in YADE.

    yade -x -n -j1 truck.py SEED FOLDER [KEY=VALUE ...]

FOLDER/SEED gets pass_1.csv.gz ... (dig.py's table), face_1.csv ... (the section before and after the dig), run.json
(what was run, with the version of YADE and the CPU time) and, kept for a resumed run, bench.npz and left_*.npz.
Keys change the mine itself: toe_m (the face is nearer by so much), rake_deg, density (a factor), size (a factor on
every rock), friction and steel (the coefficients), passes (how many of the three are dug).
"""
import json
import sys
import time
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np

HERE = Path(sys.argv[0]).resolve().parent  # yade runs a script as its own __main__
sys.path.insert(0, str(HERE))
from bench import Outline, section, settled_bench  # noqa: E402
from dig import dig  # noqa: E402
from rock import Grading, Material, Rocks  # noqa: E402
from shovel import Motion, Shovel, with_rake  # noqa: E402

KEYS = {"toe_m": 0.0, "rake_deg": 0.0, "density": 1.0, "size": 1.0, "friction": None, "steel": None, "passes": 3}
HEAD = "time_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,load_kg,moving_share"
MOTION = HERE.parents[1] / "cases/screening/motion.csv"


def main(words):
    from yade import config
    seed, folder = int(words[0]), Path(words[1]) / words[0]
    keys = {**KEYS, **{k: float(v) for k, v in (w.split("=") for w in words[2:])}}
    if unknown := set(keys) - set(KEYS):
        raise SystemExit(f"unknown {sorted(unknown)}; one of {', '.join(KEYS)}")
    folder.mkdir(parents=True, exist_ok=True)
    material, outline = Material(), Outline()
    material = replace(material, density=material.density * keys["density"],
                       friction=keys["friction"] or material.friction, steel=keys["steel"] or material.steel)
    shovel, motion = with_rake(Shovel(), keys["rake_deg"]), Motion.read(MOTION)
    note_file = folder / "run.json"
    notes = json.loads(note_file.read_text()) if note_file.exists() else {"cpu_s": {}, "digs": {}}
    notes.update(seed=seed, yade=config.version, command=" ".join(["truck.py", words[0], *words[2:]]), keys=keys,
                 material=asdict(material))

    def keep(name, rocks, start):
        notes["cpu_s"][name] = round(time.process_time() - start, 1)
        rocks.save(folder / f"{name}.npz")
        note_file.write_text(json.dumps(notes, indent=1))
    if not (folder / "bench.npz").exists():
        start = time.process_time()
        keep("bench", settled_bench(material, Grading().scaled(keys["size"]), outline, seed), start)
    rocks = Rocks.load(folder / "bench.npz").moved((-keys["toe_m"], 0, 0))
    outline = replace(outline, toe=outline.toe - keys["toe_m"])
    for number, (start_s, _, _) in enumerate(motion.passes()[:int(keys["passes"])], 1):
        begin = 34.0 * (number - 1)      # the plan's cycle: a dig begins so long after the one before
        left = folder / f"left_{number}.npz"
        heading = float(motion(begin + 2.0)[2])
        if not left.exists():
            start = time.process_time()
            before = section(rocks, heading)
            table, after, notes["digs"][str(number)] = dig(rocks, material, outline, shovel, motion, begin)
            np.savetxt(folder / f"pass_{number}.csv.gz", table, delimiter=",", header=HEAD, comments="", fmt="%.6g")
            np.savetxt(folder / f"face_{number}.csv", np.c_[before, section(after, heading)[:, 1]], delimiter=",",
                       header="x_m,z_before_m,z_after_m", comments="", fmt="%.3f")
            keep(f"left_{number}", after, start)
        rocks = Rocks.load(left)


main(sys.argv[1:])
