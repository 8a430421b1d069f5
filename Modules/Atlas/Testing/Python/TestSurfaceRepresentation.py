"""The filter from Python: surfaces at their points and in a light map, by triangles and by material, and what either costs."""
import os

import lambert
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

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
chosen = lambert.vtkSurfaceRepresentation()
chosen.SetInputConnection(clustering.GetOutputPort(0))
chosen.SetClusterConnection(clustering.GetOutputPort(1))
chosen.SetSolutionConnection(solver.GetOutputPort(0))
assert chosen.GetIntroducedTriangles() == 0 and chosen.GetPageSize() == 1024 and chosen.GetPadding() == 2
assert chosen.GetRepresentation("White") == chosen.AUTOMATIC
assert not chosen.GetSplitSurfaces()
chosen.SetPageSize(128)


def costs():
    chosen.Update()
    table = chosen.GetOutputDataObject(2)
    return {table.GetColumnName(i): vtk_to_numpy(table.GetColumn(i)).copy() for i in range(table.GetNumberOfColumns())}


# No triangle more than the input: every surface that refinement went below is in the map.
table = costs()
surfaces = vtk_to_numpy(clustering.GetOutput(0).GetCellData().GetArray("SurfaceId"))
assert len(table["LightMapped"]) == surfaces.max() + 1
assert np.array_equal(table["InputTriangles"], np.bincount(surfaces))
refined_further = table["RefinedTriangles"] > table["InputTriangles"]
assert refined_further.any() and np.array_equal(table["LightMapped"] == 1, refined_further)
# What either costs: texels whichever is chosen, the error of the map where there is one.
texels = chosen.GetOutputDataObject(0).GetFieldData().GetArray("Atlas.TexelSize").GetValue(0) ** -2
assert table["Texels"].dtype.kind == "i" and np.allclose(table["Texels"], table["Area"] * texels, atol=1, rtol=0.01)
assert ((table["MapError"] >= 0) == refined_further).all() and 0 < table["MapError"].max() < 0.05
mesh, pages = chosen.GetOutput(0), chosen.GetOutputDataObject(1)
uv = vtk_to_numpy(mesh.GetPointData().GetArray("LightMapTCoords"))
light = vtk_to_numpy(mesh.GetPointData().GetArray("Irradiance"))
assert pages.GetNumberOfBlocks() == 1 and pages.GetBlock(0).GetDimensions() == (128, 128, 1)
assert mesh.GetNumberOfCells() <= surfaces.size and (uv >= 0).any() and np.isfinite(light).all()

# The way back: every face lies in the input's, on its surface; charts are of what the map takes.
def corners_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)].astype(float)


def way_back():
    """Whether faces are in the light map, and their input faces."""
    shown, cells = chosen.GetOutput(0), chosen.GetOutput(0).GetCellData()
    chart, face, surface = (vtk_to_numpy(cells.GetArray(name)) for name in ("ChartId", "InputFaceId", "SurfaceId"))
    a, b, c = corners_of(clustering.GetOutput(0))[face].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    middle, scale = corners_of(shown).mean(axis=1) - a, (normal ** 2).sum(axis=1)
    at_b = (np.cross(middle, c - a) * normal).sum(axis=1) / scale
    at_c = (np.cross(b - a, middle) * normal).sum(axis=1) / scale
    assert min(at_b.min(), at_c.min(), (1 - at_b - at_c).min()) > -1e-4
    assert np.abs((middle * normal).sum(axis=1) / scale ** 0.75).max() < 1e-4
    assert np.array_equal(surface, surfaces[face])
    at = vtk_to_numpy(shown.GetPointData().GetArray("LightMapTCoords"))[:, 0]
    assert np.array_equal(chart >= 0, at[vtk_to_numpy(shown.GetPolys().GetConnectivityArray()).reshape(-1, 3)].max(axis=1) >= 0)
    return chart >= 0, face


is_mapped, face = way_back()
assert np.array_equal(np.unique(surfaces[face[is_mapped]]), np.flatnonzero(refined_further))
assert len(np.unique(face[is_mapped])) == is_mapped.sum()

