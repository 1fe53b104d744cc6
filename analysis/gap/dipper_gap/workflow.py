"""Steps 1 to 11: from a measured folder and a case to a verdict, a patched case and its confirmation.

Each stage is a function of the frozen values of those before it:

    make_plan   which runs are needed                        Plan
    learn       what they say of the unchanged case          Model
    predict     what a mine shows, with and without effects  Prediction
    compare     the mine's readings beside it                Part, Part
    look        where they disagree, and what explains it    Look
    confirm     fresh runs with what is named                Confirmation
    conclude    all of it, for report and gap.json           Outcome
"""
from dataclasses import dataclass, field, replace

import numpy as np

from .comparison_warnings import changing, other_faces, warnings, within
from .decision.confirm import confirm, drawn
from .decision.decide import OMNIBUS_P, PROBABILITY, Verdict, decide, sure
from .decision.law import find_laws, rival_law
from .decision.law_effect import law_effect
from .decision.next_experiment import propose
from .history import History, history, within_the_shift
from .model import Part, SignatureRuns, compare, learn, predict, predict_change, signature
from .readings.face import compare_faces
from .simulation.plan import FRESH_SEEDS, make_plan, statement, without_runs
from .simulation.simulator import request
from .statistics.isolability import Isolability, isolability, with_nuisances
from .statistics.localise import Disagreement, localise
from .statistics.match import Match, interval, match, stability
from .statistics.null import statistics

EARLY_P = 0.2           # omnibus p from which no more runs are made
SHARPENED = 2           # times an effect's strength is found anew, each with its signature at the last
SHARPENING_SEEDS = 4    # of the baseline's that it is observed or replayed with
TWO_SIDED_90 = 3.29     # a central 90 % interval of a Gaussian, in sd


@dataclass(frozen=True)
class Runner:
    """Makes runs of the case with effects, and reports them."""

    simulator: object
    catalogue: dict
    say: object
    kept: dict = field(default_factory=dict)   # {request: folder} of what has been asked for
    needed: set = field(default_factory=set)   # the runs that this has taken

    def run(self, strengths, seeds):
        return self._made([request(strengths, s, self.catalogue) for s in seeds])

    def folders(self, requests):
        """{request: folder}; each is made, and read, once."""
        new = [r for r in dict.fromkeys(requests) if r not in self.kept]
        self.kept.update(zip(new, self._made(new) if new else ()))
        return {r: self.kept[r] for r in requests}

    def runs(self, requests):
        """How many runs it has asked for, or would with these requests besides."""
        return len(self.needed.union(self.simulator.needed(requests)))

    def _made(self, requests):
        self.needed.update(self.simulator.needed(requests))
        return self.simulator.run(requests, self.say)


@dataclass(frozen=True)
class Look:
    """Where the training passes disagree, what explains it, and what may be said of it."""

    training: Part
    holdout: Part
    disagreement: Disagreement
    table: Isolability
    matched: Match
    verdict: Verdict
    signatures: tuple      # of all effects, over all passes, as they were matched


@dataclass(frozen=True)
class Named:
    """Of what the verdict names, after its confirmation."""

    verdict: Verdict
    confirmation: object
    effects: dict          # {name: strength}, the first leads; empty when it was not confirmed
    intervals: dict        # {name: [low, high]}
    stability: float       # share of resampled data in which it leads again
    second: dict = None


@dataclass(frozen=True)
class Outcome:
    """Everything the report and gap.json are made of."""

    look: Look             # its verdict is the one after the confirmation
    effects: dict = field(default_factory=dict)     # {name: strength} of what is named, the first leads
    intervals: dict = field(default_factory=dict)
    stability: float = 0.0
    confirmed: dict = field(default_factory=dict)   # {"training": Closure, "holdout": Closure}
    second: dict = None
    proposals: tuple = ()
    warnings: tuple = ()
    curves: list = field(default_factory=list)      # of the report: curves.Curve
    masses: list = field(default_factory=list)      # curves.Mass
    inflation: float = 1.0  # of the seeds' covariance
    early: bool = False     # it ended before the runs of effects, as there is no gap
    trucks: int = 1
    reference: int = 0      # trucks of the reference
    model_gap: float = None  # mean z^2 by which the reference differs from the model, in the model's own spread
    history: History = None  # truck by truck since the reference
    laws: tuple = ()        # decision.law.Law, one a force, where the catalogue has no name and the hold-out confirms
    added: object = None    # the Effect that they are
    known: object = None    # readings.fidelity.KnownErrors of the model, by which its runs were corrected
    faces: tuple = ()       # readings.face.FaceChange of the surveys of both periods
    runs: int = 0
    seeds: dict = field(default_factory=dict)


