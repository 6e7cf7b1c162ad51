"""What eight explicit methods make of the energy of a swinging cloth: energy.py [PICTURE]

Nothing damps it, so that kinetic, elastic and gravitational energy should keep their sum. All take the same step, 0.3 of
the largest that leap-frog stands. Prints for each how far the sum strays from its start, in parts of the energy of
the swing, or when it diverges.
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import taut

SCENE = """schema = 1
[solver]
integrator = "METHOD"
dt = STEP
precision = "double"
[material.silk]
density_kg_per_m2 = 0.1
stretch_N_per_m = 60.0
damping_time_s = 0.0
drag_per_s = 0.0
[cloth.scarf]
size = [1.0, 1.0]
cells = [12, 12]
origin = [0.0, 2.0, 0.0]
down = [0.0, 0.0, 1.0]
material = "silk"
hold = ["top-left", "top-right"]
"""
NAMES = {
    "euler": "explicit Euler",
    "heun": "Heun",
    "midpoint": "midpoint",
    "rk4": "Runge-Kutta 4",
    "symplectic-euler": "symplectic Euler",
    "velocity-verlet": "velocity Verlet",
    "leapfrog": "leap-frog",
    "blanes-moan": "Blanes-Moan",
}
SECONDS = 10.0


def strays(method, step):
    """Times [s] and how far the energy is off its start, in parts of what the swing exchanges."""
    world = taut.loads(SCENE.replace("METHOD", method).replace("STEP", f"{step:.9g}"))
    start = world.energies()["total"]
    swing = 0.1 * 9.81 * 0.5  # [J] of 0.1 kg whose middle swings half a metre down
    times, off = [], []
    try:
        while world.time < SECONDS:
            world.step(3)
            times.append(world.time)
            off.append(abs(world.energies()["total"] - start) / swing)
    except taut.Diverged as error:
        times.append(error.time)
        off.append(np.inf)
    return np.array(times), np.array(off)


def label(axes, ends, is_above):
    """Names at the ends of curves, (x, y, name, colour), apart from each other."""
    last = -np.inf
    for x, y, name, colour in sorted(ends):
        if is_above:
            row = 18 if x - last < 1.5 else 0
            axes.annotate(name, (x, y), xytext=(0, 6 + row), textcoords="offset points", color=colour, fontsize=14,
                          ha="left")
            last = x
        else:
            axes.annotate(name, (x, y), xytext=(8, 0), textcoords="offset points", color=colour, fontsize=14,
                          va="center")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture", nargs="?", default="energy.png", help="the file to draw; energy.png if not given")
    arguments = parser.parse_args()
    limit = taut.loads(SCENE.replace("METHOD", "leapfrog").replace("dt = STEP\n", "")).islands[0]["step_limit"]
    figure, axes = plt.subplots(figsize=(12.8, 7.2), dpi=150)
    lowest, highest = 1e-9, 10.0
    gone, staying = [], []
    for (method, name), colour in zip(NAMES.items(), plt.get_cmap("tab10").colors):
        times, off = strays(method, 0.3 * limit)
        is_finite = np.isfinite(off)
        worst = off[is_finite].max(initial=0.0)
        print(f"{method}: " + (f"{worst:.2e}" if is_finite.all() else f"diverges at {times[-1]:.2f} s"))
        off = np.maximum.accumulate(off)  # the most so far
        off[~is_finite] = 1e3
        axes.semilogy(times, np.maximum(off, lowest), color=colour, linewidth=2.5, label=name)
        if off[-1] > highest:
            gone.append((times[off > highest][0], highest, name, colour))
        else:
            staying.append((times[-1], off[-1], name, colour))
    label(axes, gone, True)
    # Two that end at the same height share it.
    staying.sort(key=lambda end: end[1])
    for k in range(1, len(staying)):
        x, y, name, colour = staying[k]
        staying[k] = (x, max(y, 2.6 * staying[k - 1][1]), name, colour)
    label(axes, staying, False)
    axes.set(xlim=(0, SECONDS), ylim=(lowest, highest), xlabel="time [s]",
             ylabel="largest error of the energy so far, in parts of the swing")
    axes.xaxis.label.set_size(14)
    axes.yaxis.label.set_size(14)
    axes.tick_params(labelsize=12)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    figure.subplots_adjust(left=0.08, right=0.85, top=0.91, bottom=0.1)
    figure.savefig(arguments.picture)


if __name__ == "__main__":
    main()
