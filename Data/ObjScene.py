"""Writes OBJ+MTL scenes for the generator scripts in this folder. Lengths are metres, y points up."""
import os

import numpy as np


class ObjScene:
    """Collects named objects of polygons with materials, and writes them as one OBJ with its MTL."""

    def __init__(self, title, digits=4):
        self.title, self.digits = title, digits
        self.materials, self.objects, self.camera = {}, [], None

    def material(self, name, kd, ke=(0, 0, 0)):
        """Diffuse reflectance `kd` [0,1]; emitted radiance `ke`, W/(m2 sr)."""
        self.materials[name] = (kd, ke)
        return name

    def add(self, name, material, points, faces):
        """Joins points that agree in the written digits; drops polygons that shrink to nothing."""
        points = np.round(np.asarray(points, float).reshape(-1, 3), self.digits) + 0.0
        unique, index = np.unique(points, axis=0, return_inverse=True)
        index = index.reshape(-1)
        kept = []
        for face in faces:
            corners = [int(index[i]) for i in face]
            corners = [c for k, c in enumerate(corners) if c != corners[k - 1]]
            if len(set(corners)) == len(corners) >= 3:
                kept.append(corners)
        used = np.unique([c for face in kept for c in face])
        row = {int(old): new for new, old in enumerate(used)}
        self.objects.append((name, material, unique[used], [[row[c] for c in f] for f in kept]))

    def quad(self, name, material, corners, facing):
        """One quadrilateral, wound so that its front looks along `facing`."""
        corners = np.asarray(corners, float)
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        order = [0, 1, 2, 3] if np.dot(normal, facing) > 0 else [3, 2, 1, 0]
        self.add(name, material, corners, [order])

    def triangles(self):
        return sum(len(face) - 2 for _, _, _, faces in self.objects for face in faces)

    def write(self, folder, base):
        form = "{:.%df}" % self.digits

        def number(x):
            text = form.format(x).rstrip("0").rstrip(".")
            return "0" if text in ("-0", "") else text

        with open(os.path.join(folder, base + ".mtl"), "w", encoding="ascii") as out:
            out.write(f"# {self.title}\n# Kd: diffuse reflectance. Ke: radiance, W/(m2 sr).\n")
            for name, (kd, ke) in self.materials.items():
                out.write(f"\nnewmtl {name}\nKd {kd[0]:g} {kd[1]:g} {kd[2]:g}\n")
                if any(ke):
                    out.write("Ke {:.8g} {:.8g} {:.8g}\n".format(*ke))
        with open(os.path.join(folder, base + ".obj"), "w", encoding="ascii") as out:
            out.write(f"# {self.title}\n# Written by {base}.py. Metres, y up. {self.triangles()} triangles.\n")
            if self.camera:
                out.write("# camera " + " ".join(f"{x:g}" for x in self.camera) + "\n")
            out.write(f"mtllib {base}.mtl\n")
            first = 1
            for name, material, points, faces in self.objects:
                out.write(f"o {name}\nusemtl {material}\n")
                out.writelines("v " + " ".join(number(x) for x in p) + "\n" for p in points)
                out.writelines("f " + " ".join(str(c + first) for c in f) + "\n" for f in faces)
                first += len(points)
        print(f"{base}: {self.triangles()} triangles, {first - 1} points")


def grid_faces(rows, columns, offset=0):
    """Quads of a rows x columns grid of points, stored row by row."""
    faces = []
    for i in range(rows - 1):
        for j in range(columns - 1):
            a = offset + i * columns + j
            faces.append([a, a + 1, a + columns + 1, a + columns])
    return faces


def inward_cube():
    """The six faces of the unit cube, wound so that they face its inside."""
    points = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    faces = {"Floor": [0, 4, 5, 1], "Ceiling": [2, 3, 7, 6], "West": [0, 2, 6, 4],
             "East": [1, 5, 7, 3], "North": [0, 1, 3, 2], "South": [4, 6, 7, 5]}
    return points, faces
