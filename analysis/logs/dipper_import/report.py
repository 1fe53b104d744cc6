"""What an import did to the data, in words and as a plot."""
import numpy as np

from dipper_run.figures import pyplot

from .fit import off
from .units import CHANNELS, DRIVES, FORCES, TRUCK_MASS

DOTS, CURVE, GAP = "#8a8a8a", "#c2410c", "#fde68a"


def words(made, what, path, notes):
    """Lines of text."""
    rows = made.rows
    out = [f"{path.name}: {len(rows.time_s)} rows of {rows.time_s[-1]:.6g} s, one each {rows.interval_s:.3g} s, "
           f"from {rows.first_stamp} to {rows.last_stamp}"]
    out += [f"  {note}" for note in notes if not note.startswith("warning: ")]
    out.append("  drive      lowest   highest    top speed        top acceleration   largest change, at line     rms")
    for name in DRIVES:
        fit, readings, unit = made.fits[name], made.readings[name], CHANNELS[name].unit
        worst, largest, rms = off(fit.change)
        change = (f"{largest:10.3f} {unit:3s} {readings.lines[worst]:8d} {rms:10.4f}"
                  if not what.channels[name].switch else "    as the switch says")
        out.append(f"  {name:5s} {fit.value.min():8.2f}  {fit.value.max():8.2f} {unit:3s} {fit.speed:8.2f}"
                   f"{_most(what, name, 'speed')} {fit.acceleration:8.2f}{_most(what, name, 'acceleration')} {change}"
                   + ("  held to its limits" if fit.limited else ""))
    out.append(f"motion: {len(made.grid)} rows of {what.sample_s:g} s, {made.grid[-1]:.6g} s, "
               f"{len(made.spans)} passes that end with a dump")
    if made.measured:
        masses = ", ".join(f"{p.truck_mass_t:.1f}" for p in made.measured.passes)
        out.append(f"measured: {len(made.measured.time_s)} readings of {', '.join(made.measured.signals)}"
                   + (f"; passes of {masses} t" if TRUCK_MASS in what.channels else ""))
    return out + [note for note in notes if note.startswith("warning: ")]


def _most(what, name, key):
    most = getattr(what.limits[name], key)
    return f" of {most:<6.4g}" if np.isfinite(most) else 10 * " "


def plot(made, what, title, file):
    """Readings and curves over time, gaps shaded, as PNG."""
    plt = pyplot()
    names = [*DRIVES, *(n for n in (*FORCES, TRUCK_MASS) if n in what.channels)]
    figure, axes = plt.subplots(len(names), 1, sharex=True, figsize=(11, 1.7 * len(names)), constrained_layout=True)
    for name, axis in zip(names, axes):
        if name in made.fits:
            readings, fit = made.readings[name], made.fits[name]
            axis.plot(readings.time_s, readings.value, ".", color=DOTS, markersize=3.5, alpha=0.6, label="log")
            axis.plot(made.grid, fit.value, "-", color=CURVE, linewidth=0.9, label="motion.csv", zorder=1)
        else:
            axis.plot(made.rows.time_s, made.rows.values[name], "-", color=DOTS, linewidth=0.8)
        for start, end in made.gaps:
            axis.axvspan(start, end, color=GAP, zorder=0)
        for _, end in made.spans:
            axis.axvline(end, color="black", linewidth=1, linestyle=":")
        axis.set_ylabel(f"{name.replace('_', ' ')} [{CHANNELS[name].unit}]", fontsize=8)
        axis.tick_params(labelsize=8)
        axis.grid(alpha=0.3)
    axes[0].set_title(f"{title}: gaps shaded, ends of passes dotted", fontsize=9, loc="left")
    axes[0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=2, fontsize=8, frameon=False, borderaxespad=0.2)
    axes[0].margins(x=0.01)
    axes[-1].set_xlabel("time [s]", fontsize=8)
    figure.savefig(file, dpi=110)
    plt.close(figure)
