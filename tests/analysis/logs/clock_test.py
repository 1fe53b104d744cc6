"""A log's rows in order: what came late or twice, a clock that was set, stamps of every kind."""
from datetime import datetime, timedelta, timezone
from types import SimpleNamespace

import numpy as np
import pytest

from dipper_gap.readings.measured import Measured, write_measured
from dipper_import.clock import order_rows
from dipper_import.import_map import Channel, FileFormat, ImportMap, Limits, TimeFormat
from dipper_import.log_file import read_log
from dipper_import.readings import row_gaps
from dipper_run.findings import Findings

N, STEP = 200, 0.1
TIME = STEP * np.arange(N)
HOIST = np.sin(TIME)


class Read:
    """What comes of a log with a column of time and one of hoist."""

    def __init__(self, folder, stamps, order=None, hoist=HOIST, head="t,h", file=FileFormat(),
                 longest_gap_s=2.0, **time):
        order = range(N) if order is None else order
        self.file = folder / "log.csv"
        self.file.write_text("\n".join([head, *(f"{stamps[k]},{hoist[k]:.5f}" for k in order)]) + "\n")
        usual = dict(columns=("t",), format=None, clock_set_at=frozenset(), first=None, last=None, spread=False, line=1)
        self.what = ImportMap(folder / "map.yaml", file, TimeFormat(**{**usual, **time}),
                              {"hoist": Channel("h", "m", 1.0, 0.0, False, False, None, None, None, 0.0, None, 2)},
                              {"hoist": Limits()}, longest_gap_s=longest_gap_s)
        self.found, self.notes, self.rows, self.gaps = Findings(), [], None, None
        log = read_log(self.file, self.what, self.found, self.notes)
        if not self.found.all:
            self.rows = order_rows(log, self.what, self.file, self.found, self.notes)
        if not self.found.all:
            self.gaps = row_gaps(self.rows, self.what, self.file, self.found, self.notes)

    def is_whole(self, atol=1e-6):
        return not self.found.all and np.allclose(self.rows.time_s, TIME, atol=atol) and \
            np.allclose(self.rows.values["hoist"], HOIST, atol=1e-5)


def seconds(shift=0.0):
    return [f"{t + shift:.3f}" for t in TIME]


START = datetime(2026, 3, 14, 23, 59, 55)


def local(form):
    return [(START + timedelta(seconds=float(t))).strftime(form) for t in TIME]


def iso(zone=None):
    return [(START + timedelta(seconds=float(t))).replace(tzinfo=zone).isoformat(timespec="milliseconds") for t in TIME]


@pytest.mark.parametrize("stamps, form", [
    (seconds(), None),
    (seconds(1.7e9), None),
    ([f"{1000 * (1.7e9 + t):.0f}" for t in TIME], "ms"),
    (iso(), None),
    (iso(timezone.utc), "iso"),
    ([s.replace("T", " ") for s in iso(timezone(timedelta(hours=-5)))], None),
    (local("%d.%m.%Y %H:%M:%S.%f"), "%d.%m.%Y %H:%M:%S.%f"),
    (local("%m/%d/%Y %I:%M:%S.%f %p"), "%m/%d/%Y %I:%M:%S.%f %p"),
    (local("%H:%M:%S.%f"), "%H:%M:%S.%f"),  # past midnight
])
def test_every_kind_of_stamp(tmp_path, stamps, form):
    read = Read(tmp_path, stamps, format=form)
    assert read.is_whole() and not read.notes, (read.found.all, read.notes)


def test_a_local_stamp_is_never_guessed(tmp_path):
    read = Read(tmp_path, local("%d.%m.%Y %H:%M:%S.%f"))
    assert read.found.all == [f"{read.file}:2: time: is '14.03.2026 23:59:55.000000', neither ISO 8601 nor a number; "
                              "write its pattern in the map, such as time: {format: '%d.%m.%Y %H:%M:%S'}"]


def test_a_stamp_among_others_that_is_none(tmp_path):
    stamps = iso()
    stamps[7] = "later"
    assert "log.csv:9: time: is 'later'; as in the first row" in Read(tmp_path, stamps).found.all[0]


def test_late_rows_are_sorted_in(tmp_path):
    order = list(range(N))
    order[50], order[51] = 51, 50
    order[100:110] = [*range(105, 110), *range(100, 105)]
    read = Read(tmp_path, seconds(), order)
    assert read.is_whole()
    assert read.notes == ["6 rows (lines 53, 107, 108, 109, 110 and 1 more): out of order, sorted in"]


def test_the_newest_row_first(tmp_path):
    read = Read(tmp_path, seconds(), list(reversed(range(N))))
    assert read.is_whole() and read.notes == ["the newest row stands first: read from the bottom up"]


