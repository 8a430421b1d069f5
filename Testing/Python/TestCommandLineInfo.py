"""`lambert info` counts what is there."""
import json
import os

from CommandLine import CORNELL_BOX, run, temporary

# A box of known kind: lit, without lamps beside its faces.
done = run("info", CORNELL_BOX, "--json")
assert done.returncode == 0, done.stderr
report = json.loads(done.stdout)
scene = report["scene"]
assert scene["triangles"] > 0 and scene["emitting_faces"] > 0 and scene["materials"] > 0
assert sum(scene["emitted_by_faces_w"]) > 0
assert scene["lights"] == {"point": 0, "spot": 0, "directional": 0, "sky": 0}
low, high = scene["bounds_low_m"], scene["bounds_high_m"]
assert all(a < b for a, b in zip(low, high))

# Another unit scales the bounds, and the power with the square.
larger = json.loads(run("info", CORNELL_BOX, "--json", "--unit", "cm").stdout)["scene"]
assert abs(larger["diagonal_m"] / scene["diagonal_m"] * 100 * scene["metres_per_unit"] - 1) < 1e-4
ratio = sum(larger["emitted_by_faces_w"]) / sum(scene["emitted_by_faces_w"])
assert abs(ratio * (100 * scene["metres_per_unit"]) ** 2 - 1) < 1e-3

# Repeated triangles, in either winding, are counted, and kept where that is asked for.
doubled = temporary("doubled.obj")
with open(doubled, "w") as file:
    file.write("v 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 1 1\nf 1 2 3\nf 2 3 1\nf 3 2 1\nf 1 2 4\n")
cleaned = json.loads(run("info", doubled, "--json").stdout)
kept = json.loads(run("info", doubled, "--json", "--no-repeated").stdout)
assert cleaned["clean_up"]["repeated_triangles"] == 2 and cleaned["scene"]["triangles"] == 2
assert kept["clean_up"]["repeated_triangles"] == 0 and kept["scene"]["triangles"] == 4

# For people.
text = run("info", CORNELL_BOX).stdout
assert "triangles" in text and "emitting" in text and "material" in text

# A stray point far away makes rays skip whole walls: said.
stray = temporary("stray.obj")
with open(CORNELL_BOX) as box, open(stray, "w") as file:
    file.write(box.read().replace("mtllib ", "mtllib " + os.path.dirname(CORNELL_BOX) + "/"))
    file.write("v 1e5 0 0\nv 1e5 1 0\nv 1e5 0 1\nf -3 -2 -1\n")
assert any("strays" in warning for warning in json.loads(run("info", stray, "--json").stdout)["warnings"])
assert not any("strays" in warning for warning in report["warnings"])
