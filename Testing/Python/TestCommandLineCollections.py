"""`.vtpc` wherever `.vtp` is written and read: a piece a surface, which together are the same scene."""
import json
import os
import subprocess

import numpy as np
from Collections import arrays_of, corners_of, pieces_of
from CommandLine import CORNELL_BOX, DATA, LAMBERT, run, solve, temporary, write_hdr
from PolyDataFile import mesh_of
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkIntArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkCompositeDataSet, vtkPartitionedDataSet,
                                           vtkPartitionedDataSetCollection, vtkPolyData)
from vtkmodules.vtkIOParallelXML import vtkXMLPartitionedDataSetCollectionWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

import lambert

ROOMS = os.path.join(DATA, "TwoRooms", "TwoRooms.obj")


def read(name):
    """The scene that Lambert finds in a file, and the account of it."""
    reader = lambert.vtkRadiositySceneReader()
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput(), json.loads(reader.GetReportJson())


def assert_same(first, second):
    """The same names and numbers, to the bit."""
    assert first.keys() == second.keys(), first.keys() ^ second.keys()
    for name in first:
        assert np.array_equal(first[name], second[name]), name


def assert_same_scene(first, second):
    assert np.array_equal(corners_of(first), corners_of(second))
    for get in ("GetPointData", "GetCellData", "GetFieldData"):
        assert_same(arrays_of(getattr(first, get)()), arrays_of(getattr(second, get)()))
    assert np.array_equal(first.GetPoints().GetData(), second.GetPoints().GetData())


def assert_pieces(whole, collection):
    """The pieces are the parts of the whole: their faces and tables, and the points that these use."""
    names, pieces = pieces_of(collection)
    points, cells, fields = (arrays_of(data) for data in (whole.GetPointData(), whole.GetCellData(), whole.GetFieldData()))
    assert len(names) == len(fields["Part.Name"])
    corners, seen = corners_of(whole), 0
    places = np.asarray(whole.GetPoints().GetData())
    used = set()
    for part, (name, piece) in enumerate(zip(names, pieces)):
        assert (name or "") == fields["Part.Name"][part]
        faces = np.flatnonzero(cells["PartId"] == part)
        seen += len(faces)
        assert piece.GetNumberOfCells() == len(faces), name

        # All arrays of its faces and of their corners; no point more.
        own = corners_of(piece)
        assert sorted(set(own.ravel())) == list(range(piece.GetNumberOfPoints())), name
        assert piece.GetNumberOfPoints() == len(set(corners[faces].ravel())), name
        assert_same(arrays_of(piece.GetCellData()), {key: value[faces] for key, value in cells.items()})
        assert_same({key: value[own] for key, value in arrays_of(piece.GetPointData()).items()},
                    {key: value[corners[faces]] for key, value in points.items()})
        assert np.array_equal(np.asarray(piece.GetPoints().GetData()).reshape(-1, 3)[own], places[corners[faces]]), name
        assert (piece.GetPointData().GetNormals() is None) == (whole.GetPointData().GetNormals() is None)

        # Its rows of the tables of parts and materials, all others whole.
        tables = arrays_of(piece.GetFieldData())
        rows = {"Part.": tables.pop("Part.Row"), "Material.": tables.pop("Material.Row")}
        assert rows["Part."].tolist() == [part]
        assert set(cells["MaterialId"][faces]) <= set(rows["Material."]), name
        used.update(rows["Material."])
        assert_same(tables, {key: next((np.array(value)[rows[table]] for table in rows if key.startswith(table)), value)
                             for key, value in fields.items()})
    assert seen == whole.GetNumberOfCells()
    assert used == set(range(len(fields["Material.Name"])))


# A solution: both sides of a sheet, several lights, a camera and an environment.
surroundings = write_hdr(temporary("surroundings.hdr"), np.ones((2, 4, 3)))
arguments = [ROOMS, "--error", "0.3", "--iterations", "2", "--environment", surroundings, "--sun", "30", "40", "9", "8", "7",
             "--sky", "1", "1", "1", "--page-size", "128"]
written = {}
for ending in ("vtp", "vtpc"):
    written[ending] = {kind: temporary(f"{kind}.{ending}") for kind in ("solved", "mapped")}
    temporary("solved")
    temporary("mapped")
    solve(*arguments, "-o", written[ending]["solved"], "--lightmap", written[ending]["mapped"])
for kind in ("solved", "mapped"):
    whole = mesh_of(written["vtp"][kind])
    assert_pieces(whole, written["vtpc"][kind])
    (first, told), (second, told_of_pieces) = read(written["vtp"][kind]), read(written["vtpc"][kind])
    assert_same_scene(first, second)
    assert len(arrays_of(first.GetFieldData())["Light.Type"]) == 3
    assert told["cleaning"] == told_of_pieces["cleaning"]
    assert told["read"]["faces"] == told_of_pieces["read"]["faces"] > 0
