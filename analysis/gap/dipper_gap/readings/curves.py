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
        inside = (time >= mine.t_start_s) & (time <= mine.t_end_s)
        t = time[inside] - mine.t_start_s
        phases = {name: (a - mine.t_start_s, b - mine.t_start_s) for name, (a, b) in phases.items()}
        at = {id(m): same_moments(m, number, t, driven[0][inside]) for m in (*trucks, *before, *after, *earlier)}
        for channel in measured.responses():
            def read(folders):
                return np.array([np.interp(at[id(m)], m.time_s, m.signals[channel]) for m in folders])

            seen, runs = read(trucks).mean(axis=0), read(before)
            new = read(after).mean(axis=0) if after else None
            usual = runs.mean(axis=0)
            if reference:
                then = read(earlier).mean(axis=0)
                usual, new = then, None if new is None else new + then - usual
            out.append(Curve(number, number in held, channel, t, seen, usual,
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


def same_moments(m, number, t, crowd):
    """Times of a folder at which its crowd in a pass is where `crowd`, (T,) m, says, of another folder `t`, (T,) s,
    since the pass began: passes may begin at another moment of the cycle."""
    at = t + one_pass(m, number).t_start_s
    return at + best_lag_s(lambda lag: ((np.interp(at + lag, m.time_s, m.signals["crowd_m"]) - crowd) ** 2).sum())
