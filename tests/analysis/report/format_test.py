"""Numbers as the pages write them."""
import json
import pathlib
import subprocess
import unittest

FORMAT = pathlib.Path(__file__).resolve().parents[3] / "analysis/report/web/format.js"


def written(function, *values):
    script = f"import * as f from '{FORMAT}'; console.log(JSON.stringify({json.dumps(values)}.map((x) => f.{function}(x))))"
    done = subprocess.run(["node", "--input-type=module", "-e", script], text=True, capture_output=True, check=True)
    return json.loads(done.stdout)


class Format(unittest.TestCase):
    def test_ticks_differ_and_keep_their_sign(self):
        self.assertEqual(written("tick", 0, 0.5, 1e6, 1e-4), ["0", "0.5", "10⁶", "10⁻⁴"])
        self.assertEqual(written("tick", 5e6, 1e7, 2e7), ["5\u202f000\u202f000", "10⁷", "2.00·10⁷"])
        self.assertEqual(written("tick", -4e-4, 6e-4), ["\u22124.00·10⁻⁴", "6.00·10⁻⁴"])


if __name__ == "__main__":
    unittest.main()
