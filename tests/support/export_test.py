#!/usr/bin/env python3
"""What taut export writes, read by the programs that it is for: numpy, VTK, and Blender where it is installed.

export_test.py PROGRAM: the points of .npz and .csv are the same numbers; the meshes that VTK and Blender show, and those
of .usda, are where the points are; what cannot be written is refused and leaves nothing.
"""
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy
import vtkmodules.vtkCommonDataModel  # noqa: F401  # the classes of what the reader gives
import vtkmodules.vtkCommonExecutionModel  # noqa: F401
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkGLTFReader

from exporting import CUT, done, expect, refused, scene

SCENE = scene("eye = [0.5, 1.5, 4.0]\ntarget = [0.5, 1.5, 0.0]", has_ground=False)
FRAMES = (0, 13, 29)
# A float of 2 m is off by 1.2e-7 at most, and so is a difference of two that is added again.
FLOATS = 5e-7

BLENDER = """
import numpy
numpy.bool = bool  # which the importer of Debian 12 asks for, and numpy 1.24 has no longer
import bpy, sys
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = 60
bpy.ops.import_scene.gltf(filepath=sys.argv[-2])
flag = bpy.data.objects["cloth_flag"]
shots = []
for frame in %r:
    bpy.context.scene.frame_set(frame)
    shape = flag.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    x = numpy.empty(3 * len(shape.vertices), dtype=numpy.float32)
    shape.vertices.foreach_get("co", x)
    x = x.reshape(-1, 3)
    shots.append(x[:, [0, 2, 1]] * [1, 1, -1])  # its z is up
numpy.save(sys.argv[-1], numpy.array(shots))
""" % (FRAMES,)


def export(*arguments):
    return done("export", *arguments)


def blocks_of(reader, frame):
    reader.UpdateTimeStep(frame / 60)
    blocks = []
    blocks_left = reader.GetOutput().NewIterator()
    blocks_left.InitTraversal()
    while not blocks_left.IsDoneWithTraversal():
        blocks.append(blocks_left.GetCurrentDataObject())
        blocks_left.GoToNextItem()
    return blocks


def points_agree():
    export("small.toml", "-o", "small.glb", "--points", "small.npz")
    export("small.toml", "-o", "small.usda", "--points", "small.csv", "--of", "cloth.flag")
    export("small.toml", "--points", "places.csv", "--frames", "7", "--of", "rope.line@end,cloth.flag@(1,0)")
    with open("places.csv", newline="") as file:
        rows = list(csv.reader(file))
    expect([(row[2], row[0]) for row in rows[1:]] == [("rope.line@end", "7"), ("cloth.flag@(1,0)", "7")], str(rows))
    points = numpy.load("small.npz")
    x, v = points["cloth.flag.x"], points["cloth.flag.v"]
    expect(x.shape == (30, 99, 3) and v.shape == x.shape and x.dtype == numpy.float64, "shapes of .npz")
    expect(points["rope.line.x"].shape == (30, 7, 3), "every body is there")
    expect(list(points["frame"]) == list(range(30)) and numpy.array_equal(points["time"], points["frame"] / 60), "time")
    table = numpy.loadtxt("small.csv", delimiter=",", skiprows=1, usecols=(0, 1, 3, 4, 5, 6, 7, 8, 9))
    expect(numpy.array_equal(table[:, 3:6].reshape(x.shape), x), "x of .csv to the last bit")
    expect(numpy.array_equal(table[:, 6:9].reshape(x.shape), v), "v of .csv to the last bit")
    # Over two frames the middle of the flag goes as its velocity between says, to order 2: four times as near at half
    # of the time.
    off = []
    for fps in (240, 480):
        export("small.toml", "--points", "fine.npz", "-y", "--of", "cloth.*", "--fps", fps)
        fine = numpy.load("fine.npz")
        middle, speed = fine["cloth.*.x"].mean(axis=1), fine["cloth.*.v"].mean(axis=1)
        off.append(numpy.abs((middle[2:] - middle[:-2]) * (fps / 2) - speed[1:-1]).max() / numpy.abs(speed).max())
    expect(off[0] < 0.02 and 3.5 < off[0] / off[1] < 4.5, "velocities belong to positions: %s" % off)
    return x


def places(there, x):
    """Vertices in the order of the points, which is that of the first frame."""
    return numpy.argmin(((x[0][:, None] - there[None]) ** 2).sum(axis=2), axis=1)


