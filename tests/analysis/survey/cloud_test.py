"""Clouds in every form that is read, and what is said of those that are not."""
import struct

import numpy as np
import pytest

import scanned_face
from dipper_run.findings import BadInput, Findings
from dipper_survey import las, ply, text_cloud
from dipper_survey.cloud import open_cloud
from dipper_survey.site import Site

POINTS = scanned_face.to_mine(scanned_face.scene(2000))


def read(path):
    found = Findings()
    cloud = open_cloud(path, found)
    found.raise_if_any()
    first, second = (np.vstack(list(cloud.parts())) for _ in range(2))
    np.testing.assert_array_equal(first, second)
    return first


def fault(path):
    with pytest.raises(BadInput) as e:
        read(path)
    assert len(e.value.findings) == 1
    return e.value.findings[0].removeprefix(str(path))


def text(tmp_path, content, name="scan.txt"):
    file = tmp_path / name
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    return file


def rows(between=" ", mark=".", end="\n", columns=(0, 1, 2), more=()):
    return "".join(between.join([f"{p[c]:.3f}".replace(".", mark) for c in columns] + list(more)) + end for p in POINTS)


@pytest.mark.parametrize("content", [
    rows(), rows("\t"), rows(", "), rows("  ") + "\n\n", rows(end="\r\n"), rows(end="\r"), rows(";", ","),
    rows("\t", ","), rows(" ", ","), "\ufeff" + rows(), rows().rstrip("\n"),
    "x y z\n" + rows(), "\ufeffX;Y;Z\n" + rows(";", ","), "//X,Y,Z,R,G,B\n" + rows(",", more=("10", "20", "30")),
    "# made by a scanner of ours, today\n" + rows(), f"{len(POINTS)}\n" + rows(more=("-512", "1", "2", "3")),
    rows(";", ",", more=("a.b",)), "Northing,Easting,Elevation\n" + rows(",", columns=(1, 0, 2)),
    "Bench 12\nEasting (m);Northing (m);RL (m);Code\nm;m;m;-\n" + rows(";", more=("rock",)),
    '"Point","E [m]","N [m]","H [m]"\n' + "".join(f'"P{i}","{a:.3f}","{b:.3f}","{c:.3f}"\n'
                                                  for i, (a, b, c) in enumerate(POINTS))])
def test_text(tmp_path, content, monkeypatch):
    monkeypatch.setattr(text_cloud, "PART", 10_000)
    np.testing.assert_allclose(read(text(tmp_path, content)), POINTS, rtol=0, atol=6e-4)


@pytest.mark.parametrize("before, after", [
    ("N,X,Y,Z", ""), ("n,x,y,z", ""), ("E,X,Y,Z", ""), ("H,X,Y,Z", ""), ("Level,X,Y,Z", ""), ("No,E,N,RL", ""),
    ("N,Easting,Northing,Elevation", ""), ("X1,Y1,Z1,X,Y,Z", ""), ("E,N,X,Y,Z", ""), ("X,Y,Z", ",N,E,H"),
    ("x,y,h", ""), ("Easting,N,Z", ""), ("E,N,Z,X", "")])
def test_columns_are_taken_as_a_whole(tmp_path, before, after):
    """Point numbers, echoes and levels beside them are none of x, y and z, nor is a second set with digits."""
    names = before.split(",")
    first = len(names) - 3 if names[-1] != "X" else 0
    lines = (",".join([*(str(i % 5) for i in range(first)), *row.split(","), *["7"] * (len(names) - first - 3),
                       *["3"] * after.count(",")]) for row in rows(",").splitlines())
    cloud = read(text(tmp_path, before + after + "\n" + "\n".join(lines) + "\n"))
    np.testing.assert_allclose(cloud, POINTS, rtol=0, atol=6e-4)


def test_rows_without_a_return_are_kept_as_such(tmp_path):
    points = read(text(tmp_path, rows() + "nan nan nan\n"))
    assert np.isnan(points[-1]).all() and len(points) == len(POINTS) + 1


