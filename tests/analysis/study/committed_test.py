"""Every study of `studies/`: the case of each of its points passes `dipper check`."""
import os
import subprocess
from pathlib import Path

import pytest

from dipper_study.study_file import read_study

STUDIES = sorted((Path(__file__).parents[3] / "studies").glob("*.yaml"))


@pytest.mark.parametrize("file", STUDIES, ids=lambda file: file.stem)
def test_a_committed_studys_points_are_cases_that_can_run(file):
    study = read_study(file)
    for point in study.points():
        settings = ["--set", *map(str, point.settings)] if point.settings else []
        check = subprocess.run([os.environ["DIPPER"], "check", study.case, *settings], capture_output=True, text=True)
        assert check.returncode == 0, f"{point}: {check.stderr}"
