"""The best setting under constraints, with few runs.

    1. the base case and a spread of points (Sobol), each with every seed
    2. a Gaussian process for the objective and for each constraint; the next points are those of the largest expected
       improvement over the best feasible mean, times the probability that the constraints hold
    3. the point with the best modelled mean among those run that hold the constraints, and the base, with fresh seeds:
       the improvement is claimed where the 90 % interval of their paired difference is on the right side of zero, and
       the fresh means hold the constraints
"""
from dataclasses import dataclass, field

import numpy as np
from scipy.stats import qmc

from dipper_run.findings import BadInput
from dipper_run.program import ProgramFailed

from .motions import PREFIX
from .statistics import compare, summary
from .study_file import Point
from .surrogate import Surrogate, expected_improvement, pooled_variance, probability_inside

CANDIDATES = 4096
SURE = 0.5        # probability that a point holds the constraints, from which it may be the answer
Z90 = 1.645       # standard deviations about the middle that hold 90 %
SLICE = 41        # places at which the page shows the model


@dataclass
class Search:
    """Points run so far and what was seen there; the first is the case itself."""

    places: list          # (d,) in the unit cube
    goal: list            # (seeds,) of each: the objective, to be made large
    margins: list         # (constraints, seeds) of each
    left_out: list = field(default_factory=list)  # (d,) of points that gave no figure

    def models(self):
        """The objective's Surrogate, and one a constraint."""
        x = np.array(self.places)
        return _surrogate(x, np.array(self.goal)), [_surrogate(x, m) for m in np.array(self.margins).swapaxes(0, 1)]

    def feasibility(self, models, x):
        """Probability that all constraints hold at x."""
        return np.prod([probability_inside(*m(x)) for m in models], axis=0) if models else np.ones(len(x))

    def promising(self, x):
        """Whether each of x is nearer to a point that gave figures than to one that gave none."""
        return _nearest(self.places, x) < _nearest(self.left_out, x)

    def best(self):
        """Index of the point that the models call best among those that are likely to hold the constraints."""
        goal, margins = self.models()
        x = np.array(self.places)
        inside = self.feasibility(margins, x)
        mean = goal(x)[0]
        if (inside >= SURE).any():
            return int(np.argmax(np.where(inside >= SURE, mean, -np.inf)))
        return int(np.argmax(inside))

    def next_places(self, count):
        """Where to run next; each is taken as if it had come out as the model says before the next is chosen."""
        trial = Search(list(self.places), list(self.goal), list(self.margins))
        x = _sobol(len(self.places[0]), len(self.places) + len(self.left_out), CANDIDATES)
        promising = self.promising(x)
        x = x[promising] if promising.any() else x
        for _ in range(count):
            goal, margins = trial.models()
            mean, sd = goal(x)
            inside = self.feasibility(margins, x)
            sure = float(goal(np.array([trial.places[trial.best()]]))[0][0])
            chosen = int(np.argmax(expected_improvement(mean, sd, sure) * inside))
            seeds = len(trial.goal[0])
            trial.places.append(x[chosen])
            trial.goal.append(np.full(seeds, mean[chosen]) + _spread(trial.goal))
            believed = [np.full(seeds, m(x[chosen:chosen + 1])[0][0]) + _spread([at[k] for at in trial.margins])
                        for k, m in enumerate(margins)]
            trial.margins.append(np.array(believed).reshape(-1, seeds))
        return trial.places[-count:]


def _nearest(places, x):
    """How far each of x is from the nearest of the places; infinite without any."""
    return np.min([np.linalg.norm(x - p, axis=1) for p in places], axis=0) if places else np.full(len(x), np.inf)


def _sobol(dimensions, seed, count):
    """(count, dimensions) places spread evenly over the unit cube."""
    return qmc.Sobol(dimensions, seed=seed).random_base2(int(np.ceil(np.log2(max(count, 2)))))[:count]


