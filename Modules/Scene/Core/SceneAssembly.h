// What readers deliver: meshes in object space, and the parts that place them in the world.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Scene/Core/Scene.h"

namespace lambert {

/// Counts of what readers met; the report is written from it.
struct ReadReport {
  std::vector<std::string> files;
  std::vector<std::string> companions;  ///< what those named and was read: libraries, buffers, images
  std::string unit;                  ///< name of the length unit that was taken, "m" where none was declared
  double metresPerUnit = 1;
  int64_t faces = 0;                 ///< as they stand in the files, polygons counted once
  int64_t polygonsTriangulated = 0;  ///< faces of more than three corners
  int64_t linesAndPointsIgnored = 0;
  int64_t materialsClamped = 0;      ///< reflectance over 0.98 in a band
  int64_t transparentMaterials = 0;  ///< their faces neither block nor reflect
  int64_t transparentFaces = 0;
  int64_t maskedMaterials = 0;       ///< alphaMode MASK
  int64_t texturesMissing = 0;
  std::vector<std::string> warnings;  ///< what was read but is not solved, one sentence each
};

/// A scene before clean-up. Meshes are in object space, in the file's own unit times metresPerUnit already applied
/// through the parts' matrices (their scale holds it). Faces keep the file's winding; `sourceCellId` is the polygon of
/// that mesh in the file. Transparent faces are left out and counted.
struct SceneAssembly {
  std::vector<TriangleMesh> meshes;  ///< complete: every per-face array filled
  std::vector<Part> parts;           ///< meshId: row of `meshes`
  std::vector<Material> materials;
  std::vector<Light> lights;         ///< world space, metres
  std::optional<Camera> camera;
  ReadReport report;
};

}  // namespace lambert
