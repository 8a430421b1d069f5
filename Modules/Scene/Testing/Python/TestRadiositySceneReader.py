"""A small lit OBJ through vtkRadiositySceneReader: arrays, tables, report, a round trip through VTP, every Set and Get."""
import json
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import lambert

folder = os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], "TestRadiositySceneReader")
os.makedirs(folder, exist_ok=True)
names = lambert.vtkRadiosityArrays


def write(name, text):
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        file.write(text)
    return path


# A floor of two triangles, one given twice; a lamp above it that looks down.
write("room.mtl", "newmtl floor\nKd 0.2 0.4 0.6\nnewmtl lamp\nKd 0 0 0\nKe 1 2 3\n")
room = write("room.obj", """mtllib room.mtl
v 0 0 0
v 2 0 0
v 2 2 0
v 0 2 0
v 0 0 1
v 1 0 1
v 0 1 1
usemtl floor
f 1 2 3
f 1 3 4
f 4 3 1
usemtl lamp
f 5 7 6
""")


def read(file, change=lambda reader: None):
    reader = lambert.vtkRadiositySceneReader()
    reader.SetFileName(file)
    change(reader)
    reader.Update()
    return reader


def cells(data, name):
    return vtk_to_numpy(data.GetCellData().GetArray(name))


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def strings(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def table(data, name):
    return vtk_to_numpy(data.GetFieldData().GetArray(name))


# What was read: reflectance, exitance pi Ke in W/m2, in metres.
reader = read(room)
scene = reader.GetOutput()
assert scene.GetNumberOfCells() == 3
materials = strings(scene, names.MaterialName())
is_lamp = np.array([materials[i] == "lamp" for i in cells(scene, names.MaterialId())])
assert is_lamp.sum() == 1
assert np.allclose(cells(scene, names.Reflectance())[~is_lamp], [0.2, 0.4, 0.6])
assert np.allclose(cells(scene, names.Emittance())[is_lamp], np.pi * np.array([1, 2, 3]))
assert np.allclose(cells(scene, names.Emittance())[~is_lamp], 0)
assert cells(scene, names.FaceFlags())[is_lamp][0] & 3 == 1
assert np.ptp(points(scene), axis=0).tolist() == [2, 2, 1]
normals = vtk_to_numpy(scene.GetPointData().GetNormals())
assert np.allclose(np.linalg.norm(normals, axis=1), 1)
corners = vtk_to_numpy(scene.GetPolys().GetConnectivityArray()).reshape(-1, 3)
assert np.allclose(normals[corners[is_lamp][0]], [0, 0, -1])

# What was changed, by number.
report = json.loads(reader.GetReportJson())
assert report["cleaning"]["repeatedTriangles"] == 1
assert report["cleaning"]["triangles"] == 3
assert report["cleaning"]["openEdges"] == 7
assert report["read"]["files"] == [room]
assert report["read"]["faces"] == 4
assert report["warnings"] == []

# Each option changes what it says.
repeated = read(room, lambda r: r.RemoveRepeatedOff())
assert repeated.GetOutput().GetNumberOfCells() == 4
in_feet = read(room, lambda r: r.SetMetresPerUnit(0.3048))
assert np.allclose(np.ptp(points(in_feet.GetOutput()), axis=0), [0.6096, 0.6096, 0.3048])
both = read(room, lambda r: r.TwoSidedEmittersOn()).GetOutput()
assert cells(both, names.FaceFlags())[is_lamp][0] & 3 == 3
blue = read(room, lambda r: r.AddMaterialSetting("floor:reflectance=0,0,0.5|emission=1,1,1")).GetOutput()
assert np.allclose(cells(blue, names.Reflectance())[~is_lamp], [0, 0, 0.5])
assert np.allclose(cells(blue, names.Emittance())[~is_lamp], np.pi)
lit = read(room, lambda r: r.SetSky(1, 2, 3)).GetOutput()
assert table(lit, names.LightType()).tolist() == [3]
assert np.allclose(table(lit, names.LightIntensity()), [[1, 2, 3]])
assert strings(lit, names.LightName()) == ["sky"]
two = read(room, lambda r: r.AddFileName(room)).GetOutput()
assert two.GetNumberOfCells() == 6


def save(data, name, mode):
    writer = vtkXMLPolyDataWriter()
    path = os.path.join(folder, name)
    writer.SetFileName(path)
    writer.SetInputData(data)
    writer.SetDataMode(mode)
    assert writer.Write() == 1
    return path


# VTK's own writer keeps the whole scene, in each of its modes; our reader reads it back to the bit.
for mode in (vtkXMLPolyDataWriter.Ascii, vtkXMLPolyDataWriter.Binary, vtkXMLPolyDataWriter.Appended):
    path = save(lit, "room.vtp", mode)
    plain = vtkXMLPolyDataReader()
    plain.SetFileName(path)
    plain.Update()
    again = read(path).GetOutput()
    for data in (plain.GetOutput(), again):
        assert points(data).tolist() == points(lit).tolist()
        assert np.allclose(vtk_to_numpy(data.GetPointData().GetNormals()),
                           vtk_to_numpy(lit.GetPointData().GetNormals()), atol=1e-7)  # brought to unit length again
        for i in range(lit.GetCellData().GetNumberOfArrays()):
            name = lit.GetCellData().GetArrayName(i)
            assert cells(data, name).tolist() == cells(lit, name).tolist(), name
            assert cells(data, name).dtype == cells(lit, name).dtype, name
        for i in range(lit.GetFieldData().GetNumberOfArrays()):
            name = lit.GetFieldData().GetArrayName(i)
            if name.endswith((".Name", ".Source", ".Image")):
                assert strings(data, name) == strings(lit, name), name
            elif name != names.PartMeshId():  # numbered anew
                assert table(data, name).tolist() == table(lit, name).tolist(), name

# A mesh from anywhere: quadrilaterals, no tables, no units.
cube = vtkCubeSource()
cube.Update()
bare = cube.GetOutput()
bare.GetPointData().Initialize()
path = save(bare, "cube.vtp", vtkXMLPolyDataWriter.Binary)
reader = read(path, lambda r: r.SetDefaultReflectance(0.1, 0.2, 0.3))
data = reader.GetOutput()
assert data.GetNumberOfCells() == 12
assert sorted(cells(data, names.SourceCellId())) == sorted(list(range(6)) * 2)
assert np.allclose(cells(data, names.Reflectance()), [0.1, 0.2, 0.3])
assert data.GetNumberOfPoints() == 24
assert json.loads(reader.GetReportJson())["cleaning"]["openEdges"] == 0
smooth = read(path, lambda r: r.SetFeatureAngle(100)).GetOutput()
assert smooth.GetNumberOfPoints() == 8

# Polygons and strips become triangles that know their cell; vertices and lines are left out.
mixed = vtkPolyData()
mixed.SetPoints(vtkPoints())
for x, y in [(0, 0), (1, 0), (1, 1), (0, 1), (2, 0), (2, 1), (3, 0)]:
    mixed.GetPoints().InsertNextPoint(x, y, 0)
for kind, ids in [("Verts", [6]), ("Lines", [4, 6]), ("Polys", [0, 1, 2, 3]), ("Strips", [1, 4, 2, 5])]:
    array = vtkCellArray()
    array.InsertNextCell(len(ids), ids)
    getattr(mixed, "Set" + kind)(array)
data = read(save(mixed, "mixed.vtp", vtkXMLPolyDataWriter.Binary)).GetOutput()
assert cells(data, names.SourceCellId()).tolist() == [2, 2, 3, 3]
corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
sides = points(data)[corners]
area = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])[:, 2] / 2
assert np.allclose(area, 0.5)  # all of them, and all the same way up

