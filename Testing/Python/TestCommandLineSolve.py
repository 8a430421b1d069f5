"""`lambert solve`: files, report and readings agree with each other."""
import csv
import json
import os
import pty
import shutil
import signal
import subprocess

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from CommandLine import CORNELL_BOX, LAMBERT, solve, temporary

# One run with everything but a picture.
out, probes, readings = temporary("box.vtp"), temporary("box-probes.csv"), temporary("box-readings.csv")
report = solve(CORNELL_BOX, "-o", out, "--error", "0.3", "--iterations", "2")
assert report["stopped_by"] in ("iterations", "error", "floor") and report["iterations"] <= 2
assert len(report["history"]) == report["iterations"]
assert report["elements"]["total"] > 0 and report["links"]["total"] > 0 and report["rays"] > 0
assert report["peak_memory_bytes"] > 1e6 and report["seconds"]["total"] >= report["seconds"]["solve"]
for key in ("load", "cluster", "solve", "reconstruct", "write"):
    assert report["seconds"][key] >= 0

# What is emitted is absorbed or escapes, per band. The balance is kept by the exchange of links, whose rows sum to one
# up to the visibility sampling; 5 % is far above that and far below a lost bounce.
whole = solve(CORNELL_BOX, "-o", out, "--error", "0.2")
assert whole["stopped_by"] in ("error", "floor")
energy = whole["energy_w"]
for emitted, absorbed, escaped in zip(energy["emitted"], energy["absorbed"], energy["escaped"]):
    assert emitted > 0 and abs(absorbed + escaped - emitted) < 0.05 * emitted, energy

# A request that is met ends the run, even where the clock would have let no further iteration begin. The solver says "error"
# from nine tenths of the request on.
for share in (1.2, 1.5, 2.0, 3.0):
    timed = solve(CORNELL_BOX, "-o", out, "--error", "0.2", "--time", share * whole["seconds"]["total"])
    error = timed["history"][-1]["error"]
    assert timed["stopped_by"] in ("error", "floor", "time"), timed["stopped_by"]
    if error is not None and error <= 0.9 * 0.2:
        assert timed["stopped_by"] == "error", (share, timed["stopped_by"], error)

# Without final gather every iteration refines links, and the request is verified and met by what they bring.
by_links = solve(CORNELL_BOX, "-o", out, "--error", "0.2", "--no-final-gather")
assert by_links["method"]["final_gather"] is False and by_links["stopped_by"] == "error"
thresholds = [entry["threshold"] for entry in by_links["history"]]
assert all(later < earlier for earlier, later in zip(thresholds, thresholds[1:])), thresholds
assert 0 < by_links["history"][-1]["error"] <= 0.2 and by_links["rays"] < whole["rays"]

# Other oracles, schedules and refinements make other links and triangles of it, and are named.
chosen = {"oracle": "bfa", "schedule": "interleaved", "refinement": "quadtree"}
other = solve(CORNELL_BOX, "-o", out, "--error", "0.3", "--no-final-gather", "--iterations", "3", "--snap-tolerance", "0.3",
              *(word for name, value in chosen.items() for word in ("--" + name, value)))
assert chosen.items() <= other["method"].items() and other["links"] != by_links["links"], other["method"]

# A coarser run is cheaper; the files below are of two iterations.
report = solve(CORNELL_BOX, "-o", out, "--error", "0.3", "--iterations", "2")
assert report["links"]["total"] < whole["links"]["total"]

# The file holds what the report says, and the contract's arrays.
reader = vtkXMLPolyDataReader()
reader.SetFileName(out)
reader.Update()
mesh = reader.GetOutput()
assert mesh.GetNumberOfCells() == report["output"]["triangles"]
points, cells = mesh.GetPointData(), mesh.GetCellData()
irradiance = vtk_to_numpy(points.GetArray("Irradiance"))
radiosity = vtk_to_numpy(points.GetArray("Radiosity"))
assert irradiance.shape == (mesh.GetNumberOfPoints(), 3) and np.isfinite(irradiance).all()
assert irradiance.min() >= 0 and irradiance.max() > 0
for name in ("Reflectance", "Emittance", "InputFaceId", "Side", "MaterialId", "PartId", "SourceCellId"):
    assert cells.HasArray(name), name
