"""How much of the gap the added effect closes, and whether anything simpler would have done as well.

G is the mean of z^2 over cells, with the sd of the unchanged model's prediction throughout. Closure is
(G before - G after) / (G before - G floor), where the floor is what a perfect model would leave.
"""
from dataclasses import dataclass

import numpy as np

from .null import root

DRAWS = 2000
SIGNIFICANT = 0.05


@dataclass(frozen=True)
class Closure:
    before: float
    after: float
    floor: float
    closure: float
    interval90: tuple
    p: float             # that so much would close by chance, were the unchanged model right
    rivals: dict         # {what: G it reaches}, to be beaten
    worse: tuple         # channels that got significantly worse
    cells: tuple         # z of each cell before, after

    def confirmed(self):
        return (self.p < SIGNIFICANT and self.closure > 0 and not self.worse
                and all(self.after < g for g in self.rivals.values()))

    def objections(self):
        out = [] if self.p < SIGNIFICANT else [f"the gap shrinks no more than by chance: p {self.p:.2g}"]
        out += [f"{name} does as well (G {g:.2f} against {self.after:.2f})"
                for name, g in self.rivals.items() if g <= self.after]
        return out + [f"{c} got worse" for c in self.worse]


def mean_square(residual, sd):
    return np.mean((residual / sd) ** 2, axis=-1)


def closure(y, baseline, after, rivals, seed=0):
    """y (n,) measured; `after` (R1, n) runs of the patched case; `rivals` {what: its mean (n,)}."""
    rng = np.random.default_rng(seed)
    sd, runs = baseline.sd, len(after)
    patched = after.mean(axis=0)
    g0, g1 = mean_square(y - baseline.mean, sd), mean_square(y - patched, sd)
    floor = float(np.mean(np.diag(baseline.noise + baseline.seed * (1 + 1 / runs)) / sd**2))
    noise = rng.standard_normal((DRAWS, len(y))) @ root(baseline.prediction).T
    # By chance: a mine like the unchanged model, judged by the same patched runs.
    lucky = mean_square(noise, sd) - mean_square(baseline.mean + noise - patched, sd)
    p = (1 + (lucky >= g0 - g1).sum()) / (1.0 + DRAWS)
    # Bootstrap: runs drawn again with replacement, the mine's own errors drawn anew.
    again = after[rng.integers(runs, size=(DRAWS, runs))].mean(axis=1)
    first = baseline.values[rng.integers(baseline.seeds, size=(DRAWS, baseline.seeds))].mean(axis=1)
    extra = np.mean(np.diag(baseline.prediction) / sd**2)  # the new errors' own share, in both
    drawn = y + noise
    b0, b1 = mean_square(drawn - first, sd) - extra, mean_square(drawn - again, sd) - extra
    share = (b0 - b1) / np.maximum(b0 - floor, 1e-3 * max(g0, 1.0))
    return Closure(float(g0), float(g1), floor, float((g0 - g1) / max(g0 - floor, 1e-9)),
                   tuple(float(q) for q in np.quantile(share, [0.05, 0.95])), float(p),
                   {k: float(mean_square(y - v, sd)) for k, v in rivals.items()},
                   _worse(baseline, drawn, first, again),
                   tuple(zip(((y - baseline.mean) / sd).tolist(), ((y - patched) / sd).tolist())))


def _worse(baseline, drawn, first, again):
    out = []
    for channel in dict.fromkeys(c.channel for c in baseline.cells):
        at = [i for i, c in enumerate(baseline.cells) if c.channel == channel]
        change = (mean_square((drawn - again)[:, at], baseline.sd[at])
                  - mean_square((drawn - first)[:, at], baseline.sd[at]))
        if np.quantile(change, SIGNIFICANT) > 0:
            out.append(channel)
    return tuple(out)


def best_fit(residual, covariance, directions, prior_sd):
    """Strengths of `directions` (n, K), normal about 0 with prior_sd (K,), that fit a residual best."""
    weighted = np.linalg.solve(covariance, directions)
    return np.linalg.solve(directions.T @ weighted + np.diag(1 / np.asarray(prior_sd) ** 2),
                           weighted.T @ residual)
