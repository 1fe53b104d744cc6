"""A law is told for what follows from the motion, with its form and size; for nothing, none."""
import functools
from dataclasses import replace

import numpy as np
import pytest

import fake_mine
import synthetic
from dipper_gap.decision.law import find_law
from dipper_gap.model import learn
from dipper_gap.simulation.plan import make_plan
from other_mine import periods
from trucks import in_a_row

TRUCKS, BEFORE = 4, 6


@functools.lru_cache(None)
def model():
    plan, simulator = make_plan({}, TRUCKS, 1), fake_mine.FakeSimulator()
    folders = dict(zip(plan.requests(), simulator.run(plan.requests())))
    return learn(plan, folders, in_a_row([synthetic.run()] * TRUCKS))


def law(effects, number):
    now, before = periods([{}] * BEFORE, [effects] * TRUCKS, number)
    baseline = replace(model().baseline, reference=model().reference(now, before),
                       scatter=np.ones(len(model().baseline.mean)))
    return find_law(model(), baseline, (2,), now, before)


@pytest.mark.parametrize("effects, channel, term, kN", [
    # A brake that drags in the swing, which this mine's hoist shows to 112 %, and friction, its crowd to 85 %.
    ({"outside": 1}, "hoist_force_kN", "swing moves", 1.12 * 60),
    ({"outside": 3}, "hoist_force_kN", "swing moves", 1.12 * 180),
    ({"crowd_friction": 150}, "crowd_force_kN", "crowd direction", 0.85 * 150)])
def test_the_form_and_the_size_are_right(effects, channel, term, kN):
    found = law(effects, 7)
    assert found.channel == channel and found.terms == ((term, pytest.approx(kN, rel=0.1)),)
    assert found.explained > 0.75 and found.p <= 0.025


def test_it_is_told_in_words():
    assert "as the crowd moves out, and -1" in law({"crowd_friction": 150}, 7).words


def test_nothing_has_no_law():
    assert [k for k in range(30, 40) if law({}, k)] == []
