"""The skeleton of the figure and how it moves: joints, poses, and the motions of figure.glb sampled to keys.

make_figure.py writes what is here; it tells what each motion is.
"""
import math

import numpy as np

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
    ("Arm", "Shoulder", SHOULDER, (0.94, -0.34, 0), 0.16),
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
        local[side + "Shoulder"] = shoulder = from_to(rest, rest + 0.3 * (arm @ rest - rest))
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


def smooth(x):
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


def curve(keys, t):
    """Through keys (time, values …) without overshoot: the slope is nought at extremes (Fritsch and Butland)."""
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
        (8.0, -0.02, -0.04, 0), (8.65, 0, -0.2, 0.23), (8.85, 0, -0.2, 0.23), (9.5, 0, -0.02, 0.01), (10, 0, 0, 0),
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
        (6.5, 0.7, -0.7, 0.3), (7.3, 0.75, -0.55, 0.35), (7.95, 0.7, -0.6, 0.3), (8.7, 0.4, 0.8, 0.55),
        (8.85, 0.4, 0.8, 0.55), (9.45, 0.9, -0.3, 0.2), (10, *ALONG_ARM),
    ],
    "LeftForeArm": [
        (0, *ALONG_ARM), (0.7, 0.2, -0.75, 0.6), (1.6, 0.9, 0.2, 0.4), (2.2, 0.7, 0.7, 0.3), (2.9, 0.0, 1, 0.15),
        (3.5, 0.5, 0.9, 0.2), (4.2, 0.9, 0.0, 0.5), (5.0, 0.3, -0.4, 0.8), (5.8, 0.4, -0.3, 0.8),
        (6.5, 0.4, -0.6, 0.6), (7.3, 0.4, -0.3, 0.8), (7.95, 0.5, -0.4, 0.6), (8.7, 0.2, 0.95, 0.5),
        (8.85, 0.2, 0.95, 0.5), (9.45, 0.8, -0.2, 0.45), (10, *ALONG_ARM),
    ],
    "RightArm": [
        (0, *ALONG_ARM), (0.7, 0.55, -0.8, 0.0), (1.6, 1, -0.15, 0.15), (2.2, 0.9, 0.3, 0.1), (2.9, 0.5, 1, 0.12),
        (3.6, 1, 0.25, 0.1), (4.2, 1, 0.15, 0.15), (5.0, 0.75, -0.6, 0.4), (5.8, 0.75, -0.55, 0.35),
        (6.5, 0.75, -0.6, 0.4), (7.3, 0.75, -0.55, 0.35), (8.0, 0.7, -0.7, 0.2), (8.7, 0.95, -0.1, -0.25),
        (8.85, 0.95, -0.1, -0.25), (9.45, 0.8, -0.5, 0.05), (10, *ALONG_ARM),
    ],
    "RightForeArm": [
        (0, *ALONG_ARM), (0.7, 0.35, -0.85, 0.35), (1.6, 0.9, -0.1, 0.45), (2.2, 0.7, 0.6, 0.3), (2.9, 0.0, 1, 0.15),
        (3.6, 0.9, 0.4, 0.25), (4.2, 0.85, 0.35, 0.35), (5.0, 0.3, -0.4, 0.8), (5.8, 0.4, -0.3, 0.8),
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
        (7.55, 7.9, *around("Left", 0)), (8.1, 8.6, HALF, 0.5, 0), (8.9, 9.4, HALF, ANKLE[2], 0),
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
