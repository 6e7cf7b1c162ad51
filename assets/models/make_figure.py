#!/usr/bin/env python3
"""Makes figure.glb: a mannequin with a skeleton, skin weights and three animations, a moving collider for clothes.

Needs numpy. Run it from anywhere; it writes the same bytes each time.
Metres, y up, 1.75 m tall, feet on y = 0, facing +z; the figure's left is +x. The mesh is one watertight surface.

    rest   arms 40 degrees below the horizontal, legs apart
    walk   1.1 s, a loop on a treadmill of 1 m/s: a planted foot moves by -1 m/s along z
    turn   4 s, a full turn to the left in small steps; from the rest pose and back to it
    dance  10 s, side steps, a half turn and back, a lunge; from the rest pose and back to it

The animations are CUBICSPLINE: values and slopes at 15 keys a second.
"""
import json
import math
import os
import struct

import numpy as np

from figure_motion import ANKLE, ELBOW, HIP, JOINTS, KNEE, NAMES, PARENT, PLACE, SHOULDER, SIDES, WALK_SPEED
from figure_motion import ALONG_ARM, WALK_TIME, WRIST, dance, joints_at, make_clip, smooth, turn, walk
from make_models import HERE, assert_watertight, capsule, ellipsoid, project, smooth_union, surface_net

# ---- the surface ----


def along_arm(p, start):
    """p seen from a place on the arm: along it, across it (up) and forwards."""
    x, y, z = (p[n] - start[n] for n in range(3))
    c, s = ALONG_ARM[:2]
    return (c * x + s * y, -s * x + c * y, z)


def torso_distance(p, q):
    return smooth_union(
        [
            ellipsoid(p, (0.0, 0.945, -0.004), (0.15, 0.12, 0.1)),  # hips
            ellipsoid(q, (0.07, 0.9, -0.04), (0.078, 0.09, 0.075)),  # seat
            ellipsoid(p, (0.0, 1.1, -0.006), (0.117, 0.18, 0.082)),  # waist
            ellipsoid(p, (0.0, 1.275, -0.012), (0.142, 0.155, 0.094)),  # chest
            ellipsoid(q, (0.068, 1.31, 0.038), (0.066, 0.066, 0.05)),  # breast
            capsule(p, (0.0, 1.425, -0.018), (0.15, 1.412, -0.014), 0.05, 0.046),  # shoulders
            capsule(p, (0.0, 1.49, -0.024), (0.11, 1.44, -0.018), 0.042, 0.036),  # slope of the neck
            capsule(p, (0.0, 1.44, -0.018), (0.0, 1.58, 0.004), 0.047, 0.044),  # neck
        ],
        0.07,
    )


def head_distance(p):
    cranium = ellipsoid(p, (0.0, 1.6625, -0.004), (0.074, 0.0865, 0.092))
    return smooth_union([cranium, ellipsoid(p, (0.0, 1.606, 0.026), (0.054, 0.088, 0.06))], 0.05)


def leg_distance(p, q):
    leg = smooth_union(
        [
            capsule(q, HIP, KNEE, 0.081, 0.04),
            capsule(q, KNEE, ANKLE, 0.036, 0.029),
            ellipsoid(q, (0.123, 0.36, -0.024), (0.043, 0.125, 0.043)),  # calf
        ],
        0.05,
    )
    foot = smooth_union(
        [
            capsule(p, (0.126, 0.03, -0.04), (0.14, 0.018, 0.09), 0.034, 0.036),  # heel to ball
            capsule(p, ANKLE, (0.138, 0.035, 0.07), 0.033, 0.029),  # instep
            ellipsoid(p, (0.146, 0.012, 0.12), (0.042, 0.026, 0.066)),  # toes
        ],
        0.03,
    )
    foot = -smooth_union([-foot, p[1]], 0.015)  # a flat sole
    return smooth_union([leg, foot], 0.035)


def arm_distance(p):
    upper, hand = along_arm(p, SHOULDER), along_arm(p, WRIST)
    arm = smooth_union(
        [
            ellipsoid(upper, (0.03, -0.002, 0.0), (0.09, 0.052, 0.053)),  # shoulder
            capsule(upper, (0.0, 0.0, 0.0), (0.285, 0.0, 0.0), 0.043, 0.029),
            capsule(upper, (0.285, 0.0, 0.0), (0.535, 0.0, 0.0), 0.028, 0.0255),
            ellipsoid(upper, (0.35, 0.0, 0.002), (0.09, 0.035, 0.038)),  # forearm
        ],
        0.04,
    )
    mitten = smooth_union(
        [
            ellipsoid(hand, (0.075, 0.0, 0.002), (0.072, 0.017, 0.041)),
            ellipsoid(hand, (0.125, -0.004, 0.0), (0.066, 0.014, 0.033)),  # fingers
            capsule(hand, (0.03, -0.004, 0.022), (0.088, -0.014, 0.05), 0.015, 0.012),  # thumb
        ],
        0.025,
    )
    return smooth_union([arm, mitten], 0.04)


