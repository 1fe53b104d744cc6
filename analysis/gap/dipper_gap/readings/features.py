"""A few numbers for each pass, phase and channel: what a logger of 0.5 to 1 Hz can tell.

    mean   of the signal over the phase
    slope  of the straight line through it, per second
    peak   its largest size
    work   of a force along the way of its own drive, kJ
    mass   what the truck scale gained, one a pass (filed under `dump`)
    balance of that and the carried hoist force (balance.py)
    removed, slope, toe, crest  of the face that a survey shows, one a pass (face.py, filed under `dump`)
    duration  of the phase, s (channel `time`): prescribed, so it only shows that the motion differs

All but the peak and where a face stands are linear in the signal; a signal is taken as straight between readings.
"""
from dataclasses import dataclass

import numpy as np

from .face import before_and_after, binned, face_of, removed_area
from .channels import FACE, MASS
from .phases import find_phases

TIME = "time"
DRIVE = {"hoist_force_kN": ("hoist_m", -1.0), "crowd_force_kN": ("crowd_m", 1.0)}  # rope in lifts
FEATURES = ("mean", "slope", "peak", "work", "mass", "balance", "removed", "toe", "crest", "duration")


@dataclass(frozen=True)
class Cell:
    """Where a number of the feature vector comes from."""

    pass_number: int
    phase: str
    channel: str
    feature: str

    @property
    def key(self):
        return self.phase, self.channel, self.feature


def number(labels):
    """(n,) integers from 0, the same for equal labels, in order of their first appearance."""
    order = {label: k for k, label in enumerate(dict.fromkeys(labels))}
    return np.array([order[label] for label in labels])


@dataclass(frozen=True)
class _Span:
    """One phase of one pass: how to read a signal at its own points."""

    pass_index: int
    phase: str
    at: np.ndarray     # (T, M): readings to values at the phase's points
    time: np.ndarray   # (M,)

    def columns(self, name, values, driven):
        """[(feature, numbers)] of a signal whose readings are `values`, (..., T)."""
        v = values @ self.at
        t, weight = self.time, _trapezoid(self.time)
        length = t[-1] - t[0]
        out = [("mean", v @ weight / length)]
        if len(t) >= 3:
            centred = t - weight @ t / length
            out.append(("slope", v @ (weight * centred) / (weight @ centred**2)))
        out.append(("peak", np.abs(v).max(axis=-1)))
        if name in DRIVE:
            way, sign = DRIVE[name]
            steps = np.diff(driven[way] @ self.at)
            out.append(("work", sign * (0.5 * (v[..., 1:] + v[..., :-1]) * steps).sum(axis=-1)))
        return out


def _trapezoid(t):
    w = np.zeros(len(t))
    w[:-1] += 0.5 * np.diff(t)
    w[1:] += 0.5 * np.diff(t)
    return w


def _reading(time, points):
    """(T, M) matrix that interpolates readings at `time` to `points`."""
    k = np.clip(np.searchsorted(time, points, side="right") - 1, 0, len(time) - 2)
    f = np.clip((points - time[k]) / (time[k + 1] - time[k]), 0.0, 1.0)
    at = np.zeros((len(time), len(points)))
    at[k, np.arange(len(points))] = 1.0 - f
    at[k + 1, np.arange(len(points))] += f
    return at


class FeatureMap:
    """From the signals of one folder to its features; built once, used on many noisy copies of them."""

    def __init__(self, measured, pass_numbers, phases=None):
        """`phases`, [{phase: (start, end)}] a pass, in place of those that the driven signals show."""
        self.measured = measured
        by_number = {p.number: p for p in measured.passes}
        self.passes = [by_number[n] for n in pass_numbers]
        self.responses = measured.responses()
        self._spans, self.phases = [], []
        self.durations = []
        if measured.signals:
            driven = (measured.signals["crowd_m"], measured.signals["swing_rad"])
            spans = [(p.t_start_s, p.t_end_s) for p in self.passes]
            self.phases = phases or find_phases(measured.time_s, *driven, spans)
            for index, found in enumerate(self.phases):
                self._add_pass(index, found)
        self.faces = self._faces() if FACE in measured.channels else {}
        self.own = dict(self._columns(measured.signals, self.masses(), self.faces, measured.signals))  # {cell: number}
        self.cells = list(self.own)

    def _faces(self):
        """{(pass index, after): (x, z)} in steps, of the passes that are surveyed before and after."""
        out = {}
        for i, p in enumerate(self.passes):
            both = before_and_after(self.measured, p.truck, p.number)
            if all(both) and np.isfinite(list(face_of(*binned(both[0])).values())).all():
                out.update({(i, k): binned(face) for k, face in enumerate(both)})
        return out

    def masses(self):
        return np.array([p.truck_mass_t for p in self.passes])

    def _add_pass(self, index, phases):
        m = self.measured
        self.durations.append({phase: b - a for phase, (a, b) in phases.items()})
        for phase, (a, b) in phases.items():
            inner = m.time_s[(m.time_s > a) & (m.time_s < b)]
            points = np.concatenate([[a], inner, [b]])
            self._spans.append(_Span(index, phase, _reading(m.time_s, points), points))

    def _columns(self, signals, masses, faces, driven):
        out = []
        for span in self._spans:
            number = self.passes[span.pass_index].number
            for name in self.responses:
                for feature, v in span.columns(name, signals[name], driven):
                    out.append((Cell(number, span.phase, name, feature), v))
            length = span.time[-1] - span.time[0]
            out.append((Cell(number, span.phase, TIME, "duration"), length))
        if MASS in self.measured.channels:
            for i, p in enumerate(self.passes):
                out.append((Cell(p.number, "dump", MASS, "mass"), masses[..., i]))
        for i, p in enumerate(self.passes):
            if (i, 0) in faces:
                out += [(Cell(p.number, "dump", FACE, f), v) for f, v in _of_faces(faces[i, 0], faces[i, 1])]
        return out

    def __call__(self, signals, masses, faces=None, driven=None):
        """Features of copies of this folder: signals {name: (B, T)}, masses (B, P), and of `faces` heights z (B, X) and
        `driven` signals, or its own -> (B, n)."""
        out = np.empty((len(masses), len(self.cells)))
        faces, driven = self.faces if faces is None else faces, driven or self.measured.signals
        for i, (_, v) in enumerate(self._columns(signals, masses, faces, driven)):
            out[:, i] = v
        return out


def _of_faces(before, after):
    """[(feature, numbers)] of a face (x, z) and what a pass left of it; z (X,) or copies (B, X)."""
    (x, z), (x_after, z_after) = before, after
    if np.ndim(z) > 1:
        rows = [_of_faces((x, a), (x_after, b)) for a, b in zip(z, z_after)]
        return [(column[0][0], np.array([v for _, v in column])) for column in zip(*rows)]
    stands = face_of(x, z)
    return [("removed", removed_area(before, after)), *((f, stands[f]) for f in ("slope", "toe", "crest"))]
