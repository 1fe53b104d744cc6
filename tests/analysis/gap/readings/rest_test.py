"""How long drives stand still in each phase."""
import numpy as np
import pytest

import synthetic
from dipper_gap.readings.features import Cell
from dipper_gap.readings.rest import at_rest


def test_the_share_of_each_phase_in_which_a_channels_drive_stands_still():
    m = synthetic.run()
    cells = [Cell(k, phase, f"{drive}_force_kN", feature) for k in (1, 2, 3) for phase in synthetic.phase_index()[k - 1]
             for drive in ("hoist", "crowd") for feature in ("mean", "slope", "peak", "work")]
    rest = dict(zip(cells, at_rest(m, cells)))
    for drive in ("hoist", "crowd"):
        speed = np.abs(np.gradient(m.signals[f"{drive}_m"], m.time_s))
        still = speed < 0.1 * np.quantile(speed, 0.9)
        for k, phases in enumerate(synthetic.phase_index(), 1):
            for phase, (a, b) in phases.items():
                share = still[(m.time_s >= a) & (m.time_s < b)].mean()
                mean, slope, peak, work = (rest[Cell(k, phase, f"{drive}_force_kN", f)]
                                           for f in ("mean", "slope", "peak", "work"))
                assert mean == peak == pytest.approx(share) and slope == pytest.approx(2 * share / (b - a))
                assert work == 0
    assert max(rest.values()) > 0.3  # a drive does stand still somewhere


def test_what_has_no_drive_of_its_own_does_not():
    assert not at_rest(synthetic.run(), [Cell(1, "dump", "truck_mass_t", "mass")]).any()
