"""The whole chain on the synthetic shovel: found, named, added, confirmed on hold-out; and its papers."""
import functools
import json
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import fake_mine
import synthetic
from dipper_gap.answer import write_answer
from dipper_gap.comparison_warnings import changing
from dipper_gap.decision.decide import Verdict
from dipper_gap.gap_json import as_json, write_json
from dipper_gap.history import within_the_shift
from dipper_gap.readings.measured import write_measured
from dipper_gap.model import learn, predict
from dipper_gap.readings.passes import split
from dipper_gap.readings.vectors import Vectors
from dipper_gap.statistics.closure import Closure
from dipper_gap.simulation.plan import LEAST_SEEDS, make_plan, statement
from dipper_gap.report import page
from dipper_gap.workflow import Named, Runner, analyse, compare, conclude, look_again
from dipper_run.findings import BadInput
from trucks import in_a_row

pytestmark = pytest.mark.usefixtures("few_draws")
# Fewer effects than the whole catalogue: a test needs seconds, not a minute.
SMALL = {n: fake_mine.CATALOGUE[n]
         for n in ("fines", "crowd_friction", "scale_gain", "cohesion", "truck_spillage", "density")}


def mine_with(truth, seed):
    return synthetic.with_noise(synthetic.run(truth, seed=900 + seed), seed)


def answer(out):
    return as_json(out, SMALL, {"case": "0" * 64})


@functools.lru_cache(None)
def known(trucks):
    """(Model, Prediction) of mines with so many trucks that scatter as the seeds do: the costly part of an analysis,
    the same for all of them; and the simulator that was asked."""
    plan, simulator = make_plan(SMALL, trucks, 1), fake_mine.FakeSimulator()
    folders = dict(zip(plan.requests(), simulator.run(plan.requests())))
    model = learn(plan, folders, in_a_row([synthetic.run()] * trucks))
    return model, predict(model, SMALL, 1.0), simulator


def judge(mine):
    """(Outcome, gap.json, simulator of what is run beside the planned) of a mine: `analyse` with what is known."""
    simulator = fake_mine.FakeSimulator()
    model, prediction, _ = known(len(mine.trucks()))
    assert model.scatter(mine) == 1.0
    out = conclude(model, prediction, mine, Runner(simulator, SMALL, lambda text: None))
    return out, answer(out), simulator


@pytest.fixture(scope="module")
def fines():
    return judge(mine_with({"fines": 0.2}, 1))


def test_split_keeps_the_first_and_last_of_three_for_training():
    assert split([1, 2, 3]) == ((1, 3), (2,))
    assert split([1, 2]) == ((1,), (2,))
    assert split([1, 2, 3, 4, 5, 6]) == ((1, 3, 4, 6), (2, 5))


def test_a_hidden_effect_is_found_named_added_and_confirmed(fines):
    _, a, _ = fines
    assert a["verdict"] == "named" and a["effect"] == "fines"
    assert a["parameter"]["estimate"] == pytest.approx(0.2, rel=0.35)  # its signature is of three chaotic runs
    assert a["gap"]["holdout_closure"] > 0.6 and a["gap"]["holdout_p"] < 0.01
    assert a["gap"]["after"] < 0.5 * a["gap"]["before"]
    assert a["patch"] == {"effects.fines": pytest.approx(a["parameter"]["estimate"], rel=1e-5)}
    assert any(d["channel"] == "truck_mass_t" for d in a["disagreement"])


def test_the_case_of_an_earlier_answer_does_not_stay_beside_a_new_one(fines, tmp_path):
    mine = mine_with({}, 3)
    write_measured(mine, tmp_path / "measured")
    (tmp_path / "one").mkdir()
    (tmp_path / "one/case.yaml").write_text("seed: 1\n")
    (tmp_path / "out/case").mkdir(parents=True)
    (tmp_path / "out/case/case.yaml").write_text("seed: 2\n")
    simulator = fake_mine.FakeSimulator()
    simulator.case = tmp_path / "one"

    def written(out):
        return write_answer(out, SMALL, simulator, tmp_path / "measured", tmp_path / "out")

    with pytest.raises(BadInput, match="out/case is there, and no earlier answer's; choose another --out"):
        written(fines[0])
    (tmp_path / "out/case/case.yaml").unlink()
    (tmp_path / "out/case").rmdir()
    assert tmp_path / "out/case" in written(fines[0]) and "fines: " in (tmp_path / "out/case/case.yaml").read_text()
    assert tmp_path / "out/case" in written(fines[0])
    (tmp_path / "out/case/notes.txt").write_text("mine")
    none = judge(mine)[0]
    assert none.look.verdict.verdict == "no-gap" and tmp_path / "out/case" not in written(none)
    assert [f.name for f in (tmp_path / "out/case").iterdir()] == ["notes.txt"]


