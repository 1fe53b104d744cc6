"""Forces of a measured folder that are legal and hardly meant are asked about; sound ones are not."""
import numpy as np
import pytest

import synthetic
from dipper_gap.readings.force_warnings import force_warnings


def signals(name="hoist_force_kN", change=None):
    m = synthetic.run(seed=1)
    rng = np.random.default_rng(2)
    out = {n: v + (25 * rng.standard_normal(len(v)) if "force" in n else 0) for n, v in m.signals.items()}
    if change:
        out[name] = change(out[name])
    return m.time_s, out


def with_rows(value, rows=slice(30, 34)):
    def change(force):
        force[rows] = value
        return force

    return change


def test_sound_forces_raise_no_question():
    assert force_warnings(*signals()) == [] == force_warnings(np.zeros(0), {})


@pytest.mark.parametrize("change, said", [
    (with_rows(-9999), "4 readings from 30 s such as -9999 kN: are these no readings, or in another unit?"),
    (with_rows(32767), "4 readings from 30 s such as 32767 kN: are these no readings, or in another unit?"),
    (with_rows(0), "4 readings from 30 s of 0 kN between others of "),
    (lambda force: 0 * force, "0 kN at most, less than an empty dipper takes: is it in kN, and is the instrument on?"),
    (lambda force: 1e-3 * force, "kN at most, less than an empty dipper takes: is it in kN"),
    (lambda force: -force, "its largest forces are negative, and a rope only pulls: is its sign right?"),
    (with_rows(812.5, slice(4, 30)), "812.5 kN in all 26 readings from 4 s to 29 s, while hoist and crowd move by ")])
def test_others_do(change, said):
    found = force_warnings(*signals(change=change))
    assert len(found) == 1 and found[0].startswith("hoist_force_kN: ") and said in found[0], found


def test_a_handle_pulls_and_pushes():
    assert force_warnings(*signals("crowd_force_kN", lambda force: -force)) == []


def test_a_reading_of_a_day_is_named_by_its_stamp():
    time_s, found = signals(change=with_rows(-9999))
    assert "4 readings from 2026-03-14T06:00:30Z such as -9999 kN" in force_warnings(1773468000 + time_s, found)[0]
