"""Figures of the page of `csgrt view`: screenshots for the documents, and how quick it is.

`cwebp -lossless -z 9` makes the files in docs/images of the screenshots.
"""
import math
import os
import statistics
import time

from page import Page, Server, new_browser


def take_screenshots(csgrt, root, work, folder):
    os.makedirs(folder, exist_ok=True)
    driver = new_browser(work)
    os.chdir(root)  # the page names the scene as it was given

    def shot(scene, name, act, width, height):
        server = Server(csgrt, os.path.join("scenes", scene))
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        try:
            page = Page(driver, server.address)
            act(page)
            page.js("csgrt.samples = 16")
            page.idle(16)
            time.sleep(0.5)  # the slice, too
            driver.save_screenshot(os.path.join(folder, name))
        finally:
            server.close()

    def ask(page):  # along a row of shapes; then it is seen from the side
        page.press("view-right").press("fit").click(*page.screen([-50, -3250, 150]))
        page.js("document.querySelector('#measured button').click()")
        page.js("turn(325, 28, csgrt.view.camera.center); changed()")
        page.idle().press("fit")

    def cut(page):
        page.press("view-iso").press("toggle-answer").press("toggle-cut").press("add-plane")
        page.press("cut-0-slice").press("fit")

    def overlap(page):
        page.press("toggle-parts").press("toggle-cut").press("add-plane").press("cut-0-set-x")
        page.set("cut-0-distance", "10").press("cut-0-slice").press("fit").click(*page.screen([10, 50, 50]))

    try:
        shot("operators.json", "viewer-ask.png", ask, 1600, 1000)
        shot("materials.json", "viewer-cut.png", cut, 1024, 700)
        shot("overlap.json", "viewer-overlap.png", overlap, 1024, 700)
        shot("operators.json", "viewer-narrow.png", ask, 390, 844)
    finally:
        driver.quit()


def measure(csgrt, work, model):
    """Of a picture of 1024x1024 pixels. Browser and csgrt share the machine."""
    driver = new_browser(work, 1600, 1200)
    try:
        resize_picture(csgrt, driver, model)
        first, fps, latencies, fulls, answers, divisors = [], [], [], [], [], []
        for _ in range(3):
            server = Server(csgrt, model)
            try:
                page = Page(driver, server.address, samples=64)
                first.append(page.js("return performance.timeOrigin + csgrt.first") / 1000 - server.began)
                fps.append(drag(page, 5))
                latencies += page.js("return csgrt.latencies")
                divisors.append(page.js("return loop.divisor"))
                page.js("csgrt.fulls.length = csgrt.answers.length = 0")
                for _ in range(5):
                    drag(page, 0.5, release=False)
                    time.sleep(0.8)
                fulls += page.js("return csgrt.fulls")
                page.start(server.address)
                time.sleep(1)
                for i in range(10):
                    page.click(412 + 20 * i, 512)
                answers += page.js("return csgrt.answers.slice(1)")  # the first opens the panel
            finally:
                server.close()
        median = statistics.median
        print(f"{os.path.basename(model)}: first pixels {median(first):.2f} s after the command's start; dragging "
              f"{median(fps):.0f} frames a second (1/{median(divisors):g} of the size), {median(latencies):.0f} ms "
              f"from mouse to pixels; {median(fulls):.0f} ms from rest to the full picture; {median(answers):.0f} ms "
              "from a click to its answer", flush=True)
    finally:
        driver.quit()


def resize_picture(csgrt, driver, model, side=1024):
    """Makes the window such that the page's picture has that many pixels."""
    server = Server(csgrt, model)
    width, height = 1600, 1200
    try:
        for _ in range(2):
            driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
            size = Page(driver, server.address).js("return csgrt.size")
            width, height = width + side - size["width"], height + side - size["height"]
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
    finally:
        server.close()


def drag(page, seconds, release=True):
    """Drags over the picture for a while. Returns the frames a second."""
    middle = [v / 2 for v in page.js("return [csgrt.size.css_width, csgrt.size.css_height]")]
    page.mouse("mousePressed", *middle, clickCount=1)
    time.sleep(0.3)
    box = page.js("const b = canvas.getBoundingClientRect(); csgrt.latencies.length = 0;"
                  "return [b.left, b.top, csgrt.frames]")
    began, now = time.time(), 0
    while now < seconds:
        now = time.time() - began
        at = [middle[0] + 250 * math.sin(now), middle[1] + 120 * math.sin(1.7 * now)]
        page.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {
            "type": "mouseMoved", "x": box[0] + at[0], "y": box[1] + at[1], "button": "left", "buttons": 1})
        time.sleep(0.008)
    frames = page.js("return csgrt.frames") - box[2]
    took = time.time() - began
    if release:
        page.mouse("mouseReleased", *at, clickCount=1)
        page.idle()
    return frames / took
