"""What the truck got against what the rope carried: one more feature of each pass.

A load hangs on the hoist rope from breakout to dump, so mass and hoist force rise and fall together from seed
to seed. Their difference hardly scatters, and tells an error of the scale from more rock. Few runs do not
show so close a tie to a shrunk covariance: it is put in as a feature. How many kN a tonne adds to the rope
follows from the baseline's own runs.
"""
import numpy as np

from .channels import MASS
from .features import Cell

HOIST = "hoist_force_kN"
BALANCE = "balance"


def _mass_and_force(cells):
    """{pass: (mass, hoist force in swing, on return)} as indices."""
    index = {c: i for i, c in enumerate(cells)}
    out = {}
    for number in dict.fromkeys(c.pass_number for c in cells):
        wanted = (Cell(number, "dump", MASS, "mass"), Cell(number, "swing", HOIST, "mean"),
                  Cell(number, "return", HOIST, "mean"))
        if all(c in index for c in wanted):
            out[number] = tuple(index[c] for c in wanted)
    return out


def tonnes_a_kN(cells, rows):
    """Slope of mass over the carried force, within each pass, from runs (R, n); None when they do not tell."""
    where = _mass_and_force(cells)
    if not where or len(rows) < 3:
        return None
    centred = rows - rows.mean(axis=0)
    mass = np.concatenate([centred[:, m] for m, _, _ in where.values()])
    force = np.concatenate([centred[:, s] - centred[:, r] for _, s, r in where.values()])
    spread = force @ force
    return float(mass @ force / spread) if spread > 0 and mass @ force > 0 else None


def balanced(cells, rows, slope):
    """Cells and features (..., n) with the balance of every pass added, in t; linear in the features."""
    where = _mass_and_force(cells) if slope else {}
    more = [rows[..., m] - slope * (rows[..., s] - rows[..., r]) for m, s, r in where.values()]
    new = [Cell(number, "dump", MASS, BALANCE) for number in where]
    return list(cells) + new, np.concatenate([rows] + [x[..., None] for x in more], axis=-1)
