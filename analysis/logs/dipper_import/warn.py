"""Input that is valid but probably a mistake: a line each that begins with "warning: "."""
import numpy as np

from dipper_gap.readings.machine_warnings import BEYOND_RATED
from dipper_gap.readings.mass_warnings import rise_as_totals
from dipper_gap.readings.suspect import DROP, SMALL, falls, pushes, stuck

from .phrases import leave_out, longest_of, some_rows
from .units import CHANNELS, FORCES, TRUCK_MASS

# Far beyond any shovel's, where the map names no machine.
LARGEST = {"hoist_force": 8000.0, "crowd_force": 8000.0, TRUCK_MASS: 700.0}  # kN, kN, t
BEYOND_STALL = 1.5         # times what a drive can pull: strokes of the rope, errors of the instrument
PASS_S = (5.0, 300.0)      # of one pass; 20 to 60 s are usual
SHORT = 0.5                # of the usual pass: no pass of its own
LEAST_LOAD_T = 2.0         # the fullest of all passes: less than a boulder
LIKE_A_PASS = 3            # times all others: the first pass, where differences of a pass's mass are taken
SHOWN = 6                  # masses in a warning
MOSTLY_EMPTY = 0.5         # of the rows without a reading
SIGMAS = 3                 # of the scale: as far apart two readings of one mass may be
LEAST_OF_STALL = 0.02      # of what a drive can pull: an empty dipper's weight alone is more


def warn_of_readings(rows, spans, what, notes):
    for name in (*FORCES, TRUCK_MASS):
        if name not in what.channels:
            continue
        _warn_of_size(name, rows, what, notes)
        if name in FORCES:
            _warn_of_empty(name, rows, notes)
            _warn_of_falls(name, rows, notes)
            if not what.channels[name].held:
                _warn_of_stuck(name, rows, notes)
    if "hoist_force" in what.channels:
        _warn_of_sign(rows, notes)
    if TRUCK_MASS in what.channels:
        _warn_of_scale(rows, spans, what.channels[TRUCK_MASS], notes)
    lengths = [b - a for a, b in spans]
    if lengths and not (PASS_S[0] <= np.median(lengths) <= PASS_S[1]):
        notes.append(f"warning: a pass takes {np.median(lengths):.4g} s, where 20 to 60 s are usual: is "
                     "time.format right?")
    short = [k for k, length in enumerate(lengths) if length < SHORT * np.median(lengths)]
    if short:
        start, end = spans[short[0]]
        more = f"; {len(short)} such passes" if len(short) > 1 else ""
        notes.append(f"warning: pass {short[0] + 1} ({start:.4g} to {end:.4g} s) takes less than half of the usual "
                     f"{np.median(lengths):.4g} s: does the log begin within it, or the door open twice?{more}")


def warn_of_masses(masses, what, notes):
    """Of what the passes bring, t."""
    most, reads = max(masses, default=0.0), what.channels[TRUCK_MASS].reads
    words = None
    if reads == "pass" and rise_as_totals(masses):
        words = "rise with every pass, as on a scale that shows the total (reads: total)"
    elif reads == "pass" and len(masses) > 1 and min(masses) == most:
        words = "are equal to the last digit: a load per truck, or a scale that is stuck?"
    elif reads == "total" and len(masses) > 1 and LIKE_A_PASS * max(masses[1:]) < masses[0]:
        words = "are small after the first, as of a scale that shows what the last pass brought (reads: pass)"
    if words:
        notes.append(f"warning: truck_mass: with reads: {reads} the passes bring "
                     f"{', '.join(f'{m:.4g}' for m in masses[:SHOWN])}{' ...' if len(masses) > SHOWN else ''} t, "
                     f"which {words}")
    if 0 < most < LEAST_LOAD_T:
        notes.append(f"warning: truck_mass: the fullest pass brings {most:.3g} t: wrong unit or scale?")
    if what.rated_load_t and most > BEYOND_RATED * what.rated_load_t:
        notes.append(f"warning: truck_mass: pass {masses.index(most) + 1} brings {most:.4g} t, more than "
                     f"{BEYOND_RATED:g} times the {what.rated_load_t:.4g} t that the machine's dipper is rated for: "
                     "wrong unit or scale?")


