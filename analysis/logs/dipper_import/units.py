"""Units a logger may write, and the channels that are read: each in one unit from here on."""
import math
from dataclasses import dataclass

# unit: (quantity, how much of the quantity's own unit it is). Own units: m, deg, kN, t.
UNITS = {
    "m": ("length", 1.0), "mm": ("length", 1e-3), "cm": ("length", 1e-2), "ft": ("length", 0.3048),
    "in": ("length", 0.0254), "yd": ("length", 0.9144),
    "deg": ("angle", 1.0), "rad": ("angle", math.degrees(1)), "mrad": ("angle", math.degrees(1e-3)),
    "rev": ("angle", 360.0),
    "kN": ("force", 1.0), "N": ("force", 1e-3), "MN": ("force", 1e3), "lbf": ("force", 4.4482216152605e-3),
    "kip": ("force", 4.4482216152605), "kgf": ("force", 9.80665e-3), "tf": ("force", 9.80665),
    "t": ("mass", 1.0), "kg": ("mass", 1e-3), "lb": ("mass", 0.45359237e-3), "klb": ("mass", 0.45359237),
    "short ton": ("mass", 0.90718474), "long ton": ("mass", 1.0160469088),
}
PERCENT = "%"      # of a range, given beside it
SWITCH = "switch"  # 0 or 1 for the ends of a range
OWN = {"length": "m", "angle": "deg", "force": "kN", "mass": "t"}


@dataclass(frozen=True)
class Kind:
    """A channel: its quantity, and its name and factor in a measured folder (docs/gap.md); None: not there."""

    quantity: str
    measured: str = None
    factor: float = 1.0

    @property
    def unit(self):
        return OWN[self.quantity]

    def units(self):
        """The units a logger may write it in."""
        return [u for u, (quantity, _) in UNITS.items() if quantity == self.quantity]


CHANNELS = {
    "hoist": Kind("length", "hoist_m"),
    "crowd": Kind("length", "crowd_m"),
    "swing": Kind("angle", "swing_rad", math.radians(1)),
    "door": Kind("angle"),
    "hoist_force": Kind("force", "hoist_force_kN"),
    "crowd_force": Kind("force", "crowd_force_kN"),
    "truck_mass": Kind("mass", "truck_mass_t"),
}
DRIVES = ("hoist", "crowd", "swing", "door")
FORCES = ("hoist_force", "crowd_force")
TRUCK_MASS = "truck_mass"
