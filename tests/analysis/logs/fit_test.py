"""The curve through a drive's readings: near what is known, smooth, and never beyond the limits."""
import math

import numpy as np
import pytest

import dipper_import.fit
import ugly_log
from dipper_import.fit import fit_drive, motion_curve, top_acceleration
from dipper_import.import_map import Limits
from dipper_import.readings import Readings

GRID = np.arange(0, 75.01, 0.1)


def readings(rate_hz, noise, step=0.0, seed=1):
    truth = ugly_log.planned(rate_hz)
    hoist = truth.channels["hoist"]
    value = hoist + noise * np.random.default_rng(seed).standard_normal(len(hoist))
    value = np.round(value / step) * step if step else value
    return Readings(truth.time_s, value, np.arange(len(value)) + 2, np.ones(len(value), bool))


@pytest.mark.parametrize("rate_hz, noise, step, within", [
    (10, 0, 0, 0.002), (10, 0.01, 0, 0.02), (10, 0, 0.05, 0.04), (5, 0.01, 0.01, 0.03), (1, 0.01, 0, 0.06)])
def test_known_curves_come_back(rate_hz, noise, step, within):
    fit = fit_drive(readings(rate_hz, noise, step), GRID, Limits(), False)
    assert np.abs(fit.value - ugly_log.planned(10).channels["hoist"][:len(GRID)]).max() < within
    assert not fit.limited


def test_a_long_log_is_smoothed_as_a_part_of_it(monkeypatch):
    short = fit_drive(readings(10, 0.01), GRID, Limits(), False)
    monkeypatch.setattr(dipper_import.fit, "MOST", 600)
    part = fit_drive(readings(10, 0.01), GRID, Limits(), False)
    assert 0 < np.abs(part.value - short.value).max() < 0.005


@pytest.mark.parametrize("limits", [
    Limits(-12, 0.5, 1.2, 0.8), Limits(-9, -1.5), Limits(speed=1.0), Limits(acceleration=0.5)])
def test_limits_are_kept_between_the_rows_too(limits):
    fit = fit_drive(readings(5, 0.01), GRID, limits, False)
    curve = motion_curve(GRID, fit.value)
    fine = np.linspace(0, GRID[-1], 20001)
    assert limits.min <= curve(fine).min() and curve(fine).max() <= limits.max
    assert np.abs(curve(fine, 1)).max() <= limits.speed * 1.0001
    assert top_acceleration(fit.value, 0.1) <= limits.acceleration * 1.0001
    assert fit.limited


def test_at_rest_at_both_ends_where_acceleration_is_limited():
    time = np.arange(0, 20, 0.1)
    moving = Readings(time, 1.0 * time, np.arange(len(time)), np.ones(len(time), bool))
    fit = fit_drive(moving, time, Limits(acceleration=1.0), False)
    assert abs(fit.value[1] - fit.value[0]) <= 0.01 + 1e-6
    assert 0.3 < np.abs(fit.change).max() < 0.6  # v^2 / 2a


@pytest.mark.parametrize("speed, acceleration", [(100, 300), (100, 60)])
def test_a_switch_opens_when_it_is_thrown(speed, acceleration):
    time = np.arange(0, 10, 0.2)
    thrown = Readings(time, np.where(time >= 4, 75.0, 0.0), np.arange(len(time)), np.ones(len(time), bool))
    grid = np.arange(0, 9.8, 0.1)
    fit = fit_drive(thrown, grid, Limits(0, 100, speed, acceleration), True)
    opens = grid[np.flatnonzero(fit.value > 0.5)[0]]
    takes = 75 / speed + speed / acceleration if speed ** 2 < 75 * acceleration else 2 * math.sqrt(75 / acceleration)
    assert 3.9 <= opens <= 4.3
    assert fit.value[np.searchsorted(grid, 4.2 + takes)] == pytest.approx(75, abs=0.5)


@pytest.mark.parametrize("pulse_s", [0.2, 0.6, 1.2])
def test_a_short_pulse_of_a_trip_wire_opens_the_door(pulse_s):
    time = np.arange(0, 20, 0.1)
    is_open = np.any([(time >= t) & (time < t + pulse_s - 1e-9) for t in (4, 12)], axis=0)
    thrown = Readings(time, np.where(is_open, 75.0, 0.0), np.arange(len(time)), np.ones(len(time), bool))
    grid = np.arange(0, 19.8, 0.1)
    fit = fit_drive(thrown, grid, Limits(0, 100, 100, 300), True)
    for opens in (4, 12):
        assert fit.value[(grid > opens) & (grid < opens + 4)].max() == pytest.approx(75, abs=1)
    assert fit.value[(grid > 9) & (grid < 12)].max() == pytest.approx(0, abs=0.5)
