#!/usr/bin/env python3
"""Makes the meshes and pictures that the shipped scenes use: *.obj here and *.png in ../textures.

Plain Python, no packages. Run it from anywhere; it writes the same bytes each time.
The figure that moves, figure.glb, comes from make_figure.py.
Lengths in metres, y up. Faces are counter-clockwise seen from outside, or from above for the poncho.
"""
import math
import os
import struct
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
TEXTURES = os.path.join(HERE, "..", "textures")


def write_obj(name, comment, vertices, triangles, uv=None, uv_of=range(10**9)):
    """uv_of: which uv a vertex has; each its own if it is not given."""
    with open(os.path.join(HERE, name), "w", newline="\n") as out:
        out.write("# %s\n# %d vertices, %d triangles; made by make_models.py\n" % (comment, len(vertices), len(triangles)))
        for v in vertices:
            out.write("v %.5f %.5f %.5f\n" % tuple(v))
        for t in uv or []:
            out.write("vt %.5f %.5f\n" % tuple(t))
        for t in triangles:
            out.write("f " + " ".join("%d/%d" % (i + 1, uv_of[i] + 1) if uv else "%d" % (i + 1) for i in t) + "\n")


def edges_of(triangles):
    """Each directed edge once, or the mesh is not consistently oriented and edge-manifold."""
    edges = set()
    for t in triangles:
        for k in range(3):
            edge = (t[k], t[(k + 1) % 3])
            assert edge not in edges, "edge %s is used twice in one direction" % (edge,)
            edges.add(edge)
    return edges


def assert_watertight(vertices, triangles):
    edges = edges_of(triangles)
    assert all((b, a) in edges for a, b in edges), "the mesh has a hole"
    volume = 0.0
    for a, b, c in triangles:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = vertices[a], vertices[b], vertices[c]
        volume += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    assert volume > 0, "the faces look inwards"


# ---- the tailor's dummy: a smooth union of ellipsoids and capsules, meshed by surface nets ----


def ellipsoid(p, centre, radii):
    """About the distance; exact on the surface."""
    q = [(p[i] - centre[i]) / radii[i] for i in range(3)]
    k0 = math.sqrt(sum(x * x for x in q))
    k1 = math.sqrt(sum((q[i] / radii[i]) ** 2 for i in range(3)))
    return k0 * (k0 - 1.0) / k1 if k1 > 0 else -min(radii)


def capsule(p, a, b, radius_a, radius_b):
    ab = [b[i] - a[i] for i in range(3)]
    ap = [p[i] - a[i] for i in range(3)]
    t = sum(ab[i] * ap[i] for i in range(3)) / sum(x * x for x in ab)
    t = min(1.0, max(0.0, t))
    return math.sqrt(sum((ap[i] - t * ab[i]) ** 2 for i in range(3))) - (radius_a + t * (radius_b - radius_a))


def smooth_union(distances, width):
    low = distances[0]
    for d in distances[1:]:
        h = max(width - abs(low - d), 0.0) / width
        low = min(low, d) - h * h * width * 0.25
    return low


def dummy_distance(p):
    p = (abs(p[0]), p[1], p[2])
    body = smooth_union(
        [
            ellipsoid(p, (0.0, 0.93, 0.0), (0.168, 0.175, 0.118)),  # hips
            ellipsoid(p, (0.0, 1.10, 0.0), (0.126, 0.16, 0.095)),  # waist
            ellipsoid(p, (0.0, 1.27, 0.004), (0.165, 0.17, 0.115)),  # chest
            capsule(p, (0.0, 1.405, -0.004), (0.165, 1.385, -0.004), 0.058, 0.055),  # shoulders
            capsule(p, (0.185, 1.375, -0.002), (0.36, 1.10, 0.01), 0.056, 0.046),  # arm down to the elbow
            capsule(p, (0.0, 1.40, -0.008), (0.0, 1.58, 0.004), 0.056, 0.05),  # neck
        ],
        0.07,
    )
    head = smooth_union(
        [
            ellipsoid(p, (0.0, 1.695, 0.008), (0.076, 0.098, 0.092)),
            ellipsoid(p, (0.0, 1.645, 0.03), (0.058, 0.075, 0.066)),  # jaw
        ],
        0.05,
    )
    return smooth_union([body, head], 0.03)


