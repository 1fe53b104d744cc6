"""Reading a measured folder: a sound one round-trips; each fault is found, at its line, all at once."""
from datetime import datetime, timedelta, timezone

import numpy as np
import pytest

import synthetic
from dipper_run.findings import BadInput
from dipper_gap.readings.measured import read_measured, write_measured


@pytest.fixture
def folder(tmp_path):
    write_measured(synthetic.run(seed=1), tmp_path / "mine")
    return tmp_path / "mine"


def findings(folder, need=1):
    with pytest.raises(BadInput) as e:
        read_measured(folder, need)
    return e.value.findings


def change(file, old, new):
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))


def line_of(file, start):
    return [i for i, t in enumerate(file.read_text().splitlines(), 1) if t.startswith(start)][0]


def test_round_trip(folder):
    first, again = synthetic.run(seed=1), read_measured(folder, 3)
    assert [p.number for p in again.passes] == [1, 2, 3]
    assert again.passes[2].truck_mass_t == pytest.approx(first.passes[2].truck_mass_t, abs=1e-3)
    assert np.allclose(again.signals["hoist_force_kN"], first.signals["hoist_force_kN"], atol=1e-3)
    assert again.channels == first.channels
    assert again.responses() == ["hoist_force_kN", "crowd_force_kN"]


def test_a_position_that_is_said_to_answer_is_not_compared(folder):
    file = folder / "channels.yaml"
    text = file.read_text()
    file.write_text("\n".join(line.replace("driven", "response") if line.startswith("crowd_m") else line
                              for line in text.splitlines()) + "\n")
    again = read_measured(folder, 3)
    assert again.responses() == ["hoist_force_kN", "crowd_force_kN"]
    assert [q for q in again.questions() if q.startswith("crowd_m: role is response, but")]


def test_masses_alone_are_enough(folder):
    (folder / "signals.csv").unlink()
    (folder / "channels.yaml").write_text(
        "truck_mass_t: {unit: t, role: response, sigma: 2, common_sigma: 2}\n")
    assert read_measured(folder, 3).signals == {}


def test_masses_that_are_not_declared_are_asked_about(folder):
    lines = (folder / "channels.yaml").read_text().splitlines(keepends=True)
    (folder / "channels.yaml").write_text("".join(x for x in lines if not x.startswith("truck_mass_t")))
    assert "channels.yaml has no truck_mass_t, so the masses in passes.csv are not compared" in \
        read_measured(folder).questions()


@pytest.mark.parametrize("row", ["nan,20,3,0,1", "pass,x_m,z_m,after,truck", "1,20,3,0"])
def test_faces_of_no_pass_are_found(folder, row):
    points = "".join(f"1,{x},{x - 10},0,1\n" for x in range(12, 20))
    (folder / "profile.csv").write_text(f"pass,x_m,z_m,after,truck\n{points}{row}\n")
    assert findings(folder)


def test_passes_that_all_bring_nothing_are_refused(folder):
    rows = [line.split(",") for line in (folder / "passes.csv").read_text().splitlines()]
    at = rows[0].index("truck_mass_t")
    (folder / "passes.csv").write_text("\n".join(",".join(["0.0" if k == at and i else c for k, c in enumerate(row)])
                                                 for i, row in enumerate(rows)) + "\n")
    assert "passes.csv: truck_mass_t: is 0 for every pass; what each pass brought" in findings(folder)[0]


@pytest.mark.parametrize("end", ["\r", "\r\r\n"])
def test_what_spreadsheets_leave_in_tables(folder, end):
    """As dipper import reads logs: line ends, empty rows and columns, minus signs of text, sep= before the header."""
    before = read_measured(folder)
    for name in ("passes.csv", "signals.csv"):
        lines = (folder / name).read_text().replace("-", "\u2212").splitlines()
        lines = [lines[0] + ",,", *(line + ",," for line in lines[1:]), "," * lines[0].count(",") + ",,"]
        (folder / name).write_bytes(end.join(["sep=,", *lines]).encode())
    again = read_measured(folder)
    assert again.passes == before.passes
    assert np.array_equal(again.signals["crowd_force_kN"], before.signals["crowd_force_kN"])