def _surrogate(x, values):
    """values: (points, seeds)."""
    return Surrogate(x, values.mean(axis=1), pooled_variance(values) / values.shape[1])


def _spread(values):
    """What the seeds share, of (points, seeds); a point that is only believed has it too, so the noise stays known."""
    values = np.array(values)
    return values.mean(axis=0) - values.mean()


def search(session, say):
    """What optimum.json and the page show as the answer; see the module."""
    how, base = session.study.optimise, _base(session)
    low, width = np.array([r.low for r in how.ranges]), np.array([r.high - r.low for r in how.ranges])
    found = Search([], [], [])
    _run(session, found, [(base - low) / width, *_sobol(len(low), 1, how.start - 1)], say)
    if len(found.places) < 2:
        raise ProgramFailed(f"{session.study.file}:{how.ranges[0].line}: optimise.parameters: of {how.start} points "
                            "only the case itself gives a figure; ranges nearer to the case's own values")
    asked = how.start
    while asked < how.points:
        count = min(how.batch, how.points - asked)
        _run(session, found, found.next_places(count), say)
        asked += count
        at = found.best()
        say(f"study: {asked} of {how.points} points; best so far {_text(how, low + width * found.places[at])}: "
            f"{how.objective.text} {_raw(how, found.goal[at]).mean():.4g}")
    at = found.best()  # the base is the first
    return _answer(session, found, base, low + width * found.places[at] if at > 0 else base, say)


def _base(session):
    """The case's own values of the parameters, as `dipper check` prints them."""
    study = session.study
    point = Point((), study.fixed)
    session.planner.check([point])
    base = [session.planner.motions.own(r.key, study.fixed) if r.key.startswith(PREFIX) else
            _value(session.planner.checked(point), r.key) for r in study.optimise.ranges]
    wrong = [f"{study.file}:{r.line}: {r.key}: the case has {value}; a range that holds it, since the answer is "
             "compared with the case as it is" for r, value in zip(study.optimise.ranges, base)
             if value is None or not r.low <= value <= r.high]
    if wrong:
        raise BadInput(wrong)
    return np.array(base)


def _value(checked, key):
    """A number of the case; an effect that it does not have is off; KEY.2 is the third of a list."""
    if key.startswith("effects."):
        return checked.get("effects", {}).get(key.split(".", 1)[1], 0.0)
    value = checked["values"].get(key)
    if value is None and key.rpartition(".")[2].isdigit():
        several, _, index = key.rpartition(".")
        value = checked["values"].get(several, [])[int(index):int(index) + 1]
        value = value[0] if value else None
    return value if isinstance(value, (int, float)) else None


def _run(session, found, places, say):
    """Runs of these places of the unit cube, with every seed of the search. What is no sound case, and one whose runs
    fail, is left out."""
    how, seeds = session.study.optimise, session.study.seeds
    points = [session.study.point_at([r.low + (r.high - r.low) * u for r, u in zip(how.ranges, p)]) for p in places]
    unsound = session.planner.faults(points)
    for point, findings in unsound.items():
        say(f"study: {_text(how, [v.number for v in point.values])} is not a valid case, left out: {findings[0]}")
    sound = [p for p in points if p not in unsound]
    rows = dict(zip(sound, _rows(session, sound, seeds)))
    for place, point in zip(places, points):
        goal, margins = _figures(how, rows.get(point, [{}] * len(seeds)))
        if np.isfinite(goal).all() and np.isfinite(margins).all():
            found.places.append(np.asarray(place, float))
            found.goal.append(goal)
            found.margins.append(margins)
        elif found.places:
            found.left_out.append(np.asarray(place, float))
        else:
            raise ProgramFailed("the case itself gives no figure to hold others against")


