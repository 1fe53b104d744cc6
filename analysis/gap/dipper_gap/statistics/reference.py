"""A mine's own earlier trucks, of a time when all was well, in the place of the model's mean.

What differs between mine and model at all times stands in both periods and drops out of their difference. The
model's runs still say what an effect does, and how runs scatter; how much, the mine's own trucks say.
"""
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import chdtri

from ..readings.features import number
from .baseline import scatter

WEIGHT = 2.0        # degrees of freedom that the model's own scatter counts against the mine's
FEATURE_DOF = 14.0  # the same of the mine's scatter as a whole against that of one feature
TOLERANCE = 0.05    # of a variance
LEAST = 0.1         # of the model's variance: less scatter than that is not believed


@dataclass(frozen=True)
class Reference:
    """T0 trucks over a baseline's cells."""

    rows: np.ndarray   # (T0, n) each truck less their mean
    own: np.ndarray    # (n, n) of one truck's instruments, then
    common: np.ndarray  # (channels, n) shifts by one common_sigma of these
    drift: np.ndarray  # (channels, n) shifts by one sd of what each channel's shared error has changed by since
    shift: np.ndarray  # (n,) mean of the trucks less the model's mean, each as its instruments show it
    along: np.ndarray = None  # (n, K) directions along which features move together, as an effect moves them
    sizes: np.ndarray = None  # (K,) sd of one run along each, besides what the scaled covariance says; None: not known

    @property
    def trucks(self):
        return len(self.rows)

    @property
    def beyond(self):
        """(n, K); beyond beyond' is what one run scatters by besides the scaled covariance."""
        return np.zeros((len(self.shift), 0)) if self.sizes is None else self.along * self.sizes

    def scattered(self, factor):
        """The same with what one run scatters by along the directions times `factor`, a variance."""
        return self if self.sizes is None else replace(self, sizes=self.sizes * np.sqrt(factor))

    def part(self, at):
        """The same over some of the cells."""
        return replace(self, rows=self.rows[:, at], own=self.own[np.ix_(at, at)], common=self.common[:, at],
                       drift=self.drift[:, at], shift=self.shift[at],
                       along=None if self.along is None else self.along[at])


def drift_sigmas(now, before, names):
    """(channels,) sd of what the shared error of each channel has changed by between two folders' channels.

    Where it is not given two errors are taken, each as large as its folder says: another calibration, another scale.
    """
    drifts = [now[n].drift_sigma for n in names]
    return np.array([np.hypot(now[n].common_sigma, before[n].common_sigma) if d is None else d
                     for n, d in zip(names, drifts)])


def mine_scatter(now, before, own_now, own_before, seed, keys):
    """(n,) variance of the mine's own runs, in variances of the model's, from two periods' trucks (T, n), (T0, n).

    `own_now`, `own_before`, `seed` (n,): variances of one truck's instruments and of one run; `keys` (n,) number the
    features, whose passes are pooled. Each feature's own ratio counts by its degrees of freedom, against that of
    all; that of all against 1.
    """
    dof = len(now) + len(before) - 2
    if dof < 1:
        return np.ones(len(seed))
    squares = sum(((rows - rows.mean(axis=0)) ** 2).sum(axis=0) for rows in (now, before))
    own = ((len(now) - 1) * own_now + (len(before) - 1) * own_before) / dof
    moves = (seed > own) & (seed > 0)
    if not moves.any():
        return np.ones(len(seed))
    usual = chdtri(dof, 0.5)  # median of the squares, in what they estimate
    whole = max(LEAST, float(np.median(((squares / usual) - own)[moves] / seed[moves])))
    whole = (WEIGHT + dof * whole) / (WEIGHT + dof)
    ratio = np.where(moves, (squares / dof - own) / np.where(moves, seed, 1.0), 0.0)
    count = np.bincount(keys, moves)
    mean = np.bincount(keys, ratio) / np.maximum(count, 1)
    feature = (FEATURE_DOF * whole + dof * count * mean) / (FEATURE_DOF + dof * count)
    return np.maximum(LEAST, feature)[keys]


def with_scatter(baseline, now, before=None):
    """The baseline with the scatter of the mine's own trucks, (T, n) and those of the reference, (T0, n); along the
    reference's directions, where it has them, besides."""
    own, seed = np.diag(baseline.own), np.diag(baseline.seed)
    if baseline.reference is None:
        return replace(baseline, scatter=scatter(now, own, seed))
    keys = number([c.key for c in baseline.cells])
    scaled = replace(baseline, scatter=mine_scatter(now, before, own, np.diag(baseline.reference.own), seed, keys),
                     reference=replace(baseline.reference, sizes=None))
    if scaled.reference.along is None:
        return scaled
    return replace(scaled, reference=replace(scaled.reference, sizes=_sizes_beyond(scaled, now, before)))


def spread_over(cells, part, scatter_of_part):
    """(n,) scatter over `cells` from that of the training passes' cells `part`, feature by feature."""
    known = {c.key: x for c, x in zip(part, scatter_of_part)}
    usual = float(np.median(scatter_of_part))
    return np.array([known.get(c.key, usual) for c in cells])


def _sizes_beyond(b, now, before):
    """(K,) sd of one of the mine's runs along each direction of the reference of `b`, besides what its covariance says.

    A covariance that few runs tell is shrunk, and promises too little where features move together: along a fuller
    dipper, say, as an effect would have it too. Along the weights with which an effect is sought, the variance of the
    trucks themselves, (T, n) and (T0, n), and of the model's runs is counted instead. The largest excess is put in
    first, as one may explain another.
    """
    rows = np.vstack([x - x.mean(axis=0) for x in (now, before)])
    dof = np.array([len(rows) - 2, b.seeds - 1])
    g, variance = b.reference.along, np.zeros(b.reference.along.shape[1])
    runs = (b.values - b.mean) * np.sqrt(b.scatter)
    own = ((len(now) - 1) * b.own + (len(before) - 1) * b.reference.own) / max(dof[0], 1)
    one = b.mine
    share = 1.0 / b.trucks + 1.0 / b.reference.trucks
    for _ in range(2 * g.shape[1]):
        w = np.linalg.solve(b.noise + one * share, g)
        claimed = np.einsum("ik,ij,jk->k", w, one, w)
        trucks = ((rows @ w) ** 2).sum(axis=0) - dof[0] * np.einsum("ik,ij,jk->k", w, own, w)
        seen = (trucks + ((runs @ w) ** 2).sum(axis=0)) / dof.sum()
        excess = np.where(claimed > 0, seen / np.maximum(claimed, 1e-300), 0.0)
        k = int(np.argmax(excess))
        if excess[k] < 1.0 + TOLERANCE:
            break
        more = (seen[k] - claimed[k]) / (w[:, k] @ g[:, k]) ** 2
        variance[k] += more
        one = one + more * np.outer(g[:, k], g[:, k])
    return np.sqrt(variance)
