"""Lights that `lambert solve` adds: where the sun stands, what it gives, what is refused."""
import math

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from CommandLine import fails, solve, temporary

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
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(name)
    reader.Update()
    mesh = reader.GetOutput()
    points, normals = vtk_to_numpy(mesh.GetPoints().GetData()), vtk_to_numpy(mesh.GetPointData().GetNormals())
    irradiance = vtk_to_numpy(mesh.GetPointData().GetArray("Irradiance"))
    axis = "xyz".index(up)
    east, north = points[:, 0], -points[:, 2] if up == "y" else points[:, 1]
    chosen = (np.abs(points[:, axis]) < 1e-6) & (normals[:, axis] > 0.9) & (np.abs(north) < 2.5)
    return east[chosen], irradiance[chosen]


# A sun in the south-east, 45 degrees high, over black faces: the wall's shadow lies to the west, 1 m sin(135) wide. Its edge
# is unsharp by the diameter of the sun, and by half an element.
black = ["--reflectance", 0, 0, 0]
for method, up in (("hierarchical", "y"), ("hierarchical", "z"), ("matrix", "z"), ("progressive", "z"), ("cached", "z")):
    more = ["--error", 0.05] if method == "hierarchical" else ["--element-size", 0.125]
    court = write_court(temporary("court.obj"), up)
    report = solve(court, "-o", out, "--method", method, *more, *black, "--up", up, "--sun", 135, 45, 2, 4, 6, "--verify", 500)
    # 16 rays over the disc of the sun, whose cosines vary by half a hundredth.
    east, light = floor_light(out, up)
    width = math.sin(math.radians(45))
    shade, sun = (east < -0.15) & (east > -width + 0.15), (east > 0.15) | (east < -width - 0.15)
    assert shade.sum() >= 2 and sun.sum() >= 8, (method, up, shade.sum(), sun.sum())
    assert np.abs(light[shade]).max() < 1e-6, (method, up, light[shade].max())
    assert np.allclose(light[sun], math.sin(math.radians(45)) * np.array([2, 4, 6]), rtol=2e-3), (method, up)

    # Energy is kept, and the reference sees the same shadow: of elements of 0.125 m its two edges are what is wrong.
    energy = report["energy_w"]
    assert np.allclose(energy["emitted"], np.add(energy["absorbed"], energy["escaped"]), rtol=0.02), (method, energy)
    assert report["error"]["rms"] < (0.07 if method == "hierarchical" else 0.15), (method, report["error"])

# What is no sun.
for bad in (["--sun", 0, 91, 1, 1, 1], ["--sun", 400, 10, 1, 1, 1], ["--sun", 0, 10, 1, 1, -1], ["--sun", 0, 10, 1],
            ["--sun", "nan", 10, 1, 1, 1]):
    fails(2, "solve", court, "-o", out, *bad, says=["--sun"])
fails(2, "solve", court, "-o", out, "--sun-diameter", 1, says=["--sun"])
fails(2, "solve", court, "-o", out, "--sun", 0, 10, 1, 1, 1, "--sun-diameter", 120, says=["--sun-diameter"])
