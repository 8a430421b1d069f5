"""`lambert solve -o OUT.glb` of textured surfaces: base texture times light, kept beside each other or baked into one image."""
import os

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from Browser import Browser, picture
from CommandLine import fails, solve, temporary, write_png
from GltfModel import REPEAT, GltfModel, decoded, insist_on_valid
from PolyDataFile import mesh_of
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkTexture, vtkWindowToImageFilter

import lambert

# A floor of 2 m under four by four checks, light and dark, of an image that repeats once; a wall without one; a lamp.
CHECKS, CODES, FACTOR = 4, (230, 90), (0.9, 0.8, 0.7)
checks = np.where(np.add.outer(np.arange(64) // 32, np.arange(64) // 32) % 2, CODES[1], CODES[0])
image_name = write_png(temporary("checks of the floor.png"), checks[..., None].repeat(3, 2))
scene = temporary("floor.obj")
with open(temporary("floor.mtl"), "w") as file:
    file.write(f"newmtl floor\nKd {' '.join(map(str, FACTOR))}\nmap_Kd {os.path.basename(image_name)}\n"
               "newmtl wall\nKd .6 .6 .6\nnewmtl lamp\nKd 0 0 0\nKe 30 30 30\n")
with open(scene, "w") as file:
    file.write("mtllib floor.mtl\nv 0 0 0\nv 0 0 2\nv 2 0 2\nv 2 0 0\nvt 0 0\nvt 0 2\nvt 2 2\nvt 2 0\nusemtl floor\nf 1/1 2/2 3/3 4/4\n"
               "v 0 2 0\nv 2 2 0\nusemtl wall\nf 1 4 6 5\n"
               "v .7 1.9 .7\nv 1.3 1.9 .7\nv 1.3 1.9 1.3\nv .7 1.9 1.3\nusemtl lamp\nf 7 8 9 10\n")

EYE, AT, ANGLE, SIZE, EV = (1, 1.6, 3.6), (1, 0.3, 0.5), 40, (320, 240), 12
camera = "--camera", ",".join(map(str, (*EYE, *AT, ANGLE)))
# Light as it is, dark enough that nothing clips: what is shown is proportional to it.
scene_and_error = scene, "--error", "0.03"
common = *scene_and_error, "--tone", "linear", "--ev", EV, *camera
keeping = "--lightmap", temporary("map.vtp"), "--page-size", "256", "--keep-textures"
light_map = *keeping[:4], "--baked-size", "600"
by_points, baked, kept = temporary("points.glb"), temporary("baked.glb"), temporary("kept.glb")
told = solve(*common, "-o", by_points)["lit_model"]
told_of_baked = solve(*common, *light_map, "-o", baked)["lit_model"]
told_of_kept = solve(*common, *keeping, "-o", kept)["lit_model"]
assert told["images"] == 1 and told["baked_texels"] == told_of_kept["baked_texels"] == 0
assert told_of_baked["baked_texels"] == 512 * 512  # The largest multiple of the page's
insist_on_valid(by_points, baked, kept)


def floor_of(model):
    """What shows at the middles of refined triangles well within checks, linear, and where they are."""
    (attributes, triangles, material), = [p for p in model.primitives() if p[2]["name"] == "floor"]
    bytes_of_image, sampler = model.image(material)
    assert bytes_of_image == open(image_name, "rb").read()  # The file's own
    assert sampler["wrapS"] == sampler["wrapT"] == REPEAT  # It repeats.
    # Nothing but image and light: a factor that is in the light leaves it room to be bright.
    assert "baseColorFactor" not in material["pbrMetallicRoughness"]
    places = attributes["POSITION"][triangles].mean(axis=1)
    down = attributes["TEXCOORD_0"][triangles].mean(axis=1) * CHECKS / 2
    inside = (np.abs(down - np.floor(down) - 0.5) < 0.3).all(axis=1)
    # Coordinates run down the image, whose rows are told here from below.
    is_dark = (np.floor(down[:, 0]) + np.floor(-down[:, 1])) % 2 == 1
    shown = attributes["COLOR_0"][triangles].mean(axis=1)[:, :3] * decoded(np.where(is_dark, CODES[1], CODES[0]))[:, None]
    return places[inside], shown[inside], is_dark[inside]


# By points: the image and the light stand beside each other.
places, shown, is_dark = floor_of(GltfModel(by_points))
assert is_dark.sum() > 20 and (~is_dark).sum() > 20
again = floor_of(GltfModel(kept))
assert np.array_equal(places, again[0]) and np.allclose(shown, again[1])

# Baked: the texel where they lie shows the same.
model = GltfModel(baked)
(attributes, triangles, material), *others = [p for p in model.primitives() if "TEXCOORD_0" in p[0]]
assert not others and "COLOR_0" not in attributes
png = temporary("baked.png")
with open(png, "wb") as file:
    file.write(model.image(material)[0])
page = picture(png)[::-1]  # Rows from above
found = np.zeros_like(shown)
for corners in triangles:
    p, uv = attributes["POSITION"][corners], attributes["TEXCOORD_0"][corners]
    if np.abs(p[:, 1]).max() > 0:
        continue
    across = np.linalg.solve(np.stack([p[1] - p[0], p[2] - p[0]])[:, [0, 2]].T, (places - p[0])[:, [0, 2]].T).T
    within = (across >= -1e-6).all(axis=1) & (across.sum(axis=1) <= 1 + 1e-6)
    at = uv[0] + across @ (uv[1:] - uv[0])
    texel = (at * len(page)).astype(int)
    found[within] = decoded(page[texel[:, 1], texel[:, 0]])[within]
# Half a code of eight bits is up to 3 % of the dark checks; light changes by a little over half a texel of the map, 8 mm.
assert np.median(np.abs(found - shown) / shown.mean()) < 0.02, np.median(np.abs(found - shown) / shown.mean())
assert np.percentile(np.abs(found - shown).max(axis=1) / shown.mean(), 95) < 0.1

# Where there is no map there is nothing to keep textures from.
fails(2, "solve", scene, "-o", kept, "--keep-textures", says=["--lightmap"])
fails(2, "solve", scene, "-o", baked, *light_map[:2], "--baked-size", "0", says=["--baked-size"])



def our_picture():
    """What vtkRadiosityActor shows from the same eye: the floor under its image times its colour, all else as it is."""
    solved = temporary("solved.vtp")
    solve(*scene_and_error, "-o", solved)
    names = mesh_of(solved).GetFieldData().GetAbstractArray("Material.Name")
    renderer, window, grab = vtkRenderer(), vtkRenderWindow(), vtkWindowToImageFilter()
    for is_floor in (True, False):
        mesh = mesh_of(solved)
        mesh.BuildCells()
        for cell, material in enumerate(vtk_to_numpy(mesh.GetCellData().GetArray("MaterialId"))):
            if (names.GetValue(material) == "floor") != is_floor:
                mesh.DeleteCell(cell)
        mesh.RemoveDeletedCells()
        actor = lambert.vtkRadiosityActor()
        actor.SetInputData(mesh)
        actor.GetToneMapping().SetCurveToLinear()
        actor.GetToneMapping().SetExposureValue(EV)
        if is_floor:
            image = vtkImageData()
            image.SetDimensions(64, 64, 1)
            linear = decoded(checks).reshape(-1, 1) * FACTOR
            image.GetPointData().SetScalars(numpy_to_vtk(linear.astype(np.float32), deep=1))
            texture = vtkTexture()
            texture.SetInputData(image)
            texture.SetColorModeToDirectScalars()
            texture.UseSRGBColorSpaceOn()
            texture.InterpolateOn()
            texture.RepeatOn()
            actor.SetTexture(texture)
        renderer.AddActor(actor)
    eye = renderer.GetActiveCamera()
    eye.SetPosition(EYE)
    eye.SetFocalPoint(AT)
    eye.SetViewUp(0, 1, 0)
    eye.SetViewAngle(ANGLE)
    renderer.ResetCameraClippingRange()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(4)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    window.Render()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(*SIZE[::-1], -1)[:, :, :3].astype(float)


# A browser shows checks either way, those of our own picture.
if lambert.vtkRadiosityImageWriter.IsDisplayAvailable():
    shots = {}
    with Browser(*SIZE) as browser:
        for name, more in (("points", ()), ("baked", light_map), ("kept", keeping)):
            html = temporary(name + ".html")
            solve(*common, *more, "-o", html)
            browser.show(html, "#bare")
            shots[name] = browser.shoot(temporary(name + ".png"))
    for name in ("baked", "kept"):
        difference = np.abs(shots[name] - shots["points"]).max(axis=2)
        # Borders of checks are as soft as a texel of the baked image, 4 mm.
        assert difference.mean() < 2, (name, difference.mean())
    floor = shots["points"][40:80, 60:260].mean(axis=2)
    assert np.percentile(floor, 90) > 1.5 * np.percentile(floor, 10), np.percentile(floor, (10, 90))

    # The images are the same, and so is the light at points: what differs is how colours between points are rounded, a code.
    # Baked checks have their soft borders besides; those far off are a pixel wide. Without the encoding, the colour of the
    # material or the image, or seen from elsewhere it is six codes and more.
    ours = our_picture()
    for name, mean, most in (("points", 0.3, 2), ("kept", 0.4, 2), ("baked", 0.6, 8)):
        difference = np.abs(shots[name] - ours).max(axis=2)
        assert difference.mean() < mean and np.percentile(difference, 99) < most, (
            name, difference.mean(), np.percentile(difference, 99))
        assert np.abs(shots[name][:, ::-1] - ours).mean() > 10  # The comparison can fail.
