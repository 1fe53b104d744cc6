"""Runs as a mine would show them, by what is known of the model's errors (readings/fidelity.py)."""
import copy
from dataclasses import replace

from ..readings.fidelity import known_errors
from .simulator import EMPTY, Simulator

OFFSET = "observation.scale_offset_t"  # what the scale adds, whatever was loaded


class Corrected(Simulator):
    """A Simulator whose runs are corrected by a Fidelity; the same runs are made, and one empty cycle."""

    def __init__(self, simulator, fidelity):
        self._simulator, self._fidelity = simulator, fidelity
        self.jobs = simulator.jobs
        self.known = None   # KnownErrors, from the first plain runs on
        self._law = None    # name of an effect that adds a force of its own, whatever the rock does

    @property
    def case(self):
        return self._simulator.case

    def run(self, requests, say=print):
        made = self._simulator.run(requests, say)
        if self.known is None:
            plain = [m for r, m in zip(requests, made) if not r.effects]
            self.known = known_errors(self._fidelity, self._simulator.run([EMPTY], say)[0], plain)
        pairs = [self._pair(r) for r in requests]
        others = dict.fromkeys(p for p, r in zip(pairs, requests) if p != r)
        found = dict(zip(others, self._simulator.run(list(others), say) if others else ()))
        plain = [found.get(p, m) if p != r else m for p, r, m in zip(pairs, requests, made)]
        # What the instruments add to the empty machine's force is not due to the rock either.
        seen = {r: replace(r, seed=EMPTY.seed, how="empty") for r in pairs if r.how == "observe"}
        looks = list(dict.fromkeys(seen.values()))
        empty = dict(zip(looks, self._simulator.run(looks, say) if looks else ()))
        return [_moved(self.known.corrected(p, empty.get(seen.get(r)), self._offset(r)), p, m)
                for p, m, r in zip(plain, made, pairs)]

    def _offset(self, r):
        """t that the scale adds to each load."""
        catalogue = self._simulator.catalogue
        return sum(factor * strength for name, strength in r.effects if name in catalogue
                   for key, _, factor in catalogue[name].overlay if key == OFFSET)

    def with_effect(self, effect):
        other = copy.copy(self)
        other._simulator, other._law = self._simulator.with_effect(effect), effect.name
        return other

    def _pair(self, r):
        """The run on the same rock beside which a run shows a force of machine or law, which no rock's error is in; the
        run itself where there is none."""
        if self._law in dict(r.effects):
            effects = tuple(e for e in r.effects if e[0] != self._law)
            return replace(r, effects=effects, how=r.how if effects else "run")
        return r.plain if r.how == "replay" and not self.takes_a_run(r) else r

    def takes_a_run(self, request):
        return self._simulator.takes_a_run(request)

    def plan(self, requests):
        return self._simulator.plan(requests)

    def case_hash(self):
        return self._simulator.case_hash()


def _moved(corrected, plain, m):
    """The corrected folder of `plain` with what `m` shows more than it."""
    if m is plain:
        return corrected
    return replace(corrected, signals={n: v + m.signals[n] - plain.signals[n] for n, v in corrected.signals.items()})
