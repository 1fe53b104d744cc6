"""A hidden effect in a mine of real paired runs is found, named, added, and the gap shrinks on the hold-out.

The mine is another simulation: finer rock, stiffer contacts, another packing, time step and sync step, with friction
in its crowd done another way than the catalogue does it. Model and mine are coarse, soft and dig two passes, so that
it fits into a test: about 14 runs.
"""
import json
import os
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml

import synthetic
from dipper_gap.decision.patch import write_patched_case
from dipper_gap.gap_json import as_json, write_json
from dipper_gap.readings.measured import read_measured
from dipper_gap.simulation.effects import read_catalogue
from dipper_gap.simulation.plan import FRESH_SEEDS, LEAST_SEEDS
from dipper_gap.simulation.simulator import DipperSimulator, request
from dipper_gap.workflow import analyse
from dipper_run.program import program

CASES = Path(__file__).resolve().parents[3] / "cases"
# Effects whose signatures need no rock to run anew: the whole catalogue takes 60 runs.
NAMES = ("crowd_friction", "hoist_drive_loss", "scale_gain", "logger_offset")
HIDDEN_KN = 200.0
RATE_HZ = 20
QUICKER = 1.25  # than the motion of `cases/screening`: about as fast as the drives may go


def two_passes(folder, changes):
    """A coarse, soft `cases/screening` of two quick passes, with {section: {key: value}} changed, in `folder`."""
    text = (CASES / "screening/case.yaml").read_text().replace("../../", f"{CASES.parent}/")
    case = yaml.safe_load(text)
    case["machine"]["motion"] = "motion.csv"
    case["machine"]["contact_on_return"] = "off"  # YAML reads it as false
    case["end_s"] = 60.0 / QUICKER
    case["output"]["dump_every_s"] = 100000
    for section, values in changes.items():
        case[section].update(values)
    folder.mkdir()
    rows = [line.split(",") for line in (CASES / "screening/motion.csv").read_text().splitlines() if line[0] != "#"]
    times = [[f"{float(row[0]) / QUICKER:.4f}", *row[1:]] for row in rows[1:]]
    (folder / "motion.csv").write_text("\n".join(map(",".join, [rows[0], *times])) + "\n")
    (folder / "case.yaml").write_text(yaml.safe_dump(case, sort_keys=False))
    return folder


def logged(run, seed):
    """A run with friction in its crowd as the mine logs it, once a second, through its instruments."""
    seen = run.parent / "seen"
    subprocess.run([program(), "observe", run, "--set", f"observation.rate_Hz={RATE_HZ}", "--out", seen], check=True,
                   capture_output=True)
    mine = read_measured(seen, simulated=True)
    speed = np.gradient(mine.signals["crowd_m"], mine.time_s)
    stribeck = (0.9 + 0.25 * np.exp(-(speed / 0.1) ** 2) + 0.15 * np.abs(speed)) * np.tanh(speed / 0.02)
    true = {**mine.signals, "crowd_force_kN": mine.signals["crowd_force_kN"] + HIDDEN_KN * stribeck}
    n = len(mine.time_s) // RATE_HZ * RATE_HZ
    seconds = replace(mine, time_s=mine.time_s[:n].reshape(-1, RATE_HZ)[:, -1],
                      signals={name: true[name][:n].reshape(-1, RATE_HZ).mean(axis=1)
                               for name in synthetic.CHANNELS if name in true},
                      passes=tuple(p for p in mine.passes if p.truck_mass_t > 0), profiles={}, left={})
    return synthetic.with_noise(seconds, seed)


@pytest.fixture(scope="module")
def mine(tmp_path_factory):
    work = tmp_path_factory.mktemp("live")
    model = two_passes(work / "model", {"rock": {"coarse_graining": 5.0, "coarse_graining_limit_m": 2.0},
                                        "contact": {"normal_scale": 0.001}, "dem": {"timestep_s": 2e-3},
                                        "coupling": {"sync_steps": 3}})
    other = two_passes(work / "other", {"rock": {"coarse_graining": 4.5, "coarse_graining_limit_m": 2.0},
                                        "contact": {"normal_scale": 0.0013}, "dem": {"timestep_s": 1.6e-3},
                                        "coupling": {"sync_steps": 2}, "pile": {"settle_s": 3.0, "relax_s": 2.5}})
    run = work / "run"
    subprocess.run([program(), "run", other, "--out", run, "--ranks", "1", "--seed", "77"], check=True,
                   stdout=subprocess.DEVNULL, env={**os.environ, "XDG_CACHE_HOME": str(work)})
    return work, model, logged(run, 5)


def test_a_hidden_effect_is_named_added_and_the_gap_shrinks(mine):
    work, model, measured = mine
    catalogue = {n: e for n, e in read_catalogue(model).items() if n in NAMES}
    simulator = DipperSimulator(model, catalogue, program(), work / "cache", jobs=1)
    out = analyse(measured, simulator, catalogue, 1, lambda text: print(text, flush=True))
    answer = as_json(out, catalogue, {"case": simulator.case_hash()})
    write_json(answer, work / "gap.json")
    a = json.loads((work / "gap.json").read_text())
    assert a["verdict"] == "named" and a["effect"] == "crowd_friction"
    low, high = a["parameter"]["interval90"]
    assert 0.5 * HIDDEN_KN < low < high < 2 * HIDDEN_KN
    assert a["gap"]["holdout_p"] < 0.05 and a["gap"]["holdout_closure"] > 0.3
    assert {d["channel"] for d in a["disagreement"]} == {"crowd_force_kN"}

    # What it wrote is a case that the simulator takes as it is.
    write_patched_case(model, out.effects, work / "patched")
    checked = subprocess.run([program(), "check", str(work / "patched")], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr

    # Everything is kept: a second analysis makes no run.
    again = DipperSimulator(model, catalogue, program(), work / "cache")
    todo, kept, _ = again.plan([request({}, s, catalogue) for s in out.seeds["baseline"] + out.seeds["fresh"]])
    assert (todo, kept) == (0, LEAST_SEEDS + FRESH_SEEDS)
