"""Signatures from few chaotic runs: what they promise against what is true."""
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from dipper_gap.statistics import signatures
from dipper_gap.statistics.baseline import make_baseline
from dipper_gap.statistics.reference import Reference
from dipper_gap.readings.features import Cell
from dipper_gap.statistics.shrink import shrink

PASSES, RUNS, EFFECTS = 3, 16, 40
CELLS = [Cell(p, phase, channel, f) for p in range(1, PASSES + 1) for phase in ("penetrate", "fill", "swing")
         for channel in ("hoist_force_kN", "crowd_force_kN") for f in ("mean", "slope", "peak")]
N = len(CELLS)
STRENGTHS, INDEX = (0.5, 1.0, 1.0), (0, 1, 2)
KEPT = (0.9, 0.1, 0.5, 0.1, 0.0, 0.0)  # of the plain run's deviation, in each pass's dig and after it


def one_run():
    """A root of the covariance of a run: features of a pass hang together closely, passes a little."""
    rng = np.random.default_rng(5)
    n = N // PASSES
    within = rng.standard_normal((n, 4)) @ rng.standard_normal((4, n)) + 0.3 * np.eye(n)
    return np.kron(np.linalg.cholesky(0.3 ** np.abs(np.subtract.outer(range(PASSES), range(PASSES)))), within)


def world(seed):
    rng, root = np.random.default_rng(seed), one_run()
    values = rng.standard_normal((RUNS, N)) @ root.T
    noise = 0.1 * np.diag((root**2).sum(axis=1))
    b, keep = make_baseline(CELLS, values, noise, np.zeros((0, N)), range(1, PASSES + 1), 4)
    assert len(keep) == N
    return b, rng, root


