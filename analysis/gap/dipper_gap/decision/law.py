"""A law for what the catalogue has no name for: a force that follows from how the machine moves.

The residual of each force, measured less usual (the model's mean, or the reference's), is taken reading by reading and
explained by a constant and few terms that the driven signals give. Terms are added greedily while they make the
training passes, each predicted from the others, likelier. Both the number of terms and how much they explain by chance
are judged by the same search on residuals in which there is no law: differences of the model's own runs, scaled to the
mine's scatter and read by its instruments. A law is reported if fewer than ALARMS of those do as well, on the training
passes and then on those held out. Where no term helps, the constant itself is a law, if fewer than ALARMS of those
residuals, with the error that all readings share, have so large a one.
"""
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..readings.curves import SameMoments
from ..readings.phases import find_terms
from ..statistics.reference import drift_sigmas

ALARMS = 0.05         # over both kinds of law and all forces
DRAWS = 99
MOST_TERMS = 3
LEAST_GAIN = 0.10     # of the weighted square that is left, for one more term
LEAST_EXPLAINED = 0.25  # of the residual's weighted square on the passes held out: less is no law
CONSTANT = "constant"

# What may be in a law: the terms of drive_terms.hpp that it adds up, and how its number a is reported.
TERMS = {
    CONSTANT: ({"constant_kN": 1}, "{a:+.0f} kN at all times"),
    "hoist moves in": ({"hoist_in_kN": 1}, "{a:+.0f} kN while the ropes come in"),
    "hoist moves out": ({"hoist_out_kN": 1}, "{a:+.0f} kN while the ropes run out"),
    "crowd moves out": ({"crowd_out_kN": 1}, "{a:+.0f} kN while the crowd moves out"),
    "crowd moves in": ({"crowd_in_kN": 1}, "{a:+.0f} kN while the crowd moves in"),
    "swing moves": ({"swing_kN": 1}, "{a:+.0f} kN while the house swings"),
    "crowd direction": ({"crowd_out_kN": 1, "crowd_in_kN": -1},
                        "{a:+.0f} kN as the crowd moves out, and {b:+.0f} kN as it moves in"),
    "hoist direction": ({"hoist_in_kN": 1, "hoist_out_kN": -1},
                        "{a:+.0f} kN as the ropes come in, and {b:+.0f} kN as they run out"),
    "crowd drag": ({"crowd_drag_kN_m": 1}, "{a:+.0f} kN for each metre that the crowd is out as it moves out, and "
                   "{b:+.0f} kN as it moves in"),
    "crowd speed": ({"crowd_speed_kNs_m": 1}, "{a:+.0f} kN per m/s of the crowd, out"),
    "hoist speed": ({"hoist_speed_kNs_m": 1}, "{a:+.0f} kN per m/s of the ropes, in"),
    "crowd extension": ({"crowd_extension_kN_m": 1}, "{a:+.0f} kN per metre that the crowd is out"),
    "hoist length": ({"hoist_length_kN_m": 1}, "{a:+.0f} kN per metre of rope"),
    "swing angle": ({"swing_angle_kN_rad": 1}, "{a:+.0f} kN per radian of the house's angle"),
    "load carried": ({"load_kN": 1}, "{a:+.0f} kN while a load is carried, from breakout to dump"),
    "pass": ({"pass_kN": 1}, "{a:+.0f} kN more with each pass"),
}
FORMS = [n for n in TERMS if n != CONSTANT]   # in the order of a _Readings' columns


@dataclass(frozen=True)
class Law:
    channel: str
    terms: tuple         # ((name of TERMS, kN), ...)
    p: float             # that differences of the model's own runs give as much on the training passes
    explained: float     # share of the residual's weighted square on the passes held out

    @property
    def words(self):
        return "; ".join(TERMS[name][1].format(a=a, b=-a) for name, a in self.terms)

    def numbers(self):
        """{term of drive_terms.hpp: number}."""
        out = {}
        for name, a in self.terms:
            for term, factor in TERMS[name][0].items():
                out[term] = out.get(term, 0.0) + factor * a
        return out


