"""What may be wrong with a cloud of which no point is over the bench."""
import numpy as np

from .site import Site

FOOT_m = 0.3048
DIGITS_m = 1e4          # surveyors leave leading digits out, or put the zone's number before the easting
READINGS = (            # columns, factors, what it is, what would be right
    ([1, 0, 2], [1, 1, 1], "with easting and northing exchanged",
     "name the columns in a header, northing,easting,elevation, or exchange the numbers of site.origin_m"),
    ([0, 2, 1], [1, 1, 1], "with the second and third column exchanged", "the elevation is the third column"),
    ([0, 2, 1], [1, -1, 1], "with y up, as x, -z, y", "turn the cloud: the elevation is the third column"),
    ([0, 1, 2], [FOOT_m] * 3, "read as feet", "convert the coordinates to metres"),
    ([0, 1, 2], [1e-3] * 3, "read as millimetres", "convert the coordinates to metres"),
    ([0, 1, 2], [1, 1, FOOT_m], "with elevations in feet", "convert the elevations to metres"))


def may_be(cloud, looked, site, over):
    """The sentence that says so. `over(points)`, which of (n, 3) in W are over the bench; `looked`: survey.Looked."""
    shift = _shift(looked, site)
    counts = np.zeros(len(READINGS) + 1, int)
    for part in cloud.parts():
        part = part[np.isfinite(part).all(axis=1)]
        for i, (columns, factors, _, _) in enumerate(READINGS):
            counts[i] += int(over(site.to_world(part[:, columns] * factors)).sum())
        counts[-1] += int(over(site.to_world(part + shift)).sum())
    k = int(counts.argmax())
    if counts[k] and k < len(READINGS):
        return f"{READINGS[k][2]} {counts[k]:,} points are there: {READINGS[k][3]}"
    if counts[k] and shift.any():
        return (f"shifted by {shift[0]:.0f}, {shift[1]:.0f} m {counts[k]:,} points are there: are leading digits left "
                "out, or is the zone's number before the easting? site.origin_m as the file has them")
    size = np.abs([looked.low, looked.high]).max(axis=0)
    if size[0] <= 180 and size[1] <= 90 and (looked.high - looked.low)[:2].max() < 0.1:
        return "are these degrees of longitude and latitude? Project the cloud to the mine's grid, in metres"
    extent = float((looked.high - looked.low).max())
    if extent > 2e3:
        return f"it is {extent:.0f} m wide: is it in millimetres? The coordinates are to be in metres"
    if site == Site():
        return ("say where W lies in the mine's coordinates: site.origin_m and site.azimuth_deg in the case, or "
                "--origin and --azimuth")
    return ("is site.origin_m (easting, northing, elevation) or site.azimuth_deg another? Are x, y and z the "
            "first columns of the file, or named in a header?")


def _shift(looked, site):
    middle = (looked.low + looked.high)[:2] / 2
    return np.array([*np.round((np.asarray(site.origin_m)[:2] - middle) / DIGITS_m) * DIGITS_m, 0.0])
