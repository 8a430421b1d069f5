"""Lights that `lambert solve` adds: where the sun stands, what it gives, what is refused."""
import math

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from CommandLine import CORNELL_BOX, fails, solve, temporary, write_hdr
from PolyDataFile import mesh_of

out = temporary("court.vtp")


def write_court(name, up):
    """A floor of 8 m with a wall of 1 m along its middle, from south to north; `up`: y or z."""
    def place(east, north, height):
        return (east, height, -north) if up == "y" else (east, north, height)

    quads = [[(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)], [(0, -4, 0), (0, 4, 0), (0, 4, 1), (0, -4, 1)]]
    with open(name, "w") as file:
        for quad in quads:
            for corner in quad:
                file.write("v %g %g %g\n" % place(*corner))
        file.write("f 1 2 3 4\nf 5 6 7 8\n")
    return name


def floor_light(name, up):
    """How far east the points in the middle of the floor's upper side lie, and their irradiance."""
    mesh = mesh_of(name)
    points, normals = vtk_to_numpy(mesh.GetPoints().GetData()), vtk_to_numpy(mesh.GetPointData().GetNormals())
    irradiance = vtk_to_numpy(mesh.GetPointData().GetArray("Irradiance"))
    axis = "xyz".index(up)
    east, north = points[:, 0], -points[:, 2] if up == "y" else points[:, 1]
    chosen = (np.abs(points[:, axis]) < 1e-6) & (normals[:, axis] > 0.9) & (np.abs(north) < 2.5)
    return east[chosen], irradiance[chosen]


MARGIN = 0.26  # An element more than the edges of a shadow.

# A sun in the south-east, 45 degrees high, over black faces: the wall's shadow lies to the west, 1 m sin(135) wide. Its edge
# is unsharp by the diameter of the sun, and by half an element.
black = ["--reflectance", 0, 0, 0]
for method, up in (("hierarchical", "y"), ("hierarchical", "z"), ("matrix", "z"), ("progressive", "z"), ("cached", "z")):
    more = ["--error", 0.05] if method == "hierarchical" else ["--element-size", 0.25]
    court = write_court(temporary("court.obj"), up)
    report = solve(court, "-o", out, "--method", method, *more, *black, "--up", up, "--sun", 135, 45, 2, 4, 6, "--verify", 500)
    # 16 rays over the disc of the sun, whose cosines vary by half a hundredth.
    east, light = floor_light(out, up)
    width = math.sin(math.radians(45))
    shade, sun = (east < -MARGIN) & (east > -width + MARGIN), (east > MARGIN) | (east < -width - MARGIN)
    assert shade.sum() >= 2 and sun.sum() >= 8, (method, up, shade.sum(), sun.sum())
    assert np.abs(light[shade]).max() < 1e-6, (method, up, light[shade].max())
    assert np.allclose(light[sun], math.sin(math.radians(45)) * np.array([2, 4, 6]), rtol=2e-3), (method, up)

    # Energy is kept, and the reference sees the same shadow: of elements of 0.25 m its two edges are what is wrong.
    energy = report["energy_w"]
    assert np.allclose(energy["emitted"], np.add(energy["absorbed"], energy["escaped"]), rtol=0.02), (method, energy)
    assert report["error"]["rms"] < (0.07 if method == "hierarchical" else 0.25), (method, report["error"])