def _rows(session, points, seeds):
    """[a row a seed] of each point."""
    try:
        session.planner.check(points)
    except BadInput as e:
        raise ProgramFailed("a point inside the ranges is not a valid case:\n" + str(e)) from e
    rows = session.make(session.planner.runs(points, seeds)) if points else []
    return [rows[k * len(seeds):(k + 1) * len(seeds)] for k in range(len(points))]


def _figures(how, rows):
    """(seeds,) of the objective, to be made large, and (constraints, seeds) of the margins."""
    sign = 1.0 if how.maximise else -1.0
    margins = [[c.margin(c.objective.value_in(row)) for row in rows] for c in how.constraints]
    return np.array([sign * how.objective.value_in(row) for row in rows]), np.array(margins).reshape(-1, len(rows))


def _raw(how, goal):
    """The objective as the study names it."""
    return np.asarray(goal) * (1.0 if how.maximise else -1.0)


def _answer(session, found, base, best, say):
    """The point that is called best, and the base, with fresh seeds; where they are the same, with the base's alone."""
    study, how = session.study, session.study.optimise
    points = [study.point_at(base)] if best is base else [study.point_at(base), study.point_at(best)]
    rows = _rows(session, points, how.confirm_seeds)
    at_base, at_best = rows[0], rows[-1]
    of_base, of_best = ({row["seed"]: how.objective.value_in(row) for row in rows} for rows in (at_base, at_best))
    compared = compare(of_base, of_best)
    better = compared.shown and (compared.difference.mean > 0) == how.maximise
    held = [{"text": str(c), "held": bool(np.mean([c.margin(c.objective.value_in(r)) for r in at_best]) >= 0),
             **vars(summary([c.objective.value_in(r) for r in at_best]))} for c in how.constraints]
    improved = bool(better and all(c["held"] for c in held))
    answer = {"improved": improved, "objective": how.objective.text, "maximise": how.maximise,
              "parameters": study.names, "best": [float(x) for x in best], "base_at": [float(x) for x in base],
              "confirmed": vars(summary(of_best.values())), "base": vars(summary(of_base.values())),
              "difference": vars(compared.difference), "confidence": compared.confidence, "constraints": held,
              "points": len(found.places), "runs": len(session.runs), "confirm_seeds": how.confirm_seeds,
              "slices": list(_slices(how, found))}
    answer["says"] = (f"no better than the base: of {len(found.places)} points the case itself is called best, "
                      f"{how.objective.text} {answer['base']['mean']:.4g} over {len(of_base)} fresh seeds"
                      if best is base else _says(answer, better))
    say(f"study: {_text(how, best)}: {answer['says']}")
    return answer


def _says(a, better):
    d = a["difference"]
    change = (f"{a['objective']} {a['confirmed']['mean']:.4g} against {a['base']['mean']:.4g} of the base, difference "
              f"{d['mean']:+.3g} ({d['low']:+.3g} to {d['high']:+.3g}, 90 %) over {d['n']} fresh seeds")
    if a["improved"]:
        return f"better than the base: {change}, confidence {100 * a['confidence']:.1f} %"
    if better:
        return f"no better than the base: with fresh seeds a constraint does not hold; {change}"
    return f"no better than the base is shown: {change}"


def _text(how, place):
    return ", ".join(f"{r.key} {x:.4g}" for r, x in zip(how.ranges, place))


def _slices(how, found):
    """The model along each parameter through the best place, with its 90 % interval."""
    goal, _ = found.models()
    best = found.places[found.best()]
    for k, r in enumerate(how.ranges):
        u = np.linspace(0, 1, SLICE)
        mean, sd = goal(np.array([[*best[:k], v, *best[k + 1:]] for v in u]))
        sides = sorted((_raw(how, mean - Z90 * sd).tolist(), _raw(how, mean + Z90 * sd).tolist()))
        yield {"parameter": r.key, "x": (r.low + (r.high - r.low) * u).tolist(), "mean": _raw(how, mean).tolist(),
               "low": sides[0], "high": sides[1]}
