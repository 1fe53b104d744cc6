"""Units a logger may write, and the channels that are read: each in one unit from here on."""
import math
import re
from dataclasses import dataclass

from dipper_run.csv_text import unit_name

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
NO_UNITS = {"dm": ("length", 0.1), "km": ("length", 1e3), "gon": ("angle", 0.9), "daN": ("force", 1e-2),
            "tonf": ("force", 8.896443230521),  # that a log may name, and a map writes as a scale
            "ton": ("mass", 0.90718474)}        # short, or a tonne: the map says
BY_NAME = {u.lower(): u for u in (*UNITS, *NO_UNITS, PERCENT)}
AS_FORCE = {"t": "tf", "kg": "kgf", "lb": "lbf", "klb": "kip", "short ton": "tonf"}  # as forces are often written
TONS = {"mass": "short tons (0.907 t) or tonnes? unit: short ton, or scale: 1, in the map",
        "force": "short tons (8.896 kN) or tonnes? unit: kN, scale: 8.896, or unit: tf, scale: 1, in the map"}
IN_NAME = re.compile(r"[(\[<]([^()\[\]<>,;]+)[^()\[\]<>]*[)\]>]")  # Pull (kip), Mass [short ton], Pull (kip, filtered)
OF_OTHER_KIND = {"bar", "pa", "kpa", "mpa", "psi", "rpm", "nm", "knm", "cwt", "kt", "grad", "mil", "counts", "fathoms"}
CHANGED = re.compile(  # 0.1 kN, kN x10, 1000 lbs, US ft, m/s, kN/rope, m^3
    r"(?:[\d.,]+\s*[x*×·]?\s*|us |int )?(%|[a-zµ]+?(?: ton)?)\.?(?:\s*[x*×·]\s*[\d.,]+|\s*/\s*\w+|\^?\d)?", re.I)
LAST_WORD = re.compile(  # Pull_kip, Crowd %; not what may be another word: Hoist rope in, Swing rev, Door st
    r"[ _/.-](mm|cm|ft|feet|deg|degrees|rad|mrad|kN|MN|daN|lbf|kips?|kgf|tf|klbs?|kg|lbs?|tons?|tonnes?|%)$", re.I)


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


def unit_said(text):
    """The unit that a text is, as UNITS, NO_UNITS or PERCENT have it; the text itself, where it is another unit or a
    multiple of one; None of any other text."""
    if known := BY_NAME.get(unit_name(text)):
        return known
    changed = CHANGED.fullmatch(text.strip())
    of = unit_name(changed[1]) if changed else None
    return text.strip() if of in BY_NAME or of in OF_OTHER_KIND else None


def unit_in_name(name):
    """The unit in brackets or as a word at the end of a column's name, else in brackets within it, or None."""
    texts = IN_NAME.findall(name)[::-1]
    if word := LAST_WORD.search(name):
        texts.insert(0, word[1])
    return next(filter(None, map(unit_said, texts)), None)


def other_unit(unit, name, channel):
    """(unit, what would be right) where the unit that a log states for the channel of a name is not the map's, and the
    map's scale does not convert it; None else."""
    quantity = CHANNELS[name].quantity
    unit = AS_FORCE.get(unit, unit) if quantity == "force" else unit
    if unit is None or channel.switch or unit == channel.unit:
        return None
    if unit == "ton" and quantity in TONS:
        return None if channel.scaled or channel.unit in ("short ton", "long ton") else (unit, TONS[quantity])
    stated, size = {**UNITS, **NO_UNITS}.get(unit, (quantity, None))
    if size is None or stated != quantity:  # only the map can say how much of the quantity it is
        scaled = abs(channel.slope) != UNITS.get(channel.unit, (quantity, None))[1]
        right = f"unit: {unit} in the map, with its range" if unit == PERCENT else \
            f"a column of {quantity}" if size is not None else \
            f"a column of {quantity}, or how much of its unit, {OWN[quantity]}, one is: scale, in the map"
        return None if scaled and channel.unit != PERCENT else (unit, right)
    if math.isclose(abs(channel.slope), size, rel_tol=0.01):
        return None
    own = OWN[quantity]
    return unit, (f"unit: {own}, scale: {size:g}" if unit in NO_UNITS else f"unit: {unit}") + \
        " in the map, if the log is right"


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
