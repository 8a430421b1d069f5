"""`lambert solve -o OUT.obj`: what other programs read is what a viewer of glTF draws; names with blanks; our own reader."""
import json
import os

import numpy as np
from CommandLine import CORNELL_BOX, fails, solve, temporary
from GltfModel import GltfModel, encoded
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

import lambert

SIZE = 128
name, glb = temporary("box under a map.obj"), temporary("box.glb")
common = CORNELL_BOX, "--error", "0.2", "--lightmap", temporary("map.vtp"), "--page-size", SIZE
solve(*common, "-o", name)
solve(*common, "-o", glb)
page, library = name.replace(".obj", "-0.png"), name.replace(".obj", ".mtl")
model = GltfModel(glb)
(by_map, drawn, material), (by_points, drawn_by_points, _) = model.primitives()

# The page is the image of the glTF model.
image = model.document["images"][0]
with open(page, "rb") as file:
    assert file.read() == model.view(image["bufferView"])
text = open(library).read()
assert "map_Kd box under a map-0.png\n" in text and text.count("illum 0") == text.count("newmtl") == 2

# Our own reader finds the faces, their places in the page, and its colours.
reader = lambert.vtkRadiositySceneReader()
reader.SetFileName(name)
for step in ("Weld", "RemoveZeroArea", "RemoveRepeated", "Orient", "FixEmitters"):
    getattr(reader, f"Set{step}")(False)
reader.Update()
mesh = reader.GetOutput()
assert not json.loads(reader.GetReportJson())["warnings"]
triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
points = vtk_to_numpy(mesh.GetPoints().GetData())
reflectance = vtk_to_numpy(mesh.GetCellData().GetArray("Reflectance"))
assert len(triangles) == len(drawn) + len(drawn_by_points)
assert np.array_equal(points[triangles[:len(drawn)]], by_map["POSITION"][drawn])  # To the bit
uv = vtk_to_numpy(mesh.GetPointData().GetTCoords())[triangles[:len(drawn)]]
assert np.allclose(uv * (1, -1) + (0, 1), by_map["TEXCOORD_0"][drawn], atol=1e-6)
assert not vtk_to_numpy(mesh.GetCellData().GetArray("Emittance")).any()

# A face that lies in one light has the texel of its middle; codes of the page against means over the face.
png = vtkPNGReader()
png.SetFileName(page)
png.Update()
texels = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars()).reshape(SIZE, SIZE, 3).astype(float)
column, row = (uv.mean(axis=1) * SIZE).astype(int).T
difference = np.abs(encoded(reflectance[:len(drawn)]) - texels[row, column]).mean(axis=1)
assert np.median(difference) < 10, np.median(difference)  # Light changes over a wall by some 60 codes.

# What no map holds has colours at its points, sRGB as glTF's are linear.
colors = by_points["COLOR_0"][drawn_by_points][:, :, :3].mean(axis=1)
assert np.abs(reflectance[len(drawn):] - np.minimum(colors, 0.98)).max() < 1e-4

# By points alone no image is written.
plain = temporary("plain.obj")
solve(CORNELL_BOX, "--error", "0.3", "-o", plain)
assert "map_Kd" not in open(plain.replace(".obj", ".mtl")).read()
assert not os.path.exists(plain.replace(".obj", "-0.png"))

# Files beside it count as outputs.
fails(2, "solve", *common[:3], "-o", name, "--lightmap", name.replace(".obj", ".vtp"), "--page-format", "png",
      says=["write over", "--output"])
fails(2, "solve", *common, "--keep-textures", "-o", name, says=["--keep-textures"])
os.remove(library)
os.mkdir(library)
fails(1, "solve", *common, "-o", name, says=["it is a folder"])
os.rmdir(library)
