"""A model whose rock resists too much, and says so: without a reference, an effect beside that error is named."""
import functools

import pytest

import fake_mine
import synthetic
from dipper_gap.gap_json import as_json
from dipper_gap.model import learn, predict
from dipper_gap.readings.fidelity import Factor, Fidelity
from dipper_gap.simulation.corrected import Corrected
from dipper_gap.simulation.plan import make_plan
from dipper_gap.simulation.simulator import Request
from dipper_gap.workflow import Runner, conclude
from trucks import in_a_row

SMALL = {n: fake_mine.CATALOGUE[n] for n in ("fines", "crowd_friction", "scale_gain", "cohesion", "density")}
# Rock that resists half as much makes the mean dig force of the synthetic shovel 0.90 of what it is.
STATED = Fidelity(Factor(0.90, 0.87, 0.93), 0.25)
TRUCKS = 4


def mine(effects, seed):
    runs = [synthetic.with_noise(synthetic.run({"resists": 0.5, **effects}, 900 + 10 * seed + k), 10 * seed + k)
            for k in range(TRUCKS)]
    return in_a_row(runs)


@functools.lru_cache(None)
def known(stated):
    simulator = fake_mine.FakeSimulator()
    simulator = Corrected(simulator, STATED) if stated else simulator
    plan, runner = make_plan(SMALL, TRUCKS, 1), Runner(simulator, SMALL, lambda text: None)
    model = learn(plan, runner.folders(plan.requests()), mine({}, 0), known=simulator.known)
    return model, predict(model, SMALL, 1.0), runner


def answer(effects, seed, stated=True):
    model, prediction, runner = known(stated)
    return as_json(conclude(model, prediction, mine(effects, seed), runner), SMALL, {"case": "0" * 64})


def test_unless_it_is_stated_the_error_is_a_gap_that_no_effect_explains():
    assert answer({}, 1, stated=False)["verdict"] == "unknown"


@pytest.mark.parametrize("seed", [1, 2])
def test_nothing_hidden_is_no_gap_once_it_is_stated(seed):
    a = answer({}, seed)
    assert a["verdict"] == "no-gap"
    low, value, high = a["fidelity"]["resistance"]
    assert low < value < high and value == pytest.approx(0.5, abs=0.06)


def test_an_effect_beside_it_is_named():
    a = answer({"crowd_friction": 60}, 3)
    assert a["verdict"] == "named" and a["effect"] == "crowd_friction"
    low, high = a["parameter"]["interval90"]
    assert low < 60 < high


def test_an_effect_that_looks_like_it_is_not_distinguished_from_it():
    """The resistance's factor is off by a tenth: within what was stated."""
    a = answer({"resists": 0.55}, 4)
    assert a["verdict"] == "no-gap"


def test_what_an_instrument_adds_is_not_corrected_as_if_it_were_rock():
    simulator = Corrected(fake_mine.FakeSimulator(), STATED)
    plain, seen = simulator.run([Request((), 1), Request((("scale_gain", 0.1), ("zero", 100.0)), 1, "observe")])
    more = seen.signals["hoist_force_kN"] - plain.signals["hoist_force_kN"]
    assert more.min() == pytest.approx(100) and more.max() == pytest.approx(100)
    assert [p.truck_mass_t for p in seen.passes] == pytest.approx([1.1 * p.truck_mass_t for p in plain.passes])
