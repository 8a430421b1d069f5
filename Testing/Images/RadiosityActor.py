#!/usr/bin/python3
"""Draws one solution twice in a plain vtkRenderer, lit by its points and by its light map, with a gloss; both have to agree.

    RadiosityActor.py LAMBERT SCENE.obj OUT.png

Needs an X display.
"""
import os
import subprocess
import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkHDRReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

import lambert
from Pictures import look_as_named, write_picture

program, scene, out = sys.argv[1:]
lit, mapped = os.path.splitext(out)[0] + "-lit.vtp", os.path.splitext(out)[0] + "-map.vtp"
subprocess.run([program, "solve", scene, "-o", lit, "--lightmap", mapped, "--iterations", "3", "--error", "0.1", "--progress",
                "none"], check=True, stdout=subprocess.DEVNULL)


def read(reader, name):
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()


# Both kinds, each in its half of the window.
window = vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetMultiSamples(0)
window.SetSize(640, 320)
for half, name in enumerate((lit, mapped)):
    actor = lambert.vtkRadiosityActor()
    actor.SetInputData(read(vtkXMLPolyDataReader(), name))
    if name == mapped:
        actor.AddLightMapPage(read(vtkHDRReader(), mapped.replace(".vtp", "-0.hdr")))
    # One exposure for both: to the refined mesh belong the inner sides of the blocks, too.
    actor.GetToneMapping().SetExposureValue(8.3)
    actor.GetToneMapping().SetWhite(3)
    actor.GetProperty().SetInterpolationToPBR()
    actor.GetProperty().SetRoughness(0.3)
    renderer = vtkRenderer()
    renderer.SetViewport(half / 2, 0, half / 2 + 0.5, 1)
    renderer.AddActor(actor)
    window.AddRenderer(renderer)
    look_as_named(renderer, scene)

image = write_picture(window, out)

# A texel is 1.6 mm, half a pixel: what is left are contact shadows between texels, and the four bytes a texel of the file.
pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(320, 640, 3).astype(int)
difference = np.abs(pixels[:, :320] - pixels[:, 320:])
if difference.mean() > 0.5 or np.percentile(difference, 99) > 3:
    sys.exit(f"The light map differs from the points by {difference.mean()} codes in the mean.")
