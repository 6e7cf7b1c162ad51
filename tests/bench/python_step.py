#!/usr/bin/env python3
"""What a tick costs from Python and from C++: a cloth of 64 x 64 cells, in pairs whose order alternates.

python_step.py PROGRAM [PAIRS [TICKS]], with PYTHONPATH naming the module of the same build and PROGRAM its
taut_python_step. Prints processor time a tick and the median of the ratios: of step() alone, of step() with the
positions after every tick, and of a tick with a force of Python that asks for nothing.
"""
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import taut

SCENE = """schema = 1
[material.linen]
density_kg_per_m2 = 0.2
stretch_N_per_m = 500.0
bend_N_per_m = 1.0
damping_time_s = 1e-4
[cloth.sheet]
size = [1.0, 1.0]
cells = [64, 64]
origin = [0.0, 2.0, 0.0]
down = [0.0, 0.0, 1.0]
material = "linen"
hold = ["top-left", "top-right"]
"""


def from_python(ticks, ask):
    world = taut.loads(SCENE, threads=1)
    if ask == "force":
        world.add_force(lambda t, x, v, m: np.zeros_like(x))
    world.step(30)
    start = time.process_time()
    for _ in range(ticks):
        world.step()
        if ask == "positions":
            world.positions("cloth.sheet")
    return time.process_time() - start, world.hash


def main():
    program, *numbers = sys.argv[1:]
    pairs, ticks = (int(n) for n in (numbers + ["7", "300"][len(numbers):]))
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(SCENE)
        file.flush()

        def from_cpp():
            seconds, state = subprocess.run([program, file.name, str(ticks)], check=True, capture_output=True,
                                            text=True).stdout.split()
            return float(seconds), state

        for ask in ("nothing", "positions", "force"):
            ratios, costs = [], []
            for pair in range(pairs):
                one, other = (from_cpp, lambda: from_python(ticks, ask)), (lambda: from_python(ticks, ask), from_cpp)
                first, second = (f() for f in (one if pair % 2 == 0 else other))
                cpp, python = (first, second) if pair % 2 == 0 else (second, first)
                if ask != "force" and cpp[1] != python[1]:
                    sys.exit(f"other bits: {cpp[1]} and {python[1]}")
                ratios.append(python[0] / cpp[0])
                costs.append((cpp[0], python[0]))
            print(f"{ask:10} C++ {1e3 * min(c for c, _ in costs) / ticks:.3f} ms  "
                  f"Python {1e3 * min(p for _, p in costs) / ticks:.3f} ms a tick, "
                  f"ratio {statistics.median(ratios):.3f} ({min(ratios):.3f} to {max(ratios):.3f})")


if __name__ == "__main__":
    main()
