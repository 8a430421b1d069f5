#!/usr/bin/python3
"""The default scene: a furnished living room, 5 x 4 x 2.8 m, with daylight from a window, a paper lantern and a table lamp.

Deterministic. The room stands on x in [0,5], z in [0,4]; the window is in the wall x = 0, the sofa before the wall z = 0.
Nothing overlaps in one plane: what stands on a surface keeps a gap of 1 mm.
"""
import os
import sys

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [FOLDER, os.path.dirname(FOLDER)]
from ObjScene import ObjScene  # noqa: E402
from Shapes import (chamfered_box, draped_cloth, flip, join, lathe, leaf, move, pillow, sheet, smooth,  # noqa: E402
                    soft_box, sphere, torus_knot, tube)

GAP = 0.001
RUG_TOP = 0.012
W, D, H = 5.0, 4.0, 2.8
WINDOW = (1.25, 2.75, 0.95, 2.25)  # z from, z to, y from, y to
REVEAL = 0.22

random = np.random.default_rng(2016)
scene = ObjScene("A living room by day")


def materials():
    m = scene.material
    m("WallPaint", (0.76, 0.72, 0.65))
    m("AccentWall", (0.22, 0.36, 0.36))
    m("CeilingPaint", (0.84, 0.83, 0.81))
    m("Skirting", (0.80, 0.79, 0.76))
    m("OakLight", (0.50, 0.34, 0.20))
    m("OakMiddle", (0.43, 0.28, 0.155))
    m("OakDark", (0.36, 0.225, 0.12))
    m("Walnut", (0.24, 0.135, 0.075))
    m("WindowFrame", (0.82, 0.82, 0.80))
    m("Linen", (0.74, 0.68, 0.56))
    m("Radiator", (0.80, 0.80, 0.78))
    m("Steel", (0.45, 0.45, 0.46))
    m("RugField", (0.66, 0.60, 0.50))
    m("RugBorder", (0.10, 0.16, 0.30))
    m("RugStripe", (0.60, 0.20, 0.12))
    m("Mustard", (0.66, 0.42, 0.09))
    m("Terracotta", (0.56, 0.19, 0.10))
    m("PillowTeal", (0.08, 0.32, 0.33))
    m("PillowCream", (0.78, 0.73, 0.62))
    m("Blanket", (0.70, 0.66, 0.62))
    m("Cloth", (0.80, 0.78, 0.74))
    m("Cobalt", (0.06, 0.13, 0.42))
    m("Celadon", (0.45, 0.60, 0.50))
    m("Bronze", (0.62, 0.30, 0.10))
    m("Marble", (0.80, 0.79, 0.77))
    m("Porcelain", (0.85, 0.84, 0.82))
    m("Orange", (0.80, 0.33, 0.04))
    m("Soil", (0.06, 0.045, 0.035))
    m("Pot", (0.60, 0.30, 0.19))
    m("Stem", (0.22, 0.28, 0.10))
    m("Leaf", (0.10, 0.30, 0.07))
    m("LeafYoung", (0.22, 0.44, 0.10))
    m("Paper", (0.88, 0.86, 0.80))
    m("PictureRed", (0.62, 0.12, 0.08))
    m("PictureBlue", (0.12, 0.25, 0.50))
    m("PictureOchre", (0.75, 0.52, 0.16))
    m("ShadeInside", (0.85, 0.82, 0.75))
    for i, kd in enumerate([(0.55, 0.10, 0.08), (0.10, 0.22, 0.42), (0.12, 0.34, 0.22), (0.70, 0.58, 0.30), (0.25, 0.10, 0.22),
                            (0.72, 0.70, 0.64), (0.15, 0.15, 0.16)]):
        m(f"Book{i}", kd)
    # Radiance, W/(m2 sr): a bright overcast sky, warm paper and a bulb.
    m("Daylight", (0, 0, 0), (2.5, 3.0, 3.6))
    m("Lantern", (0, 0, 0), (6.0, 4.5, 2.7))
    m("LampShade", (0, 0, 0), (2.2, 1.5, 0.75))
    m("Bulb", (0, 0, 0), (70, 52, 30))


