"""Forces and masses in other units, by the machine of a case."""
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from dipper_gap.readings.machine_warnings import machine_warnings, read_machine

CASE = Path(__file__).resolve().parents[4] / "cases/screening"


@pytest.mark.parametrize("force, mass, says", [
    (2300.0, 78.0, []), (2300.0 / 9.81, 78.0, ["hoist_force_kN: 234.5 kN at most, and the case's empty dipper weighs"]),
    (2300.0, 172.0, ["truck_mass_t: 172 t in the median, and the case's dipper is rated for 109 t: is it in t?"])])
def test_units_that_the_machine_cannot_have(force, mass, says):
    machine = read_machine(CASE, {"machine.model": "../../mbs/bucyrus495.yaml"})
    measured = SimpleNamespace(signals={"hoist_force_kN": np.array([0.0, force])}, channels={"truck_mass_t": None},
                               passes=[SimpleNamespace(truck_mass_t=mass)] * 3)
    found = list(machine_warnings(measured, machine))
    assert len(found) == len(says) and all(f.startswith(s) for f, s in zip(found, says))
    assert not list(machine_warnings(SimpleNamespace(signals={}, channels={}, passes=[]), machine))
