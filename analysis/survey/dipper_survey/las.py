"""LAS 1.0 to 1.4 (ASPRS, LAS Specification 1.4-R15), not compressed. Debian has no library: docs/decisions.md."""
import re
import struct

import numpy as np

PART = 1 << 18           # points
HEADER = 227             # bytes that every version has
NOISE = (7, 18)          # classes: low point, high noise
COMPRESSED = 0x80        # of a point's format, by LASzip
# GeoTIFF 1.0, section 6.3: keys of a projection, and codes that are not metres.
GEO_KEYS, GEO_TEXTS, MODEL, UNIT_OF_EASTING, UNIT_OF_ELEVATION = 34735, 34737, 1024, 3076, 4099
PROJECTION, VERTICAL = 3072, 4096
GEOGRAPHIC, GEOCENTRIC = 2, 3
FEET = {9002: "feet", 9003: "US survey feet", 9005: "feet", 9006: "feet"}
PROJECTIONS_IN_FEET = range(2222, 2290)    # EPSG: NAD83, the states' planes in feet
VERTICAL_IN_FEET = {5702, 6360, 8228}      # EPSG: NGVD29, NAVD88 (US survey feet), NAVD88 (feet)
FOOT_IN_TEXT = re.compile(r"ftUS|US ?ft|\((?:us[ -]?)?ft\)|foot|feet", re.IGNORECASE)
WKT = 2112
UNIT_IN_WKT = re.compile(r'UNIT\["([^"]*)",\s*([\d.eE+-]+)')
FOOT_m = (0.3047, 0.3049)
VLR = 54                 # bytes of a record's header
SHORTEST = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)  # bytes of a point, by its format


def open_las(path, found):
    """(parts, kind, notes) of cloud.Cloud; None after a finding."""
    size = path.stat().st_size
    with open(path, "rb") as file:
        head = file.read(375)

    def fault(wrong, right):
        found.add(path, 0, "LAS", wrong, right)

    if len(head) < HEADER:
        return fault(f"ends within its header, after {len(head)} bytes", "a whole file")
    version = f"{head[24]}.{head[25]}"
    form = head[104]
    if form & COMPRESSED:
        return fault("is compressed (LAZ)", "unpack it: laszip -i CLOUD.laz -o CLOUD.las, or export it as LAS")
    if form >= len(SHORTEST):
        return fault(f"points have the format {form}", f"0 to {len(SHORTEST) - 1}, as LAS 1.0 to 1.4 have")
    begin, = struct.unpack_from("<I", head, 96)
    length, count = struct.unpack_from("<HI", head, 105)
    if version >= "1.4" and len(head) >= 255:
        count = struct.unpack_from("<Q", head, 247)[0] or count
    scale, offset = np.frombuffer(head, "<f8", 6, 131).reshape(2, 3)
    if length < SHORTEST[form] or begin < HEADER or not (np.isfinite([scale, offset]).all() and (scale > 0).all()):
        return fault(f"has a broken header: points of {length} bytes from byte {begin}, scales {scale.tolist()}",
                     "a sound file")
    if begin + count * length > size:
        return fault(f"ends after {max(0, size - begin) // length} of its {count} points", "a whole file")
    if count == 0:
        return fault("has no points", "a cloud")
    if other := _other_unit(path, head):
        return fault(f"says that its {other}", "coordinates in metres, in the mine's grid: convert them")
    flags = 15 if form < 6 else 16
    layout = np.dtype({"names": ["xyz", "flags", "class"], "formats": ["3<i4", "u1", "u1"],
                       "offsets": [0, 15, flags], "itemsize": length})

    def parts():
        with open(path, "rb") as points:
            points.seek(begin)
            for at in range(0, count, PART):
                rows = np.fromfile(points, layout, min(PART, count - at))
                withheld = rows["flags"] & (0x80 if form < 6 else 0x04)
                classes = rows["class"] & (0x1F if form < 6 else 0xFF)
                good = (withheld == 0) & ~np.isin(classes, NOISE)
                yield rows["xyz"][good] * scale + offset

    return parts, f"LAS {version}", ("points that the file calls withheld or noise are left out",)


def _other_unit(path, head):
    """What the records after the header say of coordinates that are not metres; None where nothing does."""
    at, = struct.unpack_from("<H", head, 94)
    records, = struct.unpack_from("<I", head, 100)
    keys, texts, wkt = {}, "", ""
    with open(path, "rb") as file:
        for _ in range(records):
            file.seek(at)
            record = file.read(VLR)
            if len(record) < VLR:
                break
            kind, length = struct.unpack_from("<HH", record, 18)
            data = file.read(length)
            if kind == GEO_KEYS:
                keys = {key: value for key, place, _, value in struct.iter_unpack("<4H", data[8:len(data) // 8 * 8])
                        if place == 0}
            elif kind == GEO_TEXTS:
                texts = data.decode("latin-1")
            elif kind == WKT:
                wkt = data.decode("latin-1")
            at += VLR + length
    projected = "PROJCS[" in wkt or "PROJCRS[" in wkt
    if keys.get(MODEL) == GEOCENTRIC or "GEOCCS[" in wkt:
        return "coordinates are geocentric"
    if keys.get(MODEL) == GEOGRAPHIC or not projected and re.search("GEOGCS|GEOGCRS|GEODCRS", wkt):
        return "coordinates are degrees of longitude and latitude"
    for key, what in ((UNIT_OF_EASTING, "coordinates"), (UNIT_OF_ELEVATION, "elevations")):
        if keys.get(key) in FEET:
            return f"{what} are {FEET[keys[key]]}"
    if keys.get(PROJECTION) in PROJECTIONS_IN_FEET and UNIT_OF_EASTING not in keys:
        return f"coordinates are feet (EPSG {keys[PROJECTION]})"
    if keys.get(VERTICAL) in VERTICAL_IN_FEET and UNIT_OF_ELEVATION not in keys:
        return f"elevations are feet (EPSG {keys[VERTICAL]})"
    if keys and UNIT_OF_EASTING not in keys and (foot := FOOT_IN_TEXT.search(texts)):
        return f"projection speaks of feet ('{foot[0]}')"
    for name, size in UNIT_IN_WKT.findall(wkt):
        if FOOT_m[0] < float(size) < FOOT_m[1]:
            return f"unit is the {name or 'foot'}"
    return None
