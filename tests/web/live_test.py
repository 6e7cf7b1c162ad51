#!/usr/bin/env python3
"""The page of taut export --live in Chromium, from a file: live_test.py PROGRAM PACKAGE. What a mouse did there is a
scenario that the program plays to the same hash; sliders, keys, method and step, the editor and its faults do what they
say; scenes are played in real time; a stranger's scene stays text; nothing is asked for or complained of."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

PROGRAM = os.path.abspath(sys.argv[1])
os.environ["TAUT_WEB"] = os.path.abspath(sys.argv[2])
SCENE = """schema = 1
title = "A sail </script><script>document.title = 'out'</script> & <b>more</b>"
[run]
fps = 60
seconds = 2.0
[cloth.sail]
size = [1.0, 0.8]
cells = [12, 10]
origin = [-0.5, 1.5, 0.0]
hold = ["top-left", "top-right"]
material = "fabric:nylon"
[wind.breeze]
velocity = [2.0, 0.0, 1.0]
[camera.main]
eye = [0.0, 1.1, 2.5]
target = [0.0, 1.1, 0.0]
"""


def done(*words):
    outcome = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    assert outcome.returncode == 0, "%s: %s" % (words, outcome.stderr)
    return outcome.stdout


def browser():
    options = webdriver.ChromeOptions()
    for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=1000,640", "--use-gl=angle",
                 "--use-angle=swiftshader", "--enable-unsafe-swiftshader"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options)


def opened(driver, page):
    driver.get(pathlib.Path(page).resolve().as_uri())
    wait(driver, "return window.taut && taut.session && taut.session.tick > 3", "the page plays")


def wait(driver, condition, what, seconds=20):
    end = time.time() + seconds
    while time.time() < end:
        if driver.execute_script(condition):
            return
        time.sleep(0.05)
    raise AssertionError("%s: %s" % (what, driver.execute_script(
        "return document.getElementById('fault').textContent + document.getElementById('message').textContent")))


def text(driver, name):
    return driver.find_element(By.ID, name).text


def keeps_what_a_hand_did(driver):
    canvas = driver.find_element(By.ID, "picture")
    ActionChains(driver).move_to_element(canvas).click_and_hold().pause(0.4).move_by_offset(60, -40).pause(0.4).perform()
    assert driver.execute_script("return taut.pointer !== null && taut.isFollowing"), "it holds the sail, not the view"
    ActionChains(driver).release().perform()
    slider = driver.find_element(By.CSS_SELECTOR, "#sliders input")
    assert slider.get_attribute("aria-label") == "velocity of wind breeze, metres per second"
    slider.send_keys(Keys.END)
    driver.find_element(By.TAG_NAME, "body").click()
    time.sleep(0.5)
    record = driver.execute_script("return taut.session.record('sail.toml')")
    assert 'do = "grab"' in record["text"] and 'key = "wind.breeze.velocity"' in record["text"], record["text"]
    pathlib.Path("played.toml").write_text(record["text"])
    # The hash of a tick holds those of all before it.
    hashes = dict(re.findall(r"^(\d+) ([0-9a-f]{16})$", done("render", "played.toml", "--no-pictures", "--quiet",
                                                                    "--hash-every", "tick"), re.MULTILINE))
    assert hashes[str(record["tick"])] == record["hash"], "the program comes to another state at tick %s" % record["tick"]


def does_what_it_says(driver):
    canvas = driver.find_element(By.ID, "picture")
    tick = "return taut.session.tick"
    canvas.send_keys(Keys.SPACE)
    time.sleep(0.2)
    still = driver.execute_script(tick)
    time.sleep(0.3)
    assert driver.execute_script(tick) == still, "space pauses"
    canvas.send_keys(".")
    wait(driver, "return taut.session.tick === %d" % (still + 1), "one tick")
    canvas.send_keys(Keys.BACKSPACE)
    wait(driver, "return taut.session.tick < 3", "from the start")
    step = driver.execute_script("return taut.step")
    canvas.send_keys("+")
    wait(driver, "return Math.abs(taut.step / %r - 0.5) < 0.01" % step, "half the step")
    canvas.send_keys("m")
    wait(driver, "return taut.session.solver.method !== 'leapfrog'", "another method")
    canvas.send_keys("h")
    assert "one tick" in text(driver, "keys")
    canvas.send_keys("h")
    before = driver.execute_script("return taut.picture.camera.position.toArray()")
    ActionChains(driver).move_to_element_with_offset(canvas, -420, 40).click_and_hold().move_by_offset(80, 0) \
        .release().perform()
    wait(driver, "return !taut.isFollowing", "a drag beside it turns the view")
    wait(driver, "return taut.picture.camera.position.toArray()[0] !== %r" % before[0], "which moves the eye")
    canvas.send_keys("c")
    wait(driver, "return taut.isFollowing", "and back")


def is_edited(driver):
    driver.find_element(By.ID, "edit").click()
    write = ("const text = document.getElementById('text'); text.value = text.value.replace(arguments[0], arguments[1]);"
             "text.dispatchEvent(new Event('input'));")
    driver.execute_script(write, "cells = [12", "cels = [12")
    wait(driver, "return /sail.toml:8:1: error:.*[^]*\\^[^]*did you mean/.test(document.getElementById('fault').textContent)",
         "a mistake is shown with its line, a caret and the remedy")
    driver.execute_script(write, "cels = [12", "cells = [6")
    wait(driver, "return document.getElementById('fault').textContent === '' && taut.session.rampable().length > 0 &&"
         "taut.film.meshOf.get('cloth_sail').geometry.attributes.position.count < 90", "the scene is read again")
    driver.find_element(By.ID, "edit").click()


def gives_and_takes_files(driver):
    driver.execute_script("window.saved = []; download = (name, text) => saved.push([name, text]);")
    driver.find_element(By.ID, "save").click()
    wait(driver, "return saved.length === 2", "the text as it was edited, and what was done with it")
    (name, scene), (played, scenario) = driver.execute_script("return saved")
    assert (name, played) == ("sail.toml", "sail-played.toml") and "cells = [6" in scene and 'scene = "sail.toml"' in scenario
    driver.execute_script("taut.drop([new File([arguments[0]], 'other.toml'), new File(['nothing'], 'net.obj')])",
                          SCENE.replace("[cloth.sail]", "[cloth.other]"))
    wait(driver, "return taut.session.bodies.join() === 'cloth.other'", "a dropped scene is played")
    driver.execute_script("taut.drop([new File([arguments[0]], 'worse.toml')])", "schema = 1\n[cloth.a]\nmesh = 'no.obj'\n")
    wait(driver, "return document.getElementById('fault').textContent.includes('worse.toml:3')", "a wrong one is refused")
    assert driver.execute_script("return taut.session.bodies.join()") == "cloth.other", "and the other goes on"


def asks_for_nothing(driver, page):
    asked = [json.loads(line["message"])["message"] for line in driver.get_log("performance")]
    urls = [message["params"]["request"]["url"] for message in asked if message["method"] == "Network.requestWillBeSent"]
    outside = [url for url in urls if not url.startswith(("blob:", "data:")) and not url.endswith(page)]
    assert outside == [], outside
    log = [line for line in driver.get_log("browser") if line["level"] in ("SEVERE", "WARNING")]
    assert log == [], log


def tells_how_fast(driver):
    for name in ("flag", "curtain", "jelly", "net"):
        done("export", name, "--live", name + ".html", "--quiet", "-y")
        size = os.path.getsize(name + ".html")
        begin = time.time()
        opened(driver, name + ".html")
        first = time.time() - begin
        time.sleep(1)
        ticks = driver.execute_script("return taut.session.tick")
        begin = time.time()
        time.sleep(4)
        ticks = driver.execute_script("return taut.session.tick") - ticks
        wall = time.time() - begin
        rate = driver.execute_script("return taut.rate.pictures")
        print("%s: %.1f MB, plays after %.1f s, %.2f of real time, %.0f pictures a second"
              % (name, size / 1e6, first, ticks / 60 / wall, rate), flush=True)


def refuses():
    for words, said in ((("--live", "x.html", "--sliders", "wind.breze.velocity"), "did you mean"),
                        (("--live", "x.html", "--engine", "."), "there is no engine.mjs"),
                        (("--live", "x.png"), "out.html"), (("--live", "x.html", "-o", "x.glb"), "of their own")):
        outcome = subprocess.run([PROGRAM, "export", "sail.toml", *words], capture_output=True, text=True)
        assert outcome.returncode != 0 and said in outcome.stderr, (words, outcome.stderr)
        assert not os.path.exists("x.html") and not os.path.exists("x.png"), words


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        pathlib.Path("sail.toml").write_text(SCENE)
        refuses()
        done("export", "sail.toml", "--live", "sail.html", "--quiet")
        driver = browser()
        try:
            opened(driver, "sail.html")
            assert driver.title.startswith("A sail </script>"), driver.title
            keeps_what_a_hand_did(driver)
            does_what_it_says(driver)
            is_edited(driver)
            gives_and_takes_files(driver)
            asks_for_nothing(driver, "sail.html")
            tells_how_fast(driver)
        finally:
            driver.quit()


main()
