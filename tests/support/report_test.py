#!/usr/bin/env python3
"""Opens the report of a failing run in a real browser, from a file: what a person would see and do.

report_test.py PROGRAM FOLDER: plays a small scenario, makes it golden, changes its look and its motion, plays it again,
and looks at the report of that.
"""
import json
import pathlib
import shutil
import subprocess
import sys

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

SCENARIO = """schema = 1
title = "A bob on a spring"
[run]
fps = 20
seconds = 1.0
[net.spring]
points = [ { name = "nail", position = [0, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0] } ]
springs = [ { a = "nail", b = "bob", stiffness_N_per_m = 100.0 } ]
radius = 0.05
ball = 0.2
[collider.ground]
shape = "plane"
[camera.main]
eye = [0.0, 1.2, 4.0]
target = [0.0, 1.0, 0.0]
[[golden]]
frames = [5, 10, 15]
size = [160, 90]
"""


def expect(condition, what):
    if not condition:
        sys.exit(f"the report: {what}")


def failing_run(program, folder):
    """The report of a scenario that does something else than its goldens."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    scenario = folder / "spring.toml"
    scenario.write_text(SCENARIO, encoding="utf-8")
    made = subprocess.run([program, "test", folder, "--update", "spring", "--why", "The first of its kind."],
                          capture_output=True, text=True, check=False)
    expect(made.returncode == 0, f"no goldens: {made.stderr}")
    same = folder / "a-same.toml"
    same.write_text(SCENARIO, encoding="utf-8")
    kept = subprocess.run([program, "test", folder, "--update", "a-same", "--why", "It stays."], capture_output=True,
                          text=True, check=False)
    expect(kept.returncode == 0, f"no goldens: {kept.stderr}")
    (folder / "b-new.toml").write_text(SCENARIO, encoding="utf-8")
    scenario.write_text(SCENARIO.replace("100.0", "60.0"), encoding="utf-8")
    run = subprocess.run([program, "test", folder, "-o", folder / "out", "--quiet"], capture_output=True, text=True,
                         check=False)
    expect(run.returncode == 1, f"a changed spring should fail with 1, not {run.returncode}: {run.stdout}{run.stderr}")
    return folder / "out" / "report.html"


def browser():
    options = webdriver.ChromeOptions()
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1200,1400"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options)


def sources(images):
    return [image.get_attribute("src") for image in images]


def look(driver, page):
    driver.get(page.as_uri())
    viewer = driver.find_element(By.CSS_SELECTOR, "#spring .viewer")
    images = viewer.find_elements(By.CSS_SELECTOR, "figure img")
    expect(len(images) == 3, f"{len(images)} pictures instead of three")
    for image in images:
        expect(image.is_displayed(), "a picture is hidden")
        size = [image.get_property("naturalWidth"), image.get_property("naturalHeight")]
        expect(size == [160, 90], f"a picture of {size} pixels")
    expect(len(set(sources(images))) == 3, "golden, actual and difference are not three pictures")
    return viewer, images


def scrub(viewer, images):
    """One slider moves all three."""
    slider = viewer.find_element(By.CSS_SELECTOR, "input[type=range]")
    key, before = viewer.get_attribute("data-key"), sources(images)
    slider.send_keys(Keys.ARROW_RIGHT)
    expect(viewer.get_attribute("data-key") != key, "the slider shows the same frame still")
    for then, now in zip(before, sources(images)):
        expect(then != now, "the slider left a picture behind")
    slider.send_keys(Keys.ARROW_LEFT)
    expect(sources(images) == before, "the slider does not lead back")


def swap(driver, viewer, images):
    """Pointing at the golden shows the actual picture in its place, and the other way round."""
    golden, actual, difference = sources(images)
    for at, shown in ((0, actual), (1, golden)):
        ActionChains(driver).move_to_element(images[at]).perform()
        expect(images[at].get_attribute("src") == shown, "pointing does not swap")
        ActionChains(driver).move_to_element(viewer.find_element(By.CSS_SELECTOR, ".scrub")).perform()
        expect(sources(images) == [golden, actual, difference], "what was swapped does not come back")


def read(driver):
    text = driver.find_element(By.TAG_NAME, "main").text
    for part in ("of pixels differ", "net.spring differs first", "The first of its kind.", "--update spring"):
        expect(part in text, f"“{part}” is not to be read in it:\n{text}")
    theme = driver.find_element(By.ID, "theme")
    before = driver.find_element(By.TAG_NAME, "html").get_attribute("data-theme")
    theme.click()
    expect(driver.find_element(By.TAG_NAME, "html").get_attribute("data-theme") != before, "no other theme")


def find(driver, viewer):
    """The worst tile is framed where it lies in all three pictures, and the text's change is shown."""
    tile = json.loads(viewer.find_element(By.CSS_SELECTOR, "script").get_attribute("textContent"))[0]["tile"]
    expect(tile[2] > 0, "no tile is named")
    for figure in viewer.find_elements(By.TAG_NAME, "figure"):
        rect = figure.find_element(By.TAG_NAME, "rect")
        picture = figure.find_element(By.TAG_NAME, "img")
        expect(rect.is_displayed(), "the worst tile is not marked")
        left = picture.rect["x"] + picture.rect["width"] * tile[0] / 160
        expect(abs(rect.rect["x"] - left) < 4, f"the mark is at {rect.rect['x']}, the tile at {left}")
    changes = {kind: [line.text for line in driver.find_elements(By.CSS_SELECTOR, f"#spring .diff .{kind} code")]
               for kind in ("gone", "added")}
    expect(len(changes["gone"]) == 1 and "100.0" in changes["gone"][0], f"what has gone is {changes['gone']}")
    expect(len(changes["added"]) == 1 and "60.0" in changes["added"][0], f"what is new is {changes['added']}")


def sort(driver):
    """Failures come first, then what has no golden; the button hides what passed and nothing else."""
    names = lambda: [s.get_attribute("id") for s in driver.find_elements(By.CSS_SELECTOR, "details.scenario")
                     if s.is_displayed()]
    expect(names() == ["spring", "b-new", "a-same"], f"the scenarios stand as {names()}")
    button = driver.find_element(By.ID, "failing")
    button.click()
    expect(names() == ["spring", "b-new"], f"without what passed there are {names()}")
    button.click()
    driver.set_window_size(700, 1400)
    for command in driver.find_elements(By.CSS_SELECTOR, ".command code"):
        wide = driver.execute_script("return arguments[0].scrollWidth - arguments[0].clientWidth", command)
        expect(wide <= 0, "a command does not wrap")
    driver.set_window_size(1200, 1400)


def listen(driver, page):
    """What the page asked for: itself, and pictures that it carries."""
    for entry in driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            url = message["params"]["request"]["url"]
            expect(url.startswith("data:") or url == page.as_uri(), f"it asks for {url}")
    complaints = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
    expect(not complaints, f"the browser complains: {complaints}")


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    page = failing_run(program, folder)
    driver = browser()
    try:
        viewer, images = look(driver, page)
        scrub(viewer, images)
        swap(driver, viewer, images)
        find(driver, viewer)
        sort(driver)
        read(driver)
        listen(driver, page)
    finally:
        driver.quit()
    print("the report shows what it should")


if __name__ == "__main__":
    main()
