// A scene that gives every field of the format, each a value of its own that is not its default.
#pragma once

namespace taut::scene {

inline constexpr const char* fullScene = R"toml(schema = 1
title = "everything"
[need]
rms_position_m = 1e-3
rms_percent = 2.5
rms_pixels = 3.5
horizon_s = 0.75
budget_ms = 16
[solver]
integrator = "velocity-verlet"
dt = 1e-3
safety = 0.8
precision = "double"
newton_steps = 4
cg_tolerance = 1e-7
cg_iterations = 300
on_divergence = "freeze"
freeze_strain = 0.5
sleep_error_m = 2e-4
[world]
gravity = [0.5, -1.62, 0.25]
air_density_kg_per_m3 = 0.02
air_pressure_Pa = 2e4
[contact]
friction = 0.45
restitution = 0.35
detections = 8
[run]
fps = 30
seconds = 4.5
start = "kept.state"
[picture]
size = [640, 360]
camera = "main"
samples = 1
shadow_size = 1024
smooth = 1
[light]
direction = [1, -2, 3]
colour = "#ff8000"
intensity = 2.5
softness_deg = 90e-1
sky = [0.1, 0.2, 0.3]
ground = [0.4, 0.5, 0.6]
ambient = 0.7
[environment]
image = "square.png"
strength = 1.5
turn_deg = -90
visible = false
[background]
top = [0.11, 0.12, 0.13]
horizon = [0.21, 0.22, 0.23]
fade_start = 9
fade_end = 31
[material.silk]
density_kg_per_m2 = 0.07
stretch_N_per_m = { warp = 300, weft = 280 }
shear_N_per_m = 120
bend_N_per_m = 0.2
bending_rigidity_N_m = { warp = 3e-6, weft = 2e-6, bias = 1e-6 }
bending_hysteresis_N = 4e-4
bending_yield_per_m = 5.5
damping_time_s = 2e-4
drag_per_s = 0.4
air_kg_per_m2 = 0.03
flutter = 0.5
lumping = "uniform"
yield_strain = 0.05
break_strain = 0.5
break_cell_m = 0.05
strain_limit = 0.5
[cloth.flag]
size = [1.8, 1.2]
cells = [36, 24]
origin = [0.5, 3, 0.25]
round = false
across = [0, 0, 2]
down = [0, -3, 0]
grain_deg = 90
material = "silk"
hold = ["left", "#7", "(0.5,1)"]
clamp = ["bottom"]
hold_on = "collider.ball"
velocity = [1, 2, 3]
spin_rad_per_s = [4, 5, 6]
jitter_m = 0.001
seed = 9
friction = 0.9
restitution = 0.6
thickness = 0.01
collide = false
touch = "others"
finish = { colour = [0.1, 0.2, 0.3], back_colour = [0.4, 0.5, 0.6], accent = [0.7, 0.8, 0.9], pattern = "image", repeat_m = 0.3, weave = 0.4, binding = "satin", thread_m = 0.02, slub = 0.15, fuzz = 0.25, roughness = 0.5, sheen = 0.6, translucency = 0.35, anisotropy = 0.45, hem_m = 0.004, smooth = 2, skin = "square.obj", texture = "square.png" }
solver = { integrator = "euler", dt = 2e-4, safety = 0.7, newton_steps = 5, cg_tolerance = 1e-8, cg_iterations = 400 }
array = { count = [2, 3, 4], step_x = [1, 0, 0], step_y = [0, 2, 0], step_z = [0, 0, 3] }
[cloth.shirt]
mesh = "square.obj"
material = "silk"
position = [1, 2, 3]
rotation_deg = [90, 180, 45]
scale = 0.01
[cloth.front]
outline = [[0, 0], [0.4, 0], [0.5, 0.6], [0, 0.5]]
holes = [{ outline = [[0.1, 0.2], [0.2, 0.2], [0.15, 0.3]] }]
edges = [{ name = "hem", corners = [1, 0] }]
cell_m = 0.05
material = "silk"
[rope.rail]
ends = [[-4, 2, 1], [-1, 2.5, 1.5]]
segments = 12
length_m = 3.5
mass_kg = 2.5
stretch_N = 4e4
bend_N = 6
bending_rigidity_N_m2 = 7e-6
damping_time_s = 3e-4
drag_per_s = 0.6
radius = 0.03
lumping = "uniform"
yield_strain = 0.06
break_strain = 0.6
break_cell_m = 0.06
strain_limit = 0.6
hold = ["ends", "25%"]
[block.jelly]
size = [0.1, 0.2, 0.3]
cells = [2, 3, 5]
position = [7, 8, 9]
rotation_deg = [0, 90, 0]
density_kg_per_m3 = 950
young_Pa = 1e4
bulk_Pa = 3e4
damping_time_s = 4e-4
drag_per_s = 0.7
working_stretch = 2
lumping = "uniform"
yield_strain = 0.07
break_strain = 0.7
break_cell_m = 0.07
strain_limit = 0.7
[block.rubber]
poisson = 0.45
[block.teddy]
mesh = "corner.obj"
cells_m = 0.3
scale = 2
position = [7, 8, 10]
[net.cradle]
points = [{ name = "a", position = [0, 1, 0], mass_kg = 3, hold = true }, { name = "b", position = [1, 1, 0] }]
springs = [{ a = "a", b = "b", stiffness_N_per_m = 20, rest_length_m = 0.5, damping_time_s = 5e-4 }]
damping_time_s = 6e-4
drag_per_s = 0.8
radius = 0.04
ball = 0.07
yield_strain = 0.08
break_strain = 0.8
break_cell_m = 0.08
strain_limit = 0.8
[solid.crate]
shape = "box"
size = [0.3, 0.4, 0.5]
edge = 0.01
position = [9, 8, 7]
rotation_deg = [0, 0, 30]
density_kg_per_m3 = 700
drag_per_s = 0.05
rolling_friction = 0.003
spin_friction = 0.004
[solid.pill]
shape = "capsule"
radius = 0.06
height = 0.2
mass_kg = 0.8
[solid.stone]
shape = "mesh"
mesh = "corner.obj"
scale = 0.5
[solid.hammer]
shape = "compound"
parts = [
    { shape = "cylinder", radius = 0.02, height = 0.3, density_kg_per_m3 = 600 },
    { shape = "box", size = [0.12, 0.05, 0.05], edge = 0.001, position = [0, 0.15, 0], mass_kg = 1.5, finish = { colour = [0, 0, 1] } },
    { shape = "mesh", mesh = "corner.obj", scale = 0.1, rotation_deg = [0, 0, 90] },
]
[[joint]]
a = "rope.rail@end"
b = "net.cradle@b"
kind = "spring"
stiffness_N_per_m = 50
damping_time_s = 7e-4
rest_length_m = 0.4
name = "peg"
break_N = 12
turns = 6
radius = 0.003
coil_radius = 0.02
finish = { colour = [1, 0, 0] }
[[joint]]
a = ["rope.rail@start", "rope.rail@50%"]
b = "net.cradle@a"
kind = "weld"
reach_m = 0.05
[[joint]]
a = "net.cradle@a"
b = "collider.ball"
kind = "rod"
place = [0, 1, 2.5]
place_in = "world"
[[joint]]
a = "solid.crate"
b = "solid.pill"
kind = "hinge"
place = [0.5, 1, 2]
axis = [0, 2, 0]
limits_deg = [-90, 180]
friction_N_m = 0.3
damping_N_m_s = 0.4
motor_rad_per_s = -2
motor_N_m = 6
touch = true
[[joint]]
a = "solid.stone"
b = "solid.pill"
kind = "ball"
place = [0, 1, 2]
axis = [1, 0, 0]
cone_deg = 90
[[joint]]
a = "solid.hammer"
b = "solid.pill"
kind = "slider"
place = [0, 1, 0]
axis = [1, 0, 0]
limits_m = [-1, 2]
friction_N = 0.5
damping_N_s_per_m = 0.6
motor_m_per_s = -0.7
motor_N = 8
[[seam]]
a = "cloth.flag.0@left"
b = "cloth.flag.1@right"
over_s = 2
start_s = 3
name = "side"
break_N = 13
turns = 1
radius = 0.001
coil_radius = 0.01
finish = { colour = [1, 1, 0] }
[[mass]]
target = "block.jelly@corners"
mass_kg = 1.5
[anchor.hand]
target = "cloth.flag.*@top-left"
at = [1, 2, 4]
stiffness_N_per_m = 60
damping_kg_per_s = 0.9
[collider.ball]
shape = "sphere"
position = [0, 1, 2]
rotation_deg = [0, 0, 90]
radius = 0.4
friction = 0.6
restitution = 0.5
rolling_friction = 0.001
spin_friction = 0.002
visible = false
finish = { colour = "#0000ff" }
[collider.body]
shape = "hull"
mesh = "square.obj"
scale = 0.02
[collider.floor]
shape = "plane"
normal = [0, 5, 0]
[collider.hero]
shape = "figure"
mesh = "arm.gltf"
animation = "bend"
start_s = 0.5
speed = 2
loop = false
[collider.lift]
shape = "box"
size = [1, 2, 3]
edge = 0.05
keys = [{ t = 0.5, position = [1, 0, 0], rotation_deg = [0, 180, 0], ease = "in" }, { t = 1 }]
[collider.post]
shape = "capsule"
radius = 0.1
height = 2.5
[collider.table]
shape = "compound"
parts = [{ shape = "box", size = [2, 0.1, 1], position = [0, 1, 0], rotation_deg = [90, 0, 0] }, { shape = "cone", radius = 0.2, height = 0.3 }, { shape = "hull", mesh = "square.obj", scale = 0.5 }]
[wind.breeze]
velocity = [6, 0, 1]
gust = { amplitude = 2.5, period_s = 1.7, length_m = 3, seed = 7 }
drag = 1.1
lift = 0.5
on = ["cloth.flag.*"]
[filling.foam]
in = ["block.jelly"]
pressure_Pa = 12
keeps = "volume"
bulk_modulus_Pa = 2e3
[camera.main]
fov_deg = 45
keys = [{ t = 0, eye = [1, 2, 3], target = [4, 5, 6], fov_deg = 30, ease = "hold" }, { t = 1, eye = [1, 2, 4], target = [4, 5, 6] }]
[camera.turning]
eye = [3, 2, 1]
target = [0, 1, 0.5]
orbit_period_s = 20
follow = "rope.rail"
follow_lag_s = 0.25
[lamp.rim]
direction = [2, -1, 0]
colour = [0.2, 0.4, 0.6]
intensity = 1.5
softness_deg = 18
shadow = false
[label.name]
of = "rope.rail"
size = 0.05
colour = "#ff0000"
align = "right"
plate = 0.4
[label.place]
text = "here"
at = [1, 2, 3]
[label.title]
text = "title"
screen = [0.1, 0.2]
from_s = 0.5
to_s = 1.5
[hand]
anywhere = true
strength_N_per_m = 150
damping_ratio = 0.4
[[at]]
t = 1
do = "grab"
id = "left"
target = "cloth.flag.0@bottom-right"
near = [1, 2, 3]
radius = 0.2
rigid = true
strength_N_per_m = 140
damping_ratio = 0.2
[[at]]
t = 1.5
do = "move"
id = "left"
to = [4, 5, 6]
over_s = 0.5
ease = "out"
[[at]]
t = 1.5
do = "move"
target = "collider.ball"
rotation_deg = [0, 90, 0]
[[at]]
t = 2.25
do = "hold"
target = "rope.rail@50%"
hold_on = "collider.ball"
[[at]]
t = 2.5
do = "push"
target = "rope.rail@50%"
impulse_Ns = [0, 1, 2]
[[at]]
t = 2
do = "cut"
target = "cloth.flag.1"
segment = [[0, 0.25], [0.5, 0.75]]
[[at]]
t = 2
do = "cut"
target = "block.jelly"
plane = [[1, 2, 3], [0, 2, 0]]
[[at]]
t = 3
do = "add-mass"
target = "net.cradle@b"
mass_kg = 0.5
[[at]]
t = 3
do = "ramp"
key = "wind.breeze.velocity"
to = [9, 8, 7]
[[at]]
t = 3.5
do = "grab"
id = "right"
target = "rope.rail@50%"
max_force_N = 30
[[check]]
that = "height(cloth.flag.*) > 0"
at = 2
[[check]]
that = "time >= 0"
from = 1
to = 3
[fit]
keys = ["solver.safety", "rope.rail.mass_kg"]
low = [0.5, 1e-3]
high = [1, 100]
[[fit.target]]
that = "lowest(cloth.flag.*)"
at = 2
value = 0.5
sigma = 0.01
[[fit.target]]
that = "time"
curve = "curve.csv"
[[golden]]
frames = [10, 20]
restart = true
debug = true
camera = "turning"
size = [320, 180]
[rope.winding]
ends = [[0, 5, 1], [1, 5, 1]]
through = [{ position = [0.4, 5.2, 1] }, { position = [0.6, 5, 1.3] }]
closed = true
bending_rigidity_N_m2 = 2e-6
rest_curved = true
)toml";

}  // namespace taut::scene