# Some triangles more: the surfaces with the fewest are lit by their points.
introduced = table["RefinedTriangles"] - table["InputTriangles"]
chosen.SetIntroducedTriangles(int(np.sort(introduced)[:3].sum()))
assert np.array_equal(costs()["LightMapped"] == 0, introduced <= np.sort(introduced)[2])

# Any number of triangles: all are lit by their points; the user has the last word.
chosen.SetIntroducedTriangles(1 << 40)
assert not costs()["LightMapped"].any()
assert (vtk_to_numpy(chosen.GetOutput(0).GetPointData().GetArray("LightMapTCoords")) == -1).all()
chosen.SetRepresentation("White", chosen.LIGHT_MAP)
assert chosen.GetRepresentation("White") == chosen.LIGHT_MAP
names = clustering.GetOutput(0).GetFieldData().GetAbstractArray("Material.Name")
materials = vtk_to_numpy(clustering.GetOutput(0).GetCellData().GetArray("MaterialId"))
is_white = np.array([names.GetValue(materials[np.argmax(surfaces == s)]) == "White" for s in range(surfaces.max() + 1)])
assert is_white.any() and np.array_equal(costs()["LightMapped"] == 1, is_white)

# Any surface, by its number or its part: the narrowest counts.
odd = int(np.flatnonzero(is_white)[0])
chosen.SetSurfaceRepresentation(odd, chosen.POINTS)
assert chosen.GetSurfaceRepresentation(odd) == chosen.POINTS and chosen.GetSurfaceRepresentation(odd + 1) == chosen.AUTOMATIC
assert np.array_equal(costs()["LightMapped"] == 1, is_white & (np.arange(is_white.size) != odd))
chosen.SetSurfaceRepresentation(odd, chosen.AUTOMATIC)
part = clustering.GetOutput(0).GetFieldData().GetAbstractArray("Part.Name").GetValue(0)
chosen.SetPartRepresentation(part, chosen.POINTS)
assert chosen.GetPartRepresentation(part) == chosen.POINTS
parts = vtk_to_numpy(clustering.GetOutput(0).GetCellData().GetArray("PartId"))
of_part = np.array([parts[np.argmax(surfaces == s)] == 0 for s in range(surfaces.max() + 1)])
assert np.array_equal(costs()["LightMapped"] == 1, is_white & ~of_part)
chosen.SetPartRepresentation(part, chosen.AUTOMATIC)

# Of the steps only what changed is done again.


def counts():
    """Of a run: how often inputs were taken in, charts cut, packed and drawn."""
    chosen.Update()
    return chosen.GetNumberOfReadings(), chosen.GetNumberOfSegmentations(), chosen.GetNumberOfPackings()


def arrays():
    """What comes out: points, their light and places, the page, the costs."""
    chosen.Update()
    mesh, image = chosen.GetOutput(0), chosen.GetOutputDataObject(1).GetBlock(0)
    found = [vtk_to_numpy(mesh.GetPointData().GetArray(name)).copy() for name in ("Irradiance", "LightMapTCoords", "SharedPointId")]
    return found + [vtk_to_numpy(image.GetPointData().GetScalars()).copy(), *costs().values()]


readings, segmentations, packings = counts()
assert readings == 1
first = arrays()
chosen.Modified()
assert counts() == (1, segmentations, packings)
chosen.SetIntroducedTriangles((1 << 40) + 1)  # Every surface stays as it is shown.
assert counts() == (1, segmentations, packings)
chosen.SetPadding(3)
assert counts() == (1, segmentations, packings + 1)
chosen.SetStretch(1.5)
assert counts() == (1, segmentations + 1, packings + 2)
chosen.SetRepresentation("White", chosen.AUTOMATIC)
chosen.SetIntroducedTriangles(0)
assert counts() == (1, segmentations + 2, packings + 3)
chosen.SplitSurfacesOn()
assert counts() == (1, segmentations + 3, packings + 4)
solver.SetIterations(3)
assert counts() == (2, segmentations + 4, packings + 5)
solver.SetIterations(2)
chosen.SplitSurfacesOff()
chosen.SetRepresentation("White", chosen.LIGHT_MAP)
chosen.SetIntroducedTriangles(1 << 40)
chosen.SetStretch(2)
chosen.SetPadding(2)
assert all(np.array_equal(a, b) for a, b in zip(first, arrays(), strict=True))

