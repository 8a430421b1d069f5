"""`lambert atlas` lays a scene flat, and says what it made."""
import json
import os

from CommandLine import CORNELL_BOX, fails, run, temporary

output, picture, report = temporary("atlas.vtp"), temporary("atlas.png"), temporary("atlas.json")
done = run("atlas", CORNELL_BOX, "-o", output, "--image", picture, "--report", report, "--page-size", "256")
assert done.returncode == 0, done.stderr
assert "charts" in done.stdout
told = json.load(open(report))
assert told["charts"] >= 8 and told["pages"] == 1 and told["page_size_texels"] == 256
assert 0.4 < told["utilisation"] < 1 and 1 <= told["largest_stretch"] <= 2
assert os.path.getsize(output) > 0 and open(picture, "rb").read(4) == b"\x89PNG"

# Smaller texels take more pages.
more = run("atlas", CORNELL_BOX, "-o", output, "--report", report, "--page-size", "256", "--texel-size", "0.003")
assert more.returncode == 0, more.stderr
assert json.load(open(report))["pages"] > 1

# A device that takes no byte stands for a full disk: one sentence, and no word of the PNG library.
full = temporary("full.png")
if os.path.lexists(full):
    os.remove(full)
os.symlink("/dev/full", full)
fails(1, "atlas", CORNELL_BOX, "-o", output, "--progress", "none", "--page-size", "256", "--image", full,
      says=["could not be written", "room"])
os.remove(full)

# One sentence each.
for wrong, code in (
    (["-o", temporary("atlas.obj")], 2),
    (["-o", output, "--image", temporary("atlas.jpg")], 2),
    (["-o", output, "--report", output], 2),
    (["-o", "/nowhere/atlas.vtp"], 1),
    (["-o", output, "--texel-size", "1e-7"], 1),
    (["-o", output, "--stretch", "0.5"], 2),
):
    failed = run("atlas", CORNELL_BOX, *wrong)
    assert failed.returncode == code and failed.stderr.strip(), wrong
