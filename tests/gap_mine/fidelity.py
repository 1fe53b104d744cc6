#!/usr/bin/python3
"""What the mine and the model differ by with nothing hidden: force and mass, phase by phase.

usage: fidelity.py TABLE OBSERVED [OBSERVED ...]

OBSERVED are folders that `dipper observe RUN` wrote of runs of cases/screening; the mine's are all in runs/base, seen
by the same 1 Hz logger without errors. TABLE gets, for each pass and phase, means over the trucks and their standard
deviations, and the difference in units of both (z).
"""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from cycle import Dig  # noqa: E402
from instruments import second_means, truck_log  # noqa: E402
from make import PASSES, complete  # noqa: E402
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
    rows = np.loadtxt(folder / "passes.csv", delimiter=",", skiprows=1)[:PASSES, 1:4]
    return figures(signals.pop("time_s"), signals, rows)


def own(folder, motion):
    log, passes = truck_log([Dig.load(folder, k + 1) for k in range(PASSES)], motion, {})
    time, means = second_means(log)
    return figures(time, means, [(a, b, m) for (a, _, b), m in zip(passes, log.tonnes)])


def main(words):
    if len(words) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    motion = Motion.read(HERE.parents[1] / "cases/screening/motion.csv")
    mine = [own(f, motion) for f in complete(HERE / "runs/base")]
    model = [observed(Path(w)) for w in words[1:]]
    rows = [f"# tests/gap_mine/fidelity.py; mine: {len(mine)} trucks, model: {len(model)} runs of cases/screening; sd "
            "of single trucks, empty for one; kN as a logger of 1 Hz shows them, without errors",
            "pass,phase,figure,mine,mine_sd,model,model_sd,ratio"]
    for key in mine[0]:
        a, b = (np.array([said[key] for said in side if key in said]) for side in (mine, model))
        sd = [f"{x.std(ddof=1):.4g}" if len(x) > 1 else "" for x in (a, b)]
        if len(b):
            rows.append(f"{key[0]},{key[1]},{key[2]},{a.mean():.4g},{sd[0]},{b.mean():.4g},{sd[1]},"
                        f"{a.mean() / b.mean():.3f}")
    Path(words[0]).write_text("\n".join(rows) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
