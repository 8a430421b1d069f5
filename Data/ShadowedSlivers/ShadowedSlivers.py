#!/usr/bin/python3
"""A floor of 50 slivers, 50:1, across which the edge of a black screen throws a shadow at 45 degrees."""
import os
import sys

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))
from ObjScene import ObjScene, grid_faces  # noqa: E402

LENGTH, WIDTH, STRIPS = 2.0, 1.0, 25
HEIGHT, LAMP = 0.25, 0.04  # of the screen over the floor; across the lamp, 1 m over the floor

scene = ObjScene("Floor of 50 slivers, the edge of a shadow at 45 degrees to them")
scene.material("Floor", (0.6, 0.6, 0.6))
scene.material("Screen", (0, 0, 0))
scene.material("Lamp", (0, 0, 0), (100, 95, 85))
points = [[x, 0, z] for z in np.linspace(0, WIDTH, STRIPS + 1) for x in (LENGTH, 0)]
scene.add("Floor", "Floor", points, grid_faces(STRIPS + 1, 2))
x, z = LENGTH / 2, WIDTH / 2
scene.add("Screen", "Screen", [[x - 1, HEIGHT, z - 1], [x - 1, HEIGHT, z + 1], [x + 1, HEIGHT, z + 1]], [[0, 1, 2]])
lamp = [[x + i * LAMP / 2, 1, z + j * LAMP / 2] for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
scene.quad("Lamp", "Lamp", lamp, [0, -1, 0])
scene.camera = (1, 2.4, 2.2, 1, 0, 0.5, 40)
scene.write(FOLDER, "ShadowedSlivers")