def analyse(measured, simulator, catalogue, first_seed=1, say=print, before=None):
    """The Outcome for a mine's folder, and one of its earlier trucks `before`; throws BadInput for one that cannot be
    compared with the case."""
    plan = make_plan(catalogue, len(measured.trucks()), first_seed, simulator.takes_a_run)
    first = without_runs(plan, simulator)
    say(f"gap: {statement(plan, simulator, first)}")
    runner, known = Runner(simulator, catalogue, say), (None, None)
    if len(first.signatures) < len(plan.signatures):
        known = learn_and_predict(first, measured, before, runner)
        if omnibus(known[1], *compare(*known, measured)) >= EARLY_P:
            left = len(plan.requests()) - len(first.requests())
            early = (f"it ended before {left} runs of effects on rock or motion: the {len(first.baseline)} plain runs "
                     "and the effects that need none show no gap to explain",)
            out = conclude(*known, measured, runner, before)
            return replace(out, early=True, warnings=(*out.warnings, *early))
    return conclude(*learn_and_predict(plan, measured, before, runner, known[0]), measured, runner, before)


def learn_and_predict(plan, measured, before, runner, earlier=None):
    """(Model, Prediction) from the runs of a plan, which are made; `earlier` is the Model of a part of them."""
    folders = runner.folders(plan.requests())
    model = learn(plan, folders, measured, before, runner.simulator.known, earlier)
    if before:
        return model, predict_change(model, runner.catalogue, measured, before)
    return model, predict(model, runner.catalogue, model.scatter(measured))


def omnibus(prediction, training, _):
    """p of the test whether there is a gap."""
    b = training.baseline
    return prediction.null.omnibus_p(statistics(training.y - b.mean, b.prediction, b.grid, prediction.directions))


def conclude(model, prediction, measured, runner, before=None):
    """From the readings to the verdict, its confirmation and what to do next."""
    seen = look(model, prediction, *compare(model, prediction, measured), runner)
    verdict = seen.verdict
    runner.say(f"gap: omnibus p {seen.disagreement.omnibus_p:.3g}; verdict {verdict.verdict}"
               + (f": {', '.join(verdict.members)}" if verdict.members else ""))
    known = runner.simulator.known
    out = Outcome(seen, warnings=warnings(model, prediction, measured, before, known), inflation=model.inflation,
                  trucks=len(measured.trucks()), known=known,
                  seeds={"baseline": [r.seed for r in model.plan.baseline]})
    after = ()
    if verdict.verdict == "named":
        named = add_and_confirm(model, prediction, seen, runner, measured, before)
        fresh, after = named.confirmation, named.confirmation.folders
        out = replace(out, look=replace(seen, verdict=named.verdict), effects=named.effects,
                      intervals=named.intervals, stability=named.stability, second=named.second,
                      confirmed={"training": fresh.training, "holdout": fresh.holdout},
                      seeds={**out.seeds, "fresh": fresh.seeds})
    elif verdict.verdict == "class":
        out = replace(out, intervals={n: interval(seen.matched, n, seen.training.signatures)
                                      for n in verdict.members})
    prediction = replace(prediction, signatures=seen.signatures)
    if before:
        reference = prediction.baseline.reference
        names = list(out.effects) or [n for n in out.look.verdict.members[:1]]
        out = replace(out, reference=reference.trucks, model_gap=model_gap(prediction.baseline),
                      faces=compare_faces(measured, before))
        out = replace(out, warnings=(*out.warnings, *other_faces(out.faces)))
        if out.look.verdict.verdict != "no-gap":
            by_truck = history(model, prediction, names, seen.training.at, measured, before)
            out = replace(out, history=by_truck, warnings=(*out.warnings, *within(by_truck, reference.trucks)))
    elif out.effects:
        by_truck = within_the_shift(model, prediction, list(out.effects), measured)
        out = replace(out, history=by_truck, warnings=(*out.warnings, *changing(by_truck, runner.catalogue)))
    if out.look.verdict.verdict == "unknown":
        out, with_them = with_laws(out, model, prediction, measured, runner, before)
        after = with_them or after
    lines, loads = drawn(model, prediction, seen.holdout, measured, after, before)
    return replace(out, curves=lines, masses=loads, proposals=tuple(experiments(out)),
                   runs=runner.runs(model.plan.requests()))


