"""Masses of passes that are legal and hardly meant are asked about; sound ones are not."""
import pytest

from dipper_gap.readings.mass_warnings import mass_warnings
from dipper_gap.readings.measured import Pass


def passes(*masses, trucks=None):
    return [Pass(k, 40.0 * k, 40.0 * k + 30, m, t) for k, (m, t) in
            enumerate(zip(masses, trucks or [1] * len(masses)), 1)]


@pytest.mark.parametrize("masses", [(80.8, 79.2, 81.8), (70, 95, 88), (60.0, 80.0, 100.0), (81.0,), ()])
def test_sound_masses_raise_no_question(masses):
    assert mass_warnings(passes(*masses)) == []


@pytest.mark.parametrize("masses, said", [
    ((0.0808, 0.0792, 0.0818), ["truck_mass_t is 0.0818 at most: is it in t?"]),
    ((80.8, 160.1, 241.9), ["truck_mass_t rises with every pass of every truck, to 241.9, as the total on a scale"]),
    ((80.8, 999, 81.8), ["pass 2 of truck 1 brought 999 t, and the median is 81.8: is that a reading?"]),
    ((290, 300, 310), ["a pass brought 300 t in the median, and no dipper holds more than 200: is it in t?"]),
    ((80.8, 0, 81.8), ["pass 2 of truck 1 brought nothing: is that a reading?"])])
def test_others_do(masses, said):
    found = mass_warnings(passes(*masses))
    assert len(found) == len(said) and all(t.startswith(s) for t, s in zip(found, said)), found


def test_a_total_begins_anew_with_each_truck():
    assert len(mass_warnings(passes(80, 160, 82, 161, trucks=[1, 1, 2, 2]))) == 1
    assert mass_warnings(passes(80, 160, 82, 81, trucks=[1, 1, 2, 2])) == []
    assert mass_warnings(passes(80, 82, trucks=[1, 2])) == []
