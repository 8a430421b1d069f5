"""One triangle from its file to the lit mesh and back: by part and face number, and by its refined triangles."""
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

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
    file.write("newmtl Wall\nKd 0.5 0.6 0.7\nnewmtl Lamp\nKd 0 0 0\nKe 5 5 5\n")
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
