// What the tests of the whole solver share: scenes from Data and by seed, and solving them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Common/Core/Random.h"
#include "Common/Testing/TestScenes.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "Scene/Core/SceneCleaning.h"
#include "Scene/Core/SceneReader.h"

namespace lambert::testing {

struct SolvedScene {
  Scene scene;  ///< in the order that clustering left it in
  RadiositySolution solution;
  SolverStatistics statistics;
};

inline SolvedScene SolveScene(Scene scene, double error) {
  SolvedScene solved;
  solved.scene = std::move(scene);
  solved.scene.mesh.Complete();
  const ClusterTree tree = ClusterFaces(&solved.scene.mesh, solved.scene.parts);
  HierarchicalRadiosityOptions options;
  options.error = error;
  HierarchicalRadiosity solver(solved.scene, tree, options);
  solver.Run();
  solved.solution = solver.Solution();
  solved.statistics = solver.Statistics();
  return solved;
}

/// A scene whose faces are clustered, with both sides of every surface modelled.
struct ModelledScene {
  Scene scene;
  ClusterTree tree;
  std::vector<uint8_t> lit;
  std::optional<RayScene> rayScene;
  std::optional<ElementHierarchy> hierarchy;

  /// Once `scene` is whole.
  void Model() {
    CompleteTables(&scene);
    scene.mesh.Complete();
    tree = ClusterFaces(&scene.mesh, scene.parts);
    rayScene.emplace(scene.mesh);
    lit.assign(tree.surfaceRoots.size(), 3);
    hierarchy.emplace(scene, tree, lit, LeafMeshOptions());
  }
};

/// A scene of Data/, cleaned as a user gets it: "CornellBox" is Data/CornellBox/CornellBox.obj.
inline Scene DataScene(const std::string& name) {
  const std::string folder = std::string(LAMBERT_DATA_DIR) + "/" + name;
  return AssembleScene(ReadScene({folder + "/" + name + ".obj"}));
}

/// Adds an empty room [0, size]^3 of reflectance `rho` with a black square lamp of exitance
/// `exitance` (W/m2) under the middle of its ceiling. Material ids 0 to 6.
inline void AddLitRoom(TriangleMesh* mesh, float size, float rho, float exitance) {
  AddBox(mesh, {0, 0, 0}, {size, size, size}, BoxMaterials(rho), true);
  const float a = 0.4f * size, b = 0.2f * size;
  AddQuad(mesh, {a, a, 0.98f * size}, {0, b, 0}, {b, 0, 0}, Spectrum(0.f), Spectrum(exitance), 1,
          6);
}

inline Vec3f RandomVector(Random* random) {
  const float x = random->Uniform(), y = random->Uniform();
  return {x, y, random->Uniform()};
}

}  // namespace lambert::testing
