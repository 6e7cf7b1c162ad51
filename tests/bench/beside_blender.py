# Runs inside Blender: the sheet of a scene file of taut, with Blender's own cloth; what is not set here is as Blender
# sets it. Prints the user processor time [s] of stepping through the frames, which leaves out Blender's start. After
# `--` stands the file, and then any of
#   cells=40  fps=60  quality=5 collision_quality=2  touch=all  meshes=FOLDER (every frame as OBJ; not timed)
import math
import os
import resource
import sys
import tomllib

import bpy
from mathutils import Vector

arguments = sys.argv[sys.argv.index("--") + 1 :]
given = dict(word.split("=", 1) for word in arguments[1:])
with open(arguments[0], "rb") as file:
    told = tomllib.load(file)
sheet = told["cloth"]["sheet"]
material = told["material"][sheet["material"]]
cells = int(given.get("cells", sheet["cells"][0]))
side = sheet["size"][0]  # [m]
fps = int(given.get("fps", told["run"]["fps"]))
frames = round(fps * told["run"]["seconds"])
assert sheet["size"] == [side, side] and sheet["cells"][0] == sheet["cells"][1]


def place(taut):  # whose y is up, as Blender's z is
    return Vector((taut[0], -taut[2], taut[1]))


def add_mesh(collider):  # an OBJ file beside the scene; its y is up too
    with open(os.path.join(os.path.dirname(arguments[0]), collider["mesh"])) as file:
        lines = [line.split() for line in file]
    corners = [place([float(x) * collider["scale"] for x in line[1:4]]) for line in lines if line[:1] == ["v"]]
    faces = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in lines if line[:1] == ["f"]]
    made = bpy.data.meshes.new("collider")
    made.from_pydata(corners, [], faces)
    body = bpy.data.objects.new("collider", made)
    body.location = place(collider["position"])
    scene.collection.objects.link(body)
    bpy.context.view_layer.objects.active = body


bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = fps
scene.frame_start, scene.frame_end = 1, frames + 1
scene.gravity = (0.0, 0.0, -9.81)

for collider in told["collider"].values():
    if collider["shape"] == "sphere":
        bpy.ops.mesh.primitive_uv_sphere_add(
            segments=64, ring_count=32, radius=collider["radius"], location=place(collider["position"])
        )
    elif collider["shape"] == "mesh":
        add_mesh(collider)
    else:
        assert collider["shape"] == "plane"
        bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.modifiers.new("Collision", "COLLISION")
    bpy.context.object.collision.thickness_outer = 0.002
    bpy.context.object.collision.cloth_friction = 100 * collider["friction"]

corner, across, down = (place(sheet[key]) for key in ("origin", "across", "down"))
lines = [side * k / cells for k in range(cells + 1)]
vertices = [corner + u * across.normalized() + v * down.normalized() for v in lines for u in lines]
quads = [
    (p, p + cells + 1, p + cells + 2, p + 1)
    for p in (j * (cells + 1) + i for j in range(cells) for i in range(cells))
]
mesh = bpy.data.meshes.new("sheet")
mesh.from_pydata(vertices, [], quads)
body = bpy.data.objects.new("sheet", mesh)
scene.collection.objects.link(body)
mesh.calc_loop_triangles()
triangles = [tuple(triangle.vertices) for triangle in mesh.loop_triangles]

cloth = body.modifiers.new("Cloth", "CLOTH")
cloth.point_cache.frame_start, cloth.point_cache.frame_end = 1, frames + 1
settings = cloth.settings
settings.quality = int(given.get("quality", 5))
# Blender's cloth falls by 9.81 mm in a frame squared, at whatever frame rate, and its springs pull as if a frame were a
# second: masses of 1000 times theirs, and frames of 1/√1000 s, have forces and times be what they are called.
settings.mass = 1000 * material["density_kg_per_m2"] * side**2 / len(vertices)  # of a vertex
settings.time_scale = math.sqrt(1000) / scene.render.fps
# The force by air is air_damping/100 times the speed, in those units: a rate [1/s] times the mass.
settings.air_damping = 100 * settings.mass * material["drag_per_s"] / math.sqrt(1000)
# Blender divides a stiffness by the mean length of a spring: these are forces [N].
settings.tension_stiffness = settings.compression_stiffness = material["stretch_N_per_m"] * side / cells
settings.shear_stiffness = material["shear_N_per_m"] * side / cells

# Of the sum of two distances Blender keeps 8/9. Frictions are in hundredths, between parts of a cloth in fiftieths.
meeting = cloth.collision_settings
meeting.use_collision = True
meeting.distance_min = sheet["thickness"] * 9 / 8 - 0.002
meeting.collision_quality = int(given.get("collision_quality", 2))
if given.get("touch", sheet.get("touch")) == "all":
    meeting.use_self_collision = True
    meeting.self_distance_min = sheet["thickness"] * 9 / 8
    meeting.self_friction = 50 * told["contact"]["friction"]


def places():
    evaluated = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return [vertex.co for vertex in evaluated.data.vertices]


def write(number):
    with open(f"{given['meshes']}/{number:04d}.obj", "w") as file:
        for x in places():
            file.write(f"v {x.x!r} {x.z!r} {-x.y!r}\n")
        for a, b, c in triangles:
            file.write(f"f {a + 1} {b + 1} {c + 1}\n")


spent = 0.0
scene.frame_set(1)
for frame in range(1, frames + 1):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    scene.frame_set(frame + 1)
    spent += resource.getrusage(resource.RUSAGE_SELF).ru_utime - before
    if "meshes" in given:
        write(frame)
print(f"spent: {spent:.3f}")