def figure_distance(p):
    p = (abs(p[0]), p[1], p[2])
    q = (math.sqrt(p[0] ** 2 + 0.012**2), p[1], p[2])  # without a crease where the legs meet
    x, y = p[:2]
    # A part that is far away need not be measured.
    body = torso_distance(p, q) if x < 0.3 and y > 0.7 else 1.0
    body = smooth_union([body, leg_distance(p, q) if y < 1.1 and x < 0.3 else 1.0], 0.05)
    body = smooth_union([body, arm_distance(p) if x > 0.05 and y > 0.85 else 1.0], 0.045)
    return smooth_union([body, head_distance(p) if y > 1.4 else 1.0], 0.025)


def relax(vertices, triangles, passes):
    """Evens the edges: each vertex to the middle of its neighbours, then back onto the surface."""
    near = [set() for _ in vertices]
    for t in triangles:
        for k in range(3):
            near[t[k]].update(t)
    for _ in range(passes):
        middle = [[sum(vertices[m][n] for m in ring) / len(ring) for n in range(3)] for ring in near]
        vertices = [project(figure_distance, p) for p in middle]
    return vertices


def collapse(vertices, triangles, shortest):
    """Joins the ends of edges that are too short, as long as the surface stays a surface."""
    while True:
        near = [set() for _ in vertices]
        for t in triangles:
            for k in range(3):
                near[t[k]].update(t)
        edges = sorted((math.dist(vertices[a], vertices[b]), a, b) for a in range(len(near)) for b in near[a] if a < b)
        touched, into = set(), list(range(len(vertices)))
        for length, a, b in edges:
            if length > shortest:
                break
            if len(near[a] & near[b]) == 4 and not touched & (near[a] | near[b]):  # a, b and two more
                into[b] = a
                touched |= near[a] | near[b]
        if not touched:
            return vertices, triangles
        triangles = [tuple(into[n] for n in t) for t in triangles]
        triangles = [t for t in triangles if len(set(t)) == 3]
        used = sorted(set(n for t in triangles for n in t))
        number = {n: k for k, n in enumerate(used)}
        vertices = [vertices[n] for n in used]
        triangles = [tuple(number[n] for n in t) for t in triangles]


def make_surface():
    cell = 0.0215
    low = (-35.5 * cell, -0.47 * cell, -6.5 * cell)
    vertices, triangles = surface_net(figure_distance, low, (72, 84, 18), cell)
    vertices = relax(vertices, triangles, 3)
    vertices, triangles = collapse(vertices, triangles, 0.009)
    vertices = relax(vertices, triangles, 4)
    assert_watertight(vertices, triangles)
    return np.array(vertices), np.array(triangles)


# ---- weights: a joint takes a part of its parent's weight, so that they sum to 1 and stay in their limb ----


def beside(points, line):
    """The distance of each point from a line of segments."""
    least = np.full(len(points), np.inf)
    for a, b in zip(line, line[1:]):
        t = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
        least = np.minimum(least, np.linalg.norm(points - a - t[:, None] * (b - a), axis=1))
    return least


def make_weights(vertices):
    line = [np.array((0.0, 1.44, -0.01)), SHOULDER, ELBOW, WRIST, 2 * WRIST - ELBOW]
    in_arm = {side: 1 - smooth((beside(vertices * SIDES[side], line) - 0.06) / 0.05) for side in SIDES}
    part = np.zeros((len(JOINTS), len(vertices)))
    for j, (name, _, place, across, width) in enumerate(JOINTS[1:], 1):
        side = "Right" if name.startswith("Right") else "Left"
        shift = 0.055 * SIDES[side] * (1, 0, 0) if name.endswith("Shoulder") else 0.0
        part[j] = smooth((vertices - place - shift) @ across / np.linalg.norm(across) / width + 0.5)
        if name in ("Spine", "Chest"):  # arms hang beside the hips and yet belong to the chest
            part[j] = np.maximum(part[j], np.maximum(in_arm["Left"], in_arm["Right"]))
        if name.endswith("Shoulder"):  # not the side of the torso below the armpit
            part[j] *= in_arm[side]
        if name.endswith("UpLeg"):
            part[j] *= smooth((vertices * SIDES[side])[:, 0] / 0.04 + 0.5) * (1 - in_arm[side])
    weight = np.zeros_like(part)
    weight[0] = 1.0
    for j in range(len(JOINTS)):
        children = [c for c in range(len(JOINTS)) if PARENT[c] == j]
        if children:
            share = part[children] / np.maximum(1.0, part[children].sum(0))
            weight[children] = share * weight[j]
            weight[j] *= 1.0 - share.sum(0)
    joints = np.argsort(-weight, axis=0, kind="stable")[:4].T
    four = np.take_along_axis(weight.T, joints, 1)
    assert four.sum(1).min() > 0.99, "a vertex needs more than four joints"
    whole = np.floor(four / four.sum(1, keepdims=True) * 65535).astype(int)
    whole[:, 0] += 65535 - whole.sum(1)
    joints[whole == 0] = 0
    return joints, whole


