"""A map of a YAML file, key by key: values, defaults, and each fault at its line."""
import pytest
import yaml

from dipper_run.findings import Findings
from dipper_run.section import Section

TEXT = """\
size: 3
kind: wide
parts:
  first: [1, x]
  secnod: 2
size: 4
"""


@pytest.fixture
def top():
    return Section(yaml.compose(TEXT), "a.yaml", Findings())


def test_values_and_defaults(top):
    assert (top.number("size"), top.number("length", 7.0), top.whole("count", 1, 9, 2)) == (4, 7, 2)
    assert (top.text("kind"), top.one_of("kind", ("wide", "long"))) == ("wide", "wide")
    assert top.texts("kind", "names") == ["wide"]
    assert top.keys() == ["size", "kind", "parts"] and "parts" in top


def test_a_map_that_is_not_there_has_the_defaults(top):
    none = top.section("none")
    assert not none and none.number("size", 5.0) == 5 and none.keys() == []
    none.end()
    assert top.found.all == ["a.yaml:6: size: given twice; keep one"]


def test_each_fault_is_reported_at_its_line(top):
    parts = top.section("parts")
    assert parts.number("second", needed=True) is None and parts.numbers("first", "two numbers") is None
    parts.end()
    assert top.between("size", 0, 3, 1.0) == 1 and top.one_of("kind", ("long", "short")) is None
    assert not top.section("kind")
    top.end(required=("name",))
    assert top.found.all[1:] == [
        "a.yaml:3: parts.second: missing; a number",
        "a.yaml:4: parts.first: is 1, x; two numbers",
        "a.yaml:5: parts.secnod: unknown key; second, perhaps? one of first, second",
        "a.yaml:6: size: is 4; a number, 0 to 3",
        "a.yaml:2: kind: is wide; one of long, short",
        "a.yaml:2: kind: is wide; a map",
        "a.yaml:1: name: missing; give it"]
