"""What the runs say of a mine's passes: the unchanged case, its spread from seed to seed, and each effect.

Two stages, each a function of values that do not change: `learn` takes the runs, `predict` what is known of the
mine beside its readings. A mine's values enter neither, so one model serves all mines that log the same.
"""
from dataclasses import dataclass, replace

import numpy as np

from dipper_run.findings import BadInput

from .readings.channels import FACE, MASS
from .readings.passes import common_passes, split
from .readings.rest import at_rest
from .readings.vectors import Vectors, indices_of
from .simulation.plan import Plan
from .statistics.baseline import Baseline, make_baseline, scatter
from .statistics.isolability import with_nuisances
from .statistics.left_out import left_out_trucks
from .statistics.match import gains
from .statistics.null import Null, Tails, find_tails, left_out_inflation, simulate_null
from .statistics.reference import Reference, drift_sigmas, spread_over, with_scatter
from .statistics.signatures import deviations, fit_signature

LEFT_OUT_DRAWS = 200


@dataclass(frozen=True)
class SignatureRuns:
    strengths: tuple
    seed_index: tuple    # of the baseline's runs; None where the seed is another
    values: np.ndarray   # (J, n)
    same_rock: bool      # observed or replayed, not run


@dataclass(frozen=True)
class Model:
    """Over the cells that mine and runs share; of the mine it holds channels, trucks and passes, no reading."""

    plan: Plan
    passes: tuple         # numbers of all passes, training and held out
    vectors: Vectors
    baseline: Baseline    # its trucks scatter as its seeds do
    bias: np.ndarray      # (channels, n): shift by a constant in one channel
    runs: dict            # {effect: SignatureRuns}
    responses: tuple      # channels that answer, in the order of the instruments' shared errors
    tails: Tails
    inflation: float      # of the seeds' covariance, as leaving each seed out in turn asks
    folders: tuple        # of the baseline's runs
    rows: dict            # {request: (cells, features)} of every run, over the cells that it has

    def of_runs(self, folders):
        """(runs, n) features of noise-free folders."""
        rows = (self.vectors.of_run(m) for m in folders)
        return np.array([row[indices_of(self.baseline.cells, cells)] for cells, row in rows])

    def of_mine(self, measured):
        """(trucks, n) features of a mine's folder."""
        cells, rows, _ = self.vectors.of_mine(measured)
        return rows[:, indices_of(self.baseline.cells, cells)]

    def scatter(self, measured):
        """How much a mine's trucks vary in the training passes, in variances of the model's runs."""
        part, at = self.baseline.part(split(self.passes)[0])
        return scatter(self.of_mine(measured)[:, at], np.diag(part.own), np.diag(part.seed))

    def reference(self, measured, before):
        """The folder `before` of earlier trucks as the Reference of a mine's folder."""
        seen = before.seen_by(measured.channels)
        cells = self.baseline.cells
        then = Vectors(seen.channels, self.passes, self.folders)
        at = indices_of(cells, then.cells)
        models = np.mean([row[indices_of(cells, of)] for of, row in map(then.of_run, self.folders)], axis=0)
        of, rows, _ = then.of_mine(seen)
        rows = rows[:, indices_of(cells, of)]
        drift = self.bias * drift_sigmas(measured.channels, seen.channels, self.responses)[:, None]
        common = self.bias * np.array([seen.channels[n].common_sigma for n in self.responses])[:, None]
        mean = rows.mean(axis=0)
        return Reference(rows - mean, then.own[np.ix_(at, at)], common, drift, mean - models)


@dataclass(frozen=True)
class Prediction:
    """What is to be expected of a mine whose trucks vary so much, with and without each effect."""

    baseline: Baseline
    signatures: tuple       # of all effects, over all passes
    directions: np.ndarray  # (training cells, K) in which the null looks
    null: Null
    inflation: float        # of what few runs tell of the seeds, for fits along the signatures


@dataclass(frozen=True)
class Part:
    """Training or hold-out passes: what was measured there, and what the model says."""

    passes: tuple
    y: np.ndarray
    baseline: Baseline
    signatures: list
    nuisances: list
    plain: np.ndarray        # covariance of the prediction, nuisances included
    covariance: np.ndarray   # the same, inflated for what few runs leave unknown of the seeds'
    bias: np.ndarray         # (channels, n): shift by a constant in one channel
    at: list                 # these cells among those of all passes


def response_names(measured):
    """Channels that answer, in the order of the instruments' shared errors."""
    return (*measured.responses(), *(n for n in (MASS, FACE) if n in measured.channels))


