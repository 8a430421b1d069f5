#!/usr/bin/python3
"""Draws where the error of a solution sits: blue where it is too dark, red where it is too bright, beside a scale.

    ErrorMaps.py SCENE OUT.png [--error E] [--sky R G B] [--samples N] [--camera px,py,pz,fx,fy,fz,fov] [--scale PERCENT]

The camera is that of the comment in the scene's OBJ file where none is given. The share of the squared error that the worst
tenth and hundredth of the area hold is printed, and how noisy the path trace is. Needs an X display.
"""
import argparse
import os
import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow)

import lambert

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Testing/Images"))
from Pictures import named_camera, write_picture  # noqa: E402

SIZE = 720, 512  # Pixels
STRIP = 0.14  # of the width, for the scale
COLORS = ((-1, 0.02, 0.19, 0.45), (-0.5, 0.26, 0.58, 0.76), (0, 0.96, 0.96, 0.94), (0.5, 0.87, 0.42, 0.32),
          (1, 0.45, 0.02, 0.13))


def solved(arguments):
    """The error map of the scene, at its triangles."""
    reader = lambert.vtkRadiositySceneReader()
    reader.SetFileName(arguments.scene)
    solver = lambert.vtkHierarchicalRadiosity()
    solver.SetInputConnection(reader.GetOutputPort())
    solver.SetError(arguments.error)
    error_map = lambert.vtkErrorMap()
    error_map.SetInputConnection(solver.GetOutputPort())
    error_map.SetSceneConnection(reader.GetOutputPort())
    error_map.SetSamples(arguments.samples)
    for stage in (solver, error_map):
        stage.SetSky(*arguments.sky)
    error_map.Update()
    return error_map.GetOutput()


def tell(scene, mesh):
    """Prints how unevenly the squared error lies."""
    corners = vtk_to_numpy(mesh.GetPoints().GetData())[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray())]
    a, b, c = corners.reshape(-1, 3, 3).astype(float).transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    cells = mesh.GetCellData()
    error = vtk_to_numpy(cells.GetArray("RelativeError")).astype(float)
    light = vtk_to_numpy(cells.GetArray("ReferenceIrradiance")).mean(axis=1)
    noise = vtk_to_numpy(cells.GetArray("StandardError")).mean(axis=1) / np.maximum(light, np.average(light, weights=area))
    order = np.argsort(-abs(error))
    upto = np.cumsum(area[order]) / area.sum()
    share = np.cumsum((area * error ** 2)[order]) / (area * error ** 2).sum()
    print(f"{scene}: {len(area)} triangles, root mean square {100 * np.sqrt(np.average(error ** 2, weights=area)):.1f} %, "
          f"of which noise {100 * np.sqrt(np.average(noise ** 2, weights=area)):.1f} %, "
          f"mean {100 * np.average(error, weights=area):+.2f} %, "
          f"{100 * np.interp(0.01, upto, share):.0f} % of the square on 1 % of the area, "
          f"{100 * np.interp(0.1, upto, share):.0f} % on 10 %")


def camera_of(arguments):
    if arguments.camera:
        return [float(x) for x in arguments.camera.split(",")]
    try:
        return named_camera(arguments.scene)
    except StopIteration:
        raise SystemExit(f"{arguments.scene} names no camera: give one by --camera px,py,pz,fx,fy,fz,fov.") from None


def draw(mesh, camera, scale):
    """The mesh in the colours of its error, and the scale in a strip at the right."""
    colors = vtkColorTransferFunction()
    for at, *color in COLORS:
        colors.AddRGBPoint(scale * at, *color)
    percent = vtk_to_numpy(mesh.GetCellData().GetArray("RelativeError"))  # The mesh's own, about to be drawn.
    percent[:] = np.clip(100 * percent, -scale, scale)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.SetScalarModeToUseCellData()
    mapper.SetLookupTable(colors)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    actor.GetProperty().BackfaceCullingOn()
    picture = vtkRenderer()
    picture.SetViewport(0, 0, 1 - STRIP, 1)
    picture.AddActor(actor)
    eye = picture.GetActiveCamera()
    eye.SetPosition(camera[:3])
    eye.SetFocalPoint(camera[3:6])
    eye.SetViewAngle(camera[6])
    picture.ResetCameraClippingRange()

    bar = vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetTitle("error, %")
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%g")
    bar.SetMaximumNumberOfColors(256)
    bar.UnconstrainedFontSizeOn()
    for letters in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        letters.SetFontSize(14)
        letters.ItalicOff()
        letters.BoldOff()
        letters.ShadowOff()
    bar.SetPosition(0.05, 0.1)
    bar.SetWidth(0.9)
    bar.SetHeight(0.8)
    bar.SetBarRatio(0.3)
    strip = vtkRenderer()
    strip.SetViewport(1 - STRIP, 0, 1, 1)
    strip.AddActor2D(bar)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    window.AddRenderer(picture)
    window.AddRenderer(strip)
    return window


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("out")
    parser.add_argument("--error", type=float, default=0.05)
    parser.add_argument("--sky", type=float, nargs=3, default=(0, 0, 0))
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--camera")
    parser.add_argument("--scale", type=float, default=20, help="percent at the ends of the scale")
    arguments = parser.parse_args()

    camera = camera_of(arguments)
    mesh = solved(arguments)
    tell(os.path.basename(arguments.scene), mesh)
    window = draw(mesh, camera, arguments.scale)
    write_picture(window, arguments.out)


if __name__ == "__main__":
    main()
