"""Simplification of the lit mesh as a filter: fewer triangles, the error hardly more, the arrays that are left."""
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import lambert

CORNELL_BOX = os.path.join(os.environ["LAMBERT_DATA_DIR"], "CornellBox", "CornellBox.obj")

simple = lambert.vtkLitMeshSimplification()
assert simple.GetTolerance() == 0.02 and "Tolerance: 0.02" in str(simple)

# A uniform mesh has many triangles where light is even.
reader = lambert.vtkRadiositySceneReader()
reader.SetFileName(CORNELL_BOX)
solver = lambert.vtkMatrixRadiosity()
solver.SetInputConnection(reader.GetOutputPort())
solver.SetElementSize(0.05)
simple.SetInputConnection(solver.GetOutputPort())
sizes = []
for tolerance in (0.01, 0.03, 0.1):
    simple.SetTolerance(tolerance)
    simple.Update()
    sizes.append(simple.GetOutput().GetNumberOfCells())
refined, mesh = solver.GetOutput(), simple.GetOutput()
assert refined.GetNumberOfCells() > sizes[0] > sizes[1] > sizes[2], (refined.GetNumberOfCells(), sizes)


def bounded(data):
    error = lambert.vtkSolutionError()
    error.SetInputData(data)
    error.SetSceneConnection(reader.GetOutputPort())
    error.SetPoints(400)
    error.SetSamples(256)
    error.Update()
    return error.GetOutput().GetColumnByName("bounded").GetValue(0)


# Bounded errors add up at most; both are measured at the same places by the same paths.
assert bounded(mesh) < bounded(refined) + 0.1


def areas(data):
    """Area of every input face and side."""
    corners = vtk_to_numpy(data.GetPoints().GetData())[vtk_to_numpy(data.GetPolys().GetConnectivityArray())]
    a, b, c = corners.reshape(-1, 3, 3).astype(float).transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    cells = data.GetCellData()
    keys = 2 * vtk_to_numpy(cells.GetArray("InputFaceId")) + vtk_to_numpy(cells.GetArray("Side"))
    return np.bincount(keys, weights=area)


# Every face stays covered, and points that are left are as they were.
assert np.abs(areas(mesh) - areas(refined)).max() < 1e-6


def rows(data):
    places, light = data.GetPoints().GetData(), data.GetPointData()
    return {bytes(row) for row in np.hstack([vtk_to_numpy(a).astype(np.float32) for a in (
        places, light.GetArray("Irradiance"), light.GetArray("Radiosity"), light.GetNormals())])}


assert rows(mesh) <= rows(refined)
for name in ("Reflectance", "Emittance", "FaceFlags", "MaterialId", "PartId", "SourceCellId"):
    assert mesh.GetCellData().GetArray(name), name
assert not mesh.GetCellData().GetArray("LeafId") and mesh.GetFieldData().HasArray("Material.Name")

# What makes no sense is an error, and nothing is delivered.
for tolerance, data in ((0, refined), (2, refined), (0.1, reader.GetOutput())):
    wrong, told = lambert.vtkLitMeshSimplification(), []
    wrong.SetInputData(data)
    wrong.SetTolerance(tolerance)
    wrong.AddObserver("ErrorEvent", lambda *_: told.append(1))
    wrong.Update()
    assert told == [1] and wrong.GetOutput().GetNumberOfCells() == 0, tolerance
