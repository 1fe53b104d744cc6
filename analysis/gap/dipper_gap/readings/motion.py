"""The motion that a case plans, against the one that was measured: before anything runs."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from dipper_run.findings import BadInput, Findings

from .before import RATES
from .channels import MOTION
from .lag import best_lag_s
from .number_table import read_table
from .passes import NEED_PASSES
from .phases import planned_passes

COLUMNS = ("time_s", "hoist_m", "crowd_m", "swing_deg", "door_deg")
DURATION = 0.25         # of a pass's: from so much on its duration is another
# Assumed: from so much on the drives do not do the same. Twice what a slow logger and an operator's hand leave.
LARGEST_RMS = {"hoist_m": 0.5, "crowd_m": 0.3, "swing_rad": 0.1}
MEASURED_ONE = "is its motion the measured one?"
HOLE = 2.5              # medians: so long without a reading is no jitter of the logger's


@dataclass(frozen=True)
class PlannedMotion:
    time_s: np.ndarray
    drives: dict         # {channel of MOTION: (rows,)}
    passes: tuple        # (start, end) in s of each pass that ends with a dump
    step_s: float        # from one reading of a run to the next


def read_motion(case, values):
    """The motion of a case folder; `values` {key: value} and the motion are as `dipper check` found them."""
    found = Findings()
    table, *_ = read_table(Path(case) / values["machine.motion"], COLUMNS, found)
    found.raise_if_any()
    end = float(values["end_s"] or np.inf)
    time, door = table["time_s"], np.radians(table["door_deg"])
    drives = {"hoist_m": table["hoist_m"], "crowd_m": table["crowd_m"], "swing_rad": np.radians(table["swing_deg"])}
    end = min(end, time[-1])
    run = np.append(time[time < end], end)
    return PlannedMotion(time, drives, planned_passes(run, np.interp(run, time, door)),
                         1 / values["observation.rate_Hz"])


def compare_motion(measured, plan):
    """What differs, a line each; throws BadInput when too few passes are both measured and planned."""
    numbers = sorted({p.number for p in measured.passes})
    both = [n for n in numbers if n <= len(plan.passes)]
    if len(both) < NEED_PASSES:
        raise BadInput([f"{Path(measured.folder) / 'passes.csv'}: pass: {len(numbers)} measured, and the case's motion "
                        f"digs {len(plan.passes)}; {NEED_PASSES} or more that both have: give the case the measured "
                        "motion"])
    out = []
    if len(both) < len(numbers) or len(both) < len(plan.passes):
        out.append(f"{len(numbers)} passes are measured and the case digs {len(plan.passes)}: {len(both)} are compared")
    trucks = measured.trucks()

    def of_truck(m):
        return f" of truck {m.passes[0].truck}" if len(trucks) > 1 else ""

    for number in both:
        start, end = plan.passes[number - 1]
        mine, m = max(((_duration(m, number), m) for m in trucks), key=lambda x: abs(x[0] - (end - start)))
        if abs(mine - (end - start)) > DURATION * (end - start):
            out.append(f"pass {number}{of_truck(m)} takes {mine:.1f} s in the mine and {end - start:.1f} s in the "
                       f"case: {MEASURED_ONE}")
    if len(measured.time_s):
        out += dict.fromkeys(line for m in trucks for p in m.passes if p.number in both
                             for line in _of_readings(m.time_s, p, plan.step_s))
    names = [n for n in MOTION if n in measured.signals]
    off, lag = [], 0.0
    for m in trucks if names else ():
        lag, rms = _least_rms(m, [p for p in m.passes if p.number in both], plan, names, lag)
        off.append((rms, m))
    for n in names:
        rms, m = max(((rms[n], m) for rms, m in off), key=lambda x: x[0])
        if rms > LARGEST_RMS[n]:
            out.append(f"{n}{of_truck(m)} is {rms:.2g} {n.rsplit('_', 1)[1]} (rms) off the case's motion: "
                       + MEASURED_ONE)
    return tuple(out)


def _duration(m, number):
    return next(p.t_end_s - p.t_start_s for p in m.passes if p.number == number)


def _least_rms(m, passes, plan, names, lag):
    """(lag, _rms): with a lag that does, as the last truck's mostly does, else the one at which it is least."""
    def misfit(lag):
        return sum((x / LARGEST_RMS[n]) ** 2 for n, x in _rms(m, passes, plan, names, lag).items())

    rms = _rms(m, passes, plan, names, lag)
    if any(rms[n] > LARGEST_RMS[n] for n in names):
        lag = best_lag_s(misfit)
        rms = _rms(m, passes, plan, names, lag)
    return lag, rms


def _of_readings(time_s, p, plan):
    """Whether a pass is read as often as the runs are, every `plan` s: peaks and slopes depend on it."""
    inside = time_s[(time_s >= p.t_start_s) & (time_s <= p.t_end_s)]
    if len(inside) < 2:
        return
    median, longest = np.median(np.diff(inside)), np.diff([p.t_start_s, *inside, p.t_end_s]).max()
    if not 1 / RATES <= median / plan <= RATES:
        yield (f"a reading every {median:.3g} s, and the case's every {plan:.3g} s: set observation.rate_Hz in the "
               "case")
    if longest > HOLE * median:
        yield f"{longest:.3g} s without a reading in pass {p.number} of truck {p.truck}"


def _rms(m, passes, plan, names, lag):
    """{channel: rms of measured less planned} within the passes, the mine's clock set to the plan's less `lag`."""
    inside = np.flatnonzero((m.time_s > passes[0].t_start_s) & (m.time_s <= passes[-1].t_end_s))[1:]
    to_plan = plan.passes[passes[0].number - 1][0] - passes[0].t_start_s + lag
    before, after = m.time_s[inside - 1] + to_plan, m.time_s[inside] + to_plan
    known = (before >= plan.time_s[0]) & (after <= plan.time_s[-1])
    return {n: float(np.sqrt(np.mean((m.signals[n][inside] - _mean(plan, n, before, after))[known] ** 2)))
            if known.any() else np.inf for n in names}


def _mean(plan, name, before, after, points=5):
    """Mean of a planned drive between two arrays of times: a logger gives the mean since its last reading."""
    at = before + (after - before) * np.linspace(0, 1, points)[:, None]
    return np.interp(at, plan.time_s, plan.drives[name]).mean(axis=0)
