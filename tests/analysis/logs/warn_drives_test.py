"""Drives that are read the wrong way, or that no drive can follow: a line that begins with "warning: "."""
from types import SimpleNamespace

import numpy as np
import pytest

import ugly_log
from dipper_import.clock import Rows
from dipper_import.import_map import Limits
from dipper_import.readings import Readings, sound_readings
from dipper_import.warn_drives import (_warn_of_all_far_off, _warn_of_door, _warn_of_far_off, _warn_of_jumps,
                                       _warn_of_little, _warn_of_start, _warn_of_throws)
from dipper_run.findings import Findings

SPEED = {"hoist": 1.8, "crowd": 1.0, "swing": 20.0}


def door(unit="deg", slope=1.0, intercept=0.0):
    return SimpleNamespace(unit=unit, slope=slope, intercept=intercept)


@pytest.mark.parametrize("channel, key", [
    (door("switch", 75.0), "range: [75, 0]"), (door("%", 0.9, 5.0), "range: [95, 5]"), (door(), "sign: -1, and an")])
def test_a_door_whose_ends_are_exchanged(channel, key):
    shut = np.where(np.arange(300) % 100 < 90, 0.0, 75.0)
    _warn_of_door(shut, channel, notes := [])
    assert not notes
    _warn_of_door(75 - shut, channel, notes)
    assert notes[0].startswith("warning: door: it is at 75 deg as the log begins, and open for 90 % of the time")
    assert f"channels.door.{key}" in notes[0]


@pytest.mark.parametrize("value", [np.zeros(50), 0.3 * np.sin(np.arange(50.0)) ** 2])
def test_a_door_that_stays_shut(value):
    _warn_of_door(value, door(), notes := [])
    assert not notes


@pytest.mark.parametrize("begins_s, spans, warns", [
    (0, [(0, 40), (40, 80), (80, 120)], False), (8, [(8, 40), (40, 80), (80, 120)], True),
    (12, [(12, 40), (40, 80)], True), (8, [(8, 40)], False)])
def test_a_log_that_begins_within_a_dig(begins_s, spans, warns):
    time_s = np.arange(0, 120, 0.1)
    crowd = np.interp(time_s % 40, [0, 3, 15, 25, 35, 40], [-1.0, -1.5, 2.9, 2.9, -1.5, -1.0])
    kept = time_s >= begins_s
    _warn_of_start(crowd[kept], time_s[kept], spans, notes := [])
    assert bool(notes) == warns
    assert not warns or notes[0].startswith(f"warning: pass 1 begins at {begins_s} s with the crowd")


def door_kept(value, rate_hz=5):
    n = len(value)
    rows = Rows(np.arange(n) / rate_hz, 2 + np.arange(n), {"door": value}, 1 / rate_hz, "", "")
    kept = sound_readings(rows, "door", SimpleNamespace(column="d", switch=True), Limits(),
                          SimpleNamespace(longest_gap_s=2.0), "log.csv", Findings(), notes := [])
    return np.flatnonzero(~kept.kept).tolist(), notes


@pytest.mark.parametrize("stroke", [1.0, 75.0])
def test_a_wrong_reading_of_a_door_is_no_opening(stroke):
    sound = np.where(np.arange(300) % 100 < 90, 0.0, stroke)
    assert door_kept(sound) == ([], []) and door_kept(logged("door", 5)) == ([], [])
    wrong = sound.copy()
    wrong[[40, 94]] = stroke - wrong[[40, 94]]
    out, notes = door_kept(wrong)
    assert out == [40, 94] and "door: 2 readings (lines 42, 96) more than half the stroke off both beside" in notes[0]
    assert door_kept(wrong, rate_hz=1) == ([], [])  # it may open and shut from one row to the next but one


def test_a_door_that_is_logged_as_a_pulse_opens():
    assert door_kept(np.where(np.arange(300) % 100 == 90, 1.0, 0.0)) == ([], [])


def jumps(name, value, rate_hz, speed=None, held=False):
    what = SimpleNamespace(channels={name: SimpleNamespace(held=held)},
                           limits={name: Limits(speed=speed or SPEED[name])})
    n = len(value)
    _warn_of_jumps(name, Readings(np.arange(n) / rate_hz, value, 2 + np.arange(n), np.ones(n, bool)), what, notes := [])
    return notes


def logged(name, rate_hz, scatter=0.01, step=0.0):
    value = ugly_log.planned(rate_hz).channels[name]
    value = value + scatter * (10 if name == "swing" else 1) * np.random.default_rng(1).standard_normal(len(value))
    return np.round(value / step) * step if step else value