@dataclass(frozen=True)
class _Readings:
    """One force at the first truck's readings within the passes, (M,)."""

    terms: np.ndarray     # (M, K) of FORMS
    passes: np.ndarray    # (M,) numbers
    held: np.ndarray      # (M,) whether the pass is held out
    residual: np.ndarray  # (M,)
    chance: np.ndarray    # (R, M) of the model's runs less their mean
    share: float          # of their variance in the residual's
    sigma: float          # of one reading's mean over the trucks
    shared: float         # of an error that all readings have

    @cached_property
    def weight(self):
        """(M,) one over the variance of each reading's residual."""
        return 1.0 / (self.chance.var(axis=0, ddof=1) * self.share + self.sigma**2)


def find_laws(model, baseline, holdout, measured, before=None, seed=0):
    """(Law, ...) of the forces that one explains better than chance, the best explained first."""
    rng, found = np.random.default_rng(seed), []
    alarms = ALARMS / (2 * max(1, len(measured.responses())))
    for channel, r in _readings(model, baseline, holdout, measured, before):
        by_chance = [_no_law(r, rng) for _ in range(DRAWS)]
        law = _of_terms(r, channel, by_chance, alarms)
        if not law:
            by_chance = [y + r.shared * rng.standard_normal() for y in by_chance]
            law = _constant(r, channel, by_chance, alarms)
        if law:
            found.append(law)
    return tuple(law for _, law in sorted(found, key=lambda f: -f[0]))


def rival_law(model, baseline, holdout, measured, before=None):
    """(words, (n,) shift of all cells) of the law that explains the training passes best, of each force that has one;
    None where there is none. Whether it is one by chance is for the passes held out to say."""
    folder, words, signals = model.folders[0], [], dict(model.folders[0].signals)
    columns = _columns(folder) if measured.responses() else None
    for channel, r in _readings(model, baseline, holdout, measured, before):
        _, chosen, _ = _search(r, r.residual)
        if chosen:
            size = _fit(r.terms[~r.held][:, chosen], r.residual[~r.held], r.weight[~r.held])
            signals[channel] = signals[channel] + size[0] + columns[:, chosen] @ size[1:]
            law = Law(channel, tuple((FORMS[k], float(a)) for k, a in zip(chosen, size[1:])), 1.0, 0.0)
            words.append(f"{channel.removesuffix('_force_kN').capitalize()} force: {law.words}")
    if not words:
        return None
    moved, plain = model.of_runs([replace(folder, signals=signals), folder])
    return ". ".join(words), moved - plain


def _of_terms(r, channel, by_chance, alarms):
    """(gain, Law) of terms of the motion; None where chance does as well."""
    gain, chosen, after = _search(r, r.residual)
    if not chosen or after < LEAST_EXPLAINED:
        return None
    others = [_search(r, y) for y in by_chance]
    p, confirmed = (_p(sum(o[k] >= mine for o in others)) for k, mine in ((0, gain), (2, after)))
    if p > alarms or confirmed > ALARMS:
        return None
    size = _fit(r.terms[~r.held][:, chosen], r.residual[~r.held], r.weight[~r.held])[1:]
    return gain, Law(channel, tuple((FORMS[k], float(a)) for k, a in zip(chosen, size)), p, after)


def _constant(r, channel, by_chance, alarms):
    """(gain, Law) of a force that is there at all times; None where chance and the shared error do as well."""
    weight, held = r.weight, r.held

    def level(y, at):
        return (weight[at] @ y[at]) / weight[at].sum()

    a = level(r.residual, ~held)
    p = _p(sum(abs(level(y, ~held)) >= abs(a) for y in by_chance))
    y, w = r.residual[held], weight[held]
    explained = 1.0 - float(w @ (y - a) ** 2 / (w @ y**2))
    if p > alarms or explained < LEAST_EXPLAINED:
        return None
    y, w = r.residual[~held], weight[~held]
    return float(w @ y**2 - w @ (y - a) ** 2), Law(channel, ((CONSTANT, float(a)),), p, explained)


def _p(as_good):
    return float((1 + as_good) / (1.0 + DRAWS))


