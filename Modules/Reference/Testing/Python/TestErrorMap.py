"""The map of a solution's error as a filter: a known error where it was put, the arrays, the options."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkCubeSource

import lambert

# Options and defaults.
error_map = lambert.vtkErrorMap()
for name, default, other in (("Samples", 1024, 16), ("Seed", 1, 2 ** 63), ("NumberOfThreads", 0, 2)):
    assert getattr(error_map, "Get" + name)() == default, name
    getattr(error_map, "Set" + name)(other)
    assert getattr(error_map, "Get" + name)() == other, name
assert "Samples: 16" in str(error_map)

# A cube under a sky receives pi L: by the bake, without noise. Its upper half is made a tenth too bright.
cube = vtkCubeSource()
bake = lambert.vtkPathTracedIrradiance()
bake.SetInputConnection(cube.GetOutputPort())
bake.SetSky(1, 2, 3)
bake.SetSamples(16)
bake.Update()
solution = vtkPolyData()
solution.DeepCopy(bake.GetOutput())
up = vtk_to_numpy(solution.GetPoints().GetData())[:, 1] > 0
light = vtk_to_numpy(solution.GetPointData().GetArray("Irradiance"))
light[up] *= 1.1

error_map.SetInputData(solution)
error_map.SetSceneConnection(cube.GetOutputPort())
error_map.SetSky(1, 2, 3)
error_map.Update()
cells = error_map.GetOutput().GetCellData()
assert cells.GetScalars().GetName() == "RelativeError"
errors = vtk_to_numpy(cells.GetScalars())
corners = vtk_to_numpy(error_map.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
assert np.abs(errors - 0.1 * up[corners].mean(axis=1)).max() < 1e-4, errors  # Floats.
assert errors.max() > 0.099 and errors.min() < 1e-4
reference = vtk_to_numpy(cells.GetArray("ReferenceIrradiance"))
assert np.abs(reference - np.pi * np.array([1, 2, 3])).max() < 1e-3
assert vtk_to_numpy(cells.GetArray("StandardError")).max() < 1e-3
for name in ("InputFaceId", "Side", "Reflectance"):
    assert cells.GetArray(name), name  # What the solution carried is there.

# What makes no sense is an error, and nothing is delivered.
for refuse in (lambda f: f.SetSamples(1), lambda f: f.SetSky(-1, 0, 0), lambda f: f.SetInputData(cube.GetOutput())):
    wrong, told = lambert.vtkErrorMap(), []
    wrong.SetInputData(solution)
    wrong.SetSceneConnection(cube.GetOutputPort())
    wrong.AddObserver("ErrorEvent", lambda *_: told.append(1))
    wrong.AddObserver("WarningEvent", lambda *_: None)
    refuse(wrong)
    wrong.Update()
    assert told == [1] and wrong.GetOutput().GetNumberOfCells() == 0, told

# An abort delivers nothing and is no error.
early, told = lambert.vtkErrorMap(), []
early.SetInputData(solution)
early.SetSceneConnection(cube.GetOutputPort())
early.AddObserver("ErrorEvent", lambda *_: told.append(1))
early.AddObserver("ProgressEvent", lambda caller, _: caller.AbortExecuteOn())
early.Update()
assert not told and early.GetOutput().GetNumberOfCells() == 0
