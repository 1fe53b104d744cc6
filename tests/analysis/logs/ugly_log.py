"""A log as a mine's logger might leave it, made of known signals: for the tests, and docs/data/import/shift.csv.

usage: /usr/bin/python3 tests/analysis/logs/ugly_log.py RUN OUT.csv
RUN is what `dipper run cases/screening --no-rock=estimate` left.
"""
import subprocess
import sys
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "analysis" / name) for name in ("logs", "gap", "runs")]

import dipper_run  # noqa: E402
from dipper_import.fit import motion_curve  # noqa: E402

MOTION = Path(__file__).resolve().parent / "motion.csv"
START = datetime(2026, 3, 14, 6, 12, 0)
FEET, KIP, SHORT_TON = 0.3048, 4.4482216152605, 0.90718474
CROWD_RANGE = (-1.7, 3.2)  # m at 0 and 100 %
NAMES = "Date;Time;Hoist rope in, ft;Crowd %;Swing cw;Trip;Hoist pull kip;Crowd push kip;Truck scale st"


@dataclass(frozen=True)
class Truth:
    """Own units of the channels (units.py): m, deg, kN, t."""

    time_s: np.ndarray
    channels: dict


def planned(rate_hz, motion=MOTION):
    """The drives of a motion.csv at a logger's rate."""
    table = np.loadtxt(motion, delimiter=",", skiprows=3)
    time = np.arange(0, table[-1, 0] + 1e-9, 1 / rate_hz)
    return Truth(time, {name: motion_curve(table[:, 0], table[:, k])(time)
                        for k, name in enumerate(("hoist", "crowd", "swing", "door"), 1)})


def with_forces(truth, hoist_kN, crowd_kN, truck_t):
    more = {"hoist_force": hoist_kN, "crowd_force": crowd_kN, "truck_mass": truck_t}
    return Truth(truth.time_s, {**truth.channels, **more})


def rows_of(truth, seed):
    """A line a reading: feet, % of a range, clockwise degrees, a switch, kips and short tons, with noise."""
    rng = np.random.default_rng(seed)
    c, n = truth.channels, len(truth.time_s)
    noise = lambda size: size * rng.standard_normal(n)
    columns = [
        -(c["hoist"] + noise(0.01)) / FEET + 3.0,  # its zero is 3 ft off
        100 * (c["crowd"] + noise(0.01) - CROWD_RANGE[0]) / (CROWD_RANGE[1] - CROWD_RANGE[0]),
        -(c["swing"] + noise(0.1)),
        (c["door"] > 1.1).astype(float),
        (c["hoist_force"] + noise(20)) / KIP,
        (c["crowd_force"] + noise(20)) / KIP,
        np.maximum(0, c["truck_mass"] + noise(0.2)) / SHORT_TON,
    ]
    formats = ("{:.2f}", "{:.1f}", "{:.1f}", "{:.0f}", "{:.0f}", "{:.0f}", "{:.1f}")
    out = []
    for k, t in enumerate(truth.time_s):
        at = START + timedelta(seconds=float(t))
        stamp = [at.strftime("%d.%m.%Y"), at.strftime("%H:%M:%S,") + f"{at.microsecond // 1000:03d}"]
        out.append(stamp + [f.format(column[k]).replace(".", ",") for f, column in zip(formats, columns)])
    return out


def set_clock_back(rows, from_row, seconds):
    """The logger's clock, set back at a row."""
    out = [list(row) for row in rows]
    for row in out[from_row:]:
        at = datetime.strptime(" ".join(row[:2]), "%d.%m.%Y %H:%M:%S,%f") - timedelta(seconds=seconds)
        row[1] = at.strftime("%H:%M:%S,") + f"{at.microsecond // 1000:03d}"
    return out


def ugly(rows):
    """Text of the file: swapped rows, rows twice, a gap, a spike, empty cells, a clock set back, BOM and CRLF."""
    n = len(rows)
    rows = set_clock_back(rows, int(0.8 * n), 7.0)
    rows[int(0.3 * n)][2] = "999,99"
    rows[int(0.35 * n)][3] = ""
    rows[int(0.35 * n) + 1][3] = "NaN"
    order = list(range(n))
    for k in (int(0.1 * n), int(0.55 * n)):
        order[k], order[k + 1] = order[k + 1], order[k]
    block = int(0.7 * n)
    order[block:block + 6] = order[block + 3:block + 6] + order[block:block + 3]
    gap = int(0.45 * n)
    order = [k for k in order if not gap < k < gap + 5]
    twice = order.index(int(0.2 * n))
    order[twice:twice] = order[twice:twice + 3]
    lines = ["Shovel 12 drive logger;export of shift A", "", NAMES, *(";".join(rows[k]) for k in order)]
    return "\ufeff" + "\r\n".join(lines) + "\r\n"


def of_run(folder, rate_hz=5.0):
    """The signals of a run as its logger and the truck's scale would have them: `dipper observe` gives the forces."""
    observed = Path(folder) / "as_logged"
    subprocess.run([ROOT / "build/release/bin/dipper", "observe", folder, "--out", observed,
                    "--set", f"observation.rate_Hz={rate_hz}"], check=True)
    forces = np.loadtxt(observed / "signals.csv", delimiter=",", skiprows=1)
    run, time = dipper_run.read(folder), forces[:, 0]
    drives = {name: np.interp(time, run.time_s, run[f"machine/{name}"]) for name in ("hoist", "crowd", "swing", "door")}
    truck = np.zeros(len(time))
    for p in run.summary["passes"]:
        truck += 1e-3 * p["truck_kg"] * np.clip((time - p["t_dump_s"] - 0.5) / 2.0, 0, 1)
    drives.update(swing=np.degrees(drives["swing"]), door=np.degrees(drives["door"]))
    return with_forces(Truth(time, drives), forces[:, 4], forces[:, 5], truck)


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(ugly(rows_of(of_run(sys.argv[1]), seed=1)), newline="")