@pytest.mark.parametrize("file, old, new, where, what", [
    ("channels.yaml", "unit: kN", "unit: N", 5, "hoist_force_kN.unit: is N; kN"),
    ("channels.yaml", "crowd_m:", "bucket_m:", 3, "bucket_m: unknown channel"),
    ("channels.yaml", "role: response, sigma: 1,", "role: driven, sigma: 1,", 1, "truck_mass_t.role"),
    ("channels.yaml", "sigma: 25", "sigma: -25", 5, "hoist_force_kN.sigma: is -25"),
    ("channels.yaml", "common_sigma: 15", "common: 15", 5, "hoist_force_kN.common: unknown key"),
    ("passes.csv", "48.000,96.000", "47.000,96.000", 3, "passes must not overlap"),
    ("passes.csv", "truck_mass_t", "mass", 1, "truck_mass_t: column missing"),
    ("passes.csv", "\n2,", "\n5,", 4, "pass: is 3; whole numbers that rise"),
    ("signals.csv", "hoist_force_kN", "hoist_force_N", 1,
     "hoist_force_N: unknown column; hoist_force_kN, perhaps? declare it in channels.yaml"),
    ("passes.csv", ",truck\n", ",Truck\n", 1, "Truck: unknown column; truck, perhaps? one of pass, t_start_s, t_end_s"),
    ("signals.csv", "\n7.000,", "\n5.500,", 9, "time_s: is 5.5 s after 6 s; later times only"),
    ("signals.csv", "\n9.000,", "\n9.000,nan,", 11, "row: 7 values; 6"),
])
def test_fault_is_found_at_its_line(folder, file, old, new, where, what):
    change(folder / file, old, new)
    all_of_it = findings(folder)
    assert any(f"{file}:{where}: " in f and what in f for f in all_of_it), all_of_it


def test_an_unknown_column_of_faces_is_found(folder):
    """Faces after passes are not taken for faces before them, nor one truck's for another's."""
    rows = "".join(f"1,{x},{0.5 * x},1,1\n" for x in range(12))
    (folder / "profile.csv").write_text("pass,x_m,z_m,After,Truck\n" + rows)
    said = findings(folder)
    assert [f.split("profile.csv")[1].split(" one of")[0] for f in said if "unknown column" in f] == [
        ":1: After: unknown column; after, perhaps?", ":1: Truck: unknown column; truck, perhaps?"]


def test_wrong_units_show_in_the_values(folder):
    change(folder / "passes.csv", ",8", ",80000")
    assert any("kg, perhaps?" in f for f in findings(folder))


def test_nan_and_text_are_found(folder):
    rows = (folder / "signals.csv").read_text().splitlines()
    rows[20] = "19.000,nan,0,0,0,zero"
    (folder / "signals.csv").write_text("\n".join(rows))
    all_of_it = findings(folder)
    assert any("signals.csv:21: hoist_m: is 'nan'" in f for f in all_of_it)
    assert any("signals.csv:21: crowd_force_kN: is 'zero'" in f for f in all_of_it)


def test_signals_without_a_row_are_not_taken_for_masses_alone(folder):
    (folder / "signals.csv").write_text((folder / "signals.csv").read_text().splitlines()[0] + "\n")
    assert [f for f in findings(folder) if "signals.csv" in f and "has no readings" in f]


def test_too_few_passes_or_readings(folder):
    assert any("3 found; 4 or more are needed" in f for f in findings(folder, 4))
    rows = (folder / "signals.csv").read_text().splitlines()
    (folder / "signals.csv").write_text("\n".join(rows[:52]))
    assert any("readings within pass 2" in f for f in findings(folder))


def test_a_run_may_end_within_a_pass(folder):
    with open(folder / "passes.csv", "a") as f:
        f.write("4,144,148,0,1\n")
    assert any("readings within pass 4" in f for f in findings(folder))
    assert [p.number for p in read_measured(folder, 3, simulated=True).passes] == [1, 2, 3]


