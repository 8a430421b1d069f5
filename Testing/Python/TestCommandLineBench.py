"""`lambert bench --quick`: every method and study runs, the table makes sense, charts are drawn. Never a timing."""
import csv
import os
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkIOImage import vtkPNGReader

import lambert
from CommandLine import CORNELL_BOX, fails, run, temporary

METHODS = {"hierarchical", "reference", "cached", "matrix", "progressive"}
STAGES = ("clustering_s", "setup_s", "solve_s", "reconstruction_s")
folder = temporary("bench")
charts = lambert.vtkRadiosityImageWriter.IsDisplayAvailable()


def bench(*arguments, charts=False):
    done = run("bench", "--quick", "-o", folder, *arguments, *([] if charts else ["--no-charts"]))
    assert done.returncode == 0 and done.stderr == "", done.stderr


def table(name):
    with open(os.path.join(folder, name), newline="") as file:
        return list(csv.DictReader(file))


def numbers(row, *names):
    return [float(row[name]) for name in names]


bench(CORNELL_BOX, charts=charts)
rows = table("Measurements.csv")
assert {row["study"] for row in rows} == {"sweep", "tessellation", "convergence"}
for row in rows:
    assert row["note"] == "", row
    seconds, load, low, rms, high, receivers = numbers(row, "seconds", "load", "rms_low", "rms", "rms_high", "receivers")
    assert seconds > 0 and load >= 0 and receivers == 200, row
    # No method is without light, and none is far beyond black, whose error is 1.
    assert 0 <= low <= rms <= high and 0 < rms < 0.9, row
    assert float(row["reference_noise"]) < 0.1, row

# The sweep: each method with its two values, the finer one better (their errors are a factor of 1.3 and more apart).
sweep = {(row["method"], float(row["value"])): row for row in rows if row["study"] == "sweep"}
assert {method for method, value in sweep} == METHODS
for coarse, fine in ((("hierarchical", 0.5), ("hierarchical", 0.1)), (("reference", 4), ("reference", 16)),
                     (("cached", 16), ("cached", 64)), (("matrix", 0.2), ("matrix", 0.1)),
                     (("progressive", 0.2), ("progressive", 0.1))):
    assert float(sweep[fine]["rms"]) < float(sweep[coarse]["rms"]), (sweep[coarse], sweep[fine])
    if coarse[0] == "reference":
        assert sweep[coarse]["elements"] == "", sweep[coarse]
    else:
        assert 0 < float(sweep[coarse]["elements"]) <= float(sweep[fine]["elements"]), (sweep[coarse], sweep[fine])
for row in sweep.values():
    # The box of 38 triangles was tessellated to about 1000 vertices.
    assert row["triangles_before_tessellation"] == "38" and 990 <= float(row["vertices"]) <= 1100, row
    assert float(row["peak_mb"]) > 1 and float(row["rays"]) > 0 or row["method"] == "matrix", row

# Stages add up; the knot has about the triangles that were asked for.
for row in rows:
    if row["clustering_s"]:
        assert abs(sum(numbers(row, *STAGES)) - float(row["seconds"])) < 1e-4 * float(row["seconds"]), row
knot = next(row for row in rows if row["study"] == "tessellation")
assert abs(float(knot["triangles"]) / 20000 - 1) < 0.01 and float(knot["bvh_s"]) > 0 and float(knot["output_s"]) > 0, knot
assert not os.path.exists(os.path.join(folder, "Tessellation.vtp"))

# What is shown gets better, later.
shown = [row for row in rows if row["study"] == "convergence"]
assert [row["value"] for row in shown] == [str(1 + i) for i in range(len(shown))] and len(shown) >= 3, shown
assert float(shown[-1]["rms"]) < float(shown[0]["rms"]) and float(shown[-1]["seconds"]) > float(shown[0]["seconds"])

# The tables that are read off it.
equal = table("EqualError.csv")
assert len(equal) == 4 * len(METHODS), equal
for row in equal:
    assert (row["seconds"] == "") == (row["how"] == "not reached"), row
    if row["method"] == "reference":
        assert float(row["times_as_fast_as_bake"]) == 1, row
with open(os.path.join(folder, "Tables.md")) as file:
    assert "path-traced bake" in file.read()

# Charts, of the size that was meant.
names = ["ErrorAgainstTime-CornellBox", "ErrorAgainstElements-CornellBox", "TimeAgainstTriangles", "Convergence"]
for name in names if charts else []:
    reader = vtkPNGReader()
    reader.SetFileName(os.path.join(folder, name + ".png"))
    reader.Update()
    assert reader.GetOutput().GetDimensions() == (800, 560, 1), name
    drawing = ElementTree.parse(os.path.join(folder, name + ".svg")).getroot()
    assert len(list(drawing.iter())) > 50, name

# A second bench takes the reference that the first has traced, and finds the same error.
references = os.path.join(folder, "References")
kept = {name: os.stat(os.path.join(references, name)).st_mtime_ns for name in os.listdir(references)}
bench(CORNELL_BOX, "--studies", "sweep", "--methods", "hierarchical")
assert kept == {name: os.stat(os.path.join(references, name)).st_mtime_ns for name in os.listdir(references)}
again = table("Measurements.csv")
assert [row["rms"] for row in again] == [sweep["hierarchical", value]["rms"] for value in (0.5, 0.1)], again

# What cannot be done is said.
fails(1, "bench", CORNELL_BOX, "-o", folder, "--methods", "photon", "--no-charts", says=("photon", "matrix"))
fails(1, "bench", "nowhere.obj", "-o", folder, "--no-charts", says=("nowhere.obj",))
fails(2, "bench", "-o", folder, says=("SCENE",))