assert {0, 1} == set(arrays_of(mesh_of(written["vtp"]["solved"]).GetCellData())["Side"])
names, pieces = pieces_of(written["vtpc"]["solved"])
assert names == ["Floor", "Ceiling", "WestWall", "EastWall", "NorthWall", "SouthWall", "Partition", "Lamp"], names
assert set(arrays_of(pieces[names.index("Partition")].GetCellData())["Side"]) == {0, 1}

# A scene whose surfaces show their light in two ways, and one laid flat, from pieces or from the whole.
for case, command in (("represented", ["solve", *arguments, "-o", temporary("any.ply"), "--introduced", "100", "--lightmap"]),
                      ("flat", ["atlas", written["vtp"]["solved"], "-o"]),
                      ("flat again", ["atlas", written["vtpc"]["solved"], "-o"])):
    for ending in ("vtp", "vtpc"):
        temporary(case)
        done = run(*command, temporary(f"{case}.{ending}"), "--progress", "none")
        assert done.returncode == 0, done.stderr
    directory = os.path.dirname(temporary("any.ply"))
    assert_pieces(mesh_of(os.path.join(directory, case + ".vtp")), os.path.join(directory, case + ".vtpc"))
coordinates = [arrays_of(mesh_of(os.path.join(directory, case + ".vtp")).GetPointData())["LightMapTCoords"]
               for case in ("flat", "flat again")]
assert np.array_equal(*coordinates)

# What is solved from the pieces is what is solved from the whole; the other methods write them, too.
for ending in ("vtp", "vtpc"):
    solve(written[ending]["solved"], "-o", temporary(f"again-{ending}.vtp"), "--method", "reference", "--samples", "4")
assert_same_scene(*(mesh_of(os.path.join(directory, f"again-{ending}.vtp")) for ending in ("vtp", "vtpc")))
solve(CORNELL_BOX, "-o", temporary("simple.VTPC"), "--method", "progressive", "--simplify", "0.1")
assert pieces_of(os.path.join(directory, "simple.VTPC"))[0][-1] == "Lamp"

# A piece alone names its own surface and material.
lone, account = read(os.path.join(directory, "solved", "solved-0-6.vtp"))
assert arrays_of(lone.GetFieldData())["Part.Name"] == ["Partition"]
assert arrays_of(lone.GetFieldData())["Material.Name"] == ["Partition"]
assert set(arrays_of(lone.GetCellData())["PartId"]) == {0} == set(arrays_of(lone.GetCellData())["MaterialId"])

# Settings by material find it once.
done = run("info", written["vtpc"]["solved"], "--set", "Plaster:reflectance=0.125,0.25,0.5")
rows = [line.split() for line in done.stdout.splitlines() if "Plaster" in line]
assert rows == [["Plaster", "0.125", "0.250", "0.500"]], (done.stdout, done.stderr)


def poly_data(squares, height=0.0):
    """Unit squares side by side, two triangles each."""
    points, faces = vtkPoints(), vtkCellArray()
    for i in range(squares):
        for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
            points.InsertNextPoint(2 * i + x, y, height)
        for corners in ((0, 1, 2), (0, 2, 3)):
            faces.InsertNextCell(3, [4 * i + c for c in corners])
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(faces)
    return data


def numbers(name, rows, kind=vtkIntArray):
    array = kind()
    array.SetName(name)
    rows = np.asarray(rows).reshape(len(rows), -1)
    array.SetNumberOfComponents(rows.shape[1])
    for row in rows:
        array.InsertNextTuple(row.tolist())
    return array


def strings(name, rows):
    array = vtkStringArray()
    array.SetName(name)
    for row in rows:
        array.InsertNextValue(row)
    return array


# Names that need care; surfaces without faces, materials without surfaces.
awkward = ["a/b", "../up", 'say "hi" & <go>', "K\u00fcche \U0001f4a1", "same", "same", "", "dark", "two\nlines\tof it", "nul\x01"]
lit = [row for row, name in enumerate(awkward) if name != "dark"]
scene = poly_data(len(lit))
scene.GetCellData().AddArray(numbers("PartId", np.repeat(lit, 2)))
scene.GetCellData().AddArray(numbers("MaterialId", [3 - cell % 2 for cell in range(2 * len(lit))]))
fields = scene.GetFieldData()
fields.AddArray(strings("Part.Name", awkward))
fields.AddArray(numbers("Part.ObjectToWorld", [np.eye(4).ravel() * (row + 1) for row in range(len(awkward))], vtkFloatArray))
fields.AddArray(strings("Material.Name", ["unused", "grey", "grey", "red"]))
fields.AddArray(numbers("Material.Reflectance", [[0.1] * 3, [0.5] * 3, [0.5] * 3, [0.8, 0.2, 0.2]], vtkFloatArray))
writer = vtkXMLPolyDataWriter()
writer.SetFileName(temporary("awkward.vtp"))
writer.SetInputData(scene)
assert writer.Write() == 1
for ending in ("vtp", "vtpc"):
    temporary("awkward out")
    assert run("atlas", os.path.join(directory, "awkward.vtp"), "-o", temporary("awkward out." + ending), "--progress",
               "none").returncode == 0
