"""What a mine of so many trucks would show, before data are taken: the smallest strength of each effect.

From runs of the case alone. The mine is assumed to be logged with the given channels, to scatter from truck to truck
as the model does from seed to seed, and, with a reference, to have as many earlier trucks. An effect counts as found
where it stands out by DETECTION_D (statistics/isolability.py), the nuisances being unknown.
"""
import json
from dataclasses import dataclass, replace

import numpy as np

from .model import learn, signatures_of
from .readings.channels import FACE
from .readings.passes import split
from .simulation.plan import make_plan, statement
from .statistics.isolability import isolability, with_nuisances
from .statistics.reference import Reference, drift_sigmas

TRUCKS = (2, 4, 8)


@dataclass(frozen=True)
class Forecast:
    trucks: tuple
    channels: tuple   # names of the responses
    limits: dict      # {effect: {"model": [strength or None for each of trucks], "reference": [...]}}
    faceless: dict    # the same without surveys of the face; None where the channels have none
    runs: int


def forecast(channels, simulator, catalogue, first_seed, say=print):
    """Forecast for a mine with these `channels` {name: Channel}; makes the runs that are not kept."""
    plan = make_plan(catalogue, max(TRUCKS), first_seed, simulator.takes_a_run)
    say(f"gap: {statement(plan, simulator)}")
    requests = plan.requests()
    folders = dict(zip(requests, simulator.run(requests, say)))
    first = folders[plan.baseline[0]]
    mine = replace(first.seen_by(channels), channels={n: channels[n] for n in first.channels if n in channels})
    model = learn(plan, folders, mine, known=simulator.known)
    blind = mine.seen_by({n: c for n, c in mine.channels.items() if n != FACE})
    faceless = None
    if FACE in mine.channels:
        faceless = _ways(learn(plan, folders, blind, known=simulator.known), catalogue, blind)
    return Forecast(TRUCKS, model.responses, _ways(model, catalogue, mine), faceless,
                    sum(r.how == "run" for r in requests))


def _ways(model, catalogue, mine):
    found = {way: [_limits(model, catalogue, mine, trucks, way == "reference") for trucks in TRUCKS]
             for way in ("model", "reference")}
    return {n: {way: [row[n] for row in rows] for way, rows in found.items()} for n in found["model"][0]}


def _limits(model, catalogue, mine, trucks, with_reference):
    """{effect: smallest strength that is found, None where none within bounds is}."""
    baseline = replace(model.baseline, trucks=trucks)
    if with_reference:
        drift = model.bias * drift_sigmas(mine.channels, mine.channels, model.responses)[:, None]
        n = len(baseline.mean)
        reference = Reference(np.zeros((trucks, n)), baseline.own, drift, np.zeros(n))
        baseline = replace(baseline, reference=reference, scatter=np.ones(n))
    part, at = baseline.part(split(model.passes)[0])
    cut = [s.part(at) for s in signatures_of(model, catalogue, baseline)]
    covariance = with_nuisances(part.prediction, [s for s in cut if s.effect.nuisance])
    table = isolability([s for s in cut if not s.effect.nuisance], covariance, only="")
    return {n: float(x) if np.isfinite(x) else None for n, x in zip(table.names, table.limits)}


def as_lines(outlook, catalogue):
    """Tables to print, without and with surveys of the face."""
    if outlook.faceless is None:
        return _table(outlook, outlook.limits, catalogue)
    return ["without the face:", *_table(outlook, outlook.faceless, catalogue), "",
            "with the face surveyed before and after each pass:", *_table(outlook, outlook.limits, catalogue)]


def _table(outlook, limits, catalogue):
    """An effect a line, the most easily found (by its prior) first."""
    head = [f"{t} trucks" for t in outlook.trucks]
    rows = [["", "unit", *head, *(f"+ {t} before" for t in outlook.trucks)]]
    for n in sorted(limits, key=lambda n: _ease(limits[n], catalogue[n])):
        e, ways = catalogue[n], limits[n]
        unit = "" if e.unit in ("-", "1") else e.unit
        rows.append([n, unit, *map(_text, ways["model"]), *map(_text, ways["reference"])])
    widths = [max(len(r[k]) for r in rows) for k in range(len(rows[0]))]
    return ["  ".join(c.ljust(w) if k < 2 else c.rjust(w) for k, (c, w) in enumerate(zip(r, widths))) for r in rows]


def _ease(ways, effect):
    best = [x for x in ways["reference"] + ways["model"] if x is not None]
    return min(best) / effect.scale if best else np.inf


def _text(x):
    return "none" if x is None else f"{x:.2g}"


def write_forecast(outlook, catalogue, file):
    data = {"trucks": list(outlook.trucks), "channels": list(outlook.channels), "runs": outlook.runs, "effects": {
        n: {"title": catalogue[n].title, "unit": catalogue[n].unit, "high": catalogue[n].high, "low": catalogue[n].low,
            **ways, "without_face": outlook.faceless and outlook.faceless[n]} for n, ways in outlook.limits.items()}}
    file.write_text(json.dumps(data, indent=2, allow_nan=False) + "\n")
