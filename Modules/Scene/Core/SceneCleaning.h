// Clean-up of real CAD data, and the one world-space mesh that comes of it. Every step can be left
// out; every change is counted.
#pragma once

#include "Common/Core/Progress.h"
#include "Scene/Core/SceneAssembly.h"

namespace lambert {

struct CleaningOptions {
  bool weld = true;            ///< join points of a part where position, normal and uv agree
  bool removeZeroArea = true;  ///< drop triangles without area
  bool removeRepeated =
      true;  ///< drop triangles that repeat another of the part, in either winding
  bool orient =
      true;  ///< wind connected pieces consistently (kRewound records it; emission keeps its side)
  bool fixEmitters = true;   ///< turn closed emitting pieces that are wound inward with nothing
                             ///< inside them, and lamps that face a surface at no distance
  double featureAngle = 30;  ///< degrees; normals are made within it where the file has none
};

/// What was changed. The counts of each step are of the meshes: a mesh counts once, however many
/// parts show it.
struct CleaningReport {
  int64_t pointsWelded = 0;
  int64_t pointsUnused = 0;  ///< of no face, left out
  int64_t zeroAreaTriangles = 0;
  int64_t repeatedTriangles = 0;
  int64_t repeatedOtherMaterial = 0;  ///< of these, with another material than the copy that stayed
  int64_t facesRewound = 0;
  int64_t nonOrientablePieces = 0;
  int64_t nonManifoldEdges = 0, openEdges = 0;
  int64_t normalsMade = 0;      ///< points that had none
  int64_t normalsRepaired = 0;  ///< points whose normal was zero or not finite
  // Of the cleaned scene, instances counted each.
  int64_t invertedEmitters = 0;  ///< emitting pieces that were turned (once a material of theirs)
  int64_t triangles = 0, points = 0, pieces = 0;
  std::vector<std::string> warnings;
};

/// Cleans each mesh once, in object space, then places its parts in the world. Points of the result
/// have normals. Throws Error for a scene without a triangle that has area, Cancelled.
Scene AssembleScene(SceneAssembly assembly, const CleaningOptions& options = {},
                    CleaningReport* report = nullptr, const ProgressCallback& progress = {});

}  // namespace lambert
