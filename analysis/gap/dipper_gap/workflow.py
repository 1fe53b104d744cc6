"""Steps 1 to 11: from a measured folder and a case to a verdict, a patched case and its confirmation."""
from dataclasses import dataclass, field, replace

import numpy as np

from .baseline import make_baseline, scatter, seeds_for
from .closure import best_fit, closure
from .curves import curves, masses
from .decide import OMNIBUS_P, PROBABILITY, Verdict, decide, sure
from .isolability import isolability, with_nuisances
from .localise import localise
from .match import gains, interval, match, stability
from .measured import MASS
from .next_experiment import propose
from .null import find_tails, left_out_inflation, simulate_null, statistics
from .signatures import deviations, fit_signature
from .simulator import request
from .vectors import Vectors, places

NEED_PASSES = 2
SIGNATURE_RUNS = ((0, 0), (1, 1), (1, 2))  # (which of the two strengths, which of the baseline's seeds)
FRESH_SEEDS = 5
SHARPENED = 2           # times an effect's strength is found anew, each with its signature at the last
FRESH_FROM = 1000       # seeds of the confirming runs start so far above the baseline's
MOTION_TOLERANCE_S = 1.0
SCATTERS = 2.0          # variance of the trucks' passes, in the model's, from which the report says so
TWO_SIDED_90 = 3.29     # a central 90 % interval of a Gaussian, in sd


@dataclass(frozen=True)
class Part:
    """Training or hold-out passes: what was measured there, and what the model says."""

    passes: tuple
    y: np.ndarray
    baseline: object
    signatures: list
    nuisances: list
    plain: np.ndarray        # covariance of the prediction, nuisances included
    covariance: np.ndarray   # of the training passes: the same, wary of what few runs tell of the seeds'
    bias: np.ndarray         # (channels, n): shift by a constant in one channel
    at: list                 # these cells among those of all passes


@dataclass(frozen=True)
class SignatureRuns:
    strengths: tuple
    seed_index: tuple
    values: np.ndarray       # (J, n)
    same_rock: bool          # observed or replayed, not run


@dataclass
class Outcome:
    """Everything the report and gap.json are made of."""

    training: Part = None
    holdout: Part = None
    disagreement: object = None
    inflation: float = 1.0
    table: object = None
    matched: object = None
    verdict: Verdict = None
    effects: dict = field(default_factory=dict)     # {name: strength} of what is named, the first leads
    intervals: dict = field(default_factory=dict)
    stability: float = 0.0
    confirmed: dict = field(default_factory=dict)   # {"training": Closure, "holdout": Closure}
    second: dict = None
    proposals: list = field(default_factory=list)
    warnings: list = field(default_factory=list)
    curves: list = field(default_factory=list)      # of the report: curves.Curve
    masses: list = field(default_factory=list)      # curves.Mass
    trucks: int = 1
    runs: int = 0
    seeds: dict = field(default_factory=dict)


def split(numbers):
    """Training and hold-out passes: the second of every three is held out; of two, the last.

    The first and the last of three stay in training: some effects only show there.
    """
    held = [n for i, n in enumerate(numbers) if i % 3 == 1]
    return tuple(n for n in numbers if n not in held), tuple(held)


