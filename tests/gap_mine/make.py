#!/usr/bin/python3
"""Draws what is hidden in each case of the sealed set, writes the measured folders, and seals the truths.

usage: make.py FOLDER SECRET [RUNS]

RUNS (default: runs beside this file) has the stored digs: RUNS/base/SEED, and RUNS/NAME_STRENGTH/SEED of what needs
digs of its own. SECRET is a text that decides every draw. FOLDER gets measured/CASE, reference/CASE (the same
instruments on earlier trucks, of when nothing was hidden), sealed.csv (the SHA-256 of each truth) and truth.zip.
Strengths are multiples of the limit from which on the model gives an effect its name (docs/data/gap_limits.csv:
four trucks, the face surveyed, against a reference of this mine), and are those of LAID where there is none.
"""
import csv
import hashlib
import json
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from cycle import Dig  # noqa: E402
from effects import CATALOGUE  # noqa: E402
from instruments import Errors, write_folder  # noqa: E402
from shovel import Motion  # noqa: E402

ROOT = HERE.parents[1]
TRUCKS, PASSES = 4, 3
JITTER = 0.1                        # of a strength, so that it is no round multiple
# what is laid over stored digs: (a plausible strength where the model has no limit, the largest that is drawn)
LAID = {"hoist_drive_loss": (0.2, 0.27), "crowd_friction": (250.0, 360.0), "truck_spillage": (0.3, 0.45),
        "logger_offset": (1.0, 2.7), "carry_back": (0.4, 0.54), "liners": (0.1, 0.135), "leaking_door": (0.125, 0.27),
        "scale_gain": (-0.12, 0.27), "payload_bias": (-7.5, 13.5), "hoist_cell_drift": (0.2, 0.36),
        "crowd_cell_drift": (0.2, 0.36)}
PAIRS = (("crowd_friction", "truck_spillage"), ("hoist_drive_loss", "logger_offset"), ("carry_back", "crowd_friction"),
         ("hoist_drive_loss", "truck_spillage"), ("liners", "hoist_drive_loss"), ("crowd_friction", "logger_offset"))
OUTSIDE = {"sticky_load": 0.12, "sloping_ground": 2.5, "tight_crowd": 40.0, "cable_drag": 110.0,
           "hoist_zero_drift": 180.0, "crowd_zero_drift": 150.0, "clipped_cell": 1600.0, "lazy_cell": 1.2}
DECOYS = {"rock_density": 0.015}
CONTROLS = 6


@dataclass
class Plan:
    kind: str                # effect | pair | outside | control | decoy, as tests/analysis/gap/score.py has them
    hidden: dict             # {effect: strength}
    times: float             # of the limit
    runs: str = "base"       # whose digs


def rng_of(secret, what):
    return np.random.default_rng(list(hashlib.sha256(f"{secret} {what}".encode()).digest()))


def limits(file=ROOT / "docs/data/gap_limits.csv"):
    """{effect: limit of four trucks with surveyed faces against a reference, None where there is none}"""
    rows = csv.DictReader(line for line in open(file) if not line.startswith("#"))
    return {r["effect"]: float(r["named_reference"]) if r["named_reference"] else None for r in rows}


def strength(name, times, rng, limit):
    """(strength, in limits): about `times` the limit, within bounds; 0 limits where there is none within them."""
    usual, most = LAID[name]
    jitter = 1 + JITTER * rng.uniform(-1, 1)
    if limit is None or limit > most:
        return usual * jitter, 0.0
    sign = rng.choice([-1, 1]) if name == "logger_offset" else np.sign(usual)
    size = min(times * limit * jitter, most)
    return float(sign * size), float(size / limit)