def test_the_json_is_the_contract(fines, tmp_path):
    write_json(fines[1], tmp_path / "gap.json")
    a = json.loads((tmp_path / "gap.json").read_text())
    assert {"verdict", "effect", "class", "probability", "parameter", "disagreement", "confusable", "gap",
            "rejected", "patch", "runs", "seeds", "hashes"} <= set(a)
    assert set(a["parameter"]) == {"name", "unit", "estimate", "interval90"}
    assert {"before", "after", "floor", "closure", "holdout_closure", "holdout_p"} <= set(a["gap"])
    assert all({"pass", "phase", "channel", "z", "p_adjusted"} <= set(d) for d in a["disagreement"])
    assert all({"effect", "distinguishability"} <= set(d) for d in a["confusable"])
    assert all({"effect", "probability", "reason"} <= set(d) for d in a["rejected"])


def test_observation_effects_cost_no_run_and_the_count_is_printed_before(fines):
    _, a, simulator = fines
    model, _, before = known(1)
    # Baseline runs; three each of fines, crowd friction, cohesion and density; five to confirm.
    assert len(before.made) == LEAST_SEEDS + 4 * 3 and len(simulator.made) == 5
    assert a["runs"] == LEAST_SEEDS + 4 * 3 + 5
    assert re.search(rf"\b{LEAST_SEEDS + 12} runs, 0 of them kept", statement(model.plan, before))


def test_the_page_has_what_it_draws(fines):
    out, a, _ = fines
    data = json.loads(json.dumps(page(out, a, SMALL, "synthetic"), allow_nan=False))
    assert data["kind"] == "gap" and data["answer"] == json.loads(json.dumps(a))
    assert data["ranking"][0]["effect"] == "fines" and len(data["ranking"]) == 5  # density is a nuisance
    searched = [c for c in data["cells"] if "p_adjusted" in c]
    assert {c["pass"] for c in searched} == set(data["passes"]["training"]) == {1, 3}
    assert {c["pass"] for c in data["cells"]} == {1, 2, 3} and all("z_after" in c for c in data["cells"])
    assert [c for c in searched if c["p_adjusted"] <= data["cell_p"]]
    assert set(data["apart"]["names"]) == set(SMALL) - {"density"} == {r["effect"] for r in data["ranking"]}
    assert len(data["curves"]) == 6 and [c["held_out"] for c in data["curves"]] == [False] * 4 + [True] * 2
    for c in data["curves"]:
        assert len(c["time_s"]) == len(c["measured"]) == len(c["before"]) == len(c["spread"]) == len(c["after"])
        ends = list(c["phases"].values())
        assert ends[0][0] == 0 and all(x[1] == y[0] for x, y in zip(ends, ends[1:]))
    assert set(data["closures"]) == {"training", "holdout"} and data["masses"][0]["after"] is not None


def test_nothing_hidden_is_no_gap():
    _, a, simulator = judge(mine_with({}, 3))
    assert a["verdict"] == "no-gap" and a["patch"] == {} and a["effect"] is None
    assert a["runs"] == LEAST_SEEDS + 12 and not simulator.made  # nothing to confirm


def test_no_gap_ends_before_the_runs_of_effects_and_says_so():
    simulator, said = fake_mine.FakeSimulator(), []
    out = analyse(mine_with({}, 5), simulator, SMALL, 1, said.append)
    a = answer(out)
    assert a["verdict"] == "no-gap" and a["ended_early"] and a["omnibus_p"] >= 0.2
    assert len(simulator.made) == a["runs"] == LEAST_SEEDS
    assert any("ended before 12 runs" in w for w in a["warnings"])
    assert f"; {LEAST_SEEDS} of them decide whether there is a gap at all" in said[0]
    page(out, a, SMALL, "synthetic")


def test_each_run_is_asked_for_and_read_once(monkeypatch):
    """Where the analysis does not end early it learns from all runs what it has not read before."""
    asked, read = [], []
    simulator = fake_mine.FakeSimulator()
    run, of_run = simulator.run, Vectors.of_run
    monkeypatch.setattr(simulator, "run", lambda requests, say=print: asked.extend(requests) or run(requests, say))
    monkeypatch.setattr(Vectors, "of_run", lambda self, m: read.append(m) or of_run(self, m))
    monkeypatch.setattr("dipper_gap.workflow.conclude", lambda model, *_: model)
    model = analyse(mine_with({"fines": 0.2}, 1), simulator, SMALL, 1, lambda text: None)
    plan = make_plan(SMALL, 1, 1)
    assert sorted(map(str, asked)) == sorted(map(str, plan.requests())) and len(read) == len(asked)
    whole = learn(plan, dict(zip(plan.requests(), fake_mine.FakeSimulator().run(plan.requests()))),
                  mine_with({}, 1))
    assert np.array_equal(model.baseline.seed, whole.baseline.seed) and model.inflation == whole.inflation


