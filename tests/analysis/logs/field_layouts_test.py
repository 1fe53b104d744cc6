"""What historians, spreadsheets and loggers of the field send: read, or refused with the key that helps."""
from types import SimpleNamespace

import numpy as np
import pytest

from dipper_import.build import _check_readings
from dipper_import.clock import Rows, order_rows
from dipper_import.import_map import read_map
from dipper_import.log_file import read_log
from dipper_import.readings import held_readings
from dipper_run.findings import Findings

MAP = """\
time: {column: Time}
channels:
  hoist: {column: Hoist, unit: m, sigma: 0.1}
  crowd: {column: Crowd, unit: m, sigma: 0.1}
  swing: {column: Swing, unit: deg, sigma: 0.1}
  door: {column: Door, unit: deg}
  hoist_force: {column: Pull, unit: N, sigma: 1000}
limits: {hoist: {min: -12, max: 1}, crowd: {min: -2, max: 4}, swing: {min: -90, max: 90}, door: {min: 0, max: 90}}
"""
NAMES = ["Time", "Hoist", "Crowd", "Swing", "Door", "Pull"]
N = 12
PULL = 150000 + 12345.0 * np.arange(N)


def stamp(k, late_ms=0):
    return f"2026-03-14 06:12:{k // 5:02d}.{200 * (k % 5) + late_ms:03d}"


def rows(pull="{:.0f}", force=PULL):
    return [[stamp(k), f"{-0.25 * k:.3f}", f"{0.1 * k:.2f}", f"{k:.1f}", "0.0", pull.format(force[k])]
            for k in range(N)]


def text(body, delimiter=",", names=NAMES, end="\n"):
    return end.join(delimiter.join(f'"{c}"' if delimiter in c else c for c in row) for row in [names, *body]) + end


@pytest.fixture
def read(tmp_path):
    def reader(log, more="", map_text=MAP):
        (tmp_path / "map.yaml").write_text(map_text + more)
        (tmp_path / "log.csv").write_bytes(log.encode())
        found, notes = Findings(), []
        return read_log(tmp_path / "log.csv", read_map(tmp_path / "map.yaml"), found, notes), found.all, notes

    return reader


def is_whole(log, force=PULL):
    return len(log.lines) == N and np.allclose(log.values["hoist"], -0.25 * np.arange(N)) and \
        np.allclose(log.values["swing"], np.arange(N)) and np.allclose(log.values["hoist_force"], 1e-3 * force)


@pytest.mark.parametrize("written", ["-9999", "-9999.0", "-9999.000", "-9.999e3"])
@pytest.mark.parametrize("listed", ["-9999", "'-9999.00'"])
def test_a_number_that_means_no_reading_is_compared_as_a_number(read, written, listed):
    body = rows()
    body[3][5] = written
    log, found, notes = read(text(body), "file: {missing: [%s]}\n" % listed)
    assert not found and not notes and np.isnan(log.values["hoist_force"][3])


@pytest.mark.parametrize("value", [-9999, 999999, -999.25, 6553.5, -327.68, 3276.7])
def test_a_reading_that_looks_like_none_is_warned_of(read, value):
    body = rows()
    body[3][5] = body[4][5] = str(value)
    _, found, notes = read(text(body))
    assert not found and f"warning: hoist_force: 2 readings (lines 5, 6) of {value:g} N, far off" in notes[0]
    assert f"file: {{missing: [{value:g}]}}" in notes[0]


@pytest.mark.parametrize("nan", ["1.#QNAN", "-1.#IND", "1.#INF"])
def test_what_windows_prints_for_no_number_is_no_reading(read, nan):
    body = rows()
    body[3][5] = nan
    log, found, notes = read(text(body))
    assert not found and not notes and np.flatnonzero(np.isnan(log.values["hoist_force"])).tolist() == [3]


def test_a_sound_reading_of_999_is_no_matter(read):
    _, found, notes = read(text(rows("{:.0f}", 999 + 0.01 * PULL)))
    assert not found and not notes


def with_quality(*bad, good="Good"):
    return [[c for k, cell in enumerate(row) for c in ([cell] if k == 0 else [cell, "Bad" if (i, k) in bad else good])]
            for i, row in enumerate(rows())]


QUALITY_NAMES = [c for n in NAMES for c in ([n] if n == "Time" else [n, n + " Quality"])]
WITH_QUALITY = MAP.replace("unit: N,", "unit: N, quality: Pull Quality,")


