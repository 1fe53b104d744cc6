"""The page of a study in headless Chromium: what it says, on a wide screen and on a phone, without an error."""
import pathlib
import sys

import pytest

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
    world.study(STUDY, status=3)
    return world.out


@pytest.mark.parametrize("width, phone", [(1200, False), (390, True)])
def test_the_page_says_what_was_found(page, width, phone):
    with Browser(width, 900, phone) as browser:
        browser.open(page / "report.html")
        browser.drawn()
        text = lambda selector: browser.run("return document.querySelector(arguments[0]).textContent", selector)
        assert "18 runs of" in text(".masthead") and "6 runs failed" in text("#failures h2")
        assert browser.run("return document.querySelectorAll('#curves canvas').length") == 7
        assert "bucket: wide against plain" in text("#comparisons") and "more" in text("#comparisons")
        assert "rises" in text("#trends")
        assert browser.run("return document.querySelectorAll('#points tbody tr').length") == 6
        link = browser.run("return document.querySelector('#runs a').getAttribute('href')")
        assert (page / link).exists()
        assert browser.run("return document.documentElement.scrollWidth <= innerWidth")
        assert browser.errors() == []