def add(name, material, *shapes, **where):
    shape = join(*shapes)
    scene.add(name, material, *(move(shape, **where) if where else shape))


def box(low, high, radius=0.003, steps=1):
    return chamfered_box(low, high, radius, steps)


def cylinder(x, z, y0, y1, radius, segments=24):
    return move(lathe([(0, y0), (radius, y0), (radius, y1), (0, y1)], segments), (x, 0, z))


# ---------------------------------------------------------------------------------------------------------- the room

def floor():
    """Oak boards in three tones, staggered, in one plane without gaps."""
    width, length = 0.16, 1.25
    boards = {"OakLight": [], "OakMiddle": [], "OakDark": []}
    for row in range(int(D / width)):
        ends = np.arange(-length * random.random(), W + length, length).clip(0, W)
        for x0, x1 in zip(ends, ends[1:]):
            if x1 - x0 > 1e-6:
                z0, z1 = row * width, (row + 1) * width
                points = np.array([[x0, 0, z0], [x0, 0, z1], [x1, 0, z1], [x1, 0, z0]])
                boards[random.choice(list(boards), p=[0.3, 0.45, 0.25])].append((points, [[0, 1, 2, 3]]))
    for material, shapes in boards.items():
        add("Floor" + material, material, *shapes)


def walls():
    quad = scene.quad
    quad("Ceiling", "CeilingPaint", [[0, H, 0], [W, H, 0], [W, H, D], [0, H, D]], [0, -1, 0])
    quad("WallBack", "AccentWall", [[0, 0, 0], [W, 0, 0], [W, H, 0], [0, H, 0]], [0, 0, 1])
    quad("WallRight", "WallPaint", [[W, 0, 0], [W, 0, D], [W, H, D], [W, H, 0]], [-1, 0, 0])
    quad("WallFront", "WallPaint", [[0, 0, D], [W, 0, D], [W, H, D], [0, H, D]], [0, 0, -1])
    z0, z1, y0, y1 = WINDOW
    outer = [[0, 0, 0], [0, H, 0], [0, H, D], [0, 0, D]]
    hole = [[0, y0, z0], [0, y1, z0], [0, y1, z1], [0, y0, z1]]
    deep = [[-REVEAL, y, z] for _, y, z in hole]
    ring = [[i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)]
    scene.add("WallWindow", "WallPaint", outer + hole, ring)
    scene.add("Reveal", "WallPaint", hole + deep, ring)
    quad("Daylight", "Daylight", deep, [1, 0, 0])


def skirting():
    """A strip of 8 cm with a rounded top along every wall; open at the back, where the wall is."""
    arc = [(0.012 - 0.008 + 0.008 * np.cos(a), 0.08 - 0.008 + 0.008 * np.sin(a)) for a in np.linspace(0, np.pi / 2, 5)]
    profile = [(0.012, 0)] + arc + [(0, 0.08)]
    corners = np.array([[0, 0], [W, 0], [W, D], [0, D]], float)
    inward = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]], float)
    points = [[*(corners[k] + out * inward[k])] + [y] for out, y in profile for k in range(4)]
    points = [[x, y, z] for x, z, y in points]
    faces = [[4 * i + k, 4 * i + (k + 1) % 4, 4 * i + 4 + (k + 1) % 4, 4 * i + 4 + k]
             for i in range(len(profile) - 1) for k in range(4)]
    add("Skirting", "Skirting", flip((np.array(points), [f[::-1] for f in faces])))


