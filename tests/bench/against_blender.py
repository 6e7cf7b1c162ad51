# Runs inside Blender: the cloth of against_blender.toml with Blender's own, 2 s at 24 frames a second, quality 5, no
# self-collision; what is not set here is as Blender sets it. Prints the user processor time of stepping through the
# frames, which leaves out Blender's start, and where the cloth is in the end. After `--` stands the air damping.
import resource
import sys

import bpy

points = 71  # along an edge
side = 1.8  # [m]
frames = 48

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = 24
scene.frame_start, scene.frame_end = 1, frames + 1
scene.gravity = (0.0, 0.0, -9.81)

bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.5, location=(0.0, 0.0, 0.6))
bpy.context.object.modifiers.new("Collision", "COLLISION")

bpy.ops.mesh.primitive_grid_add(
    x_subdivisions=points - 1, y_subdivisions=points - 1, size=side, location=(0.0, 0.0, 1.15)
)
sheet = bpy.context.object
assert len(sheet.data.vertices) == points**2
cloth = sheet.modifiers.new("Cloth", "CLOTH")
cloth.point_cache.frame_start, cloth.point_cache.frame_end = 1, frames + 1
cloth.collision_settings.use_collision = True
cloth.collision_settings.use_self_collision = False
settings = cloth.settings
settings.quality = 5
settings.air_damping = float(sys.argv[-1])
settings.mass = 0.15 * side**2 / points**2  # [kg] of a vertex
# Blender divides a stiffness by the mean length of a spring: these are forces [N], of 300 and 100 N/m.
settings.tension_stiffness = settings.compression_stiffness = 300.0 * side / (points - 1)
settings.shear_stiffness = 100.0 * side / (points - 1)

scene.frame_set(1)
before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
for frame in range(2, frames + 2):
    scene.frame_set(frame)
spent = resource.getrusage(resource.RUSAGE_SELF).ru_utime - before

vertices = sheet.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices
heights = [(sheet.matrix_world @ vertex.co).z for vertex in vertices]
print(f"cloth: {spent:.3f} s, middle at {heights[len(heights) // 2]:.3f} m, a corner at {heights[0]:.3f} m")
