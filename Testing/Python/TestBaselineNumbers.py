"""The number behind each baseline picture: what it shows is not only what it showed last time, but right.

Irradiance is compared with path tracing, which knows nothing of the method: the values, W/m2, and their standard errors
are those of `lambertReferenceProbe SCENE PATHS POINT NORMAL`.
"""
import csv
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkMassProperties

import lambert
from CommandLine import CORNELL_BOX, DATA, solve, temporary

sys.path.append(os.path.join(os.environ["LAMBERT_SOURCE_DIR"], "Documentation", "Pictures"))
from ClusterColors import ring  # noqa: E402


def reading(scene, point, *arguments):
    """Irradiance that the solution delivers at one point of a surface."""
    probe, readings = temporary("probe.csv"), temporary("readings.csv")
    with open(probe, "w", encoding="ascii") as out:
        out.write("x,y,z,nx,ny,nz\n" + ",".join(map(str, point)) + "\n")
    solve(scene, "-o", temporary("lit.vtp"), "--probe", probe, "--probe-output", readings, *arguments)
    with open(readings, encoding="ascii") as file:
        row, = csv.DictReader(file)
    assert row["kind"] == "surface", row
    return np.array([float(row[band]) for band in "rgb"])


def agrees(delivered, reference, standard_error, tolerance):
    """Within the tolerance, a share of the reference, and four standard errors of it, over the three bands."""
    reference = np.array(reference)
    off = np.linalg.norm(delivered - reference)
    print(f"delivered {delivered}, reference {reference}: off by {off / np.linalg.norm(reference):.4f}")
    assert off < tolerance * np.linalg.norm(reference) + 4 * np.linalg.norm(standard_error), (delivered, reference)


# The tolerance is the error that the run was asked for; the points lie in even light, away from shadow edges. Light that
# is lost does not fit into it: without any reflection (the same path trace with every Kd 0) the wall of the box has 28 %
# less, and that of the room 57 %.
#
# CornellBox: the back wall, 1,000,000 paths.
back_wall = (0.278, 0.3, 0.5592, 0, 0, -1)
truth = (1.11816, 0.775321, 0.231128), (0.00033, 0.00023, 0.000057)
agrees(reading(CORNELL_BOX, back_wall, "--error", 0.03), *truth, 0.03)

# RefinedMesh: the same point on the mesh of that picture, three iterations coarser. Each of them divides the threshold
# by 4 or less and no error is promised for it; 0.2 is still less than the reflected light.
agrees(reading(CORNELL_BOX, back_wall, "--error", 0.01, "--iterations", 3), *truth, 0.2)

# DefaultScene: the green wall beside the pictures, 200,000 paths.
room = os.path.join(DATA, "DefaultScene", "DefaultScene.obj")
agrees(reading(room, (3.0, 2.2, 0, 0, 0, 1), "--error", 0.2, "--iterations", 7),
       (0.790786, 0.657184, 0.511616), (0.0018, 0.0014, 0.00094), 0.2)

# ClusterColors: the finest view. Its 512 clusters cover the ring once: their areas add up to VTK's own measure of it, and
# their vector areas to zero, as those of a closed surface do. 1e-5: VTK's points are of single precision.
shape = ring()
area = vtkMassProperties()
area.SetInputConnection(shape.GetOutputPort())
clusters = lambert.vtkFaceClustering()
clusters.SetInputConnection(shape.GetOutputPort())
clusters.SetClusterCount(512)
clusters.Update()
shown = np.unique(vtk_to_numpy(clusters.GetOutput().GetCellData().GetArray("ClusterId")))
table = clusters.GetOutputDataObject(1)
areas = vtk_to_numpy(table.GetColumnByName("Area"))[shown]
vector_areas = vtk_to_numpy(table.GetColumnByName("VectorArea"))[shown]
assert len(shown) == 512
assert abs(areas.sum() / area.GetSurfaceArea() - 1) < 1e-5, (areas.sum(), area.GetSurfaceArea())
assert np.linalg.norm(vector_areas.sum(axis=0)) < 1e-5 * areas.sum(), vector_areas.sum(axis=0)
