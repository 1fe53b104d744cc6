"""What a reader should know of a comparison itself, a line each."""
import numpy as np

from .readings.before import check_reference
from .readings.face import CHANGED_P

MOTION_TOLERANCE_S = 1.0
SCATTERS = 2.0  # variance of the trucks' passes, in the model's, from which the report says so


def other_faces(faces):
    """Where the trucks did not dig at faces like the reference's."""
    return tuple(f"the face differs from that of the reference: {f.kind} {f.now:.3g} {f.unit} for {f.before:.3g} (p "
                 f"{f.p:.2g}): what the rock and the place of the shovel do is in the difference too"
                 for f in faces if f.kind in ("slope", "toe", "crest") and f.p < CHANGED_P)


def changing(by_truck, catalogue):
    """Of an effect that is not the same in all trucks: what is named is its mean over them."""
    if not by_truck:
        return ()
    t, unit = by_truck.trend, catalogue[by_truck.effect].unit
    how = {"step": "at once", "ramp": "little by little", "unclear": "in some way"}[t.shape]
    size = f"{t.size:.3g} {unit} +- {2 * t.size_sd:.2g} (2 sd)"
    return (f"{by_truck.effect} is not the same in all trucks: it changes by {size}, {how}, after truck "
            f"{by_truck.trucks[t.began - 1].truck}; the named strength is the mean over the trucks",)


def within(by_truck, before):
    """Of a change that came while the measured trucks were loaded: their mean, which is what is named, is less."""
    if not (by_truck and by_truck.trend and by_truck.trend.interval90[0] > before):
        return ()
    return (f"it began after {by_truck.trend.began - before} of the measured trucks: the results here are for the "
            "mean of all of them; give the trucks since then alone, and those before it to the reference",)


def warnings(model, prediction, measured, before=None, known=None):
    """What a reader should know of the comparison itself; `known` are KnownErrors by which runs were corrected."""
    out = [*measured.questions(), *motion_warnings(model, measured)]
    if known:
        out.append(str(known.fidelity))
    if before:
        out += reference_warnings(model, measured, before)
    elif prediction.baseline.scatter > SCATTERS:
        out.append(f"the trucks' passes vary {np.sqrt(prediction.baseline.scatter):.1f} times as much as the "
                   "model's from seed to seed: was each dug at a face like the case's?")
    return tuple(out)


def motion_warnings(model, measured):
    """Where a truck's phase takes another time than the model's; the worst truck of each."""
    trucks, out = model.vectors.of_mine(measured)[2], []
    for k, (number, durations) in enumerate(zip(model.passes, model.vectors.durations)):
        for phase in dict.fromkeys([*durations, *(p for t in trucks for p in t[k])]):
            simulated = durations.get(phase, 0.0)
            mine = max((t[k].get(phase, 0.0) for t in trucks), key=lambda s: abs(s - simulated))
            if abs(mine - simulated) > MOTION_TOLERANCE_S:
                out.append(f"pass {number}: {phase} takes {mine:.1f} s in the mine and {simulated:.1f} s in the model: "
                           "is the case's motion the measured one?")
    return out


def reference_warnings(model, measured, before):
    """Where the trucks now take another time than those before: what a drive does otherwise is no effect."""
    out = [*before.questions(), *check_reference(measured, before)]
    (now, then) = (model.vectors.of_mine(m.seen_by(measured.channels))[2] for m in (measured, before))
    for k, number in enumerate(model.passes if measured.signals and before.signals else ()):
        for phase in dict.fromkeys(p for t in (*now, *then) for p in t[k]):
            a, b = (np.mean([t[k].get(phase, 0.0) for t in trucks]) for trucks in (now, then))
            if abs(a - b) > MOTION_TOLERANCE_S:
                out.append(f"pass {number}: {phase} takes {a:.1f} s now and {b:.1f} s in the reference: the motion has "
                           "changed, and forces with it")
    return out
