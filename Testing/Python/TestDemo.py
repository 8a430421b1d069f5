"""`Utilities/demo` runs through: its own scene and another, whatever view is asked for."""
import os
import stat
import subprocess

from CommandLine import CORNELL_BOX, LAMBERT, temporary

# What it runs, as it runs it, but for the time that it takes.
shortened = temporary("bin")
os.mkdir(shortened)
program = os.path.join(shortened, "lambert")
with open(program, "w") as file:
    file.write(f'#!/bin/sh\nexec "{LAMBERT}" "$@" --iterations 1 --no-final-gather --progress none\n')
os.chmod(program, stat.S_IRWXU)


def demo(*arguments):
    """Insists on success; the names of what it leaves."""
    folder = temporary("demo output")
    done = subprocess.run([os.path.join(os.environ["LAMBERT_SOURCE_DIR"], "Utilities", "demo"), *arguments], capture_output=True,
                          text=True, env={**os.environ, "LAMBERT_BIN_DIR": shortened, "DEMO_OUTPUT": folder})
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("demo: lighting"), done.stdout  # Nothing was installed or built.
    return set(os.listdir(folder))


assert demo() == {"DefaultScene.png", "DefaultScene.vtp", "DefaultScene.ply", "report.json"}
for options in ([], ["--error", "0.3", "--camera", "0.275,0.275,-0.8,0.275,0.275,0", "--size=320x240", "--tone", "local"],
                ["--size", "160x120", "--camera=0.275,0.275,-0.8,0.275,0.275,0", "--sky", "1", "1", "1", "--false-colors", "lux",
                 "--range", "0", "800", "--steps=4", "--isolines"]):
    assert demo(CORNELL_BOX, *options) == {"CornellBox.png", "CornellBox.vtp", "CornellBox.ply", "report.json"}

# What is refused ends it.
done = subprocess.run([os.path.join(os.environ["LAMBERT_SOURCE_DIR"], "Utilities", "demo"), CORNELL_BOX, "--no-such-option"],
                      capture_output=True, text=True,
                      env={**os.environ, "LAMBERT_BIN_DIR": shortened, "DEMO_OUTPUT": temporary("refused")})
assert done.returncode == 2 and "--no-such-option" in done.stderr, (done.returncode, done.stderr)
print("demo: passed")
