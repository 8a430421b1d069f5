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
assert ((table["Texels"] > 0) == refined_further).all() and 0 < table["MapError"].max() < 0.05
mesh, pages = chosen.GetOutput(0), chosen.GetOutputDataObject(1)
uv = vtk_to_numpy(mesh.GetPointData().GetArray("LightMapTCoords"))
light = vtk_to_numpy(mesh.GetPointData().GetArray("Irradiance"))
assert pages.GetNumberOfBlocks() == 1 and pages.GetBlock(0).GetDimensions() == (128, 128, 1)
assert mesh.GetNumberOfCells() <= surfaces.size and (uv >= 0).any() and np.isfinite(light).all()

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
print("surface representation: passed")

# Cut into parts: a row each, none of a surface whose kind is decided, and no face is lost.
chosen.SetIntroducedTriangles(0)
chosen.SplitSurfacesOn()
table = costs()
assert np.array_equal(np.unique(table["Surface"]), np.arange(surfaces.max() + 1))
assert np.array_equal(np.bincount(table["Surface"], table["InputTriangles"]), np.bincount(surfaces))
assert (np.bincount(table["Surface"])[is_white] == 1).all() and (table["LightMapped"] == 1).any()
