"""The channels of a measured folder: what each must be, and channels.yaml."""
from dataclasses import dataclass
from pathlib import Path

from dipper_run.findings import Findings
from dipper_run.section import Section
from dipper_run.text_file import read_yaml

DRIVEN = "driven"
RESPONSE = "response"
CHANNEL_KEYS = "{unit, role, sigma, common_sigma}"
ASSUMED = Path(__file__).with_name("assumed_channels.yaml")
MOST_DRIFT = 1.415  # of common_sigma: two errors of that size differ by no more


@dataclass(frozen=True)
class Kind:
    """What a channel of this name must be: its unit, and a size no sound reading passes."""

    unit: str
    largest: float
    hint: str


# The largest values are far beyond any shovel's: they catch a wrong unit, not a strange pass.
KNOWN = {
    "truck_mass_t": Kind("t", 1000.0, "kg, perhaps? 1 t = 1000 kg"),
    "face_m": Kind("m", 1000.0, "mm, perhaps?"),
    "hoist_m": Kind("m", 100.0, "mm, perhaps?"),
    "crowd_m": Kind("m", 50.0, "mm, perhaps?"),
    "swing_rad": Kind("rad", 10.0, "degrees, perhaps? 1 rad = 57.3 deg"),
    "hoist_force_kN": Kind("kN", 1e5, "N, perhaps? 1 kN = 1000 N"),
    "crowd_force_kN": Kind("kN", 1e5, "N, perhaps? 1 kN = 1000 N"),
}
MASS = "truck_mass_t"
FACE = "face_m"  # heights of profile.csv
MOTION = ("hoist_m", "crowd_m", "swing_rad")
FORCES = ("hoist_force_kN", "crowd_force_kN")


@dataclass(frozen=True)
class Channel:
    name: str
    unit: str
    role: str
    sigma: float
    common_sigma: float
    drift_sigma: float = None  # None: not given


def read_channels(file=ASSUMED):
    """{name: Channel} of a channels.yaml; throws BadInput. Without a file, of instruments as a mine may have them."""
    found = Findings()
    channels = channels_in(Path(file), found)
    found.raise_if_any()
    return channels


def channels_in(file, found):
    if not file.is_file():
        found.add(file, 0, "file", "not there",
                  f"list each channel as NAME: {CHANNEL_KEYS}")
        return {}
    section = Section(read_yaml(file, found, f"a map of channels, NAME: {CHANNEL_KEYS}"), file, found)
    channels = {name: _channel(section, name) for name in KNOWN if name in section}
    for name in section.keys():
        if name not in KNOWN:
            section.wrong(name, "unknown channel", "one of " + ", ".join(KNOWN))
    return {name: channels[name] for name in section.keys() if channels.get(name)}


def _channel(channels, name):
    """The Channel of a name; None where it is no map."""
    section, unit = channels.section(name, CHANNEL_KEYS), KNOWN[name].unit
    if not section:
        return None
    right = f"{unit}, in the values too"
    if (read_unit := section.text("unit", unit, right, needed=True)) != unit:
        section.wrong("unit", f"is {read_unit}", right)
    role = section.one_of("role", (DRIVEN, RESPONSE) if name in MOTION else (RESPONSE,), needed=True)
    sigma, common = (section.number(key, 0.0, f"a number in {unit}, 0 or more", needed=True, allowed=lambda x: x >= 0)
                     for key in ("sigma", "common_sigma"))
    drift = section.number("drift_sigma", None, f"a number in {unit}, 0 to {MOST_DRIFT - 0.005:g} times common_sigma",
                           allowed=lambda x: 0 <= x <= MOST_DRIFT * common)
    section.end()
    return Channel(name, unit, role, sigma, common, drift)
