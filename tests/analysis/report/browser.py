"""Headless Chromium with an empty profile and software WebGL, driven through chromedriver."""
import shutil
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.service import Service


class Browser:
    """Closes, and removes its profile, at the end of a `with`."""

    def __init__(self, width=1280, height=900, phone=False):
        self.profile = tempfile.mkdtemp(prefix="dipper-chromium-")
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle",
                     "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking",
                     "--disable-component-update", "--disable-sync", f"--window-size={width},{height}",
                     f"--user-data-dir={self.profile}"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        if phone:
            options.add_experimental_option(
                "mobileEmulation", {"deviceMetrics": {"width": width, "height": height, "pixelRatio": 2}})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.driver.set_script_timeout(60)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()
        shutil.rmtree(self.profile, ignore_errors=True)

    def open(self, file, offline=True):
        """Opens a report and waits until its replay is unpacked."""
        if offline:
            self.driver.execute_cdp_cmd("Network.enable", {})
            self.driver.execute_cdp_cmd("Network.emulateNetworkConditions", {
                "offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})
        self.driver.get(f"file://{file}")
        self.run_async("""
            const done = arguments[arguments.length - 1];
            const wait = () => {
                const d = window.dipper;
                if (d && (!d.frames || d.frames.ready === d.clock.times.length)) done(true);
                else setTimeout(wait, 50);
            };
            wait();""")

    def run(self, script, *words):
        return self.driver.execute_script(script, *words)

    def run_async(self, script, *words):
        return self.driver.execute_async_script(script, *words)

    def drawn(self):
        """Waits until the next two pictures have been painted."""
        self.run_async("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 50)))")

    def errors(self):
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]
