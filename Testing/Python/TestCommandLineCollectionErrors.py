"""Damaged `.vtpc` files, and outputs that cannot be written: one sentence each, and what was there stays."""
import os
import resource
import shutil
import signal
import subprocess

from Collections import pieces_of
from CommandLine import CORNELL_BOX, LAMBERT, fails, run, temporary
from PolyDataFile import mesh_of
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

directory = os.path.dirname(temporary("any"))
box, folder = temporary("box.vtpc"), temporary("box")
quiet = "--progress", "none"
quick = "--iterations", "1", *quiet


def write_box():
    for left in ("box", "box.vtpc.part"):  # Of a run that failed.
        temporary(left)
    assert run("solve", CORNELL_BOX, "-o", box, *quick).returncode == 0


def index(*sets):
    """A collection of pieces by their files."""
    partitions = "".join(f'<Partitions index="{i}" name="n{i}"><DataSet index="0" file="{file}"/></Partitions>'
                         for i, file in enumerate(sets))
    return ('<VTKFile type="vtkPartitionedDataSetCollection" version="1.0"><vtkPartitionedDataSetCollection>' + partitions +
            "</vtkPartitionedDataSetCollection></VTKFile>")


def read_fails(text, *says):
    path = temporary("bad.vtpc")
    with open(path, "wb") as file:
        file.write(text if isinstance(text, bytes) else text.encode())
    for command in (["info", path], ["atlas", path, "-o", temporary("never.vtp"), *quiet]):
        fails(1, *command, says=["bad.vtpc", *says])
    assert not os.path.exists(os.path.join(directory, "never.vtp"))


# No collection, or half of one.
write_box()
with open(box, "rb") as file:
    whole = file.read()
