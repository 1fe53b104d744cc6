"""Whether a mine's earlier trucks can be the reference of its measured folder: before anything runs."""
from pathlib import Path

import numpy as np

from dipper_run.findings import Findings

from .channels import FACE, MASS, MOTION
from .passes import NEED_PASSES

RATES = 1.5          # ratio of two loggers' rates from which peaks differ by what the slower one misses
FEW_TRUCKS = 2       # with fewer of both periods nothing tells how the mine's own trucks scatter


def check_reference(measured, before):
    """What is legal and hardly meant, a line each; throws BadInput for what cannot be compared."""
    found = Findings()
    now, then = Path(measured.folder), Path(before.folder)
    if measured.folder and now.resolve() == then.resolve():
        found.add(then, 0, "--reference", "is the measured folder itself", "a folder of earlier trucks")
        found.raise_if_any()
    check_channels(measured.channels, now, before, found)
    passes = [{p.number for p in m.passes} for m in (measured, before)]
    both = sorted(passes[0] & passes[1])
    if len(both) < NEED_PASSES:
        found.add(then / "passes.csv", 0, "pass", f"has passes {_list(passes[1])}, and {now} has {_list(passes[0])}",
                  f"{NEED_PASSES} or more that both have")
    same = _same_trucks(measured, before)
    if same:
        found.add(then / "passes.csv", 0, "truck", f"truck {same[0][1]} is truck {same[0][0]} of {now}",
                  "no truck in both: what changed must not be in the reference")
    found.raise_if_any()
    return _questions(measured, before, both, passes)


def check_channels(channels, folder, before, found):
    """Adds what the channels {name: Channel} of a `folder` have to answer that earlier trucks do not."""
    for name in (n for n in channels if n not in MOTION and n not in before.channels):
        found.add(Path(before.folder) / "channels.yaml", 0, name, f"not there, but {folder} has it",
                  f"what the same instrument read then, or leave {name} out of {folder}")


def _questions(measured, before, both, passes):
    out = []
    if len(both) < max(map(len, passes)):
        out.append(f"passes {_list(both)} are compared: the reference has {_list(passes[1])}, the measured folder "
                   f"{_list(passes[0])}")
    for name in (*measured.responses(), MASS, FACE):
        channel = measured.channels.get(name)
        if channel and channel.drift_sigma is None and (channel.common_sigma or before.channels[name].common_sigma):
            size = np.hypot(channel.common_sigma, before.channels[name].common_sigma)
            out.append(f"{name}: no drift_sigma: its shared error may have changed by {size:.3g} {channel.unit} since "
                       "the reference, as if another instrument had read it; drift_sigma in channels.yaml says how far "
                       "the same one drifts, and less is hidden")
    if len(measured.trucks()) + len(before.trucks()) - 2 < FEW_TRUCKS:
        out.append(f"{len(measured.trucks())} and {len(before.trucks())} trucks hardly show how the mine's own trucks "
                   "scatter: the model's scatter is taken")
    steps = [float(np.median(np.diff(m.time_s))) if len(m.time_s) > 1 else 1.0 for m in (measured, before)]
    if max(steps) > RATES * min(steps):
        out.append(f"a reading every {steps[0]:.3g} s now and every {steps[1]:.3g} s in the reference: peaks differ by "
                   "what the slower logger misses")
    return tuple(out)


def _same_trucks(measured, before):
    """[(truck, its number in the reference)] that are in both, by the durations and masses of all their passes and the
    first force in each."""
    forces = [n for n in measured.responses() if n in before.signals]
    weighed = MASS in measured.channels and MASS in before.channels

    def mark(truck):
        first = np.searchsorted(truck.time_s, [p.t_start_s for p in truck.passes])
        return (*((p.number, round(p.t_end_s - p.t_start_s, 3), weighed and p.truck_mass_t) for p in truck.passes),
                *(tuple(truck.signals[n][first]) for n in forces))

    if not forces and not weighed:
        return []
    known = {mark(t): t.passes[0].truck for t in before.trucks()}
    return [(t.passes[0].truck, known[mark(t)]) for t in measured.trucks() if mark(t) in known]


def _list(numbers):
    return ", ".join(map(str, sorted(numbers)))
