"""How far a hanging cloth stretches, over its stiffness: sweep.py [PICTURE]

A sheet of n rows whose springs are columns alone hangs by its upper edge until it is at rest. The spring of a column in
row i bears what hangs below it, so that a column is longer by the sum of those weights over k: with m the mass of a cell,
m g n²/(2 k). Prints k, the stretch, and the stretch by that formula.
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import NullLocator

import taut

ROWS, HEIGHT, DENSITY, G = 16, 1.0, 0.2, 9.81  # cells, [m], [kg/m²], [m/s²]
SCENE = f"""schema = 1
[solver]
precision = "double"
[material.weave]
density_kg_per_m2 = {DENSITY}
stretch_N_per_m = 1.0
shear_N_per_m = 0.0
bend_N_per_m = 0.0
damping_time_s = 0.0
drag_per_s = 1.0
[cloth.sheet]
size = [{HEIGHT}, {HEIGHT}]
cells = [{ROWS}, {ROWS}]
origin = [0.0, 3.0, 0.0]
material = "weave"
hold = ["top"]
"""


def stretch(k):
    """Of the lower edge, at rest, over the height [-]."""
    mass = DENSITY * HEIGHT**2 / ROWS**2  # [kg] of a cell
    slowest = np.pi / 2 / ROWS * np.sqrt(k / mass)  # [1/s] of a column
    world = taut.loads(SCENE, {"material.weave.stretch_N_per_m": k, "material.weave.drag_per_s": 2 * slowest})
    world.run(until=10.0 / slowest)  # damped as much as stops it soonest
    lower = world.positions("cloth.sheet@bottom")[:, 1].mean()
    return (3.0 - HEIGHT - lower) / HEIGHT


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture", nargs="?", default="sweep.png", help="the file to draw; sweep.png if not given")
    arguments = parser.parse_args()
    stiffnesses = np.geomspace(20.0, 2000.0, 9)  # [N/m]
    weight = DENSITY * HEIGHT**2 / ROWS**2 * G  # [N] of a cell
    measured = np.array([stretch(k) for k in stiffnesses])
    theory = weight * ROWS**2 / 2 / stiffnesses / HEIGHT
    for row in zip(stiffnesses, measured, theory):
        print("{:8.1f} N/m {:.6f} {:.6f}".format(*row))
    figure, axes = plt.subplots(figsize=(12.8, 7.2), dpi=150)
    axes.loglog(stiffnesses, 100 * theory, color="0.6", linewidth=2.5, label="m g n²/(2 k)")
    axes.loglog(stiffnesses, 100 * measured, "o", color="#2f6690", markersize=10, label="at rest")
    axes.set(xlabel="stiffness of a cell [N/m]", ylabel="stretch [% of the height]")
    axes.xaxis.label.set_size(14)
    axes.yaxis.label.set_size(14)
    axes.set_xticks([20, 50, 100, 200, 500, 1000, 2000], minor=False)
    axes.set_yticks([0.05, 0.1, 0.2, 0.5, 1, 2, 5], minor=False)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
        axis.set_minor_locator(NullLocator())
    axes.tick_params(labelsize=12)
    axes.grid(True, color="0.93")
    axes.legend(fontsize=14, frameon=False)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    figure.subplots_adjust(left=0.08, right=0.98, top=0.97, bottom=0.1)
    figure.savefig(arguments.picture)


if __name__ == "__main__":
    main()
