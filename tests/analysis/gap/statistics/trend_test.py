"""When it began: known steps and ramps, and how often the interval holds the truth."""
import numpy as np
import pytest

from dipper_gap.statistics.trend import find_trend, weights

TRUCKS, BEFORE = 14, 6


def strengths(change, size, seed, ramp=False, drift=0.0):
    """Unit scatter; a step after `change` trucks, or a ramp from there on; a shift of all since the reference."""
    rng = np.random.default_rng([seed, change])
    order = np.arange(1, TRUCKS + 1)
    shape = np.clip((order - change) / (TRUCKS - change), 0, 1) if ramp else (order > change)
    return rng.standard_normal(TRUCKS) + size * shape + drift * rng.standard_normal() * (order > BEFORE)


def found(y, drift=0.0):
    return find_trend(y, BEFORE, np.ones(TRUCKS), drift)


@pytest.mark.parametrize("change", [1, 6, 9, 13])
def test_a_clear_step_is_found_where_it_is(change):
    t = found(strengths(change, 12.0, 1))
    assert (t.began, t.interval90, t.shape if 1 < change < 13 else "step") == (change, (change, change), "step")
    assert abs(t.size - 12.0) < 3 * t.size_sd < 4.5


def test_a_clear_ramp_is_one():
    t = found(strengths(5, 30.0, 2, ramp=True))
    assert t.shape == "ramp" and abs(t.began - 5) <= 1 and t.size == pytest.approx(30, abs=4)


def test_ninety_per_cent_hold_the_truth():
    """Steps of 2.5 sd of a truck, at any of them."""
    held = []
    for seed in range(300):
        change = 2 + seed % (TRUCKS - 3)
        low, high = found(strengths(change, 2.5, seed)).interval90
        held.append(low <= change <= high)
    print(f"intervals of the day: {np.mean(held):.3f} of {len(held)} hold it")
    assert 0.85 <= np.mean(held) <= 0.99


def test_what_the_instruments_drift_by_is_not_taken_for_a_day():
    """Without it a drift of 3 sd is a step after the reference."""
    y = strengths(10, 6.0, 7, drift=3.0)
    assert found(y, drift=9.0).began == 10


def test_few_trucks_tell_no_day():
    assert find_trend(np.zeros(3), 1, np.ones(3), 0.0) is None


def test_scatter_beyond_what_was_said_widens_the_interval():
    y = strengths(8, 8.0, 3)
    small = find_trend(y, BEFORE, np.full(TRUCKS, 1e-4), 0.0)
    assert small.size_sd > 0.3


def test_weights_are_blind_to_the_other_directions():
    rng = np.random.default_rng(1)
    directions, covariance = rng.standard_normal((6, 2)), np.cov(rng.standard_normal((6, 40)))
    w = weights(directions, covariance)
    assert w @ directions == pytest.approx([1, 0], abs=1e-9)


def test_where_step_and_ramp_are_as_likely_it_is_drawn_as_a_step():
    """So its size is that of the best step, not of a ramp's end, which no truck has."""
    y = np.array([0, 0, 0, 0.3, 0.6, 1, 1.1])
    t = find_trend(y, 3, np.full(7, 0.3), 0.0)
    assert t.shape == "unclear" and t.size == pytest.approx(y[t.began:].mean() - y[:t.began].mean(), abs=0.05)
