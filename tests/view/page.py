"""The page of `csgrt view` in a headless browser, as tests use it. It needs selenium."""
import base64
import os
import shutil
import subprocess
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.firefox.service import Service as FirefoxService


def first_of(*programs):
    return next(filter(None, map(shutil.which, programs)), None)


BROWSER, DRIVER = first_of("chromium", "chromium-browser", "google-chrome"), shutil.which("chromedriver")
FIREFOX, GECKODRIVER = first_of("firefox-esr", "firefox"), shutil.which("geckodriver")


class Server:
    """A `csgrt view` of its own."""

    def __init__(self, csgrt, *arguments):
        self.began = time.time()
        self.process = subprocess.Popen([csgrt, "view", *arguments], stdout=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()

    def close(self):
        self.process.terminate()
        self.process.wait(20)
        self.process.stdout.close()


def new_browser(downloads, width=1024, height=1024, scale=1):
    options = webdriver.ChromeOptions()
    options.binary_location = BROWSER
    for one in ("--headless=new", "--no-sandbox", "--disable-gpu", f"--window-size={width},{height}",
                f"--force-device-scale-factor={scale}"):
        options.add_argument(one)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(DRIVER))
    driver.set_script_timeout(120)
    driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": downloads})
    return driver


def new_firefox(work):
    options = webdriver.FirefoxOptions()
    options.binary_location = FIREFOX
    for one in ("-headless", "--width=1024", "--height=1024"):
        options.add_argument(one)
    options.set_preference("browser.download.folderList", 2)
    options.set_preference("browser.download.dir", work)
    service = FirefoxService(GECKODRIVER, log_path=os.path.join(work, "geckodriver.log"))
    driver = webdriver.Firefox(options=options, service=service)
    driver.set_script_timeout(120)
    return driver


class Page:
    """What tests do with the page that a browser's window shows."""

    def __init__(self, driver, address, samples=1):
        self.driver = driver
        self.is_firefox = driver.name == "firefox"
        self.start(address, samples)

    def start(self, address, samples=1):
        self.driver.get("about:blank")  # else an address that differs after # alone would not load
        self.driver.get(address)
        self.wait(lambda: self.js("return Boolean(window.csgrt?.view)"))
        # One ray a pixel: as in a command's picture. The page may have taken more by now.
        self.js("csgrt.samples = arguments[0]; changed()", samples)
        return self.idle()

    def js(self, text, *arguments):
        if not self.is_firefox:
            return self.driver.execute_script(text, *arguments)
        # Scripts of Firefox's driver do not see the page's `let` and `const`: an element runs the text.
        return self.driver.execute_script("""
            const [text, given] = arguments, script = document.createElement("script");
            window.given = given;
            script.textContent = `window.made = (function() {${text}\n}).apply(null, window.given)`;
            document.head.append(script);
            script.remove();
            return window.made;""", text, arguments)

    def wait(self, condition, seconds=20):
        end = time.time() + seconds
        while not condition():
            if time.time() > end:
                raise AssertionError("nothing came in time")
            time.sleep(0.02)

    def idle(self, samples=1):
        self.driver.execute_async_script("csgrt.idle(arguments[0]).then(arguments[1])", samples)
        return self

    def id(self, name):
        return self.driver.find_element("id", name)

    def text(self, name):
        return self.js("return document.getElementById(arguments[0]).textContent", name)

    def press(self, name):
        self.js("document.getElementById(arguments[0]).click()", name)
        return self.idle()

    def set(self, name, value, event="input"):
        self.js("const e = document.getElementById(arguments[0]); e.focus(); e.value = arguments[1];"
                "e.dispatchEvent(new Event(arguments[2], {bubbles: true}))", name, value, event)
        return self.idle()

    def keys(self, *keys):
        for key in keys:
            chain = ActionChains(self.driver)
            (chain.key_down(Keys.SHIFT).send_keys(key[1]).key_up(Keys.SHIFT) if isinstance(key, tuple)
             else chain.send_keys(key)).perform()
        return self.idle()

    def chord(self, *keys):
        chain = ActionChains(self.driver)
        for key in keys:
            chain.key_down(key)
        for key in reversed(keys):
            chain.key_up(key)
        chain.perform()
        return self.idle()

    def view(self):
        return self.js("return csgrt.view")

    def mouse(self, kind, x, y, button="left", on="canvas", **more):
        box = self.js("const b = document.getElementById(arguments[0]).getBoundingClientRect();"
                      "return [b.left, b.top]", on)
        if self.is_firefox:
            act = ActionBuilder(self.driver, duration=0)
            pointer = act.pointer_action.move_to_location(round(box[0] + x), round(box[1] + y))
            {"mousePressed": pointer.pointer_down, "mouseReleased": pointer.pointer_up}.get(kind, lambda: None)()
            return act.perform()
        self.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {
            "type": kind, "x": box[0] + x, "y": box[1] + y, "button": button, **more})

    def drag(self, start, end, button="left", on="canvas", **more):
        buttons = {"left": 1, "middle": 4}[button]
        self.mouse("mousePressed", *start, button, on, clickCount=1, **more)
        time.sleep(0.15)  # the point under the mouse is asked for
        for i in range(1, 6):
            at = [a + (b - a) * i / 5 for a, b in zip(start, end)]
            self.mouse("mouseMoved", *at, button, on, buttons=buttons, **more)
        self.mouse("mouseReleased", *end, button, on, clickCount=1, **more)
        return self.idle()

    def click(self, x, y, times=1):
        before = self.js("return csgrt.answers.length")
        for count in range(1, times + 1):
            self.mouse("mousePressed", x, y, clickCount=count)
            self.mouse("mouseReleased", x, y, clickCount=count)
        self.wait(lambda: self.js("return csgrt.answers.length") > before)
        return self.idle()

    def screen(self, point):
        return self.js("return on_screen(csgrt.view.camera, arguments[0])", point)

    def color(self, x, y):
        return self.js("const s = csgrt.size; return [...canvas.getContext('2d').getImageData(arguments[0] * s.width / "
                       "s.css_width, arguments[1] * s.height / s.css_height, 1, 1).data].slice(0, 3)", x, y)

    def picture(self):
        return self.js("return canvas.toDataURL()")

    def difference(self, png):
        """(largest difference of a value, pixels that differ) between the canvas and a PNG's bytes or data URL."""
        url = png if isinstance(png, str) else "data:image/png;base64," + base64.b64encode(png).decode()
        return self.driver.execute_async_script("""
            const [url, done] = arguments, image = new Image();
            image.onload = () => {
              const other = document.createElement("canvas");
              const w = other.width = image.width, h = other.height = image.height;
              other.getContext("2d").drawImage(image, 0, 0);
              if (w !== canvas.width || h !== canvas.height) return done([999, w * h]);
              const [a, b] = [other, canvas].map(c => c.getContext("2d").getImageData(0, 0, w, h).data);
              let most = 0, count = 0;
              for (let i = 0; i < a.length; i++) {
                const d = Math.abs(a[i] - b[i]);
                if (d) { most = Math.max(most, d); count++; }
              }
              done([most, count]);
            };
            image.src = url;""", url)
