"""A reference folder that cannot be compared is refused with all its faults; a doubtful one is questioned."""
from dataclasses import replace

import pytest

import synthetic
from dipper_gap.readings.before import check_reference
from dipper_run.findings import BadInput
from other_mine import periods
from trucks import in_a_row


@pytest.fixture
def two():
    now, before = periods([{}] * 3, [{}] * 3, 1)
    return replace(now, folder="now"), replace(before, folder="then")


def findings(now, before):
    with pytest.raises(BadInput) as e:
        check_reference(now, before)
    return e.value.findings


def test_a_sound_one_has_nothing_to_ask(two):
    assert check_reference(*two) == ()


def test_every_fault_is_reported_at_once(two):
    now, before = two
    before = before.seen_by([n for n in before.channels if n != "crowd_force_kN"])
    before = replace(before, passes=tuple(p for p in before.passes if p.number < 2))
    found = findings(now, before)
    assert found == ["then/channels.yaml: crowd_force_kN: not there, but now has it; what the same instrument read "
                     "then, or leave crowd_force_kN out of now",
                     "then/passes.csv: pass: has passes 1, and now has 1, 2, 3; 2 or more that both have"]


def test_the_measured_folder_itself_is_none(two):
    assert "is the measured folder itself" in findings(two[0], two[0])[0]


def test_a_truck_in_both_is_found(two):
    now, before = two
    late = before._of(tuple(p for p in before.passes if p.truck == 2))
    again = replace(now, passes=tuple(replace(p, truck=1) for p in late.passes), time_s=late.time_s,
                    signals=late.signals)
    assert "truck 2 is truck 1 of now" in findings(again, before)[0]
    forces = [n for n in now.channels if n != "truck_mass_t"]
    assert "truck 2 is truck 1 of now" in findings(again.seen_by(forces), before.seen_by(forces))[0]


def test_what_is_doubtful_is_asked(two):
    now, before = two
    without_drift = replace(now, channels={n: replace(c, drift_sigma=None) for n, c in now.channels.items()})
    asked = check_reference(without_drift, before)
    assert len(asked) == 3 and "truck_mass_t: no drift_sigma" in asked[2] and "2.83 t" in asked[2]
    one = replace(in_a_row([synthetic.run(seed=3)]), channels=now.channels, folder="one")
    assert any("hardly show how the mine's own trucks scatter" in a for a in check_reference(one._of(one.passes[:3]),
               before._of(before.passes[:3])))
    slow = replace(before, time_s=before.time_s[::2], signals={n: v[::2] for n, v in before.signals.items()})
    assert any("every 1 s now and every 2 s in the reference" in a for a in check_reference(now, slow))
