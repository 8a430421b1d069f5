"""`lambert solve --simplify`: fewer triangles, the account of it, and the error before and after."""
import os

import numpy as np
from CommandLine import CORNELL_BOX, fails, solve, temporary, write_png
from GltfModel import GltfModel
from PolyDataFile import mesh_of

out = temporary("box.vtp")
rough = [CORNELL_BOX, "-o", out, "--error", "0.1", "--no-final-gather", "--iterations", "4"]
whole = solve(*rough)
assert "simplification" not in whole
report = solve(*rough, "--simplify", "0.05", "--verify", "200")
made = report["simplification"]
assert made["triangles_before"] == whole["output"]["triangles"] and made["points_before"] == whole["output"]["points"]
assert made["triangles_after"] == report["output"]["triangles"] < made["triangles_before"]
assert made["points_after"] == report["output"]["points"] < made["points_before"]
assert report["seconds"]["simplify"] > 0 and os.path.getsize(out) > 0
# Bounded errors add up at most; both are measured at the same places.
assert report["error"]["bounded"] <= made["error_before"]["bounded"] + 0.05

# For viewers, too; not measured, there is no error.
model = solve(*rough[:1], "-o", temporary("box.glb"), *rough[3:], "--simplify", "0.05")
assert model["output"] == report["output"] and "error_before" not in model["simplification"]

# So is what lies beside a light map that shows both sides of a sheet: a floor that keeps its texture under an upright sheet.
write_png(temporary("floor.png"), np.full((8, 8, 3), 200))
scene, light_map = temporary("sheet.obj"), temporary("map.vtp")
with open(temporary("sheet.mtl"), "w") as file:
    file.write("newmtl floor\nKd .8 .8 .8\nmap_Kd floor.png\nnewmtl sheet\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 30 30 30\n")
with open(scene, "w") as file:
    file.write("mtllib sheet.mtl\nv 0 0 0\nv 0 0 2\nv 2 0 2\nv 2 0 0\nvt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\nusemtl floor\nf 1/1 2/2 3/3 4/4\n"
               "v 1 .5 .5\nv 1 .5 1.5\nv 1 1 1.5\nv 1 1 .5\nusemtl sheet\nf 5 6 7 8\n"
               "v .7 1.9 .7\nv 1.3 1.9 .7\nv 1.3 1.9 1.3\nv .7 1.9 1.3\nusemtl lamp\nf 9 10 11 12\n")
floors, glb = [], temporary("sheet.glb")
for options in ((), ("--simplify", "0.1")):
    solve(scene, "-o", glb, "--error", "0.1", "--lightmap", light_map, "--page-size", "64", "--keep-textures", *options)
    assert mesh_of(light_map).GetCellData().HasArray("Side")
    floors += [len(triangles) for _, triangles, material in GltfModel(glb).primitives() if material["name"] == "floor"]
assert 2 < floors[1] < 0.9 * floors[0], floors

for wrong in ("0", "1.5", "much"):
    fails(2, "solve", *rough, "--simplify", wrong, says=["--simplify"])
