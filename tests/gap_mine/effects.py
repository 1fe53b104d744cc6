"""What can be hidden in the mine, each done in its own way; strengths are in the catalogue's unit where it has one.

    RUN      s -> words for truck.py: needs digs of its own
    MACHINE  s -> fields of cycle.Hidden: in the machine or in the load
    DRIVES   (Cycle, forces (2, n) N, s) -> forces: between rock and cells
    LOGGED   (Log, s) -> Log: in the instruments
    SETS     the sets' names: CATALOGUE what `dipper gap` has a name for, OUTSIDE what it has none for today
"""
from dataclasses import dataclass, replace

import numpy as np

from shovel import Shovel

FLOOR_M2, CHEEKS_M2 = 16.0, 21.0   # of the dipper, inside
BULK = 1903.0                      # kg/m^3
STEEL = 7850.0


@dataclass(frozen=True)
class Log:
    """What drives and scale show without errors of their own, at the rate of cycle.RATE_HZ."""

    time_s: np.ndarray
    signals: dict        # {channel: (n,)}, kN, m, rad
    tonnes: np.ndarray   # a pass
    truck: int           # 1, 2, ... of the folder

    def changed(self, **signals):
        return replace(self, signals={**self.signals, **signals})

    def hours(self):
        """Since the first truck: one every 10 minutes."""
        return (600.0 * (self.truck - 1) + self.time_s) / 3600.0


# --- digs of their own ------------------------------------------------------------------------------

RUN = {"standoff": lambda s: [f"toe_m={s:g}"],            # the face is nearer
       "rake_offset": lambda s: [f"rake_deg={s:g}"],
       "grading": lambda s: [f"size={1 + s:g}"],          # every rock larger by a share
       "slippery_steel": lambda s: [f"steel={0.45 * (1 - s):g}"]}


# --- machine and load -------------------------------------------------------------------------------

def carry_back(s):
    """A cake of moist fines of s m in the mean over the floor, which grows over the truck; its room is lost."""
    grows = np.array([0.75, 1.05, 1.2]) * s * FLOOR_M2
    return {"stuck_kg": tuple(2100.0 * grows), "lost_kg": tuple(0.8 * BULK * grows)}


def liners(s):
    """Plates of s m on floor and cheeks: weight low in the dipper, and room that is lost."""
    kg, room = STEEL * s * (FLOOR_M2 + CHEEKS_M2), s * (FLOOR_M2 + CHEEKS_M2)
    d = Shovel()
    centre = tuple((d.dipper_mass * a + kg * b) / (d.dipper_mass + kg) for a, b in zip(d.dipper_centre, (2.0, -0.9)))
    return {"shovel": replace(d, dipper_mass=d.dipper_mass + kg, dipper_centre=centre),
            "lost_kg": (0.8 * BULK * room,) * 3}


def leaking_door(s):
    """The share s of a load is lost from the end of the dig to the dump, faster while there is more."""
    return {"leak_per_s": -np.log(1 - s) / 6.7}


def rock_density(s):
    """All rock heavier by the share s; contacts as much stiffer, so that every force is larger by it."""
    return {"heavier": 1 + s}


def sticky_load(s):
    """The share s of each load stays in until the next dig."""
    return {"kept": s}


def sloping_ground(s):
    """The machine stands s degrees nose up."""
    return {"slope_rad": np.radians(s)}


MACHINE = {f.__name__: f for f in (carry_back, liners, leaking_door, rock_density, sticky_load, sloping_ground)}


# --- between rock and cells -------------------------------------------------------------------------

def _speed(cycle, drive):
    return np.gradient(cycle.drives[drive], cycle.time_s)


def hoist_drive_loss(cycle, forces, s):
    """Gears of efficiency 1 - s: the motor pulls T / (1 - s) hauling in and holds T (1 - s) back paying out."""
    hauls = np.clip(-_speed(cycle, 0) / 0.04, -1, 1)
    return np.array([forces[0] * (1 - s) ** -hauls, forces[1]])


def crowd_friction(cycle, forces, s):
    """Dahl's model: friction builds up to s kN over some centimetres of the handle's way, and keeps at rest."""
    stiff, force, out = s * 1e3 / 0.02, 0.0, np.zeros(len(cycle.time_s))
    for k, step in enumerate(np.diff(cycle.drives[1], prepend=cycle.drives[1][0])):
        for _ in range(8):
            force += stiff * step / 8 * (1 - force / (s * 1e3) * np.sign(step))
        out[k] = force = np.clip(force, -s * 1e3, s * 1e3)
    return np.array([forces[0], forces[1] + out])


