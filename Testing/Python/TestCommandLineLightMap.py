"""`lambert solve --lightmap`: the light in the texels is the light that probes read; seams are closed and told."""
import json

import numpy as np
from CommandLine import CORNELL_BOX, DATA, run, temporary
from PolyDataFile import mesh_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkHDRReader, vtkPNGReader

SIZE = 256
solved, mapped, report = temporary("map-solved.vtp"), temporary("map.vtp"), temporary("map.json")
probes, readings = temporary("map-probes.csv"), temporary("map-readings.csv")
common = (CORNELL_BOX, "-o", solved, "--error", "0.1", "--lightmap", mapped, "--page-size", str(SIZE))
done = run("solve", *common, "--report", report)
assert done.returncode == 0, done.stderr
told = json.load(open(report))["light_map"]
assert told["pages"] == 1 and told["page_size_texels"] == SIZE and told["covered_texels"] > SIZE * SIZE / 4
assert "light map" in json.load(open(report))["seconds"]


def page_of(name):
    """Irradiance by row from below and column."""
    reader = vtkHDRReader()
    reader.SetFileName(name)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)


# Every texel is lit by something; a reader of floats finds the light that a probe reads at the middle of each triangle.
page, mesh = page_of(mapped.replace(".vtp", "-0.hdr")), mesh_of(mapped)
assert page.shape == (SIZE, SIZE, 3) and np.isfinite(page).all() and page.min() >= 0
corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
points = vtk_to_numpy(mesh.GetPoints().GetData())[corners]
uv = vtk_to_numpy(mesh.GetPointData().GetArray("LightMapTCoords"))[corners].mean(axis=1)
normals = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
with open(probes, "w") as file:
    file.write("x,y,z,nx,ny,nz\n")
    for place, normal in zip(points.mean(axis=1), normals):
        file.write(",".join(f"{value:.9g}" for value in (*place, *normal)) + "\n")
again = run("solve", *common, "--probe", probes, "--probe-output", readings)
assert again.returncode == 0, again.stderr
rows = [line.split(",") for line in open(readings).read().splitlines()[1:]]
probed = np.array([[float(value) for value in row[6:9]] for row in rows])
column, row = (uv * SIZE).astype(int).T
found = page[row, column]
# A texel away light differs a little; sides that no light reaches have no place.
lit = np.array([r[9] == "surface" for r in rows]) & (probed.mean(axis=1) > 0.05 * probed.mean())
assert lit.sum() > 20
assert np.median(np.abs(found[lit] - probed[lit]).mean(axis=1) / probed[lit].mean(axis=1)) < 0.05

# The same pages as floats and, in linear tone, as codes: these are proportional to the light.
other = run("solve", *common, "--page-format", "exr", "--page-format", "png", "--tone", "linear", "--exposure", "-1")
assert other.returncode == 0, other.stderr
with open(mapped.replace(".vtp", "-0.exr"), "rb") as file:
    assert file.read(4) == b"\x76\x2f\x31\x01"  # Its texels are the business of LightMapPagesTest.
reader = vtkPNGReader()
reader.SetFileName(mapped.replace(".vtp", "-0.png"))
reader.Update()
codes = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(SIZE, SIZE, 3) / 255.
shown = np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)
brightest = np.arange(3) == page.argmax(axis=2)[:, :, None]
seen = brightest & (codes > 0.4) & (codes.max(axis=2) < 1)[:, :, None]
assert seen.sum() > SIZE * SIZE / 4
ratio = shown[seen] / page[seen]
# Half a code of 102 is 1.2 %, half a step of Radiance 0.4 % and less.
assert np.abs(ratio / np.median(ratio) - 1).max() < 0.02, np.abs(ratio / np.median(ratio) - 1).max()

# A smooth closed surface has seams; closing them takes most of the difference.
sphere = run("solve", f"{DATA}/SphereByLamp/SphereByLamp.obj", "-o", solved, "--error", "0.2", "--lightmap", mapped,
             "--page-size", "512", "--report", report)
assert sphere.returncode == 0, sphere.stderr
told = json.load(open(report))["light_map"]
assert told["seam_points"] > 100
assert told["seams_after"]["rms"] < 0.3 * told["seams_before"]["rms"]
assert told["seams_after"]["largest"] <= told["seams_before"]["largest"]

# Finer texels where light varies: another map of as many pages; of what it takes is told.
followed = run("solve", *common, "--texel-density", "illumination", "--report", report)
assert followed.returncode == 0, followed.stderr
assert json.load(open(report))["light_map"]["pages"] == 1 and not np.array_equal(page_of(mapped.replace(".vtp", "-0.hdr")), page)
for wrong in (["--lightmap", mapped, "--texel-density", "fine"], ["--texel-density", "uniform"]):
    assert run("solve", CORNELL_BOX, "-o", solved, *wrong).returncode == 2, wrong

