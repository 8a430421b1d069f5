#include "Scene/Core/SceneCleaning.h"

#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Scene/Core/FacingEmitters.h"
#include "Scene/Core/InvertedEmitters.h"
#include "Scene/Core/MeshRepair.h"
#include "Scene/Core/PointNormals.h"
#include "Scene/Core/SceneLimits.h"
#include "Scene/Core/ScenePlacement.h"

namespace lambert {

namespace {

void CheckEmission(const TriangleMesh& mesh, const std::vector<Material>& materials) {
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    const Spectrum& e = mesh.emittance[face];
    if (e.IsFinite() && std::min({e.r, e.g, e.b}) >= 0) continue;
    throw Error("The material '" + materials[size_t(mesh.materialId[face])].name +
                "' has an emission that is negative or not a finite number; repair the file or set "
                "another.");
  }
}

void CheckAssembly(SceneAssembly* assembly, const CleaningOptions& options) {
  if (!(options.featureAngle >= 0 && options.featureAngle <= 180)) {
    throw Error("The feature angle is " + std::to_string(options.featureAngle) +
                " degrees; it must lie in [0, 180].");
  }
  if (assembly->materials.empty()) assembly->materials.emplace_back();
  for (const Part& part : assembly->parts) {
    if (part.meshId < 0 || size_t(part.meshId) >= assembly->meshes.size()) {
      throw Error("The part '" + part.name + "' names mesh " + std::to_string(part.meshId) +
                  ", which the scene does not have.");
    }
    for (const double entry : part.objectToWorld) {
      if (!std::isfinite(entry)) {
        throw Error("The matrix of the part '" + part.name +
                    "' has an entry that is not a finite number; repair the input.");
      }
    }
  }
  for (TriangleMesh& mesh : assembly->meshes) {
    if (mesh.FaceCount() > std::numeric_limits<int32_t>::max() / 3) {
      throw Error("A mesh has more than 2^31 / 3 triangles; split it.");
    }
    mesh.Complete();
    for (const int32_t material : mesh.materialId) {
      if (material < 0 || size_t(material) >= assembly->materials.size()) {
        throw Error("A face names material " + std::to_string(material) +
                    ", which the scene does not have.");
      }
    }
    CheckEmission(mesh, assembly->materials);
  }
  RequireSolvableLights(assembly->lights);
}

/// All steps of one mesh, in object space.
CleanedMesh CleanMesh(TriangleMesh mesh, const CleaningOptions& options, CleaningReport* report) {
  if (options.weld) {
    const WeldCounts weld = WeldPoints(&mesh);
    report->pointsWelded = weld.welded;
    report->pointsUnused = weld.unused;
  }
  if (options.removeZeroArea) report->zeroAreaTriangles = RemoveZeroAreaFaces(&mesh);
  if (options.removeRepeated) {
    const RepeatCounts repeats = RemoveRepeatedFaces(&mesh);
    report->repeatedTriangles = repeats.removed;
    report->repeatedOtherMaterial = repeats.otherMaterial;
  }
  report->pointsUnused += RemoveUnusedPoints(&mesh);

  CleanedMesh cleaned;
  cleaned.topology = ConnectFaces(mesh);
  report->openEdges = cleaned.topology.openEdges;
  report->nonManifoldEdges = cleaned.topology.nonManifoldEdges;
  report->nonOrientablePieces = cleaned.topology.nonOrientablePieces;
  if (options.orient) report->facesRewound = RewindFaces(&mesh, &cleaned.topology);

  const PointNormalCounts normals =
      CompletePointNormals(options.featureAngle, &mesh, &cleaned.topology);
  report->normalsMade = normals.made;
  report->normalsRepaired = normals.repaired;
  cleaned.mesh = std::move(mesh);
  return cleaned;
}

/// Meshes that a part shows; the others are empty.
std::vector<CleanedMesh> CleanMeshes(SceneAssembly* assembly, const CleaningOptions& options,
                                     CleaningReport* report) {
  std::vector<uint8_t> shown(assembly->meshes.size(), 0);
  for (const Part& part : assembly->parts) shown[size_t(part.meshId)] = 1;
  std::vector<CleanedMesh> cleaned(shown.size());
  std::vector<CleaningReport> reports(shown.size());
  ParallelForEach(int64_t(shown.size()), 1, [&](int64_t i) {
    TriangleMesh mesh = std::move(assembly->meshes[size_t(i)]);
    if (shown[size_t(i)])
      cleaned[size_t(i)] = CleanMesh(std::move(mesh), options, &reports[size_t(i)]);
  });
  for (const CleaningReport& one : reports) {
    for (const auto count : {&CleaningReport::pointsWelded, &CleaningReport::pointsUnused,
                             &CleaningReport::zeroAreaTriangles, &CleaningReport::repeatedTriangles,
                             &CleaningReport::repeatedOtherMaterial, &CleaningReport::facesRewound,
                             &CleaningReport::nonOrientablePieces,
                             &CleaningReport::nonManifoldEdges, &CleaningReport::openEdges,
                             &CleaningReport::normalsMade, &CleaningReport::normalsRepaired}) {
      report->*count += one.*count;
    }
  }
  return cleaned;
}

/// Counts the lamps of each material that were turned, and names it.
void ReportTurned(const std::vector<int64_t>& turned, const char* what, const char* why,
                  const Scene& scene, CleaningReport* report) {
  for (size_t material = 0; material < turned.size(); ++material) {
    if (turned[material] == 0) continue;
    report->invertedEmitters += turned[material];
    report->warnings.push_back(std::to_string(turned[material]) + what + " of material '" +
                               scene.materials[material].name + why);
  }
}

void TurnEmitters(const std::vector<CleanedMesh>& meshes, const PartRanges& ranges, Scene* scene,
                  CleaningReport* report) {
  ReportTurned(TurnInvertedEmitters(meshes, ranges, scene), " closed emitting piece(s)",
               "' shone inward with nothing inside and were taken as inverted; they shine outward "
               "now.",
               *scene, report);
  ReportTurned(TurnFacingEmitters(meshes, ranges, scene), " emitting piece(s)",
               "' shone at nothing but a surface at no distance and were taken as inverted; they "
               "shine from their other side now.",
               *scene, report);
}

/// What placing has flattened: far from the origin, or through a matrix that squashes.
void RemoveFlattenedFaces(const CleaningOptions& options, TriangleMesh* world,
                          CleaningReport* report) {
  if (options.removeZeroArea) {
    const int64_t flattened = RemoveZeroAreaFaces(world);
    if (flattened > 0) {
      report->zeroAreaTriangles += flattened;
      RemoveUnusedPoints(world);
    }
  }
  for (int64_t face = 0; face < world->FaceCount(); ++face) {
    if (!HasNoArea(world->Corner(face, 0), world->Corner(face, 1), world->Corner(face, 2))) return;
  }
  throw Error("The scene has no triangle with an area; there is nothing to light.");
}

void WarnOfSize(const Scene& scene, CleaningReport* report) {
  const Box3f bounds = scene.mesh.Bounds();
  const double diagonal = bounds.Diagonal();
  bool hasIntensity = false;
  for (const Light& light : scene.lights) {
    hasIntensity |= light.IsPlaced();
  }
  if (hasIntensity && (diagonal > 1000 || diagonal < 0.01)) {
    report->warnings.push_back(
        "The scene measures " + std::to_string(diagonal) +
        " m across and has a light given by its intensity; check the length unit.");
  }
  // Beyond this, a float coordinate steps by more than the offset at which rays start (1e-5 of the
  // diagonal).
  if (Length(bounds.Center()) > 100 * diagonal) {
    report->warnings.push_back(
        "The scene lies more than 100 times its size from the origin; its coordinates lose "
        "precision there: move it nearer.");
  }
}

}  // namespace

