"""What the tests of lit models share: reading a GLB file as a viewer does, and Khronos' validator."""
import json
import os
import shutil
import struct
import subprocess

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

WEB = os.path.join(os.environ["LAMBERT_SOURCE_DIR"], "Utilities", "web")
COMPONENTS = {5123: np.uint16, 5125: np.uint32, 5126: np.float32}
REPEAT = 10497
BANDS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def encoded(linear):
    """sRGB codes, 0 to 255, of linear values."""
    linear = np.clip(linear, 0, 1)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.power(linear, 1 / 2.4) - 0.055)


def decoded(codes):
    """Linear values of sRGB codes, 0 to 255."""
    codes = np.asarray(codes) / 255.
    return np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)


def lookup(png, uv, repeats):
    """Bilinear between the texels of a PNG file's bytes, v down, linear."""
    reader = vtkPNGReader()
    reader.SetMemoryBuffer(png)
    reader.SetMemoryBufferLength(len(png))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    texels = decoded(vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3])
    at = uv * (width, height) - 0.5
    first = np.floor(at).astype(int)
    total = 0
    for step in np.ndindex(2, 2):
        column, row = ((first + step) % (width, height) if repeats else np.clip(first + step, 0, (width - 1, height - 1))).T
        total = total + texels[row, column] * np.abs(1 - np.array(step) - (at - first)).prod(axis=1)[:, None]
    return total


def places_in(corners, places):
    """Which of the places lie in a triangle, and the weights of its corners at each."""
    edges = (corners[1:] - corners[0]).T
    across = (np.linalg.pinv(edges) @ (places - corners[0]).T).T
    weights = np.column_stack([1 - across.sum(axis=1), across])
    beside = np.linalg.norm(weights @ corners - places, axis=1)
    return (weights >= -1e-4).all(axis=1) & (beside < 1e-5), weights


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

    def image(self, material):
        """The file in it that the material shows, and how it is looked up."""
        texture = self.document["textures"][material["pbrMetallicRoughness"]["baseColorTexture"]["index"]]
        image = self.document["images"][texture["source"]]
        return self.view(image["bufferView"]), self.document["samplers"][texture["sampler"]]

    def shown(self, primitive, places):
        """What a viewer shows of a primitive at places on it, linear; NaN beside it."""
        attributes, triangles, material = primitive
        color, uv = np.full((len(places), 3), np.nan), np.zeros((len(places), 2))
        for corners in triangles:
            inside, weights = places_in(attributes["POSITION"][corners], places)
            color[inside] = (weights @ attributes["COLOR_0"][corners][:, :3])[inside] if "COLOR_0" in attributes else 1
            if "TEXCOORD_0" in attributes:
                uv[inside] = (weights @ attributes["TEXCOORD_0"][corners])[inside]
        if "TEXCOORD_0" in attributes:
            data, sampler = self.image(material)
            color *= lookup(data, uv, sampler["wrapS"] == REPEAT)
        return color

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