def test_passes_of_several_trucks(folder):
    """Numbers begin anew with each truck; a folder without the column is of one."""
    text = (folder / "passes.csv").read_text()
    change(folder / "passes.csv", "\n3,96.000,144.000", "\n1,96.000,144.000")
    assert any("passes.csv:4: pass: is 1; whole numbers that rise" in f for f in findings(folder))
    rows = text.splitlines()
    (folder / "passes.csv").write_text("\n".join(r.rsplit(",", 1)[0] for r in rows))
    assert [p.truck for p in read_measured(folder).passes] == [1, 1, 1]
    two = ["1,0,20,30,1", "2,20,40,30,1", "1,60,80,31,2", "2,80,100,31,2"]
    (folder / "passes.csv").write_text("\n".join(rows[:1] + two))
    trucks = read_measured(folder, 2).trucks()
    assert [[(p.number, p.t_start_s) for p in t.passes] for t in trucks] == [[(1, 0), (2, 20)], [(1, 60), (2, 80)]]


@pytest.mark.parametrize("rows, what", [
    (["1,0,20,30,1", "2,20,40,30,1", "1,60,80,31,2"], "truck 2: has passes 1; 1, 2, as truck 1"),
    (["1,0,20,30,2", "2,20,40,30,2", "1,60,80,31,1", "2,80,100,31,1"],
     "passes.csv:4: truck: is 1; rising whole numbers"),
    (["1,0,20,30,1", "1,20,40,30,2", "2,60,80,31,1.5"], "passes.csv:4: truck: is 1.5; rising whole numbers"),
    (["1,0,20,30,1", "1,20,40,30,2"], "1 found; 2 or more are needed"),
    (["1,0,20,30,T12", "2,20,40,30,T12"], "passes.csv:2: truck: is 'T12'; a finite number"),
])
def test_faults_of_trucks(folder, rows, what):
    (folder / "passes.csv").write_text("\n".join(["pass,t_start_s,t_end_s,truck_mass_t,truck"] + rows))
    all_of_it = findings(folder, 2)
    assert any(what in f for f in all_of_it), all_of_it


def test_everything_at_once(folder):
    change(folder / "channels.yaml", "unit: kN", "unit: N")
    change(folder / "passes.csv", "48.000,96.000", "47.000,96.000")
    change(folder / "signals.csv", "\n7.000,", "\n5.500,")
    assert len(findings(folder)) == 3


def test_missing_folder(tmp_path):
    assert "not there" in findings(tmp_path / "none")[0]


FILES = ("channels.yaml", "passes.csv", "signals.csv")


@pytest.mark.parametrize("file", FILES)
def test_text_that_is_no_utf8_is_reported_with_its_line(folder, file):
    data = (folder / file).read_bytes()
    third = data.index(b"\n", data.index(b"\n") + 1) + 1
    (folder / file).write_bytes(data[:third] + b"\xe9" + data[third:])
    assert any(f"{file}:3: encoding: byte 0xE9 is not UTF-8" in f for f in findings(folder))
    (folder / file).write_bytes(data.decode().encode("utf-16"))
    assert any(f"{file}:1: encoding: is UTF-16" in f for f in findings(folder))
    (folder / file).write_bytes(data.decode().encode("utf-16-le"))
    assert any(f"{file}:1: encoding: a zero byte" in f for f in findings(folder))
    (folder / file).write_bytes(b"\xef\xbb\xbf" + data.replace(b"\n", b"\r\n"))
    read_measured(folder)


@pytest.mark.parametrize("new, what", [
    ("sigma: [25, 3]", "hoist_force_kN.sigma: is a list; a number"),
    ("sigma: {a: 1}", "hoist_force_kN.sigma: is a map; a number"),
    ("[1]: 2, sigma: 25", "hoist_force_kN.key: is a list; a word"),
    ("sigma: 1_0", "hoist_force_kN.sigma: is 1_0"),
    ("sigma: 1, sigma: 2", "hoist_force_kN.sigma: given twice"),
    ("sigma: &a [*a]", "hoist_force_kN.sigma: is a list"),
])
def test_lists_where_numbers_belong(folder, new, what):
    change(folder / "channels.yaml", "sigma: 25", new)
    all_of_it = findings(folder)
    assert any("channels.yaml:5: " + what in f for f in all_of_it), all_of_it


def test_deep_yaml_and_repeated_columns(folder):
    text = (folder / "channels.yaml").read_text()
    (folder / "channels.yaml").write_text("a: " + "[" * 3000)
    assert any("channels.yaml: YAML: lists within lists" in f for f in findings(folder))
    (folder / "channels.yaml").write_text(text)
    change(folder / "signals.csv", "hoist_m", "time_s")
    assert any("signals.csv:1: time_s: column given twice" in f for f in findings(folder))