assert mesh.GetPointData().GetNormals() is not None
for name in ("Material.Name", "Part.Name", "Part.Source"):  # The rows that the cells name.
    assert mesh.GetFieldData().GetAbstractArray(name).GetNumberOfValues() > 0, name

# The same iterations give the same bits, whatever the threads.
for threads in (1, 3):
    again = temporary("box-again.vtp")
    solve(CORNELL_BOX, "-o", again, "--error", "0.3", "--iterations", "2", "--threads", threads)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(again)
    reader.Update()
    assert np.array_equal(vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("Irradiance")), irradiance)

# PLY: the brighter side of every face, irradiance and colours; both sides where asked for.
counts = []
for more in ([], ["--both-sides"]):
    ply = temporary("box.ply")
    solve(CORNELL_BOX, "-o", ply, "--error", "0.3", "--iterations", "2", *more)
    reader = vtkPLYReader()
    reader.SetFileName(ply)
    reader.Update()
    lit = reader.GetOutput()
    counts.append(lit.GetNumberOfCells())
    colors = vtk_to_numpy(lit.GetPointData().GetArray("RGB"))
    assert lit.GetPointData().GetNormals() is not None and colors.max() > 100
    with open(ply, "rb") as file:
        header = file.read(600).split(b"end_header")[0]
    assert b"property float irradiance_r" in header
assert counts[0] <= counts[1] == report["output"]["triangles"]

# Both sides are the whole solution: position, normal and irradiance of each corner are the floats of the VTP file.
solve(CORNELL_BOX, "-o", out, "--error", "0.3", "--iterations", "2")
reader = vtkXMLPolyDataReader()
reader.SetFileName(out)
reader.Update()
solved = reader.GetOutput()
with open(ply, "rb") as file:
    data = file.read()
body = data[data.index(b"end_header\n") + len(b"end_header\n"):]
vertex = np.dtype([("place", "<f4", 3), ("normal", "<f4", 3), ("code", "u1", 3), ("irradiance", "<f4", 3)])
vertices = np.frombuffer(body, vertex, lit.GetNumberOfPoints())
faces = np.frombuffer(body, np.dtype([("count", "u1"), ("corners", "<i4", 3)]), counts[1], vertices.nbytes)["corners"]
corners = vtk_to_numpy(solved.GetPolys().GetConnectivityArray()).reshape(-1, 3)
for field, array in (("place", solved.GetPoints().GetData()), ("normal", solved.GetPointData().GetNormals()),
                     ("irradiance", solved.GetPointData().GetArray("Irradiance"))):
    assert np.array_equal(vertices[field][faces], vtk_to_numpy(array)[corners]), field

# A probe on a surface reads what the file delivers there: corner, middle and normal of a triangle.
triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
xyz = vtk_to_numpy(mesh.GetPoints().GetData())
corners = xyz[triangles]
normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
largest = np.linalg.norm(normals, axis=1).argsort()[-20:]
with open(probes, "w") as file:
    file.write("x,y,z,nx,ny,nz\n")
    for face in largest:
        file.write(",".join(repr(float(v)) for v in (*corners[face].mean(axis=0), *normals[face])) + "\n")
solve(CORNELL_BOX, "-o", out, "--error", "0.3", "--iterations", "2", "--probe", probes, "--probe-output", readings)
with open(readings) as file:
    rows = list(csv.DictReader(file))
assert list(rows[0]) == "x,y,z,nx,ny,nz,r,g,b,kind".split(",") and len(rows) == len(largest)
for row, face in zip(rows, largest):
    assert row["kind"] == "surface", row
    expected = irradiance[triangles[face]].mean(axis=0)
    measured = np.array([float(row[band]) for band in "rgb"])
    # Barycentrics in float of a point rounded to float: 1e-3 of the brightest is far above either.
    assert np.allclose(measured, expected, rtol=1e-3, atol=1e-3 * irradiance.max()), (measured, expected)

# Where the error sits: the measured points, whose parts of its square sum to 1, the largest first.
verified = temporary("verified.csv")
error = solve(CORNELL_BOX, "-o", out, "--error", "0.3", "--verify", "500", "--verify-output", verified)["error"]
with open(verified) as file:
    rows = list(csv.DictReader(file))