def window():
    z0, z1, y0, y1 = WINDOW
    x0, x1, b, g = -0.15, -0.09, 0.06, GAP
    middle = (z0 + z1) / 2
    add("WindowFrame", "WindowFrame",
        box([x0, y0 + g, z0 + g], [x1, y0 + b, z1 - g], 0.005, 2),
        box([x0, y1 - b, z0 + g], [x1, y1 - g, z1 - g], 0.005, 2),
        box([x0, y0 + b + g, z0 + g], [x1, y1 - b - g, z0 + b], 0.005, 2),
        box([x0, y0 + b + g, z1 - b], [x1, y1 - b - g, z1 - g], 0.005, 2),
        box([x0, y0 + b + g, middle - 0.035], [x1, y1 - b - g, middle + 0.035], 0.005, 2),
        *[box([x0 + 0.015, 1.72, a], [x1 - 0.015, 1.75, c], 0.004, 2)
          for a, c in ((z0 + b + g, middle - 0.035 - g), (middle + 0.035 + g, z1 - b - g))])
    add("WindowSill", "Marble", box([0.002, y0 - 0.03, z0 - 0.08], [0.16, y0 - GAP, z1 + 0.08], 0.006, 3))
    rod_y, rod_x = 2.42, 0.10
    path = [[rod_x, rod_y, z] for z in (0.72, 3.28)]
    add("CurtainRod", "Steel", tube(path, 0.012, 16),
        *[move(sphere(0.025, 10, 20), (rod_x, rod_y, z)) for z in (0.72 - 0.027, 3.28 + 0.027)],
        *[tube([[0.002, rod_y - 0.03, z], [rod_x, rod_y - 0.03, z], [rod_x, rod_y - 0.014, z]], 0.007, 10)
          for z in (0.76, 3.24)])
    for side, a, c in (("Left", 0.80, 1.27), ("Right", 2.73, 3.20)):
        def fold(s, t, a=a, c=c):
            spread = 0.86 + 0.14 * s ** 2  # Gathered at the rod, wider at the hem.
            wave = np.sin(2 * np.pi * 6 * t + 0.7 * np.sin(4 * s + 5 * t))
            depth = (0.022 + 0.020 * s) * wave
            return [rod_x + 0.002 + depth, 2.40 - s * 2.37, (a + c) / 2 + (t - 0.5) * (c - a) * spread]
        add("Curtain" + side, "Linen", sheet(fold, 30, 84))


def radiator():
    """A panel radiator behind a grille of thin louvres: the slivers of a CAD model."""
    z0, z1 = 1.36, 2.64
    add("RadiatorPanel", "Radiator", box([0.035, 0.14, z0], [0.075, 0.72, z1], 0.006, 2))
    fins = [box([0.080, 0.16, z], [0.112, 0.70, z + 0.0012], 0.0004, 1) for z in np.arange(z0 + 0.01, z1 - 0.01, 0.05)]
    louvres = [box([0.086, 0.722, z0 + 0.004 + i * 0.032], [0.12, 0.727, z0 + 0.004 + i * 0.032 + 0.006], 0.0012, 1)
               for i in range(40)]
    rails = [box([0.080, 0.7215, z0], [0.085, 0.7285, z1], 0.001, 1), box([0.121, 0.7215, z0], [0.126, 0.7285, z1], 0.001, 1)]
    add("RadiatorGrille", "Radiator", *fins, *louvres, *rails)
    add("RadiatorPipes", "Steel", *[tube([[0.055, GAP, z], [0.055, 0.139, z]], 0.009, 12) for z in (z0 + 0.05, z1 - 0.05)])


def door():
    add("Door", "Skirting", box([3.35, 0.008, D - 0.045], [4.2, 2.05, D - 0.004], 0.004, 2))
    frame = [box([3.27, GAP, D - 0.03], [3.346, 2.13, D - 0.002], 0.004, 2), box([4.204, GAP, D - 0.03], [4.28, 2.13, D - 0.002], 0.004, 2),
             box([3.348, 2.054, D - 0.03], [4.202, 2.13, D - 0.002], 0.004, 2)]
    add("DoorFrame", "Skirting", *frame)
    add("DoorHandle", "Steel", tube([[3.42, 1.05, D - 0.046], [3.42, 1.05, D - 0.09], [3.54, 1.05, D - 0.09]], 0.009, 16))


# --------------------------------------------------------------------------------------------------------- furniture

def turned_legs(places, height, base):
    profile = [(0, base), (0.016, base), (0.017, base + 0.005), (0.028, height - 0.01), (0.028, height), (0, height)]
    return [move(lathe(profile, 20), (x, 0, z)) for x, z in places]