@pytest.mark.parametrize("good", ["Good", "good [NonSpecific]", "192", "OK"])
def test_readings_whose_quality_is_bad_are_left_out(read, good):
    log, found, notes = read(text(with_quality((2, 5), good=good), names=QUALITY_NAMES), map_text=WITH_QUALITY)
    assert not found and np.flatnonzero(np.isnan(log.values["hoist_force"])).tolist() == [2]
    assert notes == ["hoist_force: 1 reading (line 4) with the quality 'Bad', left out"]


@pytest.mark.parametrize("name, good, bad", [
    ("Pull isGood", "TRUE", "FALSE"), ("Pull QC", "", "S"), ("Pull Confidence", "100", "0"), ("Pull_flag", "0", "1"),
    ("Pull state", "G", "B"), ("Remark", "", "comm fail"), ("Qualität", "gut", "schlecht")])
def test_a_quality_of_any_name_beside_its_channel_is_warned_of(read, name, good, bad):
    body = [[*row, bad if k in (3, 4) else good] for k, row in enumerate(rows())]
    _, found, notes = read(text(body, names=[*NAMES, name]))
    assert not found and len(notes) == 1 and notes[0].startswith(f"warning: '{name}' in ") and bad in notes[0]


def test_another_signal_beside_a_channel_is_no_quality(read):
    body = [[*row, f"{k}", "digging" if k < 6 else "swinging"] for k, row in enumerate(rows())]
    assert not read(text(body, names=[*NAMES, "Pull of the other rope", "Mode"]))[2]


@pytest.mark.parametrize("name, good, bad", [
    ("Estado", "Bueno", "Malo"), ("质量", "好", "坏"), ("OPC", "192", "24"), ("Shovel", "SH12", "SH13")])
@pytest.mark.parametrize("right", [True, False])
def test_a_quality_of_any_name_beside_the_time_is_warned_of(read, name, good, bad, right):
    beside = lambda row, cell: [row[0], cell, *row[1:]] if right else [cell, *row]
    body = [beside(row, bad if k in (3, 4) else good) for k, row in enumerate(rows())]
    _, found, notes = read(text(body, names=beside(NAMES, name)))
    assert not found and len(notes) == 1 and notes[0].startswith(f"warning: '{name}' in 12 cells says ")


@pytest.mark.parametrize("name, cells", [
    ("Shift", ["B"] * N), ("Digging", ["0", "1"] * 6), ("Date", ["14.03.2026"] * 6 + ["15.03.2026"] * 6),
    ("Operator", list("ABCDEFABCDEF"))])
def test_another_column_beside_the_time_is_none(read, name, cells):
    body = [[row[0], cell, *row[1:]] for row, cell in zip(rows(), cells)]
    assert read(text(body, names=["Time", name, *NAMES[1:]]))[1:] == ([], [])


def test_own_words_for_good(read):
    log = text(with_quality((2, 5), good="G"), names=QUALITY_NAMES)
    _, found, _ = read(log, map_text=WITH_QUALITY)
    assert "Pull Quality: no reading of hoist_force is good: they are 'Bad', 'G'; list what says that one is under " \
        "file.good" in found[0]
    log, found, _ = read(log, "file: {good: [g]}\n", WITH_QUALITY)
    assert not found and np.isnan(log.values["hoist_force"]).sum() == 1


@pytest.mark.parametrize("good, bad", [("0", "2147483648"), ("0x00000000", "0x80AB0000"), ("0", "1073741824")])
def test_status_codes_of_opc_ua_wait_for_the_map(read, good, bad):
    """Of their 32 bits 0 is good, and of OPC's older eight 192 to 255."""
    body = with_quality(good=good)
    body[2][QUALITY_NAMES.index("Pull Quality")] = bad
    log = text(body, names=QUALITY_NAMES)
    _, found, _ = read(log, map_text=WITH_QUALITY)
    assert f"log.csv:4: Pull Quality: is {bad}, a status code of OPC UA; 0 is good there: file: {{good: ['{good}']}}" \
        in found[0]
    log, found, _ = read(log, f"file: {{good: ['{good}']}}\n", WITH_QUALITY)
    assert not found and np.flatnonzero(np.isnan(log.values["hoist_force"])).tolist() == [2]


@pytest.mark.parametrize("code, good", [("191", False), ("192", True), ("219", True), ("255", True), ("256", False)])
def test_codes_of_opc_are_good_from_192_to_255(read, code, good):
    body = with_quality(good="192")
    body[2][QUALITY_NAMES.index("Pull Quality")] = code
    log, found, _ = read(text(body, names=QUALITY_NAMES), map_text=WITH_QUALITY)
    assert not found and np.isfinite(log.values["hoist_force"][2]) == good