assert list(rows[0]) == ("x,y,z,nx,ny,nz,face,side,r,g,b,reference_r,reference_g,reference_b,"
                         "standard_error,part").split(","), rows[0]
parts = [float(row["part"]) for row in rows]
assert len(rows) == error["points"] and parts == sorted(parts, reverse=True) and abs(sum(parts) - 1) < 1e-4, parts[:9]
delivered, reference = (sum(float(row[name + band]) for row in rows for band in "rgb") for name in ("", "reference_"))
assert abs((delivered - reference) / reference - error["bias"]) < 1e-4, (delivered, reference, error)

# A spreadsheet's CSV: a byte order mark and its ends of lines. High in mid-air facing up, outside, and facing nothing.
with open(probes, "wb") as file:
    file.write(b"\xef\xbb\xbfx,y,z,nx,ny,nz\r\n0.278,0.3,0.279,0,9,0\r\n9,9,9,0,1,0\r\n")
solve(CORNELL_BOX, "-o", out, "--error", "0.3", "--probe", probes, "--probe-output", readings)
with open(readings) as file:
    rows = list(csv.DictReader(file))
assert [row["kind"] for row in rows] == ["space", "space"] and float(rows[0]["r"]) > 0 == float(rows[1]["r"]), rows

# File names may hold blanks, letters beyond ASCII, and bytes that are no text at all.
odd = os.path.join(os.path.dirname(out), "R\u00e4ume und B\u00f6den")
os.makedirs(odd, exist_ok=True)
for name in ("K\u00fcche 1.vtp", os.fsdecode(b"no\xfftext.vtp")):
    target, account = os.path.join(odd, name), os.path.join(odd, "account.json")
    done = subprocess.run([LAMBERT, "solve", CORNELL_BOX, os.path.join(odd, "..", "box.ply"), "-o", target,
                           "--iterations", "1", "--report", account, "--progress", "none"], capture_output=True)
    assert done.returncode == 0 and os.path.getsize(target) > 0, done.stderr
    with open(account, encoding="utf-8") as file:
        assert len(json.load(file)["files"]) == 2  # Two scenes make one.
scene = os.path.join(odd, os.fsdecode(b"no\xfftext.obj"))
shutil.copy(CORNELL_BOX, scene)
shutil.copy(CORNELL_BOX[:-3] + "mtl", odd)
done = subprocess.run([LAMBERT, "info", scene, "--json"], capture_output=True)
assert done.returncode == 0 and json.loads(done.stdout)["scene"]["emitting_faces"] > 0, done.stderr

# On a terminal there is a bar, in a pipe there are lines.
master, slave = pty.openpty()
subprocess.run([LAMBERT, "solve", CORNELL_BOX, "-o", out, "--error", "0.02"], stderr=slave, stdout=subprocess.DEVNULL,
               check=True)
os.close(slave)
shown = b""
while True:
    try:
        shown += os.read(master, 65536)
    except OSError:  # The terminal is closed and read out.
        break
assert b"\r" in shown and b"#" in shown and b" %" in shown, shown
done = subprocess.run([LAMBERT, "solve", CORNELL_BOX, "-o", out, "--error", "0.2"], capture_output=True)
assert b"\r" not in done.stderr and b"iteration 1: " in done.stderr, done.stderr

# Ctrl-C keeps what is solved.
kept = temporary("kept.vtp")
report_name = temporary("kept.json")
process = subprocess.Popen([LAMBERT, "solve", CORNELL_BOX, "-o", kept, "--error", "0.001", "--progress", "plain",
                            "--report", report_name], stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
for line in process.stderr:
    if "iteration 4" in line:  # The first thresholds may be too coarse for any light to have moved.
        process.send_signal(signal.SIGINT)
        break
_, rest = process.communicate(timeout=300)
assert process.returncode == 0, rest
with open(report_name) as file:
    assert '"stopped_by": "interrupt"' in file.read()
reader = vtkXMLPolyDataReader()
reader.SetFileName(kept)
reader.Update()
assert vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("Irradiance")).max() > 0
