"""The case with the effects added: its own text, files that are found, and its own effects."""
import os

import pytest
import yaml

from dipper_gap.decision.patch import overlay, write_patched_case
from dipper_gap.simulation.effects import read_catalogue
from effect_files import FINES


@pytest.fixture
def case(tmp_path):
    folder = tmp_path / "cases" / "one"
    folder.mkdir(parents=True)
    (tmp_path / "cases" / "rock.stl").write_text("solid")
    (folder / "case.yaml").write_text("# a comment\nseed: 1\nrock:\n  mesh: ../rock.stl  # kept\n")
    return folder


def test_the_patched_case_keeps_the_text_and_finds_its_files(case, tmp_path):
    out = write_patched_case(case, {"fines": 0.1234567}, tmp_path / "out" / "case")
    text = (out / "case.yaml").read_text()
    assert "# a comment" in text and "# kept" in text
    data = yaml.safe_load(text)
    assert data["effects"] == {"fines": 0.123457}
    assert os.path.samefile(out / data["rock"]["mesh"], tmp_path / "cases" / "rock.stl")
    assert overlay({"fines": 0.1234567}) == {"effects.fines": 0.123457}
    assert not (out / "effects").exists()


def test_the_patched_case_finds_its_files_through_links_and_odd_names(case, tmp_path):
    (tmp_path / "far" / "away").mkdir(parents=True)  # deeper than the link
    (tmp_path / "runs").symlink_to(tmp_path / "far" / "away")
    odd = tmp_path / "two # of: them"
    os.rename(tmp_path / "cases", odd)
    out = write_patched_case(odd / "one", {"fines": 0.1}, tmp_path / "runs" / "case")
    data = yaml.safe_load((out / "case.yaml").read_text())
    assert os.path.samefile(out / data["rock"]["mesh"], odd / "rock.stl") and data["effects"] == {"fines": 0.1}


def test_the_patched_case_takes_the_cases_own_effect_along(case, tmp_path):
    (case / "effects").mkdir()
    (case / "effects" / "mine.yaml").write_text(FINES)
    (case / "effects" / "other.yaml").write_text(FINES)
    out = write_patched_case(case, {"mine": 0.1, "fines": 0.2}, tmp_path / "out" / "case")
    assert [f.name for f in (out / "effects").iterdir()] == ["mine.yaml"]
    assert read_catalogue(out)["mine"].title == "Fines"


@pytest.mark.parametrize("empty", ["effects: {}", "effects: {}  # none", "effects:"])
def test_an_empty_map_of_effects_is_replaced(case, tmp_path, empty):
    text = (case / "case.yaml").read_text()
    (case / "case.yaml").write_text(f"{empty}\n{text}")
    out = write_patched_case(case, {"fines": 0.2}, tmp_path / "out" / "case")
    keys = [key.value for key, _ in yaml.compose((out / "case.yaml").read_text()).value]
    assert keys == ["seed", "rock", "effects"] and "# kept" in (out / "case.yaml").read_text()
    assert os.path.samefile(out / yaml.safe_load((out / "case.yaml").read_text())["rock"]["mesh"],
                            tmp_path / "cases" / "rock.stl")