piece = os.path.join("box", "box-0-0.vtp")
assert run("info", box).returncode == 0
for text in (b"", b"no xml", b"\0\xff\xfe", whole[:len(whole) // 2], b"<VTKFile/>", b"<VTKFile type='PolyData'/>",
             whole.replace(b"vtkPartitionedDataSetCollection", b"vtkMultiBlockDataSet"),
             whole.replace(b"file=", b"fill="), index(piece, "").encode(), open(os.path.join(directory, piece), "rb").read()):
    read_fails(text, "damaged")
for text in (index(), index().replace("</vtkPart", '<Partitions index="0"/></vtkPart'),
             '<VTKFile type="vtkPartitionedDataSetCollection" version="1.0"><vtkPartitionedDataSetCollection/></VTKFile>'):
    read_fails(text, "has no faces")
fails(1, "info", temporary("missing.vtpc"), says=["missing.vtpc", "cannot be opened"])
os.makedirs(temporary("folder.vtpc"))
fails(1, "info", os.path.join(directory, "folder.vtpc"), says=["folder.vtpc"])

# Pieces that are not there, are the collection itself, another kind of data, a folder, or a pipe that nobody fills.
os.makedirs(temporary("folder.vtp"))
os.mkfifo(temporary("pipe.vtp"))
for name, says in (("gone.vtp", "not there"), ("/nowhere/gone.vtp", "not there"), ("bad.vtpc", "no poly data"),
                   ("box.vtpc", "no poly data"), ("grid.vtu", "no poly data"), ("folder.vtp", "not there"),
                   ("pipe.vtp", "not there"), ("../" * 40 + "dev/zero", "no poly data")):
    read_fails(index(piece, name), "names the piece", says)

# Damaged pieces: cut, empty, of types that VTK would crash at, with ids that their tables lack.
with open(os.path.join(folder, "box-0-6.vtp"), "rb") as file:
    good = file.read()
for bad, says in ((good[:len(good) // 2], "written anew"), (b"", "written anew"), (b"no xml", "written anew"),
                  (good.replace(b"Float32", b"Float3e"), "written anew"), (good.replace(b"Int32", b"Int3x"), "written anew"),
                  (good.replace(b'"Part.Row"', b'"Part.Rox"').replace(b'"Material.Row"', b'"Part.Row"'), "the entry 6")):
    assert bad != good
    with open(os.path.join(directory, "piece.vtp"), "wb") as file:
        file.write(bad)
    read_fails(index(piece, "piece.vtp"), "piece.vtp", says)

# Nothing but pieces without faces.
faceless = mesh_of(os.path.join(directory, piece))
faceless.SetPolys(vtkCellArray())
faceless.GetCellData().Initialize()
writer = vtkXMLPolyDataWriter()
writer.SetFileName(os.path.join(directory, "piece.vtp"))
writer.SetInputData(faceless)
assert writer.Write() == 1
read_fails(index("piece.vtp"), "has no faces")

# Outputs that cannot be written are told before the scene is read.
with open(temporary("file"), "w") as file:
    file.write("own")
for arguments in (["-o", os.path.join(directory, "file.vtpc")],
                  ["-o", temporary("out.ply"), "--lightmap", os.path.join(directory, "file.vtpc")]):
    fails(1, "solve", "missing.obj", *arguments, says=["file.vtpc", "cannot be written"])
fails(1, "atlas", "missing.obj", "-o", os.path.join(directory, "file.vtpc"), says=["file.vtpc", "cannot be written"])
fails(1, "solve", "missing.obj", "-o", "/no/such/folder/file.vtpc", says=["/no/such/folder"])
fails(1, "solve", "missing.obj", "-o", "/proc/file.vtpc", says=["/proc/file.vtpc"])
os.makedirs(temporary("folder.vtpc"))
fails(1, "solve", "missing.obj", "-o", os.path.join(directory, "folder.vtpc"), says=["is a folder"])
assert open(os.path.join(directory, "file")).read() == "own"
fails(1, "solve", "missing.obj", "-o", temporary("tried.vtpc"), says=["missing.obj"])
assert not os.path.exists(os.path.join(directory, "tried")) and not os.path.exists(os.path.join(directory, "tried.vtpc"))

# Nor may they write over what is read, or over each other.
other = temporary("other.vtpc")
with open(other, "w") as file:
    file.write(index(piece))
for command in ("solve", "atlas"):
    fails(2, command, box, "-o", box, says=["write over", "SCENE"])
    fails(2, command, os.path.join(directory, piece), "-o", box, says=["write over", "SCENE"])
    fails(1, command, other, "-o", box, *quiet, says=["write over", "SCENE"])
    fails(2, command, CORNELL_BOX, "-o", box, "--report", folder, says=["write over", "--output"])
    fails(2, command, CORNELL_BOX, "-o", box, "--report", os.path.join(folder, "box-7-7.vtp"), says=["write over"])
fails(2, "solve", CORNELL_BOX, "-o", box, "--lightmap", box, says=["write over"])
fails(2, "solve", CORNELL_BOX, "-o", box, "--lightmap", box[:-4] + "VTPC", says=["write over"])
for arguments in (["solve", CORNELL_BOX, "-o", "map.stl"], ["atlas", CORNELL_BOX, "-o", "map.stl"],
                  ["solve", CORNELL_BOX, "-o", box, "--lightmap", "map.stl"]):
    fails(2, *arguments, says=[".vtp", ".vtpc"])

# A scene may lie in the folder of the pieces.
shutil.copy(CORNELL_BOX, folder)
shutil.copy(CORNELL_BOX[:-3] + "mtl", folder)
assert run("atlas", os.path.join(folder, "CornellBox.obj"), "-o", box, *quiet).returncode == 0
assert os.path.exists(os.path.join(folder, "CornellBox.obj")) and len(pieces_of(box)[0]) == 8
write_box()


# A disk that fills up in a piece, or in the list of them: the earlier result stays, whole.
def little_room():
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))


before = {name: open(os.path.join(folder, name), "rb").read() for name in os.listdir(folder)}
with open(box, "rb") as file:
    listed = file.read()
for arguments in (["solve", CORNELL_BOX, "-o", box, *quick], ["atlas", CORNELL_BOX, "-o", box, *quiet]):
    done = subprocess.run([LAMBERT, *arguments], capture_output=True, text=True, preexec_fn=little_room)
    assert done.returncode == 1 and "could not be written" in done.stderr, done.stderr
os.makedirs(box + ".part")
fails(1, "solve", CORNELL_BOX, "-o", box, *quick, says=["box.vtpc.part"])
os.rmdir(box + ".part")
with open(box, "rb") as file:
    assert file.read() == listed
assert {name: open(os.path.join(folder, name), "rb").read() for name in os.listdir(folder)} == before
os.symlink("/dev/full", temporary("full.vtpc"))
fails(1, "solve", CORNELL_BOX, "-o", os.path.join(directory, "full.vtpc"), *quick, says=["could not be written"])
assert not os.path.exists(os.path.join(directory, "full"))
os.remove(os.path.join(directory, "full.vtpc"))
