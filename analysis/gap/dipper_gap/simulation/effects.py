"""The catalogue, one data file an effect: `analysis/effects/NAME.yaml`, and a case's own in CASE/effects.

The simulator applies them (`dipper run CASE --set effects.NAME=STRENGTH`); here only the strength's bounds
and prior matter, and whether an effect is a nuisance: allowed within its prior, never named.
"""
from dataclasses import dataclass

from dipper_run.findings import BadInput
from dipper_run.program import ProgramFailed, ask


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
    affects: str = "settling"  # what its keys have to be made again from: the schema's word

    def reference(self, scales=STRONG):
        """A strength of so many prior scales but within bounds, on the side the effect can take."""
        up = min(scales * self.scale, self.high)
        return up if up > 0 else max(-scales * self.scale, self.low)

    def sides(self):
        """The bounds that it can go to: the upper one, the lower one, or both."""
        return [bound for bound in (self.low, self.high) if bound]

    def strengths(self, same_rock):
        """The two strengths whose runs make the signature: to both sides, or half and full.

        `same_rock`: the effect is observed or replayed, so that no rock goes its own way.
        """
        full = self.reference(EXACT if same_rock else STRONG)
        return (max(-full, self.low), full) if self.low < 0 < full else (0.5 * full, full)


def read_catalogue(case):
    """Effects that a case can take, by name: the catalogue's and its own; throws BadInput with every fault."""
    try:
        return {row["name"]: _effect(row) for row in ask("effects", case)["effects"]}
    except ProgramFailed as e:
        raise BadInput(str(e).splitlines()) from e


def _effect(row):
    p = row["parameter"]
    overlay = tuple(sorted((o["key"], o["how"], o["factor"]) for o in row["overlay"]))
    return Effect(row["name"], row["title"], row["kind"], row["signature"], p["name"], p["unit"], p["low"],
                  p["high"], p["scale"], p["source"], overlay, row["nuisance"], row["affects"])