@pytest.mark.parametrize("name", SPEED)
@pytest.mark.parametrize("rate_hz, scatter, step", [(5, 0.01, 0), (1, 0.01, 0), (100, 0.01, 0.001), (10, 0.0, 0.05)])
def test_a_sound_drive_has_none(name, rate_hz, scatter, step):
    assert not jumps(name, logged(name, rate_hz, scatter, step * (20 if name == "swing" else 1)), rate_hz)


@pytest.mark.parametrize("speed", [None, np.inf])
@pytest.mark.parametrize("rows, value", [(slice(60, 70), 0.0), (slice(60, 63), 0.0), (slice(45, 65), None)])
def test_a_drive_that_drops_to_one_value_or_is_stuck_there(rows, value, speed):
    hoist = logged("hoist", 5)
    hoist[rows] = hoist[rows.start] if value is None else value
    notes = jumps("hoist", hoist, 5, speed)
    assert len(notes) == 1 and f"in all {rows.stop - rows.start} rows from line {rows.start + 2} to {rows.stop + 1}, " \
        "beside readings that the drive cannot reach from there" in notes[0]
    assert not jumps("hoist", hoist, 5, held=True)


@pytest.mark.parametrize("name, wrong, off", [("crowd", 0.0, 1.2), ("swing", -0.8, 4.0)])
def test_a_reading_or_two_far_off_the_curve(name, wrong, off):
    channel, change = SimpleNamespace(held=False), 0.01 * np.random.default_rng(1).standard_normal(400)
    readings = Readings(0.2 * np.arange(400), np.zeros(400), 2 + np.arange(400), np.ones(400, bool))
    _warn_of_far_off(name, readings, change, channel, notes := [])
    assert not notes
    change[100:102] = off
    readings.value[100] = wrong
    _warn_of_far_off(name, readings, change, channel, notes)
    assert len(notes) == 1 and f"warning: {name}: {wrong:g} " in notes[0] and f"at line 102 is {off:g} " in notes[0]


@pytest.mark.parametrize("speed", [20.0, np.inf])
def test_a_wrong_reading_of_a_drive_without_limits_is_left_out(speed):
    time, swing = 0.2 * np.arange(376), logged("swing", 5)
    at = int(swing.argmax())
    swing[at:at + 2] = 0.0
    rows = Rows(time, 2 + np.arange(376), {"swing": swing}, 0.2, "", "")
    kept = sound_readings(rows, "swing", SimpleNamespace(column="s", switch=False), Limits(speed=speed),
                          SimpleNamespace(longest_gap_s=2.0), "log.csv", found := Findings(), notes := [])
    assert not found.all and np.flatnonzero(~kept.kept).tolist() == [at, at + 1]
    assert f"out of reach of their neighbours at {min(speed, 40):g} deg/s, left out; the first is 0" in notes[0]


def test_a_drive_that_is_logged_in_steps():
    """A reading a second in a log of five rows a second."""
    hoist = np.repeat(logged("hoist", 1), 5)
    assert not jumps("hoist", hoist, 5)


@pytest.mark.parametrize("limits", [Limits(-90, 90), Limits()])
def test_a_drive_that_takes_next_to_nothing_of_its_range(limits):
    what = SimpleNamespace(channels={"swing": SimpleNamespace(unit="deg")}, limits={"swing": limits})
    swing = ugly_log.planned(5).channels["swing"]
    _warn_of_little("swing", swing, what, notes := [])
    assert not notes
    _warn_of_little("swing", np.radians(swing), what, notes)
    assert notes[0].startswith("warning: swing: all its readings are within 1.") and "another unit (rad)" in notes[0]


@pytest.mark.parametrize("off, limited, warns", [(0.05, True, None), (0.2, True, "its limits hold it there"),
                                                 (0.2, False, "coarse readings, or those of two machines?")])
def test_a_curve_that_is_far_from_most_of_its_readings(off, limited, warns):
    readings = SimpleNamespace(lines=np.arange(2, 102))
    change = off * np.ones(100)
    _warn_of_all_far_off("hoist", readings, SimpleNamespace(change=change, limited=limited), notes := [])
    assert bool(notes) == bool(warns)
    assert not warns or f"the curve is {off:.2g} m (rms) off the readings" in notes[0] and warns in notes[0]


@pytest.mark.parametrize("passes, warns", [(2, False), (1, True)])
def test_a_switch_that_opens_more_often_than_passes_end(passes, warns):
    value = np.where(np.arange(100) % 50 == 30, 75.0, 0.0)
    _warn_of_throws(value, passes * [(0, 1)], notes := [])
    assert bool(notes) == warns
    assert not warns or "its switch opens 2 times, and 1 passes end with a dump" in notes[0]
