"""Polygon shapes for the default scene: each returns (points, faces), faces wound so that the front is outside."""
import numpy as np


def _grid(rows, columns, closed=False):
    """Quads of a grid of points stored row by row; closed joins the last column to the first."""
    faces = []
    for i in range(rows - 1):
        for j in range(columns if closed else columns - 1):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            faces.append([a, b, b + columns, a + columns])
    return faces


def flip(shape):
    points, faces = shape
    return points, [face[::-1] for face in faces]


def move(shape, offset=(0, 0, 0), turn=0, tilt=0):
    """Tilted about x, then turned about y (degrees), then moved."""
    points, faces = shape
    c, s = np.cos(np.radians(tilt)), np.sin(np.radians(tilt))
    points = np.asarray(points, float) @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    points = points @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])
    return points + np.asarray(offset, float), faces


def join(*shapes):
    points, faces, first = [], [], 0
    for p, f in shapes:
        points.append(np.asarray(p, float))
        faces += [[i + first for i in face] for face in f]
        first += len(p)
    return np.vstack(points), faces


def _cube_faces(u):
    """The six faces of a cube as grids over the parameters u in [-1,1]: (direction points, faces)."""
    shapes = []
    n = len(u)
    for axis in range(3):
        for side in (-1, 1):
            points = np.zeros((n * n, 3))
            a, b = np.meshgrid(u, u, indexing="ij")
            points[:, axis] = side
            points[:, (axis + 1) % 3] = a.ravel()
            points[:, (axis + 2) % 3] = b.ravel()
            faces = _grid(n, n)
            shapes.append((points, faces if side < 0 else [f[::-1] for f in faces]))
    return join(*shapes)


def soft_box(size, power=6, n=16):
    """A superellipsoid |x/a|^p + |y/b|^p + |z/c|^p = 1 of full extents `size`, centred at the origin."""
    u = np.tan(np.linspace(-1, 1, n + 1) * np.pi / 4)
    points, faces = _cube_faces(u)
    norm = (np.abs(points) ** power).sum(axis=1) ** (1 / power)
    return points / norm[:, None] * np.asarray(size, float) / 2, faces


