"""What the page of an analysis shows, as JSON; analysis/report/web draws it (docs/report.md)."""
from dataclasses import asdict

from dipper_run.page_data import plain
from dipper_run.program import output_of

from .readings.features import FEATURES
from .readings.channels import KNOWN
from .readings.phases import in_order
from .statistics.isolability import CONFUSABLE
from .statistics.match import strength

CELL_P = 0.05     # adjusted p up to which a cell of the heat map is framed


def write_report(out, answer, catalogue, file, case_name):
    """The page, written by `dipper page`; raises ProgramFailed with what it says when it cannot."""
    output_of("page", file, given=page(out, answer, catalogue, case_name))


def page(out, answer, catalogue, case_name):
    """The page's data; `answer` is gap.json. Only finite numbers: what is none is null."""
    shown = plain({
        "effects": {n: {"title": e.title, "parameter": e.parameter, "unit": e.unit, "signature": e.signature,
                        "low": e.low, "high": e.high} for n, e in catalogue.items()},
        "passes": {"training": out.look.training.passes, "holdout": out.look.holdout.passes},
        "stability": out.stability,
        "inflation": out.inflation,
        "phases": _phases(out),
        "rows": _rows(out.look.training.baseline.cells),
        "cell_p": CELL_P,
        "cells": _cells(out),
        "ranking": _ranking(out, catalogue),
        "nothing": out.look.matched.probability["none"],
        "unknown": out.look.matched.probability["unknown"],
        "apart": {"names": out.look.table.names, "strengths": out.look.table.strengths, "d": out.look.table.d,
                  "found_from": out.look.table.limits, "d_prime": out.look.table.d_prime,
                  "confusable_below": CONFUSABLE},
        "closures": {name: {"before": c.before, "after": c.after, "floor": c.floor, "t2": c.t2, "rivals": c.rivals}
                     for name, c in out.confirmed.items()},
        "curves": [_of_pass(c) for c in sorted(out.curves, key=lambda c: (c.held_out, c.pass_number))],
        "masses": [_of_pass(m) for m in out.masses],
        "experiments": [asdict(p) for p in out.proposals]})
    return {"kind": "gap", "title": case_name, "answer": answer, **shown}


def _phases(out):
    """Columns of the heat map, in the order of a pass; the truck's mass may be in one of its own."""
    cells = (c.phase for c in out.look.training.baseline.cells)
    return list(dict.fromkeys([*in_order(c.phases for c in out.curves), *cells]))


def _rows(cells):
    """(channel, feature) of the heat map's rows, in the order of the catalogue of channels."""
    known = list(KNOWN)
    return sorted({(c.channel, c.feature) for c in cells},
                  key=lambda r: (known.index(r[0]) if r[0] in known else len(known), FEATURES.index(r[1])))


def _cells(out):
    """Before and, once fresh runs have been made, after; the hold-out's have no p: they are not searched."""
    rows = [{**_cell(c), "z": z, "p_adjusted": p} for c, z, p in
            zip(out.look.training.baseline.cells, out.look.disagreement.z, out.look.disagreement.p_adjusted)]
    if not out.confirmed:
        return rows
    rows += [{**_cell(c), "z": z} for c, (z, _) in
             zip(out.look.holdout.baseline.cells, out.confirmed["holdout"].z)]
    after = [z for name in ("training", "holdout") for _, z in out.confirmed[name].z]
    return [{**row, "z_after": z} for row, z in zip(rows, after)]


def _cell(c):
    return {"pass": c.pass_number, "phase": c.phase, "channel": c.channel, "feature": c.feature}


def _of_pass(c):
    shown = asdict(c)
    return {"pass": shown.pop("pass_number"), **shown}


def _ranking(out, catalogue):
    """Every effect that may be named, the likeliest first; its strength if it is there."""
    m, rows = out.look.matched, []
    for s in sorted(out.look.training.signatures, key=lambda s: -m.presence(s.name)):
        low, middle, high = strength(m, s.name, out.look.training.signatures)
        low, high = out.intervals.get(s.name, (low, high))
        rows.append({"effect": s.name, "probability": m.presence(s.name), "low": low, "high": high,
                     "estimate": out.effects.get(s.name, middle)})
    return rows
