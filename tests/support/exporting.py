"""What the tests of taut export share: a scene with one of each, and the program, called and watched."""
import os
import subprocess
import sys

CUT = """[[at]]
t = 0.2
do = "cut"
target = "cloth.flag"
segment = [[0.45, 1.0], [0.45, 0.4]]
"""


def scene(camera, fps=60, head="", height=2.0, finish="", rope=1.0, has_ground=True):
    """Half a second of a flag [m] in the wind, a rope, and a ball that rolls."""
    return f"""schema = 1
{head}
[run]
fps = {fps}
seconds = 0.5
[material.silk]
density_kg_per_m2 = 0.1
stretch_N_per_m = 200.0
[cloth.flag]
size = [1.0, 0.8]
cells = [10, 8]
origin = [0.0, {height}, 0.0]
material = "silk"
hold = ["left"]
{finish}
[wind.breeze]
velocity = [5.0, 0.0, 2.0]
[rope.line]
ends = [[0.0, {rope}, {rope}], [1.0, {rope}, {rope}]]
segments = 6
mass_kg = 0.2
stretch_N = 500.0
hold = ["start"]
[collider.ball]
shape = "sphere"
radius = 0.2
keys = [ {{ t = 0.0, position = [0.0, 0.2, 0.0], ease = "linear" }}, {{ t = 0.5, position = [1.0, 0.2, 0.0], ease = "linear" }} ]
{'[collider.ground]' if has_ground else ''}
{'shape = "plane"' if has_ground else ''}
[camera.main]
{camera}
"""


def expect(condition, what):
    if not condition:
        sys.exit("does not hold: " + what)


def taut(*arguments, **more):
    return subprocess.run([sys.argv[1], *map(str, arguments)], capture_output=True, text=True, check=False, **more)


def done(*arguments):
    run = taut(*arguments, "--quiet")
    expect(run.returncode == 0, "taut %s: %s" % (arguments, run.stderr))
    return run.stdout


def refused(code, words, *arguments, **more):
    """Nothing new is there then, and nothing old is gone."""
    before = sorted(os.listdir("."))
    run = taut("export", *arguments, **more)
    expect(run.returncode == code, "exit %s, not %s: %s" % (code, run.returncode, run.stderr))
    for word in words:
        expect(word in run.stderr, '"%s" in: %s' % (word, run.stderr))
    expect(sorted(os.listdir(".")) == before, "nothing is left of %s" % (arguments,))
