"""A channel that is said to share no error may have drifted all the same: its shift is known."""
from dataclasses import replace

import numpy as np
import pytest

import fake_mine
import synthetic
from dipper_gap.model import learn
from dipper_gap.simulation.plan import make_plan

HOIST = 0  # among the responses


def model(common):
    plan, simulator = make_plan({}, 1, 1), fake_mine.FakeSimulator()
    folders = dict(zip(plan.requests(), simulator.run(plan.requests())))
    channels = {n: replace(c, common_sigma=common) if n == "hoist_force_kN" else c
                for n, c in synthetic.CHANNELS.items()}
    return learn(plan, folders, replace(synthetic.run(), channels=channels))


def test_a_shift_of_a_channel_without_a_shared_error_is_known():
    none, some = model(0.0), model(15.0)
    means = [i for i, c in enumerate(none.baseline.cells) if (c.channel, c.feature) == ("hoist_force_kN", "mean")]
    assert none.responses[HOIST] == "hoist_force_kN" and none.baseline.cells == some.baseline.cells
    assert none.bias[HOIST][means] == pytest.approx(np.ones(len(means)))
    assert not none.baseline.common[HOIST].any()
    assert some.baseline.common[HOIST][means] == pytest.approx(15 * np.ones(len(means)))
