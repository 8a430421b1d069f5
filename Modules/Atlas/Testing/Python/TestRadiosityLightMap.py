"""The filter from Python: texels hold the light of the solution, and of the three steps only what changed is done again."""
import os

import lambert
import numpy as np
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkPolyData

reader = lambert.vtkRadiositySceneReader()
reader.SetFileName(os.path.join(os.environ["LAMBERT_DATA_DIR"], "CornellBox", "CornellBox.obj"))
clustering = lambert.vtkFaceClustering()
clustering.SetInputConnection(reader.GetOutputPort())
solver = lambert.vtkHierarchicalRadiosity()
solver.SetInputConnection(clustering.GetOutputPort(0))
solver.SetInputConnection(1, clustering.GetOutputPort(1))
solver.SetError(0.2)
solver.SetIterations(2)
solver.SetFinalGather(False)
atlas = lambert.vtkRadiosityAtlas()
atlas.SetInputConnection(clustering.GetOutputPort(0))
atlas.SetClusterConnection(clustering.GetOutputPort(1))
atlas.SetPageSize(128)
light_map = lambert.vtkRadiosityLightMap()
light_map.SetInputConnection(atlas.GetOutputPort())
light_map.SetSolutionConnection(solver.GetOutputPort(0))


def counts():
    """Of a run: how often faces were taken in, cut into charts, packed, and light drawn."""
    light_map.Update()
    return (atlas.GetNumberOfReadings(), atlas.GetNumberOfSegmentations(), atlas.GetNumberOfPackings(),
            light_map.GetNumberOfDrawings())


def page(number=0):
    image = light_map.GetOutput().GetBlock(number)
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)


# A page of light, row by row from below.
assert counts() == (1, 1, 1, 1)
assert light_map.GetOutput().GetNumberOfBlocks() == 1 and page().shape == (128, 128, 3)
assert light_map.GetCoveredTexels() > 128 * 128 / 4 and np.isfinite(page()).all() and page().min() >= 0
assert light_map.GetSeamRmsAfter() <= light_map.GetSeamRmsBefore()

# Where a point of the solution lies in its input face, the texel has its light.
laid, solved = atlas.GetOutput(), solver.GetOutput(0)
triangles = vtk_to_numpy(laid.GetPolys().GetConnectivityArray()).reshape(-1, 3)
corners = vtk_to_numpy(laid.GetPoints().GetData())[triangles].astype(float)
uv = vtk_to_numpy(laid.GetPointData().GetArray("LightMapTCoords"))[triangles].astype(float)
refined = vtk_to_numpy(solved.GetPolys().GetConnectivityArray()).reshape(-1, 3)
faces = vtk_to_numpy(solved.GetCellData().GetArray("InputFaceId"))
middles = vtk_to_numpy(solved.GetPoints().GetData())[refined].astype(float).mean(axis=1)
light = vtk_to_numpy(solved.GetPointData().GetArray("Irradiance"))[refined].astype(float).mean(axis=1)
errors, texels = [], page()
for face, middle, irradiance in zip(faces, middles, light):
    a, b, c = corners[face]
    across = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), middle - a, rcond=None)[0]
    at = uv[face][0] + across @ (uv[face][1:] - uv[face][0])
    errors.append(np.abs(texels[int(at[1] * 128), int(at[0] * 128)] - irradiance).mean() / light.mean())
# Half a texel is 7 mm of half a metre; the dimmer sides of walls are a few.
assert np.median(errors) < 0.03, np.median(errors)

# Nothing new: nothing is done. Another solution draws alone; another page packs the same charts; finer light on the same.
assert counts() == (1, 1, 1, 1)
before = page().copy()
solver.SetIterations(3)
assert counts() == (1, 1, 1, 2) and not np.array_equal(page(), before)
atlas.SetPadding(3)
assert counts() == (1, 1, 2, 3)
atlas.SetPageSize(256)
assert counts() == (1, 1, 3, 4) and page().shape == (256, 256, 3)
# Charts that stretch less are other charts; another scene begins anew.
atlas.SetStretch(1.5)
assert counts() == (1, 2, 4, 5)
reader.SetDefaultReflectance(0.4, 0.4, 0.4)
assert counts() == (2, 3, 5, 6)

# What was kept is what a filter makes that has nothing to keep.
fresh = lambert.vtkRadiosityAtlas()
fresh.SetInputConnection(clustering.GetOutputPort(0))
fresh.SetClusterConnection(clustering.GetOutputPort(1))
atlas.SetStretch(2)
atlas.SetPadding(2)
for name in ("Stretch", "Padding", "PageSize"):
    getattr(fresh, "Set" + name)(getattr(atlas, "Get" + name)())
light_map.Update()
fresh.Update()
for name in ("LightMapTCoords", "SharedPointId"):
    assert np.array_equal(vtk_to_numpy(fresh.GetOutput().GetPointData().GetArray(name)),
                          vtk_to_numpy(atlas.GetOutput().GetPointData().GetArray(name))), name

