"""Lights of every kind in the field data of a mesh: kept by VTK's writers, seen by methods."""
import math
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import lambert

names = lambert.vtkRadiosityArrays
folder = os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], "TestLightSource")
os.makedirs(folder, exist_ok=True)


def floor():
    """A square metre that looks up, +z."""
    mesh, points, faces = vtkPolyData(), vtkPoints(), vtkCellArray()
    for place in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)):
        points.InsertNextPoint(place)
    faces.InsertNextCell(4, (0, 1, 2, 3))
    mesh.SetPoints(points)
    mesh.SetPolys(faces)
    return mesh


def add(mesh, name, rows):
    kind = np.int32 if name == names.LightType() else np.float32
    array = numpy_to_vtk(np.array(rows, kind), deep=1)
    array.SetName(name)
    mesh.GetFieldData().AddArray(array)


def irradiance(mesh, method=lambert.vtkHierarchicalRadiosity):
    solver = method()
    solver.SetInputData(mesh)
    solver.Update()
    points = solver.GetOutput().GetPointData()
    up = vtk_to_numpy(points.GetNormals())[:, 2] > 0
    return vtk_to_numpy(points.GetArray("Irradiance"))[up]


# A sun half a degree across, aslant, and a lamp of 0.1 m: E cos, I cos / d^2.
mesh = floor()
add(mesh, names.LightType(), [2, 0])
add(mesh, names.LightPosition(), [[0, 0, 0], [0.5, 0.5, 100]])
add(mesh, names.LightDirection(), [[3, 0, -4], [0, 0, 0]])
add(mesh, names.LightIntensity(), [[1, 2, 3], [1e4, 1e4, 1e4]])
add(mesh, names.LightSize(), [0.01, 0.1])

# As saved and read back.
path = os.path.join(folder, "lights.vtp")
writer = vtkXMLPolyDataWriter()
writer.SetInputData(mesh)
writer.SetFileName(path)
writer.Write()
reader = vtkXMLPolyDataReader()
reader.SetFileName(path)
reader.Update()
for source in (mesh, reader.GetOutput()):
    for method in (lambert.vtkHierarchicalRadiosity, lambert.vtkMatrixRadiosity):
        assert np.allclose(irradiance(source, method), 0.8 * np.array([1, 2, 3]) + 1, rtol=1e-3), method

# A gradient sky, pi H + 2 pi (Z - H) / 3, and an image that is even over the upper half and black below.
image = os.path.join(folder, "even.hdr")
with open(image, "wb") as file:
    file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n" + bytes((128, 128, 128, 130, 0, 0, 0, 0)))
skies = floor()
add(skies, names.LightType(), [4, 5])
add(skies, names.LightIntensity(), [[4, 1, 0], [0.5, 0.5, 0.5]])
add(skies, names.LightHorizon(), [[1, 1, 3], [0, 0, 0]])
add(skies, names.LightGround(), [[9, 9, 9], [0, 0, 0]])
add(skies, names.LightRotation(), [0, 1])
files = vtkStringArray()
files.SetName(names.LightImage())
for name in ("", image):
    files.InsertNextValue(name)
skies.GetFieldData().AddArray(files)
expected = math.pi * np.array([1, 1, 3]) + 2 * math.pi / 3 * np.array([3, 0, -3]) + math.pi * 0.5 * 2
for method in (lambert.vtkHierarchicalRadiosity, lambert.vtkPathTracedIrradiance):
    assert np.allclose(irradiance(skies, method), expected, rtol=0.05), method  # The error that is asked for by default.

# The scene reader hands them on.
scene = lambert.vtkRadiositySceneReader()
scene.AddFileName(path)
scene.Update()
size = vtk_to_numpy(scene.GetOutput().GetFieldData().GetArray(names.LightSize()))
assert np.allclose(size.ravel(), [0.01, 0.1]), size


# What is no light is said in one sentence.
def complaint(mesh):
    solver = lambert.vtkHierarchicalRadiosity()
    said = []
    solver.AddObserver("ErrorEvent", lambda *_: said.append(1))
    solver.SetInputData(mesh)
    solver.Update()
    return said


for size in (-1, math.nan, 4):
    add(mesh, names.LightSize(), [size, 0])
    assert complaint(mesh), size
files.SetValue(1, os.path.join(folder, "missing.hdr"))
assert complaint(skies)
