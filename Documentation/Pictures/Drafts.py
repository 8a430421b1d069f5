#!/usr/bin/python3
"""Draws a scene solved at several requests of error, one picture beside the other, or below it.

    Drafts.py LAMBERT SCENE OUT.png --errors E... [--crop LEFT RIGHT BOTTOM TOP] [--below] [LAMBERT OPTION...]

LAMBERT is the program; options that are not known here go to `lambert solve`. Pixels count from below. Needs an X display.
"""
import argparse
import os
import subprocess
import tempfile

from vtkmodules.vtkFiltersCore import vtkImageAppend
from vtkmodules.vtkImagingCore import vtkExtractVOI
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

parser = argparse.ArgumentParser()
parser.add_argument("program")
parser.add_argument("scene")
parser.add_argument("picture")
parser.add_argument("--errors", type=float, nargs="+", required=True)
parser.add_argument("--crop", type=int, nargs=4)
parser.add_argument("--below", action="store_true")
arguments, options = parser.parse_known_args()

joined = vtkImageAppend()
joined.SetAppendAxis(1 if arguments.below else 0)
with tempfile.TemporaryDirectory() as folder:
    image = os.path.join(folder, "draft.png")
    # Rows are appended from below.
    for error in sorted(arguments.errors, reverse=not arguments.below):
        subprocess.run([arguments.program, "solve", arguments.scene, "-o", os.path.join(folder, "draft.vtp"),
                        "--error", str(error), "--image", image, *options], check=True)
        reader = vtkPNGReader()
        reader.SetFileName(image)
        reader.Update()
        part = vtkExtractVOI()
        part.SetInputData(reader.GetOutput())
        part.SetVOI(*(arguments.crop + [0, 0] if arguments.crop else reader.GetOutput().GetExtent()))
        part.Update()
        joined.AddInputData(part.GetOutput())
writer = vtkPNGWriter()
writer.SetInputConnection(joined.GetOutputPort())
writer.SetFileName(arguments.picture)
writer.Write()
