#!/usr/bin/python3
"""A picture of a part of a page, as docs/ has them: picture.py FILE.html SELECTOR OUT.png [phone] [time_s]

SELECTOR is a CSS selector: the part from the first that it matches to the last. With a time the replay stands there.
"""
import base64
import pathlib
import sys

from browser import Browser

MARGIN = 14  # px


def main(file, selector, out, *words):
    phone = "phone" in words
    with Browser(390 if phone else 1180, 844 if phone else 900, phone=phone) as browser:
        browser.open(pathlib.Path(file).resolve())
        for time in (w for w in words if w != "phone"):
            browser.run("dipper.clock.set(arguments[0])", float(time))
        browser.drawn()
        box = """
            const all = [...document.querySelectorAll(arguments[0])].map((e) => e.getBoundingClientRect());
            const of = (side, pick) => pick(...all.map((box) => box[side]));
            return [of('left', Math.min) + scrollX, of('top', Math.min) + scrollY, of('right', Math.max) + scrollX, of('bottom', Math.max) + scrollY];"""
        x, y, right, bottom = browser.run(box, selector)
        clip = {"x": max(x - MARGIN, 0), "y": max(y - MARGIN, 0), "width": right - x + 2 * MARGIN, "height": bottom - y + 2 * MARGIN, "scale": 1}
        made = browser.driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True, "clip": clip})
        pathlib.Path(out).write_bytes(base64.b64decode(made["data"]))


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
