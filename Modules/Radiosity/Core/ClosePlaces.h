// Places that something lies close to. What shades them, or lets light through, is narrower than a
// triangle may be, and its corners and its middle need not tell of it.
#pragma once

#include <cstdint>
#include <vector>

#include "Radiosity/Core/LeafMesh.h"
#include "Radiosity/Core/RefinedMesh.h"

namespace lambert {

struct ClosePlace {
  int32_t face = -1;  ///< of the scene's mesh
  Side side = kFront;
  Vec3f position;   ///< m
  float cover = 0;  ///< the more, the straighter above it and the nearer that lies, (0, 1]
};

/// Finds in which triangles places lie, from cut to cut.
class ClosePlaces {
 public:
  /// By reference.
  explicit ClosePlaces(const std::vector<ClosePlace>& places)
      : places_(places), patches_(places.size(), -1) {}

  /// Per triangle of `mesh`, whose patches are those of `leaves`, the place in it that is covered
  /// most; null where none lies in it, or too near to its border to tell more than that does.
  std::vector<const ClosePlace*> InTriangles(const RefinedMesh& mesh, const LeafMesh& leaves);

 private:
  int32_t LeafPatchAt(size_t place, const LeafMesh& leaves) const;

  const std::vector<ClosePlace>& places_;
  std::vector<int32_t> patches_;  ///< that they lie in, as of the last time; -1: the face is whole
};

}  // namespace lambert