def _warn_of_empty(name, rows, notes):
    empty = ~np.isfinite(rows.values[name])
    if empty.all():
        notes.append(f"warning: {name}: no row has a reading: are its times the log's, in the same time zone?")
    elif empty.mean() > MOSTLY_EMPTY:
        notes.append(f"warning: {name}: {int(empty.sum())} of {len(empty)} rows have no reading: "
                     f"channels.{name}.held: true, if it is written only as it changes")


def _warn_of_size(name, rows, what, notes):
    value, unit = rows.values[name], CHANNELS[name].unit
    most = BEYOND_STALL * what.stall_kN[name] if name in what.stall_kN else LARGEST[name]
    least = -most if name == "crowd_force" else -0.25 * most  # a rope cannot push, a load does not lift
    with np.errstate(invalid="ignore"):
        beyond = (value > most) | (value < least)
    if beyond.any():
        source = f"{BEYOND_STALL:g} times its stall force" if name in what.stall_kN else "more than any shovel's"
        notes.append(f"warning: {name}: {some_rows(rows.lines[beyond], 'reading')} beyond {least:.4g} to {most:.4g} "
                     f"{unit} ({source}); the first is {value[beyond][0]:.6g} {unit}: wrong unit, sign or scale, or "
                     "no reading (file.missing)?")
    largest = np.nanmax(np.abs(value), initial=0.0, where=np.isfinite(value))
    empty = max(what.empty_kN.get(name, 0.0), LEAST_OF_STALL * most / BEYOND_STALL)
    if name in FORCES and 0 < largest < empty:
        notes.append(f"warning: {name}: no reading is beyond {largest:.4g} {unit}, less than an empty dipper takes "
                     f"({empty:.4g} {unit}): wrong unit, scale or mark of decimals?")


def _warn_of_falls(name, rows, notes):
    for low, fallen, least in falls(rows.values[name]):
        unit = CHANNELS[name].unit
        notes.append(f"warning: {name}: {some_rows(rows.lines[fallen], 'reading')} of {low:.6g} {unit} between "
                     f"others of {least:.4g} {unit} and more: no readings? {leave_out(name, by_number=low != 0)}")


def _warn_of_stuck(name, rows, notes):
    found = stuck(rows.values[name], rows.values["hoist"], rows.values["crowd"])
    if found:
        a, b, count, way, times = found
        notes.append(f"warning: {name}: {rows.values[name][a]:.6g} {CHANNELS[name].unit} in all {count} rows from line "
                     f"{rows.lines[a]} to {rows.lines[b]}, while hoist and crowd move by {way:.3g} m"
                     f"{longest_of(times)}: is the instrument stuck, or at the end of its range? "
                     f"{leave_out(name, by_number=False)}")


def _warn_of_sign(rows, notes):
    if pushes(rows.values["hoist_force"]):
        notes.append("warning: hoist_force: its largest forces are negative, and a rope only pulls: "
                     "channels.hoist_force.sign: -1, perhaps?")


def _warn_of_scale(rows, spans, channel, notes):
    """Of a total that falls and is back at once before a truck can have been changed and loaded."""
    there = np.flatnonzero(np.isfinite(rows.values[TRUCK_MASS]))
    mass, time = rows.values[TRUCK_MASS][there], rows.time_s[there]
    if channel.reads != "total" or not spans or not len(there):
        return
    shortest, usual = min(b - a for a, b in spans), mass.max()
    same = max(SIGMAS * channel.sigma, SMALL * usual)
    for k in 1 + np.flatnonzero(np.diff(mass) < -DROP * usual):
        back = (np.diff(mass, prepend=0) > DROP * usual) & (np.abs(mass - mass[k - 1]) <= same)
        soon = np.flatnonzero(back & (time > time[k]) & (time < time[k] + shortest))
        if len(soon):
            lines, again = rows.lines[there], soon[0]
            notes.append(f"warning: truck_mass: {mass[k - 1]:.4g} t, then {mass[k]:.4g} t from line {lines[k]} and "
                         f"{mass[again]:.4g} t again at line {lines[again]}: no readings between them? "
                         + leave_out(TRUCK_MASS))
            return
