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

from make_models import HERE, assert_watertight, capsule, ellipsoid, project, smooth_union, surface_net

# ---- the skeleton: every joint has the axes of the world in the rest pose ----

ALONG_ARM = (math.cos(math.radians(40)), -math.sin(math.radians(40)), 0.0)
SHOULDER = np.array((0.172, 1.412, -0.012))
ELBOW = SHOULDER + 0.285 * np.array(ALONG_ARM)
WRIST = ELBOW + 0.25 * np.array(ALONG_ARM)
HIP, KNEE, ANKLE = np.array((0.092, 0.9, 0.0)), np.array((0.117, 0.495, 0.012)), np.array((0.127, 0.085, -0.018))
BALL = np.array((0.142, 0.02, 0.105))

# name, parent, place, and where the joint takes its parent's weight: across this direction, over this width.
CENTRE = [
    ("Hips", None, (0, 0.96, 0), None, None),
    ("Spine", "Hips", (0, 1.03, -0.005), (0, 1, 0), 0.16),
    ("Chest", "Spine", (0, 1.18, -0.01), (0, 1, 0), 0.16),
    ("Neck", "Chest", (0, 1.48, -0.016), (0, 1, 0.1), 0.08),
    ("Head", "Neck", (0, 1.56, 0), (0, 0.8, 0.6), 0.07),
]
LEFT = [
    ("Shoulder", "Chest", (0.045, 1.43, -0.01), (1, 0, 0), 0.13),
    ("Arm", "Shoulder", SHOULDER, (0.94, -0.34, 0), 0.13),
    ("ForeArm", "Arm", ELBOW, ALONG_ARM, 0.1),
    ("Hand", "ForeArm", WRIST, ALONG_ARM, 0.06),
    ("UpLeg", "Hips", HIP, (0.5, -0.85, 0), 0.16),
    ("Leg", "UpLeg", KNEE, (0, -1, 0), 0.16),
    ("Foot", "Leg", ANKLE, (0, -0.9, 0.45), 0.06),
    ("ToeBase", "Foot", BALL, (0, 0, 1), 0.05),
]
SIDES = {"Left": np.array((1, 1, 1)), "Right": np.array((-1, 1, 1))}


def skeleton():
    joints = [(n, p, np.array(x, float), d and np.array(d, float), w) for n, p, x, d, w in CENTRE]
    for side, flip in SIDES.items():
        for name, parent, place, across, width in LEFT:
            parent = parent if parent in ("Chest", "Hips") else side + parent
            joints.append((side + name, parent, np.array(place) * flip, np.array(across, float) * flip, width))
    return joints


JOINTS = skeleton()
NAMES = [joint[0] for joint in JOINTS]
PARENT = [NAMES.index(parent) if parent else -1 for _, parent, _, _, _ in JOINTS]
PLACE = np.array([joint[2] for joint in JOINTS])

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


def smooth(x):
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


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


# ---- poses: the hips and the two feet are given, the legs follow; arms point where they are told ----


