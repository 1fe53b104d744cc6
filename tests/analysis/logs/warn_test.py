"""What is legal in a log and hardly ever meant: a line that begins with "warning: "."""
from types import SimpleNamespace

import numpy as np
import pytest

from dipper_import.masses import _warn_of_rise, _warn_of_tare, Scale, truck_masses
from dipper_import.warn import (_warn_of_empty, _warn_of_falls, _warn_of_scale, _warn_of_sign, _warn_of_size,
                                _warn_of_stuck, warn_of_masses, warn_of_readings)
from dipper_run.findings import Findings

SCALE = SimpleNamespace(column="Truck", reads="dipper", sigma=0.5, held=False)
TIME = 0.2 * np.arange(300)


def of(scale):
    return SimpleNamespace(channels={"truck_mass": scale}, longest_gap_s=2.0)


@pytest.mark.parametrize("masses, warns", [
    ([68.4, 71.0], None), ([0.0684, 0.071], "the fullest pass brings 0.071 t"), ([0.0, 0.0], None),
    ([109.0, 130.0], None), ([95.0, 150.8], "pass 2 brings 150.8 t, more than 1.3 times the 109 t")])
def test_masses_beyond_what_a_dipper_brings(masses, warns):
    notes = []
    warn_of_masses(masses, SimpleNamespace(rated_load_t=109.0, channels={"truck_mass": SCALE}), notes)
    assert (warns is None and not notes) or notes[0].startswith(f"warning: truck_mass: {warns}")
    notes.clear()
    warn_of_masses([500.0], SimpleNamespace(rated_load_t=None, channels={"truck_mass": SCALE}), notes)
    assert not notes


@pytest.mark.parametrize("reads, masses, warns", [
    ("pass", [40, 85, 135], "rise with every pass"), ("pass", [40, 45, 50], None), ("pass", [40], None),
    ("pass", [135, 135, 135], "are equal to the last digit"), ("total", [40, 5, 5], "are small after the first"),
    ("total", [80, 75, 66], None), ("total", [40], None), ("dipper", [80, 80], None)])
def test_masses_that_another_kind_of_scale_shows(reads, masses, warns):
    scale = SimpleNamespace(reads=reads)
    warn_of_masses(masses, SimpleNamespace(rated_load_t=None, channels={"truck_mass": scale}), notes := [])
    assert bool(notes) == bool(warns)
    assert not warns or f"warning: truck_mass: with reads: {reads} the passes bring {masses[0]}, " in notes[0]
    assert not warns or warns in notes[0]


@pytest.mark.parametrize("empty, warns", [(0.0, False), (1.4, False), (12.0, True), (71.2, True)])
def test_a_payload_monitor_that_shows_a_load_as_a_pass_begins(empty, warns):
    notes = []
    _warn_of_tare(2, empty, 71.2, SCALE, notes)
    assert bool(notes) == warns
    if warns:
        assert notes[0].startswith(f"warning: truck_mass: as pass 2 begins, {empty:g} t are in the dipper")
    _warn_of_tare(1, None, 71.2, SCALE, notes)
    assert len(notes) == warns


@pytest.mark.parametrize("ends_s, warns", [(50.0, False), (56.0, True), (59.8, False)])
def test_a_scale_that_still_rises_as_the_log_ends(ends_s, warns):
    mass = np.interp(TIME, [0, 50, 57.5], [60.0, 60.0, 75.0])
    rows = SimpleNamespace(time_s=TIME[TIME <= ends_s], values={"truck_mass": mass[TIME <= ends_s]})
    _warn_of_rise(Scale(rows, SCALE, 2.0), 2, ends_s, SCALE, notes := [])
    assert bool(notes) == warns
    assert not warns or "still rises as the log ends, from 69 to 71 t within 2 s: pass 2 may have" in notes[0]


@pytest.mark.parametrize("late_s, masses, warns", [(0, [60.0, 70.0], False), (10, [55.0, 60.0], True)])
def test_a_scale_that_shows_a_pass_after_its_end(monkeypatch, late_s, masses, warns):
    monkeypatch.setattr("dipper_import.masses.find_phases", lambda *_: [{"dump": (25.0, 28.0)}, {"dump": (50.0, 53.0)}])
    mass = np.where(TIME < 26 + late_s, 55.0, np.where(TIME < 51 + late_s, 60.0, 70.0))
    rows = SimpleNamespace(time_s=TIME, lines=2 + np.arange(300), values={"truck_mass": mass})
    fits = {n: SimpleNamespace(value=TIME) for n in ("crowd", "swing")}
    notes, found = [], Findings()
    scale = SimpleNamespace(column="Truck", reads="pass", sigma=0.5, held=False)
    assert truck_masses(rows, fits, TIME, [(0, 30), (30, 55)], of(scale), "log.csv", found, notes) == masses
    assert not found.all and bool(notes) == warns
    assert not warns or notes[0].startswith("warning: truck_mass: 55 t as pass 1 ends, and 60 t before the next dump")


