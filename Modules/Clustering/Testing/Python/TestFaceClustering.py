"""The filter from Python: order of the faces, cluster ids, the table, statistics and errors."""
import lambert
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy, numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIntArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource


def column(table, name):
    return vtk_to_numpy(table.GetColumnByName(name))


def cells(mesh, name):
    return vtk_to_numpy(mesh.GetCellData().GetArray(name))


def triangles(mesh):
    corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(mesh.GetPoints().GetData())[corners]


source = vtkSphereSource()
source.SetThetaResolution(40)
source.SetPhiResolution(30)
source.Update()
sphere = source.GetOutput()
face_count = sphere.GetNumberOfCells()
reflectance = np.random.default_rng(1).random((face_count, 3)).astype(np.float32) * 0.9
array = numpy_to_vtk(reflectance, deep=True)
array.SetName("Reflectance")
sphere.GetCellData().AddArray(array)

clustering = lambert.vtkFaceClustering()
clustering.SetInputData(sphere)
assert clustering.GetBalance() == 0.01 and clustering.GetLevel() == 0
clustering.SetClusterCount(20)
clustering.Update()
mesh, table = clustering.GetOutputDataObject(0), clustering.GetOutputDataObject(1)

# The faces are those of the input, in another order, with what was theirs.
old = cells(mesh, "SourceCellId")
assert mesh.GetNumberOfCells() == face_count
assert np.array_equal(np.sort(old), np.arange(face_count))
assert np.array_equal(triangles(mesh), triangles(sphere)[old])
assert np.array_equal(cells(mesh, "Reflectance"), reflectance[old])
assert np.all(cells(mesh, "SurfaceId") == 0)

# The table is a binary tree over ranges of faces.
parent, child = column(table, "Parent"), column(table, "Child")
first, count = column(table, "FirstFace"), column(table, "FaceCount")
assert table.GetNumberOfRows() == 2 * face_count - 1 == clustering.GetNumberOfNodes()
inner = np.flatnonzero(child >= 0)
for side in (0, 1):
    assert np.array_equal(parent[child[inner] + side], inner)
assert np.array_equal(count[child[inner]] + count[child[inner] + 1], count[inner])
assert np.array_equal(first[child[inner]] + count[child[inner]], first[child[inner] + 1])
assert np.flatnonzero(parent < 0).tolist() == [0] and count[0] == face_count

# Area and vector area are those of the faces; the bounds hold them.
p = triangles(mesh).astype(np.float64)
normals = 0.5 * np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
areas = np.linalg.norm(normals, axis=1)
bounds = column(table, "Bounds")
for node in range(0, table.GetNumberOfRows(), 37):
    faces = slice(first[node], first[node] + count[node])
    total = areas[faces].sum()
    # Float sums over some thousand faces.
    assert abs(column(table, "Area")[node] - total) < 1e-5 * total
    assert np.linalg.norm(column(table, "VectorArea")[node] - normals[faces].sum(axis=0)) < 1e-5 * total
    corners = p[faces].reshape(-1, 3)
    assert np.array_equal(bounds[node, 0::2], corners.min(axis=0))
    assert np.array_equal(bounds[node, 1::2], corners.max(axis=0))

# ClusterId names rows of the table whose ranges hold the cells.
ids = cells(mesh, "ClusterId")
assert len(np.unique(ids)) == 20
for cluster in np.unique(ids):
    assert np.array_equal(np.flatnonzero(ids == cluster), first[cluster] + np.arange(count[cluster]))
clustering.SetClusterCount(0)
clustering.SetLevel(3)
clustering.Update()
assert len(np.unique(cells(clustering.GetOutput(), "ClusterId"))) == 8

# Balance is part of the answer.
def roundness(balance):
    clustering.SetBalance(balance)
    clustering.SetClusterCount(200)
    clustering.Update()
    nodes = np.unique(cells(clustering.GetOutput(), "ClusterId"))
    extent = column(clustering.GetOutputDataObject(1), "Bounds")[nodes]
    return ((extent[:, 1::2] - extent[:, 0::2]) ** 2).sum()


assert roundness(0.0) != roundness(10.0)

# Statistics of a sphere.
assert clustering.GetNumberOfSurfaces() == 1
assert clustering.GetNumberOfNonManifoldEdges() == 0 and clustering.GetNumberOfInconsistentEdges() == 0
assert 0 < clustering.GetMaximumDepthOverLog() < 4
assert clustering.GetMaximumDepth() >= np.log2(face_count)
assert clustering.GetClusteringSeconds() > 0

# Parts and materials cut.
part = vtkIntArray()
part.SetName("PartId")
for face in range(face_count):
    part.InsertNextValue(face % 2)
sphere.GetCellData().AddArray(part)
sphere.Modified()
clustering.Update()
ids = cells(clustering.GetOutput(), "SurfaceId")
parts = cells(clustering.GetOutput(), "PartId")
assert clustering.GetNumberOfSurfaces() == ids.max() + 1 >= 2
for surface in np.unique(ids):
    assert len(np.unique(parts[ids == surface])) == 1

# Other colours, or another cut, in the order of the tree that there is.
seconds = clustering.GetClusteringSeconds()
paint = numpy_to_vtk(np.full((sphere.GetNumberOfCells(), 3), 0.25, np.float32), deep=1)
paint.SetName("Reflectance")
sphere.GetCellData().AddArray(paint)
sphere.Modified()
clustering.SetLevel(1)
clustering.Update()
assert clustering.GetClusteringSeconds() == seconds
assert (cells(clustering.GetOutput(), "Reflectance") == 0.25).all()
assert np.array_equal(cells(clustering.GetOutput(), "SurfaceId"), ids)

# A wrong option is told once and leaves no tree.
errors = []
clustering.AddObserver("ErrorEvent", lambda *_: errors.append(1))
clustering.SetBalance(-1)
clustering.Update()
assert len(errors) >= 1

# Normals of no direction or length are made anew, as where there are none; longer ones keep their direction.
odd = vtkPolyData()
odd.DeepCopy(source.GetOutput())
normals = np.tile(np.array([0, 0, 2], np.float32), (odd.GetNumberOfPoints(), 1))
normals[::3], normals[1::3] = np.nan, 0
odd.GetPointData().SetNormals(numpy_to_vtk(normals, deep=1))
clusters = lambert.vtkFaceClustering()
clusters.SetInputData(odd)
clusters.Update()
made = vtk_to_numpy(clusters.GetOutput().GetPointData().GetNormals())
assert np.allclose(np.linalg.norm(made, axis=1), 1)
assert np.isclose(made, [0, 0, 1]).all(axis=1).sum() >= len(normals[2::3])
print("face clustering: passed")
