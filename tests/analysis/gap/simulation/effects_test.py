"""The catalogue: every effect of the repository, and each fault of a file."""
import pytest

import synthetic
from dipper_gap.simulation.effects import read_catalogue
from dipper_run.findings import BadInput
from dipper_run.program import ask
from effect_files import FINES


def test_a_bad_effect_file_is_reported_whole(tmp_path):
    (tmp_path / "effects").mkdir()
    (tmp_path / "case.yaml").write_text("seed: 1\n")
    (tmp_path / "effects" / "x.yaml").write_text(FINES.replace("rock\n", "magic\n").replace("high: 0.4", "high: -1")
                                                 .replace("title: Fines\n", ""))
    with pytest.raises(BadInput) as e:
        read_catalogue(tmp_path)
    assert len(e.value.findings) == 3


def test_every_effect_of_the_catalogue_is_read():
    catalogue = read_catalogue(synthetic.ROOT / "cases/screening")
    assert len(catalogue) >= 20
    for e in catalogue.values():
        for same_rock in (False, True):
            low, high = sorted(e.strengths(same_rock))
            assert e.low <= low < high <= e.high and 0 not in (low, high)


@pytest.mark.parametrize("name, strength, key, change", [
    ("payload_bias", -4, "observation.scale_offset_t", lambda x: x - 4),
    ("hoist_cell_drift", 0.1, "observation.hoist_cell_gain", lambda x: x + 0.1),
    ("crowd_cell_drift", -0.2, "observation.crowd_cell_gain", lambda x: x - 0.2),
    ("leaking_door", 0.1, "observation.door_leak", lambda x: x + 0.1),
    ("grading", 0.1, "rock.coarse_graining", lambda x: 1.1 * x),
    ("grading", 0.1, "rock.coarse_graining_limit_m", lambda x: 1.1 * x)])
def test_an_effect_sets_what_it_says(name, strength, key, change):
    """In cases/screening, which has sizes capped, and no key of the instruments."""
    case = synthetic.ROOT / "cases/screening"
    plain, other = (ask("check", "--json", case, *words)["values"]
                    for words in ((), ("--set", f"effects.{name}={strength}")))
    assert float(other[key]) == pytest.approx(change(float(plain[key])))
