"""A run as a learner's environment: observation, action, reward, reset from a checkpoint (docs/operator_program.md).

The calls are those of gymnasium's Env, which is not needed: `reset` gives (observation, info), `step` gives
(observation, reward, terminated, truncated, info).
"""
import json
import os
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

from .operator import GREETING, VERSION, say
from .program import program

PATIENCE_S = 600  # for a run's next words: it may settle a pile first


class EpisodeFailed(RuntimeError):
    """The run failed; the message is its own."""


class Environment:
    """Episodes of one case, each a run in a folder of its own, out/1, out/2, ...

    case     its folder
    out      a folder for the episodes
    reward   reward(before, after): of two observations, a number
    words    further words for `dipper run`: ("--set", "end_s=3", "--operator-truth")
    start    a run made with --operator to begin each episode at the last checkpoint of; None: the case's start
    """

    def __init__(self, case, out, reward, words=(), start=None):
        self.case, self.out, self.reward, self.words = Path(case), Path(out), reward, [str(w) for w in words]
        self.start = start and Path(start)
        self.hello = None  # what the run said first: limits, motion, ...
        self.folder = None  # of this episode
        self._episode = 0
        self._run = self._link = self._place = None
        self._seen = None

    def reset(self):
        """Begins an episode; (observation, info)."""
        self.close()
        self._episode += 1
        self.folder = self.out / str(self._episode)
        words = ["run", self.case, "--out", self.folder, *self.words]
        if self.start:
            shutil.copytree(self.start, self.folder)
            words.append("--resume")
        self._place = tempfile.TemporaryDirectory(prefix="dipper-")
        socket_file = f"{self._place.name}/learner"
        relay = f"{shlex.quote(sys.executable)} -B -m dipper_run.relay {shlex.quote(socket_file)}"
        with socket.socket(socket.AF_UNIX) as door:
            door.bind(socket_file)
            door.listen(1)
            door.settimeout(0.2)
            self._words = tempfile.TemporaryFile("w+")
            self._run = subprocess.Popen([program(), *map(str, words), "--operator", relay], stdout=self._words,
                                         stderr=subprocess.STDOUT, env=with_this_package())
            connection = self._accept(door)
        connection.settimeout(PATIENCE_S)
        self._link = connection.makefile("rw", encoding="utf-8", newline="\n")
        connection.close()  # the file keeps it
        self.hello = self._hear()
        if self.hello["resumed"]:
            self._hear()
        say(self._link, {GREETING: VERSION})
        self._seen = self._next()
        if self._seen is None:
            raise EpisodeFailed("the run ended before its first look")
        return self._seen, {"folder": self.folder}

    def step(self, action):
        """One look further: (observation, reward, terminated, truncated, info). `action`: as `Operator.look` gives.

        `terminated`: the run is at its end; the observation is then the last one again, the reward 0.
        """
        say(self._link, action)
        before, after = self._seen, self._next()
        if after is None:
            return before, 0.0, True, False, {"folder": self.folder}
        self._seen = after
        return after, float(self.reward(before, after)), False, False, {"folder": self.folder}

    def close(self):
        """Ends an episode that is under way, as Ctrl-C twice would."""
        if self._run and self._run.poll() is None:
            for _ in range(2):
                self._run.send_signal(signal.SIGINT)
        if self._link:
            self._link.close()
        if self._run:
            self._run.wait()
            self._words.close()
            self._place.cleanup()
        self._run = self._link = self._place = None

    def _accept(self, door):
        while True:
            try:
                return door.accept()[0]
            except TimeoutError:
                if self._run.poll() is not None:
                    self._fail()

    def _hear(self):
        line = self._link.readline()
        if not line:
            self._fail()
        return json.loads(line)

    def _next(self):
        """The next observation; None at the end of the run."""
        while True:
            asked = self._hear()
            if asked.get("end"):
                if self._run.wait() != 0:
                    self._fail()
                return None
            if not asked.get("save"):
                return asked
            say(self._link, {"state": None})

    def _fail(self):
        self._run.wait()
        self._words.seek(0)
        raise EpisodeFailed(self._words.read().strip() or f"dipper run: exit status {self._run.returncode}")


def with_this_package():
    """The surroundings of a program that imports dipper_run from here."""
    above = str(Path(__file__).resolve().parents[1])
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, [above, os.environ.get("PYTHONPATH")]))}
