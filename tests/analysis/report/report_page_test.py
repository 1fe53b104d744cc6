"""The report's page in headless Chromium: it draws, plays, obeys the keyboard, fits a phone.

MAKE_PAGE names the program that writes a page of a synthetic dig. Needs chromium, chromium-driver,
python3-selenium, python3-pil.
"""
import io
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

from PIL import Image
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import Browser

MEGABYTE = 1e6


def make_page(folder, spheres, frames, seconds):
    file = pathlib.Path(folder) / f"{spheres}.html"
    subprocess.run([os.environ["MAKE_PAGE"], file, str(spheres), str(frames), str(seconds)], check=True)
    return file


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="dipper-report-")
        cls.page = make_page(cls.folder.name, 3000, 41, 10)
        cls.browser = Browser()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.addClassCleanup(cls.browser.__exit__)
        cls.browser.open(cls.page)

    def setUp(self):
        self.browser.run("dipper.clock.pause(); dipper.clock.set(4); document.activeElement.blur();"
                         "window.scrollTo(0, 0)")

    def tearDown(self):
        self.assertEqual(self.browser.errors(), [])

    def picture(self):
        self.browser.drawn()
        canvas = self.browser.driver.find_element(By.CSS_SELECTOR, ".screen canvas")
        return Image.open(io.BytesIO(canvas.screenshot_as_png)).convert("RGB")

    def press(self, *keys):
        body = self.browser.driver.switch_to.active_element
        body.send_keys(*keys)

    def time(self):
        return self.browser.run("return dipper.clock.time")

    def test_draws_the_rocks(self):
        self.browser.run("dipper.clock.set(0)")
        at_rest = self.picture()
        self.assertGreater(len(set(at_rest.getdata())), 200, "no shaded spheres: the canvas is blank or flat")
        # The dipper is inside the pile: cut it open. What it carries moves.
        cut = self.browser.driver.find_element(By.XPATH, "//label[contains(., 'Cut')]/input")
        cut.click()
        self.addCleanup(cut.click)
        self.browser.run("dipper.clock.set(4)")
        # What moves is ochre to violet, with little green; rest, ground and walls are nearly grey.
        moving = lambda image: sum(max(r, b) - g > 25 for r, g, b in image.getdata())
        self.assertEqual(moving(at_rest), 0)
        self.assertGreater(moving(self.picture()), 500)

    def test_colours_by_speed_size_and_class(self):
        pictures = []
        for value in ("speed", "size", "class"):
            self.browser.run(f"document.querySelector('input[value={value}]').click()")
            pictures.append(self.picture().tobytes())
        self.browser.run("document.querySelector('input[value=speed]').click()")
        self.assertEqual(len(set(pictures)), 3)

    def test_size_is_that_of_the_whole_rock(self):
        # synthetic_dig.hpp: every third sphere is a rock by itself, the others are of clumps; make_page.cpp knows the
        # size of class 2.
        wrong = self.browser.run("""
            const { model } = dipper, { radius_m: r, rock, type } = model.replay, sizes = model.rockSizes();
            const near = (a, b) => Math.abs(a - b) < 1e-9;
            return sizes.filter((size, i) => !(rock[i] < 0 ? near(size, 2 * r[i]) : type[i] === 2 ? size === 1.25 : size > 2.0001 * r[i] || rock.filter((k) => k === rock[i]).length === 1)).length;""")
        self.assertEqual(wrong, 0)
        for value, said in (("size", r"rock size"), ("class", r"d200, 1\.3 m")):
            self.browser.run(f"document.querySelector('input[value={value}]').click()")
            self.assertRegex(self.browser.run("return document.querySelector('.legend').textContent"), said)
        self.browser.run("document.querySelector('input[value=speed]').click()")

    def test_shows_the_machine_at_work(self):
        """make_page.cpp: a house that stands, a handle that goes with the dipper, a rope between them."""
        places = """
            const { figure, dipper: bucket } = document.querySelector('.screen canvas').stage, [rope] = figure.ropes;
            const { array } = rope.geometry.attributes.position, end = [...array.slice(-18)];
            const mean = [0, 1, 2].map((k) => end.filter((_v, i) => i % 3 === k).reduce((a, b) => a + b) / 6);
            return [...figure.bodies.map((body) => body.position.toArray()), bucket.position.toArray(), mean];"""
        self.browser.drawn()
        house, handle, bucket, end = self.browser.run(places)
        self.assertEqual(house, [0, 0, 0])
        for place in (handle, end):
            for a, b in zip(place, bucket):
                self.assertAlmostEqual(a, b, places=2)
        self.browser.run("dipper.clock.set(9)")
        self.browser.drawn()
        self.assertGreater(self.browser.run(places)[1][0], handle[0] + 9)
        shown = self.picture()
        hide = self.browser.driver.find_element(By.XPATH, "//label[contains(., 'Hide the shovel')]/input")
        hide.click()
        self.addCleanup(hide.click)
        self.assertNotEqual(shown.tobytes(), self.picture().tobytes())

    def test_colours_the_walls_by_what_presses_them(self):
        # synthetic_dig.hpp: the dipper's k-th triangle of 12 is pressed with k t, at most with 11 * 10.
        hide = self.browser.driver.find_element(By.XPATH, "//label[contains(., 'Hide the rock')]/input")
        with_rock = self.picture()
        hide.click()  # the dipper is inside the pile
        self.addCleanup(hide.click)
        plain = self.picture()
        self.assertTrue(with_rock.tobytes() != plain.tobytes(), "the rock is still there")
        self.browser.run("document.querySelector('input[value=normal_stress_average]').click()")
        self.addCleanup(self.browser.run, "document.querySelector('.walls input').click()")
        warm = lambda image: sum(r - g > 30 for r, g, b in image.getdata())
        self.assertEqual(warm(plain), 0)
        self.assertGreater(warm(self.picture()), 500)
        bytes_, tones, door = self.browser.run("""
            const { walls } = document.querySelector('.screen canvas').stage, [dipper, door] = walls;
            const { array } = dipper.sheet.geometry.attributes.color;
            return [[...dipper.values(16)], [...array], door.sheet.material.vertexColors];""")
        pressure = [0 if b == 0 else 110 * 10 ** (5 * ((b - 1) / 254 - 1)) for b in bytes_]
        for k, p in enumerate(pressure):
            self.assertAlmostEqual(p, 4 * k, delta=0.025 * 4 * k)  # half of 1/254 of five decades
        self.assertFalse(door)
        self.assertEqual(len(tones), 12 * 9)
        light = [sum(tones[9 * k:9 * k + 3]) for k in range(12)]
        self.assertEqual(light[1:], sorted(light[1:], reverse=True), "harder pressed is not darker")
        self.browser.run("dipper.clock.set(10)")
        self.browser.drawn()
        later = self.browser.run("return document.querySelector('.screen canvas').stage.walls[0].sheet.geometry.attributes.color.array[99]")
        self.assertNotAlmostEqual(later, tones[99], places=3)

    def test_decodes_every_frame(self):
        # Rock at rest lies on a grid (synthetic_dig.hpp): off it by no more than the encoder's 2 mm
        # and the rock's own 0.1 mm. Were one change lost, it would be off in every later frame.
        worst, resting = self.browser.run("""
            const { frames, model } = dipper, { origin_m: o, step_m: s, spheres: n } = model.replay;
            const pitch = 16 / Math.ceil(Math.cbrt(n));
            let worst = 0, resting = 0;
            for (let f = 0; f < frames.times.length; ++f) {
              for (let i = 0; i < n; ++i) {
                if (frames.speeds[f][i] !== 0) continue;
                ++resting;
                const p = [0, 1, 2].map((k) => o[k] + s[k] * frames.steps[f][3 * i + k]);
                const cells = [(p[0] - 4) / pitch, (p[1] + 8) / pitch, p[2] / pitch - 0.5];
                for (const c of cells) worst = Math.max(worst, pitch * Math.abs(c - Math.round(c)));
              }
            }
            return [worst, resting];""")
        self.assertGreater(resting, 41 * 2000)
        self.assertLess(worst, 2.2e-3)

    def test_space_plays_and_pauses(self):
        before, start = self.picture().tobytes(), self.time()
        self.press(Keys.SPACE)
        deadline = time.monotonic() + 20
        while self.time() < start + 0.5 and time.monotonic() < deadline:
            time.sleep(0.05)
        self.press(Keys.SPACE)
        stopped = self.time()
        self.assertGreaterEqual(stopped, start + 0.5)
        self.assertTrue(self.picture().tobytes() != before, "the picture stands still")
        time.sleep(0.3)
        self.assertEqual(self.time(), stopped)

    def test_arrows_step_frames_and_with_shift_seconds(self):
        self.press(Keys.ARROW_RIGHT)
        self.assertAlmostEqual(self.time(), 4.25)
        self.press(Keys.ARROW_LEFT, Keys.ARROW_LEFT)
        self.assertAlmostEqual(self.time(), 3.75)
        self.browser.run("dipper.clock.set(3.8)")
        self.press(Keys.ARROW_LEFT)
        self.assertAlmostEqual(self.time(), 3.75)
        self.press(Keys.SHIFT + Keys.ARROW_RIGHT)
        self.assertAlmostEqual(self.time(), 4.75)

    def test_tab_reaches_the_controls_in_their_order_and_shows_where_it_is(self):
        wanted = ["CANVAS", "Play", "Time", "Speed", "Colour by", "Dig", "Follow", "Above", "All"]
        seen = []
        self.browser.run("const title = document.querySelector('h1'); title.tabIndex = -1; title.focus()")
        for _ in range(12):
            self.press(Keys.TAB)
            name, outline = self.browser.run("""
                const e = document.activeElement, drawn = e.matches('.choice input') ? e.nextElementSibling : e;
                const name = e.tagName === 'CANVAS' ? 'CANVAS' : e.closest('fieldset')?.querySelector('legend').textContent
                    ?? e.getAttribute('aria-label') ?? e.textContent.slice(0, 40);
                return [name, getComputedStyle(drawn).outlineStyle];""")
            self.assertNotEqual(outline, "none", name)
            seen.append(name)
        self.assertEqual([name for name in seen if name in wanted], wanted)

    def test_scrubbing_and_curves_set_the_time(self):
        self.browser.run("const s = document.querySelector('.scrub'); s.value = 7; s.dispatchEvent(new Event('input'))")
        self.assertAlmostEqual(self.time(), 7, places=3)
        plot = self.browser.driver.find_element(By.CSS_SELECTOR, "#signals .u-over")
        self.browser.run("arguments[0].scrollIntoView({block: 'center'})", plot)
        plot.click()  # in its middle
        self.assertAlmostEqual(self.time(), 5, delta=0.1)

    def test_curves_are_drawn(self):
        inked = self.browser.run("""
            return [...document.querySelectorAll('.plot canvas')].map((c) => {
              const { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
              return new Set(new Uint32Array(data.buffer)).size;
            });""")
        self.assertGreaterEqual(len(inked), 2)
        for colours in inked:
            self.assertGreater(colours, 20)

    def test_what_the_dipper_weighs_is_no_dig_force(self):
        # make_page.cpp: it meets the rock at 3 s of 10, one second into the phase
        weighed, drawn = self.browser.run("""
            const force = dipper.model.digForce(), time = dipper.model.curves.time_s;
            return [force.filter((f, k) => time[k] < 2.99 && f !== null).length, force.filter((f, k) => time[k] > 3.01 && f > 0).length];""")
        self.assertEqual(weighed, 0)
        self.assertGreater(drawn, 1000)
        read = "return document.querySelector('.readout').textContent"
        self.assertRegex(self.browser.run(read), r"^fill.*\d MN dig force")
        self.browser.run("dipper.clock.set(1)")
        self.assertRegex(self.browser.run(read), r"^reach.* t in the dipper$")

    def test_charts_are_described_in_words(self):
        said = self.browser.run("return [...document.querySelectorAll('#signals .plot')].map((e) => e.getAttribute('aria-label'))")
        self.assertRegex(said[0], r"^Chart of Force, MN, against time \(s\) from 0 to 10.* dig force: least .* at .*, most .* at .*; hoist: ")
        bare = self.browser.run("""return [...document.querySelectorAll('svg, canvas, img, [role=img]')]
            .filter((e) => !e.closest('[aria-hidden=true]') && !e.closest('[aria-label]') && !e.alt).map((e) => e.outerHTML.slice(0, 80))""")
        self.assertEqual(bare, [])

    def test_the_view_taken_is_pressed_until_the_camera_is_turned(self):
        pressed = "return [...document.querySelectorAll('[aria-pressed=true]')].map((e) => e.textContent)"
        self.assertEqual(self.browser.run(pressed), ["Dig"])
        self.browser.driver.find_element(By.XPATH, "//button[.='Above']").click()
        self.assertEqual(self.browser.run(pressed), ["Above"])
        canvas = self.browser.driver.find_element(By.CSS_SELECTOR, ".screen canvas")
        ActionChains(self.browser.driver).move_to_element(canvas).click_and_hold().move_by_offset(40, 0).release().perform()
        self.assertEqual(self.browser.run(pressed), [])
        self.browser.driver.find_element(By.XPATH, "//button[.='Dig']").click()
        self.assertEqual(self.browser.run(pressed), ["Dig"])

    def test_dark_where_the_system_is_and_light_on_paper(self):
        driver = self.browser.driver
        sky = lambda: self.picture().getpixel((5, 60))
        painted = lambda: self.browser.run("return document.querySelector('#signals canvas').toDataURL()")
        light = sum(sky()), painted()
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        self.addCleanup(driver.execute_cdp_cmd, "Emulation.setEmulatedMedia", {"features": []})
        dark = sum(sky()), painted()
        self.assertLess(dark[0], 0.6 * light[0])
        self.assertNotEqual(dark[1], light[1])
        paper = self.browser.run("dispatchEvent(new Event('beforeprint')); return getComputedStyle(document.documentElement).backgroundColor")
        self.assertEqual(paper, "rgb(251, 250, 247)")
        self.assertTrue(self.browser.run("return document.querySelector('.still').src.length > 5000"), "the picture of the dig is not printed")
        self.browser.run("dispatchEvent(new Event('afterprint'))")

    def test_says_which_phases_are_missing(self):
        # make_page.cpp's phases are none of the seven
        said = self.browser.run("return document.querySelector('#signals .missing').textContent")
        self.assertIn("penetrate, breakout", said)
        self.assertIn("The motion ends before the dipper swings back", said)

    def test_slices_show_spheres_and_walls(self):
        circles, paths = self.browser.run("""
            const all = [...document.querySelectorAll('.slice svg')];
            return [all.map((s) => s.querySelectorAll('circle').length), all.map((s) => s.querySelector('path').getAttribute('d').length)];""")
        self.assertEqual(len(circles), 2)
        self.assertGreater(min(circles), 10)
        self.assertGreater(min(paths), 50)

    def test_asks_for_nothing_over_the_network(self):
        outside = self.browser.run("return performance.getEntriesByType('resource').map((e) => e.name).filter((n) => !/^(data|blob):/.test(n))")
        self.assertEqual(outside, [])

    def test_passes_are_unfolded_on_a_wide_screen(self):
        self.assertEqual(set(self.browser.run("return [...document.querySelectorAll('details.pass')].map((e) => e.open)")), {True})

    def test_less_motion_where_the_reader_wants_less(self):
        driver = self.browser.driver
        moving = "return [...document.querySelectorAll('*')].filter((e) => parseFloat(getComputedStyle(e).transitionDuration) > 0).length"
        self.assertGreater(self.browser.run(moving), 0)
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]})
        self.addCleanup(driver.execute_cdp_cmd, "Emulation.setEmulatedMedia", {"features": []})
        self.assertEqual(self.browser.run(moving), 0)
        self.assertFalse(self.browser.run("return dipper.clock.playing"), "it plays before it is asked to")


