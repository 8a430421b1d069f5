#!/usr/bin/python3
"""The unit cube under a black ceiling of exitance 1 W/m2; the other faces reflect one half."""
import os
import sys

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))
from ObjScene import ObjScene, inward_cube  # noqa: E402

scene = ObjScene("Unit cube, black ceiling of exitance 1 W/m2, the rest reflects 0.5")
scene.material("Grey", (0.5, 0.5, 0.5))
scene.material("Ceiling", (0, 0, 0), [1 / np.pi] * 3)
points, faces = inward_cube()
ceiling = faces.pop("Ceiling")
scene.add("Walls", "Grey", points, faces.values())
scene.add("Ceiling", "Ceiling", points, [ceiling])
scene.camera = (0.5, 0.5, 0.95, 0.5, 0.45, 0, 75)
scene.write(FOLDER, "CubeRoom")
