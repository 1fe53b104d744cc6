"""LAS 1.0 to 1.4 (ASPRS, LAS Specification 1.4-R15), not compressed. Debian has no library: docs/decisions.md."""
import struct

import numpy as np

PART = 1 << 18           # points
HEADER = 227             # bytes that every version has
NOISE = (7, 18)          # classes: low point, high noise
COMPRESSED = 0x80        # of a point's format, by LASzip
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
