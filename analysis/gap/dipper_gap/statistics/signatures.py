"""What one unit of an effect does to the features, and how well a few runs tell it.

Runs at two strengths use seeds of the baseline. The rock forgets its seed from pass to pass, and a load that is
once in the dipper shows hardly anything of it: how much of the plain run's deviation the run with the effect
keeps is found for each dig and what follows it, and so much of it is taken off (a control variate). A line through
zero is fitted to the rest. A handful of chaotic runs leaves more noise than signal in 150 cells; the line is
therefore shrunk, with its remaining covariance kept and used wherever the signature is.
"""
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import chdtri

from .shrink import shrink

# Assumed: an effect in the mine differs from the catalogue's model of it by so much in a whole block (one
# phase and channel, all passes alike), and by so much in a single cell.
BLOCK_ERROR, CELL_ERROR = 0.25, 0.05
MOVES = 0.5  # share of a phase at rest below which its mean force tells the effect's size
BEFORE_BREAKOUT = ("approach", "penetrate", "fill")  # while the dipper fills
CHAOTIC = 0.01  # of the prediction's variance: cells whose seeds' share is smaller do not tell of chaos


@dataclass(frozen=True)
class Signature:
    effect: object
    g: np.ndarray        # (n,) per unit strength
    noise: np.ndarray    # (n, n) covariance of what few runs leave unknown of g, per unit strength squared
    wrong: np.ndarray    # (n, n) the same of what the catalogue's model of the effect gets wrong
    gain: float = 0.0    # sd, relative, of what it gets wrong in all cells alike: it is in the strength

    @property
    def name(self):
        return self.effect.name

    @property
    def spread(self):
        """(n, n) covariance of g, per unit strength squared."""
        return self.noise + self.wrong

    def part(self, at):
        """The same over some of the cells."""
        block = np.ix_(at, at)
        return replace(self, g=self.g[at], noise=self.noise[block], wrong=self.wrong[block])

    def inflated(self, factor):
        """The same where the seeds' covariance, known from few runs, promises too much by `factor`."""
        return replace(self, noise=self.noise * factor)


def fit_signature(effect, baseline, strengths, seed_index, values, same_rock=False):
    """From runs (J, n) at `strengths` (J,), each paired with baseline run seed_index (J,); None: with none.

    `same_rock`: the rock's motion is the plain run's own (an effect observed or replayed).
    """
    s = np.asarray(strengths, float)
    pairs = np.array([baseline.mean if k is None else baseline.values[k] for k in seed_index])
    if same_rock:
        g, error = _exact(s, values - pairs, baseline)
    else:
        g, error = _chaotic(s, values - baseline.mean, pairs - baseline.mean, baseline)
    scale = np.sqrt(error)
    g, noise = shrink(g, baseline.seed * np.outer(scale, scale), baseline, abs(effect.reference()))
    wrong, gain = _shape_error(g, baseline)
    if effect.affects == "machine":  # it acts with or against the motion
        wrong = wrong + np.diag(_rest_error(g, baseline) ** 2)
    return Signature(effect, g, noise, wrong, gain)


def _rest_error(g, baseline):
    """(n,) sd of what the effect may do to each cell while the drive stands still: anywhere between the force that it
    usually has, one way and the other."""
    out = np.zeros(len(g))
    if baseline.rest is None:
        return out
    for channel in dict.fromkeys(c.channel for c in baseline.cells):
        own = np.array([c.channel == channel for c in baseline.cells])
        moving = own & (baseline.rest < MOVES) & np.array([c.feature == "mean" for c in baseline.cells])
        usual = float(np.median(np.abs(g[moving]))) if moving.any() else 0.0
        out[own] = baseline.rest[own] * usual / np.sqrt(3.0)
    return out


