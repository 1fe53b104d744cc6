"""What `dipper gap` ends with: bad input is told in words, a fault of the program is not taken for it."""
from pathlib import Path

import pytest

from dipper_gap import __main__ as command
from dipper_run.findings import BadInput

CASE = Path(__file__).resolve().parents[3] / "cases/screening"


@pytest.fixture
def planned(tmp_path, monkeypatch):
    """Ends a forecast, before any run, with an error."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(command, "usable", lambda catalogue, simulator: (catalogue, []))

    def ended(error):
        def fail(*_):
            raise error
        monkeypatch.setattr(command, "forecast", fail)
        return command.main([str(CASE), "--plan", "--out", str(tmp_path / "out")])

    return ended


def test_bad_input_found_late_is_status_2(planned, capsys):
    assert planned(BadInput(["1 passes are both measured and simulated"])) == 2
    assert "gap: 1 passes are both" in capsys.readouterr().err


def test_a_case_without_a_shovel_is_refused(tmp_path, capsys):
    assert command.main([str(CASE.parent / "loader"), "--plan", "--out", str(tmp_path / "out")]) == 2
    assert "machine.kind: has no motion of a shovel's drives" in capsys.readouterr().err


@pytest.mark.parametrize("names, said", [(["hoist_m", "crowd_m", "swing_rad"], "nothing is left to compare"),
                                         (["hoist_force_kN"], "has hoist_force_kN without hoist_m, crowd_m, swing_rad"),
                                         (["truck_mass_t"], None)])
def test_channels_must_have_something_to_compare(names, said):
    args = command.arguments([str(CASE), "--plan", "--measured", "mine"])
    if said is None:
        return command.require_comparable(names, args)
    with pytest.raises(BadInput, match=said):
        command.require_comparable(names, args)


def test_a_fault_of_the_program_is_not_called_bad_input(planned):
    with pytest.raises(ValueError, match="could not be broadcast"):
        planned(ValueError("operands could not be broadcast together"))
