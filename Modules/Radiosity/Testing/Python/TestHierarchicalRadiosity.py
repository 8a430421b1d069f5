"""The Python surface of the method, its three ports, and its events."""
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkIOGeometry import vtkSTLReader, vtkSTLWriter
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

import lambert


def box_with_lamp():
    """A unit cube seen from within whose ceiling holds a lamp; faces in no order of any tree."""
    points, cells, emittance = vtkPoints(), vtkCellArray(), []

    def quad(a, b, c, d, exitance=0.0):
        ids = [points.InsertNextPoint(p) for p in (a, b, c, d)]
        for triangle in ((0, 1, 2), (0, 2, 3)):
            cells.InsertNextCell(3, [ids[i] for i in triangle])
            emittance.append([exitance] * 3)

    quad((0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0))
    quad((.4, .99, .4), (.6, .99, .4), (.6, .99, .6), (.4, .99, .6), 100.0)
    quad((0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1))
    quad((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
    quad((0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1))
    quad((0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1))
    quad((1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0))
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    array = numpy_to_vtk(np.array(emittance, np.float32), deep=1)
    array.SetName("Emittance")
    data.GetCellData().AddArray(array)
    flags = numpy_to_vtk(np.array([1 if e[0] else 0 for e in emittance], np.uint8), deep=1)
    flags.SetName("FaceFlags")
    data.GetCellData().AddArray(flags)
    return data


def array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def areas(data):
    xyz = vtk_to_numpy(data.GetPoints().GetData())[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    return np.linalg.norm(np.cross(xyz[:, 1] - xyz[:, 0], xyz[:, 2] - xyz[:, 0]), axis=1) / 2


def light_at_points(method):
    """Rows of position and irradiance, sorted: points made for an earlier picture keep their earlier numbers."""
    output = method.GetOutput()
    rows = np.hstack([vtk_to_numpy(output.GetPoints().GetData()), array(output, "Irradiance")])
    return rows[np.lexsort(rows.T)]


# Options, defaults, and the base class that carries the contract.
method = lambert.vtkHierarchicalRadiosity()
assert isinstance(method, lambert.vtkRadiosityAlgorithm)
for name, default, other in (("Error", 0.05, 0.2), ("TimeLimit", 0.0, 60.0), ("MemoryLimit", 0.0, 500.0), ("Iterations", 0, 7),
                             ("VerificationPoints", 2000, 0), ("FinalGather", True, False), ("NumberOfThreads", 0, 2),
                             ("StateFileName", "", "a.state"), ("ResumeFileName", "", "b.state"),
                             ("Refinement", method.RECTANGLE, method.QUADTREE), ("SnapTolerance", np.float32(0.15), 0.25),
                             ("Oracle", method.DOUBT, method.BFA), ("Schedule", method.SCHEDULED, method.INTERLEAVED)):
    assert getattr(method, "Get" + name)() == default, name
    getattr(method, "Set" + name)(other)
    assert getattr(method, "Get" + name)() == other, name
assert method.GetSky() == (0, 0, 0)
method.SetSky(1, 2, 3)
assert method.GetSky() == (1, 2, 3)
method.FinalGatherOn()
assert method.GetFinalGather()
method.FinalGatherOff()
assert not method.GetFinalGather()
assert method.GetStoppedBy() == "" and "VerificationPoints: 0" in str(method) and "FinalGather: 0" in str(method)
assert method.GetNumberOfInputPorts() == 2 and method.GetNumberOfOutputPorts() == 3

# Ports: refined mesh, history, input with light.
scene = box_with_lamp()
method = lambert.vtkHierarchicalRadiosity()
method.SetInputData(scene)
method.SetError(0.3)
method.Update()
refined, history, lit = (method.GetOutputDataObject(port) for port in range(3))
assert method.GetStoppedBy() in ("error", "floor")
assert refined.GetNumberOfCells() > scene.GetNumberOfCells()
irradiance = array(refined, "Irradiance")
assert np.isfinite(irradiance).all() and irradiance.min() >= 0 and irradiance.max() > 0
assert history.GetNumberOfRows() > 0
assert [history.GetColumnName(i) for i in range(history.GetNumberOfColumns())] == [
    "iteration", "seconds", "threshold", "elements", "links", "rays", "change", "error"]
assert lit.GetNumberOfPoints() == scene.GetNumberOfPoints() and lit.GetNumberOfCells() == scene.GetNumberOfCells()
assert np.array_equal(vtk_to_numpy(lit.GetPolys().GetConnectivityArray()), vtk_to_numpy(scene.GetPolys().GetConnectivityArray()))
assert array(lit, "Irradiance").shape == (scene.GetNumberOfPoints(), 3) and array(lit, "Irradiance").max() > 0
assert not scene.GetPointData().HasArray("Irradiance")  # The input itself stays as it was.

# Every refined triangle lies in the plane of the input triangle it names, so the numbers are the input's.
face_of = vtk_to_numpy(refined.GetCellData().GetArray("InputFaceId"))
xyz = vtk_to_numpy(scene.GetPoints().GetData())[vtk_to_numpy(scene.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
small = vtk_to_numpy(refined.GetPoints().GetData())[vtk_to_numpy(refined.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
normal = np.cross(xyz[:, 1] - xyz[:, 0], xyz[:, 2] - xyz[:, 0])
normal /= np.linalg.norm(normal, axis=1, keepdims=True)
distance = np.einsum("fcx,fx->fc", small - xyz[face_of][:, :1], normal[face_of])
assert np.abs(distance).max() < 1e-5  # Float positions in a unit cube.
assert set(face_of) == set(range(scene.GetNumberOfCells()))

# The tree of vtkFaceClustering may come in from outside; the mesh then is in its order.
clusters = lambert.vtkFaceClustering()
clusters.SetInputData(scene)
outside = lambert.vtkHierarchicalRadiosity()
outside.SetInputConnection(0, clusters.GetOutputPort(0))
outside.SetInputConnection(1, clusters.GetOutputPort(1))
outside.SetError(0.3)
outside.Update()
assert np.allclose(array(outside.GetOutput(), "Irradiance").max(), irradiance.max(), rtol=0.05)  # Same light, noise aside.

# Progress, and a displayable solution after every iteration for who observes.
seen, steps = [], []
watched = lambert.vtkHierarchicalRadiosity()
watched.SetInputData(scene)
watched.SetIterations(3)
watched.AddObserver("ProgressEvent", lambda caller, _: steps.append(caller.GetProgress()))
watched.AddObserver("UpdateDataEvent", lambda caller, _: seen.append(array(caller.GetOutputDataObject(0), "Radiosity").max()))
watched.Update()
assert len(seen) == watched.GetOutputDataObject(1).GetNumberOfRows() == 3 and min(seen) > 0
assert steps and min(steps) >= 0 and max(steps) <= 1
unwatched = lambert.vtkHierarchicalRadiosity()
unwatched.SetInputData(scene)
unwatched.SetIterations(3)
unwatched.Update()
assert np.array_equal(light_at_points(unwatched), light_at_points(watched))  # Watching changes no light.

# The history holds the verified error of every final gather; without verification, of none.
found = vtk_to_numpy(history.GetColumnByName("error"))
assert found[0] == -1 and 0 <= found[-1] and (found[-1] <= 0.3 or method.GetStoppedBy() != "error"), found
unverified = lambert.vtkHierarchicalRadiosity()
unverified.SetInputData(scene)
unverified.SetError(0.3)
unverified.SetVerificationPoints(0)
unverified.Update()
assert (vtk_to_numpy(unverified.GetOutputDataObject(1).GetColumnByName("error")) == -1).all()
assert unverified.GetStoppedBy() == "error"

# Without final gather every iteration refines links, and what they bring is verified all the same.
by_links = lambert.vtkHierarchicalRadiosity()
by_links.SetInputData(scene)
by_links.SetError(0.3)
by_links.FinalGatherOff()
by_links.Update()
thresholds = vtk_to_numpy(by_links.GetOutputDataObject(1).GetColumnByName("threshold"))
assert (np.diff(thresholds) < 0).all() and by_links.GetStoppedBy() == "error"
assert 0 <= vtk_to_numpy(by_links.GetOutputDataObject(1).GetColumnByName("error"))[-1] <= 0.3

# Regular refinement leaves powers of four of the input's triangles, but for halves beside what is finer (measured: 85 %
# of all; by rectangles 52 %).
regular = lambert.vtkHierarchicalRadiosity()
regular.SetInputData(scene)
regular.SetError(0.3)
regular.FinalGatherOff()
regular.SetRefinementToQuadtree()
regular.Update()
faces = vtk_to_numpy(regular.GetOutput().GetCellData().GetArray("InputFaceId"))
level = np.log(areas(scene)[faces] / areas(regular.GetOutput())) / np.log(4)
assert level.max() > 1.9 and np.mean(np.abs(level - np.round(level)) < 0.01) > 0.75, level

# Whatever judges links and whenever light bounces, it is the same light in the end, with other links (measured: means
# within 1.5 %).
def by_links_alone(oracle, schedule):
    solver = lambert.vtkHierarchicalRadiosity()
    solver.SetInputData(scene)
    solver.SetError(0.2)
    solver.SetVerificationPoints(0)
    solver.FinalGatherOff()
    solver.SetOracle(oracle)
    solver.SetSchedule(schedule)
    solver.Update()
    corners = vtk_to_numpy(solver.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
    at_faces = array(solver.GetOutput(), "Irradiance")[corners].mean(axis=(1, 2))
    links = vtk_to_numpy(solver.GetOutputDataObject(1).GetColumnByName("links"))
    return np.average(at_faces, weights=areas(solver.GetOutput())), links[-1]


mean, links = by_links_alone(method.DOUBT, method.SCHEDULED)
for oracle, schedule in ((method.GEOMETRIC, 0), (method.BFA, 0), (method.VISIBILITY, 0), (method.PERCEPTUAL, 0),
                         (method.DOUBT, method.INTERLEAVED)):
    other_mean, other_links = by_links_alone(oracle, schedule)
    assert abs(other_mean - mean) < 0.05 * mean and other_links != links, (oracle, schedule, mean, other_mean)

# What is none of the choices is refused.
told = []
method.AddObserver("ErrorEvent", lambda *_: told.append(1))
for name in ("Oracle", "Schedule", "Refinement"):
    for choice in (-1, 99):
        before = getattr(method, "Get" + name)()
        told.clear()
        getattr(method, "Set" + name)(choice)
        assert told and getattr(method, "Get" + name)() == before, (name, choice)

# A state that one filter saved another goes on from, to the same light; of another input it is an error.
state = os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], "TestHierarchicalRadiosity.state")
stopped = lambert.vtkHierarchicalRadiosity()
stopped.SetInputData(scene)
stopped.SetIterations(2)
stopped.SetStateFileName(state)
stopped.Update()
resumed = lambert.vtkHierarchicalRadiosity()
resumed.SetInputData(scene)
resumed.SetIterations(3)
resumed.SetResumeFileName(state)
resumed.Update()
assert resumed.GetOutputDataObject(1).GetNumberOfRows() == 3
assert np.array_equal(array(resumed.GetOutput(), "Irradiance"), array(unwatched.GetOutput(), "Irradiance"))
errors = []
resumed.AddObserver("ErrorEvent", lambda *_: errors.append(1))
resumed.SetSky(1, 1, 1)
resumed.Update()
assert errors

# Another reflectance is lit over the links that there are: shown before an iteration, and in the end as a new filter
# has it, each within the error that was asked for.
def painted(reflectance):
    data = vtkPolyData()
    data.DeepCopy(scene)
    array_ = numpy_to_vtk(np.full((scene.GetNumberOfCells(), 3), reflectance, np.float32), deep=1)
    array_.SetName("Reflectance")
    data.GetCellData().AddArray(array_)
    return data


def mean_light(method):
    return array(method.GetOutputDataObject(2), "Irradiance").mean()


relit, shown = lambert.vtkHierarchicalRadiosity(), []
relit.SetInputData(painted(0.3))
relit.SetError(0.3)
relit.Update()
first = mean_light(relit)
relit.AddObserver("UpdateDataEvent", lambda caller, _: shown.append(array(caller.GetOutputDataObject(0), "Irradiance").max()))
relit.SetInputData(painted(0.6))
relit.Update()
fresh = lambert.vtkHierarchicalRadiosity()
fresh.SetInputData(painted(0.6))
fresh.SetError(0.3)
fresh.Update()
assert mean_light(relit) > 1.1 * first and abs(mean_light(relit) / mean_light(fresh) - 1) < 0.3
assert len(shown) == relit.GetOutputDataObject(1).GetNumberOfRows() + 1
assert relit.GetOutputDataObject(1).GetNumberOfRows() < fresh.GetOutputDataObject(1).GetNumberOfRows()

# Other lights, or links that were not kept: all is made anew, to the bits of a new filter.
for method in (relit, fresh):
    method.SetIterations(2)
    method.Update()
for change in (lambda: relit.SetSky(1, 1, 1), lambda: relit.SetSky(0, 0, 0), relit.KeepLinksOff,
               lambda: relit.SetInputData(painted(0.3)), lambda: relit.SetInputData(painted(0.6))):
    change()
    relit.Update()
assert np.array_equal(array(relit.GetOutputDataObject(2), "Irradiance"), array(fresh.GetOutputDataObject(2), "Irradiance"))

# An abort after the first iteration keeps that iteration.
aborted = lambert.vtkHierarchicalRadiosity()
aborted.SetInputData(scene)
aborted.SetError(0.01)
aborted.AddObserver("UpdateDataEvent", lambda caller, _: caller.AbortExecuteOn())
aborted.Update()
assert aborted.GetStoppedBy() == "interrupt" and aborted.GetOutputDataObject(1).GetNumberOfRows() == 1
assert aborted.GetOutput().GetNumberOfCells() >= scene.GetNumberOfCells()

# An array of the wrong shape is an error, and nothing is delivered.
wrong = vtkPolyData()
wrong.ShallowCopy(scene)
two_bands = numpy_to_vtk(np.ones((scene.GetNumberOfCells(), 2), np.float32), deep=1)
two_bands.SetName("Emittance")
wrong.GetCellData().AddArray(two_bands)
broken = lambert.vtkHierarchicalRadiosity()
errors = []
broken.AddObserver("ErrorEvent", lambda *_: errors.append(1))
broken.SetInputData(wrong)
broken.Update()
assert errors and broken.GetOutput().GetNumberOfCells() == 0

# From a file's points to a mapper in four lines: points that the file shares between faces of different normals stay
# one in port 2, and a sky lights what emits nothing.
cube = vtkCubeSource()
corners = vtkCleanPolyData()  # Eight points, as an STL reader leaves them.
corners.SetInputConnection(cube.GetOutputPort())
corners.Update()
bare = vtkPolyData()
bare.SetPoints(corners.GetOutput().GetPoints())
bare.SetPolys(corners.GetOutput().GetPolys())
triangles = vtkTriangleFilter()
triangles.SetInputData(bare)
triangles.Update()
solid = os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], "cube.stl")
writer = vtkSTLWriter()
writer.SetInputConnection(triangles.GetOutputPort())
writer.SetFileName(solid)
writer.Write()

reader = vtkSTLReader()
reader.SetFileName(solid)
clusters = lambert.vtkFaceClustering()
clusters.SetInputConnection(reader.GetOutputPort())
radiosity = lambert.vtkHierarchicalRadiosity()
radiosity.SetSky(1, 2, 3)
radiosity.SetInputConnection(reader.GetOutputPort())
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(radiosity.GetOutputPort())
mapper.Update()
lit = radiosity.GetOutputDataObject(2)
stored = reader.GetOutput()
assert stored.GetNumberOfPoints() == lit.GetNumberOfPoints() == 8
assert np.array_equal(vtk_to_numpy(lit.GetPoints().GetData()), vtk_to_numpy(stored.GetPoints().GetData()))
# A convex body under a constant sky L receives pi L on every facet. The sky is sampled by rays that none blocks: 2 %
# leaves room for their scatter.
for name, factor in (("Irradiance", np.pi), ("Radiosity", np.pi / 2)):
    values = array(lit, name)
    assert values.shape == (8, 3) and np.allclose(values, factor * np.array([1, 2, 3]), rtol=0.02), (name, values)
assert np.allclose(array(mapper.GetInput(), "Irradiance"), np.pi * np.array([1, 2, 3]), rtol=0.02)
assert radiosity.GetSky() == (1.0, 2.0, 3.0)

# The same through a tree from outside.
outside = lambert.vtkHierarchicalRadiosity()
outside.SetSky(1, 2, 3)
outside.SetInputConnection(0, clusters.GetOutputPort(0))
outside.SetInputConnection(1, clusters.GetOutputPort(1))
outside.Update()
assert np.allclose(array(outside.GetOutputDataObject(2), "Irradiance"), np.pi * np.array([1, 2, 3]), rtol=0.02)

# Options without meaning are errors, not endless runs.
for option, value in (("Error", -1), ("Error", 0), ("Error", 2), ("VerificationPoints", -1), ("MemoryLimit", -1),
                      ("SnapTolerance", 0.5), ("Sky", (-1, 0, 0))):
    broken = lambert.vtkHierarchicalRadiosity()
    getattr(broken, "Set" + option)(value)
    errors = []
    broken.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    broken.SetInputConnection(reader.GetOutputPort())
    broken.Update()
    assert errors and broken.GetOutput().GetNumberOfCells() == 0, (option, value)

# No light is a warning, and darkness.
dark = lambert.vtkHierarchicalRadiosity()
warnings = []
dark.AddObserver("WarningEvent", lambda *_: warnings.append(1))
dark.SetInputConnection(reader.GetOutputPort())
dark.Update()
assert warnings and array(dark.GetOutputDataObject(2), "Irradiance").max() == 0

# An abort before the first iteration delivers nothing and is no error.
early, errors = lambert.vtkHierarchicalRadiosity(), []
early.SetSky(1, 1, 1)
early.AddObserver("ErrorEvent", lambda *_: errors.append(1))
early.AddObserver("ProgressEvent", lambda caller, _: caller.AbortExecuteOn())
early.SetInputConnection(reader.GetOutputPort())
early.Update()
assert early.GetStoppedBy() == "interrupt" and not errors
