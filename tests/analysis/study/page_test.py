"""The page of a study in headless Chromium: what it says, on a wide screen and on a phone, without an error."""
import pathlib
import sys

import pytest

from dipper_study.goal import COLUMNS
from dipper_study.report import write_page
from dipper_study.study_file import read_study
from world import World

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "report"))
from browser import Browser  # noqa: E402

STUDY = """case: case
seeds: [1, 2, 3, 4]
parameters:
  machine.rake_angle_deg: [60, 61, 62]
  bucket: {plain: {}, wide: {bodies.dipper: wide.stl}}
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    world = World(tmp_path_factory.mktemp("page"))
    world.say("fail", "4")
    world.say("warnings", "pass 1: the ropes are slack in SEED % of the dig")
    world.study(STUDY, status=3)
    return world.out


@pytest.mark.parametrize("width, phone", [(1200, False), (390, True)])
def test_the_page_says_what_was_found(page, width, phone):
    with Browser(width, 900, phone) as browser:
        browser.open(page / "report.html")
        browser.drawn()
        text = lambda selector: browser.run("return document.querySelector(arguments[0]).textContent", selector)
        assert text("h1") == "A made-up shovel: study"
        assert "18 runs of" in text(".masthead") and "6 runs failed" in text("#failures h2")
        assert "in 18 of 18 runs: pass 1: the ropes are slack in 1 to 3 % of the dig" in text("#warnings")
        assert browser.run("return document.querySelectorAll('#curves canvas').length") == 8
        assert "bucket: wide against plain" in text("#comparisons") and "more" in text("#comparisons")
        assert "rises" in text("#trends") and "Parameter" not in text("#trends thead")
        assert browser.run("return document.querySelectorAll('#points tbody tr').length") == 6
        link = browser.run("return document.querySelector('#runs a').getAttribute('href')")
        assert (page / link).exists()
        # A phone's innerWidth grows with a page that is too wide.
        assert browser.run("return document.documentElement.scrollWidth") <= width
        assert browser.run("""return [...document.querySelectorAll('.stack .table')]
            .filter((e) => e.scrollWidth > e.clientWidth).length""") == 0, "a column out of sight"
        assert browser.errors() == []


def test_intervals_of_two_seeds_do_not_flatten_a_chart(tmp_path):
    (tmp_path / "case").mkdir()
    (tmp_path / "case/case.yaml").write_text("")
    (tmp_path / "study.yaml").write_text("case: case\nseeds: [1, 2]\nparameters: {machine.rake_angle_deg: [60, 62]}\n")
    rows = [{"run": f"{rake}_s{seed}", "machine.rake_angle_deg": rake, "seed": seed, "status": "complete",
             **dict.fromkeys(COLUMNS, float("nan")), "payload_t": 50.0 + 10 * seed}
            for rake in ("60", "62") for seed in (1, 2)]  # 65 +- 32
    write_page(read_study(tmp_path / "study.yaml"), rows, [], None, tmp_path / "report.html")
    with Browser() as browser:
        browser.open(tmp_path / "report.html")
        browser.drawn()
        share = browser.run("""
            const canvas = document.querySelector('#curves canvas'), { width, height } = canvas;
            const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
            const rows = [];
            for (let k = 0; k < data.length; k += 4)
                if (data[k] === 0 && data[k + 1] === 114 && data[k + 2] === 178 && data[k + 3] === 255)
                    rows.push(Math.floor(k / 4 / width));
            return (rows[rows.length - 1] - rows[0]) / height;""")
        assert 0.2 < share < 0.3, "of the chart between the points of both seeds"
        assert browser.errors() == []


def test_a_study_of_bodies_that_have_no_passes(tmp_path):
    world = World(tmp_path)
    world.say("poses", "")
    world.study("case: case\nseeds: [1, 2]\nparameters: {machine.rake_angle_deg: [60, 62]}\n")
    assert {(row["status"], row["passes"], row["payload_t"], row["cpu_s"]) for row in world.rows()} == {
        ("complete", "0", "", "6")}
    with Browser() as browser:
        browser.open(world.out / "report.html")
        assert browser.run("return document.querySelectorAll('#runs tbody tr').length") == 4
        assert browser.errors() == []


OPTIMISE = """case: case
seeds: [1, 2]
optimise:
  maximise: payload_t
  parameters: {machine.rake_angle_deg: {low: 58, high: 70}}
  confirm_seeds: [3, 4]
"""


@pytest.mark.parametrize("improved, says", [(True, "Better than the base: machine.rake_angle_deg 64"),
                                            (False, "No better")])
def test_the_page_of_an_optimum_says_whether_it_is_one(tmp_path, improved, says):
    (tmp_path / "case").mkdir()
    (tmp_path / "case/case.yaml").write_text("")
    (tmp_path / "study.yaml").write_text(OPTIMISE)
    figure = {"n": 2, "mean": 70.0, "sd": 1.0, "low": 69.0, "high": 71.0}
    answer = {"improved": improved, "objective": "payload_t", "parameters": ["machine.rake_angle_deg"], "best": [64.0],
              "confirmed": figure, "base": figure, "difference": figure, "confidence": 0.97, "says": "said so",
              "constraints": [{"text": "dig_force_peak_MN at most 9", "held": False, **figure}],
              "points": 8, "runs": 20,
              "slices": [{"parameter": "machine.rake_angle_deg", "x": [58.0, 64.0, 70.0], "mean": [1.0, 2.0, 1.0],
                          "low": [0.0, 1.0, 0.0], "high": [2.0, 3.0, 2.0]}]}
    write_page(read_study(tmp_path / "study.yaml"), [], [], answer, tmp_path / "report.html")
    with Browser() as browser:
        browser.open(tmp_path / "report.html")
        browser.drawn()
        text = browser.run("return document.querySelector('#optimum').textContent")
        assert says in text and "said so" in text and "dig_force_peak_MN at most 9" in text and "not held" in text
        assert browser.run("return document.querySelectorAll('#optimum canvas').length") == 1
        assert browser.errors() == []
