"""What is installed works by itself: the program, the Python package, and find_package(Lambert)."""
import os
import shutil
import subprocess
import sys

from CommandLine import CORNELL_BOX, LAMBERT, temporary

build = os.path.dirname(os.path.dirname(LAMBERT))
prefix = temporary("prefix")
shutil.rmtree(prefix, ignore_errors=True)
os.makedirs(prefix)
subprocess.run(["cmake", "--install", build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)


def found(name):
    return next(os.path.join(folder, name) for folder, folders, files in os.walk(prefix) if name in folders + files)


# The program, and the package of the same interpreter.
environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "LD_LIBRARY_PATH")}
program = os.path.join(prefix, "bin", "lambert")
out = temporary("installed.vtp")
subprocess.run([program, "solve", CORNELL_BOX, "-o", out, "--error", "0.3", "--progress", "none"], check=True,
               env=environment, stdout=subprocess.DEVNULL)
assert os.path.getsize(out) > 0
environment["PYTHONPATH"] = found("site-packages")
subprocess.run([sys.executable, "-c", "import lambert, sys; lambert.vtkHierarchicalRadiosity();"
                f"sys.exit(not lambert.__file__.startswith({prefix!r}))"], check=True, env=environment)

# A program of someone else's, on a core and on shells.
consumer = os.path.join(os.path.dirname(prefix), "consumer")
shutil.rmtree(consumer, ignore_errors=True)
os.makedirs(consumer)
with open(os.path.join(consumer, "CMakeLists.txt"), "w") as file:
    file.write("""cmake_minimum_required(VERSION 3.25)
project(Consumer CXX)
find_package(Lambert REQUIRED)
add_executable(consumer main.cxx)
target_link_libraries(consumer PRIVATE Lambert::RadiosityCore Lambert::Scene)
""")
with open(os.path.join(consumer, "main.cxx"), "w") as file:
    file.write("""#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRadiositySceneReader.h>
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "Scene/vtkSceneAdapter.h"
int main(int, char** files) {
  vtkNew<vtkRadiositySceneReader> reader;
  reader->SetFileName(files[1]);
  reader->Update();
  lambert::Scene scene = lambert::SceneFromPolyData(reader->GetOutput());
  const lambert::ClusterTree tree = lambert::ClusterFaces(&scene.mesh, scene.parts);
  lambert::HierarchicalRadiosityOptions options;
  options.iterations = 1;
  lambert::HierarchicalRadiosity solver(scene, tree, options);
  solver.Run();
  return solver.Solution().mesh.FaceCount() > 0 ? 0 : 1;
}
""")
folder = os.path.join(consumer, "build")
subprocess.run(["cmake", "-S", consumer, "-B", folder, "-G", "Ninja", "-DCMAKE_PREFIX_PATH=" + prefix], check=True,
               stdout=subprocess.DEVNULL)
subprocess.run(["cmake", "--build", folder], check=True, stdout=subprocess.DEVNULL)
subprocess.run([os.path.join(folder, "consumer"), CORNELL_BOX], check=True)
