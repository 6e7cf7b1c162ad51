"""A controller that catches a ball with a net: catch.py [PICTURE]

The ball is thrown past the frame of the shipped scene "net". At the start of every tick a function looks where ball and
frame are, computes where the ball comes down to the height of the net, and slides the frame there, no faster than
3.5 m/s and no harder than 30 m/s². Prints how far from the middle of the net the ball ends up.
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import taut

G = 9.81  # [m/s²]
NET = 0.95  # [m] its height
FASTEST, HARDEST = 3.5, 30.0  # [m/s], [m/s²] of the frame
SHOWN = (0.1, 0.5, 0.9)  # [s]
THROW = {
    "cloth.ball.position": [-2.2, 1.3, 0.35],
    "cloth.ball.velocity": [4.5, 3.6, -0.55],
    "camera.main.keys": [{"t": 0.0, "eye": [-0.3, 2.1, 5.0], "target": [-0.3, 1.12, 0.0]}],
}


class Catcher:
    """Slides the frame to where the ball will come down."""

    def __init__(self, world):
        self.mass = world.masses("cloth.ball")
        self.velocity = np.zeros(3)
        self.track = []  # (t, x of the ball, x of the frame)

    def __call__(self, world, t, dt):
        x = self.mass @ world.positions("cloth.ball") / self.mass.sum()
        v = self.mass @ world.velocities("cloth.ball") / self.mass.sum()
        frame, _ = world.place_of("collider.frame")
        left = 0.0  # [s] until it is at the net
        if x[1] > NET:
            left = (v[1] + np.sqrt(v[1] ** 2 + 2 * G * (x[1] - NET))) / G
        goal = x + v * left
        goal[1] = frame[1]
        # As fast as lets it brake at the goal, or go there in the time that is left.
        way = goal - frame
        far = float(np.linalg.norm(way))
        speed = min(FASTEST, np.sqrt(HARDEST * far), far / max(dt, 0.1))
        wanted = way / max(far, 1e-9) * speed
        change = wanted - self.velocity
        self.velocity = self.velocity + change * min(1.0, HARDEST * dt / max(float(np.linalg.norm(change)), 1e-9))
        world.place("collider.frame", frame + self.velocity * dt)
        self.track.append((t, x[0], frame[0]))


def play(is_led, shown=()):
    world = taut.load("net", THROW)
    catcher = Catcher(world)
    if is_led:
        world.add_system(catcher)
    pictures = []
    for moment in (*shown, 2.0):
        world.run(until=moment)
        if moment in shown:
            pictures.append(world.render((960, 540)))
    ball = catcher.mass @ world.positions("cloth.ball") / catcher.mass.sum()
    off = ball - world.place_of("collider.frame")[0]
    return pictures, np.array(catcher.track), ball, off


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture", nargs="?", default="catch.png", help="the file to draw; catch.png if not given")
    arguments = parser.parse_args()
    pictures, track, ball, off = play(True, SHOWN)
    missed = play(False)[3]
    print(f"caught: {np.hypot(off[0], off[2]):.3f} m from the middle of the net, {ball[1]:.3f} m up")
    print(f"without the controller: {np.hypot(missed[0], missed[2]):.3f} m from it")
    figure = plt.figure(figsize=(12.8, 7.2), dpi=150)
    upper = figure.add_gridspec(1, 3, wspace=0.03, left=0.01, right=0.99, top=0.94, bottom=0.56)
    lower = figure.add_gridspec(1, 1, left=0.06, right=0.98, top=0.5, bottom=0.1)
    for i, (moment, picture) in enumerate(zip(SHOWN, pictures)):
        axes = figure.add_subplot(upper[i])
        axes.imshow(picture)
        axes.set_title(f"{moment:.2f} s", fontsize=14)
        axes.axis("off")
    axes = figure.add_subplot(lower[0])
    axes.plot(track[:, 0], track[:, 1], color="#c8302a", linewidth=2.5, label="ball")
    axes.plot(track[:, 0], track[:, 2], color="#2f6690", linewidth=2.5, label="net")
    axes.fill_between(track[:, 0], track[:, 2] - 0.6, track[:, 2] + 0.6, color="#2f6690", alpha=0.15, linewidth=0)
    for moment in SHOWN:
        axes.axvline(moment, color="0.75", linewidth=1, zorder=0)
    axes.set(xlabel="time [s]", ylabel="x [m]", xlim=(0, 2), xticks=np.arange(0, 2.1, 0.5))
    axes.xaxis.label.set_size(14)
    axes.yaxis.label.set_size(14)
    axes.tick_params(labelsize=12)
    axes.legend(fontsize=14, frameon=False, loc="upper left")
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    figure.savefig(arguments.picture)


if __name__ == "__main__":
    main()
