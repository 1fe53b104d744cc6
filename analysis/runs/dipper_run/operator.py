"""Drives a machine: a program for `dipper run CASE --operator PROGRAM` (docs/operator_program.md).

A program subclasses `Operator`, says where the drives go, and ends with `serve`:

    class Mine(Operator):
        def look(self, seen):
            return {"hoist_m": ..., "crowd_m": ..., "swing_rad": ..., "door_rad": ...}

    serve(Mine())
"""
import json
import sys

VERSION = 1
GREETING = "dipper_operator"


class Operator:
    """Who drives. What `self` holds is saved with each checkpoint, but for names that begin with `_`."""

    def start(self, hello):
        """Before the first look, and again where a run goes on. `hello`: case, machine, motion (the case's file),
        look_s, limits {hoist_m: [least, most], crowd_m, door_rad, hoist_m_s, crowd_m_s, swing_rad_s, hoist_stall_N,
        hoist_power_W, ...}, truth, resumed."""

    def look(self, seen):
        """Where the drives are to be at seen["by_s"]: {hoist_m, crowd_m, swing_rad, door_rad}, m and rad; and, if
        wanted, their rates then {hoist_m_s, ...} and done (True: the run may end). `seen`: the instruments, a dict."""
        raise NotImplementedError

    def save(self):
        """All that `look` decides by, as what JSON keeps to the bit: the same run goes on from it."""
        state = {name: value for name, value in vars(self).items() if not name.startswith("_")}
        for name, value in state.items():
            try:
                kept = json.loads(json.dumps(value, allow_nan=False)) == value
            except (TypeError, ValueError):
                kept = False
            if not kept:
                raise TypeError(f"{type(self).__name__}.{name}: {value!r:.80} does not survive JSON; give it a name "
                                "that begins with _ if `start` makes it again, or write save and load")
        return state

    def load(self, state):
        """Takes what `save` gave, after `start`."""
        vars(self).update(state)


def serve(operator, source=None, sink=None):
    """Answers the run until it ends. What is printed meanwhile goes to stderr, which the run keeps in its logs."""
    source, sink = source or sys.stdin, sink or sys.stdout
    printed, sys.stdout = sys.stdout, sys.stderr
    try:
        hello = json.loads(source.readline() or "{}")
        if hello.get(GREETING) != VERSION:
            raise RuntimeError("no run is connected: start this with `dipper run CASE --operator PROGRAM`")
        operator.start(hello)
        if hello["resumed"]:
            operator.load(json.loads(source.readline())["state"])
        say(sink, {GREETING: VERSION})
        for line in source:
            asked = json.loads(line)
            if asked.get("end"):
                break
            say(sink, {"state": operator.save()} if asked.get("save") else operator.look(asked))
    finally:
        sys.stdout = printed


def say(sink, answer):
    sink.write(json.dumps(answer, allow_nan=False) + "\n")
    sink.flush()
