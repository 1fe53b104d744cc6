"""How much of the gap the added effect closes, and whether anything simpler would have done as well.

G is the mean of z^2 over cells, with the sd of the unchanged model's prediction throughout. Closure is
(G before - G after) / (G before - G floor), where the floor is what a perfect model would leave. Cells are
correlated, so whether it closes by chance, and whether a rival does as well, is judged by T^2, which
weighs them rightly.
"""
from dataclasses import dataclass

import numpy as np

from .null import root

DRAWS = 2000
SIGNIFICANT = 0.05
BETTER = 10.0  # a rival objects when it makes the hold-out so many times more likely than the effect does
REACH = 2.0  # d below which an effect, by its own signature, does not act on these passes


@dataclass(frozen=True)
class Closure:
    before: float
    after: float
    floor: float
    closure: float       # None where the gap before is within noise of none or of the floor: nothing to close
    interval90: tuple    # of closure; None likewise
    p: float             # that T^2 would fall so far by chance, were the unchanged model right
    reaches: bool        # the effect acts on these passes at all
    t2: float            # T^2 after
    rivals: dict         # {what: T^2 it reaches}, to be beaten
    worse: tuple         # channels that got significantly worse
    z: tuple             # ((z before, z after) of each cell)

    def objections(self):
        """Why the effect is not confirmed here; nothing when it does not act here."""
        if not self.reaches:
            return []
        out = [] if self.p < SIGNIFICANT else [f"the gap shrinks no more than by chance: p {self.p:.2g}"]
        if self.closure is not None and self.closure <= 0:  # T^2 may fall where the mean square grows
            out.append(f"the gap grows: G {self.before:.2f} to {self.after:.2f}")
        out += [f"{name} does better (T2 {t2:.0f} against {self.t2:.0f})"
                for name, t2 in self.rivals.items() if t2 < self.t2 - 2 * np.log(BETTER)]
        return out + [f"{c} got worse" for c in self.worse]


def mean_square(residual, sd):
    return np.mean((residual / sd) ** 2, axis=-1)


def closure(y, baseline, after, rivals, expected, seed=0):
    """y (n,) measured; `after` (R1, n) runs of the patched case; `rivals` {what: its mean (n,)}, each the mean
    of the baseline's runs moved; `expected` (n,) the shift the effect's signature says.

    Each T^2 weighs with the covariance of its own difference: few runs of the patched case err more than the
    baseline's.
    """
    rng = np.random.default_rng(seed)
    sd, runs, covariance = baseline.sd, len(after), baseline.prediction
    patched = after.mean(axis=0)
    g0, g1 = mean_square(y - baseline.mean, sd), mean_square(y - patched, sd)
    covariance_after = baseline.against(runs)
    floor = float(np.mean(np.diag(covariance_after) / sd**2))
    noise = rng.standard_normal((DRAWS, len(y))) @ root(covariance).T
    inverse, inverse_after = np.linalg.inv(covariance), np.linalg.inv(covariance_after)

    def t2(residual, weight=inverse):
        return ((residual @ weight) * residual).sum(axis=-1)

    # By chance: a mine like the unchanged model, judged by the same patched runs.
    lucky = t2(noise) - t2(baseline.mean + noise - patched, inverse_after)
    fell = t2(y - baseline.mean) - t2(y - patched, inverse_after)
    p = (1 + (lucky >= fell).sum()) / (1.0 + DRAWS)
    # Bootstrap: runs drawn again with replacement, the mine's own errors drawn anew.
    again = after[rng.integers(runs, size=(DRAWS, runs))].mean(axis=1)
    first = baseline.values[rng.integers(baseline.seeds, size=(DRAWS, baseline.seeds))].mean(axis=1)
    drawn = y + noise
    # What the drawing itself adds to a cell's mean square: the new errors, and the spread of a mean of runs.
    spread = np.diag(baseline.seed) / sd**2
    added = 1 + spread / baseline.seeds, 1 + spread / runs
    if baseline.reference:  # the model's mean enters with the effect alone: it is what the runs with it are less by
        again, first = again - first + baseline.mean, np.broadcast_to(baseline.mean, first.shape)
        added = np.ones(len(sd)), 1 + spread * (1 / baseline.seeds + 1 / runs)
    share = interval = None
    least = np.quantile(mean_square(noise, sd), 1 - SIGNIFICANT)
    if g0 > max(least, floor + least - 1):  # beyond a perfect model's own floor, too: closure is a share of that
        b0, b1 = (mean_square(drawn - r, sd) - a.mean() for r, a in zip((first, again), added))
        interval = tuple(float(q) for q in np.quantile((b0 - b1) / np.maximum(b0 - floor, 0.1 * (g0 - floor)),
                                                       [0.05, 0.95]))
        share = float((g0 - g1) / (g0 - floor))
    return Closure(float(g0), float(g1), floor, share, interval, float(p),
                   bool(np.sqrt(t2(expected)) > REACH), float(t2(y - patched, inverse_after)),
                   {k: float(t2(y - v)) for k, v in rivals.items()}, _worse(baseline, drawn, first, again, added),
                   tuple(zip(((y - baseline.mean) / sd).tolist(), ((y - patched) / sd).tolist())))


def _worse(baseline, drawn, first, again, added):
    """Channels whose mean square grew, beyond what the few runs of the patched case add (twice: they and their
    bootstrap)."""
    out = []
    for channel in dict.fromkeys(c.channel for c in baseline.cells):
        at = [i for i, c in enumerate(baseline.cells) if c.channel == channel]
        change = (mean_square((drawn - again)[:, at], baseline.sd[at])
                  - mean_square((drawn - first)[:, at], baseline.sd[at])) - 2 * (added[1] - added[0])[at].mean()
        if np.quantile(change, SIGNIFICANT) > 0:
            out.append(channel)
    return tuple(out)


def best_fit(residual, covariance, directions, prior_sd):
    """Strengths of `directions` (n, K), normal about 0 with prior_sd (K,), that fit a residual best."""
    weighted = np.linalg.solve(covariance, directions)
    return np.linalg.solve(directions.T @ weighted + np.diag(1 / np.asarray(prior_sd) ** 2),
                           weighted.T @ residual)