def upholstered(name, material, width, depth, seats, n, where):
    """A seat for `seats`, its back to -z: base, arms, cushions and back, 3 mm apart."""
    arm, g, base = 0.17, 0.003, 0.14
    inner = width - 2 * arm
    scene_parts = [move(soft_box([width - 0.01, 0.16, depth - 0.06], 10, n), (0, base + 0.08, 0))]
    for side in (-1, 1):
        scene_parts.append(move(soft_box([arm, 0.36, depth - 0.02], 5, n), (side * (width - arm) / 2, base + 0.16 + g + 0.18, 0)))
    each = inner / seats
    for i in range(seats):
        x = -inner / 2 + (i + 0.5) * each
        scene_parts.append(move(soft_box([each - 2 * g, 0.18, depth - 0.30], 5, n), (x, base + 0.16 + g + 0.09, 0.135)))
        scene_parts.append(move(soft_box([each - 2 * g, 0.50, 0.20], 4.5, n), (x, base + 0.19 + 0.25, -depth / 2 + 0.159), tilt=-9))
    for i, part in enumerate(scene_parts):
        add(f"{name}Part{i}", material, part, **where)
    legs = [(x * (width / 2 - 0.12), z * (depth / 2 - 0.12)) for x in (-1, 1) for z in (-1, 1)]
    add(name + "Legs", "Walnut", *turned_legs(legs, base - GAP, GAP), **where)


def sofa():
    centre = np.array([1.95, 0, 0.56])
    upholstered("Sofa", "Mustard", 2.1, 0.92, 2, 12, dict(offset=centre))
    pillows = [("PillowTeal", (1.43, 0.69, 0.455), 8, 68), ("PillowCream", (2.38, 0.69, 0.455), -6, 68)]
    for i, (material, offset, turn, tilt) in enumerate(pillows):
        add(f"Pillow{i}", material, move(pillow(0.42, 0.42, 0.13), offset, turn, tilt))
    blanket_over_arm(centre)


def blanket_over_arm(centre):
    """A woollen blanket over the sofa's right arm: follows the arm's cross-section 6 mm outside of it."""
    half = np.array([0.17, 0.36]) / 2
    middle = centre + [(2.1 - 0.17) / 2, 0.14 + 0.16 + 0.003 + 0.18, 0]

    def point(s, t):
        a = np.radians(-32 + 150 * s)
        d = np.array([np.cos(a), np.sin(a)])
        radius = (abs(d[0] / half[0]) ** 5 + abs(d[1] / half[1]) ** 5) ** -0.2
        lift = 0.008 + 0.004 * (1 + np.sin(2 * np.pi * 5 * t + 2 * s)) * (0.3 + abs(2 * s - 1))
        x, y = d * (radius + lift)
        return [middle[0] + x, middle[1] + y, middle[2] + 0.05 + (t - 0.5) * 0.42 + 0.012 * np.sin(5 * s)]

    add("Blanket", "Blanket", flip(sheet(point, 40, 40)))


def armchair():
    upholstered("Armchair", "Terracotta", 0.92, 0.84, 1, 12, dict(offset=[3.86, 0, 1.42], turn=-58))


def rug():
    """A woven rug of 12 mm, its pile slightly uneven, open below; border and stripes are materials of their own."""
    x0, x1, z0, z1 = 0.95, 3.05, 1.16, 2.56
    xs, zs = np.linspace(x0, x1, 85), np.linspace(z0, z1, 57)
    points = []
    for z in zs:
        for x in xs:
            edge = min(x - x0, x1 - x, z - z0, z1 - z)
            points.append([x, 0.0005 if edge < 1e-6 else RUG_TOP - 0.0015 * (1 + np.sin(37 * x) * np.sin(41 * z)) / 2, z])
    cells = {"RugField": [], "RugBorder": [], "RugStripe": []}
    nx, nz = len(xs) - 1, len(zs) - 1
    for i in range(nz):
        for j in range(nx):
            rim = min(i, j, nz - 1 - i, nx - 1 - j)
            kind = "RugBorder" if rim < 4 or rim == 8 else "RugStripe" if rim in (5, 6) else "RugField"
            if rim > 10 and (abs((i - nz / 2 + 0.5) * 1.0) + abs((j - nx / 2 + 0.5) * 1.0)) % 14 < 2:
                kind = "RugStripe"
            a = i * (nx + 1) + j
            cells[kind].append([a, a + nx + 1, a + nx + 2, a + 1])
    for kind, faces in cells.items():
        scene.add(kind, kind, points, faces)


