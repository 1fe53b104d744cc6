"""A law is found for what follows from the motion, with its form and size; for nothing, none."""
import functools
from dataclasses import replace

import numpy as np
import pytest

import fake_mine
import synthetic
from dipper_gap.decision.law import FORMS, _readings, find_laws
from dipper_gap.decision.law_effect import effect_text, law_effect
from dipper_gap.model import learn
from dipper_gap.simulation.plan import make_plan
from dipper_gap.simulation.effects import read_catalogue
from other_mine import periods
from trucks import in_a_row

TRUCKS, BEFORE = 4, 6


@functools.lru_cache(None)
def model():
    plan, simulator = make_plan({}, TRUCKS, 1), fake_mine.FakeSimulator()
    folders = dict(zip(plan.requests(), simulator.run(plan.requests())))
    return learn(plan, folders, in_a_row([synthetic.run()] * TRUCKS))


def laws(effects, number):
    now, before = periods([{}] * BEFORE, [effects] * TRUCKS, number)
    baseline = replace(model().baseline, reference=model().reference(now, before),
                       scatter=np.ones(len(model().baseline.mean)))
    return find_laws(model(), baseline, (2,), now, before)


# What this mine's hoist shows to 112 %, and its crowd to 85 %: three outside effects of three kinds, each at two sizes,
# and friction, which the catalogue has.
@pytest.mark.parametrize("effects, channel, term, kN", [
    ({"outside": 1}, "hoist_force_kN", "swing moves", 1.12 * 60),
    ({"outside": 3}, "hoist_force_kN", "swing moves", 1.12 * 180),
    ({"bent_handle": 40}, "crowd_force_kN", "crowd drag", 0.85 * 40),
    ({"bent_handle": 80}, "crowd_force_kN", "crowd drag", 0.85 * 80),
    ({"cable": 60}, "crowd_force_kN", "swing angle", 0.85 * 60),
    ({"cable": 120}, "crowd_force_kN", "swing angle", 0.85 * 120),
    ({"zero": 60}, "hoist_force_kN", "constant", 1.12 * 60),
    ({"crowd_friction": 150}, "crowd_force_kN", "crowd direction", 0.85 * 150)])
def test_the_form_and_the_size_are_right(effects, channel, term, kN):
    found = {law.channel: law for law in laws(effects, 7)}[channel]
    assert found.terms == ((term, pytest.approx(kN, rel=0.15)),)
    assert found.explained > 0.6 and found.p <= 0.0125


def test_it_is_described_in_words():
    assert "as the crowd moves out, and -1" in laws({"crowd_friction": 150}, 7)[0].words


def test_a_pass_keeps_its_number_where_others_are_left_out():
    """Of passes 1 and 3 the second is the third, as in the run that is to show the law."""
    now, before = periods([{}] * BEFORE, [{}] * TRUCKS, 7)
    some = replace(now, passes=tuple(p for p in now.passes if p.number != 2))
    readings = dict(_readings(replace(model(), passes=(1, 3)), model().baseline, (3,), some, before))["hoist_force_kN"]
    numbers = readings.terms[:, FORMS.index("pass")]
    assert set(numbers) == {1, 3} and np.array_equal(numbers, readings.passes)


def test_nothing_has_no_law():
    assert [k for k in range(30, 40) if laws({}, k)] == []


def test_passes_that_begin_at_another_moment_have_no_law():
    """Half a second later in the cycle than the runs' passes: forces are read at the same moments of the motion."""
    late = replace(synthetic.run(), passes=tuple(replace(p, t_start_s=p.t_start_s + 0.5, t_end_s=p.t_end_s + 0.5 * (
        p.number < 3)) for p in synthetic.run().passes))
    trucks = [replace(synthetic.with_noise(synthetic.run(seed=9010 + k), 7 + k), passes=late.passes)
              for k in range(TRUCKS)]
    assert find_laws(model(), replace(model().baseline, trucks=TRUCKS), (2,), in_a_row(trucks)) == ()


def test_it_is_an_effect_that_the_program_reads(tmp_path):
    """Its file in a case's own folder: `dipper effects` lists it as it was found."""
    found = laws({"outside": 3}, 7)
    made = law_effect(found)
    (tmp_path / "case.yaml").write_text("")
    (tmp_path / "effects").mkdir()
    (tmp_path / "effects" / f"{made.name}.yaml").write_text(effect_text(made))
    read = read_catalogue(tmp_path)[made.name]
    assert read.overlay == made.overlay and read.signature == made.signature and read.affects == "instruments"
    assert {key.rsplit(".", 1)[1] for key, _, _ in read.overlay} == {"swing_kN"}
