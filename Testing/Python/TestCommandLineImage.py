"""`lambert solve --image`: a picture of the asked-for size, exposed, neither black nor blown."""
import os
import shutil

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

import lambert
from CommandLine import CORNELL_BOX, fails, solve, temporary

if not lambert.vtkRadiosityImageWriter.IsDisplayAvailable():
    raise SystemExit(0)  # What happens then is asserted in TestCommandLineErrors.py.


def picture(*arguments, scene=CORNELL_BOX):
    path = temporary("box.png")
    solve(scene, "-o", temporary("box-image.vtp"), "--error", "0.3", "--iterations", "2", "--image", path, "--size",
          "120x90", *arguments)
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    assert reader.GetOutput().GetDimensions() == (120, 90, 1)
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(float)


plain, brighter = picture(), picture("--exposure", "1")
assert 30 < plain.mean() < 200, plain.mean()
assert np.percentile(plain, 98) > 100  # Something is lit
assert np.mean(plain.min(axis=1) > 250) < 0.2  # and most is not blown.
assert brighter.mean() > plain.mean() + 5

# The curves differ; a camera of a fixed exposure value shows a stop less where the value is one more.
assert np.abs(picture("--tone", "filmic") - plain).mean() > 2
local = np.abs(picture("--tone", "local") - plain)
assert local.max() > 10 and local.mean() < 5, (local.max(), local.mean())  # Beside edges alone.
linear = [picture("--tone", "linear", "--ev", str(ev)) for ev in (3, 4)]
middle = (linear[0] > 60) & (linear[0] < 200)
decoded = [np.where(codes > 10.31, ((codes / 255 + 0.055) / 1.055) ** 2.4, codes / 255 / 12.92) for codes in linear]
assert middle.any() and abs(np.median(decoded[0][middle] / decoded[1][middle]) - 2) < 0.1  # 8 bits at 60 codes: 4 %

# The same room standing on z gives the same picture: its file does not say what is up, its floor does.
standing = temporary("standing.obj")
with open(CORNELL_BOX, encoding="ascii") as source, open(standing, "w", encoding="ascii") as turned:
    for line in source:
        words = line.split()
        if words and words[0] in ("v", "vn"):
            x, y, z = (float(word) for word in words[1:4])
            line = f"{words[0]} {x} {-z} {y}\n"
        turned.write("" if line.startswith("# camera") else line)
shutil.copy(os.path.splitext(CORNELL_BOX)[0] + ".mtl", temporary("CornellBox.mtl"))
upright = picture("--camera", "0.278,0.273,-0.8,0.278,0.273,0,39.3")
assert np.abs(picture("--camera", "0.278,0.8,0.273,0.278,0,0.273,39.3", "--up", "z", scene=standing) - upright).mean() < 2
assert np.abs(picture("--camera", "0.278,0.8,0.273,0.278,0,0.273,39.3", scene=standing) - upright).mean() < 2

# A device that takes no byte stands for a full disk: one sentence, and no word of the PNG library.
full = temporary("full.png")
if os.path.lexists(full):
    os.remove(full)
os.symlink("/dev/full", full)
fails(1, "solve", CORNELL_BOX, "-o", temporary("box-image.vtp"), "--iterations", "1", "--progress", "none", "--image",
      full, says=["could not be written"])
os.remove(full)
