"""What a study's page shows, as JSON; analysis/report/web/pages/study.js draws it (docs/study.md)."""
import numpy as np

from dipper_run.page_data import plain
from dipper_run.program import output_of

from .goal import COLUMNS
from .statistics import compare, summary


def write_page(study, rows, failures, answer, file, warnings=(), case_title=None):
    """The page, written by `dipper page`; raises ProgramFailed with what it says when it cannot."""
    output_of("page", file, given=page(study, rows, failures, answer, warnings, case_title))


def page(study, rows, failures=(), answer=None, warnings=(), case_title=None):
    """The page's data. Only finite numbers: what is none is null."""
    done = [r for r in rows if r["status"] == "complete"]
    columns = [c for c in COLUMNS if any(np.isfinite(r[c]) for r in done)]
    return plain({
        "kind": "study", "title": f"{case_title}: {study.file.stem}" if case_title else study.file.stem,
        "case": str(study.case), "seeds": study.seeds, "keep": study.keep,
        "counts": {s: sum(r["status"] == s for r in rows) for s in ("complete", "unfinished", "failed", "not made")},
        "columns": [{"name": c, "title": COLUMNS[c]} for c in columns],
        "parameters": study.names,
        "charts": [_chart(p, study, done, columns) for p in study.parameters[:1] if columns],
        "trends": [t for p in study.parameters for t in _trends(p, study, done, columns)],
        "comparisons": [c for p in study.parameters for c in comparisons(p, study.names, done, columns)],
        "points": _points(study.names, done, columns),
        "runs": [{**row, "report": f"runs/{row['run']}/report/report.html"} for row in rows],
        "failures": list(failures), "warnings": list(warnings), "answer": answer})


def _chart(parameter, study, rows, columns):
    """The first parameter's values along x; a line for every combination of the others."""
    others = [n for n in study.names if n != parameter.name]
    numbers = [v.number for v in parameter.values]
    chart = {"name": parameter.name, "names": [v.name for v in parameter.values],
             "numbers": None if None in numbers or len(set(numbers)) < len(numbers) else numbers, "lines": []}
    for key in dict.fromkeys(tuple(r[n] for n in others) for r in rows):
        of_line = [r for r in rows if tuple(r[n] for n in others) == key]
        cells = [[r for r in of_line if r[parameter.name] == v.name] for v in parameter.values]
        chart["lines"].append({
            "label": ", ".join(f"{n} {v}" for n, v in zip(others, key)) or "mean",
            "summaries": {c: [vars(summary([r[c] for r in cell])) for cell in cells] for c in columns},
            "seeds": {c: [[next((r[c] for r in cell if r["seed"] == s), None) for cell in cells] for s in study.seeds]
                      for c in columns}})
    return chart


def _trends(parameter, study, rows, columns):
    """Slope of each column against a parameter that is a number: over seeds, of each the mean over the others' values.
    """
    if any(v.number is None for v in parameter.values) or len({v.number for v in parameter.values}) < 2:
        return
    number = {v.name: v.number for v in parameter.values}
    for column in columns:
        slopes = {}
        for key, group in _groups(rows, parameter.name, study.names).items():
            x, y = np.array([(number[r[parameter.name]], r[column]) for r in group]).T
            if len(x) == len(number) and np.isfinite(y).all():
                off = x - x.mean()
                slopes[key] = off @ (y - y[0]) / (off @ off)  # 0 exactly of a figure that stays
        if slopes:
            yield {"parameter": parameter.name, "column": column, **vars(summary(_means_by_seed(slopes).values()))}


def comparisons(parameter, names, rows, columns):
    """Every value of a parameter against its first, with paired seeds: of each the mean over the others' values that
    both have."""
    first = parameter.values[0].name
    for value in parameter.values[1:]:
        for column in columns:
            a, b = ({key: r[column] for key, group in _groups(rows, parameter.name, names).items() for r in group
                     if r[parameter.name] == name and np.isfinite(r[column])} for name in (first, value.name))
            c = compare(*(_means_by_seed({key: side[key] for key in a.keys() & b.keys()}) for side in (a, b)))
            yield {"parameter": parameter.name, "value": value.name, "against": first, "column": column,
                   "confidence": c.confidence, "shown": c.shown, **vars(c.difference)}


def _groups(rows, name, names):
    """{(seed, the other parameters): its rows}."""
    found = {}
    for r in rows:
        found.setdefault((r["seed"], *(r[n] for n in names if n != name)), []).append(r)
    return found


def _means_by_seed(values):
    """{seed: mean} of {(seed, the other parameters): value}: runs of one seed are not independent."""
    found = {}
    for (seed, *_), value in values.items():
        found.setdefault(seed, []).append(value)
    return {seed: float(np.mean(of_seed)) for seed, of_seed in found.items()}


def _points(names, rows, columns):
    found = {}
    for r in rows:
        found.setdefault(tuple(r[n] for n in names), []).append(r)
    return [{"values": key, "figures": {c: vars(summary([r[c] for r in cell])) for c in columns}}
            for key, cell in found.items()]
