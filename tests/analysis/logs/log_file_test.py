"""How loggers write files: lines before and between, delimiters, quotes, encodings, and what is refused."""
import json
from pathlib import Path

import numpy as np
import pytest

from dipper_import.import_map import read_map
from dipper_import.log_file import read_log
from dipper_import.readings import _out_of_reach
from dipper_run.csv_text import decimal_number, find_decimal
from dipper_run.findings import Findings

MAP = """\
time: {column: t}
channels:
  hoist: {column: h, unit: m}
  crowd: {column: c, unit: m}
  swing: {column: s, unit: deg}
  door: {column: "d, °", unit: deg}
"""
ROWS = [["t", "h", "c", "s", "d, °"], *([f"{k / 2:.1f}", "1.5", "-0.25", "1e1", "0"] for k in range(6))]


@pytest.fixture
def read(tmp_path):
    def reader(text, more="", encoding="utf-8"):
        (tmp_path / "map.yaml").write_text(MAP + more)
        (tmp_path / "log.csv").write_bytes(text.encode(encoding))
        found, notes = Findings(), []
        return read_log(tmp_path / "log.csv", read_map(tmp_path / "map.yaml"), found, notes), found.all, notes

    return reader


def joined(rows, delimiter):
    return "\n".join(delimiter.join(f'"{c}"' if delimiter in c else c for c in row) for row in rows) + "\n"


def is_whole(log):
    return len(log.lines) == 6 and log.stamp_s[-1] == 2.5 and (log.values["crowd"] == -0.25).all() \
        and (log.values["swing"] == 10).all()


def marks():
    lines = (Path(__file__).resolve().parents[2] / "common/number_marks.txt").read_text().splitlines()
    return [line.split() for line in lines if not line.startswith("#")]


@pytest.mark.parametrize("words", marks(), ids=" ".join)
def test_marks_of_numbers_are_read_as_the_program_reads_them(words):
    """tests/common/csv_table_test.cpp reads the same lines."""
    verdict, cells = words[0], [w.split("=")[0] for w in words[1:]]
    decimal, doubtful = find_decimal(cells)
    if verdict == "none":
        assert all(decimal_number(c, d) is None for c in cells for d in ".,")
    elif verdict == "open":
        assert decimal == "," and doubtful == cells[0]
    else:
        assert (decimal, doubtful) == ({"comma": ",", "point": "."}[verdict], None)
        assert [decimal_number(c, decimal) for c in cells] == [float(w.split("=")[1]) for w in words[1:]]


TABLES = [json.loads(line) for line in
          (Path(__file__).resolve().parents[2] / "common/tables.jsonl").read_text().splitlines()]
TABLE_MAP = """\
time: {column: t_s}
channels:
  hoist: {column: h_m, unit: m}
  crowd: {column: c_m, unit: m}
  swing: {column: s_deg, unit: deg}
  door: {column: d_deg, unit: deg}
"""


@pytest.mark.parametrize("table", TABLES, ids=lambda t: t["kind"])
def test_tables_of_the_field_are_read_as_the_program_reads_them(tmp_path, table):
    """tests/common/csv_table_test.cpp reads the same tables."""
    (tmp_path / "map.yaml").write_text(TABLE_MAP)
    (tmp_path / "log.csv").write_bytes(table["text"].encode() if "text" in table else bytes.fromhex(table["hex"]))
    found = Findings()
    log = read_log(tmp_path / "log.csv", read_map(tmp_path / "map.yaml"), found, [])
    if "rows" not in table:
        assert found.all and table["says"].split(" is")[0] in "\n".join(found.all)
        return
    assert not found.all
    time, *rest = zip(*table["rows"])
    assert [s - log.stamp_s[0] for s in log.stamp_s] == [t - time[0] for t in time]
    if table["kind"] == "no line end at the end":  # a logger that was switched off may have cut its last cell
        rest[-1] = [*rest[-1][:-1], np.nan]
    assert np.array_equal([log.values[n] for n in ("hoist", "crowd", "swing", "door")], rest, equal_nan=True)


@pytest.mark.parametrize("encoding", ["punycode", "undefined"])
def test_an_encoding_of_no_file_is_refused(read, encoding):
    _, found, _ = read(joined(ROWS, ";"), f"file: {{encoding: {encoding}}}\n")
    assert f"log.csv: encoding: is not {encoding}: " in found[0] and found[0].endswith("; another file.encoding")


@pytest.mark.parametrize("delimiter", [",", ";", "\t", "|"])
def test_every_delimiter(read, delimiter):
    log, found, _ = read(joined(ROWS, delimiter))
    assert not found and is_whole(log)


@pytest.mark.parametrize("delimiter", [";", "\t", "|"])
def test_decimal_commas(read, delimiter):
    log, found, _ = read(joined([ROWS[0], *([c.replace(".", ",") for c in row] for row in ROWS[1:])], delimiter))
    assert not found and is_whole(log)


def test_quoted_decimal_commas_between_commas(read):
    log, found, _ = read(joined([ROWS[0], *([c.replace(".", ",") for c in row] for row in ROWS[1:])], ","))
    assert not found and is_whole(log)


def test_lines_that_are_no_readings(read):
    text = joined(ROWS, ";").splitlines()
    text = ["Logger 7", "", "# unit 12", text[0], "s;m;m;deg;deg", *text[1:3], text[0], *text[3:], "3,0;1"]
    log, found, notes = read("\r\n".join(text), "file: {data_line: 6}\n")
    assert not found and is_whole(log)
    assert notes == ["line 13, the last, is cut short: left out", "1 row (line 8): the header again, left out"]
    _, found, _ = read("\r\n".join(text))
    assert "log.csv:5: time: is 's', neither ISO 8601 nor a number" in found[0]


