"""MAP.yaml: each fault at its line, all at once; units, signs, ranges and a machine's limits become numbers."""
import math

import pytest

import ugly_log
from dipper_import.import_map import read_map
from dipper_import.units import other_unit, unit_in_name
from dipper_run.findings import BadInput

SOUND = """\
time: {column: Clock}
channels:
  hoist: {column: H, unit: ft, sign: -1, scale: 2, offset: 3}
  crowd: {column: C, unit: "%", range: [-1.5, 3]}
  swing: {column: S, unit: rad}
  door: {column: D, unit: deg}
limits:
  machine: MACHINE
  hoist: {acceleration: 2, max: 0.25}
"""


@pytest.fixture
def sound(tmp_path):
    file = tmp_path / "map.yaml"
    file.write_text(SOUND.replace("MACHINE", str(ugly_log.ROOT / "mbs/bucyrus495.yaml")))
    return file


def test_a_sound_map(sound):
    what = read_map(sound)
    hoist, crowd, swing = (what.channels[n] for n in ("hoist", "crowd", "swing"))
    assert (hoist.slope, hoist.intercept) == pytest.approx((-0.6096, 0.9144))
    assert (crowd.slope * 100 + crowd.intercept, crowd.intercept) == pytest.approx((3, -1.5))
    assert swing.slope * math.pi == pytest.approx(180)
    assert (what.limits["hoist"].min, what.limits["hoist"].max) == (-12, 0.25)
    assert (what.limits["swing"].speed, what.limits["swing"].acceleration) == (20, math.inf)
    assert not what.measured() and (what.longest_gap_s, what.sample_s) == (2, 0.1)


@pytest.mark.parametrize("old, new, line, what", [
    ("scale: 2", "scal: 2", 3, "channels.hoist.scal: unknown key; scale, perhaps?"),
    ("scale: 2", "scale: 0", 3, "channels.hoist.scale: is 0; a number other than 0"),
    ("unit: ft", "unit: feet", 3, "channels.hoist.unit: is feet; one of m, mm, cm, ft"),
    ("unit: ft", "unit: kN", 3, "channels.hoist.unit: is kN"),
    ("sign: -1", "sign: minus", 3, "channels.hoist.sign: is minus; 1 or -1"),
    (", range: [-1.5, 3]", "", 4, "channels.crowd.range: missing; [a, b]: the m at 0 and 100 %"),
    ("range: [-1.5, 3]", "range: [3]", 4, "channels.crowd.range: is 3; two numbers that differ"),
    ("unit: rad", "unit: rad, range: [0, 1]", 5, "channels.swing.range: with the unit rad"),
    ("unit: deg}", "unit: switch, range: [0, 75]}", 6, "channels.door: is a switch, and its speed is not given"),
    ("  door:", "  dor:", 6, "channels.dor: unknown key; door, perhaps?"),
    ("  door: {column: D, unit: deg}\n", "", 2, "channels.door: missing; name its column"),
    ("time: {column: Clock}", "time: {column: Clock, format: DD.MM}", 1, "time.format: is DD.MM; iso, one of s,"),
    ("Clock}", "Clock, format: '%d.%m.%Y %H:%m'}", 1, "time.format: has %m twice; %M is minutes"),
    ("Clock}", "Clock, format: '%c %H'}", 1, "time.format: is %c %H, which says a part of the time twice; each part"),
    ("time: {column: Clock}\n", "", 1, "time: missing"),
    ("max: 0.25", "max: -20", 9, "limits.hoist.min: is -12; below max, -20"),
    ("acceleration: 2", "acceleration: -2", 9, "limits.hoist.acceleration: is -2; a number in m/s^2, above 0"),
    ("bucyrus495", "bucyrus", 8, "limits.machine: "),
    ("limits:\n", "sample_s: 0\nlimits:\n", 7, "sample_s: is 0; seconds, above 0"),
    ("{column: C,", "{column: H,", 4, "channels.crowd: has the column 'H', as hoist; a column of its own"),
    ("limits:\n", "file: {encoding: hex}\nlimits:\n", 7, "file.encoding: is hex; such as utf-8"),
    ("limits:\n", "file: {encoding: rot13}\nlimits:\n", 7, "file.encoding: is rot13; such as utf-8"),
    ("unit: rad", "unit: rad, unit: deg", 5, "channels.swing.unit: given twice"),
    ("limits:\n", "  hoist_force: {column: F, unit: kip}\nlimits:\n", 7, "channels.hoist_force.sigma: missing"),
])
def test_each_fault_is_reported_at_its_line(sound, old, new, line, what):
    assert old in sound.read_text()
    sound.write_text(sound.read_text().replace(old, new, 1))
    with pytest.raises(BadInput) as e:
        read_map(sound)
    assert any(f.startswith(f"{sound}:{line}: {what}") or (f.startswith(f"{sound}:{line}: ") and what in f)
               for f in e.value.findings), e.value.findings


