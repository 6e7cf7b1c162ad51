#!/usr/bin/env python3
"""The page of taut export --web in a real browser, from a file: what it shows, what it does, what it asks for.

web_page_test.py PROGRAM: its vertices are where taut has the points and its picture is the one that taut draws, at more
keys than graphics cards have room for; keys and buttons do what they say; nothing comes from outside; what cannot be
written is refused and leaves nothing.
"""
import json
import os
import pathlib
import sys
import tempfile
import time

import numpy
from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from exporting import CUT, done, expect, refused, scene

SCENE = scene("eye = [0.5, 1.2, 3.5]\ntarget = [0.5, 0.9, 0.0]", fps=600, height=1.6, rope=0.5,
              head='title = "A flag & a <ball>"',
              finish='finish = { pattern = "tartan", colour = "#b3122a", accent = "#2d1a4a", '
                     'back_colour = "#cbb791", repeat_m = 0.3, weave = 0.5, sheen = 0.3 }')
LAST = 299  # of 300 keys; WebGL promises room for 256
SHADED = 160  # a frame to look at


def browser():
    options = webdriver.ChromeOptions()
    for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=500,400", "--use-gl=angle",
                 "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--force-prefers-reduced-motion"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options)


def until(condition, what):
    for _ in range(200):
        if condition():
            return
        time.sleep(0.05)
    expect(False, what)


def pixels(path):
    """(rows, columns, 3)"""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)[::-1, :, :3].astype(int)


def picture(driver):
    """The canvas once it is drawn."""
    driver.execute_async_script("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done));")
    path = pathlib.Path("canvas.png")
    path.write_bytes(driver.find_element(By.ID, "picture").screenshot_as_png)
    return pixels(path)


def has_the_motion(driver):
    points = numpy.load("small.npz")
    x = points["cloth.flag.x"]

    def there(frame):
        driver.execute_script("taut.seek(arguments[0])", frame)
        return numpy.array(driver.execute_script("return taut.positions('cloth_flag')")).reshape(-1, 3)

    order = numpy.argmin(((x[0][:, None] - there(0)[None]) ** 2).sum(axis=2), axis=1)
    for frame in (0, 100, LAST, 7):
        off = numpy.abs(there(frame)[order] - x[frame]).max() / numpy.abs(x[frame]).max()
        # Half of a step: a vertex has moved by 32767 of them at most, and by no more than the largest coordinate.
        expect(off < 2e-5, "the flag of frame %d is off by %g" % (frame, off))
    ball = numpy.array(driver.execute_script("return taut.positions('collider_ball')")).reshape(-1, 3)
    expect(abs(ball[:, 0].max() - (0.2 + 7 / 300)) < 1e-5, "the ball rolls: %s" % ball.max(axis=0))
    # Between two keys everything moves evenly.
    driver.execute_script("const time = document.getElementById('time'); time.value = 41.5 / 600;"
                          "time.dispatchEvent(new Event('input'));")
    half = numpy.array(driver.execute_script("return taut.positions('cloth_flag')")).reshape(-1, 3)[order]
    expect(numpy.abs(half - (x[41] + x[42]) / 2).max() < 3e-5, "half way between two keys")


def looks_like_taut(driver):
    driver.execute_script("for (const s of ['header', '#controls']) document.querySelector(s).style.opacity = 0;"
                          "taut.seek(arguments[0])", SHADED)
    seen = picture(driver)
    rows, columns, _ = seen.shape
    done("render", "small.toml", "-y", "--frames", SHADED, "-o", "own_#.png", "--size", "%dx%d" % (columns, rows))
    own = pixels(next(pathlib.Path(".").glob("own_*.png")))
    # Edges, noise, and sky that what stands on the ground hides from it: 0.3. Front and back swapped are 2.
    off = numpy.abs(seen - own).mean()
    expect(off < 0.7, "the picture is taut's own but for %g of 255" % off)
    expect(seen.std() > 20, "there is something to be seen")
    driver.execute_script("taut.seek(0)")
    expect(numpy.abs(picture(driver) - seen).mean() > 1, "another time looks different")
    driver.execute_script("for (const s of ['header', '#controls']) document.querySelector(s).style.opacity = 1;")


