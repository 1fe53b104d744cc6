"""What is known of how the model differs from a mine at all times: CASE/fidelity.yaml (docs/gap.md).

    dig_force:     {factor, low, high, by_phase, source}   of a dig, mine over model
    payload:       {factor, low, high, source}             of a pass's load (optional)
    not_compared:  [channel, ...]                          that the model is known not to show (optional)

low and high bound 95 %. by_phase is the sd, relative, of the rock's force in one phase and channel about that factor.

The rock's force is what a drive shows more than in the empty cycle, as the same motion needs. From the dig's end on it
is the load's weight; from first contact to the end of the fill as much of it as has been filled, in a straight line;
the rest of the dig is resistance. Coarse rock resists too much and weighs what it should: each has its own factor.
"""
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from dipper_run.findings import BadInput, Findings
from dipper_run.section import Section
from dipper_run.text_file import read_yaml

from .channels import FACE, FORCES, MASS
from .phases import find_phases

FILE = "fidelity.yaml"
DIG = ("approach", "penetrate", "fill", "breakout")
FLOWS = (*DIG, "dump")     # phases in which rock moves through or out of the dipper, as a model may get wrong
# Relative sd of what the load's weight shows while it rests in the swing: its centre may lie 0.3 m elsewhere in the
# dipper than the model's, on a lever of some 10 m.
LEVER = 0.03
USED = 4                   # runs from which a shift of features is taken: relative to a force, it needs no more
MOST = 20.0                # of a factor, looked for
SIDE_95 = 1.96
WHATS = "dig_force: {factor, low, high, by_phase, source}; payload: {factor, low, high, source}; not_compared: [...]"


@dataclass(frozen=True)
class Factor:
    value: float = 1.0
    low: float = 1.0
    high: float = 1.0

    def __str__(self):
        return f"{self.value:g} ({self.low:g} to {self.high:g})"

    @property
    def spread(self):
        """Relative sd."""
        return (self.high - self.low) / (2 * SIDE_95 * self.value)


@dataclass(frozen=True)
class Fidelity:
    dig_force: Factor = Factor()
    by_phase: float = 0.0
    payload: Factor = Factor()
    not_compared: tuple = ()
    file: str = FILE

    def __str__(self):
        words = [f"{self.file}: the model's runs are corrected: dig force times {self.dig_force}"]
        words += [f"payload times {self.payload}"] if self.payload != Factor() else []
        words += [f"{', '.join(self.not_compared)} not compared"] if self.not_compared else []
        return "; ".join(words)

    def compared(self, channels):
        """The channels {name: ...} but those that the model is known not to show."""
        return {n: c for n, c in channels.items() if n not in self.not_compared}


def read_fidelity(case):
    """The Fidelity beside a case, None without the file; throws BadInput with every fault."""
    file, found = case / FILE, Findings()
    if not file.is_file():
        return None
    section = Section(read_yaml(file, found, WHATS), file, found)
    dig, payload = (section.section(key) for key in ("dig_force", "payload"))
    by_phase = dig.number("by_phase", 0.0, "a relative sd, 0 to 1", needed=bool(dig), allowed=lambda x: 0 <= x <= 1)
    not_compared = section.texts("not_compared", "a list of response channels") if "not_compared" in section else []
    for name in not_compared:
        if name not in (*FORCES, MASS, FACE):
            section.wrong("not_compared", f"has {name}", "of " + ", ".join((*FORCES, MASS, FACE)))
    out = Fidelity(_factor(dig), by_phase, _factor(payload), tuple(not_compared), str(file))
    section.end()
    found.raise_if_any()
    return out


def _factor(section):
    """Factor of a map; 1 for sure where there is none."""
    if not section:
        return Factor()
    low, value, high = (section.number(key, 1.0, "a number above 0, mine over model", needed=True,
                                       allowed=lambda x: 0 < x <= MOST) for key in ("low", "factor", "high"))
    section.text("source", None, "where the figure is from", needed=True)
    section.end()
    if not low <= value <= high:
        section.wrong("factor", f"is {value:g}", f"between low, {low:g}, and high, {high:g}")
    return Factor(value, low, high)


