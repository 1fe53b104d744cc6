"""Forces and masses in other units, by what the case's machine weighs and carries."""
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
import yaml

from .channels import MASS

G = 9.80665              # m/s^2
TONNES = {"kg": 1e-3, "t": 1.0}
BEYOND_RATED = 1.3       # times the rated load, in the median: more than heaped dippers


@dataclass(frozen=True)
class Machine:
    empty_t: float = 0.0          # dipper and door; 0: not known
    rated_t: float = float("inf")


def read_machine(case, values):
    """Of the machine's file of a case folder; `values` {key: value} as `dipper check` found them."""
    data = yaml.safe_load((Path(case) / values["machine.model"]).read_text())

    def tonnes(part, key):
        entry = data.get(part, {}).get(key)
        return float(entry["value"]) * TONNES[entry["unit"]] if entry else None

    masses = tonnes("dipper", "mass"), tonnes("door", "mass")
    return Machine(sum(masses) if None not in masses else 0.0, tonnes("dipper", "rated_load") or float("inf"))


def machine_warnings(measured, machine):
    """Questions, a line each."""
    force = measured.signals.get("hoist_force_kN")
    if force is not None and np.abs(force).max(initial=0.0) < G * machine.empty_t:
        yield (f"hoist_force_kN: {np.abs(force).max(initial=0.0):.4g} kN at most, and the case's empty dipper weighs "
               f"{G * machine.empty_t:.4g} kN: is it in kN?")
    usual = median(p.truck_mass_t for p in measured.passes) if MASS in measured.channels else 0.0
    if usual > BEYOND_RATED * machine.rated_t:
        yield (f"truck_mass_t: {usual:.4g} t in the median, and the case's dipper is rated for "
               f"{machine.rated_t:.4g} t: is it in t?")
