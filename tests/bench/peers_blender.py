# Runs inside Blender, from peers.sh: strips of cloth that are clamped level, as row R1 of `taut reality` has them, with
# Blender's own cloth. Prints lines of peers.csv. After `--` stand a way of telling, numbers of cells along the strip,
# and Γ after Γ:   blender -b -P peers_blender.py -- angular 10,20 1,10,100
#
# How Blender is told the fabric, all of it from its force laws (source/blender/simulation/intern, 3.4), none fitted:
# - It scales gravity by 1/1000 and time by none. With masses in kg a frame is 1/√1000 s and forces are in kN.
# - A spring of a thread has the number `tension_stiffness` over the mean length of springs.
# - angular: an edge of length b turns its two faces, whose middles are a/2 away, by a force 0.1 `bending_stiffness` b θ
#   where they meet at the angle θ = κa. That is the moment B κ b where bending_stiffness = 20 B/a².
# - kept: the same with the number that is right for 10 cells, whatever the cells.
# - linear: a spring between points two cells apart. As long as it is short of its rest length by less than
#   3/bending_damping metres it is a plain one of bending_stiffness × bending_damping / (20 a). It has no stiffness in a
#   flat sheet, so no number is right. It gets the bending energy of the fabric at its own curvature, one over its
#   bending length ℓ = (B/w)^⅓: over the width k_b = 9Bℓ²/a⁴, as peers_bullet.cpp has it. Threads are 40 times as stiff;
#   softer ones would rather stretch.
import math
import resource
import sys

import bpy
from mathutils import Vector

LENGTH, DENSITY, GRAVITY = 0.1, 0.2, 9.81  # [m], [kg/m²], [m/s²]
FRAME = 1 / math.sqrt(1000)  # [s]
KILO = 1000  # N in Blender's unit of force
STEPS = 80  # a frame, the most; Blender looks through all frames before each
LONGEST = 60  # [s]


def strip(cells, model, bending, stretch, rate, frame):
    """Points at the middles of the cells, so that all have the same mass, and one before the clamp, which is in the
    middle of a face that is held. Forces in N, the rate of its drag in 1/s, a frame in s."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    a = LENGTH / cells
    places = [Vector(((i - 0.5) * a, side * a, 0)) for i in range(cells + 1) for side in (0, 1)]
    faces = [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(cells)]
    mesh = bpy.data.meshes.new("strip")
    mesh.from_pydata(places, [], faces)
    body = bpy.data.objects.new("strip", mesh)
    bpy.context.scene.collection.objects.link(body)
    body.vertex_groups.new(name="held").add(range(4), 1.0, "REPLACE")
    cloth = body.modifiers.new("Cloth", "CLOTH")
    cloth.collision_settings.use_collision = False
    settings = cloth.settings
    settings.vertex_group_mass = "held"
    settings.quality = STEPS
    settings.time_scale = frame / FRAME
    settings.mass = DENSITY * a * a / 2
    settings.tension_stiffness = settings.compression_stiffness = stretch / 2 * a / KILO
    settings.shear_stiffness = 0
    settings.tension_damping = settings.compression_damping = settings.shear_damping = 0
    settings.air_damping = 100 * settings.mass * rate * FRAME
    settings.bending_model = model
    settings.bending_damping = 0 if model == "ANGULAR" else 1
    settings.bending_stiffness = bending / KILO
    if not math.isclose(settings.bending_stiffness, bending / KILO, rel_tol=1e-5):
        sys.exit(f"peers_blender.py: Blender takes no bending_stiffness of {bending / KILO}")
    return body, cloth


def play(body, cloth, frame):
    """Height over width in the end, whether it is at rest, seconds played, seconds of processor time."""
    scene = bpy.context.scene
    scene.gravity = (0, 0, -GRAVITY)
    last = round(LONGEST / frame)
    scene.frame_start, scene.frame_end = 1, last
    cloth.point_cache.frame_start, cloth.point_cache.frame_end = 1, last
    scene.frame_set(1)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    look = max(1, round(0.25 / frame))
    seen, fastest, number = None, math.inf, 1
    while number < last and fastest > 1e-5 * LENGTH:
        number += 1
        scene.frame_set(number)
        if number % look == 0:
            evaluated = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
            places = [vertex.co.copy() for vertex in evaluated.data.vertices]
            fastest = max((p - q).length for p, q in zip(places, seen)) / (look * frame) if seen else math.inf
            seen = places
    spent = resource.getrusage(resource.RUSAGE_SELF).ru_utime - before
    end = seen[-1] + (seen[-1] - seen[-3]) / 2
    return -end.z / end.x, fastest <= 1e-5 * LENGTH, number * frame, spent


def measure(telling, cells, gamma):
    weight = DENSITY * GRAVITY
    rigidity = weight * LENGTH**3 / gamma
    a = LENGTH / cells
    stretch = 2.5e4 * DENSITY  # as R1 has it [N/m]
    if telling == "linear":
        own = (rigidity / weight) ** (1 / 3)
        spring = 9 * rigidity * own**2 / a**4 / 2  # of one of two rows; cells are square [N/m]
        stretch = max(stretch, 80 * spring)
        bending = 20 * a * spring
        # Implicit, and yet it never rests with steps that are much longer.
        step = 20
    else:
        bending = 20 * rigidity / (LENGTH / 10 if telling == "kept" else a) ** 2
        spring = bending / 10
        # Explicit: half its longest stable step.
        step = 1
    step /= 2 * math.sqrt(spring / (DENSITY * a * a / 2))
    frame = STEPS * min(FRAME / 10, step)
    rate = 2 * math.sqrt(GRAVITY / LENGTH) * max(3.516 / math.sqrt(gamma), 1.2)  # as R1 has it [1/s]
    name = "number kept" if telling == "kept" else telling
    model = "LINEAR" if telling == "linear" else "ANGULAR"
    droop, rests, seconds, spent = play(*strip(cells, model, bending, stretch, rate, frame), frame)
    print(
        f"csv:Blender {bpy.app.version[0]}.{bpy.app.version[1]} {name},{gamma:g},{cells},{droop:.6g},{int(rests)},{seconds:.2f},{spent:.3f},"
        f"bending_stiffness {bending / KILO:.5g}",
        flush=True,
    )


telling, cells_wanted, gammas = sys.argv[sys.argv.index("--") + 1 :]
for gamma in gammas.split(","):
    for cells in cells_wanted.split(","):
        measure(telling, int(cells), float(gamma))