@dataclass(frozen=True)
class KnownErrors:
    """A Fidelity for one case: `resistance` is the factor on what rock resists that gives the dig force its own."""

    fidelity: Fidelity
    empty: object        # Measured of the empty cycle
    resistance: Factor

    def corrected(self, m, empty=None, offset_t=0.0):
        """A run's folder as a mine would show it; `empty` and `offset_t` as its instruments show the empty cycle, and
        what its scale adds to each load."""
        return self._scaled(m, self.resistance.value, self.fidelity.payload.value, empty, offset_t)

    def directions(self, folders, rows_of, cells):
        """(K, n) shifts of features by one sd of what is not known of the corrected runs `folders`, alike in all
        trucks; rows_of(folders) gives (runs, n) features over `cells`."""
        folders = folders[:USED]
        full = rows_of(folders)

        def part(without):
            return (full - rows_of([without(m) for m in folders])).mean(axis=0)

        out = [part(lambda m: self._scaled(m, 0.0, 1.0)) * self.resistance.spread,
               part(lambda m: self._scaled(m, 1.0, 0.0)) * self.fidelity.payload.spread]
        forces = folders[0].responses()
        for half in range(2):  # the force may be off early in a phase otherwise than late in it
            moving = part(lambda m: self._without(m, half, FLOWS, forces)) * self.fidelity.by_phase
            out += [moving * [(c.phase, c.channel) == (phase, name) for c in cells] for phase in FLOWS
                    for name in forces]
            out += [part(lambda m: self._without(m, half, ("swing",), (name,))) * LEVER for name in forces]
        return np.array([row for row in out if row.any()]).reshape(-1, len(cells))

    def altered(self, folders, rows_of):
        """(n,) features by which the corrected runs `folders` differ from what they were."""
        folders, payload = folders[:USED], self.fidelity.payload.value
        before = [self._scaled(m, 1.0 / self.resistance.value, 1.0 / payload) for m in folders]
        return (rows_of(folders) - rows_of(before)).mean(axis=0)

    def _without(self, m, half, phases, forces):
        """The folder with no rock's force in the first (0) or second (1) half of these phases."""
        at = np.zeros(len(m.time_s), bool)
        for found in _phases(m) if m.signals else ():
            for start, end in (found[n] for n in phases if n in found):
                middle = 0.5 * (start + end)
                at |= _within(m.time_s, ((start, middle), (middle, end))[half])
        signals = dict(m.signals)
        for name, resists, weighs in rock_forces(m, self.empty):
            signals[name] = signals[name] - np.where(at & (name in forces), resists + weighs, 0.0)
        return replace(m, signals=signals)

    def _scaled(self, m, resistance, load, empty=None, offset_t=0.0):
        signals = dict(m.signals)
        for name, resists, weighs in rock_forces(m, empty or self.empty):
            signals[name] = signals[name] + (resistance - 1) * resists + (load - 1) * weighs
        passes = tuple(replace(p, truck_mass_t=offset_t + load * (p.truck_mass_t - offset_t)) for p in m.passes)
        return replace(m, signals=signals, passes=passes)


def known_errors(fidelity, empty, plain):
    """KnownErrors from runs of the unchanged case and its empty cycle."""
    dig_force = fidelity.dig_force
    value, low, high = (resistance_of(x, empty, plain) for x in (dig_force.value, dig_force.low, dig_force.high))
    return KnownErrors(fidelity, empty, Factor(value, low, high))


def resistance_of(factor, empty, plain):
    """The factor on the resistance with which the mean dig force of the runs `plain` is `factor` of what it is.

    The dig force is sqrt(crowd^2 + hoist^2), its mean from first contact to the dump (docs/metrics.md). Not below 0:
    a factor that not even rock without resistance would give is an error.
    """
    if factor == 1.0:
        return 1.0
    parts = [list(_in_dig(m, empty)) for m in plain]

    def off(k):
        means = [[np.sqrt(sum((f + (k - 1) * d) ** 2 for f, d in forces)).mean() for forces in passes]
                 for passes in ([[(f[at], d[at]) for f, d in forces] for at, forces in run] for run in parts)]
        usual = [[np.sqrt(sum(f[at] ** 2 for f, _ in forces)).mean() for at, forces in run] for run in parts]
        return np.mean(means) / np.mean(usual) - factor

    if off(0.0) >= 0:
        raise BadInput([f"{FILE}: dig_force: {factor:g} of the model's is not possible: dipper and load alone need "
                        f"{factor + off(0.0):.2f} of it; a larger factor"])
    return float(brentq(off, 0.0, MOST * max(1.0, factor), xtol=1e-6))


def _in_dig(m, empty):
    """[(readings from first contact to the dump, [(force, resistance) of each force])] of the passes."""
    forces = [(m.signals[n], resists) for n, resists, _ in rock_forces(m, empty)]
    for phases in _phases(m):
        start = phases.get("penetrate", phases.get("fill"))
        end = phases.get("dump")
        if start and end:
            yield (m.time_s >= start[0]) & (m.time_s < end[0]), forces


def _phases(m):
    return find_phases(m.time_s, m.signals["crowd_m"], m.signals["swing_rad"],
                       [(p.t_start_s, p.t_end_s) for p in m.passes])


def rock_forces(m, empty):
    """[(channel, resistance, weight of the load)], both (T,), of a run's forces."""
    out, t = [], m.time_s
    phases = _phases(m) if m.signals else []
    for name in m.responses():
        resists, weighs = np.zeros(len(t)), np.zeros(len(t))
        for p, found in zip(m.passes, phases):
            inside = (t >= p.t_start_s) & (t <= p.t_end_s)
            idle = next(q for q in empty.passes if q.number == p.number)
            rock = m.signals[name] - np.interp(t - p.t_start_s + idle.t_start_s, empty.time_s, empty.signals[name])
            carried = _within(t, found.get("swing")) & inside
            load = rock[carried].mean() if carried.any() else 0.0
            digging = np.logical_or.reduce([_within(t, found.get(phase)) for phase in DIG]) & inside
            filled = _filled(t, found) * load
            weighs[inside] = np.where(digging, filled, rock)[inside]
            resists[digging] = (rock - filled)[digging]
        out.append((name, resists, weighs))
    return out


def _within(t, span):
    return (t >= span[0]) & (t < span[1]) if span else np.zeros(len(t), bool)


def _filled(t, phases):
    """(T,) share of the load that is in the dipper while it digs."""
    digs = [phases[n] for n in ("penetrate", "fill") if n in phases]
    if not digs:
        return (t >= phases.get("breakout", (np.inf,))[0]).astype(float)
    start, end = digs[0][0], digs[-1][1]
    return np.clip((t - start) / (end - start), 0.0, 1.0)