def test_rows_that_stand_twice(tmp_path):
    order = [*range(100), *range(90, 100), *range(100, N), N - 1]
    read = Read(tmp_path, seconds(), order)
    assert read.is_whole()
    assert read.notes == ["11 rows (lines 102, 103, 104, 105, 106 and 6 more): twice in the file, left out"]


def test_other_readings_at_one_time(tmp_path):
    stamps = seconds()
    stamps[31] = stamps[30]
    read = Read(tmp_path, stamps)
    assert read.notes == ["1 row (line 33): at the time of another row, with other readings, left out"]
    assert len(read.rows.time_s) == N - 1


@pytest.mark.parametrize("back", [0.3, 7.0, 3600.0])
def test_a_clock_that_is_set_back(tmp_path, back):
    stamps = seconds()[:120] + [f"{t - back:.3f}" for t in TIME[120:]]
    read = Read(tmp_path, stamps)
    assert read.is_whole(), (read.found.all, read.notes)
    assert f"the clock is set back by {back:g} s at line 122" in read.notes[0]


def test_a_file_put_after_a_later_one(tmp_path):
    read = Read(tmp_path, seconds(), [*range(100, N), *range(100)])
    assert read.is_whole() and "100 rows (lines 102, 103, 104, 105, 106 and 95 more): out of order" in read.notes[0]


def test_a_clock_that_is_set_forward(tmp_path):
    """Silence and a clock that was set look alike in the stamps; that the drive goes on smoothly is a hint."""
    stamps = seconds()[:120] + [f"{t + 3600:.3f}" for t in TIME[120:]]
    read = Read(tmp_path, stamps)
    assert len(read.found.all) == 1
    assert "log.csv:121: time: nothing for 3600.1 s, up to line 122; 2 s at most (longest_gap_s)" in read.found.all[0]
    assert read.found.all[0].endswith("was the clock set? time.clock_set_at: [122]")
    unknown = Read(tmp_path, stamps, clock_set_at=frozenset([1, 99999]))
    assert "time.clock_set_at: has 1, 99999, where no row with a time begins" in unknown.found.all[0]
    read = Read(tmp_path, stamps, clock_set_at=frozenset([122]))
    assert read.is_whole() and "the clock is set forward by 3600 s at line 122" in read.notes[0]


@pytest.mark.parametrize("ahead, at, told", [(1.5, 120, True), (0.3, 120, True), (0.2, 120, True), (1.5, 79, False)])
def test_a_clock_that_is_set_forward_by_less_than_the_longest_gap(tmp_path, ahead, at, told):
    """A gap that is bridged, where the drive goes on at once; not where it hardly moves."""
    stamps = seconds()[:at] + [f"{t + ahead:.3f}" for t in TIME[at:]]
    read = Read(tmp_path, stamps)
    gap = f"gap of {ahead + 0.1:g} s between lines {at + 1} and {at + 2}"
    hint = f"the drives go on as if no time had passed: was the clock set? time.clock_set_at: [{at + 2}]"
    assert read.notes == [f"{gap}: bridged", *([f"warning: {gap}: {hint}"] if told else [])]
    assert not told or Read(tmp_path, stamps, clock_set_at=frozenset([at + 2])).is_whole()


@pytest.mark.parametrize("length", [3, 5, 10, 18])
@pytest.mark.parametrize("start", range(10, 170, 7))
def test_lost_rows_of_a_drive_that_moves_are_a_gap_alone(tmp_path, start, length):
    read = Read(tmp_path, seconds(), [*range(start), *range(start + length, N)])
    assert len(read.notes) == 1 and read.notes[0].endswith(": bridged")


@pytest.mark.parametrize("row, stamp, line", [(N - 1, 0.0, 201), (0, 0.0, 2), (N - 1, 1.8e9, 201)])
@pytest.mark.parametrize("backwards", [False, True])
def test_a_clock_that_is_wrong_in_one_row_at_an_end(tmp_path, row, stamp, line, backwards):
    stamps = seconds(1.7e9)
    stamps[row] = f"{stamp:.3f}"
    read = Read(tmp_path, stamps, list(reversed(range(N))) if backwards else None)
    line = N + 3 - line if backwards else line
    assert len(read.found.all) == 1 and "time: nothing for " in read.found.all[0]
    assert read.found.all[0].endswith(f"; line {line} stands alone there: is its stamp wrong?")


@pytest.mark.parametrize("back", [0, 7])
def test_a_first_row_after_all_others(tmp_path, back):
    """With and without another setting of the clock."""
    stamps = [f"{t - back * (t > 12):.3f}" for t in TIME]
    stamps[0] = "3600.000"
    read = Read(tmp_path, stamps)
    assert len(read.found.all) == 1 and "log.csv:2: time: is 358" in read.found.all[0]
    assert read.found.all[0].endswith("a stamp before that of line 3, or time.clock_set_at: [3]")
    assert Read(tmp_path, stamps, clock_set_at=frozenset([3])).is_whole()