def test_a_quality_that_the_map_does_not_name_is_warned_of(read):
    _, found, notes = read(text(with_quality((2, 5), (3, 5)), names=QUALITY_NAMES))
    assert not found and len(notes) == 1
    assert notes[0].startswith("warning: 'Pull Quality' in 2 cells says 'Bad'") and "channels.NAME.quality" in notes[0]
    assert not read(text(with_quality(), names=QUALITY_NAMES))[2]


@pytest.mark.parametrize("first, unit", [("1773468720000", "ms"), ("1773468720000000", "us"),
                                         ("1773468720000000000", "ns")])
def test_numbers_that_are_no_seconds_ask_for_their_unit(read, first, unit):
    body = [[f"{int(first) + 200 * k}", *row[1:]] for k, row in enumerate(rows())]
    _, found, _ = read(text(body))
    assert f"log.csv:2: time: is {first}, which is no count of seconds; its unit in the map, time.format: " \
        f"{unit}" in found[0]


@pytest.mark.parametrize("first", [639090655200000000, 134179423200000000])
def test_ticks_of_windows(read, first):
    """100 ns since the year 1, or since 1601."""
    body = [[f"{first + 2000000 * k}", *row[1:]] for k, row in enumerate(rows())]
    _, found, _ = read(text(body))
    assert "which is no count of seconds; its unit in the map, time.format: ticks" in found[0]
    log, found, _ = read(text(body), map_text=MAP.replace("{column: Time}", "{column: Time, format: ticks}"))
    assert not found and np.allclose(log.stamp_s - log.stamp_s[0], 0.2 * np.arange(N), atol=1e-4)


@pytest.mark.parametrize("first, form, warns", [
    (0, "{}", True), (1, "{}", True), (1001, "{}", True), (0, "{}.0", True), (1700000000, "{}", False)])
def test_the_number_of_a_row_is_warned_of(read, first, form, warns):
    body = [[form.format(first + k), *row[1:]] for k, row in enumerate(rows())]
    _, found, notes = read(text(body))
    assert not found and bool(notes) == warns
    assert not warns or "warning: the time is " in notes[0] and "is it the row's number?" in notes[0]
    assert not read(text(body), map_text=MAP.replace("{column: Time}", "{column: Time, format: s}"))[2]


def german(body):
    return [[row[0], *(c.replace(".", ",") for c in row[1:])] for row in body]


def grouped(mark, decimals=""):
    return [f"{int(f):,}".replace(",", mark) + decimals for f in PULL]


def with_pull(cells, body=None):
    return [[*row[:-1], c] for row, c in zip(body or rows(), cells)]


WHOLE = [[stamp(k), f"{-k}", f"{k}", f"{k}", "0", ""] for k in range(N)]


@pytest.mark.parametrize("mark, word", [(",", "comma"), (".", "point")])
def test_three_digits_after_every_mark_are_asked_about(read, mark, word):
    """943,981 is 943.981 or 943981: nothing in the file says which."""
    log = text(with_pull(grouped(mark), WHOLE), ";")
    _, found, _ = read(log)
    assert found and f"every {word} has three digits after it, as in '150{mark}000'" in found[0]
    assert f'file.decimal: "{mark}"' in found[0] and f'file.thousands: "{mark}"' in found[0]
    log_read, found, _ = read(log, f'file: {{thousands: "{mark}"}}\n')
    assert not found and np.allclose(log_read.values["hoist_force"], 1e-3 * PULL)
    log_read, found, _ = read(log, f'file: {{decimal: "{mark}"}}\n')
    assert not found and np.allclose(log_read.values["hoist_force"], 1e-6 * PULL)


@pytest.mark.parametrize("mark, thousands, body", [
    (",", ",", rows()), ("'", "'", rows()), ("\u2019", "'", rows()), (" ", "space", rows()),
    (".", ".", german(rows())), ("\u202f", "space", german(rows())), ("\u00a0", "space", german(rows()))])
def test_parted_thousands_are_refused_with_the_key_and_read_with_it(read, mark, thousands, body):
    decimals = ",0" if "," in body[1][1] else ".0"
    log = text(with_pull(grouped(mark, decimals), body), ";")
    _, found, _ = read(log)
    assert len(found) == 1 and f'file.thousands: "{thousands}", if that parts its thousands' in found[0]
    log_read, found, _ = read(log, f'file: {{thousands: "{thousands}"}}\n')
    assert not found and is_whole(log_read)


