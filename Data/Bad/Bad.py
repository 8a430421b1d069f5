#!/usr/bin/python3
"""Files that a reader must refuse with one clear sentence, and a few that it must survive."""
import json
import os
import struct

FOLDER = os.path.dirname(os.path.abspath(__file__))
SQUARE = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n"
LAMP = "newmtl Lamp\nKd 0 0 0\nKe 1 1 1\nnewmtl Grey\nKd .5 .5 .5\n"


def write(name, data):
    with open(os.path.join(FOLDER, name), "wb") as out:
        out.write(data if isinstance(data, bytes) else data.encode("ascii"))


def truncated_glb():
    """A glTF binary whose header promises a mesh of 36 bytes that the file does not hold."""
    gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}]}
    text = json.dumps(gltf).encode("ascii")
    text += b" " * (-len(text) % 4)
    header = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + 36)
    return header + struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", 36, b"BIN\0") + bytes(7)


write("bad.mtl", LAMP)
write("empty.obj", "")
write("garbage.obj", bytes((i * 7919 + 13) % 256 for i in range(512)))
write("truncated.glb", truncated_glb())
write("nan.obj", "mtllib bad.mtl\nusemtl Lamp\n" + SQUARE + "v nan 1 0\nf 1 2 3 4\nf 1 2 5\n")
write("infinite.obj", "mtllib bad.mtl\nusemtl Lamp\n" + SQUARE + "v 0 1e999 0\nf 1 2 3 4\nf 1 2 5\n")
write("index.obj", "mtllib bad.mtl\nusemtl Lamp\n" + SQUARE + "f 1 2 3 4\nf 1 2 99\n")
write("nolight.obj", "mtllib bad.mtl\nusemtl Grey\n" + SQUARE + "f 4 3 2 1\n")
write("zeroarea.obj", "mtllib bad.mtl\nusemtl Lamp\nv 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n")
write("nomaterial.obj", "mtllib missing.mtl\nusemtl Missing\n" + SQUARE + "f 4 3 2 1\n")
write("doubled.obj", "mtllib bad.mtl\nusemtl Lamp\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\nusemtl Grey\n" + SQUARE
      + "f 8 7 6 5\nf 5 6 7 8\nf 5 6 6\n")
