"""What has changed since a reference: a mine that the model misses everywhere, before and now."""
import functools
import json
from dataclasses import replace

import numpy as np
import pytest

import fake_mine
import synthetic
from dipper_gap.gap_json import as_json
from dipper_gap.model import learn, predict, predict_change
from dipper_gap.report import page
from dipper_gap.simulation.plan import make_plan
from dipper_gap.workflow import Runner, analyse, conclude
from other_mine import periods
from trucks import in_a_row

SMALL = {n: fake_mine.CATALOGUE[n]
         for n in ("fines", "crowd_friction", "scale_gain", "cohesion", "truck_spillage", "density")}
TRUCKS, BEFORE = 4, 6
pytestmark = pytest.mark.usefixtures("few_draws")


@functools.lru_cache(None)
def known():
    plan, simulator = make_plan(SMALL, TRUCKS, 1), fake_mine.FakeSimulator()
    folders = dict(zip(plan.requests(), simulator.run(plan.requests())))
    like = in_a_row([synthetic.run()] * TRUCKS)
    return learn(plan, folders, like, like)


def judge(now, before, with_reference=True):
    model, runner = known(), Runner(fake_mine.FakeSimulator(), SMALL, lambda text: None)
    if with_reference:
        out = conclude(model, predict_change(model, SMALL, now, before), now, runner, before)
    else:
        out = conclude(model, predict(model, SMALL, model.scatter(now)), now, runner)
    return out, json.loads(json.dumps(as_json(out, SMALL, {}), allow_nan=False))


def test_nothing_has_changed_in_a_mine_that_the_model_misses_everywhere():
    now, before = periods([{}] * BEFORE, [{}] * TRUCKS, 1)
    alone, with_it = judge(now, before, False)[1], judge(now, before)[1]
    assert alone["verdict"] == "unknown" and alone["reference"] is None and alone["history"] is None
    assert with_it["verdict"] == "no-gap" and with_it["omnibus_p"] > 0.05
    assert with_it["reference"]["trucks"] == BEFORE and with_it["reference"]["model_gap"] > 10
    assert with_it["gap"]["before"] == pytest.approx(1, abs=0.7)


def test_what_has_changed_is_named_and_stands_against_the_reference():
    now, before = periods([{}] * BEFORE, [{"crowd_friction": 120}] * TRUCKS, 3)
    out, a = judge(now, before)
    assert a["verdict"] == "named" and a["effect"] == "crowd_friction"
    assert a["parameter"]["estimate"] == pytest.approx(0.85 * 120, rel=0.15)  # this mine's crowd shows 85 % of it
    assert a["gap"]["holdout_closure"] > 0.6
    began, trucks = a["history"]["began"], a["history"]["trucks"]
    assert (began["after_trucks"], began["interval90_trucks"], began["shape"]) == (BEFORE, [BEFORE] * 2, "step")
    assert began["before"] == trucks[BEFORE]["time"] == f"{now.passes[0].t_start_s:g} s"
    assert [t["period"] for t in trucks] == ["reference"] * BEFORE + ["measured"] * TRUCKS
    shown = json.loads(json.dumps(page(out, a, SMALL, "synthetic"), allow_nan=False))
    before_mass = np.mean([p.truck_mass_t for t in before.trucks() for p in t.passes if p.number == 1])
    assert shown["masses"][0]["before"] == pytest.approx(before_mass, abs=0.01)  # in the model's place
    assert np.mean(np.abs(np.subtract(shown["curves"][0]["measured"], shown["curves"][0]["before"]))) < 100


def test_a_reference_has_its_own_instruments_shared_error():
    now, before = periods([{}] * BEFORE, [{}] * TRUCKS, 1)
    blunt = {n: replace(c, common_sigma=2 * c.common_sigma) for n, c in before.channels.items()}
    usual, twice = (known().reference(now, replace(before, channels=c)).common for c in (before.channels, blunt))
    assert np.allclose(twice, 2 * usual) and np.allclose(usual, known().baseline.common)


def test_the_trucks_show_the_strength_that_is_named():
    """A clock off by several readings is no straight line: both are of the signature at that strength."""
    few = {n: fake_mine.CATALOGUE[n] for n in ("logger_offset", "scale_gain")}
    now, before = periods([{}] * BEFORE, [{"logger_offset": 1.6}] * TRUCKS, 5)
    plan, simulator = make_plan(few, TRUCKS, 1), fake_mine.FakeSimulator()
    model = learn(plan, dict(zip(plan.requests(), simulator.run(plan.requests()))), now, before)
    runner = Runner(simulator, few, lambda text: None)
    out = conclude(model, predict_change(model, few, now, before), now, runner, before)
    strengths = [t.strength for t in out.history.trucks if t.period == "measured"]
    assert out.history.effect == "logger_offset"
    assert np.mean(strengths) == pytest.approx(out.effects["logger_offset"], rel=0.03)


def test_masses_alone_have_a_reference_too():
    now, before = (m.seen_by({"truck_mass_t": m.channels["truck_mass_t"]})
                   for m in periods([{}] * BEFORE, [{"scale_gain": 0.25}] * TRUCKS, 6))
    few = {n: SMALL[n] for n in ("scale_gain", "density")}
    out = analyse(now, fake_mine.FakeSimulator(), few, 1, lambda text: None, before)
    assert out.look.verdict.verdict != "no-gap" and out.reference == BEFORE


def test_the_day_is_found_within_the_measured_trucks_and_reported():
    """Friction since the second of four: named or not, as the trucks differ among themselves."""
    now, before = periods([{}] * BEFORE, [{}] + [{"crowd_friction": 180}] * 3, 2)
    a = judge(now, before)[1]
    began = a["history"]["began"]
    assert began["after_trucks"] == BEFORE + 1 and began["interval90_trucks"] == [BEFORE + 1] * 2
    assert any("after 1 of the measured trucks" in w for w in a["warnings"])


def test_what_no_effect_explains_has_a_day_too():
    now, before = periods([{}] * BEFORE, [{"outside": 3}] * TRUCKS, 3)
    a = judge(now, before)[1]
    assert a["verdict"] == "unknown" and a["history"]["effect"] is None
    assert a["history"]["began"]["after_trucks"] == BEFORE
    assert a["law"]["channel"] == "hoist_force_kN" and [x["term"] for x in a["law"]["terms"]] == ["swing moves"]
    assert np.mean([t["strength"] for t in a["history"]["trucks"][BEFORE:]]) == pytest.approx(1, abs=0.2)
