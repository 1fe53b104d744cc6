"""Known signals, written as an ugly log, come back; what cannot be repaired is reported with its line."""
from types import SimpleNamespace

import numpy as np
import pytest

import ugly_log
from dipper_gap.readings.measured import read_measured
from dipper_import.__main__ import main, read
from dipper_import.build import motion_text
from dipper_run.findings import BadInput

MAP = ugly_log.ROOT / "docs/data/import/shift.yaml"
# Of readings with an error of 10 mm and 0.1 deg, and of two drives' readings that are missing for up to 1.2 s.
WITHIN = {"hoist": 0.03, "crowd": 0.03, "swing": 0.5, "door": 1.0}


def known(rate_hz=10.0, loads=(40, 40, 40)):
    truth = ugly_log.planned(rate_hz)
    t = truth.time_s
    truck = sum(load * np.clip((t - at) / 2, 0, 1) for load, at in zip(loads, (15, 40, 65)))
    return ugly_log.with_forces(truth, 900 + 500 * np.sin(t), 300 * np.cos(t), truck)


@pytest.fixture
def log(tmp_path):
    file = tmp_path / "shift.csv"
    file.write_text(ugly_log.ugly(ugly_log.rows_of(known(), seed=3)), newline="")
    return file


@pytest.fixture
def map_file(tmp_path):
    """The tutorial's, seen from here."""
    file = tmp_path / "shift.yaml"
    file.write_text(MAP.read_text().replace("../../..", str(ugly_log.ROOT)))
    return file


def change(file, old, new, count=1):
    text = file.read_bytes().decode()
    assert old in text
    file.write_bytes(text.replace(old, new, count).encode())


def findings(log, map_file):
    with pytest.raises(BadInput) as e:
        read(log, map_file)
    return e.value.findings


def test_an_ugly_log_comes_back(log, map_file, tmp_path):
    assert main([str(log), "--map", str(map_file), "--out", str(tmp_path / "out")]) == 0
    truth = known()
    motion = np.loadtxt(tmp_path / "out/motion.csv", delimiter=",", skiprows=2)
    for k, name in enumerate(("hoist", "crowd", "swing"), 1):
        error = motion[:, k] - np.interp(motion[:, 0], truth.time_s, truth.channels[name])
        assert np.abs(error).max() < WITHIN[name], name
    door = np.interp(motion[:, 0], truth.time_s, truth.channels["door"])
    assert np.median(np.abs(motion[:, 4] - door)) < WITHIN["door"]
    measured = read_measured(tmp_path / "out/measured", 3)
    assert [p.truck_mass_t for p in measured.passes] == pytest.approx([40, 40, 40], abs=0.6)
    for name, column in (("hoist_force", "hoist_force_kN"), ("crowd_force", "crowd_force_kN")):
        error = measured.signals[column] - np.interp(measured.time_s, truth.time_s, truth.channels[name])
        assert np.abs(error).max() < 90  # 20 kN of noise
    assert measured.channels["hoist_m"].sigma == pytest.approx(0.03 * ugly_log.FEET, rel=1e-3)
    assert measured.channels["swing_rad"].sigma == pytest.approx(np.radians(0.1), rel=1e-3)


def test_what_was_done_is_said_with_its_lines(log, map_file):
    _, _, said = read(log, map_file)
    text = "\n".join(said)
    for words in ("clock is set back by 7 s at line 603", "3 rows (lines 157, 158, 159): twice in the file, left out",
                  "rows (lines 80, 417, 531, 532, 533): out of order, sorted in", "gap of 0.5 s between lines",
                  "hoist: 1 reading (line 232) outside the limits of -12 to 0.5 m, left out; the first is -303.9",
                  "crowd: 2 rows (lines 269, 270) without a reading", "3 passes that end with a dump"):
        assert words in text, text


def test_the_same_from_a_plain_log(tmp_path, map_file):
    """Commas, points, ISO stamps, UTF-16, metres."""
    truth = ugly_log.planned(10.0)
    rows = ["time,h,c,s,d"]
    for t, h, c, s, d in zip(truth.time_s, *truth.channels.values()):
        stamp = f"2026-03-14T06:{12 + int(t) // 60:02d}:{t % 60:06.3f}Z"
        rows.append(f"{stamp},{h:.3f},{c:.3f},{np.radians(s):.4f},{d:.1f}")
    (tmp_path / "plain.csv").write_bytes("\n".join(rows).encode("utf-16"))
    map_file.write_text("file: {encoding: utf-16}\ntime: {column: time}\nchannels:\n"
                        "  hoist: {column: h, unit: m}\n  crowd: {column: c, unit: m}\n"
                        "  swing: {column: s, unit: rad}\n  door: {column: d, unit: deg}\n")
    made, _, _ = read(tmp_path / "plain.csv", map_file)
    for name, within in (("hoist", 0.01), ("crowd", 0.01), ("swing", 0.1), ("door", 2.0)):
        error = made.fits[name].value - np.interp(made.grid, truth.time_s, truth.channels[name])
        assert np.abs(error).max() < within, name
    assert made.measured is None