@pytest.mark.parametrize("low, until, back, warns", [
    (0.0, 150, 60.0, True), (-5.0, 150, 60.4, True), (0.0, 300, 60.0, False),  # the truck leaves
    (0.0, 150, 85.0, False), (58.0, 150, 60.0, False), (0.0, 260, 60.0, False)])  # another; noise; after a pass
def test_a_total_that_falls_and_is_back_at_once(low, until, back, warns):
    mass = np.where(TIME < 10, 0.0, 60.0)
    mass[110:until], mass[until:] = low, back
    rows = SimpleNamespace(time_s=TIME, lines=2 + np.arange(300), values={"truck_mass": mass})
    scale = SimpleNamespace(reads="total", sigma=0.5)
    _warn_of_scale(rows, [(0, 20), (20, 45)], scale, notes := [])
    assert bool(notes) == warns
    assert not warns or f"60 t, then {low:g} t from line 112 and {back:g} t again at line 152" in notes[0]
    scale.reads = "dipper"
    _warn_of_scale(rows, [(0, 20), (20, 45)], scale, none := [])
    assert not none


@pytest.mark.parametrize("spans, warns", [
    ([(0, 25), (25, 50), (50, 70)], None), ([(0, 25), (25, 30), (30, 55)], "pass 2 (25 to 30 s) takes less than half "),
    ([(0, 8), (8, 33), (33, 200)], "pass 1 (0 to 8 s) takes less than half of the usual 25 s: does the log begin")])
def test_a_pass_that_is_short_among_others(spans, warns):
    rows = SimpleNamespace(time_s=TIME, lines=2 + np.arange(300), values={})
    warn_of_readings(rows, spans, SimpleNamespace(channels={}), notes := [])
    assert not notes if warns is None else len(notes) == 1 and notes[0].startswith(f"warning: {warns}")


@pytest.mark.parametrize("sign, offset", [(1, 900), (1, 0), (-1, 900)])
def test_a_rope_that_pushes(sign, offset):
    """Not one that is slack most of the time."""
    force = sign * (offset + np.maximum(0, 300 * np.sin(TIME))) + np.random.default_rng(1).standard_normal(300)
    _warn_of_sign(SimpleNamespace(values={"hoist_force": force}), notes := [])
    assert bool(notes) == (sign < 0)
    assert not notes or notes[0].endswith("channels.hoist_force.sign: -1, perhaps?")


def test_it_is_looked_at_in_every_pass(monkeypatch):
    """Of a monitor that keeps the last pass's 60 t until the next is weighed at 20 s."""
    monkeypatch.setattr("dipper_import.masses.find_phases", lambda *_: [{"dump": (25.0, 28.0)}, {"dump": (55.0, 58.0)}])
    mass = np.where(TIME < 20, 0.0, np.where(TIME < 50, 60.0, 70.0))
    rows = SimpleNamespace(time_s=TIME, lines=2 + np.arange(300), values={"truck_mass": mass})
    fits = {n: SimpleNamespace(value=TIME) for n in ("crowd", "swing")}
    notes, found = [], Findings()
    assert truck_masses(rows, fits, TIME, [(0, 30), (30, 59.8)], of(SCALE), "log.csv", found, notes) == [60.0, 70.0]
    assert not found.all and len(notes) == 1 and "as pass 2 begins, 60 t are in the dipper" in notes[0]


def test_a_force_that_most_rows_lack():
    force = np.where(np.arange(300) % 7 == 0, 500.0, np.nan)
    notes = []
    _warn_of_empty("hoist_force", SimpleNamespace(values={"hoist_force": force}), notes)
    assert notes == ["warning: hoist_force: 257 of 300 rows have no reading: channels.hoist_force.held: true, if it is "
                     "written only as it changes"]


