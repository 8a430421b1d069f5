#!/usr/bin/python3
"""A courtyard with a colonnade, to be lit by a sun and a sky: writes Courtyard.obj and .mtl into the folder given."""
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
DATA = os.path.join(FOLDER, "..", "..", "Data")
sys.path[:0] = [DATA, os.path.join(DATA, "DefaultScene")]
from ObjScene import ObjScene  # noqa: E402
from Shapes import chamfered_box, lathe, move, smooth, sphere  # noqa: E402

HEIGHT, ROOF = 3.6, 2.9
COLUMNS = (0.9, 2.5, 4.1, 5.7, 7.3)

scene = ObjScene("A courtyard with a colonnade")
scene.material("Plaster", (0.72, 0.66, 0.56))
scene.material("Terracotta", (0.62, 0.27, 0.16))
scene.material("Paving", (0.5, 0.47, 0.42))
scene.material("Stone", (0.78, 0.76, 0.72))
scene.material("Glaze", (0.12, 0.35, 0.5))


def box(name, material, low, high, radius=0.02):
    scene.add(name, material, *chamfered_box(low, high, radius))


# Ground and walls, north (z = 0) and west (x = 0).
box("Ground", "Paving", (-0.3, -0.2, -0.3), (10, 0, 8))
box("WallNorth", "Plaster", (-0.3, 0, -0.3), (10, HEIGHT, 0))
box("WallWest", "Terracotta", (-0.3, 0, 0), (0, HEIGHT, 8))

# The colonnade before the western wall.
shaft = smooth([(0.19, 0), (0.19, 0.12), (0.14, 0.2), (0.125, 1.4), (0.11, 2.4), (0.18, 2.55), (0.18, 2.6)], 24)
for k, z in enumerate(COLUMNS):
    scene.add(f"Column{k}", "Stone", *move(lathe(shaft, 32), (2, 0, z)))
box("Beam", "Stone", (1.8, 2.6, 0), (2.2, ROOF, 8))
box("Roof", "Terracotta", (0, ROOF, 0), (2.4, ROOF + 0.15, 8))

# A bench, a basin with a ball, and jars.
box("Bench", "Stone", (4.2, 0.4, 0.4), (6.4, 0.5, 0.9))
for k, x in enumerate((4.4, 6)):
    box(f"BenchLeg{k}", "Stone", (x, 0, 0.45), (x + 0.2, 0.4, 0.85))
basin = [(0, 0.02), (1.2, 0.02), (1.2, 0.5), (1, 0.5), (0.95, 0.3), (0, 0.3)]
scene.add("Basin", "Stone", *move(lathe(basin, 64), (5.2, 0, 4)))
scene.add("Ball", "Glaze", *move(sphere(0.4, 24, 48), (5.2, 0.72, 4)))
jar = smooth([(0.18, 0), (0.34, 0.3), (0.3, 0.6), (0.14, 0.85), (0.2, 0.95)], 20)
for k, place in enumerate(((7.6, 0, 0.8), (8.3, 0, 1.2), (3, 0, 6.3))):
    scene.add(f"Jar{k}", "Glaze" if k == 1 else "Terracotta", *move(lathe(jar, 40), place))

scene.write(sys.argv[1], "Courtyard")