@pytest.mark.parametrize("content, said", [
    (rows() + "512345.2 7443210.9\n", f":{len(POINTS) + 1}: point: has 2 cells"),
    (rows() + "512345.2 7443210.9 high\n", f":{len(POINTS) + 1}: point: 'high' is no number"),
    ("512,345.2;7,443,210.9;182.4\n" * 9, ":1: numbers: '512,345.2' has its thousands parted"),
    ("512,345;443,210;182,123\n" * 9, ":1: numbers: every comma has three digits after it"),
    (rows(";") + "7,443,210.9;1;2\n", f":{len(POINTS) + 1}: point: '7,443,210.9' is no number"),
    ("x,y,z\n" + rows(",", ","), ":2: point: has 6 cells, the header 3 names"),
    ("a;b;c\n" + rows(";"), ":1: header: has 'a', 'b', 'c'; columns called x, y, z"),
    ("1;2\n3;4\n", ":1: point: is '1;2'; x, y and z"),
    ("Dear all,\nhere is the scan\n", ":1: file: no line of three numbers"),
    ("3\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n" + rows(), ":1: file: is a PTX"),
    ("p1 " + rows(end="\np1 "), ":1: point: 'p1' is no number; a coordinate in m"),
    ("x" * 99_999, ":1: file: no line of three numbers, it begins with 'xxx"),
    (rows(";", ",", more=("a.b",)) + "512.345,2;7443210,9;1,5;a.b\n", f":{len(POINTS) + 1}: point: '512.345,2' is no"),
    ("", ": file: is empty"), (b"\x00\x01\x02" * 99, ": file: is neither text nor PLY nor LAS"),
    (rows().encode("utf-16"), ": file: is UTF-16"), (b"\x1f\x8b" + b"x" * 99, ": file: is compressed by gzip"),
    ("# of the drone\nmtllib a.mtl\no face\nv 512345.2 7443210.9 182.4\n", ": file: is an OBJ; export its vertices as"),
    ("v 512345.2 7443210.9 182.4\r\nv 512346.2 7443210.9 182.4\r\n", ": file: is an OBJ"),
    ("  0\r\nSECTION\r\n  2\r\nENTITIES\r\n", ": file: is a DXF"), (b"II*\0\x08\0\0\0", ": file: is a TIFF"),
    ("ncols 10\nnrows 10\nxllcorner 512345\n", ": file: is a grid of heights; export it as x y z text or LAS"),
    (b"\x89HDF\r\n\x1a\n\0\0", ": file: is HDF5; save its channels as CSV"),
    ("solid face\n", ": file: is an STL"), (b"ASTM-E57" + b"\0" * 99, ": file: is an E57"),
    (b"PK\x03\x04" + b"\0" * 99, ": file: is a ZIP; unpack it"),
    (b"PK\x03\x04" + b"\0" * 99 + b"xl/workbook.xml", ": file: is a spreadsheet; save its sheet as CSV"),
    ("lon,lat,z\n" + rows(","), "in metres of the mine's grid: project the degrees to it"),
    ("E (ft),N (ft),Z (ft)\n" + rows(","), ":1: header: says 'ft'; coordinates in metres: convert them"),
    ("x,y,z\nm,m,ft\n" + rows(","), ":2: header: says 'ft'"),
    ("x (m),y (m),z (US Survey Feet)\n" + rows(","), ":1: header: says 'feet'"),
    ("x (m),y (m),z [intl. ft]\n" + rows(","), ":1: header: says 'ft'"),
    ("x,y,z\nm,m,US survey foot\n" + rows(","), ":2: header: says 'foot'"),
    ("E,N,Z,RL\n" + rows(",", more=("1",)), ":1: header: has 2 columns for z: 'Z', 'RL'; one: give the others other"),
    ("X,Y,Z,X\n" + rows(",", more=("1",)), ":1: header: has 2 columns for x: 'X', 'X'"),
    ("X1,Y1,Z1\n" + rows(","), ":1: header: has 'X1', 'Y1', 'Z1'; columns called x, y, z"),
    ("".join(f"{i} {line}\n" for i, line in enumerate(rows().splitlines(), 1)), ":1: point: the first column counts"),
    ("".join(f"{101 + i},{line},CREST\n" for i, line in enumerate(rows(",").splitlines())),
     ":1: point: the first column counts")])
def test_text_that_is_none(tmp_path, content, said):
    assert said in fault(text(tmp_path, content))


def test_a_line_of_a_grid_in_metres_counts_no_points(tmp_path):
    grid = "".join(f"{512345 + i} 7443210 182.{i} 40\n" for i in range(9))
    assert len(read(text(tmp_path, grid))) == 9


def test_no_file(tmp_path):
    assert "cannot be read" in fault(tmp_path / "none.xyz") and "cannot be read" in fault(tmp_path)


