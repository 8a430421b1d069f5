#!/usr/bin/python3
"""Draws the face clusters of a rounded ring, a colour a cluster, in a table of views.

    ClusterColors.py OUT.png --clusters N... [--balance K...] [--columns C] [--size PIXELS]

There is a view for every number of clusters and each balance (k of the cost; the filter's default where none is given),
from left to right, then down. Needs an X display.
"""
import argparse
import colorsys
import os
import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkSuperquadricSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

import lambert

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Testing/Images"))
from Pictures import write_picture  # noqa: E402


def ring():
    """A ring with flat sides and rounded edges, as a turned part has them; one closed surface."""
    source = vtkSuperquadricSource()
    source.SetToroidal(True)
    source.SetThickness(0.45)
    source.SetPhiRoundness(0.35)
    source.SetThetaResolution(160)
    source.SetPhiResolution(96)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(source.GetOutputPort())
    whole = vtkCleanPolyData()  # the source leaves seams
    whole.SetInputConnection(triangles.GetOutputPort())
    whole.SetTolerance(1e-5)
    return whole


def color(rank):
    """Hues a golden section apart, in three lightnesses."""
    red, green, blue = colorsys.hls_to_rgb(rank * 0.618034 % 1, (0.42, 0.58, 0.72)[rank % 3], 0.62)
    return [round(255 * band) for band in (red, green, blue)]


def clustered(shape, count, balance):
    """The mesh with a colour at every cell, that of its cluster."""
    clusters = lambert.vtkFaceClustering()
    clusters.SetInputConnection(shape.GetOutputPort())
    clusters.SetClusterCount(count)
    if balance is not None:
        clusters.SetBalance(balance)
    clusters.Update()
    mesh = clusters.GetOutput()
    ranks = np.unique(vtk_to_numpy(mesh.GetCellData().GetArray("ClusterId")), return_inverse=True)[1]
    palette = np.array([color(rank) for rank in range(ranks.max() + 1)], np.uint8)
    colors = numpy_to_vtk(palette[ranks], deep=True)
    mesh.GetCellData().SetScalars(colors)
    return mesh


def view(mesh, viewport):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetAmbient(0.25)
    actor.GetProperty().SetDiffuse(0.75)
    renderer = vtkRenderer()
    renderer.SetViewport(viewport)
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(1.1, 1.5, 1.4)
    camera.SetViewAngle(24)
    renderer.ResetCamera()
    camera.Zoom(1.35)
    return renderer


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("out")
    arguments.add_argument("--clusters", type=int, nargs="+", required=True)
    arguments.add_argument("--balance", type=float, nargs="+", default=[None])
    arguments.add_argument("--columns", type=int, default=4)
    arguments.add_argument("--size", type=int, default=256, help="pixels, a side of one view")
    options = arguments.parse_args()

    shape = ring()
    views = [(count, balance) for count in options.clusters for balance in options.balance]
    columns = min(options.columns, len(views))
    rows = -(-len(views) // columns)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(4)
    window.SetSize(options.size * columns, options.size * rows)
    for place, (count, balance) in enumerate(views):
        column, row = place % columns, rows - 1 - place // columns
        viewport = (column / columns, row / rows, (column + 1) / columns, (row + 1) / rows)
        window.AddRenderer(view(clustered(shape, count, balance), viewport))
    write_picture(window, options.out)


if __name__ == "__main__":
    main()
