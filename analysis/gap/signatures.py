"""What one unit of an effect does to the features, and how well a few runs tell it.

Runs at two strengths use seeds of the baseline, so each is paired with the run without the effect, or where
the rock has forgotten its seed, compared with the mean of them. The differences are fitted by a line through
zero. A handful of chaotic runs leaves more noise than
signal in 150 cells; the fit is therefore shrunk (empirical Bayes), block by block, with its remaining
variance kept and used wherever the signature is.
"""
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from .baseline import to_grid

# Assumed: an effect in the mine differs from the catalogue's model of it by so much in a whole block (one
# phase and channel, all passes alike), and by so much in a single cell.
BLOCK_ERROR, CELL_ERROR = 0.25, 0.05
CHAOTIC = 0.01  # of the prediction's variance: cells whose seeds' share is smaller do not tell of chaos


@dataclass(frozen=True)
class Signature:
    effect: object
    g: np.ndarray        # (n,) per unit strength
    spread: np.ndarray   # (n, n) covariance of g, per unit strength squared
    chaos: float         # variance of a difference about the line, in variances of a run; 0: nothing random

    @property
    def name(self):
        return self.effect.name

    def part(self, at):
        """The same over some of the cells."""
        return Signature(self.effect, self.g[at], self.spread[np.ix_(at, at)], self.chaos)


def fit_signature(effect, baseline, strengths, seed_index, values):
    """From runs (J, n) at `strengths` (J,), each paired with baseline run seed_index (J,); None: with none
    of them, so with their mean."""
    s = np.asarray(strengths, float)
    variance = np.diag(baseline.seed)
    moves = variance > CHAOTIC * baseline.sd**2
    pairs = np.array([baseline.mean if k is None else baseline.values[k] for k in seed_index])
    g, chaos = _line(s, values - pairs, variance, moves)
    error = chaos * variance / (s @ s)
    if chaos > 1:  # nothing is left of the common seed: the mean of all seeds is the better partner
        g, chaos = _line(s, values - baseline.mean, variance, moves)
        chaos = max(chaos, 1.0)
        error = variance * (chaos / (s @ s) + (s.sum() / (s @ s)) ** 2 / baseline.seeds)
    g, error = _shrink(g, error, baseline, effect.reference())
    scale = np.sqrt(np.divide(error, variance, out=np.zeros_like(error), where=variance > 0))
    spread = baseline.seed * np.outer(scale, scale)
    if effect.kind != "observation":
        spread = spread + _shape_error(g, baseline)
    return Signature(effect, g, spread, chaos)


def _line(s, difference, variance, moves):
    """Slope through zero, and the variance of what it leaves in variances of a run (median over cells)."""
    g = s @ difference / (s @ s)
    if not moves.any() or len(s) < 2:
        return g, 0.0
    ratio = ((difference - np.outer(s, g))[:, moves] ** 2).sum(axis=0) / variance[moves]
    return g, float(np.median(ratio) / chi2.median(len(s) - 1))


def _shape_error(g, baseline):
    """Covariance of what the catalogue's own model of the effect gets wrong, beyond its strength.

    Each block's size errs by itself; what they have in common is the strength, and taken out.
    """
    block = [(c.phase, c.channel) for c in baseline.cells]
    labels = list(dict.fromkeys(block))
    member = np.array([[b == label for label in labels] for b in block], float)  # (n, blocks)
    weight = member.T @ (g / baseline.sd) ** 2
    weight = weight / max(weight.sum(), 1e-300)
    factor = (member - weight) * g[:, None] * BLOCK_ERROR
    return factor @ factor.T + np.diag((CELL_ERROR * g) ** 2)


def _shrink(g, error, baseline, reference):
    """Empirical Bayes in units of the prediction's sd: what all passes share, block by block of phase and
    channel, and what differs between passes, channel by channel. Returns estimate and variance left."""
    unit = baseline.sd / abs(reference)
    x, v = to_grid(g / unit, baseline.grid), to_grid(error / unit**2, baseline.grid)
    there = np.isfinite(x)
    count = there.sum(axis=0)
    shared = np.nansum(x, axis=0) / count
    shared_v = np.nansum(v, axis=0) / count**2
    differs, differs_v = x - shared, np.where(there, v * (1 - 1 / count), 0.0)
    keys = [None] * baseline.grid.shape[1]
    for i, c in enumerate(baseline.cells):
        keys[np.argwhere(baseline.grid == i)[0][1]] = c.key
    blocks = [(k[0], k[1]) for k in keys]
    channels = [k[1] for k in keys]
    shared, shared_left = _towards_zero(shared, shared_v, blocks, range(1))
    differs, differs_left = _towards_zero(differs, differs_v, channels, range(len(x)))
    left = np.where(there, shared_left + differs_left, np.nan)
    flat, at = baseline.grid.ravel(), baseline.grid.ravel() >= 0
    out, out_v = np.empty(len(g)), np.empty(len(g))
    out[flat[at]] = (shared + differs).ravel()[at]
    out_v[flat[at]] = left.ravel()[at]
    return out * unit, out_v * unit**2


def _towards_zero(x, v, labels, rows):
    """Normal means with a normal prior about 0 for each label, its variance by moments."""
    x, v = np.atleast_2d(x), np.atleast_2d(v)
    out, left = np.zeros_like(x), np.zeros_like(x)
    for label in dict.fromkeys(labels):
        cols = [j for j, other in enumerate(labels) if other == label]
        part, var = x[:, cols], v[:, cols]
        prior = max(0.0, float(np.nanmean(part**2 - var)))
        weight = prior / np.maximum(prior + var, 1e-300)
        out[:, cols], left[:, cols] = weight * part, weight * var
    return (out, left) if len(rows) > 1 else (out[0], left[0])
