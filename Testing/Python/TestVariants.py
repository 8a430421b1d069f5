"""Copies of a scene that are inverted, doubled or of mixed winding (emitters apart) are lit alike, within the verified error."""
import os
import subprocess
import sys

import numpy as np

from CommandLine import DATA, solve, temporary

SCENES = ("CornellBox", "TwoRooms", "SphereByLamp")
POINTS = 500
MAKE_VARIANTS = os.path.join(os.environ["LAMBERT_SOURCE_DIR"], "Utilities", "make-variants.py")


def triangles(path):
    """Corners of the triangles of an OBJ, (n, 3, 3), polygons as fans."""
    points, faces = [], []
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                points.append([float(x) for x in words[1:4]])
            elif words[:1] == ["f"]:
                corners = [int(word.split("/")[0]) for word in words[1:]]
                corners = [c - 1 if c > 0 else len(points) + c for c in corners]
                faces += [[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)]
    return np.array(points)[np.array(faces)]


def write_probes(path, corners, seed):
    """Half of the probes on surfaces by area, on one side or the other; half anywhere in the bounds, facing anywhere."""
    random = np.random.default_rng(seed)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    faces = random.choice(len(corners), POINTS // 2, p=areas / areas.sum())
    root, v = np.sqrt(random.random(POINTS // 2)), random.random(POINTS // 2)
    weights = np.stack([1 - root, root * (1 - v), root * v], axis=1)
    on = np.einsum("nk,nkd->nd", weights, corners[faces])
    on_normals = normals[faces] / areas[faces, None] * random.choice([-1, 1], POINTS // 2)[:, None]
    low, high = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
    free = low + (high - low) * random.random((POINTS - POINTS // 2, 3))
    free_normals = random.normal(size=free.shape)
    rows = np.vstack([np.hstack([on, on_normals]), np.hstack([free, free_normals])])
    np.savetxt(path, rows, delimiter=",", header="x,y,z,nx,ny,nz", comments="", fmt="%.9g")


def light(scene, probes):
    """Readings of the probes, (n, 3), and the measured error."""
    readings = temporary("readings.csv")
    report = solve(scene, "-o", temporary("out.vtp"), "--error", "0.1", "--verify", "2000", "--probe", probes,
                   "--probe-output", readings)
    return np.genfromtxt(readings, delimiter=",", skip_header=1, usecols=(6, 7, 8)), report["error"]["rms"]


def compare(scene):
    probes = temporary("probes.csv")
    folder = os.path.dirname(probes)
    write_probes(probes, triangles(scene), seed=1)
    copies = subprocess.run([sys.executable, MAKE_VARIANTS, scene, folder], check=True, capture_output=True,
                            text=True).stdout.split("\n")[:-1]
    assert len(copies) == 3, copies
    truth, error = light(scene, probes)
    assert np.sqrt(np.mean(truth ** 2)) > 0
    for copy in copies:
        readings, other_error = light(copy, probes)
        difference = np.sqrt(np.mean((readings - truth) ** 2)) / np.sqrt(np.mean(truth ** 2))
        print(f"{os.path.basename(copy)}: {difference:.4f}, verified {error:.4f} and {other_error:.4f}")
        # Two solutions are as far apart as their errors together; probes are 500 where verification has 2000: twice that.
        assert difference <= 2 * np.hypot(error, other_error), (copy, difference, error, other_error)
        # Verified alike too: no copy is worse for how it is wound.
        assert other_error < 1.5 * error + 0.01, (copy, error, other_error)


if __name__ == "__main__":
    for name in SCENES:
        compare(os.path.join(DATA, name, name + ".obj"))