def turned(axis, degrees):
    """The matrix of a turn about the axis x, y or z."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    m = np.eye(3)
    a, b = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    m[a, a], m[b, b], m[a, b], m[b, a] = c, c, -s, s
    return m


def from_to(u, v):
    """The least turn that brings one direction to the other."""
    u, v = u / np.linalg.norm(u), v / np.linalg.norm(v)
    x, y, z = np.cross(u, v)
    k = np.array(((0, -z, y), (z, 0, -x), (-y, x, 0)))
    return np.eye(3) + k + k @ k / (1.0 + u @ v)


def frame(first, second):
    first = first / np.linalg.norm(first)
    third = np.cross(first, second)
    third /= np.linalg.norm(third)
    return np.array((first, np.cross(third, first), third)).T


def leg_turns(thigh, shin, goal, sideways):
    """Inverse kinematics: the turns of thigh and knee that bring the ankle to the goal, seen from the hip joint."""
    # |thigh + Rx(angle) shin| = |goal| is a cos + b sin = c.
    a = thigh[1] * shin[1] + thigh[2] * shin[2]
    b = thigh[2] * shin[1] - thigh[1] * shin[2]
    c = (goal @ goal - thigh @ thigh - shin @ shin) / 2 - thigh[0] * shin[0]
    assert c < math.hypot(a, b), "a foot is out of reach"
    bend = turned("x", math.degrees(math.atan2(b, a) + math.acos(c / math.hypot(a, b))))
    return frame(goal, sideways) @ frame(thigh + bend @ shin, np.array((1.0, 0, 0))).T, bend


REST = {
    "hips": (0, 0, 0),  # shift
    "turn": (0, 0, 0),  # of the hips: yaw to the left, lean to the right, bow
    "torso": (0, 0, 0),  # the same against the hips
    "head": (0, 0, 0),  # the same against the torso
    "LeftArm": ALONG_ARM,  # directions, seen from the chest: outwards, up, forwards
    "LeftForeArm": ALONG_ARM,
    "RightArm": ALONG_ARM,
    "RightForeArm": ALONG_ARM,
    "LeftFoot": (*ANKLE, 0, 0, 0),  # the ankle, yaw, the pitch of the foot (toes down) and that of the toes against it
    "RightFoot": (*(ANKLE * SIDES["Right"]), 0, 0, 0),
}


def make_pose(**given):
    """The shift of the hips, and a matrix for each joint against its parent."""
    goal = {name: np.array(given.get(name, rest), float) for name, rest in REST.items()}

    def bent(name, share):
        yaw, lean, bow = goal[name] * share
        return turned("y", yaw) @ turned("z", -lean) @ turned("x", bow)

    local = {name: np.eye(3) for name in NAMES}
    local["Hips"] = hips = bent("turn", 1.0)
    local["Spine"] = local["Chest"] = bent("torso", 0.5)
    local["Neck"] = local["Head"] = bent("head", 0.5)
    for side, flip in SIDES.items():
        rest = np.array(ALONG_ARM) * flip
        arm = from_to(rest, goal[side + "Arm"] * flip)
        local[side + "Shoulder"] = shoulder = from_to(rest, rest + 0.22 * (arm @ rest - rest))
        local[side + "Arm"] = shoulder.T @ arm
        local[side + "ForeArm"] = from_to(rest, arm.T @ (goal[side + "ForeArm"] * flip))
        ankle, (yaw, pitch, toes) = goal[side + "Foot"][:3], goal[side + "Foot"][3:]
        hip = PLACE[0] + goal["hips"] + hips @ (HIP * flip - PLACE[0])
        sideways = turned("y", 0.6 * yaw + 0.4 * goal["turn"][0])[:, 0]
        thigh, knee = leg_turns((KNEE - HIP) * flip, (ANKLE - KNEE) * flip, ankle - hip, sideways)
        local[side + "UpLeg"], local[side + "Leg"] = hips.T @ thigh, knee
        local[side + "Foot"] = (thigh @ knee).T @ turned("y", yaw) @ turned("x", pitch)
        local[side + "ToeBase"] = turned("x", toes)
    return PLACE[0] + goal["hips"], np.array([local[name] for name in NAMES])


# ---- motions ----


def curve(keys, t):
    """Through keys (time, values …) without overshoot: the slope is nought at ends and extremes (Fritsch, Butland)."""
    times, values = np.array([k[0] for k in keys], float), np.array([k[1:] for k in keys], float)
    n = int(np.clip(np.searchsorted(times, t) - 1, 0, len(keys) - 2))
    rise = np.diff(values, axis=0) / np.diff(times)[:, None]

    def slope(i):
        if i in (0, len(keys) - 1):
            return np.zeros(values.shape[1])
        same = rise[i - 1] * rise[i] > 0
        return np.where(same, 2 * rise[i - 1] * rise[i] / np.where(same, rise[i - 1] + rise[i], 1.0), 0.0)

    return hermite(values[n], slope(n), values[n + 1], slope(n + 1), times[n + 1] - times[n], (t - times[n]))


def hermite(p, v, q, w, length, t):
    u = min(1.0, max(0.0, t / length))
    a, b = u * u * (3 - 2 * u), u * (1 - u)
    return p + (q - p) * a + length * b * ((1 - u) * v - u * w)


def stepping(side, steps, t):
    """A foot that stands, and goes in steps (from, to, x, z, yaw)."""
    x, y, z = ANKLE * SIDES[side]
    foot = np.array((x, z, 0.0))
    lift = 0.0
    for start, end, *goal in steps:
        u = min(1.0, max(0.0, (t - start) / (end - start)))
        foot = foot + (np.array(goal) - foot) * u**3 * (10 - 15 * u + 6 * u * u)
        lift += 16 * (u * (1 - u)) ** 2
    return (foot[0], y + 0.05 * lift, foot[1], foot[2], 14 * lift, 0.0)


def around(side, yaw):
    """Where a foot of the rest pose comes by a turn about the vertical axis; on the way a little wider."""
    wide = 1.0 if yaw % 180 == 0 else 1.2
    place = turned("y", yaw) @ (ANKLE * SIDES[side] * (wide, 1, 1))
    return (place[0], place[2], yaw)


WALK_SPEED, WALK_TIME, STANCE = 1.0, 1.1, 0.61


def walking_foot(t):
    """Ankle (y, z), pitch, toes: on the heel, flat, on the ball, and through the air."""
    heel = np.array((-ANKLE[1], -0.05))
    ball = BALL[1:] - ANKLE[1:] + np.array((-BALL[1], 0.0))

    def planted(u):
        z = ANKLE[2] + 0.5 * WALK_SPEED * WALK_TIME * STANCE - 0.01 - WALK_SPEED * WALK_TIME * u
        pitch = -16 * (1 - smooth(u / 0.1)) + 38 * max(0.0, (u - 0.34) / (STANCE - 0.34)) ** 2
        pivot = heel if pitch < 0 else ball
        turn = turned("x", pitch)[1:, 1:]
        y, z = np.array((ANKLE[1], z)) + pivot - turn @ pivot
        return np.array((y, z, pitch, -max(0.0, pitch)))

    u = t / WALK_TIME % 1.0
    if u < STANCE:
        return planted(u)
    e, air = 1e-5, 1.0 - STANCE
    off, on = planted(STANCE), planted(0.0)
    foot = hermite(off, (off - planted(STANCE - e)) / e, on, (planted(e) - on) / e, air, u - STANCE)
    foot[0] += 0.03 * math.sin(math.pi * (u - STANCE) / air) ** 2  # clear of the ground
    foot[3] = -max(0.0, off[2]) * (1 - smooth((u - STANCE) / air / 0.9))
    return foot


def walk(t):
    wave = lambda times, late=0.0: math.cos(2 * math.pi * (times * t / WALK_TIME - late))
    pose = {
        "hips": (0.016 * wave(1, 0.3), -0.036 - 0.016 * wave(2, 0.03), 0.0),
        "turn": (-6 * wave(1, 0.03), 3 * wave(1, 0.28), 2),
        "torso": (11 * wave(1, 0.04), -3.5 * wave(1, 0.28), 0),
        "head": (-5 * wave(1, 0.04), 0, -1),
    }
    for side, late in (("Left", 0.0), ("Right", 0.5)):
        y, z, pitch, toes = walking_foot(t - late * WALK_TIME)
        x = 0.098 if side == "Left" else -0.098
        pose[side + "Foot"] = (x, y, z, 3 if side == "Left" else -3, pitch, toes)
        swing = -wave(1, 0.04 + late)
        pose[side + "Arm"] = (0.36, -1, 0.02 + 0.36 * swing)
        pose[side + "ForeArm"] = (0.26, -1, 0.32 + 0.5 * -wave(1, 0.09 + late))
    return pose


def turn(t):
    yaw = lambda s: 360 * (s / 4) ** 3 * (10 - 15 * (s / 4) + 6 * (s / 4) ** 2)
    fine = np.linspace(0, 4, 4001)
    when = lambda degrees: float(np.interp(degrees, yaw(fine), fine))
    steps = {"Left": [], "Right": []}
    for n in range(6):
        for side, late in (("Left", 0), ("Right", 30)):
            end = 360 if n == 5 else 60 * n + 45 + late
            steps[side].append((when(60 * n + late), when(60 * n + late + 30), *around(side, end)))
    sway = math.sin(2 * math.pi * yaw(t) / 60) * math.sin(math.pi * t / 4) ** 2
    pose = {
        "hips": (0, -0.035 * math.sin(math.pi * t / 4) ** 2, 0),
        "turn": (yaw(t), 2 * sway, 0),
        "torso": curve([(0, 0, 0, 0), (0.9, 12, 0, 0), (2.6, 4, 0, 0), (3.4, -5, 0, 0), (4, 0, 0, 0)], t),
        "head": curve([(0, 0, 0, 0), (0.8, 22, 0, 0), (2.4, 10, 0, 0), (3.4, -6, 0, 0), (4, 0, 0, 0)], t),
    }
    for side, lift in (("Left", 0.05), ("Right", -0.05)):
        low = (0.5, -0.85, 0.12)
        out = (0.7, -0.72 + lift, 0.2)
        pose[side + "Arm"] = curve([(0, *ALONG_ARM), (0.9, *low), (2.1, *out), (3.2, *low), (4, *ALONG_ARM)], t)
        fore = [(0, *ALONG_ARM), (0.9, 0.35, -0.85, 0.4), (2.1, 0.5, -0.6, 0.6), (3.2, 0.4, -0.85, 0.3)]
        pose[side + "ForeArm"] = curve(fore + [(4, *ALONG_ARM)], t)
        pose[side + "Foot"] = stepping(side, steps[side], t)
    return pose


DANCE = {
    "hips": [
        (0, 0, 0, 0), (0.6, 0.035, -0.03, 0), (1.1, -0.03, -0.045, 0), (1.6, 0.14, -0.03, 0), (2.1, 0.2, -0.05, 0),
        (2.6, 0.38, -0.03, 0), (3.0, 0.44, -0.05, 0), (3.6, 0.3, -0.03, 0), (4.0, 0.22, -0.05, 0),
        (4.6, 0.07, -0.03, 0), (5.0, 0, -0.04, 0), (5.8, 0, -0.03, 0), (6.6, 0, -0.045, 0), (7.3, 0, -0.03, 0),
        (8.0, -0.02, -0.04, 0.0), (8.65, 0.0, -0.17, 0.2), (8.85, 0.0, -0.17, 0.2), (9.5, 0, -0.02, 0.01), (10, 0, 0, 0),
    ],
    "turn": [
        (0, 0, 0, 0), (0.6, 0, -5, 0), (1.1, 6, 5, 0), (1.6, -6, -5, 0), (2.1, 6, 5, 0), (2.6, -6, -5, 0),
        (3.0, 0, 4, 0), (3.6, 6, 5, 0), (4.0, -6, -5, 0), (4.6, 6, 5, 0), (5.0, 0, 0, 0), (6.45, 180, 0, 0),
        (6.6, 180, 0, 0), (8.0, 0, 0, 0), (8.65, 6, 0, 6), (8.85, 6, 0, 6), (9.5, 0, 0, 0), (10, 0, 0, 0),
    ],
    "torso": [
        (0, 0, 0, 0), (0.6, -6, 8, 2), (1.1, 8, -10, 0), (1.6, 4, 8, -4), (2.1, -10, -8, -4), (2.6, 6, 12, -6),
        (3.0, 0, 8, -6), (3.6, -8, -14, -2), (4.0, 12, 4, 0), (4.6, -12, -6, 0), (5.0, 14, 0, 2), (5.8, 8, 0, -4),
        (6.5, -14, 0, 0), (7.3, -8, 0, -4), (8.0, 0, 0, 2), (8.65, -14, 0, -8), (8.85, -14, 0, -8), (9.5, 0, 0, 0),
        (10, 0, 0, 0),
    ],
    "head": [
        (0, 0, 0, 0), (0.6, 10, 6, 4), (1.6, 18, -4, -4), (2.6, 10, 8, -10), (3.0, 0, 6, -10), (3.6, -20, -6, -4),
        (4.6, -14, 0, 0), (5.0, 18, 0, 0), (6.0, 12, 0, -4), (6.6, -20, 0, 0), (7.4, -12, 0, 0), (8.0, 0, 0, 4),
        (8.65, 8, 0, -10), (8.85, 8, 0, -10), (9.5, 0, 0, 0), (10, 0, 0, 0),
    ],
    "LeftArm": [
        (0, *ALONG_ARM), (0.7, 0.45, -0.85, 0.25), (1.6, 1, 0.1, 0.1), (2.2, 0.9, 0.4, 0.1), (2.9, 0.5, 1, 0.12),
        (3.5, 0.8, 0.75, 0.1), (4.2, 1, -0.05, 0.25), (5.0, 0.75, -0.6, 0.4), (5.8, 0.75, -0.55, 0.35),
        (6.5, 0.7, -0.7, 0.3), (7.3, 0.75, -0.55, 0.35), (8.0, 0.7, -0.6, 0.3), (8.7, 0.4, 0.8, 0.55),
        (8.85, 0.4, 0.8, 0.55), (9.45, 0.9, -0.3, 0.2), (10, *ALONG_ARM),
    ],
    "LeftForeArm": [
        (0, *ALONG_ARM), (0.7, 0.2, -0.75, 0.6), (1.6, 0.9, 0.2, 0.4), (2.2, 0.7, 0.7, 0.3), (2.9, 0.0, 1, 0.15),
        (3.5, 0.5, 0.9, 0.2), (4.2, 0.9, 0.0, 0.5), (5.0, 0.3, -0.4, 0.8), (5.8, 0.4, -0.3, 0.8),
        (6.5, 0.4, -0.6, 0.6), (7.3, 0.4, -0.3, 0.8), (8.0, 0.5, -0.4, 0.6), (8.7, 0.2, 0.95, 0.5),
        (8.85, 0.2, 0.95, 0.5), (9.45, 0.8, -0.2, 0.45), (10, *ALONG_ARM),
    ],
    "RightArm": [
        (0, *ALONG_ARM), (0.7, 0.55, -0.8, 0.0), (1.6, 1, -0.15, 0.15), (2.2, 0.9, 0.3, 0.1), (2.9, 0.5, 1, 0.12),
        (3.5, 1, 0.25, 0.1), (4.2, 1, 0.15, 0.15), (5.0, 0.75, -0.6, 0.4), (5.8, 0.75, -0.55, 0.35),
        (6.5, 0.75, -0.6, 0.4), (7.3, 0.75, -0.55, 0.35), (8.0, 0.7, -0.7, 0.2), (8.7, 0.95, -0.1, -0.25),
        (8.85, 0.95, -0.1, -0.25), (9.45, 0.8, -0.5, 0.05), (10, *ALONG_ARM),
    ],
    "RightForeArm": [
        (0, *ALONG_ARM), (0.7, 0.35, -0.85, 0.35), (1.6, 0.9, -0.1, 0.45), (2.2, 0.7, 0.6, 0.3), (2.9, 0.0, 1, 0.15),
        (3.5, 0.9, 0.4, 0.25), (4.2, 0.85, 0.35, 0.35), (5.0, 0.3, -0.4, 0.8), (5.8, 0.4, -0.3, 0.8),
        (6.5, 0.3, -0.4, 0.8), (7.3, 0.4, -0.3, 0.8), (8.0, 0.5, -0.6, 0.5), (8.7, 1, 0.05, -0.1),
        (8.85, 1, 0.05, -0.1), (9.45, 0.75, -0.5, 0.25), (10, *ALONG_ARM),
    ],
}
BESIDE, HALF = 0.22, 0.127
DANCE_STEPS = {
    "Left": [
        (1.15, 1.6, HALF + BESIDE, ANKLE[2], 0), (2.15, 2.6, HALF + 2 * BESIDE, ANKLE[2], 0),
        (3.6, 4.0, HALF + BESIDE, ANKLE[2], 0), (4.6, 5.0, HALF, ANKLE[2], 0), (5.05, 5.4, *around("Left", 60)),
        (5.7, 6.05, *around("Left", 140)), (6.25, 6.6, *around("Left", 180)), (6.95, 7.25, *around("Left", 90)),
        (7.55, 7.9, *around("Left", 0)), (8.1, 8.6, HALF, 0.42, 0), (8.9, 9.4, HALF, ANKLE[2], 0),
    ],
    "Right": [
        (1.65, 2.05, -HALF + BESIDE, ANKLE[2], 0), (2.65, 3.0, -HALF + 2 * BESIDE, ANKLE[2], 0),
        (3.1, 3.55, -HALF + BESIDE, ANKLE[2], 0), (4.1, 4.55, -HALF, ANKLE[2], 0), (5.35, 5.7, *around("Right", 100)),
        (6.0, 6.3, *around("Right", 180)), (6.65, 7.0, *around("Right", 130)), (7.2, 7.6, *around("Right", 40)),
        (7.75, 8.1, *around("Right", 0)),
    ],
}


def dance(t):
    pose = {name: curve(keys, t) for name, keys in DANCE.items()}
    for side, steps in DANCE_STEPS.items():
        pose[side + "Foot"] = stepping(side, steps, t)
    return pose


# ---- keys: sampled poses with their slopes, as CUBICSPLINE wants them ----


def quaternion(m):
    """x, y, z, w; of the four that stand in the products, the row with the largest."""
    xx, yy, zz = m[0, 0], m[1, 1], m[2, 2]
    rows = np.array(
        (
            (1 + xx - yy - zz, m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]),
            (m[0, 1] + m[1, 0], 1 - xx + yy - zz, m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]),
            (m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], 1 - xx - yy + zz, m[1, 0] - m[0, 1]),
            (m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1 + xx + yy + zz),
        )
    )
    q = rows[np.argmax(np.diag(rows))]
    return q / np.linalg.norm(q)


def make_clip(motion, length, loop):
    """Times, and for shift and turns: (key, in-slope / value / out-slope, …)."""
    times = np.linspace(0.0, length, round(15 * length) + 1)
    e = 1e-4

    def at(t):
        shift, turns = make_pose(**motion(t % length if loop else min(length, max(0.0, t))))
        return shift, np.array([quaternion(m) for m in turns])

    shifts, turns, before = [], [], None
    for t in times:
        three = [at(t - e), at(t), at(t + e)]
        for k in (1, 0, 2):  # q and -q are the same turn: the one near the last key
            near = before if k == 1 and before is not None else three[1][1]
            three[k] = (three[k][0], three[k][1] * np.where((three[k][1] * near).sum(1) < 0, -1, 1)[:, None])
        before = three[1][1]
        for keys, n in ((shifts, 0), (turns, 1)):
            slope = (three[2][n] - three[0][n]) / (2 * e) * (loop or 0 < t < length)
            keys.append((slope, three[1][n], slope))
    return times, np.array(shifts), np.array(turns)


def sample(keys, times, t):
    n = int(np.clip(np.searchsorted(times, t) - 1, 0, len(times) - 2))
    return hermite(keys[n, 1], keys[n, 2], keys[n + 1, 1], keys[n + 1, 0], times[n + 1] - times[n], t - times[n])


def joints_at(clip, t):
    """The matrix (3 by 4) of each joint from the rest pose, as a reader of the file gets it."""
    times, shifts, turns = clip
    world, origin = [], []
    for j, q in enumerate(sample(turns, times, t)):
        x, y, z, w = q / np.linalg.norm(q)
        m = 2 * np.array(
            (
                (0.5 - y * y - z * z, x * y - z * w, x * z + y * w),
                (x * y + z * w, 0.5 - x * x - z * z, y * z - x * w),
                (x * z - y * w, y * z + x * w, 0.5 - x * x - y * y),
            )
        )
        up = PARENT[j]
        world.append(world[up] @ m if j else m)
        origin.append(origin[up] + world[up] @ (PLACE[j] - PLACE[up]) if j else sample(shifts, times, t))
    return np.array([np.column_stack((m, o - m @ place)) for m, o, place in zip(world, origin, PLACE)])


def skin(vertices, joints, weights, matrices):
    blend = np.einsum("vk,vkij->vij", weights / 65535, matrices[joints])
    return np.einsum("vij,vj->vi", blend[:, :, :3], vertices) + blend[:, :, 3]


# ---- the file ----


def write_glb(vertices, triangles, joints, weights, clips):
    binary, views, accessors = bytearray(), [], []

    def add(array, kind, code, **more):
        """An accessor to the bytes of an array; code as OpenGL counts types."""
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes})
        accessors.append({"bufferView": len(views) - 1, "componentType": code, "count": len(array), "type": kind, **more})
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
