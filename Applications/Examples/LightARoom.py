"""Lights a room: reader >> face clusters >> hierarchical radiosity >> tone mapping >> file and mapper.

    LightARoom.py SCENE OUT.vtp
"""
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

import lambert

scene, out = sys.argv[1:]

# The pipeline.
reader = lambert.vtkRadiositySceneReader()
reader.SetFileName(scene)
clusters = lambert.vtkFaceClustering()
clusters.SetInputConnection(reader.GetOutputPort())
radiosity = lambert.vtkHierarchicalRadiosity()
radiosity.SetInputConnection(0, clusters.GetOutputPort(0))
radiosity.SetInputConnection(1, clusters.GetOutputPort(1))
radiosity.SetError(0.2)
colors = lambert.vtkRadiosityToneMapping()
colors.SetInputConnection(radiosity.GetOutputPort())

# What a window would draw.
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(colors.GetOutputPort())

# What stays on disk.
writer = vtkXMLPolyDataWriter()
writer.SetInputConnection(colors.GetOutputPort())
writer.SetFileName(out)
if not writer.Write():
    sys.exit(f"{out} could not be written.")

# Arrays are numpy.
lit = radiosity.GetOutput()
irradiance = vtk_to_numpy(lit.GetPointData().GetArray("Irradiance"))
history = radiosity.GetOutputDataObject(1)
print(f"{lit.GetNumberOfCells()} triangles after {history.GetNumberOfRows()} iterations, "
      f"stopped by {radiosity.GetStoppedBy()}, brightest point {np.linalg.norm(irradiance, axis=1).max():.6g} W/m2")
if not irradiance.max() > 0:
    sys.exit("No light arrived anywhere.")
