#!/usr/bin/python3
"""A floor of 1000:1 slivers under a small lamp, with a plate between them that stands at 45 degrees to the slivers."""
import os
import sys

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))
from ObjScene import ObjScene, grid_faces  # noqa: E402

SIZE, STRIPS = 4.0, 1000

scene = ObjScene("Floor of 1000:1 slivers, shadow edges at 45 degrees to them")
scene.material("Floor", (0.6, 0.6, 0.6))
scene.material("Plate", (0.6, 0.2, 0.1))
scene.material("Lamp", (0, 0, 0), (100, 95, 85))
points = [[x, 0, z] for z in np.linspace(0, SIZE, STRIPS + 1) for x in (SIZE, 0)]
scene.add("Floor", "Floor", points, grid_faces(STRIPS + 1, 2))
h = SIZE / 2
scene.quad("Plate", "Plate", [[h + 0.5, 0.5, h], [h, 0.5, h + 0.5], [h - 0.5, 0.5, h], [h, 0.5, h - 0.5]], [0, 1, 0])
scene.quad("Lamp", "Lamp", [[h + x, 2, h + z] for x, z in ((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1))], [0, -1, 0])
scene.camera = (2, 3.2, 5.5, 2, 0.1, 2, 45)
scene.write(FOLDER, "Sliver")