def as_a_spreadsheet_writes_it(text):
    return "\ufeff" + text.replace(",", "; ").replace(".", ",").replace("\n", "\r\n")


def test_semicolons_decimal_commas_blanks_byte_order_mark_and_carriage_returns(folder):
    first = read_measured(folder)
    for file in ("passes.csv", "signals.csv"):
        (folder / file).write_text(as_a_spreadsheet_writes_it((folder / file).read_text()), newline="")
    again = read_measured(folder)
    assert again.passes == first.passes and np.array_equal(again.time_s, first.time_s)
    assert all(np.array_equal(again.signals[n], first.signals[n]) for n in first.signals)


@pytest.mark.parametrize("behind, decimal", [(" t", "."), ("t", "."), (" t", ",")])
def test_a_mass_with_its_unit_behind_it(folder, behind, decimal):
    first = read_measured(folder)
    header, *rows = [line.split(",") for line in (folder / "passes.csv").read_text().splitlines()]
    at = header.index("truck_mass_t")
    rows = [[cell + behind if k == at else cell for k, cell in enumerate(row)] for row in rows]
    (folder / "passes.csv").write_text("\n".join(";".join(row).replace(".", decimal) for row in [header, *rows]))
    assert read_measured(folder).passes == first.passes


def test_a_mass_with_another_unit_behind_it_is_refused(folder):
    rows = (folder / "passes.csv").read_text().splitlines()
    at = rows[0].split(",").index("truck_mass_t")
    first = rows[1].split(",")
    first[at] += " kg"
    (folder / "passes.csv").write_text("\n".join([rows[0], ",".join(first), *rows[2:]]))
    assert any("passes.csv:2: truck_mass_t: is '" in f and "kg'" in f for f in findings(folder))


def test_commas_that_may_part_thousands_are_refused(folder):
    """As in the tables of a case: 943,981 kN is 944 kN or 943,981 kN."""
    header, *rows = [line.split(",") for line in (folder / "signals.csv").read_text().splitlines()]
    rows = [";".join([r[0].split(".")[0], "3", "1", "1", "943,981", "12,500"]) for r in rows]
    (folder / "signals.csv").write_text("\n".join([";".join(header), *rows]))
    assert findings(folder) == [f"{folder}/signals.csv:2: {header[4]}: is '943,981', and every comma in the file has "
                                "three digits after it: it may part thousands; write decimals with a point, and "
                                "nothing between thousands"]
    change(folder / "signals.csv", "12,500", "12,5")
    assert read_measured(folder).signals[header[4]][0] == 943.981


def test_marks_of_thousands_are_named(folder):
    header, *rows = [line.split(",") for line in (folder / "passes.csv").read_text().splitlines()]
    rows = [",".join([*r[:3], '"80,760"', r[4]]) for r in rows]
    (folder / "passes.csv").write_text("\n".join([",".join(header), *rows]))
    assert all("truck_mass_t: is '80,760'; a finite number, without marks of thousands" in f for f in findings(folder))


@pytest.mark.parametrize("change_of, goes", [
    (lambda t: f"{1000 * float(t):g}", "from 0 s to 144000 s"),
    (lambda t: f"{float(t) + 1000:g}", "from 1000 s to 1144 s"),
    (lambda t: datetime.fromtimestamp(1773468000 + float(t), timezone.utc).isoformat(),
     "from 2026-03-14T06:00:00Z to 2026-03-14T06:02:24Z")])
def test_passes_of_another_clock_or_unit_are_one_fault(folder, change_of, goes):
    header, *rows = [line.split(",") for line in (folder / "passes.csv").read_text().splitlines()]
    (folder / "passes.csv").write_text("\n".join([",".join(header), *(
        ",".join([r[0], change_of(r[1]), change_of(r[2]), *r[3:]]) for r in rows)]))
    found = findings(folder)
    assert len(found) == 1 and f"and passes.csv {goes}; seconds, or time stamps, of one clock in both files" in found[0]