def skin(vertices, joints, weights, matrices):
    blend = np.einsum("vk,vkij->vij", weights / 65535, matrices[joints])
    return np.einsum("vij,vj->vi", blend[:, :, :3], vertices) + blend[:, :, 3]


# ---- the file ----


def write_glb(vertices, triangles, joints, weights, clips):
    binary, views, accessors = bytearray(), [], []

    def add(array, kind, code, **more):
        """An accessor to the bytes of an array; code as OpenGL counts types."""
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes})
        what = {"bufferView": len(views) - 1, "componentType": code, "count": len(array), "type": kind}
        accessors.append({**what, **more})
        binary.extend(array.tobytes() + bytes(-array.nbytes % 4))
        return len(accessors) - 1

    def add_floats(array, kind):
        array = np.asarray(array, "<f4")
        flat = array.reshape(len(array), -1)
        ends = {} if kind == "VEC4" or kind == "MAT4" else {"min": flat.min(0).tolist(), "max": flat.max(0).tolist()}
        return add(array, kind, 5126, **ends)

    corner = vertices[triangles]
    normal = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normal, triangles[:, k], np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    inverse = np.tile(np.eye(4), (len(JOINTS), 1, 1))
    inverse[:, 3, :3] = -PLACE  # column by column
    primitive = {
        "attributes": {
            "POSITION": add_floats(vertices, "VEC3"),
            "NORMAL": add_floats(normal, "VEC3"),
            "JOINTS_0": add(joints.astype("u1"), "VEC4", 5121),
            "WEIGHTS_0": add(weights.astype("<u2"), "VEC4", 5123, normalized=True),
        },
        "indices": add(triangles.astype("<u2").reshape(-1), "SCALAR", 5123),
        "material": 0,
    }
    nodes = [{"name": "figure", "mesh": 0, "skin": 0}]  # joint j is node j + 1
    for j, (name, _, place, _, _) in enumerate(JOINTS):
        shift = place - PLACE[PARENT[j]] if j else place
        node = {"name": name, "translation": shift.tolist()}
        children = [c + 1 for c in range(len(JOINTS)) if PARENT[c] == j]
        nodes.append({**node, "children": children} if children else node)
    animations = []
    for name, (times, shifts, turns) in clips.items():
        samplers, channels = [], []
        at = add_floats(times, "SCALAR")
        for j in range(-1, len(JOINTS)):
            keys, path = (shifts, "translation") if j < 0 else (turns[:, :, j], "rotation")
            if j >= 0 and np.abs(keys[:, 1, :3]).max() < 1e-9:
                continue  # never turns
            channels.append({"sampler": len(samplers), "target": {"node": max(j, 0) + 1, "path": path}})
            output = add_floats(keys.reshape(-1, keys.shape[2]), "VEC3" if j < 0 else "VEC4")
            samplers.append({"input": at, "interpolation": "CUBICSPLINE", "output": output})
        animations.append({"name": name, "samplers": samplers, "channels": channels})
    wood = {"baseColorFactor": [0.8, 0.66, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 0.6}
    skins = [{"inverseBindMatrices": add_floats(inverse, "MAT4"), "skeleton": 1, "joints": list(range(1, len(nodes)))}]
    text = {
        "asset": {"version": "2.0", "generator": "make_figure.py"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": nodes,
        "meshes": [{"name": "figure", "primitives": [primitive]}],
        "skins": skins,
        "materials": [{"name": "wood", "pbrMetallicRoughness": wood}],
        "animations": animations,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(binary)}],
    }
    text = json.dumps(text, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(binary)
    assert size < 1.5e6, "the file is too large"
    with open(os.path.join(HERE, "figure.glb"), "wb") as out:
        out.write(struct.pack("<4sIIII", b"glTF", 2, size, len(text), 0x4E4F534A) + text)
        out.write(struct.pack("<II", len(binary), 0x004E4942) + binary)
    return size


# ---- what the file promises, measured on the moving surface at 60 frames a second ----


def least_distance(a, b):
    return math.sqrt(max(0.0, ((a * a).sum(1)[:, None] + (b * b).sum(1) - 2 * a @ b.T).min()))


def measure(vertices, triangles, joints, weights, clip):
    def of(*names):
        """The vertices that these joints hold."""
        return sum((weights * (joints == NAMES.index(name))).sum(1) for name in names) > 0.7 * 65535

    legs = {side: of(*(side + n for n in ("UpLeg", "Leg", "Foot", "ToeBase"))) for side in SIDES}
    arms = {side: of(side + "ForeArm", side + "Hand") for side in SIDES}
    trunk = of("Hips", "Spine", "Chest", "Neck", "Head") | legs["Left"] | legs["Right"]
    flanks = of("Hips", "Spine", "Chest") & (vertices[:, 1] < 1.27)
    elbows = of("LeftArm", "LeftForeArm") & (vertices[:, 0] > ELBOW[0] - 0.08)
    elbows |= of("RightArm", "RightForeArm") & (vertices[:, 0] < 0.08 - ELBOW[0])
    thighs = {side: legs[side] & (vertices[:, 1] < 0.72) for side in SIDES}
    pairs = {
        "forearms to trunk and legs": (arms["Left"] | arms["Right"], trunk),
        "elbows to flanks": (elbows, flanks),
        "forearm to forearm": (arms["Left"], arms["Right"]),
        "leg to leg": (thighs["Left"], thighs["Right"]),
    }
    area = lambda p: np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    volume = lambda p: (p[:, 0] * np.cross(p[:, 1], p[:, 2])).sum()
    found, before, rest = [], None, vertices[triangles]
    for t in np.arange(0.0, clip[0][-1] + 1e-9, 1 / 60):
        p = skin(vertices, joints, weights, joints_at(clip, t))
        now = {name: least_distance(p[a], p[b]) for name, (a, b) in pairs.items()}
        now["height over the ground"] = p[:, 1].min()
        now["volume"] = volume(p[triangles]) / volume(rest)
        now["area of a triangle"] = (area(p[triangles]) / area(rest)).min()
        now["speed"] = 0.0 if before is None else -60 * np.linalg.norm(p - before, axis=1).max()
        before = p
        found.append(now)
    least = {name: float(min(now[name] for now in found)) for name in found[0]}
    assert min(least[name] for name in pairs) > 0.03, "a limb comes too near: %s" % least
    assert least["height over the ground"] > -0.01 and least["volume"] > 0.95 and least["speed"] > -3, least
    return least


def assert_planted(vertices, joints, weights, clip):
    """The foot of the walk, flat from 0.12 to 0.34 of the time, goes with the treadmill and stays on it."""
    sole = (vertices[:, 1] < 0.003) & (vertices[:, 0] > 0)
    at = lambda t: skin(vertices[sole], joints[sole], weights[sole], joints_at(clip, t))
    for t in np.arange(0.12, 0.34, 0.01) * WALK_TIME:
        slide = (at(t + 1e-3) - at(t - 1e-3)) / 2e-3 + (0, 0, WALK_SPEED)
        assert np.abs(slide).max() < 0.02 and np.abs(at(t)[:, 1]).max() < 0.01, "the foot slides"


def assert_ends(clip, loop):
    """The ends meet, or are at rest in the rest pose."""
    times, shifts, turns = clip
    if loop:
        assert np.allclose(shifts[0], shifts[-1]) and np.allclose(np.abs((turns[0] * turns[-1]).sum(2))[1], 1)
    else:
        for n in (0, -1):
            rest = np.abs(turns[n, 1, :, 3])
            assert np.allclose(rest, 1) and np.allclose(shifts[n, 1], PLACE[0]), "not the rest pose"
            assert max(np.abs(shifts[n, 0]).max(), np.abs(turns[n, 0]).max()) < 1e-3, "not at rest"


if __name__ == "__main__":
    vertices, triangles = make_surface()
    joints, weights = make_weights(vertices)
    print("figure", len(vertices), "vertices,", len(triangles), "triangles")
    clips = {}
    for motion, length in ((walk, WALK_TIME), (turn, 4.0), (dance, 10.0)):
        clip = clips[motion.__name__] = make_clip(motion, length, motion is walk)
        assert_ends(clip, motion is walk)
        least = measure(vertices, triangles, joints, weights, clip)
        print(motion.__name__ + ", least:", ", ".join("%s %.3f" % item for item in least.items()))
    assert_planted(vertices, joints, weights, clips["walk"])
    print("figure.glb", write_glb(vertices, triangles, joints, weights, clips), "bytes")