def with_laws(out, model, prediction, measured, runner, before):
    """The outcome with laws of the motion, if there are any, and the folders of the runs with them; unchanged but for
    the reasons where the hold-out does not confirm them."""
    seen = out.look
    laws = find_laws(model, prediction.baseline, seen.holdout.passes, measured, before)
    if not laws:
        return out, ()
    effect = law_effect(laws)
    runner.say(f"gap: a law of the motion: {effect.signature}; {FRESH_SEEDS} fresh runs with it")
    knows = replace(runner, simulator=runner.simulator.with_effect(effect),
                    catalogue={**runner.catalogue, effect.name: effect})
    seeds = [r.seed for r in model.plan.baseline]
    runs = SignatureRuns((1.0,) * len(seeds), tuple(range(len(seeds))), model.of_runs(knows.run({effect.name: 1.0},
                                                                                                seeds)), True)
    shown = signature(effect, prediction.baseline, runs)
    training, holdout = (replace(p, signatures=[*p.signatures, shown.part(p.at)])
                         for p in (seen.training, seen.holdout))
    fresh = confirm(model, training, holdout, seen.matched, {effect.name: 1.0}, knows)
    objections = fresh.holdout.objections() if fresh.holdout.reaches else ["it does not act"]
    if objections:
        reasons = (*seen.verdict.reasons, *(f"a law ({effect.signature}) was added, but on the hold-out {o}"
                                            for o in objections))
        return replace(out, look=replace(seen, verdict=replace(seen.verdict, reasons=reasons))), ()
    return replace(out, laws=laws, added=effect,
                   confirmed={"training": fresh.training, "holdout": fresh.holdout},
                   seeds={**out.seeds, "fresh": fresh.seeds}), fresh.folders


def model_gap(b):
    """Mean square of what the reference differs by from the model, in the sd that the difference should have."""
    plain = replace(b, reference=None, scatter=1.0, trucks=b.reference.trucks, own=b.reference.own,
                    common=b.reference.common)
    return float(np.mean((b.reference.shift / plain.sd) ** 2))


def look(model, prediction, training, holdout, runner):
    residual = training.y - training.baseline.mean
    disagreement = localise(residual, training.baseline, prediction.null, prediction.directions)
    table = isolability(training.signatures, training.covariance)
    matched = match(residual, training.covariance, training.signatures, training.baseline)
    shown = {s.name: s for s in prediction.signatures}
    for _ in range(SHARPENED if disagreement.omnibus_p < OMNIBUS_P else 0):
        better = _sharpened(model, prediction, training, matched, runner)
        if not better:
            break
        shown.update(better)
        training, holdout = _with_signatures(training, better), _with_signatures(holdout, better)
        known = {names: f for names, f in matched.fits.items() if not better.keys() & set(names)}
        matched = match(residual, training.covariance, training.signatures, training.baseline, known=known)
    verdict = decide(disagreement.omnibus_p, matched, training.signatures, training.covariance, training.plain,
                     residual, training.baseline, prediction.null)
    return Look(training, holdout, disagreement, table, matched, verdict, tuple(shown.values()))


def _sharpened(model, prediction, training, matched, runner):
    """{effect: signature} of the effects that need no run, at the strength they seem to have: not all are linear."""
    lead = max((s.name for s in training.signatures), key=matched.presence)
    fit = matched.fits[matched.best_with(lead)]
    seeds = [r.seed for r in model.plan.baseline[:SHARPENING_SEEDS]]
    better = {}
    for name, strength in zip(fit.names, fit.best):
        strength = float(f"{strength:.2g}")  # so that the next round, or another mine, hardly asks for new runs
        if model.runs[name].same_rock and strength:
            values = model.of_runs(runner.run({name: strength}, seeds))
            runs = SignatureRuns((strength,) * len(seeds), tuple(range(len(seeds))), values, True)
            better[name] = signature(runner.catalogue[name], prediction.baseline, runs).inflated(prediction.inflation)
    return better


def _with_signatures(part, better):
    made = [better[s.name].part(part.at) if s.name in better else s for s in part.signatures]
    return replace(part, signatures=made)