def test_an_effect_outside_the_catalogue_is_unknown_with_a_law_that_closes_the_gap():
    out, a, simulator = judge(mine_with({"outside": 3}, 4))
    assert a["verdict"] == "unknown" and a["effect"] is None and a["next_experiment"]
    law = a["law"]
    assert {law["channel"], *(other["channel"] for other in law["also"])} == {"hoist_force_kN", "crowd_force_kN"}
    assert law["terms"] == [{"term": "swing moves", "kN": pytest.approx(180, rel=0.1)}]
    assert a["patch"] == {"effects.motion_law": 1.0} and a["gap"]["holdout_closure"] > 0.6
    assert len(simulator.laws) == 1 and a["runs"] == LEAST_SEEDS + 12 + 5
    data = page(out, a, SMALL, "synthetic")
    assert data["experiments"] and set(data["closures"]) == {"training", "holdout"}


def test_runs_that_a_failed_name_and_a_law_share_are_counted_once(monkeypatch):
    """Both are read from the same plain runs of fresh seeds."""
    monkeypatch.setattr("dipper_gap.workflow.decide", lambda *_: Verdict("named", "scale_gain", ("scale_gain",)))
    _, a, simulator = judge(mine_with({"outside": 3}, 4))
    assert a["verdict"] == "unknown" and a["law"] and any("scale_gain" in r for r in a["reasons"])
    assert a["runs"] == LEAST_SEEDS + 12 + 5


def test_a_law_that_does_not_act_on_the_hold_out_is_not_confirmed(monkeypatch):
    monkeypatch.setattr("dipper_gap.statistics.closure.REACH", np.inf)
    _, a, _ = judge(mine_with({"outside": 3}, 4))
    assert a["law"] is None and any("but on the hold-out it does not act" in r for r in a["reasons"])


def test_runs_of_a_law_that_fails_are_counted(monkeypatch):
    monkeypatch.setattr(Closure, "objections", lambda self: ["the gap grows"])
    _, a, _ = judge(mine_with({"outside": 3}, 4))
    assert a["law"] is None and any("but on the hold-out the gap grows" in r for r in a["reasons"])
    assert a["runs"] == LEAST_SEEDS + 12 + 5


def test_what_is_no_law_of_the_motion_is_unknown_without_one():
    """A force in fits and starts: nothing in the catalogue, and no term of the motion."""
    mine = mine_with({}, 4)
    fits = 400 * (np.random.default_rng(1).random(len(mine.time_s)) < 0.2)
    mine = replace(mine, signals={**mine.signals, "crowd_force_kN": mine.signals["crowd_force_kN"] + fits})
    out, a, _ = judge(mine)
    assert a["verdict"] == "unknown" and a["law"] is None and a["patch"] == {}
    assert page(out, a, SMALL, "synthetic")["closures"] == {}


def test_an_effect_that_skips_the_hold_out_is_named_but_says_so():
    _, a, _ = judge(mine_with({"truck_spillage": 15}, 5))
    assert a["verdict"] == "named" and a["effect"] == "truck_spillage"
    assert a["gap"]["holdout_closure"] is None and "does not act on the hold-out" in a["reasons"][0]


def test_a_second_effect_shows_beside_the_first():
    _, a, _ = judge(mine_with({"fines": 0.25, "crowd_friction": 120}, 6))
    assert a["verdict"] == "named"
    named = {a["effect"], a["second"]["effect"]}
    assert named == {"fines", "crowd_friction"} and not named & {r["effect"] for r in a["rejected"]}


def test_what_the_model_of_an_effect_gets_wrong_is_no_second_effect():
    """One that differs from its model by two sd of what is assumed, along what errs most, and leaves nothing else."""
    model, prediction, _ = known(6)
    training = compare(model, prediction, in_a_row([synthetic.run()] * 6))[0]
    s = next(s for s in training.signatures if s.name == "fines")
    strength, (variance, shapes) = 0.3, np.linalg.eigh(s.wrong)
    full = next(s for s in prediction.signatures if s.name == "fines").g
    after = model.baseline.mean + strength * full + np.zeros((5, 1))
    seen = training.baseline.mean + strength * (s.g + 2 * np.sqrt(variance[-1]) * shapes[:, -1])
    named = Named(Verdict("named", "fines"), SimpleNamespace(after=after), {"fines": strength},
                  {"fines": [0.28, 0.32]}, 1)
    assert look_again(model, prediction, replace(training, y=seen), named, SMALL).second is None


