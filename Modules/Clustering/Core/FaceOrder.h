// Faces of a mesh in another order.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// Permutes every per-face array but `surfaceId`: face i becomes what face order[i] was.
void ReorderFaces(const std::vector<int32_t>& order, TriangleMesh* mesh);

}  // namespace lambert