def does_what_it_says(driver):
    def clock():
        return float(driver.find_element(By.ID, "time").get_attribute("value"))

    def label():
        return driver.find_element(By.ID, "play").get_attribute("aria-label")

    expect(driver.title == "A flag & a <ball>" and driver.find_element(By.TAG_NAME, "h1").text == driver.title, "title")
    expect(driver.find_element(By.CSS_SELECTOR, "header p").text == "small", "the scene's name")
    body = driver.find_element(By.TAG_NAME, "body")
    driver.execute_script("taut.seek(10)")
    body.send_keys(Keys.ARROW_RIGHT)
    expect(abs(clock() - 11 / 600) < 1e-6, "an arrow is a frame: %s" % clock())
    body.send_keys(Keys.END)
    expect(abs(clock() - LAST / 600) < 1e-6, "End is the last")
    body.send_keys(Keys.HOME)
    driver.find_element(By.CSS_SELECTOR, "#speed option").click()
    expect(clock() == 0 and label() == "Play", "it waits where motion is not wanted")
    driver.find_element(By.ID, "picture").send_keys(Keys.SPACE)
    until(lambda: 0 < clock() < 0.4, "space plays")
    expect(label() == "Pause", "and the button pauses")
    driver.find_element(By.ID, "play").click()
    still = clock()
    before = picture(driver)
    expect(clock() == still and label() == "Play", "which it does")
    canvas = driver.find_element(By.ID, "picture")
    ActionChains(driver).move_to_element(canvas).click_and_hold().move_by_offset(80, 20).release().perform()
    turned = picture(driver)
    expect(numpy.abs(turned - before).mean() > 1, "the mouse turns it")
    driver.find_element(By.ID, "reset").click()
    expect(numpy.abs(picture(driver) - before).mean() < 1, "and the button turns it back")


def has_a_drawer_on_a_phone(driver):
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": 390, "height": 780, "deviceScaleFactor": 1, "mobile": True})
    shown, controls = (driver.find_element(By.ID, name).rect for name in ("picture", "controls"))
    expect(abs(shown["y"] + shown["height"] - controls["y"]) < 1 and shown["height"] > 500, "controls below the picture")
    expect(driver.find_element(By.ID, "reset").is_displayed(), "Reset view stays")
    until(lambda: driver.execute_script("const c = document.getElementById('picture');"
                                        "return c.height === c.clientHeight;"), "the picture has its pixels")
    looks_like_taut(driver)
    driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def asks_for_nothing(driver):
    requests = []
    for line in driver.get_log("performance"):
        message = json.loads(line["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            requests.append(message["params"]["request"]["url"])
    expect([url.split("/")[-1] for url in requests] == ["small.html"], "only the page is loaded: %s" % requests)
    expect(driver.get_log("browser") == [], "nothing is complained of")


def main():
    pathlib.Path("small.toml").write_text(SCENE, encoding="utf-8")
    done("export", "small.toml", "--web", "small.html", "-o", "small.glb", "--points", "small.npz")
    driver = browser()
    try:
        driver.get(pathlib.Path("small.html").resolve().as_uri())
        until(lambda: driver.execute_script("return !!window.taut"), "the page is there")
        has_the_motion(driver)
        looks_like_taut(driver)
        does_what_it_says(driver)
        has_a_drawer_on_a_phone(driver)
        asks_for_nothing(driver)
        driver.execute_script("HTMLCanvasElement.prototype.getContext = () => null; startPage();")
        expect("WebGL" in driver.find_element(By.ID, "message").text, "a browser without WebGL is told so")
    finally:
        driver.quit()

    refused(2, [".html"], "small.toml", "--web", "new.pdf")
    refused(2, ["--web new.html"], "small.toml", "-o", "new.html")
    refused(2, ["--web"], "small.toml", "-o", "new.glb", "--viewer", ".")
    refused(2, ["normals"], "small.toml", "--web", "new.html", "--no-normals")
    refused(6, ["three.min.js", "libjs-three"], "small.toml", "--web", "new.html", "--viewer", ".")
    refused(6, ["three.min.js", "libjs-three"], "small.toml", "--web", "new.html", env={**os.environ, "TAUT_THREE": "."})
    refused(6, ["small.html", "-y"], "small.toml", "--web", "small.html")
    # The cut is made when tick 12 is over, and shows at frame 5, which is tick 15.
    pathlib.Path("torn.toml").write_text(SCENE + CUT, encoding="utf-8")
    refused(3, ["new.html: cloth.flag", "tick 13 ", ".usda", "--frames 0-4"], "torn.toml", "--web", "new.html", "--fps", "20",
            "-o", "new.usda")


if __name__ == "__main__":
    sys.argv[1] = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            main()
        finally:
            os.chdir("/")
