"""The catalogue, one data file an effect: `analysis/effects/NAME.yaml`, and a case's own in CASE/effects.

The simulator applies them (`dipper run CASE --set effects.NAME=STRENGTH`); here only the strength's bounds
and prior matter, and whether an effect is a nuisance: allowed within its prior, never named.
"""
from dataclasses import dataclass
from pathlib import Path

import yaml

from .findings import Findings

KINDS = ("rock", "machine", "observation")
TOP = ("title", "kind", "parameter", "overlay", "signature")
PARAMETER = ("name", "unit", "low", "high", "scale", "source")
# Signatures are measured up to so many prior scales: strong, but not absurd, where the rock goes its own way; where it
# does not, and chance hides nothing, near to how little is found, as not all effects are linear.
STRONG, EXACT = 1.5, 0.5


@dataclass(frozen=True)
class Effect:
    name: str
    title: str
    kind: str
    signature: str
    parameter: str
    unit: str
    low: float            # bounds of the strength; 0, between them, is off
    high: float
    scale: float          # prior: normal about 0 with this sd, cut to the bounds
    source: str
    overlay: tuple = ()   # (key, add|scale|set, factor); effects with the same overlay share their runs
    nuisance: bool = False

    @property
    def prior_mean(self):
        return 0.0

    @property
    def prior_scale(self):
        return self.scale

    def reference(self, scales=STRONG):
        """A strength of so many prior scales but within bounds, on the side the effect can take."""
        up = min(scales * self.scale, self.high)
        return up if up > 0 else max(-scales * self.scale, self.low)

    def strengths(self, same_rock):
        """The two strengths whose runs make the signature: to both sides, or half and full.

        `same_rock`: the effect is observed or replayed, so that no rock goes its own way.
        """
        full = self.reference(EXACT if same_rock else STRONG)
        return (max(-full, self.low), full) if self.low < 0 < full else (0.5 * full, full)


def read_catalogue(*folders):
    """Effects of the folders by name, later folders first in rank; throws BadInput with every fault."""
    found, out = Findings(), {}
    for folder in folders:
        for file in sorted(Path(folder).glob("*.yaml")):
            effect = _read(file, found)
            if effect:
                out[effect.name] = effect
    if not out and not found.all:
        found.add(folders[0], 0, "catalogue", "no effects", "a folder with a NAME.yaml for each")
    found.raise_if_any()
    return out


def _read(file, found):
    before = len(found.all)
    try:
        data = yaml.safe_load(file.read_text())
    except yaml.YAMLError as e:
        mark = getattr(e, "problem_mark", None)
        found.add(file, mark.line + 1 if mark else 0, "YAML", getattr(e, "problem", e), "a map")
        return None
    data = data if isinstance(data, dict) else {}
    parameter = data.get("parameter") if isinstance(data.get("parameter"), dict) else {}
    for key in [k for k in TOP if k not in data]:
        found.add(file, 0, key, "missing", "keys " + ", ".join(TOP))
    for key in [k for k in PARAMETER if k not in parameter]:
        found.add(file, 0, "parameter." + key, "missing", "keys " + ", ".join(PARAMETER))
    numbers = [parameter.get(k) for k in ("low", "high", "scale")]
    if not all(isinstance(x, (int, float)) for x in numbers):
        found.add(file, 0, "parameter", f"low, high, scale are {numbers}", "three numbers")
    elif not (numbers[0] <= 0 <= numbers[1] and numbers[0] < numbers[1] and numbers[2] > 0):
        found.add(file, 0, "parameter", f"low, high, scale are {numbers}", "low ... high around 0, scale > 0")
    if data.get("kind") not in KINDS:
        found.add(file, 0, "kind", f"is {data.get('kind')}", " or ".join(KINDS))
    for key, way in (data.get("overlay") or {}).items():
        if not (isinstance(way, dict) and len(way) == 1 and set(way) <= {"add", "scale", "set"}):
            found.add(file, 0, f"overlay.{key}", f"is {way}", "{add: a}, {scale: s} or {set: v}")
    if len(found.all) > before:
        return None
    overlay = tuple(sorted((k, *next(iter(v.items()))) for k, v in data["overlay"].items()))
    return Effect(file.stem, data["title"], data["kind"], data["signature"], parameter["name"],
                  str(parameter["unit"]), *map(float, numbers), parameter["source"], overlay,
                  bool(data.get("nuisance", False)))