def add_and_confirm(model, prediction, seen, runner, measured, before=None):
    """Adds what is named to the case, confirms it on the hold-out, and looks for a second effect."""
    m, verdict, signatures = seen.matched, seen.verdict, seen.training.signatures
    lead = verdict.effect
    fit = m.fits[sure(m, lead)]
    names = [lead] + [n for n in fit.names if n != lead]
    strengths = {n: float(fit.best[fit.names.index(n)]) for n in names}
    intervals = {n: interval(m, n, signatures, fit.names) for n in names}
    stable = stability(m, lead, seen.training.covariance, signatures)
    runner.say(f"gap: {FRESH_SEEDS} fresh runs with {as_text(strengths)}")
    # A force that follows from the motion otherwise than the named effect has it does better than the name.
    law = None
    if model.runs[lead].same_rock:
        law = rival_law(model, prediction.baseline, seen.holdout.passes, measured, before)
    fresh = confirm(model, seen.training, seen.holdout, m, strengths, runner, law)
    objections = fresh.holdout.objections()
    if objections:
        runner.say("gap: not confirmed: " + "; ".join(objections))
        probability = m.probability["unknown"]
        verdict = replace(verdict, verdict="unknown", effect="", members=(), probability=probability, reasons=tuple(
            f"{as_text(strengths)} was added, but on the hold-out {o}" for o in objections))
        return Named(verdict, fresh, {}, intervals, stable)
    if not fresh.holdout.reaches:
        verdict = replace(verdict, reasons=(
            f"{as_text(strengths)} does not act on the hold-out passes: confirmed on training only",))
    named = Named(verdict, fresh, strengths, intervals, stable)
    if len(names) > 1:
        return _with_second(named, m, names[1], strengths[names[1]], intervals[names[1]], runner.catalogue)
    return look_again(model, prediction, seen.training, named, runner.catalogue)


def look_again(model, prediction, training, named, catalogue):
    """A second effect, where the first leaves more than noise on the training passes.

    Both are matched together; the first one's signature also knows the fresh runs, where it needed runs.
    """
    [(first, strength)] = named.effects.items()
    after = named.confirmation.after
    index = {s.name: k for k, s in enumerate(training.signatures)}
    runs, signatures = model.runs[first], list(training.signatures)
    if not runs.same_rock:
        more = replace(runs, strengths=runs.strengths + (strength,) * len(after),
                       seed_index=runs.seed_index + (None,) * len(after), values=np.vstack([runs.values, after]))
        known = signature(catalogue[first], prediction.baseline, more).inflated(prediction.inflation)
        signatures[index[first]] = known.part(training.at)
    g = signatures[index[first]].g
    left = training.y - after[:, training.at].mean(axis=0)
    low, high = named.intervals[first]
    # What is not known of the first effect, its strength and what its model gets wrong, is no second one.
    unsure = ((high - low) / TWO_SIDED_90) ** 2 * np.outer(g, g) + strength**2 * signatures[index[first]].wrong
    covariance = with_nuisances(training.baseline.against(len(after)) + unsure, training.nuisances)
    if prediction.null.plain().omnibus_p(statistics(left, covariance, training.baseline.grid)) >= OMNIBUS_P:
        return named
    m = match(training.y - training.baseline.mean, training.covariance, signatures, training.baseline)
    other = max((n for n in index if n != first), key=m.presence, default=None)
    if other is None or m.presence(first) < PROBABILITY or m.presence(other) < PROBABILITY:
        return replace(named, second={"verdict": "unknown"})
    fit = m.fits[m.best_with(other)]
    return _with_second(named, m, other, float(fit.best[fit.names.index(other)]), interval(m, other, signatures),
                        catalogue)


def _with_second(named, m, name, strength, interval90, catalogue):
    rejected = tuple(r for r in named.verdict.rejected if r[0] != name)
    second = {"verdict": "named", "effect": name, "probability": m.presence(name),
              "parameter": {"name": catalogue[name].parameter, "unit": catalogue[name].unit, "estimate": strength,
                            "interval90": list(interval90)}}
    return replace(named, verdict=replace(named.verdict, rejected=rejected), second=second,
                   intervals={**named.intervals, name: interval90})


def experiments(out):
    """Experiments for whatever is still open: the class, or every effect that is not ruled out."""
    if out.look.verdict.verdict in ("named", "no-gap"):
        return []
    names = out.look.verdict.members or [s.name for s in out.look.training.signatures]
    weights = {n: out.look.matched.presence(n) for n in names}
    if out.look.verdict.verdict != "class":  # hardly anything is known: the catalogue as it stands
        weights = {n: w + 1.0 / len(names) for n, w in weights.items()}
    return propose(weights)


def as_text(strengths):
    return ", ".join(f"{n} {s:.3g}" for n, s in strengths.items())
