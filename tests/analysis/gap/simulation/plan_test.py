"""A machine effect that the simulator cannot replay is planned, and learnt, as the chaotic run that it takes."""
from dataclasses import replace

import pytest

import fake_mine
import synthetic
from dipper_gap.model import learn
from dipper_gap.simulation.effects import EXACT, STRONG
from dipper_gap.simulation.plan import make_plan, without_runs

FRICTION = {"crowd_friction": replace(fake_mine.CATALOGUE["crowd_friction"], affects="machine")}


class LimitedDrives(fake_mine.FakeSimulator):
    def takes_a_run(self, request):
        return request.how in ("run", "replay")


@pytest.mark.parametrize("simulator, scales, exact", [(fake_mine.FakeSimulator(), EXACT, True),
                                                      (LimitedDrives(), STRONG, False)])
def test_how_it_is_run_decides_strengths_and_signature(simulator, scales, exact):
    plan = make_plan(FRICTION, 1, 1, simulator.takes_a_run)
    planned = plan.signatures["crowd_friction"]
    assert max(p.strength for p in planned) == FRICTION["crowd_friction"].reference(scales)
    assert ("crowd_friction" in without_runs(plan, simulator).signatures) == exact
    folders = dict(zip(plan.requests(), simulator.run(plan.requests())))
    assert learn(plan, folders, synthetic.run()).runs["crowd_friction"].same_rock == exact
