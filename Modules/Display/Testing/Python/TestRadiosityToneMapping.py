"""The Python surface of the display stage, and a picture that shows what it should."""
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkIOImage import vtkPNGReader

import lambert


def lit_plane():
    """A square in the xy plane that faces +z, lit twice as bright at its right edge."""
    plane = vtkPlaneSource()
    plane.SetResolution(4, 4)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(plane.GetOutputPort())
    triangles.Update()
    data = vtkPolyData()
    data.ShallowCopy(triangles.GetOutput())
    x = vtk_to_numpy(data.GetPoints().GetData())[:, 0]
    radiosity = numpy_to_vtk(np.repeat((1.5 + x)[:, None], 3, axis=1).astype(np.float32), deep=1)
    radiosity.SetName("Radiosity")
    data.GetPointData().AddArray(radiosity)
    return data


# Every option, its default, and a value that comes back.
tone = lambert.vtkRadiosityToneMapping()
for name, default, other in (("Key", 0.18, 0.3), ("Exposure", 0.0, -1.5), ("White", 0.0, 3.0), ("Curve", 0, 2),
                             ("SteadyStops", 0.0, 0.5)):
    assert getattr(tone, "Get" + name)() == default, name
    getattr(tone, "Set" + name)(other)
    assert getattr(tone, "Get" + name)() == other, name
for curve in ("Photographic", "Linear", "Filmic"):
    getattr(tone, "SetCurveTo" + curve)()
    assert tone.GetCurve() == getattr(tone, curve.upper())
told = []
tone.AddObserver("ErrorEvent", lambda *_: told.append(1))
tone.SetCurve(99)
assert told and tone.GetCurve() == tone.FILMIC
assert np.isnan(tone.GetExposureValue())
tone.SetExposureValue(9)
assert tone.GetExposureValue() == 9
assert lambert.vtkRadiosityToneMapping.ColorsArrayName() == "Colors"

# A brighter point gets a brighter colour; the rest passes through.
tone = lambert.vtkRadiosityToneMapping()
tone.SetInputData(lit_plane())
tone.Update()
output = tone.GetOutput()
colors = vtk_to_numpy(output.GetPointData().GetArray("Colors"))
assert colors.dtype == np.uint8 and colors.shape == (output.GetNumberOfPoints(), 3)
assert output.GetPointData().GetScalars().GetName() == "Colors"
assert output.GetPointData().HasArray("Radiosity")
x = vtk_to_numpy(output.GetPoints().GetData())[:, 0]
assert colors[x.argmax(), 1] > colors[x.argmin(), 1]

# An adaptation that is measured anew shows twice the light as before; a steady one as brighter, and comes there in time.
def shown(mapping, light):
    data = lit_plane()
    vtk_to_numpy(data.GetPointData().GetArray("Radiosity"))[:] *= light
    mapping.SetInputData(data)
    mapping.Update()
    return vtk_to_numpy(mapping.GetOutput().GetPointData().GetArray("Colors")).astype(int)


free, steady = lambert.vtkRadiosityToneMapping(), lambert.vtkRadiosityToneMapping()
steady.SetSteadyStops(0.25)
before = shown(free, 1)
assert np.abs(shown(free, 2) - before).max() <= 1 and np.array_equal(shown(steady, 1), before)
assert shown(steady, 2).mean() > before.mean() + 10
later = [shown(steady, 2) for _ in range(12)]
assert np.abs(later[-1] - before).max() <= 2

# Data that no method has lit is an error, not a grey picture.
errors = []
bare = lambert.vtkRadiosityToneMapping()
bare.AddObserver("ErrorEvent", lambda *_: errors.append(1))
plane = lit_plane()
plane.GetPointData().RemoveArray("Radiosity")
bare.SetInputData(plane)
bare.Update()
assert errors

# The picture: brighter to the right, background where the plane ends; from behind nothing is drawn.
writer = lambert.vtkRadiosityImageWriter()
assert tuple(writer.GetSize()) == (960, 720) and writer.GetAutomaticCamera() and writer.GetViewAngle() == 40
if not lambert.vtkRadiosityImageWriter.IsDisplayAvailable():
    errors.clear()
    writer.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    writer.SetInputData(output)
    writer.SetFileName("never-written.png")
    writer.Write()
    assert errors and not os.path.exists("never-written.png")
    raise SystemExit(0)


def picture(name, *camera):
    path = os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    image_writer = lambert.vtkRadiosityImageWriter()
    image_writer.SetInputData(output)
    image_writer.SetSize(80, 60)
    image_writer.SetCamera(*camera)
    image_writer.SetFileName(path)
    image_writer.Write()
    assert image_writer.GetErrorCode() == 0
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(60, 80, 3).astype(int)


front = picture("tone-front.png", 0, 0, 3, 0, 0, 0)
assert front[30, 50, 1] > front[30, 30, 1] > front[2, 2, 1] + 20
back = picture("tone-back.png", 0, 0, -3, 0, 0, 0)
assert np.ptp(back) <= 3  # The background's three bands alone.

# Light that is not coloured yet is developed by pixel; dodging and burning belongs to the photographic curve.
writer, errors = lambert.vtkRadiosityImageWriter(), []
writer.AddObserver("ErrorEvent", lambda *_: errors.append(1))
writer.SetInputData(lit_plane())
writer.SetFileName(os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], "tone-local.png"))
writer.SetSize(80, 60)
writer.DodgingAndBurningOn()
writer.Write()
assert not errors and os.path.exists(writer.GetFileName())
writer.GetToneMapping().SetCurveToFilmic()
writer.Write()
assert errors and writer.GetErrorCode() != 0
