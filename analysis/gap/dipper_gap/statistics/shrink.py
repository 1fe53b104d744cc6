"""A noisy vector over cells, drawn towards zero where it looks like noise (empirical Bayes).

The noise is correlated, so no cell can be drawn by itself: mass and hoist force err together, and their
difference, which hardly errs, must not take up noise of either. The prior is normal about 0, a sum of components
whose variances maximise the likelihood (the MM iteration of Zhou et al. 2019, J. Comput. Graph. Stat. 28, 350):
moved as seeds move all cells, as they move one block of phase and channel, or each feature of a block by
itself; every one of these alike in all passes, and in each pass anew.
"""
import numpy as np

from ..readings.features import number

STEPS = 30
START = 0.3    # of the variances, in the seeds' or the prediction's
LEAST = 1e-10  # keeps them positive
JITTER = 1e-6  # of the prediction's variance, added to the noise


def shrink(x, noise, baseline, unit):
    """Posterior mean (n,) and covariance (n, n) of what `x` (n,) shows with `noise` (n, n).

    `unit` is the strength at which x would be in the features' own units.
    """
    kinds = _components(baseline, unit)
    theta = [np.full(member.max() + 1, START) for _, member in kinds]
    noise = noise + np.diag(JITTER * (baseline.sd / unit) ** 2)

    def prior():
        return sum(shape * t[member] for (shape, member), t in zip(kinds, theta))

    for _ in range(STEPS):
        inverse = np.linalg.inv(prior() + noise)
        w = inverse @ x
        for (shape, member), t in zip(kinds, theta):
            seen = np.bincount(member, w * (shape @ w))
            due = np.bincount(member, (inverse * shape).sum(axis=0))
            t *= np.sqrt(np.maximum(seen, 0) / np.maximum(due, 1e-300))
            np.maximum(t, LEAST, out=t)
    p = prior()
    gain = np.linalg.solve(p + noise, p).T
    left = p - gain @ p
    return gain @ x, 0.5 * (left + left.T)


def _components(baseline, unit):
    """[(shape (n, n), member (n,))]: a component's covariance is its variance times the shape among its members."""
    cells = baseline.cells
    key = number([c.key for c in cells])
    block, one_pass = number([(c.phase, c.channel) for c in cells]), number([c.pass_number for c in cells])
    same_block, same_pass = block[:, None] == block, one_pass[:, None] == one_pass
    seeds = _between_features(baseline, key) / unit**2
    alone = np.outer(baseline.sd, baseline.sd) * (key[:, None] == key) / unit**2
    everywhere = np.zeros(len(cells), int)
    kinds = [(seeds, everywhere), (seeds * same_block, block), (alone, block)]
    return kinds + [(shape * same_pass, member) for shape, member in kinds]


def _between_features(baseline, key):
    """(n, n) how seeds move two features, taken in one pass whichever passes the cells are of."""
    correlation = np.zeros((key.max() + 1, key.max() + 1))
    sd = np.sqrt(np.diag(baseline.seed))
    safe = np.where(sd > 0, sd, 1.0)
    for row in baseline.grid:
        at = row[row >= 0]
        pair = np.ix_(key[at], key[at])
        seen = baseline.seed[np.ix_(at, at)] / np.outer(safe[at], safe[at])
        correlation[pair] = np.where(correlation[pair] == 0, seen, correlation[pair])
    return correlation[np.ix_(key, key)] * np.outer(sd, sd)
