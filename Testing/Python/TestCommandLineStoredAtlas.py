"""`lambert solve --atlas`: a light map on an atlas that is there is the one that the run would have laid flat, to the bit."""
import os
import shutil

from CommandLine import CORNELL_BOX, DATA, fails, run, solve, temporary
from PolyDataFile import mesh_of
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

ROOMS = f"{DATA}/TwoRooms/TwoRooms.obj"
common = "--error", "0.3", "--iterations", "2", "--no-final-gather", "--page-format", "exr"
flat = temporary("flat.vtp")
packing = "--page-size", "128", "--stretch", "1.5", "--padding", "3"


def files_in(folder):
    """Their names and bytes."""
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            with open(os.path.join(place, name), "rb") as file:
                found[os.path.relpath(os.path.join(place, name), folder)] = file.read()
    return found


def compare(scene, model, mapped, atlas, *options):
    """All that comes out, the light map made by `options` and on the atlas."""
    folders, told = [temporary(name) for name in ("anew", "stored")], []
    for folder, how in zip(folders, (options, ("--atlas", atlas))):
        os.mkdir(folder)
        told.append(solve(scene, "-o", os.path.join(folder, model), *common, "--lightmap", os.path.join(folder, mapped),
                          *how)["light_map"])
    anew, stored = map(files_in, folders)
    assert anew.keys() == stored.keys() and {model, mapped} < anew.keys(), (anew.keys(), stored.keys())
    for name in anew:
        assert anew[name] == stored[name], name
    for key in told[0]:  # What is used of the pages is told by single precision.
        assert told[0][key] == told[1][key] or key == "utilisation" and abs(told[0][key] - told[1][key]) < 1e-5, key
    return stored


# As `lambert atlas` leaves it, for every output that a light map goes into.
laid = run("atlas", CORNELL_BOX, "-o", flat, *packing)
assert laid.returncode == 0, laid.stderr
for ending in ("vtp", "vtpc", "ply", "glb", "gltf", "html", "obj"):
    files = compare(CORNELL_BOX, "model." + ending, "map.vtp", flat, *packing)
assert {"model-0.png", "map-0.exr"} < files.keys()
with open(flat, "rb") as file:
    assert files["map.vtp"] == file.read()

# As a light map leaves it, whole and in pieces: both sides of a sheet, two pages, texels of several sizes.
sized = "--page-size", "128", "--pages", "2", "--texel-density", "illumination"
for ending in ("vtp", "vtpc"):
    written = temporary("earlier." + ending)
    solve(ROOMS, "-o", temporary("any.vtp"), *common, "--lightmap", written, *sized)
    for mapped in ("map.vtp", "map.vtpc"):
        assert "map-1.exr" in compare(ROOMS, "model.glb", mapped, written, *sized)

# As a light map of chosen surfaces and of parts leaves it: by the same options, and by none, what it holds stays in it.
fine = "--error", "0.3", "--iterations", "5", "--page-format", "exr"
for ending in ("vtp", "vtpc"):
    for chosen in (("--represent", "Floor:points"), ("--introduced", "20", "--split-surfaces")):
        folders = [temporary(f"{ending} by {chosen[0]} {run}") for run in range(3)]
        first = os.path.join(folders[0], "map." + ending)
        told = []
        for folder, how in zip(folders, (("--page-size", "128", *chosen), ("--atlas", first, *chosen), ("--atlas", first))):
            os.mkdir(folder)
            told.append(solve(ROOMS, "-o", os.path.join(folder, "model.glb"), *fine, "--lightmap", os.path.join(folder, "map." + ending),
                              *how)["representation"]["surfaces"])
        files = [files_in(folder) for folder in folders]
        assert files[0] == files[1] == files[2] and {"model.glb", "map-0.exr"} < files[0].keys(), (ending, chosen, files[0].keys())
        assert told[0] == told[1] and {"points", "lightmap"} == {s["chosen"] for s in told[2]}

# Choice on an atlas of all surfaces: what stays in the map lies where it lay, what does not leaves its place empty.
whole, some = temporary("whole.vtp"), temporary("some.vtp")
solve(ROOMS, "-o", temporary("any.vtp"), *fine, "--lightmap", whole, "--page-size", "128")
told = solve(ROOMS, "-o", temporary("any.glb"), *fine, "--lightmap", some, "--atlas", whole, "--represent", "Floor:points")
places = {}
for name in whole, some:
    mesh = mesh_of(name)
    coords, charts, faces, sides = (data.GetArray(array) for data, array in (
        (mesh.GetPointData(), "LightMapTCoords"), (mesh.GetCellData(), "ChartId"), (mesh.GetCellData(), "InputFaceId"),
        (mesh.GetCellData(), "Side")))
    places[name] = {(int(faces.GetValue(i)), int(sides.GetValue(i))): [coords.GetTuple(mesh.GetCell(i).GetPointId(c)) for c in range(3)]
                    for i in range(mesh.GetNumberOfCells()) if charts.GetValue(i) >= 0}
on_points = [s for s in told["representation"]["surfaces"] if s["chosen"] == "points"]
assert {s["material"] for s in on_points} == {"Floor"} and len(places[some]) == len(places[whole]) - sum(s["input_triangles"] for s in on_points)
assert all(places[whole][face] == place for face, place in places[some].items())

