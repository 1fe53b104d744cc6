"""Operator and serve by themselves: the lines, what is saved, what is printed."""
import io
import json

import pytest

from dipper_run.operator import Operator, serve

HELLO = {"dipper_operator": 1, "resumed": False, "limits": {}}


class Counts(Operator):
    def __init__(self):
        self.looks = 0
        self._made = None

    def start(self, hello):
        self._made = object()

    def look(self, seen):
        print("a word")
        self.looks += 1
        return {"hoist_m": seen["x"] + self.looks}


def talk(operator, *lines):
    sink = io.StringIO()
    serve(operator, io.StringIO("".join(json.dumps(line) + "\n" for line in lines)), sink)
    return [json.loads(line) for line in sink.getvalue().splitlines()]


def test_answers_every_line_and_keeps_what_is_printed_out_of_them(capsys):
    said = talk(Counts(), HELLO, {"x": 0.1}, {"save": True}, {"x": 1 / 3}, {"end": True}, {"x": 5})
    assert said == [{"dipper_operator": 1}, {"hoist_m": 1.1}, {"state": {"looks": 1}}, {"hoist_m": 1 / 3 + 2}]
    printed = capsys.readouterr()
    assert (printed.out, printed.err) == ("", "a word\na word\n")


def test_goes_on_from_its_state():
    said = talk(Counts(), HELLO | {"resumed": True}, {"state": {"looks": 7}}, {"x": 0})
    assert said == [{"dipper_operator": 1}, {"hoist_m": 8}]


@pytest.mark.parametrize("value", [(1, 2), {1: 2}, float("nan"), {3, 4}, object()])
def test_what_json_does_not_keep_is_an_error(value):
    operator = Counts()
    operator.thing = value
    with pytest.raises(TypeError, match="Counts.thing: .* does not survive JSON"):
        operator.save()


def test_no_number_that_is_none():
    class Wild(Operator):
        def look(self, seen):
            return {"hoist_m": float("inf")}

    with pytest.raises(ValueError, match="JSON"):
        talk(Wild(), HELLO, {})


def test_says_how_to_start_it():
    with pytest.raises(RuntimeError, match="dipper run CASE --operator"):
        talk(Counts())