def _no_law(r, rng):
    """A residual by chance: one of the model's runs less the others', as large as the means differ, and the readings'
    own errors; a random mix of the runs has their covariance."""
    mix = rng.standard_normal(len(r.chance))
    mix -= mix.mean()
    made = np.sqrt(r.share / (len(mix) - 1)) * mix @ r.chance
    return made + r.sigma * rng.standard_normal(made.shape)


def _search(r, y):
    """(gain, columns, share explained on the held-out passes) of the terms that predict the training passes best from
    one another; the gain is in the weighted square."""
    weight, held = r.weight, r.held
    train, chosen = ~held, []
    left = _predicted(r.terms[train][:, []], y[train], weight[train], r.passes[train])
    first = left
    while len(chosen) < MOST_TERMS:
        trials = {k: _predicted(r.terms[train][:, [*chosen, k]], y[train], weight[train], r.passes[train])
                  for k in range(r.terms.shape[1]) if k not in chosen and np.ptp(r.terms[train][:, k]) > 0}
        k = min(trials, key=trials.get)
        if trials[k] > (1 - LEAST_GAIN) * left:
            break
        chosen, left = [*chosen, k], trials[k]
    if not chosen:
        return 0.0, [], 0.0
    plain, law = (_fit(r.terms[train][:, c], y[train], weight[train]) for c in ([], chosen))
    squares = [(weight[held] * (y[held] - b[0] - r.terms[held][:, c] @ b[1:]) ** 2).sum()
               for b, c in ((plain, []), (law, chosen))]
    return float(first - left), chosen, float(1 - squares[1] / squares[0])


def _predicted(x, y, weight, passes):
    """Weighted square of what each pass leaves when it is predicted from the others."""
    total = 0.0
    for one in np.unique(passes):
        at = passes == one
        others = ~at if (~at).any() else at  # a single training pass: by itself
        b = _fit(x[others], y[others], weight[others])
        total += (weight[at] * (y[at] - b[0] - x[at] @ b[1:]) ** 2).sum()
    return total


def _fit(x, y, weight):
    """Weighted least squares with a constant; the constant first."""
    root = np.sqrt(weight)
    return np.linalg.lstsq(np.column_stack([np.ones(len(y)), x]) * root[:, None], y * root, rcond=None)[0]


def _columns(m):
    """(T, K) of FORMS at the readings of a run, or of one truck."""
    spans = [(p.t_start_s, p.t_end_s) for p in m.passes]
    names, values = find_terms(m.time_s, *(m.signals[n] for n in ("hoist_m", "crowd_m", "swing_rad")), spans)
    return np.column_stack([sum(f * values[:, names.index(t)] for t, f in TERMS[n][0].items()) for n in FORMS])


def _readings(model, baseline, holdout, measured, before):
    """(channel, _Readings) of each force."""
    if not measured.responses():
        return
    first = measured.trucks()[0]
    columns, moments = _columns(first), [SameMoments(first, number) for number in model.passes]
    share = baseline.share(baseline.seeds)
    for channel in measured.responses():
        yield channel, _of_force(model, share, holdout, channel, measured, before, columns, moments)


def _of_force(model, share, holdout, channel, measured, before, columns, moments):
    usual = before.trucks() if before else None
    terms, passes, residual, chance = [], [], [], []
    for at in moments:
        runs = at.read(model.folders, channel)
        seen = at.read(measured.trucks(), channel).mean(axis=0)
        then = (at.read(usual, channel) if usual else runs).mean(axis=0)
        terms.append(columns[at.inside])
        terms[-1][:, FORMS.index("pass")] = at.number
        passes += [at.number] * len(at.time_s)
        residual.append(seen - then)
        chance.append(runs - runs.mean(axis=0))
    trucks = len(measured.trucks())
    variance = measured.channels[channel].sigma**2 / trucks
    variance += before.channels[channel].sigma**2 / len(usual) if usual else 0.0
    shared = drift_sigmas(measured.channels, before.channels, [channel])[0] if before else \
        measured.channels[channel].common_sigma
    return _Readings(np.vstack(terms), np.array(passes), np.isin(passes, holdout), np.concatenate(residual),
                     np.hstack(chance), share, float(np.sqrt(max(variance, 1e-12))), float(shared))