def tight_crowd(cycle, forces, s):
    """A bent handle: it takes s kN more against the motion for each metre the handle is out."""
    v = np.tanh(_speed(cycle, 1) / 0.03)
    return np.array([forces[0], forces[1] + 1e3 * s * v * np.clip(cycle.drives[1] + 1.5, 0, None)])


def cable_drag(cycle, forces, s):
    """The trailing cable pulls the handle back by s kN for each radian of swing."""
    return np.array([forces[0], forces[1] + 1e3 * s * np.abs(cycle.drives[2])])


DRIVES = {f.__name__: f for f in (hoist_drive_loss, crowd_friction, tight_crowd, cable_drag)}


# --- instruments ------------------------------------------------------------------------------------

def truck_spillage(log, s):
    """Of the last pass, what rolls off the heap: up to the share s, in rocks of 0.7 t."""
    tonnes = log.tonnes.copy()
    tonnes[-1] -= 0.7 * np.round(s * tonnes[-1] / 0.7)
    return replace(log, tonnes=tonnes)


def scale_gain(log, s):
    return replace(log, tonnes=log.tonnes * (1 + s))


def payload_bias(log, s):
    """Of s t a pass, the first truck is read with 0.3 t less and the last with as much more (its tank runs dry)."""
    return replace(log, tonnes=np.maximum(log.tonnes + s + 0.3 * np.clip((log.truck - 2.5) / 1.5, -1, 1), 0.0))


def logger_offset(log, s):
    """The force logger's clock is s late in the mean, by a step of 0.1 s more after each poll of ten readings."""
    late = s + 0.1 * (np.floor(log.time_s / 10) % 2 - 0.5)
    return log.changed(**{n: np.interp(log.time_s - late, log.time_s, log.signals[n])
                          for n in ("hoist_force_kN", "crowd_force_kN")})


def _gained(force, s):
    """Off by the share s in the mean: by less at small forces, by more at large ones (a gauge that comes loose)."""
    return force * (1 + s * (0.85 + 0.3 * np.abs(force) / (np.abs(force) + np.abs(force).mean())))


def hoist_cell_drift(log, s):
    return log.changed(hoist_force_kN=_gained(log.signals["hoist_force_kN"], s))


def crowd_cell_drift(log, s):
    return log.changed(crowd_force_kN=_gained(log.signals["crowd_force_kN"], s))


def hoist_zero_drift(log, s):
    """The cell's zero wanders off by s kN an hour as it warms up, half of it before the first truck."""
    return log.changed(hoist_force_kN=log.signals["hoist_force_kN"] + s * (0.5 + log.hours()))


def crowd_zero_drift(log, s):
    return log.changed(crowd_force_kN=log.signals["crowd_force_kN"] + s * (0.5 + log.hours()))


def clipped_cell(log, s):
    """The hoist's amplifier is at its end at s kN."""
    return log.changed(hoist_force_kN=np.minimum(log.signals["hoist_force_kN"], s))


def lazy_cell(log, s):
    """The hoist's cell follows with a time constant of s seconds (its filter is set wrong)."""
    x, dt = log.signals["hoist_force_kN"], log.time_s[1] - log.time_s[0]
    out = np.empty_like(x)
    out[0] = x[0]
    for k in range(1, len(x)):
        out[k] = out[k - 1] + (x[k] - out[k - 1]) * (1 - np.exp(-dt / s))
    return log.changed(hoist_force_kN=out)


LOGGED = {f.__name__: f for f in (truck_spillage, scale_gain, payload_bias, logger_offset, hoist_cell_drift,
                                  crowd_cell_drift, hoist_zero_drift, crowd_zero_drift, clipped_cell, lazy_cell)}
CATALOGUE = ("carry_back", "liners", "hoist_drive_loss", "crowd_friction", "truck_spillage", "scale_gain",
             "logger_offset", "payload_bias", "hoist_cell_drift", "crowd_cell_drift", "standoff", "rake_offset",
             "grading", "leaking_door")
NUISANCE = ("rock_density",)
OUTSIDE = ("sticky_load", "sloping_ground", "tight_crowd", "cable_drag", "hoist_zero_drift",
           "crowd_zero_drift", "clipped_cell", "lazy_cell", "slippery_steel")