# A texel of an image is a sun, too, as large as it is: the same shadow, and in the sun radiance times solid angle.
ROWS, COLUMNS, ROW, COLUMN = 256, 512, 64, 448  # 45 degrees high, a quarter and an eighth to the right of north
texels = np.zeros((ROWS, COLUMNS, 3))
texels[ROW, COLUMN] = (8192, 16384, 24576)
solid_angle = 2 * math.pi / COLUMNS * (math.cos(math.pi * ROW / ROWS) - math.cos(math.pi * (ROW + 1) / ROWS))
sunny = write_hdr(temporary("sun.hdr"), texels)
court = write_court(temporary("court.obj"), "z")
for method in ("hierarchical", "progressive", "cached"):
    more = ["--error", 0.05] if method == "hierarchical" else ["--element-size", 0.25]
    report = solve(court, "-o", out, "--method", method, *more, *black, "--environment", sunny, "--environment-scale", 0.5,
                   "--up", "z", "--verify", 500)
    east, light = floor_light(out, "z")
    sine = math.cos(math.pi * (ROW + 0.5) / ROWS)
    shade, sun = (east < -MARGIN) & (east > -0.7 + MARGIN), (east > MARGIN) | (east < -0.7 - MARGIN)
    assert np.abs(light[shade]).max() < 1e-6, (method, light[shade].max())
    # The texel is wider than it is high, and its middle beside that of the sun above.
    assert np.allclose(light[sun], 0.5 * solid_angle * sine * texels[ROW, COLUMN], rtol=0.01), (method, light[sun])
    energy = report["energy_w"]
    assert np.allclose(energy["emitted"], np.add(energy["absorbed"], energy["escaped"]), rtol=0.02), (method, energy)
    assert report["error"]["rms"] < (0.07 if method == "hierarchical" else 0.25), (method, report["error"])

# An even image is a sky. A gradient and its ground reach the faces that they are over: the reference agrees.
even = write_hdr(temporary("even.hdr"), np.ones((8, 16, 3)) * (0.5, 1, 1.5))
lit = {}
for name, lights in (("sky", ["--sky", 0.5, 1, 1.5]), ("even", ["--environment", even])):
    report = solve(court, "-o", out, "--method", "progressive", "--element-size", 0.5, *lights)
    lit[name] = floor_light(out, "z")[1]
assert np.allclose(lit["sky"], lit["even"], rtol=1e-5)
for lights in (["--sky-gradient", 4, 2, 1, 1, 2, 3, "--ground", 0.5, 0.5, 0], ["--environment", even, "--sun", 200, 60, 2, 2, 2]):
    report = solve(court, "-o", out, *lights, "--error", 0.05, "--verify", 1000)
    assert report["error"]["rms"] < 0.05 and report["stopped_by"] == "error", (lights, report["error"])
    energy = report["energy_w"]
    assert np.allclose(energy["emitted"], np.add(energy["absorbed"], energy["escaped"]), rtol=0.02), (lights, energy)

# The light does not depend on the threads.
bits = []
for threads in (1, 2):
    solve(court, "-o", out, "--environment", sunny, "--sky-gradient", 1, 1, 1, 2, 2, 2, "--iterations", 3, "--threads", threads)
    bits.append(floor_light(out, "z")[1])
assert np.array_equal(*bits)

# Light from far away is the same at any size of the scene: there is nothing to warn of.
report = solve(CORNELL_BOX, "-o", out, "--unit", "mm", "--sky", 1, 1, 1, "--sun", 0, 45, 1, 1, 1, "--iterations", 1)
assert report["scene"]["diagonal_m"] < 0.01 and not report["warnings"], report["warnings"]

# What is no sun, and no environment.
for bad in (["--sun", 0, 91, 1, 1, 1], ["--sun", 400, 10, 1, 1, 1], ["--sun", 0, 10, 1, 1, -1], ["--sun", 0, 10, 1],
            ["--sun", "nan", 10, 1, 1, 1]):
    fails(2, "solve", court, "-o", out, *bad, says=["--sun"])
fails(2, "solve", court, "-o", out, "--sun-diameter", 1, says=["--sun"])
fails(2, "solve", court, "-o", out, "--sun", 0, 10, 1, 1, 1, "--sun-diameter", 120, says=["--sun-diameter"])
fails(2, "solve", court, "-o", out, "--sky-gradient", 1, 1, 1, 1, 1, -1, says=["--sky-gradient"])
fails(2, "solve", court, "-o", out, "--ground", 1, 1, 1, says=["--sky-gradient"])
fails(2, "solve", court, "-o", out, "--environment-scale", 2, says=["--environment"])
fails(2, "solve", court, "-o", out, "--environment", even, "--environment-scale", -1, says=["--environment-scale"])
for file in (court, temporary("missing.hdr")):
    fails(1, "solve", court, "-o", out, "--environment", file, says=["environment image", file])
