"""A hidden effect in a mine of real paired runs is found, named, added, and the gap shrinks on the hold-out.

The mine is the fraternal twin with friction in its crowd, done another way than the catalogue does it. Model and
twin are coarser than in the blind test and dig two passes, so that it fits into a test: about 14 runs.
"""
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "blind"))
import make  # noqa: E402
import twin  # noqa: E402
from dipper_run.program import program  # noqa: E402
from dipper_gap.simulation.effects import read_catalogue  # noqa: E402
from dipper_gap.gap_json import as_json, write_json  # noqa: E402
from dipper_gap.decision.patch import write_patched_case  # noqa: E402
from dipper_gap.simulation.simulator import DipperSimulator, request  # noqa: E402
from dipper_gap.simulation.plan import FRESH_SEEDS, LEAST_SEEDS  # noqa: E402
from dipper_gap.workflow import analyse  # noqa: E402

# Effects whose signatures need no rock to run anew: the whole catalogue takes 60 runs.
NAMES = ("crowd_friction", "hoist_drive_loss", "scale_gain", "logger_offset")
HIDDEN_KN = 200.0


def coarse(case, graining, timestep_s):
    case["rock"]["coarse_graining"] = graining
    case["dem"]["timestep_s"] = timestep_s
    case["end_s"] = 47.0  # two passes
    return case


@pytest.fixture(scope="module")
def mine(tmp_path_factory):
    work = tmp_path_factory.mktemp("live")
    model = work / "model"
    model.mkdir()
    (model / "case.yaml").write_text(yaml.safe_dump(coarse(twin.model_case(), 5.0, 2e-3), sort_keys=False))
    truth = coarse(twin.twin_case(), 4.5, 1.6e-3)
    run = twin.run(truth, 77, work / "truth", program())
    plan = make.Plan("effect", {}, {"crowd_friction": HIDDEN_KN})
    rng = np.random.default_rng(5)
    return work, model, make.as_mine([make.log(run, plan, rng, program())], rng)


def test_a_hidden_effect_is_named_added_and_the_gap_shrinks(mine):
    work, model, measured = mine
    catalogue = {n: e for n, e in read_catalogue(model).items() if n in NAMES}
    simulator = DipperSimulator(model, catalogue, program(), work / "cache")
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
