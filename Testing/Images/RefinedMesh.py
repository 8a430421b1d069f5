#!/usr/bin/python3
"""Draws the lit mesh of a scene with the edges of its triangles, seen from the camera that the scene names.

    RefinedMesh.py SCENE.obj OUT.png ITERATIONS

Needs an X display.
"""
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

import lambert
from Pictures import look_as_named, write_picture

scene, out, iterations = sys.argv[1:]

reader = lambert.vtkRadiositySceneReader()
reader.SetFileName(scene)
radiosity = lambert.vtkHierarchicalRadiosity()
radiosity.SetInputConnection(reader.GetOutputPort())
radiosity.SetError(0.01)  # never met within the iterations: their number alone ends the run
radiosity.SetIterations(int(iterations))
colors = lambert.vtkRadiosityToneMapping()
colors.SetInputConnection(radiosity.GetOutputPort())
colors.Update()
if radiosity.GetStoppedBy() != "iterations":
    sys.exit(f"The run was stopped by {radiosity.GetStoppedBy()}.")

mapper = vtkPolyDataMapper()
mapper.SetInputConnection(colors.GetOutputPort())
mapper.SetScalarModeToUsePointFieldData()
mapper.SelectColorArray("Colors")
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().LightingOff()
actor.GetProperty().BackfaceCullingOn()
actor.GetProperty().EdgeVisibilityOn()
actor.GetProperty().SetEdgeColor(0.1, 0.2, 0.5)
renderer = vtkRenderer()
renderer.SetBackground(1, 1, 1)
renderer.AddActor(actor)

look_as_named(renderer, scene)

window = vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetMultiSamples(4)
window.SetSize(512, 384)
window.AddRenderer(renderer)
write_picture(window, out)
