"""What is legal in profile.csv and hardly ever meant."""
import numpy as np

from .channels import FACE
from .face import before_and_after, face_of, truck_faces
from .suspect import stretches

LEAST_POINTS = 3          # of one height in a row,
DEEP_M = 1.0              # so much below the points on both sides: no face has that
APART_M = 1.5             # between heights at one x: more than a steep face has within half a metre
SLOPES_DEG = 15.0, 70.0   # blasted rock stands at 30 to 45
TOES_M = 3.0, 40.0        # from the swing axis: under the house, beyond any shovel's reach


def face_warnings(m):
    """Questions about the faces of a measured folder, a line each."""
    if not (m.profiles or m.left):
        return []
    found = [*_of_use(m), *_of_keys(m), *_of_heights(m), *_of_places(m), *_of_areas(m)]
    return [f"profile.csv: {words}" for words in found]


def _of_use(m):
    if FACE not in m.channels:
        yield (f"channels.yaml has no {FACE}, so no truck's faces are compared with the model's: {FACE}: {{unit: m, "
               "role: response, sigma, common_sigma} says how well they are known")
        return
    trucks = m.trucks()
    for number in dict.fromkeys(p.number for p in m.passes):
        seen = sum(all(before_and_after(m, t.passes[0].truck, number)) for t in trucks)
        if 0 < seen < len(trucks):
            yield (f"pass {number} is surveyed before and after for {seen} of {len(trucks)} trucks: its faces are not "
                   "compared, as all trucks need one")


def _of_keys(m):
    passes = {(p.truck, p.number) for p in m.passes}
    after_last = {(t, max(n for of, n in passes if of == t) + 1) for t, _ in passes}
    other = sorted(m.left.keys() - passes | m.profiles.keys() - passes - after_last)
    yield from _asked([(f"pass {n} of truck {t}", "is not in passes.csv") for t, n in other],
                      "are pass and truck numbered as there?")


def _of_heights(m):
    faces = [(_named(key, after), *xz) for after, of in enumerate((m.profiles, m.left)) for key, xz in of.items()]
    holes = [(face, f"z_m is {z[a]:g} in {b - a + 1} points from x {x[a]:g} to {x[b]:g} m, between others {DEEP_M:g} m "
              "higher and more") for face, x, z in faces for a, b in _holes(z)]
    yield from _asked(holes, "are these no readings?")
    apart = [(_named((truck, number), after), f"two heights {m:.3g} m apart at x {x:g} m")
             for (truck, number, after), (x, m) in m.apart.items() if m > APART_M]
    yield from _asked(apart, "is it one section? their mean is taken")


def _holes(z):
    """(first, last) of the stretches of one height far below the points on both sides."""
    for a, b in zip(*stretches(z)):
        if b - a + 1 >= LEAST_POINTS and 0 < a and b < len(z) - 1 and min(z[a - 1], z[b + 1]) >= z[a] + DEEP_M:
            yield a, b


def _of_places(m):
    shapes = {_named(key, 0): face_of(*xz) for key, xz in m.profiles.items()}
    steep = [(face, f"rises at {f['slope']:.3g} deg" if np.isfinite(f["slope"]) else "does not rise")
             for face, f in shapes.items() if not SLOPES_DEG[0] <= f["slope"] <= SLOPES_DEG[1]]
    yield from _asked(steep, "are x_m and z_m what they should be, and in m?")
    far = [(face, f"begins to rise at x {f['toe']:.3g} m") for face, f in shapes.items()
           if f["toe"] < TOES_M[0] or f["toe"] > TOES_M[1]]
    yield from _asked(far, "is x_m in m from the swing axis, and away from the shovel?")


def _of_areas(m):
    trucks = [t.passes[0].truck for t in m.trucks()]
    grown = [(f"truck {t}", f"its passes removed {area:.3g} m2 in the mean")
             for t, area in zip(trucks, truck_faces(m)["removed"]) if area < 0]
    yield from _asked(grown, "are before and after exchanged, or x_m and z_m?")


def _named(key, after):
    return f"the face {'after' if after else 'before'} pass {key[1]} of truck {key[0]}"


def _asked(faults, question):
    """One line for all that have a fault, [(who, what)]: the first, and how many more there are."""
    if faults:
        (who, what), *more = faults
        yield f"{who}: {what}{f', and {len(more)} more' if more else ''}: {question}"