class Phone(unittest.TestCase):
    def test_fits_a_phone(self):
        with tempfile.TemporaryDirectory(prefix="dipper-report-") as folder, Browser(360, 740, phone=True) as browser:
            browser.open(make_page(folder, 800, 9, 4))
            browser.drawn()
            self.assertEqual(browser.run("return innerWidth"), 360)
            self.assertLessEqual(browser.run("return document.documentElement.scrollWidth"), 360)
            wide = browser.run("""return [...document.querySelectorAll('main *')]
                .filter((e) => e.getBoundingClientRect().right > 361 && !e.closest('.table, .plot, svg')).map((e) => e.className || e.tagName)""")
            self.assertEqual(wide, [])
            small = browser.run("""return [...document.querySelectorAll('.replay button, .choice label')]
                .filter((e) => e.getBoundingClientRect().height < 40).map((e) => e.textContent)""")
            self.assertEqual(small, [], "too small for a thumb")
            names = browser.run("return [...document.querySelectorAll('#headline td')].map((e) => e.dataset.name)")
            self.assertIn("Dig force, peak (MN)", names, "a name that stands alone")
            head = browser.run("return document.querySelector('header').textContent")
            self.assertIn("each pass planned by the operator", head)
            passes = "return [...document.querySelectorAll('details.pass')].map((e) => e.open)"
            self.assertEqual(set(browser.run(passes)), {False}, "a pass is unfolded by a tap")
            self.assertEqual(browser.errors(), [])


class Size(unittest.TestCase):
    def test_three_minutes_of_20000_spheres_stay_under_25_megabytes(self):
        with tempfile.TemporaryDirectory(prefix="dipper-report-") as folder:
            page = make_page(folder, 20000, 720, 180)
            self.assertLess(page.stat().st_size, 25 * MEGABYTE)


if __name__ == "__main__":
    unittest.main()
