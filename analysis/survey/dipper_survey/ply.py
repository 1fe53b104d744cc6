"""PLY, ascii and binary: the vertices' x, y and z."""
import io

import numpy as np

from dipper_run.findings import BadInput

PART = 1 << 18
TYPES = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
         "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
         "double": "f8", "float64": "f8"}
ORDERS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
LONGEST_HEADER = 1 << 16


class Broken(Exception):
    """(line, wrong, right)"""


def open_ply(path, found):
    """(parts, kind, notes) of cloud.Cloud; None after a finding."""
    try:
        order, elements, begin, lines = _header(path)
        before = elements[:[name for name, _, _ in elements].index("vertex")]
        _, count, properties = elements[len(before)]
        if any(p[1] is None for _, _, ps in [*before, elements[len(before)]] for p in ps):
            raise Broken(0, "has lists before or in its vertices", "vertices first, of numbers alone")
        missing = [n for n in "xyz" if n not in [name for name, _ in properties]]
        if missing:
            raise Broken(0, f"its vertices have no {', '.join(missing)}", "x, y and z")
        if count == 0:
            raise Broken(0, "has no vertices", "a cloud")
    except Broken as e:
        found.add(path, e.args[0], "PLY", *e.args[1:])
        return None
    if order is None:
        return lambda: _ascii_parts(path, begin, lines, before, count, properties), "PLY", ()
    layout = np.dtype([(f"{name} {i}", order + kind) for i, (name, kind) in enumerate(properties)])
    skipped = sum(n * np.dtype([(f"{i}", kind) for i, (_, kind) in enumerate(ps)]).itemsize for _, n, ps in before)
    names = [next(f for f in layout.names if f.split()[0] == n) for n in "xyz"]
    there = max(0, path.stat().st_size - begin - skipped) // layout.itemsize
    if there < count:
        found.add(path, 0, "PLY", f"ends after {there} of its {count} vertices", "a whole file")
        return None
    single = any(layout[n].itemsize == 4 and layout[n].kind == "f" for n in names)

    def parts():
        with open(path, "rb") as file:
            file.seek(begin + skipped)
            for at in range(0, count, PART):
                rows = np.fromfile(file, layout, min(PART, count - at))
                points = np.column_stack([rows[n] for n in names]).astype(float)
                if single:
                    _refuse_rounded(path, points)
                yield points

    return parts, "PLY", ()


def _header(path):
    """(byte order or None, [(name, count, [(property, type or None)])], where the data begin, lines of the header)"""
    with open(path, "rb") as file:
        head = file.read(LONGEST_HEADER)
    end = head.find(b"end_header")
    if end < 0:
        raise Broken(0, "has no end_header", "a PLY")
    # Old Macs end lines by CR alone; a CR LF is one line end.
    begin = end + len(b"end_header")
    begin += 2 if head[begin:begin + 2] == b"\r\n" else 1
    order, elements = "", []
    texts = head[:begin].decode("latin-1").replace("\r\n", "\n").replace("\r", "\n").split("\n")[:-1]
    for i, text in enumerate(texts, 1):
        word = text.split()
        try:
            if word[:1] == ["format"]:
                order = ORDERS[word[1]]
            elif word[:1] == ["element"]:
                elements.append((word[1].lower(), int(word[2]), []))
            elif word[:2] == ["property", "list"]:
                elements[-1][2].append((word[4], None))
            elif word[:1] == ["property"]:
                elements[-1][2].append((word[2].lower(), TYPES[word[1]]))
        except (IndexError, KeyError, ValueError) as e:
            raise Broken(i, f"is '{text[:60]}'", "a line of a PLY's header") from e
    if order == "" or not any(name == "vertex" for name, _, _ in elements):
        raise Broken(0, "has no format, or no element vertex", "a PLY of points")
    return order, elements, begin, len(texts)


def _ascii_parts(path, begin, lines, before, count, properties):
    columns = [[name for name, _ in properties].index(n) for n in "xyz"]
    with open(path, "rb") as file:
        file.seek(begin)
        text = io.TextIOWrapper(file, "latin-1")
        for _ in range(sum(n for _, n, _ in before)):
            text.readline()
            lines += 1
        for at in range(0, count, PART):
            want = min(PART, count - at)
            rows = [row for row in (text.readline() for _ in range(want)) if row.strip()]
            if len(rows) < want:
                raise BadInput([f"{path}: PLY: ends after {at + len(rows)} of its {count} vertices; a whole file"])
            try:
                points = np.loadtxt(rows, usecols=columns, ndmin=2, comments=None)
            except ValueError:
                i, row = next((i, r) for i, r in enumerate(rows) if not _sound(r, columns))
                raise BadInput([f"{path}:{lines + at + i + 1}: PLY: is '{row.strip()[:60]}'; the "
                                f"{len(properties)} numbers of a vertex"]) from None
            yield points


def _sound(row, columns):
    try:
        return [float(row.split()[c]) for c in columns] and True
    except (IndexError, ValueError):
        return False


def _refuse_rounded(path, points):
    """Of single precision, a northing of 7,443,210 m is rounded to half a metre."""
    largest = np.nanmax(np.abs(points[np.isfinite(points).all(axis=1)]), initial=0)
    step = float(np.spacing(np.float32(largest)))
    if step > 0.01:
        raise BadInput([f"{path}: PLY: coordinates up to {largest:.0f} m in single precision are rounded to {step:g} "
                        "m; export it in double precision (property double), or shifted to an origin nearby"])
