"""The built-in operator (mbs/path_follower.hpp) once more, as a program: every operation in its order.

What it sends is to be the built-in one's to the last bit (operated_machine_test.cpp), so that nothing is lost on the
way through the lines.
"""
import bisect
import csv

from dipper_run.operator import Operator, serve

DRIVES = ("hoist_m", "crowd_m", "swing_rad", "door_rad")
REACTION_S, GIVE_OUT_S = 0.2, 2.0
FULL, STALLED_CROWD, COMES_ALONG, ALONG, NEARLY_STOPPED, LET_BACK = 1.5, 0.25, 1.4, 0.5, 0.2, 0.1


def clamp(x, least, most):
    return least if x < least else most if x > most else x


class Motion:
    """machine/motion.cpp"""

    def __init__(self, file):
        with open(file) as f:
            rows = list(csv.reader(line for line in f if not line.startswith("#")))[1:]
        self.t = [round(float(r[0]) * 1e9) * 1e-9 for r in rows]
        self.x = [[float(r[1]), float(r[2]), float(r[3]) * 0.017453292519943295, float(r[4]) * 0.017453292519943295]
                  for r in rows]
        ns = [round(float(r[0]) * 1e9) for r in rows]
        self.h = [(b - a) * 1e-9 for a, b in zip(ns, ns[1:])]
        self.slope = [[0.0] * 4 for _ in rows]
        for i in range(1, len(rows) - 1):
            h0, h1 = self.h[i - 1], self.h[i]
            for j in range(4):
                d0, d1 = (self.x[i][j] - self.x[i - 1][j]) / h0, (self.x[i + 1][j] - self.x[i][j]) / h1
                if d0 * d1 > 0:
                    most = 3 * min(abs(d0), abs(d1))
                    self.slope[i][j] = clamp((h1 * d0 + h0 * d1) / (h0 + h1), -most, most)

    def at(self, t_s):
        """Positions and rates."""
        if not t_s >= self.t[0]:
            return self.x[0], [0.0] * 4
        if t_s >= self.t[-1]:
            return self.x[-1], [0.0] * 4
        i = bisect.bisect_right(self.t, t_s, 1, len(self.t) - 1) - 1
        h = self.h[i]
        s = (t_s - self.t[i]) / h
        position, rate = [], []
        for j in range(4):
            d = self.x[i + 1][j] - self.x[i][j]
            m0, m1 = h * self.slope[i][j], h * self.slope[i + 1][j]
            c2, c3 = 3 * d - 2 * m0 - m1, m0 + m1 - 2 * d
            position.append(self.x[i][j] + s * (m0 + s * (c2 + s * c3)))
            rate.append((m0 + s * (2 * c2 + s * 3 * c3)) / h)
        return position, rate


class PathFollower(Operator):
    def __init__(self):
        self.updated_s = 0.0
        self.time, self.rate, self.relief, self.relief_rate = 0.0, 1.0, 0.0, 0.0
        self.rate_slope = self.relief_slope = 0.0

    def start(self, hello):
        self._motion = Motion(hello["motion"])
        self._crowd_min = hello["limits"]["crowd_m"][0]

    def at(self, t_s):
        since = t_s - self.updated_s
        return (self.time + since * (self.rate + 0.5 * since * self.rate_slope), self.rate + since * self.rate_slope,
                self.relief + since * (self.relief_rate + 0.5 * since * self.relief_slope),
                self.relief_rate + since * self.relief_slope)

    def look(self, seen):
        t_s = seen["time_s"]
        self.time, self.rate, self.relief, self.relief_rate = self.at(t_s)
        self.updated_s = t_s
        r_crowd, r_others = seen["crowd_overload"], max(seen["hoist_overload"], seen["swing_overload"])
        crowd, others = (clamp((r - 1) / (FULL - 1), 0.0, 1.0) for r in (r_crowd, r_others))
        self.rate_slope = (min(1 - others, 1 - (1 - STALLED_CROWD) * crowd) - self.rate) / REACTION_S
        along = clamp((r_crowd - COMES_ALONG) / (FULL - COMES_ALONG), 0.0, 1.0)
        let_back = max(ALONG * along, LET_BACK * max(0.0, 1 - self.rate / NEARLY_STOPPED))
        at_stop = self._motion.at(self.time)[0][1] - self.relief <= self._crowd_min
        relief_rate = 0.0 if at_stop else let_back
        if let_back == 0:
            relief_rate = -(1 - crowd) * self.relief / GIVE_OUT_S
        self.relief_slope = (relief_rate - self.relief_rate) / REACTION_S

        time, rate, relief, back = self.at(seen["by_s"])
        position, speed = self._motion.at(time)
        position = [position[0], position[1] - relief, *position[2:]]
        speed = [rate * v + 0 * v for v in speed]
        speed[1] -= back
        return dict(zip(DRIVES, position)) | {f"{key}_s": v for key, v in zip(DRIVES, speed)}


if __name__ == "__main__":
    serve(PathFollower())