def test_masses_alone_cannot_tell(tmp_path):
    """The paper's table: 85, 80, 68 t measured; a model at 83.6, 77.6, 73.6 t. p is not decisive."""
    runs = synthetic.run(seed=1)
    mine = replace(runs, channels={"truck_mass_t": runs.channels["truck_mass_t"]}, signals={},
                   time_s=runs.time_s[:0], passes=tuple(replace(p, truck_mass_t=m) for p, m in
                                                        zip(runs.passes, (85.0 - 3.6, 80.0 + 2.4, 68.0 + 6.4))))
    write_measured(mine, tmp_path / "m")
    out = analyse(mine, MassOnly(), SMALL, 1, lambda _: None)
    assert out.look.verdict.verdict != "named"


def test_several_trucks_show_what_one_does_not():
    """An effect that one truck leaves in noise; its strength comes out, and the trucks are counted."""
    weak = {"fines": 0.06}
    trucks = [synthetic.run(weak, seed=950 + k) for k in range(6)]
    few, many = (judge(synthetic.with_noise(in_a_row(t), 8))[1] for t in (trucks[:1], trucks))
    assert few["verdict"] == "no-gap" and few["trucks"] == 1
    assert many["verdict"] == "named" and many["effect"] == "fines" and many["trucks"] == 6
    assert many["parameter"]["estimate"] == pytest.approx(0.06, rel=0.5)  # d 4, and a signature of three runs


def test_an_effect_that_grows_within_the_shift_is_reported():
    """Friction of 20 to 170 kN over six trucks: its growth is said; that of constant friction is none."""
    histories = {}
    for name, kN in (("grows", np.arange(20, 180, 30)), ("stays", np.full(6, 95))):
        trucks = [synthetic.run({"crowd_friction": float(s)}, seed=960 + k) for k, s in enumerate(kN)]
        mine = synthetic.with_noise(in_a_row(trucks), 9)
        _, prediction, _ = known(6)
        histories[name] = within_the_shift(known(6)[0], prediction, ["crowd_friction"], mine)
    assert histories["stays"] is None
    history = histories["grows"]
    assert history.effect == "crowd_friction" and len(history.trucks) == 6
    assert history.trend.shape != "step" and history.trend.size == pytest.approx(150, rel=0.3)
    [text] = changing(history, SMALL)
    assert text.startswith("crowd_friction is not the same in all trucks: it changes by 1")


class MassOnly(fake_mine.FakeSimulator):
    def _one(self, r):
        m = super()._one(r)
        return replace(m, signals={}, time_s=m.time_s[:0])


def test_a_mine_may_log_less_than_the_model():
    """Masses alone: a scale's gain may be found, a force's effect not, and nothing breaks."""
    mine = synthetic.with_noise(synthetic.run({"crowd_friction": 300}, seed=905), 5)
    only = {n: c for n, c in mine.channels.items() if n == "truck_mass_t"}
    out = analyse(mine.seen_by(only), fake_mine.FakeSimulator(), SMALL, 1, lambda text: None)
    assert {c.channel for c in out.look.training.baseline.cells} == {"truck_mass_t"}
    assert out.look.verdict.verdict == "no-gap"
    page(out, answer(out), SMALL, "synthetic")
    heavy = mine_with({"scale_gain": 0.3}, 5).seen_by(only)
    assert analyse(heavy, fake_mine.FakeSimulator(), SMALL, 1, lambda text: None).look.verdict.verdict != "no-gap"


def test_what_goes_the_way_no_effect_can_is_unknown():
    """The last pass brings more, which a spillage cannot: its best strength is 0, where nothing is to be sharpened."""
    few = {n: SMALL[n] for n in ("truck_spillage", "density")}
    mine = mine_with({"truck_spillage": -25}, 5)
    out = analyse(mine, fake_mine.FakeSimulator(), few, 1, lambda text: None)
    assert out.look.verdict.verdict == "unknown"


def test_a_survey_is_refused_where_the_runs_have_no_faces():
    mine = synthetic.with_noise(synthetic.run(seed=905, faces=True), 5)
    with pytest.raises(BadInput, match="face_m: channels.yaml declares it"):
        analyse(mine, fake_mine.FakeSimulator(), SMALL, say=lambda text: None)
