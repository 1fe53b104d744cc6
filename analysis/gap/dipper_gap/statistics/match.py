"""Which effects, up to three at once, explain the residual; against `nothing` and `something unknown`."""
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from scipy.special import logsumexp

from ..readings.balance import BALANCE, HOIST
from ..readings.features import number
from . import evidence

# Prior shares: how often, before looking, one expects so many effects. Equal among sets of one size.
PRIOR = {"none": 0.45, "unknown": 0.10, 1: 0.35, 2: 0.08, 3: 0.02}
UNKNOWN_SIZES = (1.0, 2.0, 4.0)  # of a free discrepancy, in sd of the prediction
UNKNOWN_GAINS = (0.05, 0.15)     # of a force's reading, in parts
NAMED = 0.98  # cosine, in the metric of the errors, from which a gain is an effect of the catalogue: not unknown
INTERVAL = 0.90
GAIN_ERROR = 0.10  # assumed: of a response taken as a straight line through two strengths
SAMPLES = 4000


@dataclass(frozen=True)
class Match:
    fits: dict            # {(names): Fit}
    probability: dict     # {(names) or "none" or "unknown": posterior probability}
    log_weight: dict      # the same before normalising

    def presence(self, name):
        """Probability that the effect is there, alone or with others."""
        return self.any_of((name,))

    def any_of(self, names):
        """Probability that at least one of the effects is there."""
        total = sum(p for key, p in self.probability.items() if isinstance(key, tuple) and set(names) & set(key))
        return min(1.0, total)  # rounding

    def best_with(self, name):
        """The most probable set of effects that holds `name`."""
        return max((k for k in self.fits if name in k), key=lambda k: self.probability[k])

    def log_bayes(self, name, other):
        """log Bayes factor of sets with `name` and not `other`, over those with `other` and not `name`."""
        sides = []
        for yes, no in ((name, other), (other, name)):
            w = [w for k, w in self.log_weight.items() if isinstance(k, tuple) and yes in k and no not in k]
            sides.append(logsumexp(w))
        return float(sides[0] - sides[1])


def match(residual, covariance, signatures, baseline, largest=3, known=None):
    """All sets of up to `largest` effects. `covariance` holds the nuisances; `known` {(names): Fit} are not fitted
    again."""
    known = known or {}
    factor = evidence.prepare(covariance)
    fits, log_weight = {}, {}
    for size in range(1, min(largest, len(signatures)) + 1):
        sets = list(combinations(signatures, size))
        for chosen in sets:
            names = tuple(s.name for s in chosen)
            fits[names] = known.get(names) or evidence.fit(residual, covariance, chosen, factor)
            log_weight[names] = fits[names].log_evidence + np.log(PRIOR[size] / len(sets))
    log_weight["none"] = evidence.log_gaussian(residual, factor) + np.log(PRIOR["none"])
    log_weight["unknown"] = unknown_evidence(residual, covariance, baseline, signatures) + np.log(PRIOR["unknown"])
    weights = np.array(list(log_weight.values()))
    probability = np.exp(weights - weights.max())
    probability /= probability.sum()
    return Match(fits, dict(zip(log_weight, probability.tolist())), log_weight)


def unknown_evidence(residual, covariance, baseline, signatures=()):
    """log evidence of a free discrepancy: a mixture over where it is and how large.

    Everywhere and each pass anew; everywhere and alike in all passes; or alike in all passes but in one
    channel, one phase, or one block of both; or in one pass alone; or one force reads too much, by a part that
    stays or grows from pass to pass, unless one of the `signatures` is just that.
    """
    sd = baseline.sd
    key = number([c.key for c in baseline.cells])
    same = (key[:, None] == key).astype(float)
    masks = [np.ones(len(sd), bool)]
    for pick in (lambda c: c.channel, lambda c: c.phase, lambda c: (c.phase, c.channel)):
        labels = [pick(c) for c in baseline.cells]
        masks += [np.array([x == label for x in labels]) for label in dict.fromkeys(labels)]
    shapes = [np.diag(sd**2)] + [np.outer(sd * m, sd * m) * same for m in masks]
    for one in dict.fromkeys(c.pass_number for c in baseline.cells):
        shapes.append(np.diag(sd**2 * np.array([c.pass_number == one for c in baseline.cells])))
    sized = [size**2 * shape for shape in shapes for size in UNKNOWN_SIZES]
    sized += [gain**2 * np.outer(v, v) for v in gains(baseline).T for gain in UNKNOWN_GAINS
              if not any(_cosine(v, s.g, covariance) > NAMED for s in signatures)]
    logs = [evidence.log_gaussian(residual, evidence.prepare(covariance + extra)) for extra in sized]
    return float(logsumexp(logs) - np.log(len(logs)))


