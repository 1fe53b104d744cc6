"""Truck by truck since the reference: how strong what was found is, and when it began."""
from dataclasses import dataclass

import numpy as np

from dipper_run.csv_text import stamp_text

from .statistics.trend import Trend, find_trend, weights


@dataclass(frozen=True)
class Truck:
    period: str       # reference | measured
    truck: int        # its number in that folder
    time: str         # of its first pass, as the folder tells it; None where the two folders' clocks do not follow
    strength: float   # of the effect, in its unit; of a gap without a name, in parts of the gap
    sd: float


@dataclass(frozen=True)
class History:
    effect: str       # None: the gap itself, which has no name
    trucks: tuple
    trend: Trend      # None where there are too few trucks


def history(model, prediction, names, y_training, measured, before):
    """History of what was found: `names` of the effects, the first leads; without names, of the gap as it is in
    `y_training` (n,), truck by truck along what the others show.
    """
    b, reference = prediction.baseline, prediction.baseline.reference
    now = model.of_mine(measured) - reference.shift - b.mean
    rows = np.vstack([reference.rows, now])
    seeds = b.mine
    owns = [reference.own] * len(reference.rows) + [b.own] * len(now)
    one = b.own + seeds
    if names:
        by_name = {s.name: s.g for s in prediction.signatures}
        along = [weights(np.column_stack([by_name[n] for n in names]), one)] * len(rows)
    else:
        along = _along_the_others(now, len(reference.rows), y_training, one)
        if along is None:
            return None
    strength = np.array([w @ row for w, row in zip(along, rows)])
    variance = np.array([w @ (own + seeds) @ w for w, own in zip(along, owns)])
    drift = float(((reference.drift @ along[-1]) ** 2).sum())
    told = [("reference", t) for t in before.trucks()] + [("measured", t) for t in measured.trucks()]
    times = _times([t.passes[0].t_start_s for _, t in told])
    return History(names[0] if names else None,
                   tuple(Truck(period, t.passes[0].truck, time, float(a), float(np.sqrt(v)))
                         for (period, t), time, a, v in zip(told, times, strength, variance)),
                   find_trend(strength, len(reference.rows), variance, drift))


def _along_the_others(now, before, training, one):
    """Weights for each truck from the gap that the other trucks show in the training passes' cells `training`."""
    if len(now) < 2:
        return None
    block, out = np.ix_(training, training), []
    whole = now.mean(axis=0)
    for gap in [whole] * before + [(whole * len(now) - row) / (len(now) - 1) for row in now]:
        full = np.zeros(len(whole))
        full[training] = weights(gap[training][:, None], one[block])
        out.append(full)
    return out


def _times(starts):
    """Each start as text; None for all where they do not rise from folder to folder."""
    if any(b <= a for a, b in zip(starts, starts[1:])):
        return [None] * len(starts)
    return [stamp_text(t) for t in starts]