# Options of the atlas ask for a light map; names are checked first.
for wrong, code in ((["--page-size", "64"], 2), (["--page-format", "exr"], 2), (["--lightmap", mapped, "--page-format", "gif"], 2),
                    (["--lightmap", temporary("map.obj")], 2),
                    (["--lightmap", "/nowhere/map.vtp"], 1), (["--lightmap", solved], 2)):
    failed = run("solve", CORNELL_BOX, "-o", solved, *wrong)
    assert failed.returncode == code and failed.stderr.strip(), (wrong, failed.returncode, failed.stderr)

# Surfaces that are cut where refinement went: a row a part.
split = run("solve", *common, "--introduced", "500", "--split-surfaces", "--report", report)
assert split.returncode == 0, split.stderr
told = json.load(open(report))["representation"]
assert {"lightmap", "points"} == {s["chosen"] for s in told["surfaces"]}
assert mesh_of(mapped).GetNumberOfCells() == told["triangles"]
assert run("solve", *common, "--split-surfaces").returncode == 2

# Surfaces that refinement left alone, or whose material is wanted so, are lit by their points; the report tells what either costs.
shares = {}
for name, wanted in (("budget", ["--introduced", "500"]), ("wanted", ["--represent", "White:points"])):
    mixed = run("solve", *common, *wanted, "--report", report)
    assert mixed.returncode == 0, mixed.stderr
    shares[name] = told = json.load(open(report))["representation"]
    assert 0 < told["light_mapped"] < len(told["surfaces"])
    mesh = mesh_of(mapped)
    uv = vtk_to_numpy(mesh.GetPointData().GetArray("LightMapTCoords"))
    light = vtk_to_numpy(mesh.GetPointData().GetArray("Irradiance"))
    assert mesh.GetNumberOfCells() == told["triangles"]
    assert (uv == -1).any() and (uv >= 0).any() and np.isfinite(light).all() and light.max() > 0
    # Faces tell their chart, points what they were one of.
    chart, page, shared = (vtk_to_numpy(data.GetArray(name)) for data, name in (
        (mesh.GetCellData(), "ChartId"), (mesh.GetCellData(), "PageId"), (mesh.GetPointData(), "SharedPointId")))
    corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    by_points = (uv == -1).all(axis=1)[corners].all(axis=1)
    assert np.array_equal(chart == -1, by_points) and chart.max() >= 0 and (page == 0).all()
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    first_of = np.unique(shared, return_index=True, return_inverse=True)
    assert np.array_equal(points, points[first_of[1]][first_of[2]])
    assert mesh.GetFieldData().GetArray("Atlas.PageSize").GetValue(0) == SIZE
lit_by_points = [s for s in shares["budget"]["surfaces"] if s["chosen"] == "points"]
assert sum(max(0, s["refined_triangles"] - s["input_triangles"]) for s in lit_by_points) <= 500
for surface in shares["budget"]["surfaces"]:
    assert isinstance(surface["texels"], int) and surface["texels"] > 0 and surface["error_of_input_points"] >= 0
    assert (surface["error_of_light_map"] is not None) == (surface["chosen"] == "lightmap")
assert all(s["chosen"] == ("points" if s["material"] == "White" else "lightmap") for s in shares["wanted"]["surfaces"])

# Any surface by the name of its part or by its number in that report, whatever is wanted of its material.
of_report = {s["surface"]: s for s in shares["wanted"]["surfaces"]}
white = next(n for n, s in of_report.items() if s["material"] == "White")
other = next(n for n, s in of_report.items() if s["material"] != "White")
named = run("solve", *common, "--represent", "White:points", "--represent", f"surface={white}:lightmap", "--represent",
            f"surface={other}:points", "--report", report)
assert named.returncode == 0, named.stderr
for surface in json.load(open(report))["representation"]["surfaces"]:
    turned = surface["surface"] in (white, other)
    assert (surface["chosen"] != of_report[surface["surface"]]["chosen"]) == turned, surface
part = of_report[other]["part"]
named = run("solve", *common, "--represent", f"part={part}:points", "--report", report)
assert named.returncode == 0, named.stderr
assert all((s["chosen"] == "points") == (s["part"] == part) for s in json.load(open(report))["representation"]["surfaces"])
for wrong, code in ((["--represent", "White:paint"], 2), (["--represent", "NoSuch:points"], 1), (["--introduced", "-1"], 2),
                    (["--represent", "part=NoSuch:points"], 1), (["--represent", "surface=1e3:points"], 2),
                    (["--represent", "surface=123456:points"], 1), (["--represent", ":points"], 2)):
    failed = run("solve", *common, *wrong)
    assert failed.returncode == code and failed.stderr.strip(), (wrong, failed.returncode, failed.stderr)