@pytest.mark.parametrize("mark, body", [(".", rows()), (",", german(rows()))])
def test_thousands_parted_in_one_column_by_the_decimal_mark_of_others(read, mark, body):
    """705 and 1.234 in a column of whole numbers, 0.25 in others."""
    cells = [f"{705 + 100 * k:,}".replace(",", mark) for k in range(N)]
    _, found, _ = read(text(with_pull(cells, body), ";"))
    assert len(found) == 1 and f"log.csv:5: Pull: is '1{mark}005', beside whole numbers up to 999; 1005, if" in found[0]
    _, found, _ = read(text(with_pull([f"{0.705 + k / 10:.3f}".replace(".", mark) for k in range(N)], body), ";"))
    assert not found


def test_thousands_as_india_parts_them(read):
    log = text(with_pull([f"1,{k:02d},345" for k in range(N)]))
    _, found, _ = read(log)
    assert 'file.thousands: ","' in found[0]
    log_read, found, _ = read(log, 'file: {thousands: ","}\n')
    assert not found and np.allclose(log_read.values["hoist_force"], [(100345 + 1000 * k) / 1000 for k in range(N)])


@pytest.mark.parametrize("written", ["(150000)", "150000-"])
def test_a_minus_that_does_not_stand_before_its_number_is_not_called_missing(read, written):
    _, found, _ = read(text(with_pull([written] * N)))
    assert len(found) == 1 and "; -150000, if that is meant: a minus before the number" in found[0]


@pytest.mark.parametrize("shut, open_", [("Closed", "Open"), ("FALSE", "TRUE"), ("off", "on"), ("0", "1")])
def test_words_of_a_switch(read, shut, open_):
    body = [[*row[:4], open_ if k > 6 else shut, row[5]] for k, row in enumerate(rows())]
    log, found, _ = read(text(body), map_text=SWITCH)
    assert not found and log.values["door"].tolist() == [75.0 if k > 6 else 0.0 for k in range(N)]
    for cell in ("ajar", "100", "-1"):
        body[3][4] = cell
        assert f"Door: is '{cell}'; 0 or 1, or words such as open and closed" in read(text(body), map_text=SWITCH)[1][0]


SWITCH = MAP.replace("Door, unit: deg", "Door, unit: switch, range: [0, 75]").replace(
    "door: {min: 0, max: 90}", "door: {min: 0, max: 90, speed: 100, acceleration: 300}")


@pytest.mark.parametrize("cells, before", [
    ({3: "1", 5: "0", 9: "1"}, 0.0), ({3: "Closed", 5: "Open"}, 75.0), ({3: "1", 4: "1", 5: "0"}, np.nan)])
@pytest.mark.parametrize("a_row_a_reading", [False, True])
def test_a_switch_written_only_as_it_changes_had_its_other_value_before(read, cells, before, a_row_a_reading):
    """One that is written twice with one value is written otherwise, and its first rows are empty."""
    body = [[*row[:4], cells.get(k, ""), row[5]] for k, row in enumerate(rows())]
    if a_row_a_reading:
        log = text([r for r in long(body) if r[2]], names=["Tag", "Time", "Value", "Quality"])
    else:
        log = text(body)
    log, found, notes = read(log, map_text=SWITCH)
    what = SimpleNamespace(channels={"door": SimpleNamespace(held=True, switch=True, slope=75.0, intercept=0.0)})
    door = held_readings(Rows(log.stamp_s, log.lines, log.values, 0.2, "", ""), what, notes).values["door"]
    assert not found and np.array_equal(door[:3], [before] * 3, equal_nan=True) and door[3] != before


def test_a_preamble_that_has_the_name_of_the_time(read):
    log, found, _ = read("Time,exported 12:00\nTime zone,UTC\n" + text(rows()))
    assert not found and is_whole(log)


def test_columns_parted_by_blanks_are_reported(read):
    _, found, _ = read(text(rows()).replace(" ", "T").replace(",", " "))
    assert len(found) == 1 and "columns are parted by , ; | or a tab (file.delimiter), not by blanks" in found[0]


def test_rows_that_never_have_every_channel_name_the_key():
    """As a bus sends them: one channel a row."""
    log = Rows(0.2 * np.arange(60), 2 + np.arange(60), {}, 0.2, "", "")
    _check_readings(log, np.zeros(60, bool), [(0, 10)], "log.csv", found := Findings())
    assert found.all[0].startswith("log.csv:2: time: 0 rows with a reading of every channel within pass 1 (0 to 10 s)")
    assert "held: true for channels that are written only as they change" in found.all[0]


