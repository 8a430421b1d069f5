#!/usr/bin/python3
"""Draws a floor of slivers with the edge of a shadow across it, as different refinements leave it, in a table of views.

    PatchRefinement.py OUT.png --views VIEW... [--columns C] [--width PIXELS] [--part X0 X1]

A view is `mesh`, the floor as the file has it, or `REFINEMENT,SNAP,ERROR`: rectangle or quadtree, the snap tolerance and
the error that links alone are refined for. With `,lines` behind it the triangles are drawn too. Views go from left to
right, then down; the triangles of each are printed. `--part` shows the floor from X0 to X1, m. Needs an X display.
"""
import argparse
import os
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

import lambert

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Testing/Images"))
from Pictures import write_picture  # noqa: E402

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Data/ShadowedSlivers/ShadowedSlivers.obj")
GAP = 0.012  # around a view, a fraction of it


def solved(scene, refinement, snap, error):
    """The lit scene, refined as links alone ask for."""
    radiosity = lambert.vtkHierarchicalRadiosity()
    radiosity.SetInputConnection(scene.GetOutputPort())
    radiosity.SetRefinement({"rectangle": radiosity.RECTANGLE, "quadtree": radiosity.QUADTREE}[refinement])
    radiosity.SetSnapTolerance(float(snap))
    radiosity.SetError(float(error))
    radiosity.SetVerificationPoints(0)
    radiosity.FinalGatherOff()
    colors = lambert.vtkRadiosityToneMapping()
    colors.SetInputConnection(radiosity.GetOutputPort())
    return colors


def view(scene, words, viewport, part):
    source = scene if words[0] == "mesh" else solved(scene, *words[:3])
    source.Update()
    print(",".join(words), source.GetOutput().GetNumberOfCells(), "triangles")
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(source.GetOutput())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    if words[0] == "mesh" or words[-1] == "lines":
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(0.15, 0.3, 0.55)
    renderer = vtkRenderer()
    renderer.SetViewport(viewport)
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)

    # From above, beneath the screen that throws the shadow.
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    middle = (part[0] + part[1]) / 2
    camera.SetFocalPoint(middle, 0, 0.5)
    camera.SetPosition(middle, 0.2, 0.5)
    camera.SetViewUp(0, 0, -1)
    camera.SetParallelScale(0.5)
    camera.SetClippingRange(0.1, 0.3)
    return renderer


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("out")
    arguments.add_argument("--views", nargs="+", required=True)
    arguments.add_argument("--columns", type=int, default=2)
    arguments.add_argument("--width", type=int, default=480, help="pixels of one view")
    arguments.add_argument("--part", type=float, nargs=2, default=(0.25, 1.75))
    options = arguments.parse_args()

    scene = lambert.vtkRadiositySceneReader()
    scene.SetFileName(SCENE)
    rows = -(-len(options.views) // options.columns)
    height = options.width / (options.part[1] - options.part[0])
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(options.width * options.columns, round(height * rows))
    backdrop = vtkRenderer()
    backdrop.SetBackground(1, 1, 1)
    window.AddRenderer(backdrop)
    for place, words in enumerate(options.views):
        column, row = place % options.columns, rows - 1 - place // options.columns
        viewport = ((column + GAP) / options.columns, (row + GAP) / rows,
                    (column + 1 - GAP) / options.columns, (row + 1 - GAP) / rows)
        window.AddRenderer(view(scene, words.split(","), viewport, options.part))
    write_picture(window, options.out)


if __name__ == "__main__":
    main()