def ply_file(tmp_path, kind="binary_little_endian", number="double", before="", points=POINTS, more=b"", end="\n"):
    header = end.join(["ply", f"format {kind} 1.0", "comment by a test", *([before] if before else []),
                       f"element vertex {len(POINTS)}", f"property {number} x", "property uchar red",
                       f"property {number} y", f"property {number} z", "element face 0",
                       "property list uchar int vertex_indices", "end_header", ""]).encode()
    if kind == "ascii":
        body = "".join(f"{a:.4f} 7 {b:.4f} {c:.4f}{end}" for a, b, c in points).encode()
    else:
        order = "<" if "little" in kind else ">"
        f = order + ("f8" if number == "double" else "f4")
        table = np.zeros(len(points), [("x", f), ("red", "u1"), ("y", f), ("z", f)])
        for axis, values in zip("xyz", points.T):
            table[axis] = values
        body = table.tobytes()
    return text(tmp_path, header + more + body, "scan.ply")


@pytest.mark.parametrize("words", [
    {}, {"kind": "binary_big_endian"}, {"kind": "ascii"}, {"kind": "ascii", "end": "\r\n"}, {"end": "\r\n"},
    {"before": "element camera 2\nproperty float focus\nproperty int on", "more": b"\0" * 16}])
def test_ply(tmp_path, words, monkeypatch):
    monkeypatch.setattr(ply, "PART", 700)
    np.testing.assert_allclose(read(ply_file(tmp_path, **words)), POINTS, rtol=0, atol=6e-5)


def test_single_precision_holds_local_coordinates_and_no_northing(tmp_path):
    near = POINTS - scanned_face.ORIGIN
    np.testing.assert_allclose(read(ply_file(tmp_path, number="float", points=near)), near, atol=1e-5)
    assert "rounded to 0.5 m" in fault(ply_file(tmp_path, number="float"))


@pytest.mark.parametrize("words, said", [
    ({"points": POINTS[:-5]}, f"ends after {len(POINTS) - 5} of its {len(POINTS)} vertices"),
    ({"kind": "ascii", "points": POINTS[:-5]}, f"ends after {len(POINTS) - 5} of its {len(POINTS)} vertices"),
    ({"kind": "middle_endian"}, ":2: PLY: is 'format middle_endian 1.0'"),
    ({"number": "quad"}, ":5: PLY: is 'property quad x'"),
    ({"before": "element face 1\nproperty list uchar int vertex_indices"}, "has lists before or in its vertices")])
def test_broken_ply(tmp_path, words, said):
    number = words.get("number", "double")
    file = ply_file(tmp_path, **{**words, "number": "double"})
    file.write_bytes(file.read_bytes().replace(b"double", number.encode()))
    assert said in fault(file)


def las_file(tmp_path, version=(1, 2), form=3, flags=None, classes=None, cut=0, record=bytes(10)):
    header_size = 375 if version >= (1, 4) else 227
    length = las.SHORTEST[form] + 2  # with two bytes of a maker's own
    scale, offset = np.array([0.001, 0.001, 0.001]), np.array([512000.0, 7443000.0, 0.0])
    head = bytearray(header_size)
    head[:4] = b"LASF"
    head[24:26] = bytes(version)
    struct.pack_into("<HII", head, 94, header_size, header_size + len(record), int(any(record)))
    struct.pack_into("<BHI", head, 104, form, length, 0 if version >= (1, 4) else len(POINTS))
    struct.pack_into("<6d", head, 131, *scale, *offset)
    if version >= (1, 4):
        struct.pack_into("<Q", head, 247, len(POINTS))
    body = np.zeros((len(POINTS), length), np.uint8)
    whole = np.round((POINTS - offset) / scale).astype("<i4")
    body[:, :12] = whole.view(np.uint8).reshape(-1, 12)
    if flags is not None:
        body[:, 15] = flags
    if classes is not None:
        body[:, 15 if form < 6 else 16] = classes
    data = bytes(head) + record + body.tobytes()
    return text(tmp_path, data[:len(data) - cut], "scan.las")


@pytest.mark.parametrize("version, form", [((1, 0), 0), ((1, 2), 3), ((1, 3), 5), ((1, 4), 6), ((1, 4), 7),
                                           ((1, 4), 1)])
def test_las(tmp_path, version, form, monkeypatch):
    monkeypatch.setattr(las, "PART", 700)
    np.testing.assert_allclose(read(las_file(tmp_path, version, form)), POINTS, rtol=0, atol=6e-4)