@pytest.mark.parametrize("with_zone", ["signals.csv", "t_start_s"])
def test_stamps_with_a_zone_beside_others_without_are_one_fault(folder, with_zone):
    """Of one clock by their looks, and two hours apart."""
    for file, columns in (("passes.csv", (1, 2)), ("signals.csv", (0,))):
        header, *rows = [line.split(",") for line in (folder / file).read_text().splitlines()]
        for row, k in ((row, k) for row in rows for k in columns):
            zone = "+02:00" if with_zone in (file, header[k]) else ""
            row[k] = (datetime(2026, 3, 14, 6) + timedelta(seconds=float(row[k]))).isoformat() + zone
        (folder / file).write_text("\n".join(",".join(r) for r in [header] + rows))
    column, other = ("t_start_s", "time_s of signals.csv") if with_zone == "signals.csv" else ("t_end_s", "t_start_s")
    found = [f for f in findings(folder) if "without a zone" in f]
    assert found[0].startswith(f"{folder / 'passes.csv'}: {column}: has stamps without a zone, and {other} ")
    assert len(found) == 1 and found[0].endswith("; a zone, such as Z or +02:00, in all or in none")
    assert not [f for f in findings(folder) if "signals.csv:" in f]


@pytest.mark.parametrize("value", ["1773468000000", "nan"])
def test_an_end_that_is_no_time_is_a_finding(folder, value):
    rows = [line.split(",") for line in (folder / "passes.csv").read_text().splitlines()]
    rows[1][2], rows[2][1] = value, "5"
    (folder / "passes.csv").write_text("\n".join(",".join(r) for r in rows))
    assert any("passes.csv:" in f for f in findings(folder))


def test_iso_time_stamps(folder):
    first = read_measured(folder)

    def stamp(seconds):
        return (datetime(2026, 3, 14, 23, 59, tzinfo=timezone.utc) + timedelta(seconds=float(seconds))).isoformat()

    for file, columns in (("passes.csv", (1, 2)), ("signals.csv", (0,))):
        header, *rows = [line.split(",") for line in (folder / file).read_text().splitlines()]
        for row in rows:
            for k in columns:
                row[k] = stamp(row[k])
        (folder / file).write_text("\n".join(",".join(r) for r in [header] + rows))
    again = read_measured(folder)
    assert np.allclose(np.diff(again.time_s), np.diff(first.time_s), atol=1e-6)
    assert np.allclose([p.t_start_s - again.time_s[0] for p in again.passes],
                       [p.t_start_s - first.time_s[0] for p in first.passes], atol=1e-6)
    change(folder / "signals.csv", stamp(5.0), "2026-03-14T23:59:05")  # without its zone
    assert any("signals.csv:7: time_s: is '2026-03-14T23:59:05'; a time stamp as in the first row" in f
               for f in findings(folder))


def test_one_cause_is_one_line(folder):
    rows = (folder / "signals.csv").read_text().splitlines()
    (folder / "signals.csv").write_text("\n".join(rows[:1] + [r.replace(".", ",") for r in rows[1:]]))
    faults = [f for f in findings(folder) if "signals.csv" in f and "readings within" not in f]
    assert len(faults) == 1 and f"and the same in {len(rows) - 2} more lines" in faults[0]
    assert "with decimal commas, part the columns by semicolons" in faults[0]
    (folder / "signals.csv").write_text("\n".join(rows[:1] + list(reversed(rows[1:]))))
    faults = [f for f in findings(folder) if "later times only" in f]
    assert len(faults) == 1 and f"and the same in {len(rows) - 3} more lines" in faults[0]


PIECES = [b"", b"[", b"{", b": ", b",", b"\n", b"\0", b"\xff", b"nan", b"1e999", b"&a *a", b"\"", b"- ", b"\x85"]


def test_damaged_folders_are_read_or_refused(folder):
    """Bytes changed, cut out and put in at random: findings or a sound folder, never another exception."""
    whole = {f: (folder / f).read_bytes() for f in FILES}
    rng, refused = np.random.default_rng(6), 0
    for _ in range(250):
        for file, data in whole.items():
            data = bytearray(data[:400])
            for _ in range(rng.integers(0, 4)):
                at = int(rng.integers(len(data)))
                data[at:at + int(rng.integers(0, 12))] = rng.choice(PIECES)
            (folder / file).write_bytes(data)
        try:
            read_measured(folder, 1, simulated=True)
        except BadInput as e:
            refused += 1
            assert all(str(folder) in f for f in e.findings)
    assert refused > 100
