// From cleaned meshes in object space to the one mesh in world space.
#pragma once

#include "Scene/Core/MeshTopology.h"
#include "Scene/Core/SceneAssembly.h"

namespace lambert {

/// A mesh cleaned in object space, as its instances need it.
struct CleanedMesh {
  TriangleMesh mesh;
  MeshTopology topology;
};

/// Where each part's faces and pieces lie in the scene; one entry more than there are parts.
struct PartRanges {
  std::vector<int64_t> faceBegin, pointBegin, pieceBegin;
};

PartRanges RangesOfParts(const std::vector<CleanedMesh>& meshes, const std::vector<Part>& parts);

/// Places every part's mesh in the world: positions by the part's matrix, normals by its inverse
/// transpose. A matrix that mirrors swaps two corners of each face, so that a front stays the
/// front. Emittance is exitance: no scale changes it. Points carry uvs where any mesh does. Throws
/// Error where a position leaves the range of numbers or the scene has more than 2^31 / 3 faces.
/// What is placed is taken out of `meshes`, but for their triangles.
TriangleMesh PlaceParts(const std::vector<Part>& parts, const PartRanges& ranges,
                        std::vector<CleanedMesh>* meshes);

}  // namespace lambert
