"""`lambert solve -o OUT.glb`: what a viewer draws is the light of the solution, by points and by light map."""
import json
import os

import numpy as np
from CommandLine import CORNELL_BOX, DATA, fails, solve, temporary
from GltfModel import GltfModel, encoded, insist_on_valid
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import lambert

SIZE = 256
by_points, by_map, text = temporary("box.glb"), temporary("box-map.glb"), temporary("box.gltf")
solved, mapped = temporary("box.vtp"), temporary("map.vtp")
solve(CORNELL_BOX, "-o", solved, "--error", "0.1")
report = solve(CORNELL_BOX, "-o", by_points, "--error", "0.1", "--camera", "0.5,0.5,2,0.5,0.5,0,50")
solve(CORNELL_BOX, "-o", text, "--error", "0.1", "--camera", "0.5,0.5,2,0.5,0.5,0,50")
report_of_map = solve(CORNELL_BOX, "-o", by_map, "--error", "0.1", "--lightmap", mapped, "--page-size", SIZE)

# The solution in the colours that this project shows.
reader = vtkXMLPolyDataReader()
reader.SetFileName(solved)
colors = lambert.vtkRadiosityToneMapping()
colors.SetInputConnection(reader.GetOutputPort())
colors.Update()
shown = colors.GetOutput()
triangles = vtk_to_numpy(shown.GetPolys().GetConnectivityArray()).reshape(-1, 3)
points = vtk_to_numpy(shown.GetPoints().GetData())
codes = vtk_to_numpy(shown.GetPointData().GetArray("Colors")).astype(float)

# Points: COLOR_0 is linear, and encoded by the viewer it is our colour but for the last code.
model = GltfModel(by_points)
(attributes, drawn, material), = model.primitives()
assert "KHR_materials_unlit" in material["extensions"] and not material.get("doubleSided", False)
assert np.array_equal(attributes["POSITION"][drawn], points[triangles])
assert np.abs(encoded(attributes["COLOR_0"][drawn][:, :, :3]) - codes[triangles]).max() < 1.01
assert report["lit_model"]["clipped_points"] > 0  # The lamp
clipped = np.unique(drawn[(codes[triangles] == 255).any(axis=2)])
assert 0 < report["lit_model"]["clipped_points"] <= len(clipped)
camera, = model.document["cameras"]
assert abs(camera["perspective"]["yfov"] - np.radians(50)) < 1e-9
eye, = [node["matrix"] for node in model.document["nodes"] if "camera" in node]
assert np.allclose(eye, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0.5, 2, 1])

# As text it is the same document.
document = json.load(open(text))
assert document["buffers"][0].pop("uri").startswith("data:application/octet-stream;base64,")
assert document == model.document | {"buffers": [{"byteLength": len(model.buffer)}]}

# A light map: the texel at the middle of a face of the scene is our colour there, the mean of the corners' about it.
model = GltfModel(by_map)
(attributes, drawn, material), *others = model.primitives()
texture = model.document["textures"][material["pbrMetallicRoughness"]["baseColorTexture"]["index"]]
png = temporary("page.png")
with open(png, "wb") as file:
    file.write(model.view(model.document["images"][texture["source"]]["bufferView"]))
reader = vtkPNGReader()
reader.SetFileName(png)
reader.Update()
page = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(SIZE, SIZE, 3)  # Rows from below
assert report_of_map["lit_model"]["images"] == 1 and 0 < report_of_map["lit_model"]["clipped_texels"] < SIZE * SIZE / 8  # A tenth, and what chance adds
centres, normals = points[triangles].mean(axis=1), np.cross(points[triangles[:, 1]] - points[triangles[:, 0]],
                                                            points[triangles[:, 2]] - points[triangles[:, 0]])
differences = []
uv = attributes["TEXCOORD_0"]
assert uv.min() >= 0 and uv.max() <= 1
for corners in drawn:
    # Refined triangles of the same plane that hold a place of the face tell what should show there.
    place, at = attributes["POSITION"][corners].mean(axis=0), uv[corners].mean(axis=0)
    a, b, c = attributes["POSITION"][corners]
    normal = np.cross(b - a, c - a)
    aligned = np.einsum("ij,j->i", normals, normal) > 0.999 * np.linalg.norm(normals, axis=1) * np.linalg.norm(normal)
    nearest = np.argmin(np.where(aligned, np.linalg.norm(centres - place, axis=1), np.inf))
    texel = page[int((1 - at[1]) * SIZE), int(at[0] * SIZE)].astype(float)
    differences.append(np.abs(texel - codes[triangles[nearest]].mean(axis=0)).max())
# The nearest centre is up to half a refined triangle away, a texel 7 mm wide: some 5 codes in the median.
assert len(differences) > 20 and np.median(differences) < 6, np.median(differences)

# Sides that the map does not hold are coloured at their points; together they are every side that is lit.
assert len(others) <= 1
area = lambda p, t: np.linalg.norm(np.cross(p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]]), axis=1).sum() / 2
total = area(attributes["POSITION"], drawn) + sum(area(a["POSITION"], t) for a, t, _ in others)
assert abs(total - area(points, triangles)) < 1e-4 * total, (total, area(points, triangles))

# Several pages are several materials.
many = temporary("pages.glb")
told = solve(f"{DATA}/SphereByLamp/SphereByLamp.obj", "-o", many, "--error", "0.3", "--lightmap", mapped, "--page-size", "64",
             "--texel-size", "0.03")
model = GltfModel(many)
assert told["light_map"]["pages"] > 1 and len(model.document["images"]) == told["lit_model"]["images"] > 1
assert len(model.document["materials"]) == told["lit_model"]["meshes"] >= len(model.document["images"])

insist_on_valid(by_points, by_map, text, many)

# A full disk is said in one sentence.
full = temporary("full.glb")
if os.path.lexists(full):
    os.remove(full)
os.symlink("/dev/full", full)
fails(1, "solve", CORNELL_BOX, "-o", full, "--error", "0.5", "--iterations", "1", "--progress", "none",
      says=["could not be written"])
os.remove(full)