def test_names_with_line_breaks_match_their_names_with_blanks(read):
    names = [f'"{n}\n(x)"' for n in NAMES]
    log = ",".join(names) + "\n" + text(rows()).split("\n", 1)[1]
    for blank in ("\\n", " "):
        named = MAP
        for n in NAMES:
            named = named.replace(f"column: {n}", f'column: "{n}{blank}(x)"')
        log_read, found, _ = read(log, map_text=named)
        assert not found and is_whole(log_read) and log_read.lines[0] == 8


def test_bars_in_names_do_not_part_them(read):
    named = MAP
    for n in NAMES[1:]:
        named = named.replace(f"column: {n}", f"column: S12|{n}")
    log, found, _ = read(text(rows(), names=["Time", *(f"S12|{n}" for n in NAMES[1:])]), map_text=named)
    assert not found and is_whole(log)


def test_a_long_preamble(read):
    log, found, _ = read("".join(f"Tag {k},{3 * k}\n" for k in range(400)) + text(rows()))
    assert not found and is_whole(log) and log.lines[0] == 402


def test_a_header_without_any_of_the_names_is_one_line(read):
    _, found, _ = read("Site,7\n" + text(rows(), names=["a", "b", "c", "d", "e", "f"]))
    assert len(found) == 1 and "none of their columns is in the header of log.csv, line 2; file.header_line" in found[0]
    assert "it has 'a', 'b', 'c', 'd', 'e', 'f'" in found[0]


@pytest.mark.parametrize("end", ["\r", "\r\n", "\r\r\n"])
def test_line_ends_of_every_system(read, end):
    log, found, _ = read(text(rows(), end=end))
    assert not found and is_whole(log)


def test_a_cell_too_many_before_a_delimiter_at_the_end(read):
    """Of an unquoted decimal comma: no column moves in silence."""
    body = [[*row, ""] for row in rows()]
    assert is_whole(read(text(body, names=[*NAMES, ""]))[0])
    body[4] = [*body[4][:2], "906", "900", *body[4][3:]]
    _, found, _ = read(text(body, names=[*NAMES, ""]))
    assert len(found) == 1 and "log.csv:6: row: 8 cells; 7, as in the header: with decimal commas" in found[0]


def test_two_machines_whose_rows_have_a_number_are_refused(read):
    body = [[*row, str(11 + k % 2)] for k, row in enumerate(rows())]
    _, found, _ = read(text(body, names=[*NAMES, "EQMT"]))
    assert len(found) == 1 and "EQMT: says '11', '12' in turn: several machines in one log?" in found[0]
    assert is_whole(read(text(body, names=[*NAMES, "Heartbeat"]))[0])


def test_channels_logged_at_another_time_are_warned_of(read):
    pairs = [[cell for name in row[1:] for cell in (row[0], name)] for row in rows()]
    late = [[*row[:-2], row[-2].replace("06:12", "07:12"), row[-1]] for row in pairs]
    names = [n for name in NAMES[1:] for n in (NAMES[0], name)]
    for body, warns in ((pairs, False), (late, True)):
        _, _, notes = read(text(body, names=names), map_text=MAP.replace("unit: N", "unit: N, held: true"))
        assert any("0 % of it within theirs: another time zone" in n for n in notes) == warns


def test_empty_rows_and_columns_of_spreadsheets(read):
    body = [row + ["", ""] for row in rows()]
    body[4:4] = [[""] * 8] * 2
    log, found, _ = read(text(body + [[""] * 8] * 3, names=[*NAMES, "", ""]))
    assert not found and is_whole(log)


@pytest.mark.parametrize("minus", ["\u2212", "\u2013"])
def test_minus_signs_of_word_processors(read, minus):
    log, found, _ = read(text(rows()).replace(",-", f",{minus}"))
    assert not found and is_whole(log)


def test_units_behind_numbers(read):
    body = [[t, f"{h} m", f"{c}m", f"{s}°", f"{d}", f"{p} N"] for t, h, c, s, d, p in rows()]
    log, found, _ = read(text(body))
    assert not found and is_whole(log)
    body = [[*row[:-1], row[-1].replace("N", "kN")] for row in body]
    _, found, _ = read(text(body))
    assert "Pull: is '150000 kN', and the same in 11 more lines; a number in N, as the map says, or" in found[0]


def test_rows_of_units_below_the_header_name_the_key(read):
    log = text([["", "m", "m", "deg", "deg", "N"], ["", "rope", "handle", "house", "trip", "pull"], *rows()])
    iso = MAP.replace("{column: Time}", "{column: Time, format: iso}")
    for map_text in (MAP, iso):
        _, found, _ = read(log, map_text=map_text)
        assert "log.csv:2: time: is ''" in found[0] and "file.data_line: 4" in found[0]
    log_read, found, _ = read(log, "file: {data_line: 4}\n")
    assert not found and is_whole(log_read)


