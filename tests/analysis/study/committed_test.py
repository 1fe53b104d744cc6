"""Every study of `studies/`: `dipper motion` and `dipper check` take each of its points, as before a study's runs."""
from pathlib import Path

import pytest

from dipper_run.program import program
from dipper_study.__main__ import first_points
from dipper_study.plan import Planner
from dipper_study.study_file import read_study

STUDIES = sorted((Path(__file__).parents[3] / "studies").glob("*.yaml"))


@pytest.mark.parametrize("file", STUDIES, ids=lambda file: file.stem)
def test_a_committed_studys_points_are_cases_that_can_run(file, tmp_path):
    study = read_study(file)
    Planner(study, program(), tmp_path / "study").check(first_points(study))