@pytest.mark.parametrize("old, new, what", [
    ("Hoist rope in, ft", "Rope, ft", "shift.yaml:5: channels.hoist.column: 'Hoist rope in, ft' is no column of "
     "shift.csv (line 3); 'Rope, ft', perhaps?"),
    ("Swing cw", "Trip", "'Trip' is the name of 2 columns"),
    ("999,99", "stuck", "'stuck'; a number with a decimal comma; if it means that there is no reading"),
    ("999,99", "1.5", "is '1.5'; a number with a decimal comma"),
    (";NaN;", ";", "row: 8 cells; 9, as in the header"),
])
def test_faults_of_the_log(log, map_file, old, new, what):
    change(log, old, new)
    found = findings(log, map_file)
    assert any(what in f for f in found), found


@pytest.mark.parametrize("old, new, what", [
    ("unit: ft, sign: -1", "unit: ft", "hoist is from 2.926 to 305.7 m; -12 to 0.5 m (limits): unit, sign, scale or"),
    ("unit: ft, sign: -1", "unit: m, sign: -1", "unit: ft in the map, if the log is right"),
    ("reads: total", "reads: pass", None),
    ("swing: {acceleration: 12}", "longest_gap_s: 0.4", "unknown key"),
])
def test_a_map_that_does_not_fit_the_log(log, map_file, old, new, what):
    change(map_file, old, new)
    if what:
        assert any(what in f for f in findings(log, map_file))
    else:
        made, _, _ = read(log, map_file)
        assert [p.truck_mass_t for p in made.measured.passes] == pytest.approx([40, 80, 120], abs=0.6)


def test_a_gap_that_is_too_long_names_its_lines(log, map_file):
    with open(map_file, "a") as f:
        f.write("longest_gap_s: 0.4\n")
    found = findings(log, map_file)
    assert len(found) == 1 and "time: nothing for 0.5 s, up to line" in found[0] and "0.4 s at most" in found[0]


def test_readings_that_no_drive_can_make_are_left_out(log, map_file):
    change(log, "999,99", "25,00")  # within the rope's range, and 4 m off
    _, _, said = read(log, map_file)
    assert any("hoist: 1 reading (line 232) out of reach of their neighbours at 1.8 m/s" in s for s in said), said


@pytest.mark.parametrize("load, taken", [(-0.3, True), (-3.0, False)])
def test_a_pass_that_loads_nothing_counts_as_0_within_the_error_of_the_scale(log, map_file, load, taken):
    """Of 0.5 short tons."""
    log.write_text(ugly_log.ugly(ugly_log.rows_of(known(loads=(40, load, 40)), seed=3)), newline="")
    if not taken:
        assert any("pass 2 (" in f and "; 0 t or more, down to -1.36 t where it loads nothing (3 sigma)" in f
                   for f in findings(log, map_file))
        return
    made, _, said = read(log, map_file)
    assert [p.truck_mass_t for p in made.measured.passes] == pytest.approx([40, 0, 40], abs=0.6)
    assert made.measured.passes[1].truck_mass_t == 0
    assert any(s.startswith("warning: truck_mass: pass 2 (") and "within 3 sigma of the scale (1.36 t): taken as 0" in s
               for s in said), said


@pytest.mark.parametrize("sample_s", [0.1, 0.005, 1 / 3])
def test_the_times_of_a_long_motion_rise_by_the_sample(sample_s):
    grid = sample_s * np.arange(int(1020 / sample_s))
    made = SimpleNamespace(grid=grid, fits=dict.fromkeys(WITHIN, SimpleNamespace(value=np.zeros(len(grid)))))
    rows = motion_text(made, SimpleNamespace(path=MAP), "shift.csv").splitlines()[2:]
    assert rows[0].startswith("0,") and (sample_s == 1 / 3 or max(map(len, rows)) < 47)
    assert np.diff([float(row.split(",")[0]) for row in rows]) == pytest.approx(sample_s, abs=1e-8)


def test_forces_without_a_pass(log, map_file):
    change(log, ";1;", ";0;", -1)
    assert any("passes: none ends with a dump" in f for f in findings(log, map_file))


PIECES = [b"", b";", b",", b"\n", b"\0", b"\xff", b"nan", b"1e999", b'"', b"\r", b"14.03.2026", b"-", b"999999"]