class Workflow:
    def __init__(self, measured, simulator, catalogue, first_seed=1, say=print):
        self.measured, self.simulator, self.catalogue = measured, simulator, catalogue
        self.first_seed, self.say = first_seed, say
        self.out = Outcome()

    def requests(self):
        """Baseline runs, and {effect: its signature runs}; effects with the same overlay share them."""
        seeds = [self.first_seed + k for k in range(seeds_for(len(self.measured.trucks())))]
        base = [request({}, s, self.catalogue) for s in seeds]
        made, shared = {}, {}
        for e in sorted(self.catalogue.values(), key=lambda e: e.nuisance):
            first = shared.setdefault(e.overlay or e.name, e)
            strengths = first.strengths(request({first.name: 1.0}, 0, self.catalogue).how != "run")
            made[e.name] = [(strengths[i], k, request({first.name: strengths[i]}, seeds[k], self.catalogue))
                            for i, k in SIGNATURE_RUNS]
        return base, made

    def statement(self):
        """What the analysis will take, before it starts."""
        base, made = self.requests()
        every = base + [r for rows in made.values() for _, _, r in rows]
        todo, kept, each = self.simulator.plan(every)
        fresh = f"{FRESH_SEEDS} more confirm a named effect"
        text = f"{todo + kept} runs, {kept} of them kept from before; {fresh}"
        if todo and each:
            text += f"; about {todo * each / 2 / 60:.0f} min, two at a time"
        elif todo:
            text += "; how long is told after the first"
        return text

    def run(self):
        self.say(f"gap: {self.statement()}")
        self.prepare()
        self.judge()
        return self.out

    def judge(self):
        """From the prepared residuals to the verdict, its confirmation and what to do next."""
        out = self.out
        self.look()
        self.say(f"gap: omnibus p {out.disagreement.omnibus_p:.3g}; verdict {out.verdict.verdict}"
                 + (f": {', '.join(out.verdict.members)}" if out.verdict.members else ""))
        if out.verdict.verdict == "named":
            self._add_and_confirm()
        else:
            self._draw([])
        if out.verdict.verdict == "class":
            self.out.intervals = {n: interval(out.matched, n, out.training.signatures)
                                  for n in out.verdict.members}
        self._next()

    def look(self):
        """Where the training passes disagree, what explains it, and what may be said of it."""
        out, null, directions = self.out, self.null, self.directions
        residual = out.training.y - out.training.baseline.mean
        out.disagreement = localise(residual, out.training.baseline, null, directions)
        out.table = isolability(out.training.signatures, out.training.covariance)
        out.matched = match(residual, out.training.covariance, out.training.signatures, out.training.baseline)
        for _ in range(SHARPENED if out.disagreement.omnibus_p < OMNIBUS_P else 0):
            self._sharpen(residual)
        out.verdict = decide(out.disagreement.omnibus_p, out.matched, out.training.signatures,
                             out.training.covariance, out.training.plain, residual, out.training.baseline, null)

    def features(self, measured):
        """(trucks, n) of a mine's folder over the cells of the prepared model."""
        cells, y, _ = self.vectors.of_mine(measured)
        return y[:, places(cells, self.common)]

    def _sharpen(self, residual):
        """Matches again, with the effects that need no run known at the strength they seem to have: not all are
        linear."""
        out, seeds, better = self.out, range(self.whole.seeds), {}
        lead = max((s.name for s in out.training.signatures), key=out.matched.presence)
        fit = out.matched.fits[out.matched.best_with(lead)]
        for name, strength in zip(fit.names, fit.best):
            if self.runs[name].same_rock:
                asked = [request({name: strength}, self.first_seed + k, self.catalogue) for k in seeds]
                values = self._features_of(self.simulator.run(asked, self.say))
                runs = SignatureRuns((strength,) * len(asked), tuple(seeds), values, True)
                better[name] = self._signature(name, runs)
        if not better:
            return
        for which in ("training", "holdout"):
            part = getattr(out, which)
            made = [better[s.name].part(part.at) if s.name in better else s for s in part.signatures]
            setattr(out, which, replace(part, signatures=made))
        known = {names: f for names, f in out.matched.fits.items() if not better.keys() & set(names)}
        out.matched = match(residual, out.training.covariance, out.training.signatures, out.training.baseline,
                            known=known)

    def _signature(self, name, runs):
        """Over all passes' cells; as wary as the null asks."""
        made = fit_signature(self.catalogue[name], self.whole, runs.strengths, runs.seed_index, runs.values,
                             runs.same_rock)
        return made.wary(self.wary)

    def prepare(self):
        """Runs what is needed; from it the baseline, the signatures and the null of both parts."""
        base, made = self.requests()
        rows = list(dict.fromkeys(base + [r for runs in made.values() for _, _, r in runs]))
        folders = dict(zip(rows, self.simulator.run(rows, self.say)))
        self.out.runs = len([r for r in rows if r.how == "run"])
        self.out.seeds = {"baseline": [r.seed for r in base]}
        common = set(p.number for p in self.measured.passes)
        for m in folders.values():
            common &= set(p.number for p in m.passes)
        numbers = sorted(common)
        if len(numbers) < NEED_PASSES:
            raise ValueError(f"{len(numbers)} passes are both measured and simulated; {NEED_PASSES} or more "
                             "are needed, one to train on and one to hold out")
        trucks = self.out.trucks = len(self.measured.trucks())
        self.vectors = Vectors(self.measured.channels, numbers, [folders[r] for r in base])
        cells, rows, durations = self.vectors.of_mine(self.measured)
        self._check_motion(durations, self.vectors.durations, numbers)
        rows_of = {r: self.vectors.of_run(m) for r, m in folders.items()}
        everywhere = set(cells).intersection(*(c for c, _ in rows_of.values()))
        common = [c for c in cells if c in everywhere]
        rows_of = {r: v[places(c, common)] for r, (c, v) in rows_of.items()}
        at = places(self.vectors.cells, common)
        whole, keep = make_baseline(common, np.array([rows_of[r] for r in base]), self.vectors.own[np.ix_(at, at)],
                                    self.vectors.common[:, at], numbers, trucks)
        runs = {n: SignatureRuns(tuple(s for s, _, _ in made_rows), tuple(k for _, k, _ in made_rows),
                                 np.array([rows_of[r][keep] for _, _, r in made_rows]),
                                 made_rows[0][2].how != "run")
                for n, made_rows in made.items()}
        ran = {made[n][0][2]: r for n, r in runs.items() if not r.same_rock}  # each run once
        whole = whole.knowing(np.concatenate([whole.more] + [deviations(r.strengths, r.seed_index, r.values, whole)
                                                             for r in ran.values()]))
        tails = find_tails(whole)  # of any size: the same when inflated
        one = replace(whole, trucks=1)
        self.out.inflation = left_out_inflation(one, simulate_null(one, draws=200, tails=tails))
        self.common = [common[i] for i in keep]
        rows = rows[:, places(cells, self.common)]
        whole = whole.inflated(self.out.inflation)
        training, held = split(numbers)
        whole = replace(whole, scatter=scatter_of(rows, whole, training))
        if whole.scatter > SCATTERS:
            self.out.warnings.append(f"the trucks' passes vary {np.sqrt(whole.scatter):.1f} times as much as the "
                                     "model's from seed to seed: was each dug at a face like the case's?")
        self.base_folders = [folders[r] for r in base]
        self.whole, self.runs, self.wary = whole, runs, 1.0
        signatures = [self._signature(n, r) for n, r in runs.items()]
        size = np.array([self.measured.channels[n].common_sigma for n in self._response_names()])
        bias = whole.common / np.where(size > 0, size, 1.0)[:, None]
        y = rows.mean(axis=0)
        part = self._part(training, y, signatures, bias)
        self.directions = np.column_stack([s.g for s in part.signatures] + [gains(part.baseline)])
        self.null = simulate_null(self.whole, self.directions, passes=training, tails=tails)
        self.wary = self.null.inflation(len(part.signatures))
        signatures = [s.wary(self.wary) for s in signatures]
        self.out.holdout = self._part(held, y, signatures, bias)
        part = self._part(training, y, signatures, bias)
        wary = part.baseline.inflated(self.wary).prediction
        self.out.training = replace(part, covariance=with_nuisances(wary, part.nuisances))

    def _part(self, passes, y, signatures, bias):
        baseline, at = self.whole.part(passes)
        cut = [s.part(at) for s in signatures]
        nuisances = [s for s in cut if s.effect.nuisance]
        plain = with_nuisances(baseline.prediction, nuisances)
        return Part(passes, y[at], baseline, [s for s in cut if not s.effect.nuisance], nuisances, plain, plain,
                    bias[:, at], at)

    def _draw(self, after_folders):
        held = self.out.holdout.passes
        numbers = sorted(self.out.training.passes + held)
        share = self.whole.share(self.whole.seeds)
        self.out.curves = curves(self.measured, self.base_folders, after_folders, numbers, held, share)
        self.out.masses = masses(self.measured, self.base_folders, after_folders, numbers, held, share)

    def _features_of(self, folders):
        """(runs, n) over all passes' cells."""
        rows = (self.vectors.of_run(m) for m in folders)
        return np.array([row[places(cells, self.common)] for cells, row in rows])

    def _response_names(self):
        return self.measured.responses() + ([MASS] if MASS in self.measured.channels else [])

    def _check_motion(self, trucks, simulated, passes):
        """Says where a truck's phase takes another time than the model's; the worst truck of each."""
        for k, (number, durations) in enumerate(zip(passes, simulated)):
            for phase in dict.fromkeys([*durations, *(p for t in trucks for p in t[k])]):
                model = durations.get(phase, 0.0)
                mine = max((t[k].get(phase, 0.0) for t in trucks), key=lambda s: abs(s - model))
                if abs(mine - model) > MOTION_TOLERANCE_S:
                    self.out.warnings.append(
                        f"pass {number}: {phase} takes {mine:.1f} s in the mine and {model:.1f} s in the model: is the "
                        "case's motion the measured one?")

    def _add_and_confirm(self):
        out = self.out
        m, lead = out.matched, out.verdict.effect
        fit = m.fits[sure(m, lead)]
        names = [lead] + [n for n in fit.names if n != lead]
        strengths = {n: float(fit.best[fit.names.index(n)]) for n in names}
        out.intervals = {n: interval(m, n, out.training.signatures, fit.names) for n in names}
        out.stability = stability(m, lead, out.training.covariance, out.training.signatures)
        after = self._confirm(strengths)
        held = out.confirmed["holdout"]
        if held.objections():
            self.say("gap: not confirmed: " + "; ".join(held.objections()))
            out.verdict = replace(out.verdict, verdict="unknown", effect="", members=(), reasons=tuple(
                f"{as_text(strengths)} was added, but on the hold-out {o}" for o in held.objections()))
            return
        if not held.reaches:
            out.verdict = replace(out.verdict, reasons=(
                f"{as_text(strengths)} does not act on the hold-out passes: confirmed on training only",))
        out.effects = strengths
        if len(names) > 1:
            out.second = self._second(m, names[1], strengths[names[1]])
        else:
            self._look_again(lead, strengths[lead], after)

    def _confirm(self, strengths):
        """Fresh runs of the patched case; fills out.confirmed."""
        out = self.out
        seeds = [self.first_seed + FRESH_FROM + k for k in range(FRESH_SEEDS)]
        asked = [request(strengths, s, self.catalogue) for s in seeds]
        self.say(f"gap: {FRESH_SEEDS} fresh runs with {as_text(strengths)}")
        folders = self.simulator.run(asked, self.say)
        out.runs += FRESH_SEEDS
        self._draw(folders)
        out.seeds["fresh"] = seeds
        after = self._features_of(folders)
        for name, part in (("training", out.training), ("holdout", out.holdout)):
            expected = sum(strengths[s.name] * s.g for s in part.signatures if s.name in strengths)
            out.confirmed[name] = closure(part.y, part.baseline, after[:, part.at],
                                          self._rivals(part, strengths), expected)
        return after

    def _rivals(self, part, strengths):
        """Means on `part` of what must be beaten, each fitted on the training passes."""
        train = self.out.training
        residual, mean = train.y - train.baseline.mean, part.baseline.mean
        rivals = {}
        if train.nuisances:
            b = best_fit(residual, train.baseline.prediction, np.array([s.g for s in train.nuisances]).T,
                         [s.effect.scale for s in train.nuisances])
            rivals["nuisances tuned anew"] = mean + b @ np.array([s.g for s in part.nuisances])
        wrong = [n for n in (s.name for s in train.signatures) if n not in strengths]
        if wrong:
            best = max(wrong, key=lambda n: self.out.matched.log_weight[(n,)])
            g = next(s.g for s in part.signatures if s.name == best)
            rivals[f"{best}, the best wrong effect"] = mean + self.out.matched.fits[(best,)].best[0] * g
        shift = best_fit(residual, train.baseline.prediction, train.bias.T, np.full(len(train.bias), 1e6))
        rivals["a constant bias in each channel"] = mean + shift @ part.bias
        return rivals

    def _look_again(self, first, strength, after):
        """A second effect, where the first leaves more than noise on the training passes.

        Both are matched together; the first one's signature now also knows the fresh runs, where it needed runs.
        """
        out, train = self.out, self.out.training
        residual = train.y - train.baseline.mean
        index = {s.name: k for k, s in enumerate(train.signatures)}
        runs, signatures = self.runs[first], list(train.signatures)
        if not runs.same_rock:
            more = replace(runs, strengths=runs.strengths + (strength,) * len(after),
                           seed_index=runs.seed_index + (None,) * len(after), values=np.vstack([runs.values, after]))
            signatures[index[first]] = self._signature(first, more).part(train.at)
        g = signatures[index[first]].g
        left = train.y - after[:, train.at].mean(axis=0)
        low, high = out.intervals[first]
        unsure = ((high - low) / TWO_SIDED_90) ** 2 * np.outer(g, g)
        covariance = train.baseline.against(len(after)) + unsure
        if self.null.plain().omnibus_p(statistics(left, covariance, train.baseline.grid)) >= OMNIBUS_P:
            return
        m = match(residual, train.covariance, signatures, train.baseline)
        rest = [n for n in index if n != first]
        other = max(rest, key=m.presence, default=None)
        if other is None or m.presence(first) < PROBABILITY or m.presence(other) < PROBABILITY:
            out.second = {"verdict": "unknown"}
            return
        fit = m.fits[m.best_with(other)]
        out.intervals[other] = interval(m, other, signatures)
        out.second = self._second(m, other, float(fit.best[fit.names.index(other)]))

    def _second(self, m, name, strength):
        e, verdict = self.catalogue[name], self.out.verdict
        self.out.verdict = replace(verdict, rejected=tuple(r for r in verdict.rejected if r[0] != name))
        return {"verdict": "named", "effect": name, "probability": m.presence(name),
                "parameter": {"name": e.parameter, "unit": e.unit, "estimate": strength,
                              "interval90": list(self.out.intervals[name])}}

    def _next(self):
        """Experiments for whatever is still open: the class, or every effect that is not ruled out."""
        out = self.out
        if out.verdict.verdict in ("named", "no-gap"):
            return
        names = out.verdict.members or [s.name for s in out.training.signatures]
        weights = {n: out.matched.presence(n) for n in names}
        if out.verdict.verdict != "class":  # hardly anything is known: the catalogue as it stands
            weights = {n: w + 1.0 / len(names) for n, w in weights.items()}
        out.proposals = propose(weights)


def scatter_of(rows, whole, training):
    """How much a mine's trucks (T, n) vary in the training passes, in variances of the model's runs."""
    seen, at = whole.part(training)
    return scatter(rows[:, at], np.diag(seen.own), np.diag(seen.seed))


def as_text(strengths):
    return ", ".join(f"{n} {s:.3g}" for n, s in strengths.items())


