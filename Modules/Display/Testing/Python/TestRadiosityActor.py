"""The actor in a plain renderer: its curves, both kinds of light, base textures, specular light."""
import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkRenderingCore import (vtkProperty, vtkRenderer, vtkRenderWindow, vtkShaderProperty, vtkTexture,
                                            vtkWindowToImageFilter)

import lambert

actor = lambert.vtkRadiosityActor()
assert actor.GetNumberOfLightMapPages() == 0 and not actor.GetLinearLight()
actor.LinearLightOn()
assert actor.GetLinearLight() and actor.GetToneMapping().GetKey() == 0.18

if not lambert.vtkRadiosityImageWriter.IsDisplayAvailable():
    raise SystemExit(0)
SIZE = 64


def floats(name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values, dtype=np.float32), deep=1)
    array.SetName(name)
    return array


def squares(left, right):
    """Two squares beside each other in the plane z = 0; each a dict of the arrays at its four points."""
    data, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    for offset in (-1, 0):
        first = points.GetNumberOfPoints()
        for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
            points.InsertNextPoint(x + offset, y - 0.5, 0)
        for corners in ((0, 1, 2), (0, 2, 3)):
            ids = vtkIdList()
            for corner in corners:
                ids.InsertNextId(first + corner)
            cells.InsertNextCell(ids)
    data.SetPoints(points)
    data.SetPolys(cells)
    for name in left:
        data.GetPointData().AddArray(floats(name, list(left[name]) + list(right[name])))
    # A ridge along the middle, so that it alone faces the eye.
    normals = [[np.sin(x), 0, np.cos(x)] for x in vtk_to_numpy(points.GetData())[:, 0]]
    data.GetPointData().SetNormals(floats("Normals", normals))
    data.GetCellData().AddArray(floats("Reflectance", [[0.5] * 3] * 4))
    return data


def page(light, size=4):
    image = vtkImageData()
    image.SetDimensions(size, size, 1)
    image.GetPointData().SetScalars(floats("Irradiance", [light] * (size * size)))
    return image


def draw(shown, environment=None):
    renderer = vtkRenderer()
    if environment:
        renderer.UseImageBasedLightingOn()
        renderer.SetEnvironmentTexture(environment)
    renderer.AddActor(shown)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0, 0, 3)
    camera.SetViewAngle(20)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(SIZE, SIZE)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(SIZE, SIZE, 3).astype(int)


