"""One triangle from its file to the lit mesh, a texel and a pixel of the actor, and back: by part and face number."""
import os

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkCellPicker, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

import lambert
from CommandLine import temporary

# A room of named objects; faces of the shelf stand in the file after others, and the third of them is followed.
SHELF_FACE = np.array([[0.2, 0.3, 0.2], [0.2, 0.3, 0.9], [0.8, 0.3, 0.2]])
objects = {
    "floor": ("Wall", [(0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0)], [(1, 2, 3, 4)]),
    "lamp": ("Lamp", [(.3, .95, .3), (.7, .95, .3), (.7, .95, .7), (.3, .95, .7)], [(1, 2, 3, 4)]),
    "shelf": ("Wall", [*map(tuple, SHELF_FACE), (0.8, 0.3, 0.9), (0.9, 0.3, 0.9), (0.9, 0.3, 0.2)],
              [(3, 4, 5), (3, 5, 6), (1, 2, 3), (2, 4, 3)]),
}
path = temporary("room.obj")
with open(os.path.splitext(path)[0] + ".mtl", "w") as file:
    file.write("newmtl Wall\nKd 0.5 0.6 0.7\nnewmtl Lamp\nKd 0 0 0\nKe 1 1 1\n")
with open(path, "w") as file:
    file.write("mtllib room.mtl\n")
    count = 0
    for name, (material, points, faces) in objects.items():
        file.write(f"o {name}\nusemtl {material}\n")
        file.writelines("v {} {} {}\n".format(*point) for point in points)
        file.writelines("f " + " ".join(str(count + i) for i in face) + "\n" for face in faces)
        count += len(points)

reader = lambert.vtkRadiositySceneReader()
reader.SetFileName(path)
reader.Update()
clean = reader.GetOutput()
clusters = lambert.vtkFaceClustering()
clusters.SetInputConnection(reader.GetOutputPort())


def cells(data, name):
    return vtk_to_numpy(data.GetCellData().GetArray(name))


def corners(data):
    indices = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(data.GetPoints().GetData())[indices].astype(float)


def part_row(data, name):
    names = data.GetFieldData().GetAbstractArray("Part.Name")
    rows = [row for row in range(names.GetNumberOfValues()) if name in names.GetValue(row)]
    assert len(rows) == 1, rows
    return rows[0]


def area(triangles):
    return np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1) / 2


# The face by its name and number, in the clean mesh and in the order of the clusters.
for source in (reader, clusters):
    radiosity = lambert.vtkHierarchicalRadiosity()
    radiosity.SetInputConnection(0, source.GetOutputPort(0))
    if source is clusters:
        radiosity.SetInputConnection(1, source.GetOutputPort(1))
    radiosity.SetError(0.1)
    radiosity.Update()
    mesh, refined = radiosity.GetInputDataObject(0, 0), radiosity.GetOutput()
    shelf = cells(mesh, "PartId") == part_row(mesh, "shelf")
    face = np.flatnonzero(shelf & (cells(mesh, "SourceCellId") == 2))
    assert len(face) == 1, face
    assert np.allclose(np.sort(corners(mesh)[face[0]], axis=0), np.sort(SHELF_FACE, axis=0), atol=1e-6)

    # Its refined triangles name it, and its part and number with it; each lit side of it is covered once.
    mine = cells(refined, "InputFaceId") == face[0]
    assert mine.sum() > 2 and part_row(refined, "shelf") == part_row(mesh, "shelf")
    assert np.array_equal(mine, (cells(refined, "PartId") == part_row(refined, "shelf")) & (cells(refined, "SourceCellId") == 2))
    pieces = corners(refined)
    a, b, c = SHELF_FACE
    for side in np.unique(cells(refined, "Side")[mine]):
        covering = pieces[mine & (cells(refined, "Side") == side)]
        assert abs(area(covering).sum() - area(SHELF_FACE[None])[0]) < 1e-5  # Float positions in a room of 1 m.
        # Barycentric coordinates of every corner: inside, in the plane.
        solved = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), (covering - a).reshape(-1, 3).T, rcond=None)[0]
        assert solved.min() > -1e-5 and solved.sum(axis=0).max() < 1 + 1e-5
        assert np.abs(covering[..., 1] - 0.3).max() < 1e-6
        # The reversed side faces down, the front up.
        normals = np.cross(covering[:, 1] - covering[:, 0], covering[:, 2] - covering[:, 0])
        assert np.all(normals[:, 1] > 0) if side == 0 else np.all(normals[:, 1] < 0)

    # And its light is that of the lamp above it.
    points = vtk_to_numpy(refined.GetPolys().GetConnectivityArray()).reshape(-1, 3)[mine & (cells(refined, "Side") == 0)]
    assert vtk_to_numpy(refined.GetPointData().GetArray("Irradiance"))[points].min() > 0

