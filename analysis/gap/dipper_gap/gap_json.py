"""gap.json: the answer, in the form docs/gap.md fixes."""
import json

import numpy as np

from .decision.patch import overlay
from .statistics.isolability import CONFUSABLE

SHOWN_P = 0.05  # cells whose adjusted p is larger are left out of `disagreement`


def as_json(out, catalogue, hashes):
    """The contract of docs/gap.md as a dict; numbers that do not exist are null."""
    v = out.look.verdict
    lead = next(iter(out.effects), "")
    return {
        "verdict": v.verdict,
        "effect": lead or None,
        "class": list(v.members) if v.verdict in ("named", "class") else [],
        "probability": v.probability,
        "parameter": _parameter(out, catalogue, lead) if lead else None,
        "disagreement": _disagreement(out),
        "confusable": _confusable(out, lead or (v.members[0] if v.members else "")),
        "gap": _gap(out),
        "rejected": [{"effect": n, "probability": p, "reason": r} for n, p, r in v.rejected],
        "patch": overlay(out.effects or ({out.added.name: 1.0} if out.added else {})),
        "trucks": out.trucks,
        "reference": _reference(out),
        "fidelity": _fidelity(out.known),
        "history": _history(out, catalogue),
        "law": _law(out) if out.laws else None,
        "face": [{"what": f.kind, "unit": f.unit, "before": f.before, "now": f.now, "p_adjusted": f.p}
                 for f in out.faces],
        "runs": out.runs,
        "ended_early": out.early,
        "seeds": out.seeds,
        "hashes": hashes,
        "omnibus_p": out.look.disagreement.omnibus_p,
        "reasons": list(v.reasons),
        "intervals": {n: list(i) for n, i in out.intervals.items()},
        "second": out.second,
        "next_experiment": [{"name": p.name, "title": p.title, "minutes": p.minutes, "bits": p.bits}
                            for p in out.proposals[:3]],
        "warnings": list(out.warnings)}


def _parameter(out, catalogue, name):
    e = catalogue[name]
    return {"name": e.parameter, "unit": e.unit, "estimate": out.effects[name],
            "interval90": list(out.intervals[name])}


def _law(out):
    """The best law, and in `also` those of other forces."""
    first, *others = ({"channel": law.channel, "terms": [{"term": n, "kN": a} for n, a in law.terms],
                       "words": law.words, "p": law.p, "holdout_explained": law.explained} for law in out.laws)
    return {**first, "effect": out.added.name, "also": others}


def _fidelity(known):
    """The known errors of the model, and the factor on the rock's resistance that follows from it."""
    if not known:
        return None
    of = {"dig_force": known.fidelity.dig_force, "payload": known.fidelity.payload, "resistance": known.resistance}
    factors = {n: [f.low, f.value, f.high] for n, f in of.items()}
    return {**factors, "by_phase": known.fidelity.by_phase, "not_compared": list(known.fidelity.not_compared)}


def _reference(out):
    return {"trucks": out.reference, "model_gap": out.model_gap} if out.reference else None


def _history(out, catalogue):
    """Truck by truck since the reference, and when it began."""
    h = out.history
    if not h:
        return None
    unit = catalogue[h.effect].unit if h.effect else "of the gap"
    return {"effect": h.effect, "unit": unit,
            "trucks": [{"period": t.period, "truck": t.truck, "time": t.time, "strength": t.strength, "sd": t.sd}
                       for t in h.trucks],
            "began": _began(h) if h.trend else None}


def _began(h):
    """Between which trucks, counted from the reference's first; each `after` is of the truck before the change."""
    t, (low, high) = h.trend, h.trend.interval90
    return {"after_trucks": t.began, "interval90_trucks": [low, high], "shape": t.shape, "size": t.size,
            "size_sd": t.size_sd, "after": h.trucks[t.began - 1].time, "before": h.trucks[t.began].time,
            "interval90": [h.trucks[low - 1].time, h.trucks[high].time]}


def _disagreement(out):
    d, cells = out.look.disagreement, out.look.training.baseline.cells
    order = np.argsort(d.p_adjusted, kind="stable")
    return [{"pass": cells[i].pass_number, "phase": cells[i].phase, "channel": cells[i].channel,
             "feature": cells[i].feature, "z": float(d.z[i]), "p_adjusted": float(d.p_adjusted[i])}
            for i in order if d.p_adjusted[i] <= SHOWN_P]


def _confusable(out, name):
    """What could be taken for the leading effect, the nearest first."""
    t = out.look.table
    if not name:
        return []
    i = t.names.index(name)
    pairs = [(t.d_prime[i, j], n) for j, n in enumerate(t.names) if j != i]
    return [{"effect": n, "distinguishability": float(d), "same_class": bool(d < CONFUSABLE)}
            for d, n in sorted(pairs)]


def _gap(out):
    z = out.look.disagreement.z
    train, held = out.confirmed.get("training"), out.confirmed.get("holdout")
    return {"before": float(np.mean(z**2)), "after": train.after if train else None,
            "floor": train.floor if train else 1.0, "closure": train.closure if train else None,
            "closure_interval90": _list(train and train.interval90),
            "holdout_closure": held.closure if held else None,
            "holdout_interval90": _list(held and held.interval90),
            "holdout_p": held.p if held else None}


def _list(pair):
    return list(pair) if pair else None


def write_json(data, file):
    file.write_text(json.dumps(data, indent=2, allow_nan=False) + "\n")
