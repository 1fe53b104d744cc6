"""A true effect is confirmed, a wrong one is not, however few the runs that confirm it."""

import numpy as np
import pytest

from dipper_gap.readings.features import Cell
from dipper_gap.statistics.baseline import Baseline, make_baseline
from dipper_gap.statistics.closure import closure

CELLS = [Cell(2, phase, channel, f) for phase in ("fill", "swing", "dump", "return")
         for channel in ("hoist_force_kN", "crowd_force_kN") for f in ("mean", "slope", "peak", "work")]
RUNS, FRESH, MINES, SIZE = 16, 5, 80, 1.2  # SIZE: the effect's shift of each cell, in sd of a run


def confirm(trucks, number, true=True, size=SIZE):
    """A mine with an effect that shifts every cell, against `FRESH` runs with it (or with its opposite)."""
    rng, n = np.random.default_rng([trucks, number]), len(CELLS)
    shift = size * np.where(np.arange(n) % 2, 1.0, -1.0)
    b, _ = make_baseline(CELLS, rng.standard_normal((RUNS, n)), 0.05 * trucks * np.eye(n), np.zeros((0, n)), (2,),
                         trucks)
    y = shift + rng.standard_normal((trucks, n)).mean(axis=0) + np.sqrt(0.05) * rng.standard_normal(n)
    after = (shift if true else -shift) + rng.standard_normal((FRESH, n))
    nearly = {"a rival that does half of it": b.mean + 0.5 * shift}
    return closure(y, b, after, nearly if true else {}, shift, seed=number)


@pytest.mark.parametrize("trucks, most", [(1, 0.10), (4, 0.05)])
def test_a_true_effect_is_seldom_refused(trucks, most):
    refused = [bool(confirm(trucks, k).objections()) for k in range(MINES)]
    print(f"{trucks} trucks: {np.mean(refused):.3f} refused")
    assert np.mean(refused) <= most


def test_its_closure_is_whole():
    found = [confirm(4, k).closure for k in range(MINES)]
    assert np.median(found) == pytest.approx(1.0, abs=0.1)


def test_closure_is_no_share_of_what_the_fresh_runs_leave_anyway():
    """Sixteen trucks and a small effect: the gap is as large as the floor of five runs, or smaller."""
    found = [confirm(16, k, size=0.4) for k in range(40)]
    assert sum(f.closure is None for f in found) > 20
    assert not [f for f in found if f.after < f.before and any("the gap grows" in o for o in f.objections())]
    assert all(f.closure < 2 for f in found if f.closure is not None)


def test_an_effect_with_which_the_gap_grows_is_refused():
    """Cells that move together: the effect takes their difference away, which T^2 sees, and moves them all off."""
    rng, n = np.random.default_rng(4), len(CELLS)
    values = rng.standard_normal((RUNS, 1)) + 0.5 * rng.standard_normal((RUNS, n))
    b, _ = make_baseline(CELLS, values, 1e-3 * np.eye(n), np.zeros((0, n)), (2,), 4)
    sides = np.where(np.arange(n) % 2, 1.0, -1.0)
    y = b.mean + 3.0 * sides
    after = b.mean + 3.0 * sides + 4.0 + 0.01 * rng.standard_normal((FRESH, n))
    found = closure(y, b, after, {}, sides)
    assert found.p < 0.05 and found.closure < 0
    assert any("the gap grows" in o for o in found.objections())


def test_a_wrong_effect_is_refused():
    assert all(confirm(4, k, true=False).objections() for k in range(20))


def test_closure_of_a_known_gap():
    """A gap of known size, closed to a known part."""
    rng = np.random.default_rng(1)
    n, runs = 40, 8
    cells = [Cell(1, "fill", "hoist_force_kN", str(k)) for k in range(n)]
    values = 0.1 * rng.standard_normal((runs, n))
    base = Baseline(cells, values.mean(axis=0), values, np.eye(n), np.zeros((0, n)), np.zeros((0, n)),
                    0.01 * np.eye(n), np.arange(n)[None])
    shift = np.full(n, 4.0)
    y = shift + rng.standard_normal(n)
    near = closure(y, base, 0.9 * shift + 0.1 * rng.standard_normal((5, n)), {"half": 0.5 * shift}, shift)
    assert near.closure == pytest.approx(1 - 0.4**2 / 16, abs=0.05)
    assert near.interval90[0] < near.closure < near.interval90[1]
    assert near.p < 0.001 and near.objections() == []
    wrong = closure(y, base, -0.5 * shift + 0.1 * rng.standard_normal((5, n)), {"half": 0.5 * shift}, shift)
    assert wrong.closure < 0 and len(wrong.objections()) == 4
