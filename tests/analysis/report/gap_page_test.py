"""The page of a gap analysis in headless Chromium: what it says, its keys, a phone, the dark, paper.

DIPPER names the program, whose `dipper page` writes the page. The analysis is one of the synthetic shovel.
"""
import base64
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "analysis/gap"), str(ROOT / "analysis/runs"), str(ROOT / "tests/analysis/gap")]
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402

import fake_mine  # noqa: E402
import synthetic  # noqa: E402
from browser import Browser  # noqa: E402
from dipper_gap.gap_json import as_json  # noqa: E402
from dipper_gap.report import page, write_report  # noqa: E402
from dipper_gap.workflow import analyse  # noqa: E402

NAMES = ("fines", "crowd_friction", "scale_gain", "density")
STORED = ROOT / "tests/analysis/gap/blind/results"


def dipper_page(data, file):
    return subprocess.run([os.environ["DIPPER"], "page", str(file)], input=data, capture_output=True, text=True)


class Analysis(unittest.TestCase):
    """One analysis with a hidden effect, and its page in a browser."""

    @classmethod
    def setUpClass(cls):
        catalogue = {n: fake_mine.CATALOGUE[n] for n in NAMES}
        mine = synthetic.with_noise(synthetic.run({"fines": 0.2}, seed=901), 1)
        out = analyse(mine, fake_mine.FakeSimulator(), catalogue, 1, lambda text: None)
        cls.answer = as_json(out, catalogue, {"case": "0" * 64})
        cls.data = page(out, cls.answer, catalogue, "synthetic <b>")
        folder = tempfile.TemporaryDirectory(prefix="dipper-gap-page-")
        cls.addClassCleanup(folder.cleanup)
        cls.file = pathlib.Path(folder.name) / "report.html"
        write_report(out, cls.answer, catalogue, cls.file, "synthetic <b>")
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)
        cls.browser.open(cls.file)

    def setUp(self):
        self.browser.run("window.scrollTo(0, 0); document.activeElement.blur()")

    def tearDown(self):
        self.assertEqual(self.browser.errors(), [])

    def text(self, selector):
        return self.browser.run("return document.querySelector(arguments[0]).textContent", selector)

    def media(self, **features):
        driver = self.browser.driver
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                               {"features": [{"name": k.replace("_", "-"), "value": v} for k, v in features.items()]})
        self.addCleanup(driver.execute_cdp_cmd, "Emulation.setEmulatedMedia", {"features": []})

    def test_says_the_verdict(self):
        self.assertEqual(self.answer["verdict"], "named")
        self.assertTrue(self.text(".verdict .head").startswith("Fines: strength 0."))
        self.assertIn("gap closed, held out", self.text(".figures"))
        self.assertIn("--set effects.fines=", self.text("#again pre"))
        self.assertEqual(self.browser.run("return document.title"), "synthetic <b> – Dipper")

    def test_the_table_of_masses_has_two_standard_deviations_as_its_text_says(self):
        self.assertIn("two standard deviations", self.text("#before-after"))
        cells = self.browser.run("return [...document.querySelectorAll('#before-after td')].map((td) => td.textContent)")
        shown = [text for text in cells if "±" in text]
        self.assertEqual(shown, [f"{m['before']:.1f} ± {2 * m['spread']:.1f}" for m in self.data["masses"]])

    def test_the_heat_map_has_every_cell_and_frames_the_significant(self):
        maps = self.browser.run("""return [...document.querySelectorAll('#disagreement table')].map((t) =>
            [t.caption.textContent, t.querySelectorAll('td[tabindex]').length, t.querySelectorAll('.framed').length])""")
        searched = [c for c in self.data["cells"] if "p_adjusted" in c]
        for (title, cells, framed), number in zip(maps, self.data["passes"]["training"], strict=True):
            here = [c for c in searched if c["pass"] == number]
            self.assertEqual(title, f"Pass {number}")
            self.assertEqual(cells, len(here))
            self.assertEqual(framed, sum(c["p_adjusted"] <= 0.05 for c in here))
        said = {float(d["z"]) for d in self.answer["disagreement"]}
        self.assertEqual(sum(m[2] for m in maps), len(said))

    def test_arrows_walk_the_heat_map_and_each_cell_says_more(self):
        first = self.browser.driver.find_element(By.CSS_SELECTOR, "#disagreement td[tabindex='0']")
        self.browser.run("arguments[0].focus()", first)
        seen = set()
        for key in (Keys.ARROW_DOWN, Keys.ARROW_DOWN, Keys.ARROW_RIGHT, Keys.ARROW_LEFT, Keys.ARROW_UP):
            self.browser.driver.switch_to.active_element.send_keys(key)
            seen.add(self.text("#disagreement .detail"))
        self.assertGreaterEqual(len(seen), 3)
        for said in seen:
            self.assertRegex(said, r"in \w+: the mine has (less|more), by .* sd; adjusted p ")
        self.assertEqual(self.browser.run("return document.querySelectorAll('#disagreement table')[0].querySelectorAll('[tabindex=\"0\"]').length"), 1)

    def test_the_heat_map_of_the_model_with_the_effect_is_paler_and_has_the_hold_out(self):
        sizes = "return [...document.querySelectorAll('#disagreement td[tabindex]')].map((e) => parseFloat(e.style.getPropertyValue('--share')))"
        before = self.browser.run(sizes)
        self.browser.run("document.querySelector('#disagreement input[value=z_after]').click()")
        self.addCleanup(self.browser.run, "document.querySelector('#disagreement input[value=z]').click()")
        after = self.browser.run(sizes)
        self.assertLess(sum(x * x for x in after) / len(after), 0.6 * sum(x * x for x in before) / len(before))
        self.assertIn("Pass 2 (held out)", self.text("#disagreement .grids"))

    def test_ranks_every_effect(self):
        rows = self.browser.run("return [...document.querySelectorAll('#ranking tbody tr')].map((r) => r.textContent)")
        self.assertEqual(len(rows), 3)
        self.assertTrue(rows[0].startswith("Finesfines"))
        self.assertIn("%", rows[0])

    def test_draws_the_curves_and_describes_them_in_words(self):
        plots = self.browser.run("""
            return [...document.querySelectorAll('#before-after .plot')].map((p) => {
              const c = p.querySelector('canvas'), { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
              return [p.getAttribute('aria-label'), new Set(new Uint32Array(data.buffer)).size];
            });""")
        self.assertEqual(len(plots), 6)
        for said, colours in plots:
            self.assertRegex(said, r"Chart of .* force, pass \d.*kN, against time in the pass \(s\) from 0 to .*measured: least .* most ")
            self.assertGreater(colours, 20)

    def test_a_pass_can_be_picked(self):
        self.browser.run("document.querySelector('#before-after input[value=\"2\"]').click()")
        self.addCleanup(self.browser.run, "document.querySelector('#before-after input[value=all]').click()")
        shown = self.browser.run("return [...document.querySelectorAll('#before-after .curve')].filter((f) => f.offsetHeight).map((f) => f.id)")
        self.assertEqual(sorted(shown), ["curve-crowd_force_kN-2", "curve-hoist_force_kN-2"])
        self.browser.run("location.hash = 'curve-hoist_force_kN-1'")
        self.browser.drawn()
        self.assertTrue(self.browser.run("return document.getElementById('curve-hoist_force_kN-1').offsetHeight > 0"), "a link's curve stays hidden")

    def test_every_picture_has_words(self):
        bare = self.browser.run("""return [...document.querySelectorAll('svg, canvas, img, [role=img]')]
            .filter((e) => !e.closest('[aria-hidden=true]') && !e.closest('[aria-label]') && !e.alt).map((e) => e.outerHTML.slice(0, 80))""")
        self.assertEqual(bare, [])

    def test_is_dark_where_the_system_is_and_readable(self):
        ratio = """
            const lum = (text) => { const c = text.match(/[\\d.]+/g).slice(0, 3).map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
              return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
            const of = (e) => getComputedStyle(e), back = lum(of(document.documentElement).backgroundColor);
            const contrast = (e) => { const l = lum(of(e).color); return (Math.max(l, back) + 0.05) / (Math.min(l, back) + 0.05); };
            return [back, ...['h1', '.lead', '.note, .unit', '.eyebrow'].map((s) => contrast(document.querySelector(s)))];"""
        light = self.browser.run(ratio)
        before = self.ink()
        self.media(prefers_color_scheme="dark")
        self.browser.drawn()
        dark = self.browser.run(ratio)
        self.assertLess(dark[0], 0.05)
        self.assertGreater(light[0], 0.9)
        for contrast in light[1:] + dark[1:]:
            self.assertGreater(contrast, 4.5)
        self.assertNotEqual(self.ink(), before, "the curves kept the colours of the light page")

    def ink(self):
        """The measured dots' colour, as the canvas has most of it."""
        return self.browser.run("""
            const c = document.querySelector('#before-after canvas'), { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
            const count = new Map();
            for (const p of new Uint32Array(data.buffer)) if (p >>> 24 === 255) count.set(p, (count.get(p) ?? 0) + 1);
            return [...count].sort((a, b) => b[1] - a[1]).slice(0, 4).map(([p]) => p);""")

    def test_prints_in_the_light_on_few_sheets(self):
        self.media(prefers_color_scheme="dark")
        self.browser.run("""window.printed = null;
            addEventListener('afterprint', () => { window.left = document.documentElement.className; }, { once: true });
            addEventListener('beforeprint', () => { window.printed = document.documentElement.className;
              window.widths = [...document.querySelectorAll('#before-after .uplot canvas')].map((c) => c.width / devicePixelRatio); }, { once: true });""")
        pdf = self.browser.driver.execute_cdp_cmd("Page.printToPDF", {"printBackground": True})["data"]
        self.assertEqual(self.browser.run("return window.printed"), "paper")
        self.assertEqual(self.browser.run("return window.left"), "")
        pages = len(re.findall(rb"/Type\s*/Page\b", base64.b64decode(pdf)))
        self.assertTrue(2 <= pages <= 9, pages)
        self.assertEqual(set(self.browser.run("return window.widths")), {340}, "a column's width, or what they say shrinks")

    def test_asks_for_nothing_over_the_network(self):
        outside = self.browser.run("return performance.getEntriesByType('resource').map((e) => e.name).filter((n) => !/^(data|blob):/.test(n))")
        self.assertEqual(outside, [])
        self.assertLess(self.file.stat().st_size, 300_000)

    def test_fits_a_phone(self):
        with Browser(360, 740, phone=True) as phone:
            phone.open(self.file)
            phone.drawn()
            self.assertLessEqual(phone.run("return document.documentElement.scrollWidth"), 360)
            wide = phone.run("""return [...document.querySelectorAll('main *')]
                .filter((e) => e.getBoundingClientRect().right > 361 && !e.closest('.table, .plot')).map((e) => e.className || e.tagName)""")
            self.assertEqual(wide, [])
            right = phone.run("return Math.max(...[...document.querySelectorAll('#disagreement td')].map((e) => e.getBoundingClientRect().right))")
            self.assertLessEqual(right, 360, "a phase that is out of sight")
            small = phone.run("return [...document.querySelectorAll('.choice label')].filter((e) => e.getBoundingClientRect().height < 40).map((e) => e.textContent)")
            self.assertEqual(small, [], "too small for a thumb")


