#!/usr/bin/env -S yade -x -n -j1
"""What the mine's rock weighs in a box and how steep its piles stand.

    yade -x -n -j1 calibrate.py box|pile SEED [KEY=VALUE ...]

Prints one line of JSON. Keys: friction, density, size, lift (m, of the pile's sheet). The box is five of the largest
rocks wide and struck level; the pile forms as an upright sheet is lifted at 0.61 m/s for 12.2 m, or slower for less,
and is measured between 20 and 80 % of its height.
"""
import json
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # yade runs a script as its own __main__
from rock import Grading, Material, Scene, strewn  # noqa: E402


def lattice(low, high, largest, rng):
    """Sites in a box from `low` (3,) up, in its ground plan to `high` (2,), in layers."""
    pitch = 1.16 * largest
    n = [max(1, int((high[k] - low[k]) / pitch)) for k in range(2)]
    x = [low[k] + (np.arange(n[k]) + 0.5) * (high[k] - low[k]) / n[k] for k in range(2)]
    layers = low[2] + 0.55 * largest + 0.98 * pitch * np.arange(200)
    return np.stack(np.meshgrid(layers, x[0], x[1], indexing="ij"), -1).reshape(-1, 3)[:, [1, 2, 0]]


def box(material, grading, seed):
    """Bulk density [kg/m^3] in a box with rough floor and slick sides."""
    rng = np.random.default_rng([seed, 2])
    largest = grading.classes[-1][1]
    edge = 5 * largest
    rocks = strewn(grading, 0.66 * edge**3, lattice((0, 0, 0), (edge, edge), largest, rng), rng)
    scene = Scene(material, damping=0.3)
    scene.wall(0, 2)
    for axis in (0, 1):
        scene.wall(0, axis, scene.slick), scene.wall(edge, axis, scene.slick)
    scene.add(rocks)
    scene.start()
    scene.run(5.0)
    points = np.random.default_rng(seed).uniform(0, edge, (40000, 3))
    return {"bulk_density_kg_m3": round(material.density * scene.rocks(rocks).filled(points), 1), "rocks": len(rocks)}


def pile(material, grading, seed, lift):
    """Angle [deg] of the flank before a lifted sheet."""
    rng = np.random.default_rng([seed, 3])
    largest = grading.classes[-1][1]
    depth, width = max(0.5 * lift + 2, 3.5 * largest), 4 * largest
    volume = 0.58 * width * (0.85 * lift**2 + depth * lift)
    rocks = strewn(grading, volume, lattice((-depth, 0, 0), (-0.1, width), largest, rng), rng)
    scene = Scene(material, damping=0.3)
    scene.wall(0, 2), scene.wall(-depth, 0, scene.slick)
    scene.wall(0, 1, scene.slick), scene.wall(width, 1, scene.slick)
    a, b, c, d = (0, -1, 0), (0, width + 1, 0), (0, width + 1, 60), (0, -1, 60)
    sheet = scene.facets(np.array([[a, b, c], [a, c, d]], float), scene.steel)
    scene.add(rocks)
    scene.start()
    scene.run(4.5)
    scene.newton.damping = 0.0
    speed = 0.61 * np.sqrt(lift / 12.2)
    for k in sheet:
        scene.O.bodies[k].state.vel = (0, 0, speed)
    scene.run(lift / speed)
    scene.run(2.0 * np.sqrt(lift))
    out = np.arange(0.25, 3 * lift, 0.25)
    x, y = np.meshgrid(out, np.linspace(0.15, 0.85, 15) * width, indexing="ij")
    top = np.median(scene.rocks(rocks).surface(x.ravel(), y.ravel()).reshape(x.shape), axis=1)
    high = top[:4].mean()
    flank = (top > 0.2 * high) & (top < 0.8 * high)
    at = np.flatnonzero(flank)
    slopes = [(top[i] - top[j]) / (out[i] - out[j]) for i in at for j in at if i > j]
    return {"angle_deg": round(float(np.degrees(np.arctan(-np.median(slopes)))), 2), "height_m": round(float(high), 2),
            "rocks": len(rocks)}


def main(words):
    keys = {k: float(v) for k, v in (w.split("=") for w in words[2:])}
    material = Material()
    material = replace(material, friction=keys.get("friction", material.friction),
                       density=keys.get("density", material.density))
    grading, start = Grading().scaled(keys.get("size", 1.0)), time.process_time()
    said = box(material, grading, int(words[1])) if words[0] == "box" else pile(material, grading, int(words[1]),
                                                                                keys.get("lift", 6.0))
    print(json.dumps({"what": words[0], "seed": int(words[1]), "friction": material.friction,
                      "density": material.density, **said, "cpu_s": round(time.process_time() - start, 1)}), flush=True)


main(sys.argv[1:])
