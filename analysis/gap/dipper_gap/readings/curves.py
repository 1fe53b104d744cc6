"""Measured, before and after, signal by signal and pass by pass: what the report draws."""
from dataclasses import dataclass

import numpy as np

from .channels import MASS
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
    """Curves of the response signals; simulated ones are read at the measured times within the pass.

    `share`: variance of the mine's mean less the model's, in variances of a run. With a `reference` folder its trucks
    stand in the place of `before`, and `after` is what the runs make of them.
    """
    if not measured.responses():
        return []
    out = []
    trucks = measured.trucks()
    time, driven = trucks[0].time_s, [trucks[0].signals[name] for name in ("crowd_m", "swing_rad")]
    passes = [one_pass(trucks[0], number) for number in numbers]
    found = find_phases(time, *driven, [(p.t_start_s, p.t_end_s) for p in passes])
    for number, mine, phases in zip(numbers, passes, found):
        t = time[(time >= mine.t_start_s) & (time <= mine.t_end_s)] - mine.t_start_s
        phases = {name: (a - mine.t_start_s, b - mine.t_start_s) for name, (a, b) in phases.items()}
        for channel in measured.responses():
            seen = np.mean([read_signal(m, number, channel, t) for m in trucks], axis=0)
            runs = np.array([read_signal(m, number, channel, t) for m in before])
            new = np.mean([read_signal(m, number, channel, t) for m in after], axis=0) if after else None
            usual = runs.mean(axis=0)
            if reference:
                then = np.mean([read_signal(m, number, channel, t) for m in reference.trucks()], axis=0)
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


def read_signal(m, number, channel, t):
    return np.interp(t + one_pass(m, number).t_start_s, m.time_s, m.signals[channel])