# Progress; an abort leaves nothing and is no error; wrong options are told.
errors, fractions = [], []
chosen.AddObserver("ErrorEvent", lambda *_: errors.append(1))
watch = chosen.AddObserver("ProgressEvent", lambda *_: (fractions.append(chosen.GetProgress()), chosen.SetAbortExecute(1)))
chosen.Modified()
chosen.Update()
assert fractions and not errors and chosen.GetOutput(0).GetNumberOfCells() == 0
chosen.RemoveObserver(watch)
chosen.SetAbortExecute(0)
chosen.SetRepresentation("White", 7)
assert len(errors) == 1 and chosen.GetRepresentation("White") == chosen.LIGHT_MAP
chosen.SetIntroducedTriangles(-1)
chosen.Update()
assert len(errors) >= 2 and chosen.GetOutput(0).GetNumberOfCells() == 0
chosen.SetIntroducedTriangles(0)
chosen.SetSurfaceRepresentation(int(surfaces.max()) + 1, chosen.POINTS)
told = len(errors)
chosen.Update()
assert len(errors) > told
chosen.SetSurfaceRepresentation(int(surfaces.max()) + 1, chosen.AUTOMATIC)
# Cut into parts: a row each, none of a surface whose kind is decided, and no face is lost.
chosen.SetIntroducedTriangles(0)
chosen.SplitSurfacesOn()
table = costs()
assert np.array_equal(np.unique(table["Surface"]), np.arange(surfaces.max() + 1))
assert np.array_equal(np.bincount(table["Surface"], table["InputTriangles"]), np.bincount(surfaces))
assert (np.bincount(table["Surface"])[is_white] == 1).all() and (table["LightMapped"] == 1).any()
way_back()

# What was kept is what a filter makes that has nothing to keep: parts of surfaces, both sides of a sheet.
reader.SetFileName(os.path.join(os.environ["LAMBERT_DATA_DIR"], "TwoRooms", "TwoRooms.obj"))
solver.SetIterations(5)
solver.SetError(0.1)
chosen.SetIntroducedTriangles(20)
chosen.SetPageSize(256)
chosen.Update()
chosen.SetPadding(4)
kept, (_, _, packings) = arrays(), counts()
assert chosen.GetOutput(0).GetCellData().HasArray("Side") and {0, 1} == set(costs()["LightMapped"])
assert len(costs()["Surface"]) > len(set(zip(costs()["Surface"], costs()["Side"])))  # Some are cut.
chosen.SetStretch(1.5)
chosen.Update()
chosen.SetStretch(2)
again = arrays()
assert counts()[2] == packings + 2
options = {name: getattr(chosen, "Get" + name)() for name in ("IntroducedTriangles", "SplitSurfaces", "PageSize", "Padding", "Stretch")}
fresh = lambert.vtkSurfaceRepresentation()
fresh.SetInputConnection(clustering.GetOutputPort(0))
fresh.SetClusterConnection(clustering.GetOutputPort(1))
fresh.SetSolutionConnection(solver.GetOutputPort(0))
fresh.SetRepresentation("White", fresh.LIGHT_MAP)
for name, value in options.items():
    getattr(fresh, "Set" + name)(value)
way = [vtk_to_numpy(chosen.GetOutput(0).GetCellData().GetArray(name)).copy() for name in ("InputFaceId", "ChartId", "Side", "SurfaceId")]
chosen = fresh
assert all(np.array_equal(a, b) and np.array_equal(a, c) for a, b, c in zip(arrays(), kept, again, strict=True))
for name, values in zip(("InputFaceId", "ChartId", "Side", "SurfaceId"), way):
    assert np.array_equal(values, vtk_to_numpy(fresh.GetOutput(0).GetCellData().GetArray(name))), name
print("surface representation: passed")
