"""A page in Debian's Chromium, without a display: its picture, its keys and its mouse, over the pipe of its debugger."""
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

PATIENCE = 120  # Seconds until a page has to be there: software rendering on a busy machine.


def picture(name):
    """Rows from below, columns, bands."""
    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3].astype(float)


class Browser:
    def __init__(self, width, height):
        program = shutil.which("chromium")
        assert program, "Utilities/setup installs the browser that shows pages"
        self.profile = tempfile.mkdtemp()
        commands, self.to_browser = os.pipe()
        self.from_browser, answers = os.pipe()
        # As root there is no sandbox; SwiftShader draws WebGL without a graphics card.
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{commands} 4>&{answers}', "bash", program, "--headless=new", "--no-sandbox",
             "--remote-debugging-pipe", f"--user-data-dir={self.profile}", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--hide-scrollbars", "--force-device-scale-factor=1",
             f"--window-size={width},{height}"], pass_fds=(commands, answers), stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(commands)
        os.close(answers)
        self.rest, self.number, self.session, self.requests = b"", 0, None, []
        self.size = width, height

    def __enter__(self):
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.call("Network.enable")
        self.call("Page.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=self.size[0], height=self.size[1], deviceScaleFactor=1,
                  mobile=False)
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()
        os.close(self.to_browser)
        os.close(self.from_browser)
        shutil.rmtree(self.profile, ignore_errors=True)

    def message(self):
        while b"\0" not in self.rest:
            part = os.read(self.from_browser, 1 << 16)
            assert part, "the browser ended"
            self.rest += part
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **parameters):
        self.number += 1
        command = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            command["sessionId"] = self.session
        data = json.dumps(command).encode() + b"\0"
        while data:
            data = data[os.write(self.to_browser, data):]
        while True:
            answer = self.message()
            if answer.get("method") == "Network.requestWillBeSent":
                self.requests.append(answer["params"]["request"]["url"])
            if answer.get("id") == self.number:
                assert "error" not in answer, answer
                return answer["result"]

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def wait_for(self, expression):
        end = time.monotonic() + PATIENCE
        while not self.value(expression):
            assert time.monotonic() < end, expression
            time.sleep(0.05)

    def show(self, file, suffix=""):
        """Opens a page of a lit model and waits until it has drawn."""
        self.call("Page.navigate", url="file://" + file + suffix)
        self.wait_for("document.body && document.body.dataset.state")
        assert self.value("document.body.dataset.state") == "drawn", self.value("document.body.innerText")

    def shoot(self, name):
        """The picture, also left as a file."""
        # Two frames later what was drawn is on the screen.
        self.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        data = self.call("Page.captureScreenshot", format="png")["data"]
        with open(name, "wb") as file:
            file.write(base64.b64decode(data))
        return picture(name)

    def eye(self):
        """Where the camera of the page stands and which way it looks."""
        return np.array(self.value("""(() => {
            const {position, matrixWorld} = page.camera;
            return [position.toArray(), [-matrixWorld.elements[8], -matrixWorld.elements[9], -matrixWorld.elements[10]]];
        })()"""))

    def press(self, code, until="true"):
        """Holds a key until the page says so."""
        self.call("Input.dispatchKeyEvent", type="keyDown", code=code, key=code)
        self.wait_for(until)
        self.call("Input.dispatchKeyEvent", type="keyUp", code=code, key=code)

    def drag(self, x, y):
        """Drags the mouse from the middle by so many pixels."""
        at = [self.size[0] // 2, self.size[1] // 2]
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=at[0], y=at[1], button="left", buttons=1, clickCount=1)
        for _ in range(10):
            at = [at[0] + x / 10, at[1] + y / 10]
            self.call("Input.dispatchMouseEvent", type="mouseMoved", x=at[0], y=at[1], button="left", buttons=1)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=at[0], y=at[1], button="left", buttons=0, clickCount=1)