collection = os.path.join(directory, "awkward out.vtpc")
names, pieces = pieces_of(collection)
assert names == [{"": None, "nul\x01": "nul\ufffd"}.get(name, name) for name in awkward], names
assert [piece.GetNumberOfCells() for piece in pieces] == [2 if row in lit else 0 for row in range(len(awkward))]
assert set(os.listdir(os.path.join(directory, "awkward out"))) == {f"awkward out-0-{row}.vtp" for row in range(len(awkward))}
(first, _), (second, _) = read(os.path.join(directory, "awkward out.vtp")), read(collection)
assert_same_scene(first, second)
assert arrays_of(second.GetFieldData())["Part.Name"] == awkward
assert arrays_of(second.GetFieldData())["Material.Name"] == ["unused", "grey", "grey", "red"]

# An output whose own name is no text.
for name in ("K\u00fcche 1 & 2", os.fsdecode(b"no\xfftext")):
    path, plain = temporary(name + ".vtpc"), temporary("plain.vtpc")
    for command in (["atlas", CORNELL_BOX, "-o", path, "--progress", "none"], ["info", path]):
        done = subprocess.run([LAMBERT, *command], capture_output=True)
        assert done.returncode == 0, done.stderr
    os.rename(path, plain)  # Its pieces have names that VTK takes.
    assert len(pieces_of(plain)[0]) == 8 and read(plain)[0].GetNumberOfCells() > 0

# Written anew, by a smaller scene: no piece of the earlier one stays, all else does.
folder = temporary("anew")
os.makedirs(folder)
with open(os.path.join(folder, "notes.txt"), "w") as file:
    file.write("own")
small = temporary("small.vtp")
writer.SetFileName(small)
writer.SetInputData(poly_data(1))
assert writer.Write() == 1
for source, count in ((CORNELL_BOX, 8), (small, 1), (CORNELL_BOX, 8)):
    target = os.path.join(directory, "anew.vtpc")
    assert run("atlas", source, "-o", target, "--progress", "none").returncode == 0
    assert len(os.listdir(folder)) == count + 1 and len(pieces_of(target)[0]) == count, os.listdir(folder)
with open(os.path.join(folder, "notes.txt")) as file:
    assert file.read() == "own"

# Collections of others: VTK's writer, several pieces a name, arrays and tables that differ.
grey, lamp, bare = poly_data(2), poly_data(1, 1.0), poly_data(1, 2.0)
grey.GetCellData().AddArray(numbers("Reflectance", [[0.25] * 3] * 4, vtkFloatArray))
lamp.GetCellData().AddArray(numbers("Emittance", [[7.0] * 3] * 2, vtkFloatArray))
lamp.GetFieldData().AddArray(strings("Material.Name", ["bulb"]))
lamp.GetFieldData().AddArray(numbers("Material.Reflectance", [[0.0] * 3], vtkFloatArray))
foreign = vtkPartitionedDataSetCollection()
for i, (name, parts) in enumerate((("Table & chair", [grey, bare]), ("Bulb", [lamp]))):
    partitions = vtkPartitionedDataSet()
    for j, part in enumerate(parts):
        partitions.SetPartition(j, part)
    foreign.SetPartitionedDataSet(i, partitions)
    foreign.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
writer = vtkXMLPartitionedDataSetCollectionWriter()
writer.SetFileName(temporary("foreign.vtpc"))
writer.SetInputData(foreign)
assert writer.Write() == 1
data, account = read(os.path.join(directory, "foreign.vtpc"))
tables, cells = arrays_of(data.GetFieldData()), arrays_of(data.GetCellData())
assert tables["Part.Name"] == ["Table & chair", "Table & chair", "Bulb"]
assert cells["PartId"].tolist() == [0, 0, 0, 0, 1, 1, 2, 2] and account["read"]["faces"] == 8
assert np.allclose(cells["Reflectance"][:, 0], [0.25] * 4 + [0.5] * 4) and cells["Emittance"].max() == 7
assert tables["Material.Name"][cells["MaterialId"][-1]] == "bulb"
