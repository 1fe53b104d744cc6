"""The progress line of a study."""
import sys
import time

from dipper_run.quantities import minutes

PLAIN_EVERY_S = 30.0


class Progress:
    """On a terminal the line is written over; elsewhere it is a line each time a run ends, or every half minute."""

    def __init__(self, total, todo, guess_s, at_once, stream=sys.stdout):
        """todo: the jobs to be made, of a total of runs."""
        self.total, self.done, self.failed, self.at_once = total, total - len(todo), 0, at_once
        self._begun = {job.folder for job in todo if job.begun}  # these take only the rest of a run's time
        self._made, self._guess_s, self._began = 0, guess_s, time.monotonic()
        self._stream, self._tty, self._told = stream, stream.isatty(), 0.0

    def ended(self, job, error=None):
        """A run has ended."""
        self._made += job.folder not in self._begun
        self.done += error is None
        self.failed += error is not None
        self.show(force=True)

    def left_s(self):
        """Remaining time, from the runs made so far as a whole; before the first from their size."""
        todo = self.total - self.done - self.failed
        if self._made:
            return (time.monotonic() - self._began) / self._made * todo
        return self._guess_s * todo / self.at_once

    def show(self, more="", force=False):
        now = time.monotonic()
        if not self._tty and not force and now - self._told < PLAIN_EVERY_S:
            return
        self._told = now
        text = f"study: {self.done} of {self.total} runs done, {self.failed} failed{more}"
        if self.done + self.failed < self.total:
            text += f"; about {minutes(self.left_s())} left"
        self._stream.write(f"\r{text:<79.79}" if self._tty else text + "\n")
        self._stream.flush()

    def close(self):
        if self._tty:
            self._stream.write("\n")
