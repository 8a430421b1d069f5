#!/usr/bin/python3
"""Two rooms joined by a doorway in a wall without thickness; the only lamp hangs in the first room."""
import os
import sys

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))
from ObjScene import ObjScene, grid_faces  # noqa: E402

CELL, LENGTH, HEIGHT, WIDTH = 0.25, 5.0, 2.5, 3.0
DOOR = (1.0, 2.0, 2.0)  # from z, to z, height

scene = ObjScene("Two rooms, one lamp, a doorway in a wall without thickness")
scene.material("Plaster", (0.7, 0.7, 0.7))
scene.material("Floor", (0.5, 0.35, 0.25))
scene.material("Partition", (0.35, 0.5, 0.7))
scene.material("Lamp", (0, 0, 0), (12, 11, 9))


def sheet(name, material, origin, u, v, keep=lambda p: True):
    """A rectangle in square cells with front along u x v; cells whose centre is not kept are left out."""
    origin, u, v = (np.array(a, float) for a in (origin, u, v))
    n, m = (int(round(np.linalg.norm(a) / CELL)) for a in (u, v))
    points = np.array([origin + u * i / n + v * j / m for j in range(m + 1) for i in range(n + 1)])
    faces = [f for f in grid_faces(m + 1, n + 1) if keep(points[f].mean(axis=0))]
    scene.add(name, material, points, faces)


def beside_door(p):
    return not (DOOR[0] < p[2] < DOOR[1] and p[1] < DOOR[2])


X, Y, Z = [LENGTH, 0, 0], [0, HEIGHT, 0], [0, 0, WIDTH]
sheet("Floor", "Floor", [0, 0, 0], Z, X)
sheet("Ceiling", "Plaster", [0, HEIGHT, 0], X, Z)
sheet("WestWall", "Plaster", [0, 0, 0], Y, Z)
sheet("EastWall", "Plaster", [LENGTH, 0, 0], Z, Y)
sheet("NorthWall", "Plaster", [0, 0, 0], X, Y)
sheet("SouthWall", "Plaster", [0, 0, WIDTH], Y, X)
sheet("Partition", "Partition", [LENGTH / 2, 0, 0], Y, Z, beside_door)
scene.quad("Lamp", "Lamp", [[1, 2.3, 1], [1.5, 2.3, 1], [1.5, 2.3, 1.5], [1, 2.3, 1.5]], [0, -1, 0])
scene.camera = (0.2, 1.6, 2.8, 3.2, 1.0, 1.0, 60)
scene.write(FOLDER, "TwoRooms")
