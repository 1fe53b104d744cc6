#!/usr/bin/python3
"""What the mine and the model differ by with nothing hidden: force and mass, phase by phase.

usage: fidelity.py TABLE [OBSERVED ...]

OBSERVED are folders that `dipper observe RUN` wrote of runs of cases/screening; the mine's are all in runs/base, seen
by the same 1 Hz logger without errors; of a truck that is not finished its digs so far. What
docs/data/screening_passes.csv says of the model is compared too. TABLE gets, for each pass and phase, means over the
trucks and their standard deviations.
"""
import csv
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from cycle import Dig  # noqa: E402
from instruments import second_means, truck_log  # noqa: E402
from make import PASSES  # noqa: E402
from shovel import Motion  # noqa: E402

PHASES = ("approach", "penetrate", "fill", "breakout", "swing", "dump", "return")
FORCES = ("hoist_force_kN", "crowd_force_kN")


def marks(time, crowd, swing):
    """Ends of the phases but the last, s, of one pass (docs/metrics.md): shares of the crowd's stroke and the swing."""
    out = np.argmax(crowd >= crowd.min() + 0.97 * np.ptp(crowd))
    turned = np.abs(swing - swing[out])
    largest = turned[out:].max()
    faces = turned <= 0.05 * largest
    begin = out - np.argmin(faces[:out][::-1]) if not faces[:out].all() else 0
    end = out + np.argmin(faces[out:])
    start = begin + np.argmin(crowd[begin:out + 1])
    stroke = crowd[start:end].max() - crowd[start]

    def first(past, since):
        return time[since + np.argmax(past[since:])]
    there = np.flatnonzero(turned > 0.97 * largest)
    there = there[there >= out]
    return [first(crowd >= crowd[start] + s * stroke, start) for s in (0.10, 0.45, 0.97)] + [
        first(turned >= 0.05 * largest, out), time[there[0]], time[there[-1]]]


def figures(time, signals, passes):
    """{(pass, phase, figure): value} of a truck: mean and largest of each force, and the tonnes."""
    said = {}
    for number, (start, end, tonnes) in enumerate(passes, 1):
        inside = (time > start) & (time <= end)
        t = time[inside]
        fine = np.arange(t[0], t[-1], 0.05)
        crowd, swing = (np.interp(fine, t, signals[n][inside]) for n in ("crowd_m", "swing_rad"))
        edges = [t[0] - 1, *marks(fine, crowd, swing), t[-1]]
        for phase, a, b in zip(PHASES, edges, edges[1:]):
            within = (t > a) & (t <= b + 1e-9)
            for name in FORCES:
                if within.any():
                    said[number, phase, f"{name} mean"] = signals[name][inside][within].mean()
                    said[number, phase, f"{name} peak"] = np.abs(signals[name][inside][within]).max()
        said[number, "dump", "truck_mass_t"] = tonnes
    return said


def observed(folder):
    head = (folder / "signals.csv").open().readline().strip().split(",")
    signals = dict(zip(head, np.loadtxt(folder / "signals.csv", delimiter=",", skiprows=1).T))
    rows = np.loadtxt(folder / "passes.csv", delimiter=",", skiprows=1, ndmin=2)[:PASSES, 1:4]
    return figures(signals.pop("time_s"), signals, rows)


def own(folder, motion):
    """The figures of one of the mine's trucks, and those of the committed table of the model's passes."""
    digs = [Dig.load(folder, k + 1) for k in range(PASSES) if (folder / f"pass_{k + 1}.csv.gz").exists()]
    log, passes = truck_log(digs, motion, {})
    time, means = second_means(log)
    said = figures(time, means, [(a, b, m) for (a, _, b), m in zip(passes, log.tonnes)])
    force = np.hypot(log.signals["hoist_force_kN"], log.signals["crowd_force_kN"]) / 1e3
    for k, (d, (_, dump, _)) in enumerate(zip(digs, passes)):
        touched = 34.0 * k + d.table[np.argmax(np.linalg.norm(d.table[:, 1:4], axis=1) > 20e3), 0]
        dug = (log.time_s > touched) & (log.time_s < dump)
        said[k + 1, "dig to dump", "dig_force_mean_MN"] = force[dug].mean()
        said[k + 1, "dig to dump", "dig_force_peak_MN"] = force[dug].max()
        said[k + 1, "dig to dump", "payload_t"] = log.tonnes[k]
    return said


def known(file=HERE.parents[1] / "docs/data/screening_passes.csv"):
    """Of cases/screening, 16 runs: [{(pass, phase, figure): value}]."""
    with open(file) as f:
        rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
    names = ("dig_force_mean_MN", "dig_force_peak_MN", "payload_t")
    return [{(int(r["pass"]), "dig to dump", n): float(r[n]) for r in rows if r["seed"] == seed for n in names}
            for seed in dict.fromkeys(r["seed"] for r in rows)]


def main(words):
    if not words:
        print(__doc__, file=sys.stderr)
        return 2
    motion = Motion.read(HERE.parents[1] / "cases/screening/motion.csv")
    mine = [own(f, motion) for f in sorted((HERE / "runs/base").iterdir()) if (f / "pass_1.csv.gz").exists()]
    model = [observed(Path(w)) for w in words[1:]] + known()
    rows = ["# tests/gap_mine/fidelity.py: nothing hidden, no errors of instruments; sd of single trucks",
            "# forces of a phase as a logger of 1 Hz shows them, kN; from dig to dump at full rate",
            "pass,phase,figure,mine,mine_sd,mine_trucks,model,model_sd,model_runs,ratio"]
    order = (*PHASES, "dig to dump")
    for key in sorted({k for said in mine for k in said}, key=lambda k: (k[0], order.index(k[1]), k[2])):
        a, b = (np.array([said[key] for said in side if key in said]) for side in (mine, model))
        sd = [f"{x.std(ddof=1):.4g}" if len(x) > 1 else "" for x in (a, b)]
        theirs = f"{b.mean():.4g},{sd[1]},{len(b)},{a.mean() / b.mean():.3f}" if len(b) else ",,0,"
        rows.append(f"{key[0]},{key[1]},{key[2]},{a.mean():.4g},{sd[0]},{len(a)},{theirs}")
    Path(words[0]).write_text("\n".join(rows) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
