"""What one unit of an effect does to the features, and how well a few runs tell it.

Runs at two strengths use seeds of the baseline. The rock forgets its seed from pass to pass: how much of the
plain run's deviation the run with the effect keeps is found pass by pass, and so much of it is taken off (a
control variate). A line through zero is fitted to the rest. A handful of chaotic runs leaves more noise than
signal in 150 cells; the line is therefore shrunk, with its remaining covariance kept and used wherever the
signature is.
"""
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from .shrink import shrink

# Assumed: an effect in the mine differs from the catalogue's model of it by so much in a whole block (one
# phase and channel, all passes alike), and by so much in a single cell.
BLOCK_ERROR, CELL_ERROR = 0.25, 0.05
CHAOTIC = 0.01  # of the prediction's variance: cells whose seeds' share is smaller do not tell of chaos


@dataclass(frozen=True)
class Signature:
    effect: object
    g: np.ndarray        # (n,) per unit strength
    spread: np.ndarray   # (n, n) covariance of g, per unit strength squared

    @property
    def name(self):
        return self.effect.name

    def part(self, at):
        """The same over some of the cells."""
        return Signature(self.effect, self.g[at], self.spread[np.ix_(at, at)])


def fit_signature(effect, baseline, strengths, seed_index, values, same_rock=False):
    """From runs (J, n) at `strengths` (J,), each paired with baseline run seed_index (J,); None: with none.

    `same_rock`: the rock's motion is the plain run's own (an effect observed or replayed).
    """
    s = np.asarray(strengths, float)
    pairs = np.array([baseline.mean if k is None else baseline.values[k] for k in seed_index])
    g, error = (_exact if same_rock else _chaotic)(s, values, pairs, baseline)
    scale = np.sqrt(error)
    g, spread = shrink(g, baseline.seed * np.outer(scale, scale), baseline, abs(effect.reference()))
    if effect.kind != "observation":
        spread = spread + _shape_error(g, baseline)
    return Signature(effect, g, spread)


def _exact(s, values, pairs, baseline):
    """Slope (n,) through zero of runs on the same rock, and its variance in variances of a run: what the
    median cell is off the line."""
    moves, seed = _moves(baseline), np.diag(baseline.seed)
    difference = values - pairs
    g = s @ difference / (s @ s)
    off = 0.0
    if moves.any() and len(s) > 1:
        ratio = ((difference - np.outer(s, g))[:, moves] ** 2).sum(axis=0) / seed[moves]
        off = float(np.median(ratio) / chi2.median(len(s) - 1))
    return g, np.full(len(g), off / (s @ s))


def _chaotic(s, values, pairs, baseline):
    """The same of runs whose rock went its own way; part of it, the same in a pass, is the plain run's still."""
    moves, sd = _moves(baseline), np.sqrt(np.diag(baseline.seed))
    v, b = values - baseline.mean, pairs - baseline.mean
    off_line = np.eye(len(s)) - np.outer(s, s) / (s @ s)
    g, error = np.zeros(len(sd)), np.zeros(len(sd))
    for number in dict.fromkeys(c.pass_number for c in baseline.cells):
        at = np.array([c.pass_number == number for c in baseline.cells])
        told = at & moves
        v_left, b_left = (off_line @ x[:, told] / sd[told] for x in (v, b))
        kept = float(np.clip((v_left * b_left).sum() / max((b_left**2).sum(), 1e-300), 0.0, 1.0))
        # Never less than what the memory leaves open: two or three runs may lie on a line by chance.
        seen = ((v_left - kept * b_left) ** 2).mean() * len(s) / (len(s) - 1) if told.any() else 0.0
        g[at] = s @ (v - kept * b)[:, at] / (s @ s)
        error[at] = max(seen, 1 - kept**2) / (s @ s) + ((1 - kept) * s.sum() / (s @ s)) ** 2 / baseline.seeds
    return g, error


def _moves(baseline):
    return np.diag(baseline.seed) > CHAOTIC * baseline.sd**2


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
