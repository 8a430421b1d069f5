#!/usr/bin/python3
"""A closed diffuse sphere in front of a lamp that faces away from a wall: the wall receives what the sphere reflects, and nothing else."""
import os
import sys

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))
from ObjScene import ObjScene, grid_faces  # noqa: E402

RADIUS, CENTRE, LEVELS = 0.5, np.array([0, 1, 1.4]), 5


def icosphere(levels):
    """Unit sphere of 20 x 4^levels triangles, wound outward."""
    g = (1 + 5 ** 0.5) / 2
    points = [[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g],
              [0, -1, -g], [0, 1, -g], [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]]
    points = [np.array(p) / np.linalg.norm(p) for p in points]
    faces = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4],
             [11, 10, 2], [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8],
             [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]]
    for _ in range(levels):
        middle, finer = {}, []

        def midpoint(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                p = points[a] + points[b]
                middle[key] = len(points)
                points.append(p / np.linalg.norm(p))
            return middle[key]

        for a, b, c in faces:
            ab, bc, ca = midpoint(a, b), midpoint(b, c), midpoint(c, a)
            finer += [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        faces = finer
    return np.array(points), faces


scene = ObjScene("Closed diffuse sphere beside a lamp, near a wall", digits=5)
scene.material("Sphere", (0.8, 0.6, 0.3))
scene.material("Wall", (0.5, 0.5, 0.5))
scene.material("Lamp", (0, 0, 0), (20, 20, 20))
points, faces = icosphere(LEVELS)
scene.add("Sphere", "Sphere", CENTRE + RADIUS * points, faces)
wall = [[x, y, 0] for y in np.linspace(0, 2, 21) for x in np.linspace(-1.5, 1.5, 31)]
scene.add("Wall", "Wall", wall, grid_faces(21, 31))
scene.quad("Lamp", "Lamp", [[-0.8, 0.8, 0.3], [-0.4, 0.8, 0.3], [-0.4, 1.2, 0.3], [-0.8, 1.2, 0.3]], [0, 0, 1])
scene.camera = (2.2, 1.5, 3.2, -0.1, 0.95, 0.7, 40)
scene.write(FOLDER, "SphereByLamp")