def coffee_table():
    cx, cz, top = 1.95, 1.86, 0.40
    add("TableTop", "Walnut", box([cx - 0.55, top - 0.028, cz - 0.32], [cx + 0.55, top, cz + 0.32], 0.006, 4))
    profile = [(0, RUG_TOP + GAP), (0.009, RUG_TOP + GAP), (0.018, top - 0.03 - 0.002), (0.018, top - 0.029), (0, top - 0.029)]
    add("TableLegs", "Walnut", *[move(lathe(profile, 16), (cx + x * 0.47, 0, cz + z * 0.25)) for x in (-1, 1) for z in (-1, 1)])
    y = top + GAP
    add("Plinth", "Marble", box([cx - 0.40, y, cz - 0.10], [cx - 0.16, y + 0.045, cz + 0.10], 0.004, 3))
    knot = torus_knot(0.30, 0.024)
    add("TorusKnot", "Bronze", move(knot, (cx - 0.28, y + 0.046, cz), turn=40))
    for i, (material, w, d, h, turn) in enumerate([("Book1", 0.24, 0.17, 0.024, 12), ("Book3", 0.21, 0.15, 0.018, 26)]):
        add(f"TableBook{i}", material, move(box([-w / 2, 0, -d / 2], [w / 2, h, d / 2], 0.0025, 2),
                                            (cx + 0.02, y + 0.025 * i, cz + 0.19), turn))
    fruit_bowl(cx + 0.34, y, cz - 0.06)


def fruit_bowl(x, y, z):
    radius, thick = 0.15, 0.004
    t = np.radians(np.linspace(18, 80, 16))
    outside = [(radius * np.sin(a), radius * (1 - np.cos(a))) for a in t]
    inside = [((radius - thick) * np.sin(a), radius - (radius - thick) * np.cos(a)) for a in t[::-1]]
    foot = [(0, 0), (outside[0][0], 0)]
    floor_inside = [(0, thick)]
    add("FruitBowl", "Porcelain", lathe(foot + outside + inside + floor_inside, 56), offset=(x, y, z))
    ball = 0.036
    ring = radius - thick - ball - GAP
    places = [ring * np.array([np.sin(e) * np.cos(a), -np.cos(e), np.sin(e) * np.sin(a)])
              for e, a in ((np.radians(25.5), k * 2 * np.pi / 3 + 0.4) for k in range(3))]
    places.append(np.array([0, places[0][1] + 0.0605, 0]))
    add("Oranges", "Orange", *[move(sphere(ball, 16, 28), p) for p in places], offset=(x, y + radius, z))


def draped_table():
    """A small round table under a cloth, with the lamp."""
    x, z, radius, top = 3.46, 0.47, 0.26, 0.56
    add("SideTable", "Walnut", cylinder(x, z, top - 0.022, top, radius, 64), cylinder(x, z, 0.031, top - 0.023, 0.03, 24),
        cylinder(x, z, GAP, 0.03, 0.17, 48))
    add("TableCloth", "Cloth", move(draped_cloth(radius + 0.002, top + 0.002, 0.42, 14), (x, 0, z)))
    y = top + 0.003
    foot = smooth([(0.075, 0.004), (0.07, 0.02), (0.03, 0.045), (0.055, 0.10), (0.075, 0.15), (0.05, 0.21), (0.018, 0.25), (0.016, 0.29)], 44)
    profile = [(0, 0), (0.075, 0)] + [tuple(p) for p in foot] + [(0, 0.29)]
    add("LampFoot", "Celadon", move(lathe(profile, 48), (x, y, z)))
    low, high, r0, r1, thick = 0.30, 0.50, 0.165, 0.105, 0.002
    rows = np.linspace(0, 1, 9)
    outer = [(r0 + (r1 - r0) * f, low + (high - low) * f) for f in rows]
    inner = [(r - thick, h) for r, h in outer]
    add("LampShade", "LampShade", move(lathe(outer, 64), (x, y, z)))
    rims = [flip(lathe([outer[0], inner[0]], 64)), flip(lathe([inner[-1], outer[-1]], 64))]
    add("LampShadeInside", "ShadeInside", flip(lathe(inner, 64)), *rims, offset=(x, y, z))
    add("Bulb", "Bulb", move(sphere(0.03, 12, 20), (x, y + 0.38, z)))
    add("BulbHolder", "Steel", move(lathe([(0, 0.291), (0.012, 0.291), (0.012, 0.348), (0, 0.348)], 20), (x, y, z)))
    add("SmallBowl", "Cobalt", move(lathe([(0, 0), (0.025, 0)] + [tuple(p) for p in smooth([(0.028, 0.004), (0.05, 0.03), (0.056, 0.05)], 10)]
                                         + [tuple(p) for p in smooth([(0.053, 0.05), (0.047, 0.031), (0, 0.008)], 10)], 40),
                                   (x - 0.10, y, z + 0.16)))


