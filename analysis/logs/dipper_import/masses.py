"""What each pass brought to the truck, by its scale or by the shovel's payload monitor."""
import numpy as np

from dipper_gap.readings.phases import find_phases

from .units import TRUCK_MASS

WEIGHED_S = 1.0  # readings of the scale that are averaged
TARE = 0.05      # of a load: more in a dipper that comes back empty is none
CHANGED = 0.2    # of what a scale shows: a fall by more is another truck
SIGMAS = 3       # of the scale: as far below zero the mass of a pass that loads nothing may be
WAYS_TO_READ = ("reads: total is a scale that goes up with each pass, reads: pass shows what the last pass brought, "
                "reads: dipper the load in the dipper, until it is dumped")


class Scale:
    """The readings of a scale."""

    def __init__(self, rows, channel, longest_gap_s):
        there = np.isfinite(rows.values[TRUCK_MASS])
        self.time_s, self.mass = rows.time_s[there], rows.values[TRUCK_MASS][there]
        self.oldest_s = np.inf if channel.held else longest_gap_s  # of a reading that still counts

    def level(self, start, end):
        """Median of the readings between two times, else the last one before them; None without any."""
        first, last = np.searchsorted(self.time_s, start), np.searchsorted(self.time_s, end, side="right")
        if first < last:
            return float(np.median(self.mass[first:last]))
        known = first > 0 and start - self.time_s[first - 1] <= self.oldest_s
        return float(self.mass[first - 1]) if known else None

    def highest(self, start, end):
        """The highest level that it shows for WEIGHED_S between two times; None without any."""
        starts = self.time_s[(self.time_s >= start) & (self.time_s <= end - WEIGHED_S)]
        return max((self.level(t, t + WEIGHED_S) for t in starts), default=None)


def truck_masses(rows, fits, grid, spans, what, path, found, notes):
    """t, a pass each; 0 where the scale shows less, within its error. NaN after a finding."""
    channel, none = what.channels[TRUCK_MASS], [np.nan] * len(spans)
    scale = Scale(rows, channel, what.longest_gap_s)
    phases = find_phases(grid, fits["crowd"].value, np.radians(fits["swing"].value), spans)
    dumps = [p.get("dump", (end, end))[0] for p, (_, end) in zip(phases, spans)]
    if channel.reads != "pass" and not _dump_within(rows, dumps, spans, path, found):
        return none
    until, out, late, least = [*dumps[1:], rows.time_s[-1]], [], [], -SIGMAS * channel.sigma
    for number, ((start, end), dump, last) in enumerate(zip(spans, dumps, until), 1):
        before, after = _before_and_after(scale, number, start, dump, end, last, channel, late, notes)
        if after is None or before is None or after - before < least:
            line = int(rows.lines[np.searchsorted(rows.time_s, end, side="right") - 1])
            found.add(path, line, channel.column,
                      f"pass {number} ({start:.4g} to {end:.4g} s) "
                      + ("has no reading before or after its dump" if after is None or before is None
                         else f"brings {after - before:.4g} t"),
                      f"0 t or more, down to {least:.3g} t where it loads nothing ({SIGMAS} sigma); {WAYS_TO_READ}"
                      + ("" if channel.held or after is not None and before is not None else
                         "; held: true, if it is written once a dump"))
            return none
        if after <= before:
            notes.append(f"warning: truck_mass: pass {number} ({start:.4g} to {end:.4g} s) brings "
                         f"{after - before:.4g} t, within {SIGMAS} sigma of the scale ({-least:.3g} t): taken as 0")
        out.append(max(0.0, after - before))
    if late:
        number, at_end, settled = late[0]
        notes.append(f"warning: truck_mass: {at_end:.4g} t as pass {number} ends, and {settled:.4g} t later on, which "
                     "counts: the scale shows a pass late" + (f"; so in {len(late)} passes" if len(late) > 1 else ""))
    if channel.reads == "total":
        _warn_of_rise(scale, len(spans), until[-1], channel, notes)
    if channel.reads == "pass" and any(out):
        _warn_of_late(scale, spans, until, channel, notes)
    if not any(out):
        found.add(path, int(rows.lines[0]), channel.column,
                  f"no pass brings anything with reads: {channel.reads}; the readings "
                  f"go up to {scale.mass.max(initial=0.0):.4g} t",
                  WAYS_TO_READ)
    return out