def test_gaps_are_reported_with_their_lines(tmp_path):
    read = Read(tmp_path, seconds(), [*range(60), *range(70, N)])
    assert read.notes == ["gap of 1.1 s between lines 61 and 62: bridged"]
    assert read.gaps == [pytest.approx((5.9, 7.0))]
    read = Read(tmp_path, seconds(), [*range(60), *range(90, N)])
    assert "log.csv:61: time: nothing for 3.1 s, up to line 62; 2 s at most" in read.found.all[0]
    assert "clock_set_at" not in read.found.all[0]


def unpadded(separator, late_ms=30):
    stamps = [START + timedelta(seconds=float(t), milliseconds=late_ms) for t in TIME]
    return [s.strftime(f"%d.%m.%Y %H:%M:%S{separator}{s.microsecond // 1000}") for s in stamps]


@pytest.mark.parametrize("separator", [".", ",", ":", " "])
def test_milliseconds_without_zeros_before_them_are_refused(tmp_path, separator):
    read = Read(tmp_path, [f'"{s}"' for s in unpadded(separator)], format=f"%d.%m.%Y %H:%M:%S{separator}%f")
    assert len(read.found.all) == 1 and read.found.all[0].startswith(
        f"{read.file}:3: time: is '14.03.2026 23:59:55{separator}130', before the row above as it stands")
    assert read.found.all[0].endswith("; milliseconds with zeros before them (.050 for 50)")


@pytest.mark.parametrize("order", [None, list(reversed(range(N))), [1, 0, *range(2, N)]])
def test_decimals_without_zeros_behind_them_are_read(tmp_path, order):
    stamps = [(START + timedelta(seconds=0.05 + float(t))).strftime("%d.%m.%Y %H:%M:%S.%f").rstrip("0") for t in TIME]
    assert Read(tmp_path, stamps, order, format="%d.%m.%Y %H:%M:%S.%f").is_whole()


@pytest.mark.parametrize("form, pattern", [("%Y%m%d%H%M%S.%f", "%Y%m%d%H%M%S.%f"), ("%Y%m%d%H%M%S", "%Y%m%d%H%M%S")])
def test_a_stamp_that_is_all_digits_names_its_pattern(tmp_path, form, pattern):
    read = Read(tmp_path, local(form))
    assert read.found.all[0].endswith(f"; its pattern in the map, time.format: '{pattern}'")


def test_numbers_of_which_a_spreadsheet_has_cut_the_digits(tmp_path):
    read = Read(tmp_path, [f"{1.77e12 + 1000 * t:.5E}" for t in TIME], format="ms")
    assert "is 1.77000E+12, as many rows: its last digits are lost" in read.found.all[0]
    assert Read(tmp_path, [f"{1e3 + 1000 * t:.6E}" for t in TIME], format="ms").is_whole()


def test_thousands_in_the_time(tmp_path):
    stamps = [f'"{800 + 1000 * t:,.0f}"' for t in TIME]
    read = Read(tmp_path, stamps, format="ms")
    assert "log.csv:4: time: is '1,000', beside numbers without its mark; file.thousands: \",\"" in read.found.all[0]
    assert Read(tmp_path, stamps, format="ms", file=FileFormat(thousands=",")).is_whole()


def test_two_machines_in_one_log(tmp_path):
    stamps, hoist = [s for s in seconds() for _ in "ab"], [h for k in HOIST for h in (k, 3 - k)]
    read = Read(tmp_path, stamps, range(2 * N), hoist)
    assert read.found.all[0].endswith("; one machine's rows: those of one stamp are far apart")


def test_a_slow_logger_names_the_key(tmp_path):
    read = Read(tmp_path, [f"{24 * t:.1f}" for t in TIME])
    assert "is one row each 2.4 s; 0.001 to 2 s (longest_gap_s)" in read.found.all[0]
    assert "; longest_gap_s: 3.6, if the logger is as slow" in read.found.all[0]


def test_stamps_of_whole_seconds(tmp_path):
    stamps = [f"{int(t + 1e-9)}" for t in TIME]
    assert "180 of 200 rows have the time of another row" in Read(tmp_path, stamps).found.all[0]
    assert Read(tmp_path, stamps, spread=True).is_whole()


def day_number(rate_hz, digits):
    """As a spreadsheet writes stamps."""
    return [f"{46095.25833 + k / rate_hz / 86400:.{digits}f}" for k in range(N)]