def bookshelf():
    x0, x1, z0, z1, height = 3.92, 4.82, 0.02, 0.31, 1.95
    t = 0.022
    boards = [0.09, 0.47, 0.85, 1.23, 1.58, height - t]
    parts = [box([x0, GAP, z0], [x0 + t, height, z1], 0.002, 2), box([x1 - t, GAP, z0], [x1, height, z1], 0.002, 2)]
    parts += [box([x0 + t + GAP, y, z0 + 0.006], [x1 - t - GAP, y + t, z1 - 0.004], 0.002, 2) for y in boards]
    parts += [box([x0 + t + GAP, 0.093 + t, z0], [x1 - t - GAP, height - t - 0.003, z0 + 0.005], 0.001, 1)]
    add("Bookshelf", "OakLight", *parts)
    books = {}
    gaps = {1: (0.30, 0.62), 2: (0.0, 0.22), 3: (0.52, 0.84)}  # Room for ornaments, per shelf.
    for level, (y, above) in enumerate(zip(boards, boards[1:])):
        x = x0 + t + 0.008
        while True:
            thick, tall = random.uniform(0.016, 0.045), random.uniform(0.62, 0.86) * (above - y - t)
            deep = random.uniform(0.15, 0.21)
            if x + thick > x1 - t - 0.008:
                break
            hole = gaps.get(level)
            if hole and x - x0 - t < hole[1] - 1e-6 and x + thick - x0 - t > hole[0]:
                x = x0 + t + hole[1]
                continue
            inset = random.uniform(0.012, 0.03)
            shape = box([x, y + t + GAP, z1 - inset - deep], [x + thick, y + t + GAP + tall, z1 - inset], 0.0022, 1)
            books.setdefault(int(random.integers(0, 7)), []).append(shape)
            x += thick + random.uniform(0.001, 0.0025)
    for colour, shapes in sorted(books.items()):
        add(f"Books{colour}", f"Book{colour}", *shapes)
    add("ShelfGlobe", "PictureOchre", move(sphere(0.085, 24, 40), (x0 + t + 0.46, boards[1] + t + 0.114, 0.17)))
    add("GlobeFoot", "Walnut", move(lathe([(0, 0), (0.055, 0), (0.055, 0.008), (0.02, 0.016), (0.012, 0.027), (0, 0.027)], 40),
                                    (x0 + t + 0.46, boards[1] + t + GAP, 0.17)))
    jar = smooth([(0.05, 0.003), (0.075, 0.05), (0.08, 0.10), (0.05, 0.16), (0.03, 0.19), (0.042, 0.21)], 32)
    inner = smooth([(0.039, 0.21), (0.027, 0.188), (0.04, 0.165), (0, 0.15)], 12)
    add("ShelfJar", "Cobalt", move(lathe([(0, 0), (0.05, 0)] + [tuple(p) for p in jar] + [tuple(p) for p in inner], 44),
                                   (x0 + t + 0.11, boards[2] + t + GAP, 0.17)))
    add("ShelfKnot", "Celadon", move(torus_knot(0.20, 0.017, 3, 2, 180, 10), (x0 + t + 0.69, boards[3] + t + GAP, 0.17), turn=15))


# -------------------------------------------------------------------------------------------------------- ornaments

