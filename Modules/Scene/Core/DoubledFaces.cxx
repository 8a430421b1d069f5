#include "Scene/Core/DoubledFaces.h"

#include <algorithm>

#include "Scene/Core/FirstEqual.h"

namespace lambert {

namespace {

/// The corner of `other` that lies where corner `k` of `face` does; 3 for none.
size_t CornerAt(const TriangleMesh& mesh, int64_t other, const Vec3f& p) {
  size_t k = 0;
  while (k < 3 && !SameBits(mesh.Corner(other, int(k)), p)) ++k;
  return k;
}

bool HasSameCorners(const TriangleMesh& mesh, int64_t a, int64_t b) {
  return CornerAt(mesh, b, mesh.Corner(a, 0)) < 3 && CornerAt(mesh, b, mesh.Corner(a, 1)) < 3 &&
         CornerAt(mesh, b, mesh.Corner(a, 2)) < 3;
}

/// For each face the first with the same corners.
std::vector<int32_t> FirstCopies(const TriangleMesh& mesh) {
  return FirstEqual(
      mesh.FaceCount(),
      [&](int64_t face) {
        return HashPoint(mesh.Corner(face, 0)) + HashPoint(mesh.Corner(face, 1)) +
               HashPoint(mesh.Corner(face, 2));
      },
      [&](int64_t a, int64_t b) { return HasSameCorners(mesh, a, b); });
}

/// The side that was the back in the file.
Side FileBack(const TriangleMesh& mesh, int64_t face) {
  return (mesh.faceFlags[size_t(face)] & kRewound) ? kFront : kBack;
}

bool EmitsFromFileBack(const TriangleMesh& mesh, int64_t face) {
  return mesh.Emits(face, FileBack(mesh, face)) && !mesh.emittance[size_t(face)].IsBlack();
}

/// Whether two faces with the same corners are wound opposite ways.
bool AreReversed(const TriangleMesh& mesh, int64_t a, int64_t b) {
  return Dot(mesh.VectorArea(a), mesh.VectorArea(b)) < 0;
}

}  // namespace

DoubledFaces::DoubledFaces(const TriangleMesh& mesh) {
  if (mesh.faceFlags.size() != mesh.triangles.size()) return;
  const std::vector<int32_t> first = FirstCopies(mesh);
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const int32_t other = first[size_t(face)];
    if (other == face || !(mesh.Area(face) > 0)) continue;
    // The file's fronts look opposite ways.
    const bool isReversed = AreReversed(mesh, face, other);
    if (isReversed != (FileBack(mesh, face) == FileBack(mesh, other))) continue;
    if (EmitsFromFileBack(mesh, face) || EmitsFromFileBack(mesh, other)) continue;
    if (twins_.empty()) twins_.resize(mesh.triangles.size());
    if (twins_[size_t(other)].face >= 0) continue;  // A third copy.
    Twin &mine = twins_[size_t(face)], &its = twins_[size_t(other)];
    mine.face = other, its.face = int32_t(face);
    mine.hidden = FileBack(mesh, face), its.hidden = FileBack(mesh, other);
    mine.isReversed = its.isReversed = isReversed;
    for (int k = 0; k < 3; ++k) {
      mine.corner[size_t(k)] = uint8_t(CornerAt(mesh, other, mesh.Corner(face, k)));
      its.corner[size_t(k)] = uint8_t(CornerAt(mesh, face, mesh.Corner(other, k)));
    }
  }
}

DoubledFaces::Place DoubledFaces::OnTwin(const Place& hidden) const {
  const Twin& twin = twins_[size_t(hidden.face)];
  const Vec2f& b = hidden.barycentric;
  std::array<float, 3> weights{};
  weights[twin.corner[0]] = 1 - b.x - b.y;
  weights[twin.corner[1]] = b.x;
  weights[twin.corner[2]] = b.y;
  return {twin.face, {weights[1], weights[2]}};
}

}  // namespace lambert
