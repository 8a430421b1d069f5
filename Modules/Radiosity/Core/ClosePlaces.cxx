#include "Radiosity/Core/ClosePlaces.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "Common/Core/Barycentric.h"
#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// A place lies in a triangle where every corner has at least this weight.
constexpr float kWithin = 0.02f;

/// What a triangle belongs to: its patch, or the side of its face where that is whole.
int64_t OwnerOf(int32_t patch, int32_t face, uint8_t side) {
  return patch >= 0 ? int64_t(patch) : -1 - (2 * int64_t(face) + side);
}

/// How far within a convex polygon a place lies, m; negative outside.
float DepthIn(const std::vector<Vec3f>& corners, const Vec3f& place) {
  Vec3f normal;
  for (size_t i = 2; i < corners.size(); ++i) {
    normal += Cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  float least = std::numeric_limits<float>::max();
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3f edge = corners[(i + 1) % corners.size()] - corners[i];
    const Vec3f inward = Normalize(Cross(normal, edge));
    least = std::min(least, Dot(inward, place - corners[i]));
  }
  return least;
}

}  // namespace

// Down from the patch that it lay in before.
int32_t ClosePlaces::LeafPatchAt(size_t place, const LeafMesh& leaves) const {
  const ClosePlace& close = places_[place];
  int32_t patch = patches_[place];
  if (patch < 0) patch = leaves.FindFacePatch(close.face, close.side);
  while (patch >= 0) {
    const std::vector<int32_t> parts = leaves.Parts(patch);
    if (parts.empty()) break;
    float most = std::numeric_limits<float>::lowest();
    for (const int32_t part : parts) {
      const float depth = DepthIn(leaves.Corners(part), close.position);
      if (depth > most) patch = part;
      most = std::max(most, depth);
    }
  }
  return patch;
}

std::vector<const ClosePlace*> ClosePlaces::InTriangles(const RefinedMesh& mesh,
                                                        const LeafMesh& leaves) {
  // The patches that they lie in, and the triangles of these.
  ParallelForEach(int64_t(places_.size()), 256,
                  [&](int64_t i) { patches_[size_t(i)] = this->LeafPatchAt(size_t(i), leaves); });
  const auto ownerOf = [&](size_t place) {
    const ClosePlace& close = places_[place];
    return OwnerOf(patches_[place], close.face, close.side);
  };
  std::unordered_map<int64_t, std::vector<int64_t>> trianglesOf;
  for (size_t i = 0; i < places_.size(); ++i) trianglesOf.try_emplace(ownerOf(i));
  for (size_t t = 0; t < mesh.Triangles().size(); ++t) {
    const LeafTriangle& triangle = mesh.Triangles()[t];
    const auto found = trianglesOf.find(OwnerOf(triangle.patch, triangle.face, triangle.side));
    if (found != trianglesOf.end()) found->second.push_back(int64_t(t));
  }

  // The triangle of each, and the place of each triangle.
  std::vector<int64_t> triangleOf(places_.size(), -1);
  ParallelForEach(int64_t(places_.size()), 256, [&](int64_t i) {
    for (const int64_t t : trianglesOf.at(ownerOf(size_t(i)))) {
      const auto& p = mesh.PointsOfTriangles()[size_t(t)];
      const auto at = [&](size_t corner) { return mesh.Points()[size_t(p[corner])].position; };
      const auto weights = BarycentricWeights(at(0), at(1), at(2), places_[size_t(i)].position);
      if (!weights || std::min({weights->x, weights->y, weights->z}) < kWithin) continue;
      triangleOf[size_t(i)] = t;
      return;
    }
  });
  std::vector<const ClosePlace*> placeOf(mesh.Triangles().size(), nullptr);
  for (size_t i = 0; i < places_.size(); ++i) {
    if (triangleOf[i] < 0) continue;
    const ClosePlace*& most = placeOf[size_t(triangleOf[i])];
    if (!most || places_[i].cover > most->cover) most = &places_[i];
  }
  return placeOf;
}

}  // namespace lambert
