"""The filter from Python: texture coordinates, charts and pages, the tree from outside, errors."""
import lambert
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource


def cells(mesh, name):
    return vtk_to_numpy(mesh.GetCellData().GetArray(name))


def triangles(mesh):
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


source = vtkSphereSource()
source.SetThetaResolution(40)
source.SetPhiResolution(30)

atlas = lambert.vtkRadiosityAtlas()
atlas.SetInputConnection(source.GetOutputPort())
assert atlas.GetStretch() == 2 and atlas.GetPageSize() == 1024 and atlas.GetPages() == 1
assert atlas.GetTexelSize() == 0 and atlas.GetPadding() == 2
atlas.SetPageSize(256)
atlas.Update()
mesh = atlas.GetOutput()

# The sphere in a few charts; each triangle has an area on its page, all wound alike.
charts, pages = cells(mesh, "ChartId"), cells(mesh, "PageId")
assert len(np.unique(charts)) == atlas.GetNumberOfCharts() >= 2
assert atlas.GetNumberOfPages() == 1 and np.all(pages == 0)
uv = vtk_to_numpy(mesh.GetPointData().GetArray("LightMapTCoords"))
assert uv.shape == (mesh.GetNumberOfPoints(), 2) and uv.min() > 0 and uv.max() < 1
corners = uv[triangles(mesh)].astype(np.float64)
first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
areas = 0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
assert np.all(areas > 0)
assert abs(areas.sum() - atlas.GetUtilisation()) < 1e-3

# Points belong to one chart each; texels are as large as it says.
for chart in np.unique(charts):
    others = np.setdiff1d(triangles(mesh), triangles(mesh)[charts == chart])
    assert len(np.intersect1d(triangles(mesh)[charts == chart], others)) == 0
points = vtk_to_numpy(mesh.GetPoints().GetData())[triangles(mesh)].astype(np.float64)
world = 0.5 * np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1)
texel = np.sqrt(world.sum() / (areas.sum() * 256 ** 2))
assert abs(texel / atlas.GetDeliveredTexelSize() - 1) < 0.02

# The same with the tree of a clustering before it.
clustering = lambert.vtkFaceClustering()
clustering.SetInputConnection(source.GetOutputPort())
again = lambert.vtkRadiosityAtlas()
again.SetInputConnection(clustering.GetOutputPort(0))
again.SetClusterConnection(clustering.GetOutputPort(1))
again.SetPageSize(256)
again.Update()
assert np.array_equal(uv, vtk_to_numpy(again.GetOutput().GetPointData().GetArray("LightMapTCoords")))

# Texels of a given size take pages.
again.SetPageSize(64)
again.SetTexelSize(0.01)
again.Update()
assert again.GetNumberOfPages() > 1 and again.GetDeliveredTexelSize() == 0.01
assert cells(again.GetOutput(), "PageId").max() + 1 == again.GetNumberOfPages()

# Mip maps ask for padding.
again.SetMipLevels(2)
again.Update()
assert again.GetOutput().GetFieldData().GetArray("Atlas.Padding").GetValue(0) == 6 and again.GetPadding() == 2

# A wrong option, and texels too small for anyone, are told once and leave nothing.
for change in (lambda a: a.SetStretch(0.5), lambda a: a.SetPages(0), lambda a: a.SetMipLevels(6), lambda a: a.SetTexelSize(1e-6)):
    wrong = lambert.vtkRadiosityAtlas()
    wrong.SetInputConnection(source.GetOutputPort())
    change(wrong)
    errors = []
    wrong.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    wrong.Update()
    assert len(errors) >= 1 and wrong.GetOutput().GetNumberOfCells() == 0
print("radiosity atlas: passed")
