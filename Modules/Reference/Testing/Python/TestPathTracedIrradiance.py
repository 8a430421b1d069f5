"""The reference as a filter: a method at vertices, and estimates at points of one's own."""
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPlaneSource

import lambert

CORNELL_BOX = os.path.join(os.environ["LAMBERT_DATA_DIR"], "CornellBox", "CornellBox.obj")


def array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def points_with_normals(positions, normals, **more):
    data, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(np.array(positions, np.float32), deep=1))
    data.SetPoints(points)
    data.GetPointData().SetNormals(numpy_to_vtk(np.array(normals, np.float32), deep=1))
    for name, values in more.items():
        extra = numpy_to_vtk(np.array(values, np.float32), deep=1)
        extra.SetName(name)
        data.GetPointData().AddArray(extra)
    return data


def errors_of(method):
    errors = []
    method.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    method.Update()
    return len(errors)


# Options, defaults, and the base class that carries the contract.
method = lambert.vtkPathTracedIrradiance()
assert isinstance(method, lambert.vtkRadiosityAlgorithm)
for name, default, other in (("Samples", 256, 16), ("Seed", 1, 2 ** 63), ("NumberOfThreads", 0, 2)):
    assert getattr(method, "Get" + name)() == default, name
    getattr(method, "Set" + name)(other)
    assert getattr(method, "Get" + name)() == other, name
assert method.GetStoppedBy() == "" and method.GetSky() == (0, 0, 0)
assert method.GetNumberOfInputPorts() == 3 and method.GetNumberOfOutputPorts() == 3
assert "Samples: 16" in str(method)

# Any polygons of VTK's: a convex body under a constant sky L receives pi L, by every path.
cube = vtkCubeSource()
method = lambert.vtkPathTracedIrradiance()
method.SetInputConnection(cube.GetOutputPort())
method.SetSky(1, 2, 3)
method.SetSamples(32)
method.Update()
baked, history, lit = (method.GetOutputDataObject(port) for port in range(3))
assert baked.GetNumberOfCells() == 12 and baked.GetNumberOfPoints() == 24
assert lit.GetNumberOfCells() == 6 and lit.GetNumberOfPoints() == 24  # The input as it came.
for data in (baked, lit):
    assert np.allclose(array(data, "Irradiance"), np.pi * np.array([1, 2, 3]), rtol=1e-5)
    assert np.allclose(array(data, "Radiosity"), np.pi / 2 * np.array([1, 2, 3]), rtol=1e-5)
assert history.GetNumberOfRows() == 1 and history.GetColumnByName("elements").GetValue(0) == 24
for name in ("Reflectance", "Emittance", "InputFaceId", "Side", "MaterialId", "PartId", "SourceCellId"):
    assert baked.GetCellData().HasArray(name), name
assert method.GetStoppedBy() == "error"

# The seed changes the noise, the threads do not.
reader = lambert.vtkRadiositySceneReader()
reader.SetFileName(CORNELL_BOX)


def bake(seed=1, threads=0, samples=64):
    method = lambert.vtkPathTracedIrradiance()
    method.SetInputConnection(reader.GetOutputPort())
    method.SetSeed(seed)
    method.SetSamples(samples)
    method.SetNumberOfThreads(threads)
    method.Update()
    return method.GetOutput()


first = bake()
assert np.array_equal(array(first, "Irradiance"), array(bake(threads=1), "Irradiance"))
assert not np.array_equal(array(first, "Irradiance"), array(bake(seed=2), "Irradiance"))

# Points of one's own: beside what they carry, irradiance and its standard error, in closed form.
lamp = vtkPlaneSource()  # A unit square at z = 1, over [0,1]^2, that emits downward.
lamp.SetOrigin(0, 0, 1)
lamp.SetPoint1(0, 1, 1)
lamp.SetPoint2(1, 0, 1)
lamp.Update()
scene = vtkPolyData()
scene.ShallowCopy(lamp.GetOutput())
exitance = numpy_to_vtk(np.ones((1, 3), np.float32), deep=1)
exitance.SetName("Emittance")
scene.GetCellData().AddArray(exitance)
probes = points_with_normals([(0, 0, 0), (.5, .5, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0)],
                             [(0, 0, 1), (0, 0, 2), (1, 0, 0), (0, 0, -1), (0, 0, 0)], Name=range(5))
estimate = lambert.vtkPathTracedIrradiance()
estimate.SetInputData(scene)
estimate.SetPointsData(probes)
estimate.SetSamples(4096)
estimate.Update()
out = estimate.GetOutput()
assert out.GetNumberOfPoints() == 5 and list(array(out, "Name")) == [0, 1, 2, 3, 4]
light, error = array(out, "Irradiance"), array(out, "StandardError")
for row, expected in enumerate((0.1385316, 0.2394565, 0.0557342)):
    # Four standard errors; a float's rounding beside them.
    assert np.all(np.abs(light[row] - expected) < 4 * error[row] + 1e-5), (light[row], error[row])
    assert np.all((0 < error[row]) & (error[row] < 0.02 * expected)), error[row]
assert not light[3:].any() and not error[3:].any()  # Facing away; no normal at all.
assert estimate.GetOutputDataObject(2).GetNumberOfCells() == 1

# Connected as a filter; the hemisphere that sees may be another than that of the normal.
tilted = (np.sqrt(.5), 0, np.sqrt(.5))
seeing = points_with_normals([(.5, .5, 0)] * 2, [tilted] * 2, GeometricNormals=[tilted, (-1, 0, 0)])
estimate.SetPointsData(seeing)
estimate.Update()
light = array(estimate.GetOutput(), "Irradiance")
assert 0 < light[1, 0] < 0.6 * light[0, 0], light  # Half of the lamp, the half at the shallower angle.

# What makes no sense is an error, and nothing is delivered.
for samples in (0, -5):
    broken = lambert.vtkPathTracedIrradiance()
    broken.SetInputConnection(reader.GetOutputPort())
    broken.SetSamples(samples)
    assert errors_of(broken) == 1 and broken.GetOutput().GetNumberOfCells() == 0
no_normals = vtkPolyData()
no_normals.SetPoints(probes.GetPoints())
for points, samples in ((no_normals, 16), (probes, 1)):
    broken = lambert.vtkPathTracedIrradiance()
    broken.SetInputData(scene)
    broken.SetPointsData(points)
    broken.SetSamples(samples)
    assert errors_of(broken) == 1 and not broken.GetOutput().GetPointData().HasArray("Irradiance")

# No points, no estimates; no light, a warning and darkness.
estimate.SetPointsData(points_with_normals(np.zeros((0, 3)), np.zeros((0, 3))))
estimate.Update()
assert estimate.GetOutput().GetNumberOfPoints() == 0
dark, warnings = lambert.vtkPathTracedIrradiance(), []
dark.AddObserver("WarningEvent", lambda *_: warnings.append(1))
dark.SetInputConnection(cube.GetOutputPort())
dark.Update()
assert warnings and array(dark.GetOutputDataObject(2), "Irradiance").max() == 0 and dark.GetOutput().GetNumberOfCells() == 12

# An abort delivers nothing and is no error.
early, steps = lambert.vtkPathTracedIrradiance(), []
early.SetInputConnection(reader.GetOutputPort())
early.AddObserver("ProgressEvent", lambda caller, _: (steps.append(caller.GetProgress()), caller.AbortExecuteOn()))
assert errors_of(early) == 0 and early.GetStoppedBy() == "interrupt" and steps
assert early.GetOutput().GetNumberOfCells() == 0
