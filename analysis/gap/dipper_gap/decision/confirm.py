"""Whether the effect that explains the training passes also closes the gap where nobody looked."""
from dataclasses import dataclass

import numpy as np

from ..readings.curves import curves, masses
from ..statistics.closure import best_fit, closure

FLAT_PRIOR = 1e6  # sd of a constant bias, in the channel's unit


@dataclass(frozen=True)
class Confirmation:
    training: object      # Closure
    holdout: object
    after: np.ndarray     # (runs, n) features of the fresh runs, over all passes
    folders: tuple
    seeds: list


def confirm(model, training, holdout, matched, strengths, runner, law=None):
    """Fresh runs of the case with `strengths` {effect: strength}, against both parts; `law` is a rival that
    law.rival_law has found."""
    seeds = model.plan.fresh_seeds()
    folders = runner.run(strengths, seeds)
    after = model.of_runs(folders)

    def closed(part):
        expected = sum(strengths[s.name] * s.g for s in part.signatures if s.name in strengths)
        rivals = _rivals(part, training, matched, strengths, law)
        return closure(part.y, part.baseline, after[:, part.at], rivals, expected)

    return Confirmation(closed(training), closed(holdout), after, tuple(folders), seeds)


def _rivals(part, training, matched, strengths, law):
    """Means on `part` of what must be beaten, each fitted on the training passes."""
    residual, mean = training.y - training.baseline.mean, part.baseline.mean
    rivals = {}
    if training.nuisances:
        b = best_fit(residual, training.baseline.prediction, np.array([s.g for s in training.nuisances]).T,
                     [s.effect.scale for s in training.nuisances])
        rivals["nuisances tuned anew"] = mean + b @ np.array([s.g for s in part.nuisances])
    wrong = [s.name for s in training.signatures if s.name not in strengths]
    if wrong:
        best = max(wrong, key=lambda n: matched.log_weight[(n,)])
        g = next(s.g for s in part.signatures if s.name == best)
        rivals[f"{best}, the best wrong effect"] = mean + matched.fits[(best,)].best[0] * g
    if law:
        words, moves = law
        rivals[f"a law ({words})"] = mean + moves[part.at]
    shift = best_fit(residual, training.baseline.prediction, training.bias.T, np.full(len(training.bias), FLAT_PRIOR))
    rivals["a constant bias in each channel"] = mean + shift @ part.bias
    return rivals


def drawn(model, prediction, holdout, measured, after, reference=None):
    """Curves and masses of the report; `after` are folders of the patched case, if there are any. A reference is drawn
    in the model's place, and `after` moved by as much."""
    share = prediction.baseline.share(prediction.baseline.seeds)
    words = (measured, list(model.folders), list(after), list(model.passes), holdout.passes, share, reference)
    return curves(*words), masses(*words)