@pytest.mark.parametrize("form, version, noise", [(1, (1, 2), 7), (6, (1, 4), 18)])
def test_noise_and_withheld_points_of_a_las_are_left_out(tmp_path, form, version, noise):
    classes = np.full(len(POINTS), 2)
    classes[:30] = noise
    assert len(read(las_file(tmp_path, version, form, classes=classes))) == len(POINTS) - 30
    flags = np.zeros(len(POINTS))
    flags[:20] = 0x80 if form < 6 else 0x04
    assert len(read(las_file(tmp_path, version, form, flags=flags))) == len(POINTS) - 20


def las_record(kind, data):
    head = bytearray(las.VLR)
    struct.pack_into("<HH", head, 18, kind, len(data))
    return bytes(head) + data


@pytest.mark.parametrize("kind, data, said", [
    (las.GEO_KEYS, struct.pack("<8H", 1, 1, 0, 1, las.MODEL, 0, 1, las.GEOGRAPHIC), "degrees of longitude"),
    (las.GEO_KEYS, struct.pack("<8H", 1, 1, 0, 1, las.UNIT_OF_EASTING, 0, 1, 9003), "coordinates are US survey feet"),
    (las.GEO_KEYS, struct.pack("<8H", 1, 1, 0, 1, las.UNIT_OF_ELEVATION, 0, 1, 9002), "elevations are feet"),
    (las.WKT, b'PROJCS["x",GEOGCS["y"],UNIT["US survey foot",0.3048006096]]', "unit is the US survey foot"),
    (las.GEO_KEYS, struct.pack("<8H", 1, 1, 0, 1, las.MODEL, 0, 1, las.GEOCENTRIC), "coordinates are geocentric"),
    (las.GEO_KEYS, struct.pack("<8H", 1, 1, 0, 1, las.PROJECTION, 0, 1, 2227), "coordinates are feet (EPSG 2227)"),
    (las.GEO_KEYS, struct.pack("<8H", 1, 1, 0, 1, las.VERTICAL, 0, 1, 6360), "elevations are feet (EPSG 6360)"),
    (las.WKT, b'PROJCS["x",GEOGCS["y"],UNIT["unknown",0.3048006]]', "unit is the unknown"),
    (las.WKT, b'GEOGCS["y",UNIT["degree",0.0174533]]', "degrees of longitude"),
    (las.WKT, b'COMPD_CS["z",GEOGCS["y",UNIT["degree",0.0174533]],VERT_CS["h",UNIT["metre",1]]]', "degrees of long")])
def test_a_las_in_another_unit_is_refused(tmp_path, kind, data, said):
    assert said in fault(las_file(tmp_path, record=las_record(kind, data)))


def test_a_las_in_metres_is_read(tmp_path):
    for record in ((las.GEO_KEYS, struct.pack("<8H", 1, 1, 0, 1, las.UNIT_OF_EASTING, 0, 1, 9001)),
                   (las.GEO_KEYS, struct.pack("<8H", 1, 1, 0, 1, las.PROJECTION, 0, 1, 26910)),
                   (las.WKT, b'PROJCS["x",GEOGCS["y",UNIT["degree",0.0174533]],UNIT["metre",1]]')):
        assert len(read(las_file(tmp_path, record=las_record(*record)))) == len(POINTS)


def test_broken_las(tmp_path):
    assert f"ends after {len(POINTS) - 1} of its {len(POINTS)} points" in fault(las_file(tmp_path, cut=9))
    file = las_file(tmp_path)
    whole = file.read_bytes()
    file.write_bytes(whole[:104] + b"\x83" + whole[105:])
    assert "is compressed (LAZ); unpack it: laszip" in fault(file)
    file.write_bytes(whole[:104] + b"\x63" + whole[105:])
    assert "has the format" in fault(file) or "have the format 99" in fault(file)
    file.write_bytes(whole[:100])
    assert "ends within its header" in fault(file)
    file.write_bytes(whole[:131] + bytes(24) + whole[155:])
    assert "has a broken header" in fault(file)


def test_a_site_turns_and_shifts_in_double_precision():
    world = scanned_face.scene(2000)
    np.testing.assert_allclose(Site(scanned_face.ORIGIN, scanned_face.AZIMUTH).to_world(POINTS), world, atol=1e-8)
    np.testing.assert_allclose(Site().to_world(world), world, atol=1e-12)
    north = Site((100, 200, 10), 0).to_world([[97, 205, 11]])  # 5 m ahead, 3 m to the west: left
    np.testing.assert_allclose(north, [[5, 3, 1]], atol=1e-12)
