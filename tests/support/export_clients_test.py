#!/usr/bin/env python3
"""What taut export writes, read by clients that npm has: the validator of glTF's makers, and OpenUSD itself, as
WebAssembly in a browser.

export_clients_test.py PROGRAM FOLDER: .glb has no error; the meshes that OpenUSD hands to whoever draws are where taut has
the points, at every frame, and where something is cut, too. The packages of clients/package.json go to FOLDER. Exits with
77, skipped, where npm or the network is not there.
"""
import functools
import http.server
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time

import numpy
from selenium import webdriver

from exporting import CUT, done, expect, scene

HERE = pathlib.Path(__file__).resolve().parent / "clients"
SKIPPED = 77
SCENE = scene('keys = [ { t = 0.0, eye = [0.5, 1.5, 4.0], target = [0.5, 1.5, 0.0] }, { t = 0.5, eye = [0.0, 1.5, 4.0], target = [0.5, 1.5, 0.0] } ]')


def skip(why):
    print("skipped: " + why)
    sys.exit(SKIPPED)


def installed(folder):
    """The folder of the packages, which are installed where they are not yet as pinned."""
    folder.mkdir(parents=True, exist_ok=True)
    for tool in ("node", "npm"):
        if shutil.which(tool) is None:
            skip("%s is not installed" % tool)
    pinned = json.loads((HERE / "package.json").read_text())["dependencies"]

    def version(name):
        try:
            return json.loads((folder / "node_modules" / name / "package.json").read_text())["version"]
        except OSError:
            return None

    if any(version(name) != pinned[name] for name in pinned):
        shutil.copy(HERE / "package.json", folder)
        run = subprocess.run(
            ["npm", "install", "--omit=peer", "--ignore-scripts", "--no-audit", "--no-fund", "--no-package-lock",
             "--fetch-retries=0", "--fetch-timeout=20000"],
            cwd=folder, capture_output=True, text=True, check=False)
        if run.returncode != 0:
            skip("npm installs nothing: " + run.stderr.strip().replace("npm error ", "").splitlines()[0])
    return folder / "node_modules"


def glb_is_valid(packages):
    for name in ("small", "plain", "flag"):
        run = subprocess.run(["node", HERE / "validate.js", name + ".glb"], capture_output=True, text=True, check=False,
                             env={**os.environ, "NODE_PATH": str(packages)})
        expect(run.returncode == 0, "the validator runs: " + run.stderr)
        issues = json.loads(run.stdout)
        expect(issues["numErrors"] == 0 and issues["numWarnings"] == 0, "%s.glb: %s" % (name, issues["messages"]))


class Handler(http.server.SimpleHTTPRequestHandler):
    """Whose pages may share memory among threads, as OpenUSD does."""

    def end_headers(self):
        self.send_header("Cross-Origin-Opener-Policy", "same-origin")
        self.send_header("Cross-Origin-Embedder-Policy", "require-corp")
        super().end_headers()

    def log_message(self, *arguments):
        pass


def read_by_usd(names):
    """Of each file what OpenUSD shows at every time code."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory="."))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    options = webdriver.ChromeOptions()
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
        options.add_argument(flag)
    driver = webdriver.Chrome(options=options)
    try:
        driver.set_script_timeout(60)
        driver.get("http://127.0.0.1:%d/usd.html" % server.server_port)
        for _ in range(600):
            if driver.execute_script("return usd !== null"):
                break
            time.sleep(0.05)
        else:
            expect(False, "OpenUSD starts: %s" % driver.get_log("browser"))
        script = "const done = arguments[1]; read(arguments[0]).then(done, (error) => done({error: String(error)}));"
        films = [driver.execute_async_script(script, name) for name in names]
    finally:
        driver.quit()
        server.shutdown()
    for film in films:
        expect("error" not in film, "OpenUSD reads it: %s" % film.get("error"))
    return films


def places(numbers):
    return numpy.array(numbers).reshape(-1, 3)


def nearest(there, x):
    return numpy.argmin(((x[:, None] - there[None]) ** 2).sum(axis=2), axis=1)


def usd_agrees():
    whole, torn = read_by_usd(["small.usda", "torn.usda"])
    expect(whole["codesPerSecond"] == 60 and len(whole["frames"]) == 30, "frames are time codes")
    x = numpy.load("small.npz")["cloth.flag.x"]
    order = nearest(places(whole["frames"][0]["cloth_flag"]["points"]), x[0])
    for frame, meshes in enumerate(whole["frames"]):
        # A rounding to floats, 6e-8, and one to nine digits.
        off = numpy.abs(places(meshes["cloth_flag"]["points"])[order] - x[frame]).max() / numpy.abs(x[frame]).max()
        expect(off < 1e-6, "OpenUSD has the flag of frame %d off by %g" % (frame, off))
        normals = places(meshes["cloth_flag"]["normals"])
        expect(numpy.abs((normals**2).sum(axis=1) - 1).max() < 1e-5, "normals of frame %d" % frame)
        shift = numpy.array(meshes["collider_ball"]["transform"]).reshape(4, 4)
        expect(abs(shift[3, 0] - frame / 30) < 1e-6, "OpenUSD has the ball of frame %d" % frame)
    # Each point is at a vertex; those along the cut's edges, half way to the next point, are besides.
    x = numpy.load("torn.npz")["cloth.flag.x"]
    counts = []
    for frame, meshes in enumerate(torn["frames"]):
        flag = meshes["cloth_flag"]
        there = places(flag["points"])
        far = ((x[frame][:, None] - there[None]) ** 2).sum(axis=2)
        off = numpy.sqrt(far.min(axis=1).max()) / numpy.abs(x[frame]).max()
        expect(off < 1e-6, "OpenUSD has the torn flag of frame %d off by %g" % (frame, off))
        expect(max(flag["indices"]) == len(there) - 1, "triangles are of the points of frame %d" % frame)
        counts.append(len(there))
    changes = [frame for frame in range(1, len(counts)) if counts[frame] != counts[frame - 1]]
    expect(changes == [5], "the cut shows at frame 5 alone: %s" % counts)


def main(packages):
    pathlib.Path("small.toml").write_text(SCENE, encoding="utf-8")
    pathlib.Path("torn.toml").write_text(SCENE + CUT, encoding="utf-8")
    done("export", "small.toml", "-o", "small.usda", "--digits", "9", "--points", "small.npz")
    done("export", "torn.toml", "-o", "torn.usda", "--digits", "9", "--points", "torn.npz", "--fps", "20")
    done("export", "small.toml", "-o", "small.glb")
    done("export", "small.toml", "-o", "plain.glb", "--no-normals", "--only", "cloth.*,rope.*", "--every", "7")
    done("export", "flag", "-o", "flag.glb", "--frames", "0-1")  # with a picture
    glb_is_valid(packages)
    for file in (packages / "three-usdz-loader" / "external").iterdir():
        os.symlink(file, file.name)
    shutil.copy(HERE / "usd.html", ".")
    usd_agrees()


if __name__ == "__main__":
    sys.argv[1] = os.path.abspath(sys.argv[1])
    where = installed(pathlib.Path(sys.argv[2]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            main(where)
        finally:
            os.chdir("/")
