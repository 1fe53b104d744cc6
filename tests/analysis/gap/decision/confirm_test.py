"""A law of the motion beside a name: it objects where the force has another form than the name's, only there."""
import functools
from dataclasses import replace

import pytest

import fake_mine
import synthetic
from dipper_gap.gap_json import as_json
from dipper_gap.model import learn, predict
from dipper_gap.simulation.plan import make_plan
from dipper_gap.workflow import Runner, conclude

# Friction in the slide is replayed, as in the real catalogue: the rock does what it did.
SMALL = {n: replace(e, affects="machine") if n == "crowd_friction" else e for n, e in fake_mine.CATALOGUE.items()
         if n in ("fines", "crowd_friction", "scale_gain")}


@functools.lru_cache(None)
def known():
    runner = Runner(fake_mine.FakeSimulator(), SMALL, lambda text: None)
    plan = make_plan(SMALL, 1, 1)
    model = learn(plan, runner.folders(plan.requests()), synthetic.run())
    return model, predict(model, SMALL, 1.0), runner


def answer(truth, seed):
    model, prediction, runner = known()
    mine = synthetic.with_noise(synthetic.run(truth, seed=900 + seed), seed)
    return as_json(conclude(model, prediction, mine, runner), SMALL, {"case": "0" * 64})


def test_friction_that_grows_with_the_crowds_extension_is_not_called_friction():
    a = answer({"bent_handle": 30}, 5)
    assert a["verdict"] == "unknown" and a["effect"] is None
    assert any("crowd_friction" in r and "for each metre that the crowd is out" in r and "does better" in r
               for r in a["reasons"])
    assert a["law"]["terms"] == [{"term": "crowd drag", "kN": pytest.approx(30, rel=0.15)}]


def test_a_law_of_the_same_form_is_no_objection():
    a = answer({"crowd_friction": 80}, 5)
    assert a["verdict"] == "named" and a["effect"] == "crowd_friction" and a["reasons"] == []