def surface_net(distance, low, counts, cell):
    """One vertex in each cell that the surface crosses, one quad at each crossed edge of the grid."""
    nx, ny, nz = counts

    def at(i, j, k):
        return (low[0] + i * cell, low[1] + j * cell, low[2] + k * cell)

    value = {(i, j, k): distance(at(i, j, k)) for i in range(nx) for j in range(ny) for k in range(nz)}
    # Where a square of the grid is inside at two opposite corners only, two sheets would meet in an edge: fill it.
    squares = [((1, 0, 0), (0, 1, 0)), ((0, 1, 0), (0, 0, 1)), ((0, 0, 1), (1, 0, 0))]
    filled = True
    while filled:
        filled = False
        for i, j, k in value:
            for u, v in squares:
                across = [(i, j, k), (i + u[0] + v[0], j + u[1] + v[1], k + u[2] + v[2])]
                other = [(i + u[0], j + u[1], k + u[2]), (i + v[0], j + v[1], k + v[2])]
                inside = [value.get(c, 1.0) < 0 for c in across + other]
                if inside in ([True, True, False, False], [False, False, True, True]):
                    value[min(other if inside[0] else across, key=value.get)] = -1e-6
                    filled = True
    corners = [(a, b, c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
    pairs = [(a, b) for a in corners for b in corners if a < b and sum(x != y for x, y in zip(a, b)) == 1]
    number, vertices = {}, []
    for i in range(nx - 1):
        for j in range(ny - 1):
            for k in range(nz - 1):
                crossings = []
                for a, b in pairs:
                    va = value[i + a[0], j + a[1], k + a[2]]
                    vb = value[i + b[0], j + b[1], k + b[2]]
                    if (va < 0) != (vb < 0):
                        t = va / (va - vb)
                        crossings.append([a[n] + t * (b[n] - a[n]) for n in range(3)])
                if crossings:
                    mean = [sum(c[n] for c in crossings) / len(crossings) for n in range(3)]
                    number[i, j, k] = len(vertices)
                    vertices.append(project(distance, [at(i, j, k)[n] + mean[n] * cell for n in range(3)]))
    triangles = []
    for i, j, k in value:
        for axis in range(3):
            there = [i, j, k]
            there[axis] += 1
            there = tuple(there)
            if there not in value or (value[i, j, k] < 0) == (value[there] < 0):
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            quad = []
            for du, dv in ((0, 0), (-1, 0), (-1, -1), (0, -1)):
                c = [i, j, k]
                c[u] += du
                c[v] += dv
                quad.append(number[tuple(c)])
            if value[i, j, k] > 0:
                quad.reverse()
            # The shorter diagonal makes the rounder pair.
            d = [sum((vertices[quad[a]][n] - vertices[quad[a + 2]][n]) ** 2 for n in range(3)) for a in (0, 1)]
            if d[0] <= d[1]:
                triangles += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
            else:
                triangles += [(quad[1], quad[2], quad[3]), (quad[1], quad[3], quad[0])]
    return vertices, triangles


def project(distance, p):
    """Onto the surface, by two steps of Newton along the gradient."""
    e = 1e-5
    for _ in range(2):
        d = distance(p)
        g = []
        for n in range(3):
            q = list(p)
            q[n] += e
            g.append((distance(q) - d) / e)
        square = sum(x * x for x in g)
        p = [p[n] - d * g[n] / square for n in range(3)]
    return p


def make_dummy():
    # The grid is symmetric about x = 0 and its lines meet no flat part of the shape.
    cell = 0.029
    vertices, triangles = surface_net(dummy_distance, (-16.5 * cell, 0.727, -5.5 * cell), (34, 38, 12), cell)
    assert_watertight(vertices, triangles)
    write_obj("dummy.obj", "A tailor's dummy: torso, arms to the elbow, head. Watertight.", vertices, triangles)
    return len(vertices)


# ---- the poncho: rings about the hole, each with as many points as keep the triangles near equilateral ----


def make_poncho():
    hole, rim, spacing = 0.125, 0.66, 0.033
    rings = round((rim - hole) / (spacing * math.sqrt(3) / 2))
    vertices, uv, triangles, first = [], [], [], []
    for r in range(rings + 1):
        radius = hole + (rim - hole) * r / rings
        count = round(2 * math.pi * radius / spacing)
        first.append((len(vertices), count, 0.5 * (r % 2)))
        for n in range(count):
            angle = 2 * math.pi * (n + 0.5 * (r % 2)) / count
            x, z = radius * math.cos(angle), -radius * math.sin(angle)
            vertices.append((x, 0.0, z))
            uv.append((x + rim, z + rim))
    for inner, outer in zip(first, first[1:]):
        # Walk both rings side by side; the one that is behind takes the next step.
        i = o = 0
        while i < inner[1] or o < outer[1]:
            angle_i = (i + 1 + inner[2]) / inner[1]
            angle_o = (o + 1 + outer[2]) / outer[1]
            a, b = inner[0] + i % inner[1], outer[0] + o % outer[1]
            if i == inner[1] or (o < outer[1] and angle_o < angle_i):
                triangles.append((a, b, outer[0] + (o + 1) % outer[1]))
                o += 1
            else:
                triangles.append((a, b, inner[0] + (i + 1) % inner[1]))
                i += 1
    edges_of(triangles)
    write_obj("poncho.obj", "A round poncho with a hole for the neck, flat, seen from above.", vertices, triangles, uv)
    return len(vertices)


# ---- the curtain: sewn in pleats, uv along the flat cloth ----


def make_curtain():
    pleats, width, height, depth = 9, 2.7, 2.0, 0.055
    steps, rows = 9, 38
    columns = pleats * steps
    fine = 2000
    path = [(width * t / fine, depth * math.cos(2 * math.pi * pleats * t / fine)) for t in range(fine + 1)]
    length = [0.0]
    for a, b in zip(path, path[1:]):
        length.append(length[-1] + math.hypot(b[0] - a[0], b[1] - a[1]))
    across = []
    for c in range(columns + 1):
        s = length[-1] * c / columns
        n = next(n for n in range(1, fine + 1) if length[n] >= s - 1e-9)
        t = (s - length[n - 1]) / (length[n] - length[n - 1])
        across.append([path[n - 1][k] + t * (path[n][k] - path[n - 1][k]) for k in (0, 1)] + [s])
    vertices, uv, triangles = [], [], []
    for r in range(rows + 1):
        for x, z, s in across:
            vertices.append((x - width / 2, -height * r / rows, z))
            uv.append((s, height * r / rows))
    for r in range(rows):
        for c in range(columns):
            a = r * (columns + 1) + c
            b, d = a + 1, a + columns + 1
            # Cut one way and the other by turns, so that the cloth has no grain.
            if (r + c) % 2:
                triangles += [(a, d, d + 1), (a, d + 1, b)]
            else:
                triangles += [(a, d, b), (b, d, d + 1)]
    edges_of(triangles)
    write_obj("curtain.obj", "A curtain in nine pleats, hanging from y = 0; front to +z.", vertices, triangles, uv)
    return len(vertices), length[-1]


# ---- the cape: a part of a cone, in rows about the neck, in number of points like the rings of the poncho ----


def make_cape():
    top, length, steep, arc, spacing = 0.122, 1.0, math.radians(38), math.radians(250), 0.034
    rows = round(length / (spacing * math.sqrt(3) / 2))
    vertices, uv, triangles, first = [], [], [], []
    for r in range(rows + 1):
        down = length * r / rows
        radius = top + down * math.sin(steep)
        count = round(arc * radius / spacing)
        first.append((len(vertices), count))
        for n in range(count + 1):
            angle = -math.pi / 2 + arc * (n / count - 0.5)
            vertices.append((radius * math.cos(angle), 1.53 - down * math.cos(steep), radius * math.sin(angle)))
            uv.append((arc * radius * n / count, down))
    for inner, outer in zip(first, first[1:]):
        i = o = 0
        while i < inner[1] or o < outer[1]:
            a, b = inner[0] + i, outer[0] + o
            if i == inner[1] or (o < outer[1] and (o + 0.5) * inner[1] < (i + 0.5) * outer[1]):
                triangles.append((a, b + 1, b))
                o += 1
            else:
                triangles.append((a, a + 1, b))
                i += 1
    edges_of(triangles)
    write_obj("cape.obj", "A cape: a part of a cone about the y axis, open to +z.", vertices, triangles, uv)
    return len(vertices)


# ---- the ball: an icosahedron whose triangles are divided and drawn out to a sphere ----


def make_ball():
    golden = (1 + math.sqrt(5)) / 2
    vertices = [v for a in (-1, 1) for b in (-golden, golden) for v in ((0, a, b), (a, b, 0), (b, 0, a))]
    near = lambda i, j: abs(sum((vertices[i][n] - vertices[j][n]) ** 2 for n in range(3)) - 4) < 1e-9
    triangles = []
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                if near(i, j) and near(j, k) and near(i, k):
                    a, b, c = (vertices[m] for m in (i, j, k))
                    outwards = (
                        a[0] * (b[1] * c[2] - b[2] * c[1])
                        + a[1] * (b[2] * c[0] - b[0] * c[2])
                        + a[2] * (b[0] * c[1] - b[1] * c[0])
                    )
                    triangles.append((i, j, k) if outwards > 0 else (i, k, j))
    for _ in range(3):
        middle, finer = {}, []

        def between(a, b):
            edge = (min(a, b), max(a, b))
            if edge not in middle:
                middle[edge] = len(vertices)
                vertices.append(tuple(vertices[a][n] + vertices[b][n] for n in range(3)))
            return middle[edge]

        vertices = [tuple(x / math.sqrt(sum(y * y for y in v)) for x in v) for v in vertices]
        for a, b, c in triangles:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    vertices = [tuple(x / math.sqrt(sum(y * y for y in v)) for x in v) for v in vertices]
    assert_watertight(vertices, triangles)
    uv = [(v[1] + 1, v[0] + 1) for v in vertices]  # bands about the y axis
    write_obj("ball.obj", "A ball of radius 1 about the origin. Watertight.", vertices, triangles, uv)
    return len(vertices)


# ---- the cushion: two square foils that share their rim and lie on each other, barely apart ----


def make_cushion(side=1.0, cells=26, apart=0.008):
    def inside(i, j):
        return 0 < i < cells and 0 < j < cells

    numbers, vertices, uv = {}, [], []
    for face in (1, -1):
        for j in range(cells + 1):
            for i in range(cells + 1):
                u, v = i / cells - 0.5, j / cells - 0.5
                if face < 0 and not inside(i, j):
                    numbers[face, i, j] = numbers[1, i, j]
                    continue
                numbers[face, i, j] = len(vertices)
                vertices.append((side * u, face * 0.5 * apart * (1 - 4 * u * u) * (1 - 4 * v * v), side * v))
                uv.append((u + 0.5, 0.5 - v))
    triangles = []
    for face in (1, -1):
        for j in range(cells):
            for i in range(cells):
                a, b, c, d = (numbers[face, i + k % 2, j + k // 2] for k in range(4))
                # From the middle outwards, so that no triangle lies on the rim alone.
                halves = ((a, c, d), (a, d, b)) if (2 * i < cells) == (2 * j < cells) else ((a, c, b), (b, c, d))
                triangles += [t if face > 0 else t[::-1] for t in halves]
    assert_watertight(vertices, triangles)
    write_obj("cushion.obj", "Two foils that share their rim, flat. Watertight.", vertices, triangles, uv)
    return len(vertices)



# ---- the bear: sewn of plush, with eyes and a nose of their own that sit in hollows, a gap from the plush ----

BEAR_EYE, BEAR_NOSE = (0.05, 0.452, 0.124), (0.0, 0.414, 0.174)
BEAR_EYE_RADII, BEAR_NOSE_RADII = (0.0165, 0.0165, 0.0165), (0.024, 0.0165, 0.0165)
BEAR_GAP = 0.004


def bear_distance(p):
    p = (abs(p[0]), p[1], p[2])
    plush = smooth_union(
        [
            ellipsoid(p, (0.0, 0.175, 0.0), (0.135, 0.175, 0.118)),  # body
            ellipsoid(p, (0.0, 0.42, 0.022), (0.132, 0.112, 0.112)),  # head
            ellipsoid(p, (0.0, 0.39, 0.122), (0.058, 0.046, 0.05)),  # muzzle
            capsule(p, (0.115, 0.275, 0.01), (0.212, 0.185, 0.1), 0.047, 0.046),  # arm
            capsule(p, (0.078, 0.07, 0.05), (0.145, 0.063, 0.215), 0.066, 0.056),  # leg
            ellipsoid(p, (0.15, 0.075, 0.245), (0.056, 0.075, 0.042)),  # foot
        ],
        0.028,
    )
    plush = smooth_union([plush, ellipsoid(p, (0.108, 0.512, 0.004), (0.05, 0.05, 0.026))], 0.018)  # ear
    for centre, radii in ((BEAR_EYE, BEAR_EYE_RADII), (BEAR_NOSE, BEAR_NOSE_RADII)):
        plush = -smooth_union([-plush, ellipsoid(p, centre, [r + BEAR_GAP for r in radii])], 0.006)
    return plush


def bear_shade(p):
    """0 dark, 1/2 brown, 1 cream: where the texture has the colour."""
    p = (abs(p[0]), p[1], p[2])
    patches = [
        ellipsoid(p, (0.0, 0.385, 0.145), (0.06, 0.047, 0.045)),  # muzzle
        ellipsoid(p, (0.0, 0.175, 0.11), (0.085, 0.11, 0.05)),  # belly
        ellipsoid(p, (0.15, 0.075, 0.285), (0.042, 0.06, 0.022)),  # sole
        ellipsoid(p, (0.108, 0.512, 0.03), (0.032, 0.032, 0.02)),  # ear
    ]
    return 0.5 + 0.5 * min(1.0, max(0.0, 0.5 - min(patches) / 0.012))


def button(centre, radii, rings=8, around=16):
    """An ellipsoid whose poles look to the front and the back."""
    vertices = [(centre[0], centre[1], centre[2] + radii[2])]
    for r in range(1, rings):
        high, out = math.cos(math.pi * r / rings), math.sin(math.pi * r / rings)
        for n in range(around):
            angle = 2 * math.pi * n / around
            vertices.append((centre[0] + radii[0] * out * math.cos(angle), centre[1] + radii[1] * out * math.sin(angle),
                             centre[2] + radii[2] * high))
    vertices.append((centre[0], centre[1], centre[2] - radii[2]))
    triangles, last = [], len(vertices) - 1
    for n in range(around):
        m = (n + 1) % around
        triangles.append((0, 1 + n, 1 + m))
        for r in range(rings - 2):
            a, b = 1 + r * around, 1 + (r + 1) * around
            triangles += [(a + n, b + n, b + m), (a + n, b + m, a + m)]
        triangles.append((last - around + n, last, last - around + m))
    return vertices, triangles


def make_bear():
    cell, levels = 0.0152, 40
    vertices, triangles = surface_net(bear_distance, (-17.5 * cell, -1.3 * cell, -8.7 * cell), (36, 40, 30), cell)
    shades = [round(levels * bear_shade(v)) for v in vertices]
    for x in (-1, 1, 0):
        centre, radii = (BEAR_NOSE, BEAR_NOSE_RADII) if x == 0 else (BEAR_EYE, BEAR_EYE_RADII)
        new, faces = button((x * centre[0], centre[1], centre[2]), radii)
        triangles += [tuple(i + len(vertices) for i in t) for t in faces]
        vertices += new
        shades += [0] * len(new)
    assert_watertight(vertices, triangles)
    write_obj("bear.obj", "A bear that sits. Watertight, in four parts.", vertices, triangles,
              [(min(0.96, max(0.04, s / levels)), 0.5) for s in range(levels + 1)], shades)
    return len(vertices)


# ---- pictures ----


def write_png(name, size, colour):
    """colour(u, v) -> (r, g, b) 0 … 1; four samples a pixel."""
    rows = []
    for y in range(size):
        row = bytearray([0])
        for x in range(size):
            total = [0.0, 0.0, 0.0]
            for sx, sy in ((0.125, 0.375), (0.375, 0.875), (0.625, 0.125), (0.875, 0.625)):
                for n, c in enumerate(colour((x + sx) / size, (y + sy) / size)):
                    total[n] += c
            row += bytes(int(255 * t / 4 + 0.5) for t in total)
        rows.append(bytes(row))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(os.path.join(TEXTURES, name), "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)))
        out.write(chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


def hex_colour(text):
    return tuple(int(text[i : i + 2], 16) / 255 for i in (1, 3, 5))


def poncho_colour(u, v):
    """Rings of bands, with a row of zigzags and one of diamonds."""
    x, y = 2 * u - 1, 2 * v - 1
    r = math.hypot(x, y)
    turn = (math.atan2(y, x) / (2 * math.pi)) % 1.0
    night, rust, sand, teal, cream = map(hex_colour, ("#1f2a44", "#b5432a", "#dda448", "#1f7a78", "#f0e6d2"))
    wave = abs(2 * ((turn * 36) % 1.0) - 1)
    bands = [(0.22, sand), (0.28, rust), (0.30, cream), (0.345, night), (0.36, cream), (0.43, teal), (0.44, sand)]
    for outer, colour in bands:
        if r < outer:
            return colour
    if r < 0.56:
        return cream if r < 0.465 + 0.06 * wave else rust
    if r < 0.575:
        return sand
    if r < 0.68:
        wave = abs(2 * ((turn * 40) % 1.0) - 1)
        return sand if abs(r - 0.6275) < 0.04 * wave else night
    for outer, colour in [(0.695, sand), (0.77, rust), (0.785, cream), (0.83, teal), (0.845, cream)]:
        if r < outer:
            return colour
    if r < 0.94:
        wave = abs(2 * ((turn * 60) % 1.0) - 1)
        return rust if r < 0.868 + 0.05 * wave else night
    return sand if r < 0.965 else night


def flag_colour(u, v):
    """Blue between red: a coil spring carries a golden weight. The flag shows the upper two thirds of the square."""
    blue, white, gold, red = map(hex_colour, ("#163a6b", "#f3efe4", "#e6a823", "#c8372d"))
    middle, top, bottom, turns, half = 0.5, 0.12, 0.38, 5, 0.085

    def near(a, b, width):
        along = (b[0] - a[0], b[1] - a[1])
        t = ((u - a[0]) * along[0] + (v - a[1]) * along[1]) / (along[0] ** 2 + along[1] ** 2)
        t = min(1.0, max(0.0, t))
        return math.hypot(u - a[0] - t * along[0], v - a[1] - t * along[1]) < width / 2

    if math.hypot(u - middle, v - 0.505) < 0.085:
        return gold
    coil = [(middle, 0.075), (middle, top)]
    for n in range(2 * turns):
        coil.append((middle + (half if n % 2 else -half), top + (bottom - top) * (n + 0.5) / (2 * turns)))
    coil += [(middle, bottom), (middle, 0.45)]
    if any(near(a, b, 0.021) for a, b in zip(coil, coil[1:])) or near((0.37, 0.07), (0.63, 0.07), 0.026):
        return white
    if 0.27 < u < 0.73:
        return blue
    return white if 0.245 < u < 0.755 else red


def noise(u, v, cells, seed):
    """-1 … 1, smooth over a lattice of cells (across, down), repeating from edge to edge."""
    nx, ny = cells
    x, y = u * nx, v * ny
    i, j = int(x), int(y)
    sx, sy = ((3 - 2 * t) * t * t for t in (x - i, y - j))

    def at(i, j):
        h = (i % nx * 73856093 ^ j % ny * 19349663 ^ seed * 83492791) & 0xFFFFFFFF
        h = (h ^ h >> 15) * 0x2C1B3C6D & 0xFFFFFFFF
        h = (h ^ h >> 12) * 0x297A2D39 & 0xFFFFFFFF
        return (h ^ h >> 15) / 0x7FFFFFFF - 1

    upper = at(i, j) + sx * (at(i + 1, j) - at(i, j))
    lower = at(i, j + 1) + sx * (at(i + 1, j + 1) - at(i, j + 1))
    return upper + sy * (lower - upper)


def lawn_colour(u, v):
    """Short grass: blades of all shades, a few dry ones, and soft patches."""
    shade = 0.55 * noise(u, v, (150, 90), 1) + 0.45 * noise(u, v, (90, 150), 2) + 0.3 * noise(u, v, (9, 9), 3)
    dry = max(0.0, noise(u, v, (110, 70), 4) - 0.35) + max(0.0, 0.4 * noise(u, v, (7, 7), 5))
    low, high, straw = map(hex_colour, ("#2f4a1c", "#7c9a4a", "#a8a062"))
    part = min(1.0, max(0.0, 0.5 + 0.5 * shade))
    return tuple(low[n] + part * (high[n] - low[n]) + 0.5 * dry * (straw[n] - low[n]) for n in range(3))


def parquet_colour(u, v):
    """Sixteen rows of two oak boards each, staggered, with grain along them."""
    row = int(16 * v)
    along = (2 * u + (0.0, 0.62, 0.27, 0.81)[row % 4] + 0.5 * (row // 4 % 2)) % 2.0
    board = 2 * row + int(along)
    edge = min(16 * v % 1.0, 1 - 16 * v % 1.0) / 16, min(along % 1.0, 1 - along % 1.0) / 2
    tone = noise((board * 0.37) % 1.0, (board * 0.71) % 1.0, (61, 67), 6)
    grain = 0.6 * noise(u, v, (9, 300), 7 + board) + 0.4 * noise(u, v, (24, 130), 80 + board)
    light, dark = map(hex_colour, ("#a88a68", "#74563c"))
    part = min(1.0, max(0.0, 0.38 + 0.2 * tone + 0.22 * grain))
    if min(edge) < 0.0012:
        part = 1.25
    return tuple(light[n] + part * (dark[n] - light[n]) for n in range(3))


def bear_colour(u, v):
    dark, brown, cream = map(hex_colour, ("#120d0a", "#8a5a34", "#e9d3ab"))
    low, high, t = (dark, brown, 2 * u) if u < 0.5 else (brown, cream, 2 * u - 1)
    return tuple(low[n] + min(1.0, max(0.0, t)) * (high[n] - low[n]) for n in range(3))


if __name__ == "__main__":
    os.makedirs(TEXTURES, exist_ok=True)
    print("dummy", make_dummy(), "vertices")
    print("poncho", make_poncho(), "vertices")
    print("curtain", *make_curtain(), "vertices, metres of cloth")
    print("cape", make_cape(), "vertices")
    print("ball", make_ball(), "vertices")
    print("cushion", make_cushion(), "vertices")
    print("bear", make_bear(), "vertices")
    write_png("bear.png", 64, bear_colour)
    write_png("poncho.png", 768, poncho_colour)
    write_png("flag.png", 512, flag_colour)
    write_png("lawn.png", 384, lawn_colour)
    write_png("parquet.png", 512, parquet_colour)
