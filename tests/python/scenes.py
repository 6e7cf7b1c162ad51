"""Scenes that the tests of the Python module share."""

CLOTH = """schema = 1
[run]
seconds = 12
[material.silk]
density_kg_per_m2 = 0.1
stretch_N_per_m = 60.0
[cloth.scarf]
size = [1.0, 1.0]
cells = [6, 6]
origin = [0.0, 2.0, 0.0]
down = [0.0, 0.0, 1.0]
material = "silk"
hold = ["top-left", "top-right"]
[collider.ball]
shape = "sphere"
radius = 0.3
position = [0.5, 1.2, 0.4]
[wind.breeze]
velocity = [1.0, 0.0, 0.0]
[camera.front]
eye = [0.5, 1.5, 4.0]
target = [0.5, 1.5, 0.0]
"""

# Free masses of 2 kg at x = 1, 2, 3, each an island of its own, and nothing that acts on them.
MASSES = """schema = 1
[world]
gravity = [0.0, 0.0, 0.0]
[solver]
precision = "double"
""" + "".join(f"""[net.ball{i}]
drag_per_s = 0.0
points = [
  {{ name = "m", position = [{i}.0, 0.0, 0.0], mass_kg = 2.0 }},
  {{ name = "wall", position = [{i}.0, 0.0, 9.0], mass_kg = 1.0, hold = true }},
]
springs = [ {{ a = "m", b = "wall", stiffness_N_per_m = 1e-9 }} ]
""" for i in (1, 2, 3))
