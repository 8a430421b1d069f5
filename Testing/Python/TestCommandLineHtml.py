"""`lambert solve -o OUT.html`: a browser shows the picture that we draw from the same eye, and one can walk in it."""
import numpy as np
from Browser import Browser, picture
from CommandLine import CORNELL_BOX, solve, temporary
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import lambert

if not lambert.vtkRadiosityImageWriter.IsDisplayAvailable():
    raise SystemExit(0)  # There is nothing to compare with.

# From behind: the wall whose back is turned to the eye does not hide the box.
EYE, AT, ANGLE, SIZE = (0.28, 0.3, 1.3), (0.28, 0.25, 0.2), 36, (480, 360)
camera = ",".join(map(str, (*EYE, *AT, ANGLE)))
by_points, by_map, solved = temporary("box.html"), temporary("box-map.html"), temporary("box.vtp")
solve(CORNELL_BOX, "-o", solved, "--error", "0.1")
solve(CORNELL_BOX, "-o", by_points, "--error", "0.1", "--camera", camera)
solve(CORNELL_BOX, "-o", by_map, "--error", "0.1", "--camera", camera, "--lightmap", temporary("map.vtp"))

# Our picture, exposed for the whole solution as the model is.
reader = vtkXMLPolyDataReader()
reader.SetFileName(solved)
colors = lambert.vtkRadiosityToneMapping()
colors.SetInputConnection(reader.GetOutputPort())
writer = lambert.vtkRadiosityImageWriter()
writer.SetInputConnection(colors.GetOutputPort())
writer.SetFileName(temporary("ours.png"))
writer.SetSize(*SIZE)
writer.SetCamera(*EYE, *AT)
writer.SetViewUp(0, 1, 0)
writer.SetViewAngle(ANGLE)
writer.Write()
ours = picture(writer.GetFileName())

# A sheet a millimetre over a floor of 6 m that is drawn after it, under a lamp; beneath it the floor is dark.
stack, on_stack = temporary("stack.obj"), temporary("stack.html")
with open(temporary("stack.mtl"), "w") as file:
    file.write("newmtl floor\nKd .5 .5 .5\nnewmtl sheet\nKd .8 .8 .8\nnewmtl lamp\nKd 0 0 0\nKe 50 50 50\n")
with open(stack, "w") as file:
    file.write("mtllib stack.mtl\nv 2 .001 2\nv 2 .001 4\nv 4 .001 4\nv 4 .001 2\nusemtl sheet\nf 1 2 3 4\n"
               "v 0 0 0\nv 0 0 6\nv 6 0 6\nv 6 0 0\nusemtl floor\nf 5 6 7 8\n"
               "v 2.5 3 2.5\nv 3.5 3 2.5\nv 3.5 3 3.5\nv 2.5 3 3.5\nusemtl lamp\nf 9 10 11 12\n")
solve(stack, "-o", on_stack, "--error", "0.1", "--camera", "3,2.5,9,3,0,3,30")

with Browser(*SIZE) as browser:
    # What lies on the floor hides it wherever they are drawn from far away.
    browser.show(on_stack, "#bare")
    sheet = browser.shoot(temporary("stack.png"))[160:200, 200:280].mean(axis=2)
    assert sheet.min() > 0.8 * np.median(sheet) > 40, (sheet.min(), np.median(sheet))

    # The browser blends colours in linear light and we their codes: a code apart where light is steep. Both have
    # samples of their own at edges, a pixel in fifty. A texel of the map is 1.6 mm, a pixel to two, and soft where
    # shadows are sharp. In another exposure, without the encoding, or seen from elsewhere it is 20 codes and more.
    for page, mean, most in ((by_points, 1.5, 3), (by_map, 2, 5)):
        browser.show(page, "#bare")
        shown = browser.shoot(temporary("shown.png"))
        assert shown.shape == ours.shape, shown.shape
        difference = np.abs(shown - ours).max(axis=2)
        assert difference.mean() < mean and np.percentile(difference, 95) < most, (
            page, difference.mean(), np.percentile(difference, 95))
        assert np.abs(shown[:, ::-1] - ours).mean() > 10  # The comparison can fail.

    # Nothing is asked of a network.
    assert browser.requests and not [url for url in browser.requests if url.startswith(("http", "ws"))], browser.requests

    # The panel names the scene and its size.
    browser.show(by_points)
    text = browser.value("document.getElementById('panel').innerText")
    assert "CornellBox" in text and "55.6 cm" in text and "Walk" in text, text
    first, start = browser.shoot(temporary("first.png")), browser.eye()
    assert np.allclose(start[0], EYE, atol=1e-6)

    # Orbit: the point looked at stays in the middle and as far away.
    browser.drag(80, 20)
    turned = browser.eye()
    far = np.linalg.norm(np.subtract(AT, EYE))
    assert abs(np.linalg.norm(turned[0] - AT) - far) < 1e-4 and np.linalg.norm(turned[0] - EYE) > 0.1 * far
    assert np.allclose(turned[0] + far * turned[1], AT, atol=1e-4)

    # Reset: the first picture again.
    browser.press("KeyR")
    assert np.array_equal(browser.shoot(temporary("again.png")), first)

    # Walk: forwards is where one looks, level; the mouse turns the head about the place.
    browser.press("KeyW")
    browser.press("ArrowUp", until=f"page.camera.position.z < {EYE[2] - 0.05}")
    walked = browser.eye()
    assert abs(walked[0][1] - EYE[1]) < 1e-6 and abs(walked[0][0] - EYE[0]) < 1e-6, walked
    browser.press("KeyD", until=f"page.camera.position.x > {EYE[0] + 0.02}")
    walked = browser.eye()
    browser.drag(-100, 0)
    looked = browser.eye()
    assert np.allclose(looked[0], walked[0]) and looked[1][0] < walked[1][0] - 0.2, (walked, looked)

    # Orbit again: about what lies before the eye, which stays where it is.
    browser.press("KeyO")
    assert np.allclose(browser.eye(), looked, atol=1e-5)
    browser.press("KeyH")
    assert browser.value("getComputedStyle(document.getElementById('panel')).display") == "none"
