"""What the tests of the command line share: running it, and reading what it wrote."""
import json
import os
import shutil
import subprocess
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

LAMBERT = os.path.join(os.environ["LAMBERT_BIN_DIR"], "lambert")
DATA = os.environ["LAMBERT_DATA_DIR"]
CORNELL_BOX = os.path.join(DATA, "CornellBox", "CornellBox.obj")


def temporary(name):
    """A path for a file of this test that does not exist yet."""
    script = os.path.splitext(os.path.basename(sys.argv[0]))[0]  # Tests may run side by side.
    folder = os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], script)
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, name)
    if os.path.exists(path):
        shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)
    return path


def run(*arguments, environment=None):
    return subprocess.run([LAMBERT, *map(str, arguments)], capture_output=True, text=True, env=environment)


def solve(*arguments):
    """Runs `lambert solve` with a report, insists on success, and returns the report."""
    report = temporary("report.json")
    done = run("solve", *arguments, "--report", report, "--progress", "none")
    assert done.returncode == 0, done.stderr
    assert done.stderr == "", done.stderr
    with open(report) as file:
        return json.load(file)


def fails(exit_code, *arguments, says=(), environment=None):
    """Insists on an exit code and on one sentence on stderr that holds every word of `says`."""
    done = run(*arguments, environment=environment)
    assert done.returncode == exit_code, (arguments, done.returncode, done.stderr)
    lines = done.stderr.strip().splitlines()
    assert lines, arguments
    if exit_code == 1:
        assert len(lines) == 1 and lines[0].startswith("lambert: ") and lines[0].endswith("."), lines
    for word in says:
        assert word in done.stderr, (word, done.stderr)


def write_png(name, codes):
    """A PNG file of rows x columns x 3 codes, the lowest row first."""
    codes = np.asarray(codes, np.uint8)
    image = vtkImageData()
    image.SetDimensions(codes.shape[1], codes.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(codes.reshape(-1, 3)))
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFileName(name)
    writer.Write()
    return name


def write_hdr(name, texels):
    """A Radiance HDR file of rows x columns x 3 radiances, the uppermost row first."""
    texels = np.asarray(texels, float)
    largest = texels.max(axis=2)
    exponent = np.where(largest > 1e-30, np.floor(np.log2(np.maximum(largest, 1e-30))) + 1, -128)
    mantissa = np.floor(texels * 2.0 ** (8 - exponent)[..., None])
    with open(name, "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % largest.shape)
        file.write(np.dstack([mantissa, exponent + 128]).astype(np.uint8).tobytes())
    return name
