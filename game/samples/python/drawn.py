"""A cloth that falls over a ball, drawn with matplotlib: drawn.py [PICTURE]

Prints how near the cloth comes to the ball's middle: never nearer than the ball's radius and the cloth's thickness.
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import taut

CENTRE, RADIUS = np.array([0.0, 0.7, 0.0]), 0.3  # [m]
SCENE = f"""schema = 1
[material.silk]
density_kg_per_m2 = 0.1
stretch_N_per_m = 300.0
bend_N_per_m = 2.0
drag_per_s = 1.5
[cloth.scarf]
size = [1.2, 1.2]
cells = [48, 48]
origin = [-0.6, 1.05, -0.6]
down = [0.0, 0.0, 1.0]
material = "silk"
thickness = 0.005
[collider.ball]
shape = "sphere"
position = {CENTRE.tolist()}
radius = {RADIUS}
"""
SHOWN = (0.1, 0.3, 0.8)  # [s]
COLOURS = {"cloth.scarf": (0.82, 0.18, 0.20), "ball": (0.88, 0.86, 0.82)}
VIEW, LIGHT = np.array([0.45, 0.42, 0.79]), np.array([0.25, 0.85, 0.47])  # directions to the eye and to the light


def triangles_of(surface):
    """Corners (n, 3, 3) and colours (n, 3), lit; the back of a cloth is darker."""
    normals = surface.normals[surface.triangles].mean(axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    is_back = normals @ VIEW < 0
    normals[is_back] *= -1
    shine = 0.3 + 0.75 * np.clip(normals @ LIGHT, 0, 1)
    shine[is_back] *= 0.6
    colours = np.clip(shine[:, None] * COLOURS[surface.name], 0, 1)
    corners = surface.positions[surface.triangles]
    if surface.name == "ball":  # matplotlib sorts triangles by their middles: what touches needs some room
        corners = CENTRE + 0.93 * (corners - CENTRE)
    return corners, colours


def draw(axes, world):
    corners, colours = (np.concatenate(parts) for parts in zip(*map(triangles_of, world.surfaces())))
    corners = corners[:, :, [0, 2, 1]] * [1, -1, 1]  # y is up in taut, z in matplotlib
    axes.add_collection3d(Poly3DCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.3))
    axes.set(xlim=(-0.6, 0.6), ylim=(-0.6, 0.6), zlim=(0.35, 1.1))
    axes.set_box_aspect((1.2, 1.2, 0.75), zoom=1.12)
    axes.view_init(elev=np.degrees(np.arcsin(VIEW[1])), azim=np.degrees(np.arctan2(-VIEW[2], VIEW[0])))
    axes.text2D(0.5, 0.93, f"{world.time:.1f} s", transform=axes.transAxes, fontsize=16, ha="center")
    axes.set_axis_off()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture", nargs="?", default="drawn.png", help="the file to draw; drawn.png if not given")
    arguments = parser.parse_args()
    world = taut.loads(SCENE)
    figure = plt.figure(figsize=(12.8, 4.4), dpi=150)
    nearest = np.inf
    for i, moment in enumerate(SHOWN):
        while world.time < moment - 1e-9:
            world.step()
            nearest = min(nearest, np.linalg.norm(world.positions("cloth.scarf") - CENTRE, axis=1).min())
        draw(figure.add_axes((i / len(SHOWN), 0, 1 / len(SHOWN), 1), projection="3d"), world)
    figure.savefig(arguments.picture)
    print(f"nearest to the middle: {nearest:.4f} m")


if __name__ == "__main__":
    main()
