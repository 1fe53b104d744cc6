"""The difference of two periods: its covariance against samples, and how the mine's own trucks show their scatter."""
from dataclasses import replace

import numpy as np
import pytest

from dipper_gap.readings.features import Cell
from dipper_gap.readings.channels import Channel
from dipper_gap.statistics.baseline import make_baseline
from dipper_gap.statistics.left_out import left_out_trucks
from dipper_gap.statistics.null import Tails, scores, simulate_null, statistics
from dipper_gap.statistics.reference import Reference, drift_sigmas, with_scatter
from dipper_gap.workflow import model_gap

CELLS = [Cell(p, phase, "hoist_force_kN", f) for p in (1, 2, 3) for phase in ("fill", "swing")
         for f in ("mean", "slope", "peak")]
N, RUNS, TRUCKS, BEFORE = len(CELLS), 16, 4, 6
OWN, DRIFT = 0.3, 0.5


def baseline(seed=0, trucks=TRUCKS, before=BEFORE, scatter=1.0):
    """Unit variance from seed to seed; instruments err by OWN, and have drifted by DRIFT."""
    rng = np.random.default_rng(seed)
    b = make_baseline(CELLS, rng.standard_normal((RUNS, N)), np.eye(N) * OWN**2, np.ones((1, N)), (1, 2, 3), trucks)[0]
    reference = Reference(np.zeros((before, N)), np.eye(N) * OWN**2, np.ones((1, N)), np.full((1, N), DRIFT),
                          np.full(N, 7.0))
    return replace(b, reference=reference, scatter=np.full(N, scatter))


def test_the_reference_differs_from_the_model_by_its_own_instruments_shared_error():
    """What those of now share says nothing of it."""
    b = baseline()
    sharp = replace(b, common=0 * b.common)
    assert model_gap(sharp) == model_gap(b) and np.array_equal(sharp.unlike, b.unlike)
    blunt = replace(b, reference=replace(b.reference, common=np.full((1, N), 7.0)))
    assert model_gap(blunt) == pytest.approx(1, rel=0.05) and model_gap(b) > 30  # its shift is 7


def trucks(rng, count, size=1.0, level=0.0):
    return level + size * rng.standard_normal((count, N)) + OWN * rng.standard_normal((count, N))


def test_prediction_is_the_variance_of_the_periods_difference():
    """Nothing of the model's mean is in it, nor what the instruments err by at all times."""
    b, rng = replace(baseline(), seed=np.eye(N)), np.random.default_rng(1)
    off = [trucks(rng, TRUCKS, level=9.0).mean(axis=0) + DRIFT * rng.standard_normal()
           - trucks(rng, BEFORE, level=9.0).mean(axis=0) for _ in range(4000)]
    assert np.var(off) == pytest.approx(np.diag(b.prediction).mean(), rel=0.05)
    assert np.allclose(b.level, b.mean + 7.0)
    runs = 5  # with an effect: the model's own mean enters with them
    assert np.allclose(b.against(runs), b.prediction + b.seed * (1 / RUNS + 1 / runs))


@pytest.mark.parametrize("size", [0.5, 1.0, 2.0])
def test_the_mines_trucks_tell_their_scatter_less_and_more_than_the_models(size):
    found = []
    for k in range(20):
        rng = np.random.default_rng([3, k])
        b = baseline(k)
        found.append(np.median(with_scatter(b, trucks(rng, TRUCKS, size, 5), trucks(rng, BEFORE, size)).scatter))
    assert np.median(found) == pytest.approx(size**2, rel=0.25 if size >= 1 else 0.4)


def test_two_lone_trucks_tell_no_scatter():
    b, rng = baseline(trucks=1, before=1), np.random.default_rng(2)
    assert np.allclose(with_scatter(b, trucks(rng, 1), trucks(rng, 1)).scatter, 1.0)


