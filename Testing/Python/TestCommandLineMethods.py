"""`lambert solve --method`: every method from the same command line, its own options, its name in the report."""
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from CommandLine import CORNELL_BOX, fails, run, solve, temporary
from PolyDataFile import mesh_of

out = temporary("box.vtp")


def irradiance(name):
    return vtk_to_numpy(mesh_of(name).GetPointData().GetArray("Irradiance"))


# The default is hierarchical, and says so.
report = solve(CORNELL_BOX, "-o", out, "--error", "0.3", "--iterations", "1")
assert report["method"] == {"name": "hierarchical", "error": 0.3, "time": 0, "max_memory": 0, "iterations": 1, "final_gather": True,
                            "oracle": "doubt", "schedule": "scheduled", "refinement": "rectangle"}, report["method"]
assert report["requested_error"] == 0.3 and "clustering" in report and "energy_w" in report

# The reference lights the vertices of the mesh as it is, without clusters.
report = solve(CORNELL_BOX, "-o", out, "--method", "reference", "--samples", "64")
assert report["method"] == {"name": "reference", "samples": 64, "seed": 1}, report["method"]
assert report["output"]["triangles"] >= report["scene"]["triangles"] and report["rays"] > 64 * report["elements"]["total"]
assert report["stopped_by"] == "error" and report["iterations"] == 1
for field in ("requested_error", "clustering", "energy_w"):
    assert field not in report, field
light = irradiance(out)
assert np.isfinite(light).all() and light.min() >= 0 and light.max() > 0

# The same seed gives the same bits for any number of threads; another seed does not.
for more, is_same in ((["--threads", "1"], True), (["--threads", "3"], True), (["--seed", "2"], False)):
    solve(CORNELL_BOX, "-o", out, "--method", "reference", "--samples", "64", *more)
    assert np.array_equal(irradiance(out), light) == is_same, more

# What goes around a method goes around every method: verification, a sky.
report = solve(CORNELL_BOX, "-o", out, "--method", "reference", "--samples", "16", "--verify", "50", "--sky", ".1", ".1", ".1")
assert report["error"]["points"] > 0 and report["scene"]["lights"]["sky"] == 1

# Methods on uniform elements: bright where the reference is. Elements of a tenth of a metre in a box of half a metre
# leave 5 to 8 %, to which 200 points of verification add a few.
for method, options, values in (
        ("matrix", [], {}),
        ("progressive", [], {}),
        ("cached", ["--output-size", "0.05", "--paths", "24", "--gather-rays", "16", "--emitter-rays", "8", "--seed", "3"],
         {"output_size": 0.05, "paths": 24, "gather_rays": 16, "emitter_rays": 8, "seed": 3})):
    report = solve(CORNELL_BOX, "-o", out, "--method", method, "--element-size", "0.1", *options, "--verify", "200")
    assert report["method"] == {"name": method, "element_size": 0.1, **values}, report["method"]
    assert report["output"]["triangles"] > report["scene"]["triangles"], method
    assert report["error"]["bounded"] < 0.2 and abs(report["error"]["bias"]) < 0.1, (method, report["error"])

# An option of another method is wrong usage, said in one sentence that names both.
for method, options in (("hierarchical", ["--samples", "--seed", "--element-size", "--output-size", "--paths", "--gather-rays",
                                         "--emitter-rays"]),
                        ("reference", ["--error", "--time", "--iterations", "--no-final-gather", "--element-size", "--paths", "--gather-rays"]),
                        ("matrix", ["--error", "--samples", "--seed", "--output-size", "--paths", "--gather-rays"]),
                        ("progressive", ["--error", "--samples", "--seed", "--paths", "--gather-rays", "--emitter-rays"]),
                        ("cached", ["--error", "--time", "--iterations", "--samples"])):
    for option in options:
        fails(2, "solve", CORNELL_BOX, "-o", out, "--method", method, option, "1", says=[option, "--method " + method])
for option, value in (("--oracle", "bfa"), ("--schedule", "interleaved"), ("--refinement", "quadtree"), ("--snap-tolerance", "0.1")):
    fails(2, "solve", CORNELL_BOX, "-o", out, "--method", "matrix", option, value, says=[option, "--method matrix"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--samples", "9", says=["--method hierarchical"])  # Not given is the default.

# Values without meaning.
fails(2, "solve", CORNELL_BOX, "-o", out, "--method", "photons", says=["photons", "reference"])
for method, option, value in (("hierarchical", "--oracle", "delphi"), ("hierarchical", "--schedule", "never"),
                              ("hierarchical", "--refinement", "octree"), ("hierarchical", "--snap-tolerance", "0.5"),
                              ("reference", "--samples", "0"), ("reference", "--samples", "many"),
                              ("reference", "--seed", "-1"), ("matrix", "--element-size", "-1"),
                              ("matrix", "--element-size", "nan"), ("cached", "--paths", "0"), ("cached", "--gather-rays", "0"),
                              ("cached", "--output-size", "-1"), ("cached", "--emitter-rays", "0")):
    fails(2, "solve", CORNELL_BOX, "-o", out, "--method", method, option, value, says=[option])
for method in ("matrix", "progressive", "cached"):  # More elements than any memory holds.
    fails(1, "solve", CORNELL_BOX, "-o", temporary("never.vtp"), "--method", method, "--element-size", "1e-6",
          "--progress", "none")
assert not os.path.exists(temporary("never.vtp"))
assert "reference" in run("solve", "--help").stdout