def halves(picture):
    return picture[SIZE // 2, SIZE // 4], picture[SIZE // 2, 3 * SIZE // 4]


OUTSIDE, INSIDE = [[-1, -1]] * 4, [[0.25, 0.25], [0.75, 0.25], [0.75, 0.75], [0.25, 0.75]]
dim, bright = [[1, 0.5, 0.25]] * 4, [[8, 4, 2]] * 4

# The shader's curves are those of the filter, to a code of rounding.
both = squares({"Radiosity": dim}, {"Radiosity": bright})
for curve in ("Photographic", "Linear", "Filmic"):
    actor, mapping = lambert.vtkRadiosityActor(), lambert.vtkRadiosityToneMapping()
    actor.SetInputData(both)
    mapping.SetInputData(both)
    for settings in (mapping, actor.GetToneMapping()):
        getattr(settings, "SetCurveTo" + curve)()
        settings.SetExposure(0.5)
    mapping.Update()
    colors = vtk_to_numpy(mapping.GetOutput().GetPointData().GetArray("Colors")).astype(int)
    for pixel, color in zip(halves(draw(actor)), (colors[0], colors[4])):
        assert np.abs(pixel - color).max() <= 1, (curve, pixel, color)

# One mesh, lit by points on the left and by the second page on the right: irradiance and reflectance are equal, so is the light.
mixed = squares({"Irradiance": dim, "LightMapTCoords": OUTSIDE}, {"Irradiance": bright, "LightMapTCoords": INSIDE})
mixed.GetCellData().AddArray(floats("PageId", [0, 0, 1, 1]))
actor = lambert.vtkRadiosityActor()
actor.SetInputData(mixed)
actor.AddLightMapPage(page([100, 0, 0]))
actor.AddLightMapPage(page(dim[0]))
left, right = halves(draw(actor))
assert left.max() > 50 and np.abs(left - right).max() <= 1, (left, right)

# A base texture takes the place of the reflectance for both: linear 0.5 keeps the picture, but for the exposure's own mean.
actor.SetTexture(vtkTexture())
actor.GetTexture().SetInputData(page([0.5] * 3))
actor.GetTexture().SetColorModeToDirectScalars()
actor.GetTexture().UseSRGBColorSpaceOn()
mixed.GetPointData().SetTCoords(floats("TCoords", [[0.5, 0.5]] * 8))
mixed.Modified()
textured = halves(draw(actor))
assert np.abs(textured[0] - left).max() <= 2 and np.abs(textured[0] - textured[1]).max() <= 1, (textured, left)
green = vtkImageData()
green.SetDimensions(1, 1, 1)
green.AllocateScalars(3, 3)
vtk_to_numpy(green.GetPointData().GetScalars())[:] = (0, 255, 0)
actor.SetTexture(vtkTexture())
actor.GetTexture().SetInputData(green)
for pixel in halves(draw(actor)):
    assert pixel[0] == 0 and pixel[2] == 0 and pixel[1] > left[1]

# Specular light of the renderer's lights comes on top, diffuse and ambient do not, under both kinds of shading.
even = squares({"Radiosity": dim}, {"Radiosity": dim})
actor = lambert.vtkRadiosityActor()
actor.SetInputData(even)
plain = draw(actor)[SIZE // 2, 4]
for shading in ("Phong", "PBR"):
    actor = lambert.vtkRadiosityActor()
    actor.SetInputData(even)
    surface = actor.GetProperty()
    getattr(surface, "SetInterpolationTo" + shading)()
    surface.SetSpecular(1)
    surface.SetSpecularPower(200)
    surface.SetRoughness(0.15)
    picture = draw(actor)
    assert (picture[SIZE // 2, SIZE // 2] - plain).min() > 20, shading
    assert np.abs(picture[SIZE // 2, 4] - plain).max() <= 4, shading  # the tail of the highlight

# What lamps and surroundings bring besides goes with the specular part: of the surroundings, red before the mirror, under both
# kinds of shading.
surroundings = vtkImageData()
surroundings.SetDimensions(64, 32, 1)
surroundings.AllocateScalars(3, 3)  # 8 bits
texels = vtk_to_numpy(surroundings.GetPointData().GetScalars()).reshape(32, 64, 3)
texels[:] = 0
texels[:, 32:, 0] = 200  # towards z, where the squares and the eye look at each other
environment = vtkTexture()
environment.SetInputData(surroundings)
environment.InterpolateOn()
environment.MipmapOn()
seen = {}
for shading in ("Phong", "PBR"):
    for is_on in (False, True):
        actor = lambert.vtkRadiosityActor()
        actor.SetInputData(even)
        surface = actor.GetProperty()
        getattr(surface, "SetInterpolationTo" + shading)()
        surface.SetSpecular(0.5)
        surface.SetSpecularPower(200)
        surface.SetRoughness(0.1)
        surface.SetMetallic(1)
        seen[shading, is_on] = draw(actor, environment if is_on else None)[SIZE // 2, 4]
    added = seen[shading, True] - seen[shading, False]
    assert added[0] > 40 and abs(added[1:]).max() <= 4, (shading, added)
assert np.abs((seen["Phong", True] - seen["Phong", False])[0] - 0.5 * 200) <= 4, seen

# Another property on the way mirrors the same, and shows the same light map.
for data, pages, around in ((even, [], environment), (mixed, [page([100, 0, 0]), page(dim[0])], None)):
    actor = lambert.vtkRadiosityActor()
    actor.SetInputData(data)
    for light in pages:
        actor.AddLightMapPage(light)
    pictures = []
    for _ in range(2):
        actor.SetProperty(vtkProperty())
        actor.GetProperty().SetSpecular(0.5)
        actor.GetProperty().SetSpecularPower(200)
        pictures.append(draw(actor, around))
    assert np.array_equal(*pictures) and pictures[0].max() > 50

# So does another shader property, and switching curve and light back and forth on one actor.
actor = lambert.vtkRadiosityActor()
actor.SetInputData(mixed)
for light in ([100, 0, 0], dim[0]):
    actor.AddLightMapPage(page(light))
first = draw(actor)
actor.SetShaderProperty(vtkShaderProperty())
assert np.array_equal(draw(actor), first)
for there, back in ((actor.LinearLightOn, actor.LinearLightOff),
                    (actor.GetToneMapping().SetCurveToFilmic, actor.GetToneMapping().SetCurveToPhotographic),
                    (lambda: actor.GetProperty().SetSpecular(1), lambda: actor.GetProperty().SetSpecular(0))):
    there()
    assert not np.array_equal(draw(actor), first)
    back()
    assert np.array_equal(draw(actor), first)

# A light map is averaged where its texels are smaller than pixels, as far as its charts lie apart.
checks = page([0, 0, 0], 128)
vtk_to_numpy(checks.GetPointData().GetScalars())[:] = 2 * (np.indices((128, 128)).sum(axis=0) % 2).reshape(-1, 1)
flat = squares({"LightMapTCoords": [[0, 0], [1, 0], [1, 1], [0, 1]]}, {"LightMapTCoords": [[0, 0], [1, 0], [1, 1], [0, 1]]})
spread = {}
for padding in (0, 6):
    flat.GetFieldData().AddArray(floats("Atlas.Padding", [padding]))
    actor = lambert.vtkRadiosityActor()
    actor.SetInputData(flat)
    actor.AddLightMapPage(checks)
    actor.GetToneMapping().SetCurveToLinear()
    spread[padding] = draw(actor)[8:-8, 8:-8].std()
assert spread[6] < 2 and spread[0] > 10, spread

# Points without light are an error, and nothing is drawn.
actor, errors = lambert.vtkRadiosityActor(), []
actor.AddObserver("ErrorEvent", lambda *_: errors.append(1))
actor.SetInputData(squares({}, {}))
assert draw(actor).max() == 0 and errors
