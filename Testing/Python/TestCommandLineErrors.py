"""Every failure has its exit code and one clear sentence, and leaves no output behind."""
import os
import shutil

import numpy as np
from CommandLine import CORNELL_BOX, DATA, fails, run, temporary, write_hdr

out = temporary("never.vtp")
bad = os.path.join(DATA, "Bad")

# Wrong usage: 2.
fails(2)
fails(2, "solve", CORNELL_BOX)
fails(2, "dance")
fails(2, "solve", CORNELL_BOX, "-o", "scene.stl", says=[".vtp", ".ply"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--error", "0")
fails(2, "solve", CORNELL_BOX, "-o", out, "--error", "two")
fails(2, "solve", CORNELL_BOX, "-o", out, "--time", "-1")
fails(2, "solve", CORNELL_BOX, "-o", out, "--iterations", "0")
fails(2, "solve", CORNELL_BOX, "-o", out, "--unit", "parsec")
fails(2, "solve", CORNELL_BOX, "-o", out, "--sky", "1", "1", "-1")
fails(2, "solve", CORNELL_BOX, "-o", out, "--image", "never.png", "--size", "100", says=["--size"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--image", "never.png", "--camera", "1,2,3", says=["--camera"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--probe", "points.csv", says=["--probe-output"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--verify-output", "points.csv", says=["--verify"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--no-such-option")
fails(2, "solve", CORNELL_BOX, "-o", out, "--progress", "0", says=["{auto,plain,none}"])
for option in ("--error", "--time", "--feature-angle", "--exposure", "--ev", "--key", "--white"):
    for number in ("nan", "inf"):
        fails(2, "solve", CORNELL_BOX, "-o", out, option, number, says=[option, number])
for option in ("--sky", "--reflectance"):
    fails(2, "solve", CORNELL_BOX, "-o", out, option, "nan", "1", "1", says=[option, "nan"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--image", "never.png", "--size", "10.5x20", says=["--size"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--image", "picture.jpg", says=[".png"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--tone", "cubist", says=["--tone"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--lightmap", temporary("map.vtp"), "--texel-density", "fine",
      says=["--texel-density", "{uniform,illumination}"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--up", "w", says=["--up"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--false-colors", "nit", says=["--false-colors"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--isolines", says=["--isolines", "--false-colors"])
picture = temporary("never.png")
fails(2, "solve", CORNELL_BOX, "-o", out, "--image", picture, "--false-colors", "lux", "--range", "5", "5",
      says=["--range"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--false-colors", "lux", says=["--image"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--probe-gather", says=["--probe"])

# Nothing is no value of an option, as of a variable in a script that was never set.
for option in ("--save-state", "--resume", "--report", "--probe", "--image", "--lightmap", "--environment", "--camera", "--error"):
    fails(2, "solve", CORNELL_BOX, "-o", out, option, "", says=[option, "empty" if option != "--error" else "not a number"])
fails(2, "solve", "", "-o", out, says=["SCENE", "empty"])
fails(2, "atlas", CORNELL_BOX, "-o", out, "--report", "", says=["--report", "empty"])
fails(2, "info", "", says=["SCENE", "empty"])

# Nor is an option taken of which no output would have anything.
for name, options, says in ((out, ["--lightmap", temporary("map.vtp"), "--keep-textures"], ["--keep-textures", "glTF"]),
                            (out, ["--lightmap", temporary("map.vtp"), "--baked-size", "512"], ["--baked-size", "glTF"]),
                            (temporary("never.ply"), ["--lightmap", temporary("map.vtp"), "--baked-size", "512"],
                             ["--baked-size"]),
                            (temporary("never.glb"), ["--lightmap", temporary("map.vtp"), "--keep-textures", "--baked-size",
                                                      "512"], ["--baked-size", "--keep-textures"]),
                            (temporary("never.glb"), ["--tone", "local"], ["--tone", "local", "--image"]),
                            (temporary("never.ply"), ["--tone", "local"], ["--tone", "local", "--image"]),
                            (out, ["--image", picture, "--false-colors", "lux", "--tone", "local"],
                             ["--tone", "--false-colors"]),
                            (out, ["--size", "64x48"], ["--size", "--image"]),
                            (out, ["--camera", "0,1,3,0,1,0"], ["--camera", "--image", "glTF"]),
                            (temporary("never.obj"), ["--camera", "0,1,3,0,1,0"], ["--camera", "--image"]),
                            (temporary("never.glb"), ["--both-sides"], ["--both-sides", "PLY"])):
    fails(2, "solve", CORNELL_BOX, "-o", name, *options, says=says)
    assert not os.path.exists(name)
map_of_pages = "--lightmap", temporary("map.vtp"), "--page-size", "64", "--page-format"
for option, value in (("--tone", "linear"), ("--tone", "photographic"), ("--key", "0.2"), ("--exposure", "1"), ("--ev", "3"),
                      ("--white", "2")):
    for others in ([], [*map_of_pages, "exr"], ["--image", picture, "--false-colors", "lux"]):
        fails(2, "solve", CORNELL_BOX, "-o", out, *others, option, value, says=[option, "PLY", "--page-format png"])

# It is where one of several outputs has: nothing but the scene is wrong then.
for name, options in ((out, ["--exposure", "1", *map_of_pages, "exr", "--page-format", "png"]),
                      (temporary("never.ply"), ["--exposure", "1", *map_of_pages, "hdr"]),
                      (temporary("never.glb"), ["--tone", "filmic", "--image", picture, "--false-colors", "lux"]),
                      (temporary("never.obj"), ["--key", "0.2"]), (temporary("never.html"), ["--camera", "0,1,3,0,1,0"])):
    fails(1, "solve", "missing.obj", "-o", name, *options, says=["missing.obj"])

# No output may write over what is read or over another output.
scene = temporary("scene.ply")
fails(2, "solve", scene, "-o", os.path.join(os.path.dirname(scene), ".", "scene.ply"), says=["write over", "SCENE"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--report", out, says=["write over", "--output"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--probe", out, "--probe-output", out, says=["write over"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--probe", out + ".part", "--probe-output", out + ".csv", says=["write over"])
fails(1, "solve", "missing.obj", "-o", out, "--probe", "missing.csv", "--probe-output", "/dev/null", "--report", "/dev/null",
      says=["missing"])
sky = temporary("sky.hdr")
fails(2, "solve", CORNELL_BOX, "-o", out, "--environment", sky, "--save-state", sky, says=["write over"])
state = temporary("state")
fails(2, "solve", CORNELL_BOX, "-o", out, "--save-state", state, "--report", state + ".part", says=["write over"])
fails(2, "solve", CORNELL_BOX, "-o", out, "--lightmap", temporary("map.vtp"), "--report", temporary("map-0.hdr"),
      says=["write over"])

# Nor over what the scene's files name, which is known once they are read.
room, library = temporary("room.obj"), temporary("room.mtl")
shutil.copyfile(os.path.splitext(CORNELL_BOX)[0] + ".mtl", library)
with open(CORNELL_BOX) as box, open(room, "w") as file:
    file.write(box.read().replace("CornellBox.mtl", "room.mtl"))
fails(1, "solve", room, "-o", out, "--report", library, "--progress", "none", says=["write over", "SCENE"])
fails(1, "atlas", room, "-o", out, "--report", library, "--progress", "none", says=["write over", "SCENE"])
assert os.path.getsize(library) == os.path.getsize(os.path.splitext(CORNELL_BOX)[0] + ".mtl")
surroundings, under_them = write_hdr(temporary("surroundings.hdr"), np.ones((2, 4, 3))), temporary("open.vtp")
assert run("solve", CORNELL_BOX, "-o", under_them, "--environment", surroundings, "--iterations", "1", "--progress",
           "none").returncode == 0
fails(1, "solve", under_them, "-o", out, "--report", surroundings, "--progress", "none", says=["write over", "SCENE"])

# Scenes that cannot be read or lit: 1.
fails(1, "solve", "missing.obj", "-o", out, says=["missing.obj"])
for name in ("empty.obj", "garbage.obj", "truncated.glb", "nan.obj", "infinite.obj", "zeroarea.obj"):
    fails(1, "solve", os.path.join(bad, name), "-o", out, "--progress", "none")
fails(1, "solve", os.path.join(bad, "nolight.obj"), "-o", out, "--progress", "none", says=["no light"])
fails(1, "solve", CORNELL_BOX, "-o", out, "--progress", "none", "--set", "NoSuchMaterial:two-sided",
      says=["NoSuchMaterial"])
fails(1, "info", "missing.obj", says=["missing.obj"])
fails(1, "info", "/dev/null", says=["/dev/null"])
fails(1, "solve", CORNELL_BOX, "-o", out, "--progress", "none", "--set", "Lamp:emission=3e38", says=["Lamp", "emission"])

# What is quoted from a file stays on one line, whatever it holds.
binary = temporary("binary.obj")
for word in (b"1\v2", b"\x1b[31m", b"1\x002"):
    with open(binary, "wb") as file:
        file.write(b"v 0 0 " + word + b"\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    fails(1, "info", binary, says=["is not a finite number in line 1"])

# Sizes whose areas single precision cannot hold.
for size in ("1e-12", "1e20"):
    far = temporary("size.obj")
    with open(far, "w") as file:
        file.write(f"v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nf 1 2 3\n")
    fails(1, "solve", far, "-o", out, "--progress", "none", "--sky", "1", "1", "1", says=["length unit"])

# A solution that was cut off.
cut = temporary("cut.vtp")
assert run("solve", CORNELL_BOX, "-o", cut, "--iterations", "1", "--progress", "none").returncode == 0
with open(cut, "r+b") as file:
    file.truncate(os.path.getsize(cut) // 2)
fails(1, "info", cut, says=[cut, "damaged"])

# Damage that VTK would print of, or crash at.
for wrong in (("Float32", "Float3e"), ('NumberOfComponents="3"', 'NumberOfComponents="2"')):
    assert run("solve", CORNELL_BOX, "-o", cut, "--iterations", "1", "--progress", "none").returncode == 0
    with open(cut, "rb") as file:
        whole = file.read()
    with open(cut, "wb") as file:
        file.write(whole.replace(wrong[0].encode(), wrong[1].encode()))
    fails(1, "info", cut)

# Outputs that cannot be written are refused before the scene is even read.
for option, ending in (("-o", "vtp"), ("--report", "json"), ("--image", "png")):
    outputs = {"-o": out, option: "/no/such/folder/file." + ending}
    fails(1, "solve", "missing.obj", *sum(([k, v] for k, v in outputs.items()), []), says=["/no/such/folder"])
# So are those whose names the others give.
for other, arguments in (("map-0.hdr", ["-o", out, "--lightmap", temporary("map.vtp")]),
                         ("model-0.png", ["-o", temporary("model.obj")]),
                         ("new.state.part", ["-o", out, "--save-state", temporary("new.state")])):
    os.makedirs(temporary(other))
    fails(1, "solve", "missing.obj", *arguments, says=[other, "cannot be written"])
    temporary(other)
folder = temporary("folder.vtp")
os.makedirs(folder, exist_ok=True)
fails(1, "solve", CORNELL_BOX, "-o", folder, says=["is a folder"])
os.rmdir(folder)

fails(1, "solve", CORNELL_BOX, "-o", "/proc/file.vtp", says=["/proc/file.vtp"])  # Even root may not.

# A device that takes no byte stands for a full disk.
for name in ("full.vtp", "full.ply"):
    full = temporary(name)
    if os.path.lexists(full):
        os.remove(full)
    os.symlink("/dev/full", full)
    fails(1, "solve", CORNELL_BOX, "-o", full, "--iterations", "1", "--progress", "none", says=["could not be written"])
    os.remove(full)

# A state that cannot be saved takes nothing else with it.
full = temporary("full.state.part")
os.symlink("/dev/full", full)
fails(1, "solve", CORNELL_BOX, "-o", out, "--iterations", "1", "--progress", "none", "--save-state", full[:-5],
      says=[full[:-5], "could not be written"])
assert os.path.exists(out)
os.remove(out)
for name in ("map-0.hdr", "map-0.png"):
    os.symlink("/dev/full", temporary(name))
    fails(1, "solve", CORNELL_BOX, "-o", out, "--iterations", "1", "--progress", "none", "--lightmap",
          temporary("map.vtp"), "--page-format", name[-3:], says=["could not be written"])
    os.remove(os.path.join(os.path.dirname(out), name))

# Probe points are checked, with the line, before solving.
probes, readings = temporary("probes.csv"), temporary("readings.csv")
for text, says in (("a,b\n", ["header"]),
                   ("x,y,z,nx,ny,nz\n0,0,0,0,1,0\n0,0,0,0,0,0\n", ["Line 3", "zero normal"]),
                   ("x,y,z,nx,ny,nz\n0,0,nan,0,1,0\n", ["Line 2", "nan"]),
                   ("x,y,z,nx,ny,nz\n0,0,1e30,0,1,0\n", ["Line 2", "beyond"]),
                   ("x,y,z,nx,ny,nz\n0,0,0,0,1\n", ["Line 2", "5 fields"])):
    with open(probes, "w") as file:
        file.write(text)
    fails(1, "solve", CORNELL_BOX, "-o", out, "--probe", probes, "--probe-output", readings, says=says)

fails(1, "solve", CORNELL_BOX, "-o", out, "--probe", bad, "--probe-output", readings, says=["cannot be read"])
fails(1, "solve", CORNELL_BOX, "-o", out, "--probe", probes + ".no", "--probe-output", readings, says=["cannot be read"])

# A picture without a display: a sentence, no abort.
without = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
fails(1, "solve", CORNELL_BOX, "-o", out, "--image", temporary("never.png"), says=["xvfb-run"], environment=without)
assert not os.path.exists(out) and not os.path.exists(readings)

# Help and version are no failures.
assert run("--version").stdout.startswith("lambert ")
for arguments in (["--help"], ["solve", "--help"], ["info", "--help"]):
    done = run(*arguments)
    assert done.returncode == 0 and "--help" in done.stdout