@pytest.mark.parametrize("name, map_unit, says", [
    ("Pull (kip)", "kN", "is in kip here, and in kN by the map; unit: kip in the map"), ("Pull [kips]", "kip", None),
    ("Pull (daN)", "kN", "is in daN here, and in kN by the map; unit: kN, scale: 0.01 in the map, if the log is right"),
    ("Pull (N)", "kN, scale: 0.001", None),
    ("Pull (daN)", "kN, scale: 0.01", None), ("Pull (t)", "tf", None), ("Pull (t)", "kN", "is in tf here"),
    ("Pull (m)", "kN", "is in m here, and in kN by the map; a column of force"), ("Pull (bar)", "kN, scale: 12", None),
    ("Pull (%)", "kN", "is in % here"), ("Pull (%)", "kN, scale: 20", None), ("Pull (left)", "kN", None),
    ("Pull (short ton)", "tf", "is in tonf here"), ("Pull (kip, filtered)", "kN", "is in kip here"),
    ("Pull (0.1 kN)", "kN", "is in 0.1 kN here"), ("Pull (kN x10)", "kN", "is in kN x10 here"),
    ("Pull (kN/rope)", "kN, scale: 2", None), ("Pull (kPa)", "kN", "is in kPa here, and in kN by the map; a column of"),
    ("Pull/kip", "kN", "is in kip here"), ("Pull (load cell 2)", "kN", None)])
def test_another_unit_in_a_column_s_name_is_refused(read, name, map_unit, says):
    map_text = MAP.replace("{column: Pull, unit: N", f"{{column: '{name}', unit: {map_unit}")
    _, found, _ = read(text(rows(), names=[*NAMES[:5], name]), map_text=map_text)
    assert not found if says is None else len(found) == 1 and f"log.csv:1: {name}: {says}" in found[0]


def test_another_unit_of_a_mass_is_refused(read):
    mass = "  truck_mass: {column: 'Mass [short ton]', unit: t, reads: total, sigma: 1}\n"
    map_text = MAP.replace("limits:", mass + "limits:")
    log = text([[*row, "0"] for row in rows()], names=[*NAMES, "Mass [short ton]"])
    _, found, _ = read(log, map_text=map_text)
    assert "Mass [short ton]: is in short ton here, and in t by the map; unit: short ton in the map" in found[0]
    assert not read(log, map_text=map_text.replace("unit: t,", "unit: short ton,"))[1]


def test_another_unit_in_a_row_below_the_header_is_refused(read):
    units = ["s", "m", "m", "deg", "deg", "kip"]
    _, found, _ = read(text([["", "rope", "crowd", "house", "trip", "pull"], units, *rows()]), "file: {data_line: 4}\n")
    assert len(found) == 1 and "log.csv:3: Pull: is in kip here, and in N by the map" in found[0]


def test_another_unit_in_a_column_of_units_is_refused(read):
    of = dict(zip(NAMES[1:], ("m", "m", "deg", "deg", "N")))
    body = [[*r, of[r[0]]] for r in long(rows())]
    names = ["Tag", "Time", "Value", "Quality", "Unit"]
    assert not read(text(body, names=names))[1]
    line = next(k for k, r in enumerate(body, 2) if r[0] == "Pull" and k > 30)
    changed = [[*r[:4], "kip" if r[0] == "Pull" and k > 30 else r[4]] for k, r in enumerate(body, 2)]
    _, found, _ = read(text(changed, names=names))
    assert len(found) == 1 and found[0].endswith(
        f"log.csv:{line}: Pull: is in kip here, and in N by the map; one unit in all of the log, not N, kip")
    assert not read(text([[*r[:4], "SH12"] for r in body], names=names))[1]


def long(body, late_ms=0, by_tag=False):
    """A row a reading: tag, time, value and quality."""
    out = [[name, stamp(k, j * late_ms), row[j], "Good"] for k, row in enumerate(body)
           for j, name in enumerate(NAMES) if j]
    return sorted(out, key=lambda r: r[0]) if by_tag else out


@pytest.mark.parametrize("by_tag", [False, True])
def test_a_row_a_reading(read, by_tag):
    log, found, notes = read(text(long(rows(), by_tag=by_tag), names=["Tag", "Time", "Value", "Quality"]))
    assert not found and is_whole(log)
    assert notes == ["a row a reading: 'Tag' says whose, 'Value' what"]


