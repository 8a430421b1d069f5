// The scenes that a bench runs on: files, tessellated where they are coarse, and a shape made at
// any number of triangles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "Scene/Core/Scene.h"
#include "SceneArguments.h"

namespace lambert {

struct BenchScene {
  std::string name;
  Scene scene;                      ///< at whose vertices light is asked for
  std::optional<Scene> coarse;      ///< the scene before it was tessellated; none where it was not
  std::vector<int32_t> coarseFace;  ///< per face of `scene`: the face of `coarse` that it lies in

  /// The scene with the fewest faces, for methods that make a mesh of their own.
  const Scene& Coarsest() const { return coarse ? *coarse : scene; }
};

/// Reads and cleans a file; one of fewer than `kCoarseVertices` vertices is tessellated to about
/// `vertices` (0: left as it is). The name is the file's without folder and ending. Throws Error,
/// also for a scene without light.
BenchScene LoadBenchScene(const std::string& file, const SceneArguments& reading, int64_t vertices);
constexpr int64_t kCoarseVertices = 10000;

/// Divides every edge into equal parts of about one length for the whole scene, chosen so that
/// about `vertices` points come of it, and every face into a grid between; no T-vertices arise.
/// `source` gets, per face, the face that it lies in.
Scene TessellateRegularly(const Scene& scene, int64_t vertices, std::vector<int32_t>* source);

/// A trefoil knot of a tube with waves, about `triangles` of them, 1.6 m across, in a closed room
/// of 4 x 3 x 4 m with a lamp of 1 m2 at its ceiling. The walls are two triangles each.
Scene MakeKnotRoom(int64_t triangles);

}  // namespace lambert