def test_damaged_logs_are_read_or_refused(log, map_file):
    """Bytes changed, cut out and put in at random: findings or a motion, never another exception."""
    whole, rng, refused = log.read_bytes()[:12000], np.random.default_rng(5), 0
    for _ in range(30):
        data = bytearray(whole)
        for _ in range(rng.integers(1, 4)):
            at = int(rng.integers(0, len(data)))
            data[at:at + int(rng.integers(0, 30))] = PIECES[rng.integers(0, len(PIECES))]
        log.write_bytes(bytes(data))
        try:
            read(log, map_file)
        except BadInput:
            refused += 1
    assert 3 < refused < 30


def plain(truth, mass, keep_door=lambda k: True):
    """A row a reading of everything, in the channels' own units, without noise."""
    c = truth.channels
    rows = ["t,h,c,s,d,f,m"]
    for k, t in enumerate(truth.time_s):
        door = f"{c['door'][k]:.3f}" if keep_door(k) else ""
        rows.append(f"{t:.3f},{c['hoist'][k]:.4f},{c['crowd'][k]:.4f},{c['swing'][k]:.3f},{door},"
                    f"{c['hoist_force'][k]:.1f},{mass[k]:.2f}")
    return "\n".join(rows) + "\n"


PLAIN_MAP = """\
time: {column: t}
channels:
  hoist: {column: h, unit: m, sigma: 0.01}
  crowd: {column: c, unit: m, sigma: 0.01}
  swing: {column: s, unit: deg, sigma: 0.1}
  door: {column: d, unit: deg}
  hoist_force: {column: f, unit: kN, sigma: 20}
  truck_mass: {column: m, unit: t, reads: total, sigma: 0.5}
limits: {machine: MACHINE}
"""


@pytest.fixture
def plain_map(tmp_path):
    file = tmp_path / "plain.yaml"
    file.write_text(PLAIN_MAP.replace("MACHINE", str(ugly_log.ROOT / "mbs/bucyrus495.yaml")))
    return file


def hung_in_dipper(truth, loads):
    """A payload monitor: shows the load from the swing until the door opens, else 0."""
    c, mass = truth.channels, np.zeros(len(truth.time_s))
    openings = np.flatnonzero((c["door"][1:] > 1) & (c["door"][:-1] <= 1))
    for load, k in zip(loads, openings):
        mass[(truth.time_s > truth.time_s[k] - 6) & (truth.time_s <= truth.time_s[k])] = load
    return mass


def test_a_payload_monitor_is_read_before_the_dump(tmp_path, plain_map):
    truth, loads = known(), (68.4, 71.2, 65.0)
    log = tmp_path / "plain.csv"
    log.write_text(plain(truth, hung_in_dipper(truth, loads)))
    for reads in ("pass", "total"):
        change(plain_map, "reads: total", f"reads: {reads}")
        found = findings(log, plain_map)
        assert len(found) == 1 and "reads: dipper the load in the dipper, until it is dumped" in found[0], found
        change(plain_map, f"reads: {reads}", "reads: total")
    change(plain_map, "reads: total", "reads: dipper")
    made, _, _ = read(log, plain_map)
    assert [p.truck_mass_t for p in made.measured.passes] == pytest.approx(loads)


def cut_at(truth, start):
    there = truth.time_s >= start
    return ugly_log.Truth(truth.time_s[there] - truth.time_s[there][0],
                          {name: value[there] for name, value in truth.channels.items()})


def masses(log, map_file):
    made, _, said = read(log, map_file)
    return [p.truck_mass_t for p in made.measured.passes], [s for s in said if s.startswith("warning: ")]


@pytest.mark.parametrize("start", [12, 14])
def test_a_log_that_begins_within_a_pass_is_refused(tmp_path, plain_map, start):
    truth, log = cut_at(known(), start), tmp_path / "plain.csv"
    log.write_text(plain(truth, truth.channels["truck_mass"]))
    found = findings(log, plain_map)
    assert len(found) == 1 and "plain.csv:2: passes: pass 1 (0 to " in found[0] and \
        "the log begins within a pass; a time.from before its dig, or after its end" in found[0], found
    change(plain_map, "{column: t}", "{column: t, from: 12}")
    truth = cut_at(known(), 9)
    log.write_text(plain(truth, truth.channels["truck_mass"]))
    assert masses(log, plain_map)[0] == pytest.approx([40, 40], abs=0.1)


def test_a_log_that_begins_with_the_door_open_begins_with_the_next_pass(tmp_path, plain_map):
    truth, log = cut_at(known(), 16), tmp_path / "plain.csv"
    assert truth.channels["door"][0] > 10
    log.write_text(plain(truth, truth.channels["truck_mass"]))
    loads, warnings = masses(log, plain_map)
    assert loads == pytest.approx([40, 40], abs=0.1)
    assert any("the log begins with the door open: what it dumps until" in w for w in warnings), warnings