class Stored(unittest.TestCase):
    def test_a_verdict_alone_gives_a_page(self):
        """Every kind of verdict of the blind test: gap.json and nothing else."""
        first = {}
        for file in sorted(STORED.glob("*/gap.json")):
            answer = json.loads(file.read_text())
            first.setdefault(answer["verdict"], answer)
        self.assertGreaterEqual(set(first), {"named", "unknown", "no-gap"})
        with tempfile.TemporaryDirectory(prefix="dipper-gap-page-") as folder, Browser() as browser:
            for verdict, answer in first.items():
                file = pathlib.Path(folder) / f"{verdict}.html"
                made = dipper_page(json.dumps({"kind": "gap", "title": verdict, "answer": answer}), file)
                self.assertEqual(made.returncode, 0, made.stderr)
                browser.open(file)
                self.assertEqual(browser.run("return document.querySelectorAll('[role=alert]').length"), len(set(answer.get("warnings", []))))
                self.assertTrue(browser.run("return document.querySelector('.verdict').classList.contains(arguments[0])", verdict))
                twice = browser.run("""return [...document.querySelectorAll('th small')]
                    .filter((e) => e.previousSibling?.textContent === e.textContent).map((e) => e.textContent)""")
                self.assertEqual(twice, [], "a gap.json has no titles: a name beside itself")
                self.assertEqual(browser.errors(), [])

    def test_names_once_second_not_rejected_and_closure_capped(self):
        answer = json.loads((STORED / "m30/gap.json").read_text())
        self.assertGreater(answer["gap"]["holdout_closure"], 1)
        second = answer["rejected"][0]["effect"]
        answer["second"] = {"verdict": "named", "effect": second, "probability": 0.99,
                            "parameter": {"name": "x", "unit": "m", "estimate": 1.0, "interval90": [0.5, 1.5]}}
        with tempfile.TemporaryDirectory(prefix="dipper-gap-page-") as folder, Browser() as browser:
            file = pathlib.Path(folder) / "page.html"
            made = dipper_page(json.dumps({"kind": "gap", "title": "m30", "answer": answer}), file)
            self.assertEqual(made.returncode, 0, made.stderr)
            browser.open(file)
            rows = browser.run("return [...document.querySelectorAll('#rejected tbody th')].map((e) => e.textContent)")
            self.assertEqual(rows, [r["effect"] for r in answer["rejected"] if r["effect"] != second])
            self.assertIn(second, browser.run("return document.querySelector('.verdict').textContent"))
            closed = browser.run("return [...document.querySelectorAll('.figures dd')].map((e) => e.firstChild.textContent)")
            self.assertIn("100 %", closed)
            self.assertFalse([value for value in closed if re.fullmatch(r"\d{3,} %", value) and value != "100 %"])

    def test_tables_fit_a_phone(self):
        answer = json.loads((STORED / "m30/gap.json").read_text())
        with tempfile.TemporaryDirectory(prefix="dipper-gap-page-") as folder, Browser(390, 844, phone=True) as phone:
            file = pathlib.Path(folder) / "page.html"
            made = dipper_page(json.dumps({"kind": "gap", "title": "m30", "answer": answer}), file)
            self.assertEqual(made.returncode, 0, made.stderr)
            phone.open(file)
            phone.drawn()
            cut = phone.run("""return [...document.querySelectorAll('.table')]
                .filter((e) => e.scrollWidth > e.clientWidth).map((e) => e.textContent.slice(0, 40))""")
            self.assertEqual(cut, [], "columns out of sight")


class Refused(unittest.TestCase):
    def test_what_is_no_page_ends_with_2_and_writes_nothing(self):
        with tempfile.TemporaryDirectory(prefix="dipper-gap-page-") as folder:
            file = pathlib.Path(folder) / "page.html"
            for data, why in (("{", "not JSON"), ('{"title": "x"}', "kind"), ('{"kind": "weather", "title": "x"}', "gap, run")):
                made = dipper_page(data, file)
                self.assertEqual(made.returncode, 2)
                self.assertIn(why, made.stderr)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])


if __name__ == "__main__":
    unittest.main()