Scene AssembleScene(SceneAssembly assembly, const CleaningOptions& options, CleaningReport* report,
                    const ProgressCallback& progress) {
  CleaningReport ownReport;
  if (!report) report = &ownReport;
  *report = {};
  const auto step = [&](double fraction, const char* stage) {
    if (!Report(progress, fraction, stage)) throw Cancelled();
  };

  // Clean each mesh once, in object space.
  step(0, "Cleaning");
  CheckAssembly(&assembly, options);
  std::vector<CleanedMesh> meshes = CleanMeshes(&assembly, options, report);

  // Place its instances in the world.
  step(0.7, "Placing");
  Scene scene;
  scene.materials = std::move(assembly.materials);
  scene.parts = std::move(assembly.parts);
  scene.lights = std::move(assembly.lights);
  scene.camera = assembly.camera;
  const PartRanges ranges = RangesOfParts(meshes, scene.parts);
  scene.mesh = PlaceParts(scene.parts, ranges, &meshes);

  // What can only be told in the world.
  step(0.9, "Placing");
  if (options.fixEmitters) TurnEmitters(meshes, ranges, &scene, report);
  RemoveFlattenedFaces(options, &scene.mesh, report);
  WarnOfSize(scene, report);
  report->triangles = scene.mesh.FaceCount();
  report->points = scene.mesh.PointCount();
  report->pieces = ranges.pieceBegin.back();
  step(1, "Placing");
  return scene;
}

}  // namespace lambert