def test_a_row_a_reading_at_times_of_their_own(read):
    log, found, notes = read(text(long(rows(), late_ms=10), names=["Tag", "Time", "x", "Quality"]))
    assert not found and "swing" in notes[-1] and "logged at times of their own, taken at those of hoist" in notes[-1]
    inner = slice(1, None)  # before its first reading a channel has none
    assert np.allclose(log.values["swing"][inner], np.arange(N)[inner] - 0.1)
    assert np.isnan(log.values["swing"][0])


def test_a_row_a_reading_says_what_it_lacks(read):
    log = [[*row, "7"] for row in long(rows())]
    names = ["Tag", "Time", "Reading", "Quality", "Site"]
    _, found, _ = read(text(log, names=names))
    assert "file.value: missing: log.csv has a row a reading, and 2 columns of numbers; the column of the values, " \
        "one of 'Reading', 'Site'" in found[0]
    log_read, found, _ = read(text(log, names=names), "file: {value: Reading}\n")
    assert not found and is_whole(log_read)
    _, found, _ = read(text([r for r in long(rows()) if r[0] != "Door"], names=names[:4]))
    assert "'Door' is neither a column of log.csv nor in its 'Tag'; there are 'Hoist', 'Crowd', " \
        "'Swing', 'Pull'" in found[0]


@pytest.mark.parametrize("tag", ["\\\\PI01\\{}", "{} ", "\\\\PI01\\SH12.{}.PV"])
def test_tags_with_a_server_or_in_capitals_are_reported(read, tag):
    log = [[tag.format(r[0]).upper(), *r[1:]] for r in long(rows())]
    _, found, _ = read(text(log, names=["Tag", "Time", "Value", "Quality"]))
    assert len(found) == 1 and "the tags as 'Tag' has them, a row a reading: " in found[0] and "HOIST" in found[0]


def paired(names_of_time):
    body = [[c for j in range(1, 6) for c in (stamp(k, 10 * (j - 1)), row[j])] for k, row in enumerate(rows())]
    return text(body, names=[c for t, n in zip(names_of_time, NAMES[1:]) for c in (t, n)])


def test_a_time_beside_each_reading(read):
    own = [f"{n} t" for n in NAMES[1:]]
    named = MAP.replace("column: Time", "column: Hoist t")
    for n in NAMES[1:]:
        named = named.replace(f"column: {n},", f"column: {n}, time: {n} t,")
    for log, map_text in ((paired(["Time"] * 5), MAP), (paired(own), named)):
        log, found, notes = read(log, map_text=map_text)
        assert not found and notes[0] == "5 columns of time, each for the readings beside it"
        assert np.allclose(log.values["crowd"][1:], 0.1 * np.arange(N)[1:] - 0.005)


def test_a_clock_that_is_set_back_with_times_of_their_own_is_refused(read, tmp_path):
    """Channels are joined by stamps that say two moments."""
    at = lambda k, j: stamp(k, 10 * j) if k < 8 else stamp(k - 4, 50 + 10 * j)
    body = [[c for j in range(1, 6) for c in (at(k, j), row[j])] for k, row in enumerate(rows())]
    log, found, notes = read(text(body, names=[c for n in NAMES[1:] for c in ("Time", n)]))
    assert not found and notes[0] == "5 columns of time, each for the readings beside it"
    what = read_map(tmp_path / "map.yaml")
    assert order_rows(log, what, "log.csv", refused := Findings(), []) is None
    assert refused.all == [
        "log.csv:10: time: the clock is set back, and channels have times of their own, which are joined by their "
        "stamps; a part of the log: time.to before '2026-03-14 06:12:00.860', or time.from after "
        "'2026-03-14 06:12:01.410'"]


def test_whole_seconds_are_spread_for_each_channel_before_they_are_joined(read):
    """One that lacks a row has times of its own within that second alone."""
    body = [[name, at[:-4], *rest] for name, at, *rest in long(rows())]
    body.remove(["Crowd", *[r[1:] for r in body if r[0] == "Crowd"][7]])
    log, found, notes = read(text(body, names=["Tag", "Time", "Value", "Quality"]),
                             map_text=MAP.replace("{column: Time}", "{column: Time, same_stamp: spread}"))
    assert not found and notes[1] == "crowd: logged at times of their own, taken at those of hoist"
    assert np.allclose(log.stamp_s - log.stamp_s[0], 0.2 * np.arange(N))
    crowd = 0.1 * np.arange(N)
    assert np.allclose(log.values["crowd"][[*range(5), 10]], crowd[[*range(5), 10]])
    assert np.nanmax(np.abs(log.values["crowd"] - crowd)) < 0.1