def learn(plan, folders, measured, before=None, known=None, earlier=None):
    """The model from the runs {request: folder} of a plan, for a mine that logs as `measured` does, and a reference
    that logs as `before` does. `known` are the KnownErrors by which the runs were corrected: what they leave unknown
    is an error that all trucks share. What an `earlier` Model of the same mine and fewer runs has read is not read
    again.
    """
    mines = [measured] + ([before.seen_by(measured.channels)] if before else [])
    numbers = common_passes(measured, [*folders.values(), *mines[1:]])
    base = [folders[r] for r in plan.baseline]
    if FACE in measured.channels and not all(FACE in m.channels for m in base):
        raise BadInput([f"{FACE}: channels.yaml declares it, but runs of this case have no faces; leave it out there"])
    known_rows = earlier.rows if earlier and earlier.passes == tuple(numbers) else {}
    vectors = earlier.vectors if known_rows else Vectors(measured.channels, numbers, base)
    mine_cells, *others = (vectors.of_mine(m)[0] for m in mines)
    mine_cells = [c for c in mine_cells if all(c in of for of in others)]
    if before:  # a peak is no difference of peaks: where mine and model differ, it may be another moment's
        mine_cells = [c for c in mine_cells if c.feature != "peak"]
    seen = {r: known_rows.get(r) or vectors.of_run(m) for r, m in folders.items()}
    everywhere = set(mine_cells).intersection(*(cells for cells, _ in seen.values()))
    cells = [c for c in mine_cells if c in everywhere]
    rows = {r: row[indices_of(cells, own)] for r, (own, row) in seen.items()}
    at = indices_of(cells, vectors.cells)
    baseline, keep = make_baseline(cells, np.array([rows[r] for r in plan.baseline]), vectors.own[np.ix_(at, at)],
                                   vectors.common[:, at], numbers, len(measured.trucks()))
    baseline = replace(baseline, rest=at_rest(base[0], baseline.cells))
    runs = {n: SignatureRuns(tuple(p.strength for p in planned), tuple(p.seed_index for p in planned),
                             np.array([rows[p.request][keep] for p in planned]), planned[0].same_rock)
            for n, planned in plan.signatures.items()}
    ran = {plan.signatures[n][0].request: r for n, r in runs.items() if not r.same_rock}  # each run once
    baseline = baseline.with_deviations(np.concatenate(
        [baseline.more] + [deviations(r.strengths, r.seed_index, r.values, baseline) for r in ran.values()]))
    tails = find_tails(baseline)  # of any size: the same when inflated
    one = replace(baseline, trucks=1)
    inflation = left_out_inflation(one, simulate_null(one, draws=LEFT_OUT_DRAWS, tails=tails))
    bias = vectors.bias[:, at][:, keep]
    model = Model(plan, tuple(numbers), vectors, baseline.inflated(inflation), bias, runs, response_names(measured),
                  tails, inflation, tuple(base), seen)
    if not known:
        return model
    shared = np.vstack([baseline.common, known.directions(base, model.of_runs, baseline.cells)])
    return replace(model, baseline=replace(model.baseline, common=shared, altered=known.altered(base, model.of_runs)))


def predict(model, catalogue, trucks_scatter):
    """The prediction for a mine whose trucks vary so much (Model.scatter)."""
    return prediction_of(model, catalogue, replace(model.baseline, scatter=trucks_scatter))


def predict_change(model, catalogue, measured, before):
    """The prediction of what a mine's folder differs by from one of earlier trucks; both tell how trucks scatter."""
    now, reference = model.of_mine(measured), model.reference(measured, before)
    baseline = replace(model.baseline, reference=reference, scatter=np.ones(len(model.baseline.cells)))
    part, at = baseline.part(split(model.passes)[0])
    rows = now[:, at], reference.rows[:, at]
    part = with_scatter(part, *rows)
    baseline = replace(baseline, scatter=spread_over(baseline.cells, part.cells, part.scatter))
    signatures = signatures_of(model, catalogue, baseline)
    along = np.column_stack([s.g for s in signatures] + [gains(baseline)])
    part = with_scatter(replace(part, reference=replace(part.reference, along=along[at])), *rows)
    baseline = replace(baseline, reference=replace(reference, along=along, sizes=part.reference.sizes))
    return predicted(model, baseline.scattered(left_out_trucks(*rows, part, model.tails)), signatures)


def prediction_of(model, catalogue, baseline):
    """The prediction for a mine of which a baseline says what it reads."""
    return predicted(model, baseline, signatures_of(model, catalogue, baseline))


def signatures_of(model, catalogue, baseline):
    """Signatures of all effects over all passes of a baseline."""
    return [signature(catalogue[n], baseline, runs) for n, runs in model.runs.items()]


def predicted(model, baseline, signatures):
    """Likewise, with signatures that are fitted already."""
    training = split(model.passes)[0]
    part, at = baseline.part(training)
    named = [s.part(at) for s in signatures if not s.effect.nuisance]
    directions = np.column_stack([s.g for s in named] + [gains(part)])
    null = simulate_null(baseline, directions, passes=training, tails=model.tails)
    inflation = null.inflation(len(named))
    return Prediction(baseline, tuple(s.inflated(inflation) for s in signatures), directions, null, inflation)


def signature(effect, baseline, runs):
    return fit_signature(effect, baseline, runs.strengths, runs.seed_index, runs.values, runs.same_rock)


def compare(model, prediction, measured):
    """The training and the hold-out passes of a mine beside the prediction; what a reference differs by from the
    model at all times is taken off."""
    y = model.of_mine(measured).mean(axis=0)
    if prediction.baseline.reference:
        y = y - prediction.baseline.reference.shift
    return tuple(_part(model, prediction, passes, y) for passes in split(model.passes))


def _part(model, prediction, passes, y):
    baseline, at = prediction.baseline.part(passes)
    cut = [s.part(at) for s in prediction.signatures]
    nuisances = [s for s in cut if s.effect.nuisance]
    plain = with_nuisances(baseline.prediction, nuisances)
    inflated = with_nuisances(baseline.inflated(prediction.inflation).prediction, nuisances)
    return Part(passes, y[at], baseline, [s for s in cut if not s.effect.nuisance], nuisances, plain, inflated,
                model.bias[:, at], at)
