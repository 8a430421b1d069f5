"""The Python surface of progressive radiosity: its options, its ports, its errors, its observers."""
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


scene = furnace()
method = lambert.vtkProgressiveRadiosity()
assert isinstance(method, lambert.vtkRadiosityAlgorithm)
for name, default, other in (("ElementSize", 0.0, 0.4), ("PatchSize", 0.0, 0.8), ("Unshot", 0.005, 1e-3), ("Shots", 0, 100000),
                             ("SkyRays", 256, 16), ("Ambient", True, False)):
    assert getattr(method, "Get" + name)() == default, name
    getattr(method, "Set" + name)(other)
    assert getattr(method, "Get" + name)() == other, name

# All three ports. Form factors of a cube are good to a thousandth, and a thousandth may stay unshot: both double.
method.SetInputData(scene)
method.Update()
refined, history, lit = (method.GetOutputDataObject(port) for port in range(3))
assert method.GetStoppedBy() == "error"
assert refined.GetNumberOfCells() > scene.GetNumberOfCells()
assert np.allclose(array(refined, "Radiosity"), 2, rtol=0.004)
assert (vtk_to_numpy(refined.GetCellData().GetArray("Side")) == 1).all()  # The fronts look out into the dark.
assert history.GetNumberOfRows() > 3
assert lit.GetNumberOfPoints() == scene.GetNumberOfPoints()
assert np.allclose(array(lit, "Irradiance"), 2, rtol=0.004)

# Errors are told, and nothing is delivered.
for name, value in (("ElementSize", -1.0), ("PatchSize", -1.0), ("Unshot", 0.0), ("Shots", -1)):
    broken, errors = lambert.vtkProgressiveRadiosity(), []
    if name != "ElementSize":
        broken.SetElementSize(0.2)
    getattr(broken, "Set" + name)(value)
    broken.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    broken.SetInputData(scene)
    broken.Update()
    assert errors and broken.GetOutput().GetNumberOfCells() == 0, name

# An abort ends the run without an error.
aborted, errors = lambert.vtkProgressiveRadiosity(), []
aborted.SetElementSize(0.2)
aborted.AddObserver("ErrorEvent", lambda *_: errors.append(1))
aborted.AddObserver("ProgressEvent", lambda caller, _: caller.AbortExecuteOn())
aborted.SetInputData(scene)
aborted.Update()
assert aborted.GetStoppedBy() == "interrupt" and not errors

# Observers of progressive radiosity see light before the end; with the ambient term early light is about that of the last.
for ambient in (False, True):
    method, seen = lambert.vtkProgressiveRadiosity(), []
    method.SetElementSize(0.4)
    method.SetAmbient(ambient)
    method.AddObserver("UpdateDataEvent", lambda caller, _: seen.append(array(caller.GetOutput(), "Irradiance").mean()))
    method.SetInputData(scene)
    method.Update()
    assert len(seen) > 3 and len(seen) == method.GetOutputDataObject(1).GetNumberOfRows()
    if not ambient:
        assert (np.diff(seen) > 0).all() and seen[0] < 0.8 * seen[-1]
    else:
        assert abs(seen[0] - seen[-1]) < 0.2 * seen[-1]