def _cosine(a, b, covariance):
    (aa, ab), (_, bb) = np.array([a, b]) @ np.linalg.solve(covariance, np.array([a, b]).T)
    return abs(ab) / np.sqrt(max(aa * bb, 1e-300))


def _reading(cell, channel, mean):
    """What of a cell's mean {cell: number} a force's channel shows; a balance is the mass less the hoist's load."""
    if cell.feature == BALANCE and channel == HOIST:
        return mean[cell] - mean.get(replace(cell, feature="mass"), mean[cell])
    return mean[cell] if cell.channel == channel else 0.0


def gains(baseline):
    """(n, 2 x forces): what a force's load cell shows that reads twice too much, in all passes or more and more."""
    late = np.array([c.pass_number for c in baseline.cells], float)
    late -= late.min()
    mean, out = dict(zip(baseline.cells, baseline.level)), []
    for channel in dict.fromkeys(c.channel for c in baseline.cells if c.channel.endswith("_force_kN")):
        reading = np.array([_reading(c, channel, mean) for c in baseline.cells])
        out += [reading, reading * late / late.max()] if late.any() else [reading]
    return np.array(out).reshape(-1, len(baseline.mean)).T


def strength(m, name, signatures, only=None, seed=0):
    """(low, median, high) of one effect's strength if it is there, over all sets that hold it (or one set `only`)."""
    by_name = {s.name: s for s in signatures}
    keys = [only] if only else [k for k in m.fits if name in k and m.probability[k] > 1e-4 * m.presence(name)]
    weight = np.array([m.probability[k] for k in keys])
    if not weight.sum() > 0:  # beaten beyond what a float holds: by itself, then
        keys, weight = [(name,)], np.ones(1)
    rng = np.random.default_rng(seed)
    counts = rng.multinomial(SAMPLES, weight / weight.sum())
    draws = np.concatenate([evidence.sample(m.fits[k], [by_name[n] for n in k], c, rng)[:, k.index(name)]
                            for k, c in zip(keys, counts) if c])
    e = by_name[name].effect
    relative = np.hypot(GAIN_ERROR, by_name[name].gain)
    draws = np.clip(draws * (1 + relative * rng.standard_normal(len(draws))), e.low, e.high)
    tail = (1 - INTERVAL) / 2
    return tuple(float(x) for x in np.quantile(draws, [tail, 0.5, 1 - tail]))


def interval(m, name, signatures, only=None, seed=0):
    """Central 90 % of the strength if the effect is there."""
    low, _, high = strength(m, name, signatures, only, seed)
    return [low, high]


def stability(m, name, covariance, signatures, copies=100, seed=0):
    """Share of data sets drawn from the best fit with `name`, less its other effects, in which `name` leads again."""
    rng = np.random.default_rng(seed)
    by_name = {s.name: s for s in signatures}
    truth = m.fits[m.best_with(name)]
    spread = covariance + sum(a * a * by_name[n].spread for a, n in zip(truth.best, truth.names))
    lower = np.linalg.cholesky(spread)
    drawn = truth.best[truth.names.index(name)] * by_name[name].g + rng.standard_normal((copies, len(spread))) @ lower.T
    singles = {n: m.fits[(n,)] for n in by_name}
    factors = {n: evidence.prepare(covariance + f.best[0] ** 2 * by_name[n].spread)
               for n, f in singles.items()}
    scores = np.array([_profile(drawn, factors[n], by_name[n]) for n in by_name])
    return float(np.mean(scores.argmax(axis=0) == list(by_name).index(name)))


def _profile(rows, factor, signature):
    """log likelihood at the best allowed strength, for many residuals at once."""
    e = signature.effect
    weighted = evidence.cho_solve(factor, signature.g, check_finite=False)
    strength = np.clip(rows @ weighted / max(signature.g @ weighted, 1e-300), e.low, e.high)
    left = rows - strength[:, None] * signature.g
    solved = evidence.cho_solve(factor, left.T, check_finite=False)
    return -0.5 * (left.T * solved).sum(axis=0) - np.log(np.diag(factor[0])).sum()
