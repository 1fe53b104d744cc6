"""YADE does what the mine needs: led facets end where the motion has them, and a dig weighs what lies in the dipper."""
import json
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCRIPT = """
import sys; sys.path.insert(0, {here!r})
import json
import numpy as np
import dig as d
from bench import Outline, settled_bench
from dataclasses import replace
from rock import Grading, Material, Rocks
from shovel import Motion, Shovel
motion = Motion.read({motion!r})
outline = Outline(height=2.5, width=6.5, crest=0.5, toe=13.2)
rocks = settled_bench(replace(Material(), step=1e-3), Grading(), outline, 1, log=lambda s: None)
table, left, notes = d.dig(rocks, Material(), outline, Shovel(), motion, 34.0, log=lambda s: None, end_s=4.4)
led = LED
aim, axes = led.pose
err = max(np.abs(np.array(O.bodies[k].state.pos) - (aim + axes @ p)).max() for k, p in zip(led.ids, led.local))
print('SAID', json.dumps(dict(rocks=len(rocks), left=len(left), notes=notes, fx=table[:, 1].min(), off=float(err),
      load=table[-1, 7], lowest=min(float(m[:, 2].min()) for m in left.members), rows=len(table))))
"""


def test_a_small_dig(tmp_path):
    script = tmp_path / "small.py"
    script.write_text(SCRIPT.format(here=str(HERE), motion=str(HERE.parents[1] / "cases/screening/motion.csv")))
    said = subprocess.run(["yade", "-x", "-n", "-j1", script], capture_output=True, text=True, cwd=tmp_path)
    line = [text for text in said.stdout.splitlines() if text.startswith("SAID")]
    assert line, said.stdout[-2000:] + said.stderr[-2000:]
    m = json.loads(line[0][5:])
    assert m["rocks"] == m["left"] + m["notes"]["load_rocks"] + m["notes"]["cleared"]     # none is lost
    assert m["off"] < 0.02                            # m: within two steps' travel of where the motion has the dipper
    assert m["fx"] < -20e3 and m["load"] > 1000       # rock pushes the dipper back, and some is in it
    assert m["lowest"] > 0.2 and m["rows"] > 60       # no rock went through the ground
