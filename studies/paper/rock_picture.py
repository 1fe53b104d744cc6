"""Pictures of spheres and triangles, for the scripts that repeat the paper's."""
import pathlib

import numpy as np

LIGHT_W = np.array([-0.35, 0.45, 0.82])
STEEL, GROUND = np.array([0.85, 0.55, 0.15]), np.array([0.93, 0.92, 0.90])


class Picture:
    """Spheres and triangles in perspective: what is nearest the eye stays in each pixel."""

    def __init__(self, eye_W, aim_W, half_width, pixels):
        """half_width: of the picture at a distance of 1; pixels: columns, rows."""
        self.eye, self.pixels = np.asarray(eye_W), pixels
        ahead = aim_W - self.eye
        self.ahead = ahead / np.linalg.norm(ahead)
        self.right = np.cross(self.ahead, [0, 0, 1])
        self.right /= np.linalg.norm(self.right)
        self.up = np.cross(self.right, self.ahead)
        self.focus = pixels[0] / 2 / half_width
        self.depth = np.full(pixels[::-1], np.inf)
        self.colour = np.tile(GROUND, (*pixels[::-1], 1))

    def seen(self, points):
        """Columns, rows and distances ahead (n) of points (n, 3) in W."""
        p = points - self.eye
        far = p @ self.ahead
        return (self.pixels[0] / 2 + self.focus * (p @ self.right) / far,
                self.pixels[1] / 2 - self.focus * (p @ self.up) / far, far)

    def spheres(self, centres, radii, colours):
        columns, rows, far = self.seen(centres)
        size = self.focus * radii / far
        width, height = self.pixels
        inside = ((columns > -size) & (columns < width + size) & (rows > -size) & (rows < height + size) &
                  (far > 1))
        for k in np.flatnonzero(inside):
            box, u, v = self._box(columns[k] - size[k], columns[k] + size[k], rows[k] - size[k], rows[k] + size[k])
            a, b = (u - columns[k]) / size[k], (rows[k] - v) / size[k]
            flat = a * a + b * b
            c = np.sqrt(np.maximum(0, 1 - flat))
            light = np.maximum(0, a * (self.right @ LIGHT_W) + b * (self.up @ LIGHT_W) - c * (self.ahead @ LIGHT_W))
            self._put(box, np.where(flat < 1, far[k] - radii[k] * c, np.inf),
                      colours[k] * (0.35 + 0.65 * light)[..., None])

    def triangles(self, corners, colour, opacity=1.0):
        """corners: (n, 3, 3). What is not opaque is drawn last."""
        for t in corners:
            normal = np.cross(t[1] - t[0], t[2] - t[0])
            light = 0.45 + 0.55 * abs(normal @ LIGHT_W) / (np.linalg.norm(normal) + 1e-12)
            columns, rows, far = self.seen(t)
            box, u, v = self._box(columns.min(), columns.max(), rows.min(), rows.max())
            edges = np.array([columns[1:] - columns[0], rows[1:] - rows[0]])
            if abs(np.linalg.det(edges)) < 1e-9 or not u.size:
                continue
            s, q = np.einsum("ij,jkl->ikl", np.linalg.inv(edges), np.array([u - columns[0], v - rows[0]]))
            nearness = 1 / far[0] + s * (1 / far[1] - 1 / far[0]) + q * (1 / far[2] - 1 / far[0])
            within = (s >= 0) & (q >= 0) & (s + q <= 1)
            self._put(box, np.where(within, 1 / np.where(within, nearness, 1), np.inf), colour * light, opacity)

    def _box(self, left, right, top, bottom):
        """A rectangle of pixels, and their middles."""
        columns = np.arange(max(0, int(left)), min(self.pixels[0], int(right) + 1))
        rows = np.arange(max(0, int(top)), min(self.pixels[1], int(bottom) + 1))
        u, v = np.meshgrid(columns + 0.5, rows + 0.5)
        first = (rows[0] if rows.size else 0, columns[0] if columns.size else 0)
        return (slice(first[0], first[0] + rows.size), slice(first[1], first[1] + columns.size)), u, v

    def _put(self, box, far, colour, opacity=1.0):
        nearer = far < self.depth[box]
        if opacity == 1:
            self.depth[box][nearer] = far[nearer]
        there = self.colour[box]
        there[nearer] += opacity * (np.broadcast_to(colour, there.shape)[nearer] - there[nearer])


def wall(file):
    """(n, 3, 3) corners of the triangles of a wall's dump, VTK's legacy format with three points a triangle."""
    lines = file.read_text().split("\n")
    start = next(k for k, line in enumerate(lines) if line.startswith("POINTS"))
    count = int(lines[start].split()[1])
    return np.array(" ".join(lines[start + 1:]).split()[:3 * count], float).reshape(-1, 3, 3)


def scene(run, folder, time_s):
    """Of the frame of `run` (dipper_run.read(folder)) nearest to a time: the frame, the spheres' centres (n, 3) and the
    corners of the triangles of dipper and door (m, 3, 3), in W."""
    frame = min(run.frames, key=lambda f: abs(f.time_s - time_s))
    steel = [wall(pathlib.Path(folder) / "dumps" / f"{body}_{frame.step}.vtk") for body in ("dipper", "door")]
    return frame, np.stack([frame.rocks[k] for k in "xyz"], 1), np.concatenate(steel)
