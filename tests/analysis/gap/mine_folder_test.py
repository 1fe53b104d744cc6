"""What the mine of another code (tests/gap_mine) writes is a measured folder, and of the case's motion."""
import sys
from pathlib import Path

import numpy as np
import yaml

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "analysis/gap"), str(ROOT / "analysis/runs"), str(ROOT / "tests/gap_mine")]
from dipper_gap.readings.measured import read_measured  # noqa: E402
from instruments import Errors, write_folder  # noqa: E402
from shovel_test import MOTION, a_dig  # noqa: E402

CASE = ROOT / "cases/screening"


def folder(where, hidden, trucks=2):
    rng = np.random.default_rng(5)
    write_folder(where, [[a_dig(number=k) for k in range(3)]] * trucks, hidden, MOTION, Errors.draw(rng), rng, [34.0])
    return read_measured(where, need_passes=3)


def test_it_is_read_and_its_drives_are_the_case_s(tmp_path):
    m = folder(tmp_path / "m", {})
    assert len(m.passes) == 6 and len(m.trucks()) == 2
    assert all(abs(p.truck_mass_t - 60) < 6 for p in m.passes)
    lines = [line for line in (CASE / "motion.csv").read_text().splitlines() if not line.startswith("#")]
    plan = np.array([line.split(",") for line in lines[1:]], float)
    first = m.trucks()[0]
    middle = first.time_s[:90] - 0.5      # a reading is the mean since the last one
    assert np.abs(first.signals["hoist_m"][:90] - np.interp(middle, plan[:, 0], plan[:, 1])).max() < 0.15
    assert np.abs(first.signals["crowd_m"][:90] - np.interp(middle, plan[:, 0], plan[:, 2])).max() < 0.1


def test_what_is_hidden_shows_where_it_acts(tmp_path):
    plain, spilt = (folder(tmp_path / n, h) for n, h in (("a", {}), ("b", {"truck_spillage": 0.3})))
    mass = [np.array([p.truck_mass_t for p in m.passes]) for m in (plain, spilt)]
    assert np.allclose(mass[0] - mass[1], [0, 0, 18, 0, 0, 18], atol=0.6)     # the same errors: t
    assert np.array_equal(plain.signals["hoist_force_kN"], spilt.signals["hoist_force_kN"])
    rubbed = folder(tmp_path / "c", {"crowd_friction": 100.0})
    more = rubbed.signals["crowd_force_kN"] - plain.signals["crowd_force_kN"]
    v = np.gradient(plain.signals["crowd_m"], plain.time_s)
    assert np.allclose(more[v > 0.4], 100, atol=15) and np.allclose(more[v < -0.4], -100, atol=15)
    assert (tmp_path / "a/profile.csv").exists() and yaml.safe_load((tmp_path / "a/channels.yaml").read_text())