def vtk_agrees(x):
    reader = vtkGLTFReader()
    reader.SetFileName("small.glb")
    reader.UpdateInformation()
    expect(reader.GetNumberOfAnimations() == 1 and abs(reader.GetAnimationDuration(0) - 29 / 60) < 1e-6, "29 frames")
    reader.EnableAnimation(0)
    reader.SetFrameRate(60)
    for frame in FRAMES:
        ball, flag, rope = blocks_of(reader, frame)[:3]
        there = vtk_to_numpy(flag.GetPoints().GetData())
        order = places(there, x) if frame == 0 else order
        there = there[order]
        expect(numpy.abs(there - x[frame]).max() < FLOATS, "VTK has the flag of frame %d" % frame)
        middle = numpy.mean([vtk_to_numpy(ball.GetPoints().GetData()).max(0)[0] - 0.2])
        expect(abs(middle - frame / 30) < 1e-5, "VTK has the ball of frame %d" % frame)
        # Normals are at right angles to the edges that meet, in the mean.
        normals = vtk_to_numpy(flag.GetPointData().GetNormals())[order]
        grid, n = there.reshape(9, 11, 3), normals.reshape(9, 11, 3)
        along, down = grid[1:-1, 2:] - grid[1:-1, :-2], grid[2:, 1:-1] - grid[:-2, 1:-1]
        face = numpy.cross(down, along)
        face /= numpy.linalg.norm(face, axis=2)[..., None]
        alike = (face * n[1:-1, 1:-1]).sum(axis=2)
        expect(alike.min() > 0.97, "VTK has normals of frame %d: %s" % (frame, alike.min()))


def usda_agrees(x):
    text = pathlib.Path("small.usda").read_text()
    flag = text[text.index('def Mesh "cloth_flag"') :]
    samples = flag[flag.index("point3f[] points.timeSamples") : flag.index("normal3f[] normals")]
    for frame in FRAMES:
        line = re.search(r"^ *%d: \[(.*)\],$" % frame, samples, re.M).group(1)
        there = numpy.array([float(n) for n in re.findall(r"[-0-9.e]+", line)]).reshape(-1, 3)
        order = places(there, x) if frame == 0 else order
        expect(numpy.abs(there[order] - x[frame]).max() < 5.2e-6, "USD has frame %d to five digits" % frame)


def blender_agrees(x):
    if shutil.which("blender") is None:
        print("skipped: Blender is not installed")
        return
    pathlib.Path("read.py").write_text(BLENDER)
    blender = subprocess.run(
        ["blender", "--background", "--factory-startup", "--python", os.path.abspath("read.py"), "--",
         os.path.abspath("small.glb"), os.path.abspath("shots.npy")],
        capture_output=True, text=True,
    )
    expect(os.path.exists("shots.npy"), "Blender reads it: " + blender.stdout + blender.stderr)
    for frame, there in zip(FRAMES, numpy.load("shots.npy")):
        order = places(there, x) if frame == 0 else order
        expect(numpy.abs(there[order] - x[frame]).max() < FLOATS, "Blender has frame %d" % frame)


def main():
    pathlib.Path("small.toml").write_text(SCENE)
    x = points_agree()
    vtk_agrees(x)
    usda_agrees(x)
    blender_agrees(x)
    lost = export("small.toml", "-o", "fewer.glb", "--every", "3", "--only", "cloth.flag")
    expect(re.search(r"19 frames left out, error .* mm rms, .* mm at worst \(cloth.flag", lost), "lost motion: " + lost)

    refused(2, [".usda", ".glb"], "small.toml", "-o", "small.obj")
    refused(2, [".npz", ".csv"], "small.toml", "--points", "small.txt")
    refused(2, ["cloth.flga"], "small.toml", "-o", "new.glb", "--only", "cloth.flga")
    refused(2, ["cloth.flag, rope.line, collider.ball, ground"], "small.toml", "-o", "new.glb", "--only", "*.x")
    refused(2, ["collider.ball"], "small.toml", "-o", "new.glb", "--only", "collider.bell")
    refused(2, ["cloth.flga"], "small.toml", "--points", "new.npz", "--of", "cloth.flga@left")
    refused(2, ["0-29"], "small.toml", "-o", "new.glb", "--frames", "0-99")
    refused(6, ["small.glb", "-y"], "small.toml", "-o", "small.glb")
    # Far above the largest step of such springs.
    refused(4, ["nothing was written", "--frames 0-"], "small.toml", "-o", "new.usda", "--points", "new.csv",
            "--set", "solver.dt=0.016", "--set", "material.silk.stretch_N_per_m=1e6")
    # The cut is made when tick 12 is over, and shows at frame 5, which is tick 15.
    pathlib.Path("torn.toml").write_text(SCENE + CUT)
    refused(3, ["new.glb: cloth.flag", "tick 13 ", ".usda", "--frames 0-4"], "torn.toml", "-o", "new.glb", "--fps", "20")
    export("torn.toml", "-o", "torn.usda", "--fps", "20")
    counts = re.search(r"int\[\] faceVertexCounts.timeSamples = {(.*?)}", pathlib.Path("torn.usda").read_text(), re.S)
    expect([int(n) for n in re.findall(r"(\d+): ", counts.group(1))] == [0, 5], "triangles change at frame 5 alone")


if __name__ == "__main__":
    sys.argv[1] = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        main()
        os.chdir("/")