def test_trucks_that_move_together_otherwise_than_the_model_are_seen():
    """Same variances, but features move one way in the mine, which the model's runs never do."""
    b, rng = baseline(), np.random.default_rng(5)
    alike = [trucks(rng, count) for count in (TRUCKS, BEFORE)]
    assert left_out_trucks(*alike, with_scatter(b, *alike), Tails()) < 1.6
    # Alternating signs of one number: T2 does not see it, the mirror image does.
    sides = np.where(np.arange(N) % 2, 1.0, -1.0)
    close = replace(b, seed=0.1 * np.eye(N) + 0.9)  # the model: all features together
    other = [rng.standard_normal((count, 1)) * sides + OWN * rng.standard_normal((count, N))
             for count in (TRUCKS, BEFORE)]
    assert left_out_trucks(*other, with_scatter(close, *other), Tails()) > 2


def test_the_null_of_two_periods_is_nominal():
    """Mines of half and of twice the model's scatter; alarms at 0.2."""
    alarms = []
    for k in range(40):
        rng = np.random.default_rng([9, k])
        size = (0.7, 1.4)[k % 2]
        now, then = trucks(rng, TRUCKS, size, 5), trucks(rng, BEFORE, size, 5)
        b = with_scatter(baseline(k), now, then)
        null = simulate_null(b, draws=100, seed=k, tails=Tails())
        residual = now.mean(axis=0) + DRIFT * rng.standard_normal() - then.mean(axis=0)
        alarms.append(null.omnibus_p(statistics(residual, b.prediction, b.grid)) <= 0.2)
    print(f"two periods: {np.mean(alarms):.3f} at 0.2")
    assert 0.03 < np.mean(alarms) < 0.40  # three standard errors of 40


def vary_along(b, rng, size):
    """Trucks without a gap that vary along one direction besides, by which an effect is sought, as no run does: their
    prediction, its null, and the squared score along that direction."""
    g = rng.standard_normal((N, 3))
    now, then = (trucks(rng, count) + size * rng.standard_normal((count, 1)) * g[:, 0] for count in (TRUCKS, BEFORE))
    b = with_scatter(replace(b, reference=replace(b.reference, along=g)), now, then)
    b = b.scattered(left_out_trucks(now, then, b, Tails()))
    null = simulate_null(b, g, draws=100, tails=Tails())
    residual = now.mean(axis=0) + DRIFT * rng.standard_normal() - then.mean(axis=0)
    score = scores(residual, b.inflated(null.inflation(3)).prediction, g)[0]
    return null.omnibus_p(statistics(residual, b.prediction, b.grid, g)), score, null


def test_trucks_that_vary_along_an_effect_are_not_taken_for_it():
    """Known from few trucks, it is as little known in each draw of the null."""
    p, score, nulls = zip(*(vary_along(baseline(k), np.random.default_rng([8, k]), 1.5) for k in range(40)))
    print(f"along an effect: {np.mean(np.array(p) <= 0.05):.3f} at 0.05, score {np.mean(score):.2f}")
    assert np.mean(np.array(p) <= 0.05) < 0.15
    assert np.mean([null.fits[:, 0, 0].mean() for null in nulls]) > 1.5
    assert np.mean(score) < 2.5


def test_what_the_trucks_scatter_by_along_an_effect_is_enlarged_with_the_rest():
    b = baseline()
    b = replace(b, reference=replace(b.reference, along=np.ones((N, 1)), sizes=np.array([2.0])))
    assert np.allclose(b.inflated(3.0).mine, 3 * b.mine) and np.allclose(b.scattered(3.0).mine, 3 * b.mine)
    assert np.allclose(b.inflated(3.0).seed, 3 * b.seed) and np.allclose(b.scattered(3.0).seed, b.seed)


def test_errors_of_one_instrument_cancel_only_where_it_is_stated():
    now = {"a": Channel("a", "t", "response", 1, 2.0, 0.5), "b": Channel("b", "t", "response", 1, 3.0)}
    then = {"a": Channel("a", "t", "response", 1, 2.0), "b": Channel("b", "t", "response", 1, 4.0)}
    assert drift_sigmas(now, then, ["a", "b"]) == pytest.approx([0.5, 5.0])