def _exact(s, difference, baseline):
    """Slope (n,) through zero of runs on the same rock less the plain ones, and its variance in variances of a
    run: what the median cell it touches is off the line."""
    moves, seed = _moves(baseline) & (difference != 0).any(axis=0), np.diag(baseline.seed)
    g = s @ difference / (s @ s)
    off = 0.0
    if moves.any() and len(s) > 1:
        ratio = ((difference - np.outer(s, g))[:, moves] ** 2).sum(axis=0) / seed[moves]
        off = float(np.median(ratio) / chdtri(len(s) - 1, 0.5))
    return g, np.full(len(g), off / (s @ s))


def _chaotic(s, v, b, baseline):
    """The same of runs whose rock went its own way; v, b (J, n) are deviations from the baseline's mean, theirs
    and the plain run's, 0 where there is none."""
    paired = b.any(axis=1)
    g, error = np.zeros(len(baseline.mean)), np.zeros(len(baseline.mean))
    for at, kept, seen in _memory(s, v, b, baseline):
        left = max(seen, 1 - kept**2)  # two or three runs may lie on a line by chance
        g[at] = s @ (v - kept * b)[:, at] / (s @ s)
        error[at] = left / (s @ s) + (s @ (1 - kept * paired) / (s @ s)) ** 2 / baseline.seeds
    return g, error


def _memory(s, v, b, baseline):
    """Of each dig and what follows it: its cells, how much of the plain run's deviation b (J, n) is kept in v (J, n),
    and the variance of the rest about the line, in variances of a run."""
    moves, sd, off = _moves(baseline), np.sqrt(np.diag(baseline.seed)), _off_line(s)
    spans = [(c.pass_number, c.phase in BEFORE_BREAKOUT) for c in baseline.cells]
    for span in dict.fromkeys(spans):
        at = np.array([other == span for other in spans])
        at_moving = at & moves
        v_left, b_left = (off @ x[:, at_moving] / sd[at_moving] for x in (v, b))
        kept = float(np.clip((v_left * b_left).sum() / max((b_left**2).sum(), 1e-300), 0.0, 1.0))
        yield at, kept, float(((v_left - kept * b_left) ** 2).mean()) if at_moving.any() else 0.0


def _off_line(s):
    """(J - 1, J) orthonormal rows that see nothing of a line through zero."""
    return np.linalg.svd(s[None])[2][1:]


def deviations(strengths, seed_index, values, baseline):
    """(J - 1, n) what runs with an effect differ by from a line, scaled to a plain run's size: as the rock
    moves by chance, so more is known of that than the plain runs tell."""
    s = np.asarray(strengths, float)
    v, b = values - baseline.mean, baseline.values[list(seed_index)] - baseline.mean
    out = np.zeros((len(s) - 1, len(baseline.mean)))
    for at, kept, seen in _memory(s, v, b, baseline):
        if seen > 0:
            out[:, at] = _off_line(s) @ (v - kept * b)[:, at] / np.sqrt(seen)
    return out


def _moves(baseline):
    return np.diag(baseline.seed) > CHAOTIC * baseline.sd**2


def _shape_error(g, baseline):
    """Covariance of what the catalogue's own model of the effect gets wrong, beyond its strength, and sd of that.

    Each block's size errs by itself; what they have in common is in the strength, and its relative sd beside. Where a
    mine's earlier trucks differ from the model, what an effect does to them may differ by as large a share besides, by
    itself in each block or in all of them alike: a force that is a quarter less everywhere is a quarter less with the
    effect too.
    """
    block = [(c.phase, c.channel) for c in baseline.cells]
    labels = list(dict.fromkeys(block))
    member = np.array([[b == label for label in labels] for b in block], float)  # (n, blocks)
    weight = member.T @ (g / baseline.sd) ** 2
    weight = weight / max(weight.sum(), 1e-300)
    unlike = member.T @ baseline.unlike / member.sum(axis=0)  # (blocks,)
    factor = (member - weight) * g[:, None] * np.hypot(BLOCK_ERROR, unlike)
    gain = np.hypot(BLOCK_ERROR * np.sqrt((weight**2).sum()), weight @ unlike)
    return factor @ factor.T + np.diag((CELL_ERROR * g) ** 2), float(gain)
