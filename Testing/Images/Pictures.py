"""What the pictures of the image tests share: the camera that a scene names, and the file that a window becomes."""
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter


def named_camera(scene):
    """Eye, point looked at and field of view of the line `# camera` of an OBJ file: seven numbers."""
    with open(scene, encoding="ascii") as text:
        return next([float(word) for word in line.split()[2:]] for line in text if line.startswith("# camera"))


def look_as_named(renderer, scene):
    """Takes the camera that an OBJ file names."""
    numbers = named_camera(scene)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(numbers[0:3])
    camera.SetFocalPoint(numbers[3:6])
    camera.SetViewAngle(numbers[6])
    renderer.ResetCameraClippingRange()


def write_picture(window, name):
    """Draws a window into a PNG file; returns the picture as vtkImageData."""
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(name)
    writer.Write()
    return image.GetOutput()
