"""Inverted, doubled and mixed-up copies of a scene are cleaned to the same triangles, area and emitted light."""
import json
import os
import subprocess
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import lambert

script = os.path.join(os.environ["LAMBERT_SOURCE_DIR"], "Utilities", "make-variants.py")
folder = os.path.join(os.environ["LAMBERT_TEMPORARY_DIR"], "TestMakeVariants")


def measure(file):
    """Area of all faces and vector power (exitance times the area vector of the emitting side), and the report."""
    reader = lambert.vtkRadiositySceneReader()
    reader.SetFileName(file)
    reader.Update()
    mesh = reader.GetOutput()
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    corners = points[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    flags = vtk_to_numpy(mesh.GetCellData().GetArray("FaceFlags"))
    emittance = vtk_to_numpy(mesh.GetCellData().GetArray("Emittance"))
    front = (flags & 1).astype(int) - (flags >> 1 & 1)
    power = (np.linalg.norm(area, axis=1) * np.abs(front)) @ emittance
    return (np.linalg.norm(area, axis=1).sum(), power, (area * front[:, None]).T @ emittance,
            json.loads(reader.GetReportJson())["cleaning"])


for scene in ["CornellBox/CornellBox.obj", "SphereByLamp/SphereByLamp.obj"]:
    source = os.path.join(os.environ["LAMBERT_DATA_DIR"], scene)
    name = os.path.splitext(os.path.basename(scene))[0]
    subprocess.run([sys.executable, script, source, folder, "--seed", "3"], check=True, stdout=subprocess.DEVNULL)
    area, power, direction, report = measure(source)
    assert power.min() > 0
    changed = {}
    for variant in ["inverted", "doubled", "mixed"]:
        other = measure(os.path.join(folder, f"{name}-{variant}.obj"))
        # Sums of the same numbers in another order.
        assert np.isclose(other[0], area, rtol=1e-9), (scene, variant)
        assert np.allclose(other[1], power, rtol=1e-9), (scene, variant)
        assert np.allclose(other[2], direction, rtol=1e-9, atol=1e-12 * np.abs(power).max()), (scene, variant)
        for count in ["triangles", "pieces", "openEdges", "nonManifoldEdges", "normalsMade"]:
            assert other[3][count] == report[count], (scene, variant, count)
        changed[variant] = other[3]
    assert changed["doubled"]["repeatedTriangles"] > report["repeatedTriangles"]
    assert changed["mixed"]["facesRewound"] > report["facesRewound"]
