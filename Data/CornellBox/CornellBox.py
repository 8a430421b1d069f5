#!/usr/bin/python3
"""The Cornell box from its measured coordinates and its published reflectances in RGB.

The measurements are in millimetres; the room is written in metres (0.55 m high). The front is open. The lamp fills a hole in
the ceiling, which is why the ceiling is a frame of four quadrilaterals.
"""
import os
import sys

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))
from ObjScene import ObjScene  # noqa: E402

METRES = 0.001
CENTRE = np.array([278, 274, 280])

scene = ObjScene("Cornell box, measured coordinates")
scene.material("White", (0.725, 0.71, 0.68))
scene.material("Red", (0.63, 0.065, 0.05))
scene.material("Green", (0.14, 0.45, 0.091))
scene.material("Lamp", (0, 0, 0), (17, 12, 4))


def wall(name, material, corners):
    corners = np.array(corners, float)
    scene.quad(name, material, corners * METRES, CENTRE - corners.mean(axis=0))


def block(name, top, height):
    """A box on the floor: four sides and the top, facing outward. It stands on the floor without a face below."""
    top = np.array(top, float)
    base = np.array([[x, 0, z] for x, z in top])
    roof = base + [0, height, 0]
    sides = [[i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)]
    points = np.vstack([base, roof])
    faces = sides + [[4, 5, 6, 7]]
    middle = points.mean(axis=0)
    outward = []
    for face in faces:
        p = points[face]
        n = np.cross(p[1] - p[0], p[2] - p[0])
        outward.append(face if np.dot(n, p.mean(axis=0) - middle) > 0 else face[::-1])
    scene.add(name, "White", points * METRES, outward)


wall("Floor", "White", [[552.8, 0, 0], [0, 0, 0], [0, 0, 559.2], [549.6, 0, 559.2]])
outer = [[556, 548.8, 0], [556, 548.8, 559.2], [0, 548.8, 559.2], [0, 548.8, 0]]
inner = [[343, 548.8, 227], [343, 548.8, 332], [213, 548.8, 332], [213, 548.8, 227]]
frame = [[i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)]
ceiling = np.array(outer + inner, float)
down = np.cross(ceiling[1] - ceiling[0], ceiling[5] - ceiling[0])[1] < 0
scene.add("Ceiling", "White", ceiling * METRES, frame if down else [f[::-1] for f in frame])
wall("Back", "White", [[549.6, 0, 559.2], [0, 0, 559.2], [0, 548.8, 559.2], [556, 548.8, 559.2]])
wall("Right", "Green", [[0, 0, 559.2], [0, 0, 0], [0, 548.8, 0], [0, 548.8, 559.2]])
wall("Left", "Red", [[552.8, 0, 0], [549.6, 0, 559.2], [556, 548.8, 559.2], [556, 548.8, 0]])
block("ShortBlock", [[130, 65], [82, 225], [240, 272], [290, 114]], 165)
block("TallBlock", [[423, 247], [265, 296], [314, 456], [472, 406]], 330)
wall("Lamp", "Lamp", inner)

scene.camera = (0.278, 0.273, -0.8, 0.278, 0.273, 0, 39.3)
scene.write(FOLDER, "CornellBox")