def _dump_within(rows, dumps, spans, path, found):
    """Whether each pass swings to the truck before it ends, else a finding: its load would be none."""
    for number, (dump, (start, end)) in enumerate(zip(dumps, spans), 1):
        if end - dump < WEIGHED_S:
            found.add(path, int(rows.lines[np.searchsorted(rows.time_s, start)]), "passes",
                      f"pass {number} ({start:.4g} to {end:.4g} s) has no dump that takes {WEIGHED_S:g} s"
                      + (": the log begins within a pass" if number == 1 else ""),
                      "a time.from before its dig, or after its end" if number == 1 else
                      "a swing to the truck before the door opens: channels.swing; or wrong readings of channels.door")
            return False
    return True


def _before_and_after(scale, number, start, dump, end, until, channel, late, notes):
    """What the scale shows before and after the dump of a pass, t; `until`: the next dump, or the log's end.
    `late` takes (pass, t as it ends, t later) of a total that rises after a pass."""
    full = scale.level(max(start, dump - WEIGHED_S), dump)
    at_end = scale.level(end - WEIGHED_S, end)
    if channel.reads == "dipper":
        _warn_of_tare(number, scale.level(start, start + WEIGHED_S), full, channel, notes)
        return 0.0, full
    if channel.reads == "pass":
        return 0.0, at_end
    settled = _settled(scale, at_end, end, until, channel)
    if None not in (at_end, settled) and abs(settled - at_end) > SIGMAS * channel.sigma:
        late.append((number, at_end, settled))
    return full, settled


def _settled(scale, at_end, end, until, channel):
    """What a total shows for a pass: before the next dump, or at its highest where another truck has come since."""
    level = scale.level(max(end, until - WEIGHED_S), until)
    highest = scale.highest(end - WEIGHED_S, until)
    if highest is None:
        return at_end if level is None else level
    if level is not None and level >= highest - max(SIGMAS * channel.sigma, CHANGED * highest):
        return level
    return at_end if at_end is not None and highest - at_end <= SIGMAS * channel.sigma else highest


def _warn_of_tare(number, empty, full, channel, notes):
    """Warns of a payload monitor that shows a load as its pass begins."""
    if None not in (empty, full) and empty > max(SIGMAS * channel.sigma, TARE * full):
        notes.append(f"warning: truck_mass: as pass {number} begins, {empty:.4g} t are in the dipper: its own weight "
                     "(offset), or what the last pass brought (reads: pass)?")


def _warn_of_rise(scale, number, end, channel, notes):
    """Warns of a scale that still rises as the log ends: the mass of the last pass is then too small."""
    earlier, at_end = scale.level(end - 2 * WEIGHED_S, end - WEIGHED_S), scale.level(end - WEIGHED_S, end)
    if None not in (earlier, at_end) and at_end - earlier > SIGMAS * channel.sigma:
        notes.append(f"warning: truck_mass: the scale still rises as the log ends, from {earlier:.4g} to "
                     f"{at_end:.4g} t within {2 * WEIGHED_S:g} s: pass {number} may have brought more. A longer log, "
                     "or a time.to before that pass")


def _warn_of_late(scale, spans, until, channel, notes):
    """Warns of a scale that shows a pass only after its end: each mass is then that of the pass before."""
    for number, ((_, end), next_dump) in enumerate(zip(spans, until), 1):
        at_end = scale.level(end - WEIGHED_S, end)
        later = scale.level(max(end, next_dump - WEIGHED_S), next_dump)
        if None not in (at_end, later) and later > SIGMAS * channel.sigma < abs(later - at_end):
            notes.append(f"warning: truck_mass: {at_end:.4g} t as pass {number} ends, and {later:.4g} t before the "
                         "next dump: does the scale show a pass only then? Its masses are those of the passes before")
            return
