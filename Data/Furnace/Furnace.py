#!/usr/bin/python3
"""A furnace: the closed unit cube, every face emits exitance 1 W/m2 inward and reflects one half, so that B = 2 everywhere."""
import os
import sys

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))
from ObjScene import ObjScene, inward_cube  # noqa: E402

scene = ObjScene("Furnace: closed, exitance 1 W/m2 and reflectance 0.5 everywhere")
scene.material("Wall", (0.5, 0.5, 0.5), [1 / np.pi] * 3)
points, faces = inward_cube()
scene.add("Cube", "Wall", points, faces.values())
scene.camera = (0.5, 0.5, 0.95, 0.5, 0.5, 0, 75)
scene.write(FOLDER, "Furnace")