# Other methods and other light: the same places.
again = temporary("again.vtp")
solve(ROOMS, "-o", temporary("any.vtp"), "--method", "reference", "--samples", "4", "--sky", "1", "1", "1", "--set", "Lamp:emission=0",
      "--lightmap", again, "--atlas", written)
assert mesh_of(again).GetFieldData().GetArray("Atlas.PageSize").GetValue(0) == 128

# That of `lambert atlas` has one place for the two sides of a sheet.
rooms = temporary("rooms.vtp")
assert run("atlas", ROOMS, "-o", rooms, "--page-size", "128").returncode == 0
told = solve(ROOMS, "-o", temporary("any.glb"), *common, "--lightmap", again, "--atlas", rooms)["light_map"]
assert told["pages"] == 1 and not mesh_of(again).GetCellData().HasArray("Side") and mesh_of(written.replace(
    ".vtpc", ".vtp")).GetCellData().HasArray("Side")

# What an atlas decides is not asked for beside it; nor is it written over.
out, mapped = temporary("never.vtp"), ("--lightmap", temporary("never-map.vtp"))
for option, value in (("--pages", 1), ("--page-size", 64), ("--texel-size", 0.1), ("--padding", 2), ("--mip-levels", 0),
                      ("--stretch", 2), ("--texel-density", "uniform")):
    fails(2, "solve", CORNELL_BOX, "-o", out, *mapped, "--atlas", flat, option, value, says=[option, "--atlas"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--atlas", flat, says=["--atlas", "--lightmap"])
fails(2, "solve", CORNELL_BOX, "-o", out, *mapped, "--atlas", temporary("flat.obj"), says=["--atlas", ".vtp"])
fails(2, "solve", CORNELL_BOX, "-o", out, *mapped, "--atlas", "", says=["--atlas", "empty"])
for output in ("-o", "--lightmap", "--report"):
    given = {"-o": out, "--lightmap": mapped[1], "--report": temporary("never.json"), output: flat}
    fails(2, "solve", CORNELL_BOX, *sum(given.items(), ()), "--atlas", flat, says=["write over", "--atlas"])
piece = os.path.join(written[:-5], sorted(os.listdir(written[:-5]))[0])
fails(1, "solve", ROOMS, "-o", out, *mapped, "--atlas", written, "--report", piece, "--progress", "none", says=["write over"])


# What is none, or is of another scene, is told before anything is solved.
def changed(how):
    """The atlas of the Cornell box with something amiss."""
    mesh, name = vtkPolyData(), temporary("changed.vtp")
    mesh.DeepCopy(mesh_of(flat))
    how(mesh)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(mesh)
    writer.SetFileName(name)
    writer.Write()
    return name


def refused(name, *says, scene=CORNELL_BOX):
    fails(1, "solve", scene, "-o", out, *mapped, "--atlas", name, "--progress", "none", says=[name, *says])
    assert not os.path.exists(out)


solved = temporary("solved.vtp")
solve(CORNELL_BOX, "-o", solved, *common[:5])
refused(solved, "holds no atlas", "Atlas.PageSize")
refused(temporary("missing.vtp"), "cannot be opened")
refused(flat, "another scene", scene=ROOMS)
refused(written, "another scene")
fails(1, "solve", CORNELL_BOX, "-o", out, *mapped, "--atlas", flat, "--unit", "cm", "--progress", "none", says=["another scene"])
fails(1, "solve", ROOMS, "-o", out, *mapped, "--atlas", some, "--represent", "Floor:lightmap", "--progress", "none",
      says=[some, "no charts", "material Floor"])
for array, value, says in (("Atlas.PageSize", None, "Atlas.PageSize"), ("Atlas.PageSize", 0, "Atlas.PageSize"),
                           ("Atlas.PageSize", 1 << 30, "Atlas.PageSize"), ("Atlas.Padding", -1, "Atlas.Padding"),
                           ("Atlas.TexelSize", float("nan"), "Atlas.TexelSize")):
    refused(changed(lambda mesh: mesh.GetFieldData().RemoveArray(array) if value is None
                    else mesh.GetFieldData().GetArray(array).SetComponent(0, 0, value)), says)
for array, value, says in (("ChartId", None, "ChartId"), ("ChartId", 7, "out of order"),
                           ("PageId", 1 << 30, "out of order"), ("PageId", -1, "out of order")):
    refused(changed(lambda mesh: mesh.GetCellData().RemoveArray(array) if value is None
                    else mesh.GetCellData().GetArray(array).SetComponent(0, 0, value)), says)
refused(changed(lambda mesh: mesh.GetCellData().GetArray("PageId").Fill(1 << 30)), "more pages than charts")
for value in (float("nan"), -0.5, 2):
    refused(changed(lambda mesh: mesh.GetPointData().GetArray("LightMapTCoords").SetComponent(0, 1, value)), "no page")
refused(changed(lambda mesh: mesh.GetPoints().SetPoint(0, 0, 0, 9)), "another scene")
cut = temporary("cut.vtp")
shutil.copyfile(flat, cut)
with open(cut, "r+b") as file:
    file.truncate(os.path.getsize(cut) // 2)
refused(cut, "damaged")
print("stored atlas: passed")