# What cannot be read ends in one error and an empty output, not in a crash.
with open(path, "rb") as file:
    whole = file.read()
with open(os.path.join(folder, "cut.vtp"), "wb") as file:
    file.write(whole[:len(whole) // 2])
with open(save(bare, "ascii.vtp", vtkXMLPolyDataWriter.Ascii)) as file:
    text = file.read()
write("type.vtp", text.replace('type="Float32"', 'type="Float3"'))
bad = [os.path.join(folder, "missing.obj"), os.path.join(folder, "missing.vtp"), os.path.join(folder, "cut.vtp"),
       os.path.join(folder, "type.vtp"), write("garbage.vtp", "no xml"), write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")]
for file in bad:
    heard = []
    reader = lambert.vtkRadiositySceneReader()
    reader.AddObserver(vtkCommand.ErrorEvent, lambda caller, event: heard.append(event))
    reader.SetFileName(file)
    reader.GetExecutive().AddObserver(vtkCommand.ErrorEvent, lambda caller, event: None)
    reader.Update()
    assert len(heard) == 1, file
    assert reader.GetOutput().GetNumberOfCells() == 0, file
    assert reader.GetReportJson() == ""

# A length of no sense is an error, too.
for length in (-1.0, float("nan"), float("inf")):
    heard = []
    reader = lambert.vtkRadiositySceneReader()
    reader.AddObserver(vtkCommand.ErrorEvent, lambda caller, event: heard.append(event))
    reader.GetExecutive().AddObserver(vtkCommand.ErrorEvent, lambda caller, event: None)
    reader.SetFileName(room)
    reader.SetMetresPerUnit(length)
    reader.Update()
    assert len(heard) == 1 and reader.GetOutput().GetNumberOfCells() == 0, length

# Every Set has its Get, and gives back what it was given.
reader = lambert.vtkRadiositySceneReader()
defaults = {"Weld": True, "RemoveZeroArea": True, "RemoveRepeated": True, "Orient": True, "FixEmitters": True,
            "TwoSidedEmitters": False, "OpaqueGlass": False, "BlackMetals": False}
for name, default in defaults.items():
    assert getattr(reader, "Get" + name)() is default, name
    getattr(reader, name + ("Off" if default else "On"))()
    assert getattr(reader, "Get" + name)() is not default, name
    before = reader.GetMTime()
    getattr(reader, "Set" + name)(default)
    assert getattr(reader, "Get" + name)() is default, name
    assert reader.GetMTime() > before, name
assert (reader.GetMetresPerUnit(), reader.GetFeatureAngle()) == (0, 30)
reader.SetMetresPerUnit(0.01)
reader.SetFeatureAngle(45)
assert (reader.GetMetresPerUnit(), reader.GetFeatureAngle()) == (0.01, 45)
assert reader.GetDefaultReflectance() == (0.5, 0.5, 0.5) and reader.GetSky() == (0, 0, 0)
reader.SetDefaultReflectance(0.1, 0.2, 0.3)
reader.SetSky(4, 5, 6)
assert reader.GetDefaultReflectance() == (0.1, 0.2, 0.3) and reader.GetSky() == (4, 5, 6)
reader.AddFileName("a.obj")
reader.AddFileName("b.obj")
assert (reader.GetNumberOfFileNames(), reader.GetFileName(), reader.GetFileName(1)) == (2, "a.obj", "b.obj")
reader.SetFileName("c.obj")
assert (reader.GetNumberOfFileNames(), reader.GetFileName(), reader.GetFileName(7)) == (1, "c.obj", "")
reader.ClearFileNames()
assert reader.GetNumberOfFileNames() == 0
reader.AddMaterialSetting("x:two-sided")
assert reader.GetNumberOfMaterialSettings() == 1
reader.ClearMaterialSettings()
assert reader.GetNumberOfMaterialSettings() == 0
assert "FeatureAngle: 45" in str(reader)
