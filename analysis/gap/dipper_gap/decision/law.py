"""A law for what the catalogue has no name for: a force that follows from how the machine moves.

The residual of each force, measured less usual (the model's mean, or the reference's), is taken reading by reading and
explained by a constant and few terms that the driven signals give. Terms are added greedily while they make the
training passes, each predicted from the others, likelier. Both the number of terms and how much they explain by chance
are judged by the same search on residuals in which there is no law: differences of the model's own runs, scaled to the
mine's scatter and read by its instruments. A law is told if fewer than ALARMS of those do as well, on the training
passes and then on those held out.
"""
from dataclasses import dataclass

import numpy as np

from ..readings.curves import one_pass, read_signal

ALARMS = 0.05
DRAWS = 99
MOST_TERMS = 3
LEAST_GAIN = 0.10     # of the weighted square that is left, for one more term
LEAST_EXPLAINED = 0.25  # of the residual's weighted square on the passes held out: less is no law
STANDS_M_S, STANDS_RAD_S = 0.05, 0.02  # speeds below which a drive counts as standing

WORDS = {  # how a term's coefficient a is told, in kN
    "hoist moves in": "{a:+.0f} kN while the ropes come in",
    "hoist moves out": "{a:+.0f} kN while the ropes run out",
    "crowd moves out": "{a:+.0f} kN while the crowd moves out",
    "crowd moves in": "{a:+.0f} kN while the crowd moves in",
    "swing moves": "{a:+.0f} kN while the house swings",
    "crowd direction": "{a:+.0f} kN as the crowd moves out, and {b:+.0f} kN as it moves in",
    "hoist direction": "{a:+.0f} kN as the ropes come in, and {b:+.0f} kN as they run out",
    "crowd speed": "{a:+.0f} kN per m/s of the crowd, out",
    "hoist speed": "{a:+.0f} kN per m/s of the ropes, in",
    "crowd extension": "{a:+.0f} kN per metre that the crowd is out",
    "hoist length": "{a:+.0f} kN per metre of rope",
    "load carried": "{a:+.0f} kN while a load is carried, from breakout to dump",
    "pass": "{a:+.0f} kN more with each pass",
}


@dataclass(frozen=True)
class Law:
    channel: str
    terms: tuple         # ((name of WORDS, kN), ...)
    p: float             # that differences of the model's own runs give as much on the training passes
    explained: float     # share of the residual's weighted square on the passes held out

    @property
    def words(self):
        return "; ".join(WORDS[name].format(a=a, b=-a) for name, a in self.terms)


@dataclass(frozen=True)
class _Readings:
    """One force at the first truck's readings within the passes, (M,)."""

    terms: np.ndarray     # (M, K)
    passes: np.ndarray    # (M,) numbers
    residual: np.ndarray  # (M,)
    chance: np.ndarray    # (R, M) of the model's runs less their mean
    sigma: float          # of one reading's mean over the trucks


def find_law(model, baseline, holdout, measured, before=None, seed=0):
    """The Law of the force it explains best; None where none does better than chance."""
    rng, best = np.random.default_rng(seed), None
    share = baseline.share(baseline.seeds)
    for channel in measured.responses():
        r = _readings(model, channel, measured, before)
        held = np.isin(r.passes, holdout)
        weight = 1.0 / (r.chance.var(axis=0, ddof=1) * share + r.sigma**2)
        gain, chosen, after = _search(r, r.residual, weight, held)
        by_chance = [_search(r, _no_law(r, share, rng), weight, held) for _ in range(DRAWS)]
        p = (1 + sum(g >= gain for g, _, _ in by_chance)) / (1.0 + DRAWS)
        confirmed = (1 + sum(a >= after for _, _, a in by_chance)) / (1.0 + DRAWS)
        sound = p <= ALARMS / len(measured.responses()) and confirmed <= ALARMS and after >= LEAST_EXPLAINED
        if chosen and sound and (not best or gain > best[0]):
            size = _fit(r.terms[~held][:, chosen], r.residual[~held], weight[~held])[1:]
            names = list(WORDS)
            best = gain, Law(channel, tuple((names[k], float(a)) for k, a in zip(chosen, size)), float(p), float(after))
    return best[1] if best else None


