"""The synthetic shovel as a simulator with a catalogue, for tests of the statistics and the workflow."""
import functools
import zlib
from dataclasses import replace

import numpy as np

import synthetic
from dipper_gap.statistics.baseline import make_baseline
from dipper_gap.simulation.effects import Effect
from dipper_gap.statistics.isolability import with_nuisances
from dipper_gap.readings.noise import common_errors, measured_features, noise_covariance, noisy_features
from dipper_gap.readings.phases import find_terms
from dipper_gap.statistics.null import simulate_null
from dipper_gap.statistics.signatures import fit_signature
from dipper_gap.simulation.simulator import Simulator

PASSES = [1, 2, 3]
SEEDS = 8


def effect(name, unit, high, scale, kind="rock", sign="+", nuisance=False):
    low = -high if sign == "both" else 0.0
    return Effect(name, name.replace("_", " ").capitalize(), kind, "synthetic", "strength", unit, low, high,
                  scale, "synthetic", ((f"effects.{name}", "set", 1.0),), nuisance,
                  "instruments" if kind == "observation" else "dig")


CATALOGUE = {e.name: e for e in (
    effect("fines", "1", 0.4, 0.12),
    effect("cohesion", "kPa", 8, 2),
    effect("crust", "1", 6, 2),
    effect("pile_height", "m", 6, 2),
    effect("friction_pair", "1", 1.0, 0.3),
    effect("truck_spillage", "t", 30, 10, "observation"),
    effect("carry_back", "t", 20, 6),
    effect("liners", "t", 20, 6, "machine"),
    effect("rake", "deg", 15, 5, sign="both"),
    effect("standoff", "m", 1.5, 0.5, sign="both"),
    effect("scale_gain", "1", 0.3, 0.08, "observation", sign="both"),
    effect("rope_stretch", "s", 1.5, 0.5, "machine"),
    effect("crowd_friction", "kN", 400, 120, "machine"),
    effect("hoist_loss", "1", 0.3, 0.08, "machine"),
    effect("logger_offset", "s", 2, 0.6, "observation"),
    effect("density", "1", 0.1, 0.01, sign="both", nuisance=True),
    effect("friction_line", "1", 0.5, 0.1, sign="both", nuisance=True),
    effect("standoff_scan", "m", 0.2, 0.05, sign="both", nuisance=True))}


class FakeSimulator(Simulator):
    """The synthetic shovel behind the workflow's interface; counts what it is asked to run."""

    def __init__(self, spread=1.0, faces=False):
        self.spread, self.faces, self.made, self.laws = spread, faces, [], {}

    def run(self, requests, say=print):
        return [self._one(r) for r in requests]

    def _one(self, r):
        if r not in self.made and r.how == "run":
            self.made.append(r)
        # A chaotic run shares nothing with the plain one of its seed; what the instruments do is no run.
        chaos = 0 if r.how != "run" or not r.effects else zlib.crc32(repr(r.effects).encode()) % 10**6
        effects = {"no_rock": 1.0 if r.how == "empty" else 0.0, **dict(r.effects)}
        made = synthetic.run(effects, r.seed + 17 * chaos, spread=self.spread, faces=self.faces)
        for name, strength in r.effects:
            made = with_law(made, self.laws[name].overlay, strength) if name in self.laws else made
        return made

    def with_effect(self, effect):
        self.laws[effect.name] = effect
        return self

    def plan(self, requests):
        return len({r if r.how == "run" else r.plain for r in requests}), 0, None

    def case_hash(self):
        return "synthetic"


def with_law(m, overlay, strength):
    """A folder whose forces follow the motion besides, as `observation.hoist_law` and `crowd_law` say."""
    spans = [(p.t_start_s, p.t_end_s) for p in m.passes]
    names, values = find_terms(m.time_s, *(m.signals[n] for n in ("hoist_m", "crowd_m", "swing_rad")), spans)
    signals = dict(m.signals)
    for key, _, number in overlay:
        _, law, term = key.split(".")
        name = law.replace("_law", "_force_kN")
        signals[name] = signals[name] + strength * number * values[:, names.index(term)]
    return replace(m, signals=signals)


class World:
    """A baseline and signatures made with seeds of their own: what an analysis has to work with."""

    def __init__(self, number=0, spread=1.0, catalogue=CATALOGUE):
        self.spread, self.first = spread, 10_000 * (number + 1)
        folders = [synthetic.run({}, self.first + k, spread=spread) for k in range(SEEDS)]
        runs = [noisy_features(m, synthetic.CHANNELS, PASSES) for m in folders]
        self.baseline, self.keep = make_baseline(runs[0].cells, np.array([r.mean for r in runs]),
                                                 noise_covariance(runs, synthetic.CHANNELS),
                                                 common_errors(folders, synthetic.CHANNELS, PASSES), PASSES)
        made = [self._signature(e) for e in catalogue.values()]
        self.signatures = [s for s in made if not s.effect.nuisance]
        self.nuisances = [s for s in made if s.effect.nuisance]
        self.directions = np.array([s.g for s in self.signatures]).T
        self.null = simulate_null(self.baseline, self.directions, draws=300, seed=number)
        factor = self.null.inflation(len(self.signatures))
        self.signatures = [s.inflated(factor) for s in self.signatures]
        self.nuisances = [s.inflated(factor) for s in self.nuisances]
        self.plain = with_nuisances(self.baseline.prediction, self.nuisances)
        self.covariance = with_nuisances(self.baseline.inflated(factor).prediction, self.nuisances)

    def _features(self, effects, seed):
        return noisy_features(synthetic.run(effects, seed, spread=self.spread), synthetic.CHANNELS, PASSES)

    def _signature(self, e):
        strengths, index, rows = [], [], []
        for s in e.strengths(e.kind == "observation"):
            for k in (0, 1):
                # Not the baseline's seed itself: in a chaotic run nothing is left of the common start.
                seed = self.first + k
                if e.kind != "observation":
                    seed += 100 + 6 * k + zlib.crc32(e.name.encode()) % 5
                strengths.append(s)
                index.append(k)
                rows.append(self._features({e.name: s}, seed + (0 if e.kind == "observation" else len(rows))).mean)
        return fit_signature(e, self.baseline, strengths, index, np.array(rows)[:, self.keep],
                             e.kind == "observation")

    def residual(self, effects, seed):
        """A mine with a hidden effect, seen through its instruments."""
        mine = synthetic.run(effects, self.first + 5000 + seed, spread=self.spread)
        _, y, _ = measured_features(synthetic.with_noise(mine, self.first + seed, drives=True), PASSES)
        return y[self.keep] - self.baseline.mean


@functools.lru_cache(maxsize=8)
def world(number=0):
    return World(number)