@pytest.mark.parametrize("names, cut", [("thcsd", "1.5"), ("thcsd", "1"), ("hcsdt", "2.")])
def test_a_last_cell_that_may_be_cut_short_is_no_reading(read, names, cut):
    """Of a time the whole row goes."""
    order = ["thcsd".index(name) for name in names]
    text = joined([[[*row[:4], "1.5" if k else row[4]][i] for i in order] for k, row in enumerate(ROWS)], ";")
    whole, found, notes = read(text)
    assert not found and not notes and len(whole.lines) == 6 and (whole.values["door"] == 1.5).all()
    log, found, notes = read(text.rstrip("\n")[:-3] + cut)
    left = "its last cell" if names[-1] == "d" else "it"
    assert not found and notes == [f"line 7, the last, has no line end, and may be cut short: {left} is left out"]
    assert len(log.lines) == (6 if names[-1] == "d" else 5) and np.isfinite(log.values["door"][:5]).all()
    assert not np.isfinite(log.values["door"][5:]).any()


@pytest.mark.parametrize("at", [0, 1, 2, 10, 37, 38, 39])
@pytest.mark.parametrize("off", [9.0, -9.0])
def test_a_reading_that_is_out_of_reach_of_its_neighbours(at, off):
    """Also one at the end, which has them to one side."""
    time = 0.2 * np.arange(40)
    value = 4 * np.sin(time / 3)  # 1.3 m/s
    assert not _out_of_reach(time, value, 1.8).any()
    value[at] += off
    assert np.flatnonzero(_out_of_reach(time, value, 1.8)).tolist() == [at]


def test_empty_cells_at_the_end_of_rows(read):
    log, found, _ = read(joined([row + [""] for row in ROWS], ";"))
    assert not found and is_whole(log)
    log, found, _ = read(joined([ROWS[0], *(row + [""] for row in ROWS[1:])], ";"))
    assert not found and is_whole(log)


def test_cells_that_mean_no_reading(read):
    rows = [list(row) for row in ROWS]
    rows[2][1], rows[3][1], rows[4][1] = "", "NULL", "-9999"
    log, found, _ = read(joined(rows, ";"), "file: {missing: ['-9999']}\n")
    assert not found and [x == x for x in log.values["hoist"]] == [True, False, False, False, True, True]


@pytest.mark.parametrize("mark", ["#", "# "])
def test_a_header_behind_the_mark_of_comments_names_the_key(read, mark):
    log = mark + joined(ROWS, ",")
    _, found, _ = read("# unit 12\n" + log)
    assert len(found) == 1 and "log.csv:2: file: begins with #, as comments do, and has the names of columns; " \
        "file.header_line: 2, if it is the header" in found[0]
    whole, found, _ = read("# unit 12\n" + log, "file: {header_line: 2}\n")
    assert not found and is_whole(whole)


def test_a_column_that_begins_with_a_mark(read, tmp_path):
    (tmp_path / "hash.yaml").write_text(MAP.replace("column: t", "column: '#t'") + "file: {header_line: 1}\n")
    (tmp_path / "hash.csv").write_text("#" + joined(ROWS, ","))
    found = Findings()
    assert is_whole(read_log(tmp_path / "hash.csv", read_map(tmp_path / "hash.yaml"), found, [])) and not found.all


@pytest.mark.parametrize("written", ["#N/A", " #n/a "])
def test_a_row_that_begins_with_no_value_is_no_comment(read, written):
    rows = [[*row[1:], row[0]] for row in ROWS]
    rows[3][0] = written
    log, found, _ = read("# a comment, too\n" + joined(rows, ","))
    assert not found and is_whole(log) and np.flatnonzero(np.isnan(log.values["hoist"])).tolist() == [2]
    rows[3][0] = "#DIV/0!"
    assert "log.csv:4: h: is '#DIV/0!'; a number; if it means that there is no reading, list it under file.missing" \
        in read(joined(rows, ","))[1][0]


def test_encodings(read):
    text = joined(ROWS, ";")
    _, found, _ = read(text, encoding="cp1252")
    assert "log.csv:1: encoding: byte 0xB0 is not UTF-8" in found[0] and "{encoding: utf-16}, or cp1252" in found[0]
    for encoding in ("cp1252", "utf-16", "utf-8-sig"):
        log, found, _ = read(text, "file: {encoding: %s}\n" % encoding, encoding)
        assert not found and is_whole(log)


@pytest.mark.parametrize("more", ["", "file: {encoding: cp1252}\n"])
@pytest.mark.parametrize("begins, said", [
    ("\xd0\xcf\x11\xe0\xa1\xb1", "is a spreadsheet (.xls), or another document of an office program; save its sheet"),
    ("\x1f\x8b\x08\0", "is compressed by gzip; unpack it with gunzip"),
    ("PK\x03\x04\0\0xl/workbook.xml", "is a spreadsheet; save its sheet as CSV")])
def test_files_that_are_no_text_are_named(read, begins, said, more):
    _, found, _ = read(begins, more, "latin-1")
    assert len(found) == 1 and f"log.csv: file: {said}" in found[0] and "encoding" not in found[0]


def test_one_cause_is_one_line(read):
    text = joined(ROWS[:1], ";") + "".join(f"{k / 2};up;0;0;0\n" for k in range(114))
    _, found, _ = read(text)
    assert len(found) == 1 and "log.csv:2: h: is 'up', and the same in 113 more lines; a number; if it" in found[0]
    _, found, _ = read("t,h,c,s,\"d, °\"\n" + "".join(f"{k},1,5,0,0,0\n" for k in range(114)))
    assert len(found) == 1 and "row: 6 cells, and the same in 113 more lines; 5, as in the header: with" in found[0]