# Laid flat it still names its part and number. The texels of its page hold the light of its refined triangles.
PAGE, PIXELS, WIDTH = 256, 161, 0.8
atlas = lambert.vtkRadiosityAtlas()
atlas.SetInputConnection(clusters.GetOutputPort(0))
atlas.SetClusterConnection(clusters.GetOutputPort(1))
atlas.SetSolutionConnection(radiosity.GetOutputPort(0))
atlas.SetPageSize(PAGE)
light_map = lambert.vtkRadiosityLightMap()
light_map.SetInputConnection(atlas.GetOutputPort())
light_map.SetSolutionConnection(radiosity.GetOutputPort(0))
light_map.Update()
laid, page = atlas.GetOutput(), light_map.GetOutput().GetBlock(0)
texels = vtk_to_numpy(page.GetPointData().GetScalars()).reshape(PAGE, PAGE, 3)
# The shelf is a sheet: of its two faces there, one a side, the upper one is followed.
up = np.cross(corners(laid)[:, 1] - corners(laid)[:, 0], corners(laid)[:, 2] - corners(laid)[:, 0])[:, 1] > 0
laid_face, = np.flatnonzero((cells(laid, "PartId") == part_row(laid, "shelf")) & (cells(laid, "SourceCellId") == 2) & up)
at_corners = vtk_to_numpy(laid.GetPolys().GetConnectivityArray()).reshape(-1, 3)[laid_face]
uv = vtk_to_numpy(laid.GetPointData().GetArray("LightMapTCoords"))[at_corners].astype(float)
p = corners(laid)[laid_face]
middles = corners(refined)[mine & (cells(refined, "Side") == 0)].mean(axis=1)
light = vtk_to_numpy(refined.GetPointData().GetArray("Irradiance"))[points].astype(float).mean(axis=1)
across = np.linalg.lstsq(np.stack([p[1] - p[0], p[2] - p[0]], axis=1), (middles - p[0]).T, rcond=None)[0].T
column, row = ((uv[0] + across @ (uv[1:] - uv[0])) * PAGE).astype(int).T
in_texels = texels[row, column].astype(float)
# The middle of a texel is half of one, some 4 mm, from that of a triangle; the lamp is 0.65 m away.
assert np.abs(in_texels / light - 1).max() < 0.05, np.abs(in_texels / light - 1).max()
assert light.max() / light.min() > 1.1  # Texels elsewhere on it have other light.

# Seen from above, under the lamp, its pixels show that light times its reflectance.
if lambert.vtkRadiosityImageWriter.IsDisplayAvailable():
    actor, renderer, window, grab = lambert.vtkRadiosityActor(), vtkRenderer(), vtkRenderWindow(), vtkWindowToImageFilter()
    actor.SetInputData(laid)
    actor.AddLightMapPage(page)
    actor.LinearLightOn()
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(WIDTH / 2)
    camera.SetFocalPoint(0.5, 0, 0.5)
    camera.SetPosition(0.5, 0.6, 0.5)
    camera.SetViewUp(0, 0, -1)
    camera.SetClippingRange(0.01, 1)
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(PIXELS, PIXELS)
    window.AddRenderer(renderer)
    window.Render()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    shown = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(PIXELS, PIXELS, 3) / 255.
    # Middles of refined triangles at least a pixel and a texel within the face; what lies over it is nothing.
    x, y = (((middles[:, [0, 2]] - 0.5) * (1, -1) / WIDTH + 0.5) * PIXELS).astype(int).T
    radiosity_there = light * (0.5, 0.6, 0.7)
    assert 0.05 < radiosity_there.min() and radiosity_there.max() < 0.95, radiosity_there  # The frame buffer holds [0, 1].
    # Half a code of 255 and what a texel may differ by.
    assert (np.abs(shown[y, x] - radiosity_there) < 0.5 / 255 + 0.05 * radiosity_there).all()

    # And a pixel leads back to the face in the file.
    picker = vtkCellPicker()
    picker.SetTolerance(0)
    assert picker.Pick(int(x[0]), int(y[0]), 0, renderer)
    picked = picker.GetCellId()
    assert cells(laid, "SourceCellId")[picked] == 2 and cells(laid, "PartId")[picked] == part_row(laid, "shelf")
    assert picker.GetActor() is actor and np.abs(np.array(picker.GetPickPosition()) - middles[0]).max() < WIDTH / PIXELS
