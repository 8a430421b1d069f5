"""`lambert solve --save-state` and `--resume`: a solution goes on where it was stopped, to the same file."""
import filecmp
import os
import signal
import subprocess

from CommandLine import CORNELL_BOX, LAMBERT, fails, solve, temporary

# In one go and in two, byte for byte; the history counts on.
whole, state, resumed = temporary("whole.vtp"), temporary("box.state"), temporary("resumed.vtp")
one_go = solve(CORNELL_BOX, "-o", whole, "--iterations", "6")
solve(CORNELL_BOX, "-o", resumed, "--iterations", "3", "--save-state", state)
assert not filecmp.cmp(whole, resumed, shallow=False)
report = solve(CORNELL_BOX, "-o", resumed, "--iterations", "6", "--resume", state)
assert filecmp.cmp(whole, resumed, shallow=False)
assert report["stopped_by"] == "iterations" and report["iterations"] == 6 and report["method"]["resume"] == state
assert [entry["links"] for entry in report["history"]] == [entry["links"] for entry in one_go["history"]]
seconds = [entry["seconds"] for entry in report["history"]]
assert seconds == sorted(seconds)

# As many iterations as there are already: the file as it was then. One file may be read and written anew.
solve(CORNELL_BOX, "-o", whole, "--iterations", "3")
solve(CORNELL_BOX, "-o", resumed, "--iterations", "3", "--resume", state, "--save-state", state)
assert filecmp.cmp(whole, resumed, shallow=False)

# After Ctrl-C, wherever it came; and after a limit of time, here one that ends the run after its first iteration.
request = ["--error", "0.2", "--no-final-gather"]
solve(CORNELL_BOX, "-o", whole, *request)
by_links = [CORNELL_BOX, "-o", resumed, *request]
process = subprocess.Popen([LAMBERT, "solve", *by_links, "--progress", "plain", "--save-state", state],
                           stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
for line in process.stderr:
    if "iteration 2" in line:
        process.send_signal(signal.SIGINT)
        break
process.communicate(timeout=300)
assert process.returncode == 0
assert solve(*by_links, "--resume", state)["stopped_by"] == "error"
assert filecmp.cmp(whole, resumed, shallow=False)
assert solve(*by_links, "--time", "0.001", "--save-state", state)["stopped_by"] == "time"
assert solve(*by_links, "--resume", state)["stopped_by"] == "error"
assert filecmp.cmp(whole, resumed, shallow=False)

# Another scene, other materials, other lights; a broken file, none at all; a state of another method.
arguments = ["solve", CORNELL_BOX, "-o", resumed, "--progress", "none", "--resume", state]
fails(1, *arguments, "--set", "Red:reflectance=0.1,0.1,0.1", says=[state, "other materials", "from the beginning"])
fails(1, *arguments, "--sky", "1", "1", "1", says=[state, "other lights"])
fails(1, *arguments, "--unit", "cm", says=[state, "other geometry"])
fails(1, *arguments, "--refinement", "quadtree", says=[state, "another refinement"])
with open(state, "r+b") as file:
    file.truncate(os.path.getsize(state) - 1)
fails(1, *arguments, says=[state, "cut short"])
os.remove(state)
fails(1, *arguments, says=[state, "cannot be read"])
fails(2, *arguments, "--method", "matrix", says=["--resume"])
fails(2, "solve", CORNELL_BOX, "-o", resumed, "--save-state", resumed, says=["--save-state"])
fails(1, "solve", CORNELL_BOX, "-o", resumed, "--save-state", os.path.join(state, "no", "folder"), says=["folder"])
