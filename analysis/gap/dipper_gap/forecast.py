"""What a mine of so many trucks would show, before data are taken: the smallest strength of each effect.

From runs of the case alone. The mine is assumed to be logged with the given channels, to scatter from truck to truck
as the model does from seed to seed, and, with a reference, to have as many earlier trucks; of a reference that is given
already, its own scatter and what it differs by from the model count. An effect is found where it stands out by
DETECTION_D (statistics/isolability.py), and named where besides nothing else explains as much (statistics/naming.py),
the nuisances being unknown.
"""
import json
from dataclasses import dataclass, replace

import numpy as np

from .model import learn, predict_change, prediction_of
from .readings.channels import FACE
from .readings.passes import split
from .simulation.plan import make_plan, statement
from .statistics.isolability import isolability, with_nuisances
from .statistics.naming import naming_limits
from .statistics.reference import Reference, drift_sigmas

TRUCKS = (2, 4, 8)
USUAL = 4            # trucks for which what few runs tell is estimated
WAYS = ("model", "reference")  # against the model's mean, or against earlier trucks


@dataclass(frozen=True)
class Forecast:
    trucks: tuple
    channels: tuple   # names of the responses
    limits: dict      # {effect: {way: [strength that is found or None, for each of trucks], "named": {way: the same}}}
    faceless: dict    # the same without surveys of the face; None where the channels have none
    runs: int
    reference: int    # trucks of a reference that was given; 0: as many as of now are assumed


def forecast(channels, simulator, catalogue, first_seed, say=print, before=None):
    """Forecast for a mine with these `channels` {name: Channel}, and a folder `before` of its earlier trucks; makes the
    runs that are not kept."""
    plan = make_plan(catalogue, max(TRUCKS), first_seed, simulator.takes_a_run)
    say(f"gap: {statement(plan, simulator)}")
    requests = plan.requests()
    folders = dict(zip(requests, simulator.run(requests, say)))
    first = folders[plan.baseline[0]]
    mine = replace(first.seen_by(channels), channels={n: channels[n] for n in first.channels if n in channels})
    limits, model = _ways(plan, folders, catalogue, simulator.known, mine, before)
    faceless = None
    if FACE in mine.channels:
        blind = mine.seen_by({n: c for n, c in mine.channels.items() if n != FACE})
        faceless, _ = _ways(plan, folders, catalogue, simulator.known, blind, before and before.seen_by(blind.channels))
    return Forecast(TRUCKS, model.responses, limits, faceless, len(simulator.needed(requests)),
                    len(before.trucks()) if before else 0)


def _ways(plan, folders, catalogue, known, mine, before):
    """(limits as a Forecast has them, Model) for a mine that logs as `mine` does."""
    model = learn(plan, folders, mine, known=known)
    change = learn(plan, folders, mine, before or mine, known, model)
    usual = replace(model.baseline, trucks=USUAL)
    alone = _limits(model, [replace(usual, trucks=t) for t in TRUCKS], prediction_of(model, catalogue, usual))
    if before:
        # One run without noise stands for the trucks to come: it says nothing of how they scatter.
        prediction = predict_change(replace(change, baseline=replace(change.baseline, trucks=USUAL)), catalogue, mine,
                                    before)
        baselines = [replace(prediction.baseline, trucks=t) for t in TRUCKS]
    else:
        baselines = [_assumed(change, mine, t) for t in TRUCKS]
        usual = _assumed(change, mine, USUAL)
        prediction = prediction_of(change, catalogue, usual)
    against = _limits(change, baselines, prediction)
    return {n: {**dict(zip(WAYS, (alone[n][0], against[n][0]))), "named": dict(zip(WAYS, (alone[n][1], against[n][1])))}
            for n in alone}, model


def _assumed(model, mine, trucks):
    """The baseline against as many earlier trucks, which read as the model does."""
    drift = model.bias * drift_sigmas(mine.channels, mine.channels, model.responses)[:, None]
    n = len(model.baseline.mean)
    reference = Reference(np.zeros((trucks, n)), model.baseline.own, model.baseline.common, drift, np.zeros(n))
    return replace(model.baseline, trucks=trucks, reference=reference, scatter=np.ones(n))


def _limits(model, baselines, prediction):
    """{effect: ([strength that is found, None where none within bounds is], [that is named])}, one a baseline."""
    found, named = [], []
    for baseline in baselines:
        part, at = baseline.part(split(model.passes)[0])
        cut = [s.part(at) for s in prediction.signatures]
        effects, nuisances = ([s for s in cut if s.effect.nuisance == of] for of in (False, True))
        covariance = with_nuisances(part.inflated(prediction.inflation).prediction, nuisances)
        found.append(isolability(effects, covariance, only="").limits)
        named.append(naming_limits(effects, covariance, part, found[-1]))
    return {s.name: tuple([float(x[k]) if np.isfinite(x[k]) else None for x in kind] for kind in (found, named))
            for k, s in enumerate(effects)}


def as_lines(outlook, catalogue):
    """Tables to print, without and with surveys of the face."""
    if outlook.faceless is None:
        return _table(outlook, outlook.limits, catalogue)
    return ["without the face:", *_table(outlook, outlook.faceless, catalogue), "",
            "with the face surveyed before and after each pass:", *_table(outlook, outlook.limits, catalogue)]


def _table(outlook, limits, catalogue):
    """An effect a line, the most easily found (by its prior) first: what is found, and in brackets what is named."""
    before = [f"+ {outlook.reference or t} before" for t in outlook.trucks]
    rows = [["", "unit", *(f"{t} trucks" for t in outlook.trucks),
             *(f"{t} {b}" if outlook.reference else b for t, b in zip(outlook.trucks, before))]]
    for n in sorted(limits, key=lambda n: _ease(limits[n], catalogue[n])):
        e, ways = catalogue[n], limits[n]
        unit = "" if e.unit in ("-", "1") else e.unit
        rows.append([n, unit, *(f"{_text(a)} ({_text(b)})" for way in WAYS
                                for a, b in zip(ways[way], ways["named"][way]))])
    widths = [max(len(r[k]) for r in rows) for k in range(len(rows[0]))]
    return ["  ".join(c.ljust(w) if k < 2 else c.rjust(w) for k, (c, w) in enumerate(zip(r, widths))) for r in rows]


def _ease(ways, effect):
    best = [x for way in WAYS for x in ways[way] if x is not None]
    return min(best) / effect.scale if best else np.inf


def _text(x):
    return "none" if x is None else f"{x:.2g}"


def write_forecast(outlook, catalogue, file):
    data = {"trucks": list(outlook.trucks), "channels": list(outlook.channels), "runs": outlook.runs,
            "reference": outlook.reference, "effects": {
                n: {"title": catalogue[n].title, "unit": catalogue[n].unit, "high": catalogue[n].high,
                    "low": catalogue[n].low, **ways, "without_face": outlook.faceless and outlook.faceless[n]}
                for n, ways in outlook.limits.items()}}
    file.write_text(json.dumps(data, indent=2, allow_nan=False) + "\n")
