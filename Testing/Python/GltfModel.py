"""What the tests of lit models share: reading a GLB file as a viewer does, and Khronos' validator."""
import json
import os
import shutil
import struct
import subprocess

import numpy as np

WEB = os.path.join(os.environ["LAMBERT_SOURCE_DIR"], "Utilities", "web")
COMPONENTS = {5123: np.uint16, 5125: np.uint32, 5126: np.float32}
BANDS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def encoded(linear):
    """sRGB codes, 0 to 255, of linear values."""
    linear = np.clip(linear, 0, 1)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.power(linear, 1 / 2.4) - 0.055)


class GltfModel:
    """The document of a GLB file, its buffer, and its accessors as arrays."""

    def __init__(self, name):
        with open(name, "rb") as file:
            data = file.read()
        magic, version, length, size, kind = struct.unpack_from("<4sIII4s", data)
        assert (magic, version, length, kind) == (b"glTF", 2, len(data), b"JSON")
        self.document = json.loads(data[20:20 + size])
        length, kind = struct.unpack_from("<I4s", data, 20 + size)
        assert kind == b"BIN\0"
        self.buffer = data[28 + size:28 + size + length]

    def view(self, row):
        view = self.document["bufferViews"][row]
        return self.buffer[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]

    def array(self, row):
        accessor = self.document["accessors"][row]
        values = np.frombuffer(self.view(accessor["bufferView"]), COMPONENTS[accessor["componentType"]])
        values = values.reshape(accessor["count"], BANDS[accessor["type"]])
        return values / 65535. if accessor.get("normalized") else values

    def primitives(self):
        """By mesh: its attributes as arrays, its triangles, its material."""
        for mesh in self.document["meshes"]:
            for primitive in mesh["primitives"]:
                attributes = {name: self.array(row) for name, row in primitive["attributes"].items()}
                triangles = self.array(primitive["indices"]).reshape(-1, 3)
                yield attributes, triangles, self.document["materials"][primitive["material"]]


def insist_on_valid(*names):
    """Khronos' validator finds nothing to say about the files."""
    node = shutil.which("node")
    assert node and os.path.isdir(os.path.join(WEB, "node_modules")), "Utilities/setup installs what checks glTF files"
    done = subprocess.run([node, os.path.join(WEB, "validate-gltf"), *names], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    for line in done.stdout.splitlines():
        report = json.loads(line)
        assert report["numErrors"] == report["numWarnings"] == report["numInfos"] == 0, report
    assert len(done.stdout.splitlines()) == len(names)