def runs_of(true, b, rng, root):
    """Three runs with an effect `true` (n,) a unit, which forget the plain run's seed."""
    kept = np.repeat(KEPT, [2 * N // 3 // PASSES, N // 3 // PASSES] * PASSES)
    fresh = rng.standard_normal((len(INDEX), N)) @ root.T
    return np.outer(STRENGTHS, true) + kept * b.values[list(INDEX)] + np.sqrt(1 - kept**2) * fresh


def fitted(true, b, rng, root, monkeypatch):
    monkeypatch.setattr(signatures, "BLOCK_ERROR", 0.0)
    monkeypatch.setattr(signatures, "CELL_ERROR", 0.0)
    effect = SimpleNamespace(kind="rock", affects="settling", name="e", reference=lambda: 1.0)
    return signatures.fit_signature(effect, b, STRENGTHS, INDEX, runs_of(true, b, rng, root))


def distance(vector, b):
    return float(np.sqrt(vector @ np.linalg.solve(b.prediction, vector)))


def test_an_effect_that_does_nothing_is_not_promised(monkeypatch):
    """Three runs' noise alone is far from zero in these units; little of it may be left."""
    raw, left = [], []
    for k in range(EFFECTS):
        b, rng, root = world(k)
        s = np.asarray(STRENGTHS)
        raw.append(distance(s @ (runs_of(np.zeros(N), b, np.random.default_rng(k), root)) / (s @ s), b))
        left.append(distance(fitted(np.zeros(N), b, rng, root, monkeypatch).g, b))
    print(f"d of noise: {np.median(raw):.1f} as it is, {np.median(left):.2f} shrunk, {max(left):.1f} at most")
    assert np.median(raw) > 4
    assert np.median(left) < 0.5 and np.quantile(left, 0.9) < 2.5


@pytest.mark.parametrize("kind", ["as seeds move", "one block", "a feature of each block"])
def test_errors_are_as_large_as_promised(kind, monkeypatch):
    """Of effects of several kinds, in the prediction's metric, and their length is kept."""
    error, promised, length, found = [], [], [], []
    for k in range(EFFECTS):
        b, rng, root = world(100 + k)
        pick = np.random.default_rng([7, k])
        if kind == "as seeds move":
            true = np.tile((pick.standard_normal(N) @ root.T)[:N // PASSES], PASSES)
        elif kind == "one block":
            chosen = CELLS[pick.integers(N)]
            true = np.array([3.0 * ((c.phase, c.channel) == (chosen.phase, chosen.channel)) for c in CELLS]) * b.sd
        else:
            true = np.tile(pick.standard_normal(N // PASSES), PASSES) * b.sd
        s = fitted(true, b, rng, root, monkeypatch)
        whole = np.linalg.inv(b.prediction + s.spread)
        error.append((s.g - true) @ whole @ (s.g - true))
        promised.append(np.trace(whole @ s.spread))
        length.append(distance(true, b))
        found.append(distance(s.g, b))
    print(f"{kind}: squared error {np.mean(error):.1f}, promised {np.mean(promised):.1f}; "
          f"d {np.median(length):.1f}, found {np.median(found):.1f}")
    assert np.mean(error) < 2 * np.mean(promised) and np.mean(promised) < 8
    assert 0.75 < np.median(np.array(found) / np.array(length)) < 1.15


def test_what_is_kept_of_the_seed_is_found_for_each_dig_and_after_it():
    kept = []
    for k in range(EFFECTS):
        b, rng, root = world(200 + k)
        v = runs_of(np.zeros(N), b, rng, root) - b.mean
        kept.append([x for _, x, _ in signatures._memory(np.asarray(STRENGTHS), v, b.values[list(INDEX)] - b.mean, b)])
    assert np.mean(kept, axis=0) == pytest.approx(KEPT, abs=0.2)  # few cells; never below 0


def test_deviations_are_of_a_runs_size():
    b, rng, root = world(300)
    rows = np.concatenate([signatures.deviations(STRENGTHS, INDEX, runs_of(np.zeros(N), b, rng, root), b)
                           for _ in range(60)])
    assert np.median(rows.var(axis=0) / (root**2).sum(axis=1)) == pytest.approx(1.0, abs=0.2)


def test_exact_signatures_pass_unchanged():
    b, _, _ = world(1)
    x = np.random.default_rng(2).standard_normal(N) * b.sd
    g, spread = shrink(x, np.zeros((N, N)), b, 1.0)
    assert np.allclose(g, x, atol=1e-3 * b.sd) and np.abs(spread).max() < 1e-4 * np.diag(b.prediction).max()


def test_an_effect_against_the_motion_is_bounded_where_the_drive_stands_still():
    b, _, _ = world(1)
    crowd = np.array([c.channel == "crowd_force_kN" and c.feature == "mean" for c in b.cells])
    swing = np.array([c.phase == "swing" for c in b.cells])
    rest, g = 0.6 * (crowd & swing), 1.0 * (crowd & ~swing)
    b = replace(b, rest=rest)
    for affects, expected in (("machine", 0.6 / np.sqrt(3)), ("settling", 0.0)):
        effect = SimpleNamespace(kind="machine", affects=affects, name="e", reference=lambda: 1.0)
        wrong = signatures.fit_signature(effect, b, (1.0, 1.0), (0, 1), b.values[:2] + g, True).wrong
        sd = np.sqrt(np.diag(wrong))
        assert sd[rest > 0] == pytest.approx(np.full(PASSES, expected), abs=0.02)
        assert sd[(rest == 0) & (g == 0)].max() < 0.05


def test_an_effect_may_differ_more_where_the_mines_earlier_trucks_do():
    b, rng, root = world(2)
    trucks = 4
    off = np.array([0.5 * (c.phase == "fill" and c.channel == "hoist_force_kN") for c in b.cells])
    mean = 50 * np.sqrt(np.diag(b.seed))
    alike = Reference(np.zeros((trucks, N)), b.own, b.common, np.zeros((0, N)), 0 * mean)
    b = replace(b, mean=mean, reference=alike)
    assert not b.unlike.any()
    other = replace(b, reference=replace(alike, shift=off * mean))
    assert other.unlike == pytest.approx(off, abs=0.01)
    at = off > 0
    sizes = [np.sqrt(np.diag(signatures._shape_error(mean, x)[0]))[at] / mean[at] for x in (b, other)]
    assert (sizes[1] > 1.5 * sizes[0]).all()
    # What an error that all readings of a channel share may be is no difference of mine and model.
    shared = replace(b, reference=replace(alike, common=np.array([off * mean / 2]), shift=0.99 * off * mean))
    assert shared.unlike.max() < 0.02
    # A mine that differs by as much everywhere leaves that in the strength.
    everywhere = replace(b, reference=replace(alike, shift=0.3 * mean))
    gains = [signatures._shape_error(mean, x)[1] for x in (b, everywhere)]
    assert gains[0] < 0.15 and gains[1] == pytest.approx(np.hypot(gains[0], 0.3), abs=0.01)
