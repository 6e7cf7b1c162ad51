#!/usr/bin/env python3
"""The module in Chromium: page_test.py PACKAGE ASSETS. Hashes of every tick of every shipped scene and scenario are
those that node_test.mjs has from the program, and the sample page moves its flag and follows the mouse."""
import functools
import http.server
import json
import pathlib
import sys
import tempfile
import threading
import time

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By

PLAY = """
const [list, path, ticks, done] = arguments;
(async () => {
  const {filesFrom, hashesOf} = await import('/tests/web/assets.mjs');
  const {start, World} = await import('/taut/taut.mjs');
  await start();
  const read = async (file) => new Uint8Array(await (await fetch('/assets/' + file)).arrayBuffer());
  window.files ??= await filesFrom(list, read);
  return hashesOf(World, path, window.files, ticks);
})().then(done, (error) => done(String(error)));
"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".mjs": "text/javascript",
                      ".wasm": "application/wasm"}

    def log_message(self, *_):
        pass


def browser():
    options = webdriver.ChromeOptions()
    for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=500,400", "--use-gl=angle",
                 "--use-angle=swiftshader", "--enable-unsafe-swiftshader"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options)


def has_the_hashes(driver, assets, expected):
    files = [str(file.relative_to(assets)) for file in assets.rglob("*") if file.is_file()]
    for path, hashes in expected.items():
        begin = time.time()
        found = driver.execute_async_script(PLAY, files, path, len(hashes) - 1)
        assert found == hashes, "%s: %s" % (path, found if isinstance(found, str) else next(
            "tick %d: %s, by the program %s" % (k, a, b) for k, (a, b) in enumerate(zip(found, hashes)) if a != b))
        print("%s: %d ticks, %.1f s" % (path, len(hashes) - 1, time.time() - begin), flush=True)


def the_sample_moves(driver):
    corner = "return window.shown && window.shown('cloth_flag')"
    for _ in range(200):
        if driver.execute_script(corner):
            break
        time.sleep(0.05)
    log = driver.get_log("browser")
    before = driver.execute_script(corner)
    assert before, log
    time.sleep(1)
    assert driver.execute_script(corner) != before, log
    canvas = driver.find_element(By.TAG_NAME, "canvas")
    ActionChains(driver).move_to_element(canvas).click_and_hold().pause(0.3).move_by_offset(30, 0).pause(0.5).perform()
    assert driver.execute_script("return window.session.advance(0.05).isHolding"), log
    ActionChains(driver).release().perform()
    assert not [line for line in log if line["level"] == "SEVERE" and "favicon" not in line["message"]], log


def main():
    package, assets = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    expected = json.loads((package.parent / "hashes.json").read_text())
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        modules = root / "node_modules"
        modules.mkdir()
        for place, target in ((root / "taut", package), (root / "assets", assets),
                              (root / "tests", assets.parent / "tests"), (modules / "taut-engine", package),
                              (modules / "three", "/usr/share/javascript/three"),
                              (root / "page.html", assets.parent / "game/samples/web/page.html")):
            place.symlink_to(target)
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        driver = browser()
        driver.set_script_timeout(3600)
        try:
            driver.get("http://127.0.0.1:%d/page.html" % server.server_port)
            the_sample_moves(driver)
            driver.get("http://127.0.0.1:%d/taut/package.json" % server.server_port)
            has_the_hashes(driver, assets, expected)
        finally:
            driver.quit()
            server.shutdown()


main()