def plans(rng, runs, limit):
    """All cases, in an order of chance."""
    out = []

    def add(kind, names, times):
        drawn = {n: strength(n, times, rng, limit.get(n)) for n in names}
        out.append(Plan(kind, {n: s for n, (s, _) in drawn.items()}, min(x for _, x in drawn.values())))

    for name in LAID:
        for times in (1.0, 2.0) if limit.get(name) else (1.0,):
            add("effect", (name,), times)
    for pair in PAIRS:
        add("pair", pair, 2.0)
    out += [Plan("outside", {name: s * (1 + JITTER * rng.uniform(-1, 1))}, 1.0) for name, s in OUTSIDE.items()]
    out += [Plan("decoy", {name: s * sign}, 0.0) for name, s in DECOYS.items() for sign in (-1, 1)]
    out += [Plan("control", {}, 0.0) for _ in range(CONTROLS)]
    for folder in sorted(runs.iterdir()):   # those with digs of their own
        if folder.name != "base" and complete(folder):
            name, _, s = folder.name.rpartition("_")
            out.append(Plan("effect" if name in CATALOGUE else "outside", {name: float(s)},
                            float(s) / limit[name] if limit.get(name) else 0.0, folder.name))
    rng.shuffle(out)
    return out


def complete(folder):
    """Seeds of a folder of runs that have all their digs."""
    return sorted(f for f in folder.iterdir() if all((f / f"pass_{k}.csv.gz").exists() for k in range(1, PASSES + 1)))


def drawn_trucks(folders, rng):
    """TRUCKS trucks: the digs of each pass are of other seeds, in an order of its own. The lanes hardly touch, so a
    pass of one bench and the next of another make a truck; with fewer benches than trucks some come twice.
    """
    order = [np.resize(rng.permutation(len(folders)), TRUCKS) for _ in range(PASSES)]
    return [[Dig.load(folders[order[k][i]], k + 1) for k in range(PASSES)] for i in range(TRUCKS)]


def halves(folders, rng):
    """Folders for the trucks of now, and others for the earlier ones, where there are enough for both."""
    if len(folders) < 2 * TRUCKS:
        return folders, folders
    mixed = [folders[k] for k in rng.permutation(len(folders))]
    return mixed[:len(mixed) // 2], mixed[len(mixed) // 2:]


def write_case(folder, case, plan, runs, motion, secret):
    """The truth of one case, after its folders are written."""
    rng, base = rng_of(secret, f"noise {case}"), complete(runs / "base")
    now, earlier = halves(base, rng) if plan.runs == "base" else (complete(runs / plan.runs), base)
    errors = Errors.draw(rng)
    piles = [float(r["angle_deg"]) for r in csv.DictReader(open(HERE / "piles.csv"))]
    laid = {} if plan.runs != "base" else plan.hidden
    trucks = drawn_trucks(now, rng)
    write_folder(folder / "measured" / case, trucks, laid, motion, errors, rng, piles)
    before = errors.moved(rng)
    write_folder(folder / "reference" / case, drawn_trucks(earlier, rng), {}, motion, before, rng, piles)
    return {"kind": plan.kind, "effects": plan.hidden if plan.kind in ("effect", "pair") else {},
            "implementation": plan.hidden, "times_limit": round(plan.times, 3), "runs": plan.runs,
            "seeds": [[d.seed for d in t] for t in trucks], "reference": True,
            "salt": hashlib.sha256(f"{secret} {case}".encode()).hexdigest()}


def main(words):
    if len(words) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    folder, secret = Path(words[0]), words[1]
    runs = Path(words[2]) if len(words) == 3 else HERE / "runs"
    if (folder / "sealed.csv").exists():
        print(f"make: {folder}/sealed.csv is there already: truths are sealed once", file=sys.stderr)
        return 2
    motion = Motion.read(ROOT / "cases/screening/motion.csv")
    todo, seals = plans(rng_of(secret, "plans"), runs, limits()), []
    folder.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(folder / "truth.zip", "w", zipfile.ZIP_DEFLATED) as box:
        for number, plan in enumerate(todo, 1):
            case = f"m{number:02d}"
            truth = json.dumps(write_case(folder, case, plan, runs, motion, secret), indent=1)
            info = zipfile.ZipInfo(f"truth/{case}.yaml", (2000, 1, 1, 0, 0, 0))  # JSON is YAML
            box.writestr(info, truth)
            seals.append(f"{case},{hashlib.sha256(truth.encode()).hexdigest()}")
    (folder / "sealed.csv").write_text("case,sha256\n" + "\n".join(seals) + "\n")
    print(f"{len(todo)} cases written, their truths sealed")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