# Progress is told; an abort leaves nothing, is no error, and the next run starts where it ended.
fractions, errors = [], []
light_map.AddObserver("ErrorEvent", lambda *_: errors.append(1))
watch = light_map.AddObserver("ProgressEvent", lambda *_: fractions.append(light_map.GetProgress()))
light_map.Modified()
drawn = counts()
assert len(fractions) >= 3 and fractions == sorted(fractions)
light_map.RemoveObserver(watch)
watch = light_map.AddObserver("ProgressEvent", lambda *_: light_map.SetAbortExecute(1))
light_map.Modified()
light_map.Update()
assert light_map.GetOutput().GetNumberOfBlocks() == 0 and not errors and light_map.GetNumberOfDrawings() == drawn[3]
light_map.RemoveObserver(watch)
light_map.SetAbortExecute(0)
light_map.Modified()
assert counts() == drawn[:3] + (drawn[3] + 1,)

# The solution of the mesh in another order, and a mesh without an atlas, are told and leave nothing.
unordered = lambert.vtkHierarchicalRadiosity()
unordered.SetIterations(1)
unordered.SetFinalGather(False)
unordered.SetInputConnection(reader.GetOutputPort())
for atlas_port, solution_port in ((atlas.GetOutputPort(), unordered.GetOutputPort(0)),
                                  (clustering.GetOutputPort(0), solver.GetOutputPort(0))):
    wrong = lambert.vtkRadiosityLightMap()
    wrong.SetInputConnection(atlas_port)
    wrong.SetSolutionConnection(solution_port)
    told = []
    wrong.AddObserver("ErrorEvent", lambda *_: told.append(1))
    wrong.Update()
    assert told and wrong.GetOutput().GetNumberOfBlocks() == 0

# With the solution an atlas has both sides of a wall between two rooms, and is packed anew only where other sides are lit.
reader.SetFileName(os.path.join(os.environ["LAMBERT_DATA_DIR"], "TwoRooms", "TwoRooms.obj"))
atlas.SetSolutionConnection(solver.GetOutputPort(0))
light_map.Update()
cells = atlas.GetOutput().GetCellData()
sides, faces = (vtk_to_numpy(cells.GetArray(name)) for name in ("Side", "InputFaceId"))
both = np.flatnonzero(np.bincount(faces) == 2)
assert len(both) > 100 and (np.bincount(faces, sides == 1)[both] == 1).all()
cut = atlas.GetNumberOfSegmentations()
solver.SetIterations(4)
light_map.Update()
assert atlas.GetNumberOfSegmentations() == cut
uv = vtk_to_numpy(atlas.GetOutput().GetPointData().GetArray("LightMapTCoords"))
corners = vtk_to_numpy(atlas.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
column, row = (uv[corners].mean(axis=1) * 256).astype(int).T
light, on_sheet = page()[row, column].mean(axis=1), np.isin(faces, both)
dim, bright = sorted(light[on_sheet & (sides == side)].mean() for side in (0, 1))
assert 0 < dim < 0.5 * bright, (dim, bright)

# Texels follow the illumination where that is asked for; the charts are the same.
assert atlas.GetTexelDensity() == atlas.UNIFORM
atlas.SetTexelDensity(atlas.ILLUMINATION)
light_map.Update()
assert atlas.GetNumberOfSegmentations() == cut
assert not np.array_equal(uv, vtk_to_numpy(atlas.GetOutput().GetPointData().GetArray("LightMapTCoords")))

# Sides, faces and surfaces that cannot be are told in a sentence.


def changed(data, name, value):
    """A copy with another first entry of an array, or without it."""
    copy = vtkPolyData()
    copy.DeepCopy(data)
    if value is None:
        copy.GetCellData().RemoveArray(name)
    else:
        copy.GetCellData().GetArray(name).SetComponent(0, 0, value)
    return copy


laid, solved = atlas.GetOutput(), solver.GetOutput(0)
for mesh, solution, says in ((changed(laid, "Side", 2), solved, "The array Side has the entry 2"),
                             (changed(laid, "InputFaceId", -1), solved, "face -1"),
                             (changed(laid, "InputFaceId", 1e9), solved, "face 1000000000"),
                             (changed(laid, "SurfaceId", None), solved, "surfaces"),
                             (changed(laid, "SurfaceId", -1), solved, "surface below 0"),
                             (laid, changed(solved, "Side", 255), "The array Side has the entry 255")):
    wrong = lambert.vtkRadiosityLightMap()
    wrong.SetInputData(0, mesh)
    wrong.SetInputData(1, solution)
    told = []

    @calldata_type(VTK_STRING)
    def tell(_caller, _event, text):
        told.append(text)

    wrong.AddObserver("ErrorEvent", tell)
    wrong.Update()
    assert told and says in told[0] and wrong.GetOutput().GetNumberOfBlocks() == 0, (says, told)

# The solution of another order is refused each time, not drawn over charts that were kept.
told = []
atlas.AddObserver("ErrorEvent", lambda *_: told.append(1))
atlas.SetSolutionConnection(unordered.GetOutputPort(0))
atlas.SetTexelDensity(atlas.UNIFORM)
for _ in range(2):
    told.clear()
    atlas.Modified()
    atlas.Update()
    assert told and atlas.GetOutput().GetNumberOfCells() == 0
print("radiosity light map: passed")