def lantern():
    """A ribbed paper globe on a cord; the paper emits from its outside."""
    x, y, z, radius, ribs = 2.15, 2.08, 1.75, 0.21, 14
    t = np.linspace(-np.pi / 2 + 0.22, np.pi / 2 - 0.22, ribs * 4 + 1)
    bulge = 1 - 0.018 * np.abs(np.cos(ribs * np.linspace(0, np.pi, len(t))))
    add("Lantern", "Lantern", move(lathe(np.column_stack([radius * bulge * np.cos(t), 0.96 * radius * np.sin(t)]), 36), (x, y, z)))
    top = y + 0.96 * radius * np.sin(t[-1])
    add("LanternCap", "Steel", move(lathe([(0, 0), (0.05, 0), (0.05, 0.004), (0.01, 0.02), (0, 0.02)], 32), (x, top + GAP, z)))
    add("LanternCord", "Steel", tube([[x, top + 0.022, z], [x, H - 0.026, z]], 0.003, 8))
    add("CeilingRose", "Porcelain", move(lathe([(0, 0), (0.03, 0), (0.05, 0.012), (0.05, 0.024), (0, 0.024)], 40), (x, H - 0.025, z)))


def floor_vase():
    outer = smooth([(0.085, 0.004), (0.11, 0.06), (0.155, 0.20), (0.165, 0.34), (0.12, 0.48), (0.06, 0.57), (0.052, 0.63), (0.085, 0.70)], 56)
    inner = smooth([(0.081, 0.70), (0.047, 0.63), (0.053, 0.57), (0.09, 0.50), (0, 0.42)], 22)
    profile = [(0, 0), (0.085, 0)] + [tuple(p) for p in outer] + [tuple(p) for p in inner]
    add("FloorVase", "Cobalt", move(lathe(profile, 56), (0.45, GAP, 2.98)))
    branches, buds = [], []
    for k in range(7):
        a, lean, tall = k * 0.9 + 0.3, random.uniform(0.10, 0.28), random.uniform(0.45, 0.75)
        path = [[(0.02 + lean * s ** 1.6) * np.cos(a + 0.3 * s), 0.47 + (0.23 + tall) * s, (0.02 + lean * s ** 1.6) * np.sin(a + 0.3 * s)]
                for s in np.linspace(0, 1, 14)]
        branches.append(tube(path, np.linspace(0.004, 0.0015, 14), 6))
        for s in (7, 9, 11, 13):
            buds.append(move(soft_box([0.022, 0.03, 0.022], 2.2, 3), np.array(path[s]) + [0, 0.018, 0]))
    add("Branches", "Walnut", *branches, offset=(0.45, GAP, 2.98))
    add("Buds", "PillowCream", *buds, offset=(0.45, GAP, 2.98))


