"""The Python surface of the picture writer, and what it refuses."""
import os

import lambert

writer = lambert.vtkRadiosityImageWriter()
for name, default, other in (("FileName", None, "picture.png"), ("Size", (960, 720), (64, 48)), ("ViewAngle", 40.0, 60.0),
                             ("AutomaticCamera", True, False),
                             ("Exposure", 0.0, -1.5), ("DodgingAndBurning", False, True), ("UpAxis", -1, 2), ("FalseColors", 0, 1),
                             ("FalseColorRange", (0, 0), (0, 500)), ("FalseColorSteps", 0, 4), ("Isolines", False, True)):
    assert getattr(writer, "Get" + name)() == default, name
    getattr(writer, "Set" + name)(other)
    assert getattr(writer, "Get" + name)() == other, name

writer.SetUpAxis(7)
assert writer.GetUpAxis() == writer.UP_Z

# A camera of one's own ends the automatic one.
writer.AutomaticCameraOn()
writer.SetCamera(1, 2, 3, 4, 5, 6)
assert not writer.GetAutomaticCamera() and writer.GetPosition() == (1, 2, 3) and writer.GetFocalPoint() == (4, 5, 6)
writer.AutomaticCameraOn()
writer.SetViewUp(0, 0, 1)
assert not writer.GetAutomaticCamera() and writer.GetViewUp() == (0, 0, 1)
writer.SetViewAngle(500)
assert 0 < writer.GetViewAngle() < 180
assert lambert.vtkRadiosityImageWriter.IsDisplayAvailable() in (True, False)

# A scene without light values, and a size of nothing, are errors that write nothing.
path = os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], "never.png")
reader = lambert.vtkRadiositySceneReader()
reader.SetFileName(os.path.join(os.environ["LAMBERT_DATA_DIR"], "CornellBox", "CornellBox.obj"))
for size in ((64, 48), (0, 48)):
    writer, errors = lambert.vtkRadiosityImageWriter(), []
    writer.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    writer.SetInputConnection(reader.GetOutputPort())
    writer.SetFileName(path)
    writer.SetSize(*size)
    writer.Write()
    assert errors and writer.GetErrorCode() != 0 and not os.path.exists(path)

# False colours ask for irradiance, and for a scale that has a length.
if lambert.vtkRadiosityImageWriter.IsDisplayAvailable():
    solved = lambert.vtkPathTracedIrradiance()
    solved.SetInputConnection(reader.GetOutputPort())
    solved.SetSamples(1)
    for source, ends, fails in ((reader, (0, 0), True), (solved, (2, 1), True), (solved, (0, 0), False)):
        writer, errors = lambert.vtkRadiosityImageWriter(), []
        writer.AddObserver("ErrorEvent", lambda *_: errors.append(1))
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetFileName(path if fails else path.replace("never", "lux"))
        writer.SetSize(64, 48)
        writer.SetCamera(0.278, 0.273, -0.8, 0.278, 0.273, 0)
        writer.SetFalseColors(writer.LUX)
        writer.SetFalseColorRange(*ends)
        writer.Write()
        assert bool(errors) == fails and os.path.exists(writer.GetFileName()) != fails, (ends, fails)
