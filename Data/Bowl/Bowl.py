#!/usr/bin/python3
"""An open spherical bowl of half-angle 60 degrees, to be lit by a sky alone.

Under a constant sky of radiance L its inside receives E = pi L (1 - f) / (1 - rho f) everywhere, where f = (1 - cos 60) / 2 = 1/4
is the fraction of the sphere that the bowl covers: 6/7 pi L.
"""
import os
import sys

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(FOLDER))
from ObjScene import ObjScene, grid_faces  # noqa: E402

HALF_ANGLE, RINGS, SECTORS = np.radians(60), 40, 96

scene = ObjScene("Spherical bowl of radius 1 m and half-angle 60 degrees, no light of its own", digits=5)
scene.material("Bowl", (0.5, 0.5, 0.5))
rings = np.linspace(0, HALF_ANGLE, RINGS + 1)
sectors = np.linspace(0, 2 * np.pi, SECTORS + 1)
points = [[np.sin(t) * np.cos(p), 1 - np.cos(t), np.sin(t) * np.sin(p)] for t in rings for p in sectors]
scene.add("Bowl", "Bowl", points, grid_faces(RINGS + 1, SECTORS + 1))
scene.camera = (0, 2.2, 2.4, 0, 0.2, 0, 45)
scene.write(FOLDER, "Bowl")