def _no_law(r, share, rng):
    """A residual by chance: one of the model's runs less the others', as large as the means differ, and the readings'
    own errors; a random mix of the runs has their covariance."""
    mix = rng.standard_normal(len(r.chance))
    mix -= mix.mean()
    made = np.sqrt(share / (len(mix) - 1)) * mix @ r.chance
    return made + r.sigma * rng.standard_normal(made.shape)


def _search(r, y, weight, held):
    """(gain, columns, share explained on the held-out passes) of the terms that predict the training passes best from
    one another; the gain is in the weighted square."""
    train, chosen = ~held, []
    left = _predicted(r.terms[train][:, []], y[train], weight[train], r.passes[train])
    first = left
    while len(chosen) < MOST_TERMS:
        trials = {k: _predicted(r.terms[train][:, [*chosen, k]], y[train], weight[train], r.passes[train])
                  for k in range(r.terms.shape[1]) if k not in chosen and np.ptp(r.terms[train][:, k]) > 0}
        k = min(trials, key=trials.get)
        if trials[k] > (1 - LEAST_GAIN) * left:
            break
        chosen, left = [*chosen, k], trials[k]
    if not chosen:
        return 0.0, [], 0.0
    plain, law = (_fit(r.terms[train][:, c], y[train], weight[train]) for c in ([], chosen))
    squares = [(weight[held] * (y[held] - b[0] - r.terms[held][:, c] @ b[1:]) ** 2).sum()
               for b, c in ((plain, []), (law, chosen))]
    return float(first - left), chosen, float(1 - squares[1] / squares[0])


def _predicted(x, y, weight, passes):
    """Weighted square of what each pass leaves when it is predicted from the others."""
    total = 0.0
    for one in np.unique(passes):
        at = passes == one
        others = ~at if (~at).any() else at  # a single training pass: by itself
        b = _fit(x[others], y[others], weight[others])
        total += (weight[at] * (y[at] - b[0] - x[at] @ b[1:]) ** 2).sum()
    return total


def _fit(x, y, weight):
    """Weighted least squares with a constant; the constant first."""
    root = np.sqrt(weight)
    return np.linalg.lstsq(np.column_stack([np.ones(len(y)), x]) * root[:, None], y * root, rcond=None)[0]


def _readings(model, channel, measured, before):
    first, usual = measured.trucks()[0], before.trucks() if before else None
    terms, passes, residual, chance = [], [], [], []
    for number, phases in zip(model.passes, model.vectors.durations):
        p = one_pass(first, number)
        inside = (first.time_s >= p.t_start_s) & (first.time_s <= p.t_end_s)
        t = first.time_s[inside] - p.t_start_s
        runs = np.array([read_signal(m, number, channel, t) for m in model.folders])
        seen = np.mean([read_signal(m, number, channel, t) for m in measured.trucks()], axis=0)
        then = np.mean([read_signal(m, number, channel, t) for m in usual], axis=0) if usual else runs.mean(axis=0)
        terms.append(_terms(first, inside, t, phases, number))
        passes += [number] * len(t)
        residual.append(seen - then)
        chance.append(runs - runs.mean(axis=0))
    trucks = len(measured.trucks())
    variance = measured.channels[channel].sigma**2 / trucks
    variance += before.channels[channel].sigma**2 / len(usual) if usual else 0.0
    return _Readings(np.vstack(terms), np.array(passes), np.concatenate(residual), np.hstack(chance),
                     float(np.sqrt(max(variance, 1e-12))))


def _terms(m, inside, t, phases, number):
    """(M, K) in the order of WORDS; ropes that come in have a hoist that falls."""
    hoist, crowd, swing = (m.signals[n] for n in ("hoist_m", "crowd_m", "swing_rad"))
    v_in, v_out, turn = (np.gradient(s, m.time_s)[inside] for s in (-hoist, crowd, swing))
    lifts, lowers, out, back = v_in > STANDS_M_S, v_in < -STANDS_M_S, v_out > STANDS_M_S, v_out < -STANDS_M_S
    ends = np.cumsum([0.0, *phases.values()])
    spans = dict(zip(phases, zip(ends, ends[1:])))
    loaded = (t >= spans["breakout"][0]) & (t < spans["dump"][0]) if {"breakout", "dump"} <= set(spans) else t < 0
    columns = (lifts, lowers, out, back, np.abs(turn) > STANDS_RAD_S, 1.0 * out - back, 1.0 * lifts - lowers,
               v_out, v_in, crowd[inside], hoist[inside], loaded, np.full(len(t), float(number)))
    return np.column_stack(columns).astype(float)