def plant():
    x, z = 0.46, 0.50
    outer = smooth([(0.13, 0.003), (0.15, 0.10), (0.18, 0.28), (0.19, 0.34)], 30)
    inner = smooth([(0.178, 0.34), (0.168, 0.30)], 6)
    profile = [(0, 0), (0.13, 0)] + [tuple(p) for p in outer] + [tuple(p) for p in inner] + [(0.1665, 0.295)]
    add("Pot", "Pot", move(lathe(profile, 48), (x, GAP, z)))
    soil = sheet(lambda s, t: [0.1665 * s * np.cos(2 * np.pi * t), 0.2955 + 0.006 * (1 - s) * np.sin(9 * t * np.pi) * s,
                               0.1665 * s * np.sin(2 * np.pi * t)], 8, 49)
    add("Soil", "Soil", soil, offset=(x, GAP, z))
    stems, old, young = [], [], []
    for k in range(4):
        a0, tall = k * np.pi / 2 + 0.5, (1.02, 0.80, 1.18, 0.64)[k]
        bend = (0.10, 0.12, 0.06, 0.14)[k]
        path = np.array([[(0.03 + bend * s ** 2) * np.cos(a0), 0.285 + tall * s, (0.03 + bend * s ** 2) * np.sin(a0)]
                         for s in np.linspace(0, 1, 16)])
        stems.append(tube(path, np.linspace(0.009, 0.004, 16), 8))
        count = 9
        for i in range(count):
            s = 0.30 + 0.70 * i / (count - 1)
            turn = np.degrees(a0) + i * 137.5 + 20 * k
            length, width = (0.30 - 0.12 * s) * random.uniform(0.9, 1.1), (0.12 - 0.03 * s) * random.uniform(0.9, 1.1)
            base = path[min(15, int(s * 15))]
            # Leaves that would reach through a wall or the curtain turn towards the room instead.
            direction = np.array([np.cos(np.radians(turn)), -np.sin(np.radians(turn))])
            tip = base[[0, 2]] + direction * (length + 0.01) + [x, z]
            if tip[0] < 0.05 or tip[1] < 0.05 or (tip[0] < 0.2 and tip[1] > 0.75):
                turn += 180
            turn_radians = np.radians(turn)
            start = base + 0.0105 * np.array([np.cos(turn_radians), 0, -np.sin(turn_radians)])
            shape = move(leaf(length, width, 0.12 + 0.06 * s, 0.22 * random.uniform(0.7, 1.3)), start, turn)
            (young if i > 6 else old).append(shape)
    add("Stems", "Stem", *stems, offset=(x, GAP, z))
    add("Leaves", "Leaf", *old, offset=(x, GAP, z))
    add("YoungLeaves", "LeafYoung", *young, offset=(x, GAP, z))


def pictures():
    """Two framed reliefs above the sofa: flat discs and bars in layers of 2 mm."""
    for i, (x, y, w, h) in enumerate([(1.52, 1.62, 0.62, 0.80), (2.38, 1.62, 0.62, 0.80)]):
        b, z = 0.03, 0.003
        add(f"Frame{i}", "Walnut",
            box([x - w / 2, y - h / 2, z], [x + w / 2, y - h / 2 + b, z + 0.028], 0.003, 2),
            box([x - w / 2, y + h / 2 - b, z], [x + w / 2, y + h / 2, z + 0.028], 0.003, 2),
            box([x - w / 2, y - h / 2 + b + GAP, z], [x - w / 2 + b, y + h / 2 - b - GAP, z + 0.028], 0.003, 2),
            box([x + w / 2 - b, y - h / 2 + b + GAP, z], [x + w / 2, y + h / 2 - b - GAP, z + 0.028], 0.003, 2))
        add(f"Canvas{i}", "Paper", box([x - w / 2 + b + GAP, y - h / 2 + b + GAP, z], [x + w / 2 - b - GAP, y + h / 2 - b - GAP, z + 0.010], 0.001, 1))
        disc = [(0, 0), (1, 0), (1, 0.0015), (0, 0.0015)]

        def relief(name, material, r, dx, dy, layer, x=x, y=y, z=z, i=i):
            shape = lathe([(r * a, c) for a, c in disc], 72)
            add(f"Picture{i}{name}", material, move(move(shape, tilt=90), (x + dx, y + dy, z + 0.011 + 0.0025 * layer)))

        if i == 0:
            relief("Sun", "PictureRed", 0.13, 0.03, 0.14, 0)
            relief("Moon", "PictureOchre", 0.055, -0.12, -0.02, 0)
            bars = [box([x - 0.22, y - 0.30 + 0.05 * k, z + 0.011], [x + 0.22 - 0.05 * k, y - 0.275 + 0.05 * k, z + 0.0125], 0.0004, 1) for k in range(4)]
            add("Picture0Bars", "PictureBlue", *bars)
        else:
            for k, (r, m) in enumerate([(0.21, "PictureBlue"), (0.155, "PictureOchre"), (0.10, "PictureRed"), (0.05, "Paper")]):
                relief(f"Ring{k}", m, r, 0.02 * (k % 2), 0.015 * k - 0.02, k)


def main():
    materials()
    for build in (floor, walls, skirting, window, radiator, door, sofa, armchair, rug, coffee_table, draped_table, bookshelf,
                  lantern, floor_vase, plant, pictures):
        build()
    scene.camera = (4.8, 1.55, 3.88, 1.9, 0.92, 0.9, 52)
    scene.write(FOLDER, "DefaultScene")


main()
