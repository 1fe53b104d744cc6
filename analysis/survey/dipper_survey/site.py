"""Where the world frame W lies in the mine's coordinates."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Site:
    """`site` of a case: easting, northing and elevation of W's origin in m, and the azimuth of W's x, the direction of
    the dig, in degrees clockwise from grid north. The default is W itself: x east, y north."""

    origin_m: tuple = (0.0, 0.0, 0.0)
    azimuth_deg: float = 90.0

    @property
    def axes(self):
        """(2, 2): x (out to the face) and y (left of it) of W as rows, in easting and northing."""
        a = np.radians(self.azimuth_deg)
        return np.array([[np.sin(a), np.cos(a)], [-np.cos(a), np.sin(a)]])

    def to_world(self, points):
        """(n, 3) of easting, northing, elevation in m -> (n, 3) in W, float64: the large part of a coordinate goes
        before anything else is done to it."""
        local = np.asarray(points, float) - np.asarray(self.origin_m, float)
        return np.column_stack([local[:, :2] @ self.axes.T, local[:, 2]])