@pytest.mark.parametrize("text", ["", "[]", "a: [", "channels: 3\ntime: [1]", "channels: {hoist: {column: [a]}}"])
def test_what_is_no_map_is_refused(sound, text):
    sound.write_text(text)
    with pytest.raises(BadInput):
        read_map(sound)


def test_what_a_drive_can_pull_is_the_machine_s(sound):
    assert read_map(sound).stall_kN == {"hoist_force": 4800, "crowd_force": 3000}
    assert read_map(sound).empty_kN == {"hoist_force": pytest.approx(9.81 * 50)}  # of its dipper and door


def test_thousands_and_decimals_have_marks_of_their_own(sound):
    sound.write_text(sound.read_text() + 'file: {decimal: ",", thousands: ","}\n')
    with pytest.raises(BadInput) as e:
        read_map(sound)
    assert "file.thousands: is ,, as file.decimal; another mark than the decimal one" in e.value.findings[0]


@pytest.mark.parametrize("name, unit", [
    ("Hoist pull kip", "kip"), ("HoistForce_kN", "kN"), ("hoist_force_KIPS", "kip"), ("Crowd %", "%"),
    ("Swing deg", "deg"), ("Payload_tons", "ton"), ("Pull [kip] kN", "kN"), ("Hoist rope in", None),
    ("Swing rev", None), ("hoist_m", None), ("Door st", None), ("kip", None), ("SwingRad", None),
    ("Pull_kip_mean", None)])
def test_a_unit_is_in_brackets_or_the_last_word_of_a_name(name, unit):
    assert unit_in_name(name) == unit


@pytest.mark.parametrize("quantity, said, unit, right", [
    ("truck_mass", "tons", "unit: t", "short tons (0.907 t) or tonnes? unit: short ton, or scale: 1"),
    ("truck_mass", "ton", "unit: kg", "short tons (0.907 t) or tonnes?"),
    ("truck_mass", "tons", "unit: t, scale: 1", None),
    ("truck_mass", "Tn", "unit: t", "short tons (0.907 t) or tonnes?"), ("truck_mass", "tons", "unit: short ton", None),
    ("truck_mass", "tons", "unit: long ton", None), ("truck_mass", "US tons", "unit: t", "unit: short ton"),
    ("truck_mass", "us ton", "unit: short ton", None), ("truck_mass", "metric tons", "unit: t", None),
    ("truck_mass", "metric ton", "unit: short ton", "unit: t"), ("hoist_force", "tons", "unit: tf, scale: 1", None),
    ("hoist_force", "ton", "unit: tf", "short tons (8.896 kN) or tonnes? unit: kN, scale: 8.896")])
def test_tons_are_short_or_metric(sound, quantity, said, unit, right):
    reads = ", reads: total" if quantity == "truck_mass" else ""
    more = f"  {quantity}: {{column: F, {unit}, sigma: 1{reads}}}\n"
    sigmas = SOUND.replace("sign: -1", "sigma: 1").replace("range: [-", "sigma: 1, range: [-").replace(
        "unit: rad", "unit: rad, sigma: 1").replace("MACHINE", str(ugly_log.ROOT / "mbs/bucyrus495.yaml"))
    sound.write_text(sigmas.replace("limits:\n", more + "limits:\n"))
    other = other_unit(unit_in_name(f"F ({said})"), quantity, read_map(sound).channels[quantity])
    assert other is None if right is None else other[1].startswith(right)