@pytest.mark.parametrize("stamps, form, digit", [
    (day_number(1, 5), "days", "0.864"), (day_number(0.51, 5), "days", "0.864"), (day_number(5, 6), "days", "0.0864"),
    (day_number(1, 6), "days", None), (day_number(5, 8), "days", None), (day_number(1, 8), "days", None),
    ([f"{0.25 * k + 0.01:.1f}" for k in range(N)], "s", "0.1"), ([f"{int(1.2 * k)}" for k in range(N)], "s", "1"),
    ([f"{k}" for k in range(N)], "s", None), ([f"{k / 2:.1f}" for k in range(N)], "s", None)])
def test_stamps_too_coarse_for_the_interval(tmp_path, stamps, form, digit):
    read = Read(tmp_path, stamps, format=form)
    assert not any("counts by" in f for f in read.found.all) if digit is None else len(read.found.all) == 1 and \
        f"log.csv:2: time: counts by {digit} s, too coarse for one row each" in read.found.all[0]
    assert not Read(tmp_path, stamps, format=form, spread=True).found.all


@pytest.mark.parametrize("lost", [0.02, 0.1, 0.3])
def test_whole_seconds_with_lost_rows_are_read(tmp_path, lost):
    kept = np.flatnonzero(np.random.default_rng(3).random(N) > lost)
    assert not Read(tmp_path, [f"{k}" for k in range(N)], kept, longest_gap_s=9).found.all


@pytest.mark.parametrize("apart, kept", [(0.0003, False), (0.0007, True)])
def test_rows_closer_than_a_logger_writes_are_of_one_time(tmp_path, apart, kept):
    """What is kept has times of its own in signals.csv."""
    stamps = [f"{t:.4f}" for t in TIME]
    stamps[31] = f"{TIME[30] + apart:.4f}"
    read = Read(tmp_path, stamps)
    told = ["1 row (line 33): at the time of another row, with other readings, left out"]
    assert not read.found.all and read.notes == ([] if kept else told)
    hoist = SimpleNamespace(name="hoist_m", unit="m", role="driven", sigma=1, common_sigma=0, drift_sigma=None)
    signals = {"hoist_m": read.rows.values["hoist"]}
    write_measured(Measured({"hoist_m": hoist}, (), read.rows.time_s, signals), tmp_path / "out")
    time = [float(row.split(",")[0]) for row in (tmp_path / "out/signals.csv").read_text().splitlines()[1:]]
    assert np.diff(time).min() > 0 and len(time) == N - (not kept)


def test_a_part_of_the_log(tmp_path):
    read = Read(tmp_path, iso(), first="2026-03-14T23:59:57", last="2026-03-14T23:59:59")
    assert len(read.rows.time_s) == 21 and read.rows.time_s[0] == 0
    assert "is 'noon'; a stamp as in the log" in Read(tmp_path, iso(), first="noon").found.all[0]
    assert "no row of log.csv is within" in Read(tmp_path, iso(), first="2027-01-01T00:00:00").found.all[0]


@pytest.mark.parametrize("ends, kept", [
    ({"first": "23:59:57.000000"}, slice(20, N)), ({"last": "00:00:05.000000"}, slice(0, 101)),
    ({"first": "23:59:57.000000", "last": "00:00:05.000000"}, slice(20, 101)),
    ({"first": "00:00:05.000000"}, slice(100, N)), ({"first": "23:59:00.000000"}, slice(0, N)),
    ({"last": "23:59:57.000000"}, slice(0, 21)), ({"last": "00:10:00.000000"}, slice(0, N))])
@pytest.mark.parametrize("newest_first", [False, True])
def test_a_part_of_a_log_without_dates_goes_on_after_midnight(tmp_path, ends, kept, newest_first):
    order = reversed(range(N)) if newest_first else None
    read = Read(tmp_path, local("%H:%M:%S.%f"), order, format="%H:%M:%S.%f", **ends)
    assert not read.found.all and np.allclose(read.rows.values["hoist"], HOIST[kept], atol=1e-5)
    cut = " and ".join(f"time.{'from' if key == 'first' else 'to'}" for key in ends)
    assert read.notes[0] == f"{cut}: {N - len(HOIST[kept])} of {N} rows left out"


def test_a_file_that_is_none(tmp_path):
    read = Read(tmp_path, seconds(), [])
    assert "no rows after the header" in read.found.all[0]
    read = Read(tmp_path, seconds(), head="Zeit,h")
    assert "map.yaml:1: time.column: 't' is no column of log.csv (line 1); it has 'Zeit', 'h'" in read.found.all[0]
    read = Read(tmp_path, ["5"] * N)
    assert "log.csv:2: time: does not rise" in read.found.all[0]