def test_channels_of_a_clock_without_a_date_are_joined_over_midnight(read):
    """Also one that is first written after midnight."""
    def at(k, late_ms):
        ms = (86399000 + 200 * k + late_ms) % 86400000
        return f"{ms // 3600000:02d}:{ms // 60000 % 60:02d}:{ms // 1000 % 60:02d}.{ms % 1000:03d}"
    body = [[n, at(k, 10 * j), row[j]] for k, row in enumerate(rows()) for j, n in enumerate(NAMES) if j]
    body = [r for r in body if r[0] != "Door" or r[1] < "12"]
    log, found, _ = read(text(body, names=["Tag", "Time", "Value"]),
                         map_text=MAP.replace("{column: Time}", "{column: Time, format: '%H:%M:%S.%f'}"))
    assert not found and np.allclose(log.values["crowd"][1:], 0.1 * np.arange(N)[1:] - 0.005)
    assert np.isfinite(log.values["door"]).tolist() == [k > 5 for k in range(N)]


@pytest.mark.parametrize("late_ms", [0, 100])
@pytest.mark.parametrize("name", ["SH13", "7"])
def test_two_machines_with_the_same_tags_are_refused(read, late_ms, name):
    other = [[stamp(k, late_ms), *row[1:]] for k, row in enumerate(rows())]
    log = [["SH12" if name == "SH13" else "6", *r] for r in long(rows())] + [[name, *r] for r in long(other)]
    for body in (log, sorted(log, key=lambda r: r[2])):
        _, found, _ = read(text(body, names=["Asset", "Tag", "Time", "Value", "Quality"]), "file: {value: Value}\n")
        assert len(found) == 1 and f"'{name}' in turn, of one tag: several machines in one log?; one machine's rows" \
            in found[0] and ": Asset: says " in found[0]
    log = [[asset, *row] for asset, body in (("SH12", rows()), ("SH13", other)) for row in body]
    _, found, _ = read(text(log, names=["Asset", *NAMES]))
    assert len(found) == 1 and "Asset: says 'SH12', 'SH13' in turn: several machines in one log?" in found[0]


def test_a_quality_that_changes_from_row_to_row_names_no_machine(read):
    log = [[*r[:3], "192" if k % 2 else "24"] for k, r in enumerate(long(rows(), by_tag=True))]
    named = WITH_QUALITY.replace("Pull Quality", "Note")
    assert not read(text(log, names=["Tag", "Time", "Value", "Quality"]))[1]
    assert not read(text(log, names=["Tag", "Time", "Value", "Note"]), "file: {value: Value}\n", named)[1]


def test_a_bit_that_beats_names_no_machine(read):
    body = [[*row, str(k % 2)] for k, row in enumerate(rows())]
    assert read(text(body, names=[*NAMES, "Watchdog"]))[1:] == ([], [])


@pytest.mark.parametrize("unit, turn", [("deg", 360), ("rad", 2 * np.pi), ("rev", 1), ("mrad", 2000 * np.pi)])
def test_a_swing_that_begins_anew_after_a_turn_goes_on(read, unit, turn):
    body = [[*row[:3], f"{(turn * (10 - 3 * k) / 360) % turn:.6f}", *row[4:]] for k, row in enumerate(rows())]
    log, found, notes = read(text(body), map_text=MAP.replace("Swing, unit: deg", f"Swing, unit: {unit}"))
    assert not found and np.allclose(log.values["swing"], 10 - 3 * np.arange(N), atol=1e-3)
    assert notes == ["swing: 1 step (line 6) of a whole turn: it goes on from there, without them"]


def test_a_swing_that_begins_anew_within_a_hole_of_the_log(read):
    """20 deg/s over the 1.8 s that may be missing."""
    swing = [*range(10, 4, -2), *range(330, 312, -2)]
    body = [[stamp(k + 8 * (k > 2)), *row[1:3], str(s), *row[4:]] for k, (row, s) in enumerate(zip(rows(), swing))]
    log, found, notes = read(text(body))
    assert not found and np.allclose(log.values["swing"], [s - 360 * (s > 180) for s in swing])
    assert notes == ["swing: 1 step (line 5) of a whole turn: it goes on from there, without them"]


def test_a_time_to_the_right_of_each_reading(read):
    body = [[c for j in range(1, 6) for c in (row[j], stamp(k, 10 * (j - 1)))] for k, row in enumerate(rows())]
    log, found, notes = read(text(body, names=[c for n in NAMES[1:] for c in (n, "Time")]))
    assert not found and notes[0] == "5 columns of time, each for the readings beside it"
    assert np.allclose(log.values["crowd"][1:], 0.1 * np.arange(N)[1:] - 0.005)
