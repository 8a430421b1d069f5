"""Raw triangles - unwelded, wound at random, doubled, some without area - get the same light as the cleaned scene."""
import os
import random

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import lambert

SAMPLES = 512


def quad(a, b, c, d, n):
    """The triangles of a quad, cut n x n, counter-clockwise from the front."""
    a, b, c, d = (np.array(p, float) for p in (a, b, c, d))

    def point(i, j):
        s, t = i / n, j / n
        return a * (1 - s) * (1 - t) + b * s * (1 - t) + c * s * t + d * (1 - s) * t

    for i in range(n):
        for j in range(n):
            p, q, r, s = point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)
            yield p, q, r
            yield p, r, s


def box(low, high, n):
    (x, y, z), (u, v, w) = low, high
    for corners in (((x, y, z), (x, y, w), (u, y, w), (u, y, z)), ((x, v, z), (u, v, z), (u, v, w), (x, v, w)),
                    ((x, y, z), (u, y, z), (u, v, z), (x, v, z)), ((x, y, w), (x, v, w), (u, v, w), (u, y, w)),
                    ((x, y, z), (x, v, z), (x, v, w), (x, y, w)), ((u, y, z), (u, y, w), (u, v, w), (u, v, z))):
        yield from quad(*corners, n)


def write(name, materials):
    with open(name + ".mtl", "w") as file:
        file.write("newmtl wall\nKd .7 .6 .5\nnewmtl block\nKd .3 .5 .7\nnewmtl lamp\nKd 0 0 0\nKe 5 5 5\n")
    with open(name + ".obj", "w") as file:
        file.write(f"mtllib {os.path.basename(name)}.mtl\n")
        count = 0
        for material, triangles in materials:
            file.write(f"o {material}\nusemtl {material}\n")
            for triangle in triangles:
                for point in triangle:
                    file.write("v %.9g %.9g %.9g\n" % tuple(point))
                file.write(f"f {count + 1} {count + 2} {count + 3}\n")
                count += 3


def spoil(triangles):
    for number, (p, q, r) in enumerate(triangles):
        yield (p, q, r) if random.random() < 0.5 else (r, q, p)
        if number % 5 == 0:
            yield (q, r, p) if random.random() < 0.5 else (p, r, q)  # Again, over the first.
        if number % 7 == 0:
            yield p, q, (p + q) / 2  # A needle.
        if number % 11 == 0:
            yield p, p, p


def bake(name, seed, clean):
    reader = lambert.vtkRadiositySceneReader()
    reader.SetFileName(name + ".obj")
    for step in ("Weld", "RemoveZeroArea", "RemoveRepeated", "Orient", "FixEmitters"):
        getattr(reader, "Set" + step)(clean)
    method = lambert.vtkPathTracedIrradiance()
    method.SetInputConnection(reader.GetOutputPort())
    method.SetSamples(SAMPLES)
    method.SetSeed(seed)
    method.Update()
    return method.GetOutput()


def light_by_place(data):
    """Irradiance at every position and normal: means over the points that share them and are of faces with area."""
    points, normals = (vtk_to_numpy(a).round(4) + 0.0 for a in (data.GetPoints().GetData(), data.GetPointData().GetNormals()))
    irradiance = vtk_to_numpy(data.GetPointData().GetArray("Irradiance"))
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    xyz = vtk_to_numpy(data.GetPoints().GetData())[corners]
    areas = np.linalg.norm(np.cross(xyz[:, 1] - xyz[:, 0], xyz[:, 2] - xyz[:, 0]), axis=1)
    places = {}
    for point in np.unique(corners[areas > 1e-6]):
        places.setdefault((*points[point], *normals[point]), []).append(irradiance[point])
    return {place: np.mean(light, axis=0) for place, light in places.items()}


random.seed(1)
folder = os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], "TestRawTriangles")
os.makedirs(folder, exist_ok=True)
room = [triangle[::-1] for triangle in box((0, 0, 0), (1, 1, 1), 4)]
block = list(box((.5625, 0, .5625), (.8125, .375, .8125), 2))  # Halves are exact, or needles would keep some area.
lamp = list(quad((.4, .98, .4), (.6, .98, .4), (.6, .98, .6), (.4, .98, .6), 1))
whole, spoilt = os.path.join(folder, "whole"), os.path.join(folder, "spoilt")
write(whole, [("wall", room), ("block", block), ("lamp", lamp)])
write(spoilt, [("wall", spoil(room)), ("block", spoil(block)), ("lamp", lamp)])  # Winding says where a lamp shines.

raw, cleaned, again = bake(spoilt, 1, False), bake(spoilt, 2, True), bake(whole, 3, True)
assert raw.GetNumberOfCells() > 1.2 * cleaned.GetNumberOfCells()  # The spoilt triangles are there.
assert cleaned.GetNumberOfCells() == again.GetNumberOfCells()
raw, cleaned, again = light_by_place(raw), light_by_place(cleaned), light_by_place(again)
assert set(cleaned) == set(again)

# A lit place of the cleaned scene is there in the raw one. (None lies on the block's foot, where light jumps.)
lit = [place for place, light in cleaned.items() if light.max() > 0]
assert len(lit) > 150 and set(lit) <= set(raw), len(set(lit) - set(raw))


def rms(a, b):
    return np.sqrt(np.mean([np.square(a[place] - b[place]) for place in lit]))


# Between raw and cleaned lies no more than between two seeds. Places of the raw scene take means over up to six
# vertices; those of the cleaned one, one each. The factor 1.5 is for the scatter of an rms over 150 places, half of
# whose squares a few places by the lamp carry; a fifth more light in one place of ten would break it.
noise = rms(cleaned, again)
scale = np.sqrt(np.mean([np.square(cleaned[place]) for place in lit]))
assert 0 < noise < 0.05 * scale, (noise, scale)
assert rms(raw, cleaned) < 1.5 * noise, (rms(raw, cleaned), noise)
mean = {name: np.mean([light[place] for place in lit]) for name, light in (("raw", raw), ("cleaned", cleaned))}
assert abs(mean["raw"] / mean["cleaned"] - 1) < 0.01, mean