def chamfered_box(low, high, radius=0.003, steps=1):
    """A box from `low` to `high` with its edges rounded in `steps` strips: long slivers, as CAD systems write them."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    radius = min(radius, 0.45 * (high - low).min())
    arc = np.tan(np.linspace(0, np.pi / 4, steps + 1)) if steps else np.zeros(1)
    n = 2 * len(arc)
    codes = np.concatenate([-np.arange(len(arc))[::-1] - 1, np.arange(len(arc)) + 1])
    points, faces = _cube_faces(codes.astype(float))
    # The row of a corner's arc, and the side that it belongs to, out of the code.
    sign = np.sign(points)
    for axis in range(3):
        for side in (0, 1):
            first = (2 * axis + side) * n * n
            block = slice(first, first + n * n)
            direction = np.zeros((n * n, 3))
            direction[:, axis] = sign[block, axis]
            for other in ((axis + 1) % 3, (axis + 2) % 3):
                code = np.abs(points[block, other]).astype(int) - 1
                direction[:, other] = sign[block, other] * arc[code]
            direction /= np.linalg.norm(direction, axis=1)[:, None]
            core = np.where(sign[block] < 0, low + radius, high - radius)
            points[block] = core + radius * direction
    return points, faces


def lathe(profile, segments=64):
    """A profile of (radius, height) turned about y; with heights rising along it the front looks outward."""
    profile = np.asarray(profile, float)
    angles = np.arange(segments) * 2 * np.pi / segments
    points = [[r * np.cos(a), y, r * np.sin(a)] for r, y in profile for a in angles]
    return np.array(points), [f[::-1] for f in _grid(len(profile), segments, closed=True)]


def smooth(knots, n):
    """n points along a Catmull-Rom curve through the knots."""
    knots = np.asarray(knots, float)
    padded = np.vstack([2 * knots[0] - knots[1], knots, 2 * knots[-1] - knots[-2]])
    out = []
    for t in np.linspace(0, len(knots) - 1, n):
        i = min(int(t), len(knots) - 2)
        f = t - i
        a, b, c, d = padded[i:i + 4]
        out.append(0.5 * (2 * b + (c - a) * f + (2 * a - 5 * b + 4 * c - d) * f ** 2 + (3 * b - a - 3 * c + d) * f ** 3))
    return np.array(out)


def sphere(radius, rows=24, segments=48):
    t = np.linspace(-np.pi / 2, np.pi / 2, rows + 1)
    return lathe(np.column_stack([radius * np.cos(t), radius * np.sin(t)]), segments)


def tube(path, radius, sides=12, closed=False):
    """A round tube along a path, its frame carried along by parallel transport; `radius` may vary along it."""
    path = np.asarray(path, float)
    n = len(path)
    radius = np.broadcast_to(radius, (n,))
    if closed:
        tangent = np.roll(path, -1, axis=0) - np.roll(path, 1, axis=0)
    else:
        tangent = np.gradient(path, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    axis = np.eye(3)[np.argmin(np.abs(tangent[0]))]
    frame = [np.cross(tangent[0], axis)]
    for t in tangent[1:]:
        v = frame[-1] - np.dot(frame[-1], t) * t
        frame.append(v / np.linalg.norm(v))
    frame = np.array(frame)
    frame[0] /= np.linalg.norm(frame[0])
    twist = np.zeros(n)
    if closed:  # Spread what the frame turned in one round, so that the ends meet.
        last = frame[-1] - np.dot(frame[-1], tangent[0]) * tangent[0]
        angle = np.arctan2(np.dot(np.cross(last, frame[0]), tangent[0]), np.dot(last, frame[0]))
        twist = angle * np.arange(n) / n
    points = []
    for i in range(n):
        other = np.cross(tangent[i], frame[i])
        for a in np.arange(sides) * 2 * np.pi / sides + twist[i]:
            points.append(path[i] + radius[i] * (np.cos(a) * frame[i] + np.sin(a) * other))
    faces = _grid(n, sides, closed=True)
    if closed:
        faces += [[(n - 1) * sides + j, (n - 1) * sides + (j + 1) % sides, (j + 1) % sides, j] for j in range(sides)]
    else:
        faces += [list(range(sides))[::-1], [(n - 1) * sides + j for j in range(sides)]]
    return np.array(points), faces


def torus_knot(size, thickness, p=2, q=3, n=280, sides=16):
    """A (p,q) torus knot standing on y = 0, about `size` across."""
    t = np.arange(n) * 2 * np.pi / n
    r = 2 + np.cos(q * t)
    path = np.column_stack([r * np.cos(p * t), r * np.sin(p * t), np.sin(q * t)]) * size / 6
    points, faces = tube(path, thickness, sides, closed=True)
    return points - [0, points[:, 1].min(), 0], faces


def pillow(width, depth, thickness, n=18):
    """A square pillow with pinched edges in the x-z plane, y up."""
    u = np.sin(np.linspace(-np.pi / 2, np.pi / 2, n + 1))
    a, b = np.meshgrid(u, u, indexing="ij")
    pinch = 1 - 0.06 * (a ** 2 + b ** 2 - 2 * a ** 2 * b ** 2)
    puff = ((1 - a ** 4) * (1 - b ** 4)) ** 0.6 * thickness / 2
    x, z = a * pinch * width / 2, b * pinch * depth / 2
    top = np.column_stack([x.ravel(), puff.ravel(), z.ravel()])
    bottom = top * [1, -1, 1]
    faces = [f[::-1] for f in _grid(n + 1, n + 1)]
    return join((top, [f[::-1] for f in faces]), (bottom, faces))


def sheet(function, rows, columns):
    """An open sheet: function(s, t) over the unit square."""
    points = [function(s, t) for s in np.linspace(0, 1, rows) for t in np.linspace(0, 1, columns)]
    return np.array(points), _grid(rows, columns)


def draped_cloth(radius, top, drop, folds, rows=28, columns=132, seed=1):
    """A round cloth over a round table: flat on top, falling in folds that widen downward. Front outside."""
    random = np.random.default_rng(seed)
    phase, strength = random.uniform(0, 2 * np.pi, 3), random.uniform(0.2, 0.5, 3)
    bend = 0.02

    def point(s, t):
        a = 2 * np.pi * t
        if s < 0.3:
            r = radius * s / 0.3
            return [r * np.cos(a), top, r * np.sin(a)]
        f = (s - 0.3) / 0.7
        fold = np.sin(folds * a + phase[0] + strength[0] * np.sin(3 * a + phase[1]))
        fold += strength[1] * np.sin((folds // 2) * a + phase[2])
        hem = drop * (1 + 0.03 * np.sin(4 * a))
        arc = f * hem
        turn = min(arc / bend, np.pi / 2)
        r = radius + bend * np.sin(turn) + f ** 1.2 * 0.055 * (fold + 1.2)
        y = top - bend * (1 - np.cos(turn)) - max(0, arc - bend * np.pi / 2)
        return [r * np.cos(a), y, r * np.sin(a)]

    return sheet(point, rows, columns)


def leaf(length, width, rise, droop, n=12, m=7):
    """A thin leaf from the origin along +x: lens-shaped, folded at its midrib, drooping towards the tip."""
    def point(s, t):
        half = width / 2 * np.sin(np.pi * min(1, s ** 0.8)) ** 0.9 + 0.001
        v = 2 * t - 1
        x = length * s
        y = rise * s - droop * s ** 2 + 0.25 * half * abs(v) + 0.006 * np.sin(9 * s) * v
        return [x, y, half * v]

    return sheet(point, n, m)