@pytest.mark.parametrize("late_s", [0.0, 4.0, 6.0])
@pytest.mark.parametrize("changed_s", [None, 60.0])
def test_a_scale_that_shows_a_pass_after_its_end(tmp_path, plain_map, late_s, changed_s):
    """What the passes bring is the scale's rise; a truck that is changed takes away what had come."""
    truth, log = known(loads=(69, 77, 68)), tmp_path / "plain.csv"
    mass = np.interp(truth.time_s - late_s, truth.time_s, truth.channels["truck_mass"])
    mass[truth.time_s > (changed_s or np.inf)] -= 69 + 77
    log.write_text(plain(truth, mass + 0.1 * np.random.default_rng(2).standard_normal(len(mass))))
    found, warnings = masses(log, plain_map)
    assert found == pytest.approx([69, 77, 68], abs=0.5)
    assert not warnings if not late_s else len(warnings) == 1 and "t as pass 1 ends, and 69" in warnings[0] and \
        "the scale shows a pass late; so in 3 passes" in warnings[0]


@pytest.mark.parametrize("empty, known_masses", [((30, 50), None), ((28, 36), [69, 77, 68]), ((64, 99), None)])
def test_a_scale_without_readings_has_no_stale_ones(tmp_path, plain_map, empty, known_masses):
    truth, log = known(loads=(69, 77, 68)), tmp_path / "plain.csv"
    mass = truth.channels["truck_mass"]
    mass[(truth.time_s > empty[0]) & (truth.time_s < empty[1])] = np.nan
    log.write_text(plain(truth, mass).replace("nan", ""))
    if known_masses:
        assert masses(log, plain_map)[0] == pytest.approx(known_masses, abs=0.1)
    else:
        assert "has no reading before or after its dump" in findings(log, plain_map)[0]


def test_a_channel_that_is_written_only_as_it_changes(tmp_path, plain_map):
    truth = known()
    door, log = truth.channels["door"], tmp_path / "plain.csv"
    still = lambda k: 0 < k < len(door) - 1 and door[k - 1] == door[k]
    log.write_text(plain(truth, truth.channels["truck_mass"], lambda k: not still(k)))
    found = findings(log, plain_map)
    assert len(found) == 1 and "2 s at most (longest_gap_s): channels.door.held: true if it is" in found[0]
    change(plain_map, "unit: deg}", "unit: deg, held: true}")
    made, _, said = read(log, plain_map)
    assert np.abs(made.fits["door"].value - np.interp(made.grid, truth.time_s, door)).max() < 3
    assert any(line.startswith("  door: ") and "have the last one before (held)" in line for line in said)


def test_readings_beyond_the_machine_are_warned_of(tmp_path, plain_map):
    truth, log = known(), tmp_path / "plain.csv"
    force = truth.channels["hoist_force"]
    log.write_text(plain(truth, truth.channels["truck_mass"]))
    assert not any("warning" in line for line in read(log, plain_map)[2])
    force[40:43] = -5000
    log.write_text(plain(truth, truth.channels["truck_mass"]))
    assert "warning: hoist_force: 3 readings (lines 42, 43, 44) beyond -1800 to 7200 kN (1.5 times its stall force)" \
        in read(log, plain_map)[2][-1]


def test_warnings_are_said_before_a_fault_that_they_may_have_caused(tmp_path, plain_map, capsys):
    """A swing in rad as deg has no dump: no pass brings anything."""
    truth, log = known(), tmp_path / "plain.csv"
    truth.channels["swing"][:] = np.radians(truth.channels["swing"])
    log.write_text(plain(truth, truth.channels["truck_mass"]))
    assert len(findings(log, plain_map)) == 1
    said = capsys.readouterr().err
    assert said.startswith("warning: swing: all its readings are within 1.") and "another unit (rad)" in said


@pytest.mark.parametrize("unit_s, what", [(1e-3, "ms: 0.1 s"), (3600, "h: 0.1 s")])
def test_times_in_another_unit_are_refused(tmp_path, plain_map, unit_s, what):
    truth, log = known(), tmp_path / "plain.csv"
    truth = ugly_log.Truth(truth.time_s / unit_s, truth.channels)
    text = plain(truth, truth.channels["truck_mass"]).splitlines()
    text = [text[0], *(f"{t:.9g}," + row.split(",", 1)[1] for t, row in zip(truth.time_s, text[1:]))]
    log.write_text("\n".join(text))
    found = findings(log, plain_map)
    assert len(found) == 1 and "time: is one row each" in found[0], found
    assert "in time.format, perhaps? " in found[0] and what in found[0], found


def test_rows_too_far_apart_are_refused(tmp_path, plain_map):
    truth, log = known(rate_hz=1 / 3), tmp_path / "plain.csv"
    log.write_text(plain(truth, truth.channels["truck_mass"]))
    assert "plain.csv:2: time: is one row each 3 s; 0.001 to 2 s (longest_gap_s)" in findings(log, plain_map)[0]
