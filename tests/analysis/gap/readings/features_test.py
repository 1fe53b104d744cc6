"""Phases of the cycle and features of a phase, against values worked out by hand."""
import numpy as np
import pytest

import synthetic
from dipper_gap.readings.features import FeatureMap
from dipper_gap.readings.measured import Measured, Pass
from dipper_gap.readings.phases import find_phases, in_order
from dipper_gap.statistics.signatures import BEFORE_BREAKOUT

PHASES = ["approach", "penetrate", "fill", "breakout", "swing", "dump", "return"]  # of the program


def ramp_cycle(rate_hz=1.0):
    """Crowd out from 0 to 10 m over 0..20 s, still to 24 s; swing from 24 to 34 s, rest to 40, back to 50."""
    t = np.arange(0, 50.01, 1 / rate_hz)
    crowd = np.interp(t, [0, 20, 24, 50], [0, 10, 10, 0])
    swing = np.interp(t, [0, 24, 34, 40, 50], [0, 0, 1, 1, 0])
    return t, crowd, swing


@pytest.mark.parametrize("rate_hz", [0.5, 1.0, 10.0, 100.0])
def test_phases_of_a_ramp(rate_hz):
    t, crowd, swing = ramp_cycle(rate_hz)
    ph = find_phases(t, crowd, swing, [(0, 50)])[0]
    assert list(ph) == PHASES
    ends = [ph[p][1] for p in PHASES]
    assert ends == pytest.approx([2.0, 9.0, 19.4, 24.5, 33.7, 40.3, 50.0], abs=1e-9)


def test_the_order_of_phases_is_known_from_passes_that_lack_some():
    assert in_order([PHASES[:2], PHASES[4:], [PHASES[0], *PHASES[2:5]], PHASES[1:3]]) == PHASES
    assert in_order([]) == []


def test_names_of_phases_that_the_method_uses_are_the_programs():
    assert tuple(PHASES[:PHASES.index("breakout")]) == BEFORE_BREAKOUT


def test_phases_do_not_move_with_the_loggers_clock():
    t, _, crowd, swing = synthetic.motion(10.0)
    fine = find_phases(t, crowd, swing, [(0, 48)])[0]
    for start in (0, 3, 7):
        coarse = find_phases(t[start::10], crowd[start::10], swing[start::10], [(0, 48)])[0]
        for phase in ("penetrate", "fill", "breakout", "swing"):
            assert coarse[phase][1] == pytest.approx(fine[phase][1], abs=0.35)


@pytest.mark.parametrize("way", [1, -1])
def test_a_pass_that_begins_while_swinging_back_and_ends_past_the_face(way):
    """The first 6 s still turn back to the face, the last turn beyond it; the dig is found all the same."""
    t, crowd, swing = ramp_cycle()
    before, after = np.arange(-6.0, 0.0), np.arange(51.0, 56.0)
    t = np.concatenate([before, t, after])
    crowd = np.concatenate([0.3 - 0.05 * before, crowd, 0 * after])
    swing = way * np.concatenate([-0.1 * before, swing, -0.05 * (after - 50)])
    ph = find_phases(t, crowd, swing, [(-6, 55)])[0]
    assert ph["approach"][0] == -6.0
    assert [ph[p][1] for p in PHASES] == pytest.approx([2.0, 9.0, 19.4, 24.5, 33.7, 40.3, 55.0], abs=1e-9)


def test_a_pass_that_is_cut_short_has_no_return():
    t, crowd, swing = ramp_cycle()
    assert "return" not in find_phases(t, crowd, swing, [(0, 38)])[0]


def straight_line_folder():
    t, crowd, swing = ramp_cycle()
    signals = {"hoist_m": -0.5 * t, "crowd_m": crowd, "swing_rad": swing,
               "hoist_force_kN": 100 + 3 * t, "crowd_force_kN": np.full_like(t, -40.0)}
    return Measured(dict(synthetic.CHANNELS), (Pass(1, 0, 50, 77.0),), t, signals)


def test_features_of_a_straight_line_are_exact():
    m = straight_line_folder()
    fmap = FeatureMap(m, [1])
    row = fmap({n: m.signals[n][None] for n in fmap.responses}, fmap.masses()[None])[0]
    value = {c.key: x for c, x in zip(fmap.cells, row)}
    a, b = 2.0, 9.0  # penetrate
    hoist = "penetrate", "hoist_force_kN"
    assert value[(*hoist, "mean")] == pytest.approx(100 + 3 * (a + b) / 2)
    assert value[(*hoist, "slope")] == pytest.approx(3.0)
    assert value[(*hoist, "peak")] == pytest.approx(100 + 3 * b)
    assert value[(*hoist, "work")] == pytest.approx(0.5 * (100 + 3 * (a + b) / 2) * (b - a))
    assert value[("penetrate", "crowd_force_kN", "work")] == pytest.approx(-40 * 3.5)
    assert value[("penetrate", "crowd_force_kN", "peak")] == pytest.approx(40)
    assert value[("penetrate", "time", "duration")] == pytest.approx(b - a)
    assert value[("dump", "truck_mass_t", "mass")] == 77.0


def test_many_copies_at_once_are_the_same_as_one():
    m = synthetic.run(seed=3)
    fmap = FeatureMap(m, [1, 2, 3])
    clean = {n: m.signals[n] for n in fmap.responses}
    one = fmap({n: v[None] for n, v in clean.items()}, fmap.masses()[None])
    two = fmap({n: np.stack([v, 2 * v]) for n, v in clean.items()}, np.stack([fmap.masses()] * 2))
    assert np.allclose(one[0], two[0], rtol=1e-12)
