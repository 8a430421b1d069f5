"""A wall without thickness between a lit and a dim room: each side shows its own light in the light map, in a picture, in glTF, in OBJ."""
import numpy as np
from CommandLine import DATA, solve, temporary
from GltfModel import GltfModel
from PolyDataFile import mesh_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkIOImage import vtkHDRReader, vtkPNGReader
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

import lambert

SIZE, WALL, PARTITION = 512, 2.5, "Partition"
ROOMS = f"{DATA}/TwoRooms/TwoRooms.obj"
mapped, solved, glb, obj = (temporary(n) for n in ("map.vtp", "solved.vtp", "rooms.glb", "rooms.obj"))
common = ROOMS, "--error", "0.1", "--lightmap", mapped, "--page-size", SIZE
toned = *common, "--tone", "linear", "--exposure", "-2"


def faces_of(mesh):
    """Corners of the partition's faces, and which of all faces they are."""
    corners = vtk_to_numpy(mesh.GetPoints().GetData())[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    return corners, (np.abs(corners[:, :, 0] - WALL) < 1e-5).all(axis=1)


def image_of(reader, name):
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()


def texels_of(image):
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3).astype(float)


def towards_dim(corners):
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 0] > 0


def mean_on(corners, light):
    """Of the side of the lit room and that of the dim one, by area."""
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return [np.average(light[side], axis=0, weights=areas[side]) for side in (~towards_dim(corners), towards_dim(corners))]


# What the solution has on both sides: the partition's are some ten to one.
solve(*common, "-o", solved)
mesh = mesh_of(solved)
corners, on_wall = faces_of(mesh)
triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
irradiance = vtk_to_numpy(mesh.GetPointData().GetArray("Irradiance"))[triangles].mean(axis=1)
wanted = mean_on(corners[on_wall], irradiance[on_wall])
ratio = wanted[1].mean() / wanted[0].mean()
assert ratio < 0.2, ratio

# The light map has as much on either: two faces back to back, each with its own place and light.
mesh = mesh_of(mapped)
corners, on_wall = faces_of(mesh)
assert mesh.GetCellData().HasArray("Side") and towards_dim(corners[on_wall]).mean() == 0.5
image = image_of(vtkHDRReader(), mapped.replace(".vtp", "-0.hdr"))
uv = vtk_to_numpy(mesh.GetPointData().GetArray("LightMapTCoords"))[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
column, row = (uv[on_wall].mean(axis=1) * SIZE).astype(int).T
for found, light in zip(mean_on(corners[on_wall], texels_of(image)[row, column]), wanted):
    assert np.abs(found / light - 1).max() < 0.05, (found, light)  # A texel a face of a quarter of a metre.

# In a picture of it, from either room.
actor = lambert.vtkRadiosityActor()
actor.SetInputData(mesh)
actor.AddLightMapPage(image)
actor.GetToneMapping().SetCurveToLinear()
actor.GetToneMapping().SetExposure(-2)
actor.GetProperty().LightingOff()
renderer, window = vtkRenderer(), vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(0)
window.SetSize(64, 64)
window.AddRenderer(renderer)
renderer.AddActor(actor)
camera = renderer.GetActiveCamera()
camera.ParallelProjectionOn()
camera.SetParallelScale(0.4)
shown = []
for side in (-1, 1):
    camera.SetFocalPoint(WALL, 1.25, 0.5)
    camera.SetPosition(WALL + side * 0.2, 1.25, 0.5)
    renderer.ResetCameraClippingRange()
    window.Render()
    pixels = vtkUnsignedCharArray()
    window.GetPixelData(0, 0, 63, 63, 1, pixels, 0)
    codes = vtk_to_numpy(pixels).reshape(-1, 3) / 255.
    shown.append(np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4).mean())
near = (np.abs(corners.mean(axis=1) - (WALL, 1.25, 0.5)).max(axis=1) < 0.4) & on_wall
column, row = (uv[near].mean(axis=1) * SIZE).astype(int).T
light = mean_on(corners[near], texels_of(image)[row, column])
expected = light[1].mean() / light[0].mean()
assert abs(shown[1] / shown[0] / expected - 1) < 0.1, (shown, expected)  # Codes of some 40: a step is 3 %.

# Mixed with surfaces that their points light: still both sides, each with its way back to the one input face.
solve(*common, "-o", solved, "--represent", PARTITION + ":lightmap", "--introduced", "1000000")
mixed = mesh_of(mapped)
corners_of_mixed, on_wall_of_mixed = faces_of(mixed)
chart, face, side = (vtk_to_numpy(mixed.GetCellData().GetArray(name)) for name in ("ChartId", "InputFaceId", "Side"))
assert np.array_equal(chart >= 0, on_wall_of_mixed) and set(side[on_wall_of_mixed]) == {0, 1}
assert (np.unique(face[on_wall_of_mixed], return_counts=True)[1] == 2).all()
reader, clustering = lambert.vtkRadiositySceneReader(), lambert.vtkFaceClustering()
reader.SetFileName(ROOMS)
clustering.SetInputConnection(reader.GetOutputPort())
clustering.Update()
lowest, highest = (reach(faces_of(clustering.GetOutput(0))[0], axis=1)[face] for reach in (np.min, np.max))
assert ((corners_of_mixed.min(axis=1) > lowest - 1e-4) & (corners_of_mixed.max(axis=1) < highest + 1e-4)).all()

# In glTF, mixed and all under the map: both sides are in the page's mesh, and nothing of the wall beside it.
for options in (("--represent", PARTITION + ":lightmap", "--introduced", "1000000"), ()):
    solve(*toned, "-o", glb, *options)
    model = GltfModel(glb)
    (attributes, drawn, _), *others = model.primitives()
    corners = attributes["POSITION"][drawn]
    on_wall = (np.abs(corners[:, :, 0] - WALL) < 1e-5).all(axis=1)
    assert towards_dim(corners[on_wall]).mean() == 0.5
    for other, triangles, _ in others:
        assert not (np.abs(other["POSITION"][triangles][:, :, 0] - WALL) < 1e-5).all(axis=1).any()
    assert model.document["samplers"][0] == {"magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071}  # Trilinear
    png = temporary("rooms.png")
    with open(png, "wb") as file:
        file.write(model.view(model.document["images"][0]["bufferView"]))
    codes = texels_of(image_of(vtkPNGReader(), png)) / 255
    linear = np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)
    at = attributes["TEXCOORD_0"][drawn][on_wall].mean(axis=1) * (1, -1) + (0, 1)
    column, row = (at * SIZE).astype(int).T
    light = mean_on(corners[on_wall], linear[row, column])
    assert abs(light[1].mean() / light[0].mean() / ratio - 1) < 0.05, (light, ratio)

# In OBJ: the same faces.
solve(*toned, "-o", obj)
points = np.array([[float(v) for v in line.split()[1:4]] for line in open(obj) if line.startswith("v ")])
faces = np.array([[int(c.split("/")[0]) - 1 for c in line.split()[1:]] for line in open(obj) if line.startswith("f ")])
on_wall = (np.abs(points[faces][:, :, 0] - WALL) < 1e-5).all(axis=1)
assert np.array_equal(points[faces][on_wall][:, :, 1:].astype(np.float32), corners[(np.abs(corners[:, :, 0] - WALL) < 1e-5).all(axis=1)][:, :, 1:])
print("sheets: passed")
