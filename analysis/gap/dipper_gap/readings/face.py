"""The face as a survey shows it: what each pass removed, and where the face stands.

profile.csv holds the face in the plane of the dig before each pass, and after it: marked so, or as what the next pass
finds (P + 1 after the last pass P). Heights are linear between points. With the lowest and highest point of a face at
heights b and b + h,

    toe      x at which it first rises above b + 0.1 h, coming from the shovel
    crest    x at which it first rises above b + 0.9 h
    slope    of the straight line between the two
    removed  area between a face and the next one, where both are surveyed, m2 (m3 per metre of width)
    t_a_m2   what the truck got over that area: bulk density in place, per metre of width
"""
from dataclasses import dataclass

import numpy as np
from scipy.stats import ttest_ind_from_stats

LOW, HIGH = 0.1, 0.9
LEAST_POINTS = 5
BIN_M = 0.5  # sigma of face_m is that of a height over so much of the section
KINDS = {"slope": "deg", "toe": "m", "crest": "m", "removed": "m2", "t_a_m2": "t/m2"}
CHANGED_P = 0.01  # family-wise: the faces of two periods differ


@dataclass(frozen=True)
class FaceChange:
    kind: str      # of KINDS
    unit: str
    before: float  # mean over trucks
    now: float
    p: float       # of so large a difference by the trucks' own scatter (Welch), adjusted for all kinds (Holm)


def face_of(x, z):
    """{toe, crest, slope} of points with x rising; nan where the face does not rise."""
    bottom, height = z.min(), np.ptp(z)
    toe, crest = (_first_above(x, z, bottom + share * height) for share in (LOW, HIGH))
    slope = np.degrees(np.arctan2((HIGH - LOW) * height, crest - toe)) if height > 0 else np.nan
    return {"toe": toe, "crest": crest, "slope": float(slope)}


def _first_above(x, z, level):
    k = int(np.argmax(z > level))
    if not z[k] > level:
        return float("nan")
    if k == 0:
        return float(x[0])
    return float(x[k - 1] + (level - z[k - 1]) / (z[k] - z[k - 1]) * (x[k] - x[k - 1]))


def removed_area(before, after):
    """m2 between two faces, each (x, z) with x rising, over what both show; nan where they share nothing."""
    low, high = max(before[0][0], after[0][0]), min(before[0][-1], after[0][-1])
    if high <= low:
        return float("nan")
    x = np.unique(np.concatenate([[low, high], *(f[0][(f[0] > low) & (f[0] < high)] for f in (before, after))]))
    return float(np.trapz(np.interp(x, *before) - np.interp(x, *after), x))


def before_and_after(measured, truck, number):
    """Faces (x, z) before a truck's pass and after it, in one plane; None for what was not surveyed."""
    after = measured.left.get((truck, number), measured.profiles.get((truck, number + 1)))
    return measured.profiles.get((truck, number)), after


def binned(face):
    """(x, z) by steps of BIN_M: the mean of the points in each; steps without points are left out."""
    x, z = face
    step = np.floor(x / BIN_M + 1e-9).astype(int)
    steps, at = np.unique(step, return_inverse=True)
    return (steps + 0.5) * BIN_M, np.bincount(at, z) / np.bincount(at)


def truck_faces(measured):
    """{kind: (trucks,)} of a folder with a profile.csv; each truck's mean over its passes, nan where it is not given.

    Toe, crest and slope are of the face before the truck's first pass.
    """
    out = {kind: [] for kind in KINDS}
    for truck in measured.trucks():
        number, passes = truck.passes[0].truck, truck.passes
        known = {p.number: before_and_after(measured, number, p.number) for p in passes}
        first = face_of(*known[passes[0].number][0]) if known[passes[0].number][0] else {}
        for kind in ("slope", "toe", "crest"):
            out[kind].append(first.get(kind, np.nan))
        areas = [(removed_area(*known[p.number]), p.truck_mass_t) for p in passes if all(known[p.number])]
        out["removed"].append(np.mean([a for a, _ in areas]) if areas else np.nan)
        whole = sum(a for a, _ in areas)
        out["t_a_m2"].append(sum(m for _, m in areas) / whole if whole > 0 else np.nan)
    return {kind: np.array(v, float) for kind, v in out.items()}


def compare_faces(measured, before):
    """(FaceChange, ...) of what both folders survey with two trucks or more."""
    if not (measured.profiles and before.profiles):
        return ()
    now, then = truck_faces(measured), truck_faces(before)
    rows = []
    for kind, unit in KINDS.items():
        a, b = (v[kind][np.isfinite(v[kind])] for v in (then, now))
        if len(a) > 1 and len(b) > 1 and (np.ptp(a) > 0 or np.ptp(b) > 0):
            p = ttest_ind_from_stats(b.mean(), b.std(ddof=1), len(b), a.mean(), a.std(ddof=1), len(a), equal_var=False)
            rows.append((kind, unit, float(a.mean()), float(b.mean()), float(p.pvalue)))
    adjusted, largest = {}, 0.0
    for k, row in enumerate(sorted(rows, key=lambda r: r[4])):  # Holm
        largest = max(largest, min(1.0, (len(rows) - k) * row[4]))
        adjusted[row[0]] = largest
    return tuple(FaceChange(*row[:4], adjusted[row[0]]) for row in rows)
