"""Truck by truck, since the reference or over the measured ones: how strong what was found is, and when it changed."""
from dataclasses import dataclass

import numpy as np

from dipper_run.csv_text import stamp_text

from .statistics.trend import Trend, find_trend, weights

CHANGES_SD = 3.0  # of a change among the measured trucks, from which it is reported where no reference says when
LEAST_SIDE = 2  # trucks on each side of a change that has no name: each is left out in turn
ROUNDS = 3


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


def history(model, prediction, names, training, measured, before):
    """History of what was found: `names` of the effects, the first leads; without names, of the gap as the training
    passes' cells `training` show it, each truck along what the others say has changed.
    """
    b, reference = prediction.baseline, prediction.baseline.reference
    now = model.of_mine(measured) - reference.shift - b.mean
    rows, first = np.vstack([reference.rows, now]), reference.trucks
    owns = [reference.own] * first + [b.own] * len(now)
    # The model's scatter, not the trucks' own: a change among the measured ones is in theirs, and would hide itself.
    one = b.own + b.seed

    def seen(along):
        strength = np.array([w @ row for w, row in zip(along, rows)])
        variance = np.array([w @ (own + b.seed) @ w for w, own in zip(along, owns)])
        drift = float(((reference.drift @ along[-1]) ** 2).sum())
        return strength, variance, find_trend(strength, first, variance, drift)

    if names:
        by_name = {s.name: s.g for s in prediction.signatures}
        found = seen([weights(np.column_stack([by_name[n] for n in names]), one)] * len(rows))
    elif len(now) < LEAST_SIDE or first < LEAST_SIDE:
        return None
    else:
        began = first
        for _ in range(ROUNDS):  # where it began says which trucks show it, and they say where it began
            found = seen(_along_the_others(rows, began, training, one))
            if not found[2] or not LEAST_SIDE <= found[2].began <= len(rows) - LEAST_SIDE:
                break
            began = found[2].began
    strength, variance, trend = found
    both = [("reference", t) for t in before.trucks()] + [("measured", t) for t in measured.trucks()]
    times = _times([t.passes[0].t_start_s for _, t in both])
    return History(names[0] if names else None,
                   tuple(Truck(period, t.passes[0].truck, time, float(a), float(np.sqrt(v)))
                         for (period, t), time, a, v in zip(both, times, strength, variance)), trend)


def within_the_shift(model, prediction, names, measured):
    """History of the effects `names` over the measured trucks alone, where the first of them changes from truck to
    truck by more than CHANGES_SD; None where it does not, or there are too few trucks."""
    b = prediction.baseline
    rows, one = model.of_mine(measured) - b.mean, b.own + b.seed
    by_name = {s.name: s.g for s in prediction.signatures}
    w = weights(np.column_stack([by_name[n] for n in names]), one)
    strength, variance = rows @ w, np.full(len(rows), w @ one @ w)
    trend = find_trend(strength, 0, variance, float(((b.common @ w) ** 2).sum()))
    if trend is None or abs(trend.size) < CHANGES_SD * trend.size_sd:
        return None
    trucks = measured.trucks()
    times = _times([t.passes[0].t_start_s for t in trucks])
    return History(names[0], tuple(Truck("measured", t.passes[0].truck, time, float(a), float(np.sqrt(v)))
                                   for t, time, a, v in zip(trucks, times, strength, variance)), trend)


def _along_the_others(rows, began, training, one):
    """Weights for each truck of `rows` (K, n) along what the others, less it, have changed by after `began` of them."""
    since, out, block = np.arange(len(rows)) >= began, [], np.ix_(training, training)
    for k in range(len(rows)):
        others = np.arange(len(rows)) != k
        change = rows[since & others].mean(axis=0) - rows[~since & others].mean(axis=0)
        full = np.zeros(len(change))
        full[training] = weights(change[training][:, None], one[block])
        out.append(full)
    return out


def _times(starts):
    """Each start as text; None for all where they do not rise from folder to folder."""
    if any(b <= a for a, b in zip(starts, starts[1:])):
        return [None] * len(starts)
    return [stamp_text(t) for t in starts]
