"""From cycles to a measured folder (docs/gap.md): the mine's logger, cells, scale, survey and their errors."""
from dataclasses import dataclass

import numpy as np

from cycle import RATE_HZ, Hidden, cycle
from effects import DRIVES, LOGGED, MACHINE, Log

# channel: unit, role, error of one reading, error that all readings of these instruments share, and by how much that
# has moved since earlier trucks
CHANNELS = {"truck_mass_t": ("t", "response", 0.8, 1.0, 0.3),
            "hoist_m": ("m", "driven", 0.005, 0.0, 0.0),
            "crowd_m": ("m", "driven", 0.005, 0.0, 0.0),
            "swing_rad": ("rad", "driven", 0.001, 0.0, 0.0),
            "hoist_force_kN": ("kN", "response", 25.0, 15.0, 5.0),
            "crowd_force_kN": ("kN", "response", 25.0, 15.0, 5.0)}
STEP = {"truck_mass_t": 0.1, "hoist_m": 0.001, "crowd_m": 0.001, "swing_rad": 1e-4, "hoist_force_kN": 5.0,
        "crowd_force_kN": 5.0}     # of the displays
CHANGE_S = 60.0                    # from truck to truck, nothing logged
SURVEY = ("m", "response", 0.06, 0.04, 0.056)   # of a drone's points, of its levelling, which is another each day
ANGLE_DEG = 0.8                                 # of a pile's angle


def truck_log(digs, motion, hidden, truck=1):
    """One truck without errors of its instruments. hidden: {effect: strength}, all but those that need runs."""
    fields = {}
    for name, s in hidden.items():
        if name in MACHINE:
            fields.update(MACHINE[name](s))
    c = cycle(digs, motion, Hidden(**fields))
    forces = c.forces
    for name, s in hidden.items():
        if name in DRIVES:
            forces = DRIVES[name](c, forces, s)
    log = Log(c.time_s, {"hoist_m": c.drives[0], "crowd_m": c.drives[1], "swing_rad": c.drives[2],
                         "hoist_force_kN": forces[0] / 1e3, "crowd_force_kN": forces[1] / 1e3},
              c.dumped_kg / 1e3, truck)
    for name, s in hidden.items():
        if name in LOGGED:
            log = LOGGED[name](log, s)
    return log, c.passes


@dataclass(frozen=True)
class Errors:
    """What all readings of the instruments share: drawn once for a mine and its earlier trucks."""

    common: dict
    level_m: float

    @classmethod
    def draw(cls, rng):
        return cls({n: rng.normal(0, c[3]) for n, c in CHANNELS.items()}, rng.normal(0, SURVEY[3]))

    def moved(self, rng):
        """Of the same instruments at another time."""
        return Errors({n: e + rng.normal(0, CHANNELS[n][4]) for n, e in self.common.items()},
                      rng.normal(0, SURVEY[3]))


def second_means(log):
    """Times and means of each second of a log's signals."""
    every = int(RATE_HZ)
    n = len(log.time_s) // every * every
    return (log.time_s[:n].reshape(-1, every)[:, -1] + 0.5 / RATE_HZ,
            {k: v[:n].reshape(-1, every).mean(axis=1) for k, v in log.signals.items()})


def _read(name, values, errors, rng):
    seen = values + errors.common[name] + rng.normal(0, CHANNELS[name][2], np.shape(values))
    return np.round(seen / STEP[name]) * STEP[name]


def write_folder(folder, trucks, hidden, motion, errors, rng, pile_deg=()):
    """A measured folder of trucks, each a list of digs, through the instruments. pile_deg: true angles of piles."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "channels.yaml").write_text("".join(
        f"{n}: {{unit: {u}, role: {r}, sigma: {s:g}, common_sigma: {c:g}{f', drift_sigma: {d:g}' if d else ''}}}\n"
        for n, (u, r, s, c, d) in {**CHANNELS, "face_m": SURVEY}.items()))
    passes, rows, faces, start = [], [], [], 0.0
    for number, digs in enumerate(trucks, 1):
        log, spans = truck_log(digs, motion, hidden, number)
        time, means = second_means(log)
        seen = {n: _read(n, v, errors, rng) for n, v in means.items()}
        rows += ["%.3f," % (start + t) + ",".join("%.5g" % seen[n][k] for n in means) for k, t in enumerate(time)]
        tonnes = np.maximum(_read("truck_mass_t", log.tonnes, errors, rng), 0)
        passes += [f"{k},{start + a:.3f},{start + b:.3f},{m:.1f},{number}"
                   for k, ((a, _, b), m) in enumerate(zip(spans, tonnes), 1)]
        for k, d in enumerate(digs, 1):
            for after in (0, 1):
                faces += _points(k, d.face[:, 0], d.face[:, 1 + after], after, number, errors, rng)
        start += time[-1] + CHANGE_S
    names = [n for n in CHANNELS if n != "truck_mass_t"]
    _table(folder / "signals.csv", "time_s," + ",".join(names), rows)
    _table(folder / "passes.csv", "pass,t_start_s,t_end_s,truck_mass_t,truck", passes)
    _table(folder / "profile.csv", "pass,x_m,z_m,after,truck", faces)
    _table(folder / "pile_angle.csv", "pile,angle_deg",
           [f"{k},{a + rng.normal(0, ANGLE_DEG):.1f}" for k, a in enumerate(pile_deg, 1)])


def _points(number, x, z, after, truck, errors, rng):
    return [f"{number},{a:.2f},{max(0.0, b + errors.level_m + rng.normal(0, SURVEY[2])):.2f},{after},{truck}"
            for a, b in zip(x, z)]


def _table(file, head, rows):
    if rows:
        file.write_text(head + "\n" + "\n".join(rows) + "\n")
