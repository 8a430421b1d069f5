"""`lambert solve --simplify`: fewer triangles, the account of it, and the error before and after."""
import os

from CommandLine import CORNELL_BOX, fails, solve, temporary

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

for wrong in ("0", "1.5", "much"):
    fails(2, "solve", *rough, "--simplify", wrong, says=["--simplify"])