@pytest.mark.parametrize("name, gone, warned", [
    ("hoist_force", range(60, 75), "15 readings (lines 62, 63, 64, 65, 66 and 10 more)"),
    ("crowd_force", range(5, 290, 20), "15 readings (lines 7, 27, 47, 67, 87 and 10 more)"),
    ("hoist_force", (60, 61), None), ("hoist_force", (), None), ("hoist_force", range(15), None)])
def test_a_force_that_falls_to_nothing_and_back(name, gone, warned):
    """Zeros as loggers write them while a cell is away; not a force that passes through zero, or begins with it."""
    force = 900 + 300 * np.sin(TIME)
    force[list(gone)] = 0
    notes = []
    _warn_of_falls(name, SimpleNamespace(lines=2 + np.arange(300), values={name: force}), notes)
    assert [warned in n for n in notes] == ([True] if warned else []), notes
    through = np.round(np.linspace(-1000, 1000, 300) / 100) * 100  # steps of an instrument
    _warn_of_falls(name, SimpleNamespace(lines=2 + np.arange(300), values={name: through}), empty := [])
    assert not empty


@pytest.mark.parametrize("low", [-1, 0.1])
def test_a_force_that_falls_to_another_small_number_and_back(low):
    force = 900 + 300 * np.sin(TIME)
    force[[9, 80, 81, 200]] = low
    _warn_of_falls("hoist_force", SimpleNamespace(lines=2 + np.arange(300), values={"hoist_force": force}), notes := [])
    assert len(notes) == 1 and f"4 readings (lines 11, 82, 83, 202) of {low:g} kN between others of" in notes[0]
    assert "list the number under file.missing" in notes[0]


def test_forces_smaller_than_the_weight_of_the_machine_s_dipper():
    """In tonnes of force, read as kN."""
    what = SimpleNamespace(stall_kN={"hoist_force": 4800.0}, empty_kN={"hoist_force": 490.5})
    for scale, warns in ((1, False), (1 / 9.80665, True)):
        rows = SimpleNamespace(lines=2 + np.arange(300), values={"hoist_force": scale * (900 + 300 * np.sin(TIME))})
        _warn_of_size("hoist_force", rows, what, notes := [])
        assert bool(notes) == warns
    assert "no reading is beyond 122.4 kN, less than an empty dipper takes (490.5 kN)" in notes[0]


def test_a_force_that_changes_its_sign_at_once_falls_to_nothing():
    force = np.where(np.arange(300) // 10 % 2, 800.0, -800.0) + TIME
    force[::10] = 5.0
    _warn_of_falls("crowd_force", SimpleNamespace(lines=2 + np.arange(300), values={"crowd_force": force}), notes := [])
    assert not notes


@pytest.mark.parametrize("scale, warns", [(1, False), (1e-3, True), (0, False)])
def test_forces_smaller_than_an_empty_dipper_s(scale, warns):
    what = SimpleNamespace(stall_kN={"hoist_force": 4800.0}, empty_kN={})
    rows = SimpleNamespace(lines=2 + np.arange(300), values={"hoist_force": scale * (900 + 300 * np.sin(TIME))})
    _warn_of_size("hoist_force", rows, what, notes := [])
    assert bool(notes) == warns
    assert not warns or "no reading is beyond 1.2 kN, less than an empty dipper takes" in notes[0]


@pytest.mark.parametrize("rows, hoist_m_s, warned", [
    (60, 0.5, "812.5 kN in all 60 rows from line 102 to 161, while hoist and crowd move by 29.5 m"),
    (60, 0.0, None),   # the machine stands: so does its force
    (8, 1.5, None)])   # a moment
def test_a_force_that_does_not_change_while_the_machine_moves(rows, hoist_m_s, warned):
    force = 900 + 50 * np.sin(np.arange(300.0))
    force[100:100 + rows] = 812.5
    hoist = hoist_m_s * np.minimum(np.arange(300.0), 200)
    hoist[150] = np.nan
    log = SimpleNamespace(lines=2 + np.arange(300),
                          values={"hoist_force": force, "hoist": hoist, "crowd": np.full(300, 1.0)})
    _warn_of_stuck("hoist_force", log, notes := [])
    assert [warned in note for note in notes] == ([True] if warned else [])


def test_a_force_that_never_changes():
    log = SimpleNamespace(lines=2 + np.arange(50), values={"crowd_force": np.full(50, 7.0), "hoist": np.zeros(50),
                                                           "crowd": 0.2 * np.arange(50.0)})
    _warn_of_stuck("crowd_force", log, notes := [])
    assert "7 kN in all 50 rows" in notes[0]
