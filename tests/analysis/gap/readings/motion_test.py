"""A logger of another rate than the case's, and holes in its readings, are asked about before anything runs."""
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import synthetic
from dipper_gap.readings.measured import read_measured
from dipper_gap.readings.motion import PlannedMotion, compare_motion, read_motion
from dipper_run.program import check_json
from trucks import in_a_row

CASE = Path(__file__).resolve().parents[4] / "cases/screening"
VALUES = {"machine.motion": "motion.csv", "end_s": 0, "observation.rate_Hz": 1}
BLIND = Path(__file__).resolve().parents[1] / "blind/measured"


def asked(rate_hz, planned_hz=1.0):
    time, hoist, crowd, swing = synthetic.motion(10.0)
    plan = PlannedMotion(time, {"hoist_m": hoist, "crowd_m": crowd, "swing_rad": swing},
                         tuple((48.0 * k, 48.0 * (k + 1)) for k in range(3)), 1 / planned_hz)
    return compare_motion(synthetic.run(rate_hz=rate_hz), plan)


@pytest.mark.parametrize("rate_hz, step", [(2.0, "0.5"), (5.0, "0.2"), (0.5, "2")])
def test_another_rate_than_the_runs_is_asked_about_once(rate_hz, step):
    line = f"a reading every {step} s, and the case's every 1 s: set observation.rate_Hz in the case"
    assert asked(rate_hz) == (line,)
    assert asked(rate_hz, planned_hz=rate_hz) == ()


def test_a_hole_in_a_pass_is_asked_about():
    m, plan = synthetic.run(), read_motion(CASE, VALUES)
    there = [i for i, t in enumerate(m.time_s) if not 60 < t < 70]
    m = replace(m, time_s=m.time_s[there], signals={n: v[there] for n, v in m.signals.items()})
    assert "10 s without a reading in pass 2 of truck 1" in compare_motion(m, plan)


def cut(m, keep):
    there = np.flatnonzero(keep(m.time_s))
    return replace(m, time_s=m.time_s[there], signals={n: v[there] for n, v in m.signals.items()})


def test_a_log_that_begins_late_or_ends_early_is_asked_about():
    m, plan = synthetic.run(), read_motion(CASE, VALUES)
    end = m.passes[-1].t_end_s
    assert "12 s without a reading in pass 1 of truck 1" in compare_motion(cut(m, lambda t: t >= 12), plan)
    assert "25 s without a reading in pass 3 of truck 1" in compare_motion(cut(m, lambda t: t <= end - 25), plan)


def test_every_truck_is_compared_with_the_motion():
    one = synthetic.run()
    off = replace(one, signals={**one.signals, "hoist_m": one.signals["hoist_m"] + 8.0})
    time, hoist, crowd, swing = synthetic.motion(10.0)
    plan = PlannedMotion(time, {"hoist_m": hoist, "crowd_m": crowd, "swing_rad": swing},
                         tuple((48.0 * k, 48.0 * (k + 1)) for k in range(3)), 1.0)
    assert compare_motion(in_a_row([one, one]), plan) == ()
    assert compare_motion(in_a_row([one, off]), plan) == (
        "hoist_m of truck 2 is 8 m (rms) off the case's motion: is its motion the measured one?",)


def test_the_runs_rate_is_the_cases():
    steps = [read_motion(CASE, {**VALUES, "observation.rate_Hz": rate}).step_s for rate in (1, 5)]
    assert steps == [1.0, 0.2]


def test_the_sealed_set_has_the_runs_rate_and_no_holes():
    plan = read_motion(CASE, check_json(CASE)["values"])
    folders = sorted(BLIND.iterdir())
    lines = [line for f in folders for line in compare_motion(read_measured(f), plan)]
    assert len(folders) == 52 and not [line for line in lines if "reading" in line]
