"""`lambert solve --max-memory`: the process stays below, and what was solved until then is written."""
import os

from CommandLine import CORNELL_BOX, fails, solve, temporary

out = temporary("box.vtp")
by_links = [CORNELL_BOX, "-o", out, "--error", "0.01", "--no-final-gather"]

# Ceilings above what the program itself takes (some 60 MB): more memory, more iterations.
iterations, links = [], []
for megabytes in (80, 110, 140):
    report = solve(*by_links, "--max-memory", megabytes)
    assert report["stopped_by"] == "memory" and report["method"]["max_memory"] == megabytes
    assert report["peak_memory_bytes"] <= 1.1 * megabytes * 1e6, (megabytes, report["peak_memory_bytes"])
    assert os.path.getsize(out) > 0 and report["output"]["triangles"] > 0
    iterations.append(report["iterations"])
    links.append(report["links"]["total"])
assert iterations[0] < iterations[-1] and links == sorted(links), (iterations, links)

# Below what reading takes there is one iteration; a gather has to have room, too.
report = solve(*by_links, "--max-memory", "10")
assert report["stopped_by"] == "memory" and report["iterations"] == 1 and report["output"]["triangles"] > 0
report = solve(CORNELL_BOX, "-o", out, "--error", "0.3", "--max-memory", "500")
assert report["stopped_by"] == "error"

fails(2, "solve", CORNELL_BOX, "-o", out, "--max-memory", "0", says=["--max-memory"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--method", "matrix", "--max-memory", "100", says=["--max-memory"])
