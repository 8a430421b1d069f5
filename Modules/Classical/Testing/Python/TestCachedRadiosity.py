"""The Python surface of the cached method: its options, its ports, its errors."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource

import lambert


def furnace():
    """A unit cube that shines inward with 1 W/m2 and reflects half: radiosity 2 everywhere."""
    cube, triangles = vtkCubeSource(), vtkTriangleFilter()
    triangles.SetInputConnection(cube.GetOutputPort())
    triangles.Update()
    data = triangles.GetOutput()
    count = data.GetNumberOfCells()
    for name, values in (("Emittance", np.ones((count, 3), np.float32)), ("FaceFlags", np.full(count, 2, np.uint8))):
        array = numpy_to_vtk(values, deep=1)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    return data


def array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


method = lambert.vtkCachedRadiosity()
assert isinstance(method, lambert.vtkRadiosityAlgorithm)
for name, default, other in (("ElementSize", 0.0, 0.2), ("OutputSize", 0.0, 0.4), ("Paths", 32, 8), ("GatherRays", 64, 16), ("EmitterRays", 16, 4),
                             ("Seed", 1, 2)):
    assert getattr(method, "Get" + name)() == default, name
    getattr(method, "Set" + name)(other)
    assert getattr(method, "Get" + name)() == other, name

# All three ports. In a furnace every ray reads the same light: nothing is left to chance, 0.2 % is for the last bounces.
scene = furnace()
method.SetInputData(scene)
method.Update()
refined, history, lit = (method.GetOutputDataObject(port) for port in range(3))
assert method.GetStoppedBy() == "error"
assert refined.GetNumberOfCells() > scene.GetNumberOfCells()
assert np.allclose(array(refined, "Radiosity"), 2, rtol=0.002)
assert (vtk_to_numpy(refined.GetCellData().GetArray("Side")) == 1).all()  # The fronts look out into the dark.
assert history.GetNumberOfRows() > 3
assert lit.GetNumberOfPoints() == scene.GetNumberOfPoints()
assert np.allclose(array(lit, "Irradiance"), 2, rtol=0.002)

# A large output size leaves the mesh as it is.
method.SetOutputSize(100)
method.Update()
assert method.GetOutput().GetNumberOfCells() == scene.GetNumberOfCells()
assert np.allclose(array(method.GetOutput(), "Radiosity"), 2, rtol=0.002)

# Errors are told, and nothing is delivered.
for name, value in (("Paths", 0), ("GatherRays", -1), ("ElementSize", -1.0), ("OutputSize", -1.0), ("ElementSize", 1e-6)):
    broken, errors = lambert.vtkCachedRadiosity(), []
    getattr(broken, "Set" + name)(value)
    broken.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    broken.SetInputData(scene)
    broken.Update()
    assert errors and broken.GetOutput().GetNumberOfCells() == 0, name

# An abort ends the run without an error.
aborted, errors = lambert.vtkCachedRadiosity(), []
aborted.AddObserver("ErrorEvent", lambda *_: errors.append(1))
aborted.AddObserver("ProgressEvent", lambda caller, _: caller.AbortExecuteOn())
aborted.SetInputData(scene)
aborted.Update()
assert aborted.GetStoppedBy() == "interrupt" and not errors
