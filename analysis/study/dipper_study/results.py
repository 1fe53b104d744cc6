"""A study's table: a row a run, as CSV and HDF5."""
import csv
import os
import re

import h5py
import numpy as np

import dipper_run

from .goal import COLUMNS

FIGURES = (*COLUMNS, "passes", "passes_to_fill", "truck_filled_fraction", "truck_load_fraction", "cycle_s",
           "tonnes_per_hour", "energy_J_per_kg", "warnings", "cpu_s", "wall_s")

PURE = ("fill_factor", "fill_factor_load", "passes", "passes_to_fill", "truck_filled_fraction", "truck_load_fraction",
        "warnings")
UNITS = {"tonnes_per_hour": "t/h", "energy_J_per_kg": "J/kg"}  # of others the last word of the name
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?!\w|\.\d)")


def row_of(planned, names, facts, failure=None):
    """{column: value} of a run; a failed one has its values, seed and status only."""
    row = {"run": planned.name, **{n: v.name for n, v in zip(names, planned.point.values)}, "seed": planned.seed,
           "status": "failed" if failure else "complete" if facts else "not made"}
    if facts and not failure:
        run = dipper_run.read(planned.folder)
        row |= figures(run)
        row |= {"warnings": len(warnings_of(run)), "status": "complete" if is_whole(run) else "unfinished"}
    return row


def is_whole(run):
    """Whether every pass was dumped: the figures of one that was cut short are no pass's. Bodies that follow a table
    of poses have no passes, and no table of them in their metrics."""
    passes = run.summary["passes"]
    if not passes and "passes" not in run.metrics:
        return True
    return bool(passes) and all(p.get("dumped", True) for p in passes)


def warnings_of(run):
    return run.summary.get("warnings", [])


def warned(texts_of_runs):
    """[(text, runs that have it)], most first. Texts that differ in their numbers alone are one, with their ranges."""
    found = {}  # {text without its numbers: (its texts, {index of a run})}
    for k, of_run in enumerate(texts_of_runs):
        for text in of_run:
            texts, runs = found.setdefault(NUMBER.sub("0", text), ([], set()))
            texts.append(text)
            runs.add(k)
    return sorted(((_with_ranges(texts), len(runs)) for texts, runs in found.values()), key=lambda one: -one[1])


def _with_ranges(texts):
    """The first text, with "38 to 49" for a number that differs among them."""
    columns = zip(*(NUMBER.findall(text) for text in texts))
    ranges = iter([dict.fromkeys((min(c, key=float), max(c, key=float))) for c in columns])
    return NUMBER.sub(lambda _: " to ".join(next(ranges)), texts[0])


def figures(run):
    """What a run is compared by: means over its passes, the largest for peaks. nan where there is no such figure."""
    passes, worked = run.summary["passes"], run.metrics.get("passes", [])
    truck = run.summary.get("truck", {})  # where the case has truck.rated_t
    mean = lambda rows, key, unit: float(np.mean([r.get(key, np.nan) for r in rows])) / unit if rows else np.nan
    return {"payload_t": mean(passes, "payload_kg", 1e3), "truck_t": mean(passes, "truck_kg", 1e3),
            "fill_factor": mean(passes, "fill_factor", 1), "fill_factor_load": mean(passes, "fill_factor_load", 1),
            "dig_force_mean_MN": mean(passes, "dig_force_mean_N", 1e6),
            "dig_phases_force_mean_MN": mean(passes, "dig_phases_force_mean_N", 1e6),
            "dig_force_peak_MN": max((p["dig_force_peak_N"] for p in passes), default=np.nan) / 1e6,
            "dig_work_MJ": mean(worked, "dig_work_J", 1e6), "passes": len(passes),
            "passes_to_fill": truck.get("passes_to_fill", np.nan),
            "truck_filled_fraction": truck.get("filled_fraction", np.nan),
            "truck_load_fraction": truck.get("load_fraction", np.nan),
            **operator_figures(run.summary.get("operator")),
            "cpu_s": run.summary["dem"]["cpu_s"] + run.summary["mbs"]["cpu_s"],
            "wall_s": run.summary["dem"]["wall_s"]}  # as cpu_s of all starts of a run that was resumed


def operator_figures(operator):
    """Of an operator who plans; nan for another: one who follows a motion has no such summary, a program its name."""
    of = operator if isinstance(operator, dict) else {}
    number = lambda key: np.nan if of.get(key) is None else of[key]
    cycles = of.get("cycles_s") or [np.nan]  # none after a single pass
    return {"cycle_s": float(np.mean(cycles)), "tonnes_per_hour": number("tonnes_per_hour"),
            "energy_J_per_kg": number("energy_J_per_kg")}


def write_csv(rows, names, file):
    columns = ["run", *names, "seed", "status", *FIGURES]
    part = file.with_suffix(".csv.part")
    with open(part, "w", newline="") as f:
        table = csv.writer(f, lineterminator="\n")
        table.writerow(columns)
        table.writerows([_text(row.get(c)) for c in columns] for row in rows)
    os.replace(part, file)


def write_hdf5(rows, names, file, study_text):
    """A dataset a column, in the order of the CSV; columns that are no numbers are text, missing figures nan."""
    part = file.with_suffix(".h5.part")
    with h5py.File(part, "w", locking=False) as f:
        f.attrs["study"] = study_text
        for column in ("run", "status"):
            f.create_dataset(column, data=[row[column] for row in rows], dtype=h5py.string_dtype())
        for name in names:
            _column(f.require_group("parameters"), name, [row[name] for row in rows])
        f["seed"] = np.array([row["seed"] for row in rows])
        for column in FIGURES:
            f[column] = np.array([row.get(column, np.nan) for row in rows], float)
            f[column].attrs["unit"] = "1" if column in PURE else UNITS.get(column, column.rsplit("_", 1)[-1])
    os.replace(part, file)


def _column(group, name, cells):
    try:
        group[name] = np.array([float(c) for c in cells])
    except ValueError:
        group.create_dataset(name, data=cells, dtype=h5py.string_dtype())


def _text(value):
    if value is None or isinstance(value, float) and not np.isfinite(value):
        return ""
    return f"{value:.6g}" if isinstance(value, float) else value
