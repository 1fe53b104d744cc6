"""Measured, before and after, signal by signal and pass by pass: what the report draws."""
from dataclasses import dataclass

import numpy as np

from .channels import MASS
from .lag import best_lag_s
from .phases import find_phases


@dataclass(frozen=True)
class Curve:
    pass_number: int
    held_out: bool
    channel: str
    time_s: np.ndarray     # since the pass began
    measured: np.ndarray   # mean over trucks, at the first one's readings
    before: np.ndarray     # mean over runs, or over the reference's trucks
    spread: np.ndarray     # sd, by the seeds, of measured less before
    after: np.ndarray      # None when nothing was added
    phases: dict           # {phase: (from, to)} in time_s


@dataclass(frozen=True)
class Mass:
    pass_number: int
    held_out: bool
    measured: float        # mean over trucks
    before: float
    spread: float
    after: float           # None when nothing was added


def curves(measured, before, after, numbers, held, share, reference=None):
    """Curves of the response signals, all read where the first truck's motion is at its readings.

    `share`: variance of the mine's mean less the model's, in variances of a run. With a `reference` folder its trucks
    stand in the place of `before`, and `after` is what the runs make of them.
    """
    if not measured.responses():
        return []
    out = []
    trucks, earlier = measured.trucks(), reference.trucks() if reference else ()
    time, driven = trucks[0].time_s, [trucks[0].signals[name] for name in ("crowd_m", "swing_rad")]
    passes = [one_pass(trucks[0], number) for number in numbers]
    found = find_phases(time, *driven, [(p.t_start_s, p.t_end_s) for p in passes])
    for number, mine, phases in zip(numbers, passes, found):
        moments = SameMoments(trucks[0], number)
        phases = {name: (a - mine.t_start_s, b - mine.t_start_s) for name, (a, b) in phases.items()}
        for channel in measured.responses():
            seen, runs = moments.read(trucks, channel).mean(axis=0), moments.read(before, channel)
            new = moments.read(after, channel).mean(axis=0) if after else None
            usual = runs.mean(axis=0)
            if reference:
                then = moments.read(earlier, channel).mean(axis=0)
                usual, new = then, None if new is None else new + then - usual
            out.append(Curve(number, number in held, channel, moments.time_s, seen, usual,
                             runs.std(axis=0, ddof=1) * np.sqrt(share), new, phases))
    return out


def masses(measured, before, after, numbers, held, share, reference=None):
    if MASS not in measured.channels:
        return []
    out = []
    for number in numbers:
        mine, usual = _mass(measured.trucks(), number), _mass(before, number)
        new = _mass(after, number) if after else None
        if reference:
            then = _mass(reference.trucks(), number)
            usual, new = then, None if new is None else new + then - usual
        spread = np.std([one_pass(m, number).truck_mass_t for m in before], ddof=1) * np.sqrt(share)
        out.append(Mass(number, number in held, mine, usual, float(spread), new))
    return out


def _mass(folders, number):
    return float(np.mean([one_pass(m, number).truck_mass_t for m in folders]))


def one_pass(m, number):
    return next(p for p in m.passes if p.number == number)


class SameMoments:
    """Reads folders at the moments of the motion at which a first one is read in a pass: passes may begin at another
    moment of the cycle. A folder's lag is looked for once."""

    def __init__(self, first, number):
        p = one_pass(first, number)
        self.number = number
        self.inside = (first.time_s >= p.t_start_s) & (first.time_s <= p.t_end_s)  # (all readings,)
        self.time_s = first.time_s[self.inside] - p.t_start_s                       # (T,) since the pass began
        self._crowd = first.signals["crowd_m"][self.inside]
        self._known = {}  # by the folder's identity; the folder itself, too, so that it is not another's

    def read(self, folders, channel):
        """(folders, T) of a channel."""
        return np.array([np.interp(self._times(m), m.time_s, m.signals[channel]) for m in folders])

    def _times(self, m):
        if id(m) not in self._known:
            at, crowd = self.time_s + one_pass(m, self.number).t_start_s, m.signals["crowd_m"]
            lag = best_lag_s(lambda lag: ((np.interp(at + lag, m.time_s, crowd) - self._crowd) ** 2).sum())
            self._known[id(m)] = m, at + lag
        return self._known[id(m)][1]
