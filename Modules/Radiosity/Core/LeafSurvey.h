// What rays between leaves tell before any light is gathered: where leaves are seen, and which
// places lie close to something.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Radiosity/Core/ClosePlaces.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/LeafBalance.h"
#include "Radiosity/Core/LeafLookup.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

struct LeafSurvey {
  /// By element, a place for each of its samples, m: one of those nearest to it at which rays from
  /// afar met the leaf, drawn among them; the sample itself where none did, and on what is not
  /// flat.
  std::vector<std::array<Vec3f, kSamplesPerElement>> places;
  std::vector<ClosePlace> close;  ///< at most one a sample, of what lies closest to it
};

/// Casts a part of the rays that `rows` has room for. Adds those cast to `cast`. The same for any
/// number of threads.
LeafSurvey SurveyLeaves(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                        const LeafRows& rows, const LeafLookup& leaves, uint64_t seed,
                        int64_t* cast);

}  // namespace lambert
