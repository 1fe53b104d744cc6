"""What the report draws is read at the same moments of the motion."""
from dataclasses import replace

import numpy as np

import synthetic
from dipper_gap.readings.curves import curves


def test_passes_that_begin_at_another_moment_lie_over_each_other():
    """The same run, its passes cut 2 s earlier: no difference, where 2 s make a difference of hundreds of kN."""
    run = synthetic.run(seed=3)
    earlier = replace(run, passes=tuple(replace(p, t_start_s=p.t_start_s - 2) for p in run.passes))
    drawn = curves(run, [earlier, earlier], [earlier], [2, 3], [3], 1.0)
    assert {(c.pass_number, c.channel) for c in drawn} == {
        (n, name) for n in (2, 3) for name in ("hoist_force_kN", "crowd_force_kN")}
    for c in drawn:
        np.testing.assert_allclose(c.before, c.measured, atol=1e-6)
        np.testing.assert_allclose(c.after, c.measured, atol=1e-6)
        assert np.abs(np.interp(c.time_s - 2, c.time_s, c.measured) - c.measured).max() > 100
