#include "Classical/Core/UniformMesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "Common/Core/Error.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {

Error TooManyElements(double elementSize) {
  return Error("Elements of " + std::to_string(elementSize) + " m would be more than " +
               std::to_string(kMaximumElements) + " on this mesh; ask for larger ones.");
}

using Triangle = std::array<int32_t, 3>;

/// Cuts faces into patches and elements.
class MeshCutter {
 public:
  MeshCutter(const Scene& scene, double elementSize, double patchSize)
      : elementSquared_(elementSize * elementSize),
        patchSquared_(std::max(patchSize, elementSize) * std::max(patchSize, elementSize)) {
    mesh_.elementSize = elementSize;
    mesh_.positions = scene.mesh.positions;
    mesh_.normals = scene.mesh.normals;
    mesh_.uvs = scene.mesh.uvs;
  }

  void CutFace(int32_t face, const Triangle& triangle) {
    face_ = face;
    Cut(triangle, false);
  }

  UniformMesh Finish() {
    mesh_.patchBegin.push_back(int32_t(mesh_.ElementCount()));
    for (Vec3f& normal : mesh_.normals) normal = Normalize(normal);
    return std::move(mesh_);
  }

 private:
  void Cut(Triangle t, bool isInPatch) {
    // Is it a patch, an element?
    if (!isInPatch && !HasLongEdge(t, patchSquared_)) {
      isInPatch = true;
      mesh_.patches.push_back(t);
      mesh_.patchBegin.push_back(int32_t(mesh_.ElementCount()));
    }
    const double limit = isInPatch ? elementSquared_ : patchSquared_;
    if (!HasLongEdge(t, limit)) {
      mesh_.triangles.push_back(t);
      mesh_.face.push_back(face_);
      if (mesh_.ElementCount() > kMaximumElements) throw TooManyElements(mesh_.elementSize);
      return;
    }

    // Halve its long edges: of one, the first; of two, the first and the second.
    std::array<bool, 3> isLong;
    for (size_t c = 0; c < 3; ++c) isLong[c] = IsLong(t[c], t[(c + 1) % 3], limit);
    const int cuts = int(isLong[0]) + int(isLong[1]) + int(isLong[2]);
    while (!isLong[0] || (cuts == 2 && isLong[2])) {
      std::rotate(t.begin(), t.begin() + 1, t.end());
      std::rotate(isLong.begin(), isLong.begin() + 1, isLong.end());
    }
    const int32_t ab = Midpoint(t[0], t[1]);
    if (cuts == 1) {
      Cut({t[0], ab, t[2]}, isInPatch);
      Cut({ab, t[1], t[2]}, isInPatch);
      return;
    }
    const int32_t bc = Midpoint(t[1], t[2]);
    if (cuts == 2) {
      Cut({ab, t[1], bc}, isInPatch);
      CutQuad({t[0], ab, bc, t[2]}, isInPatch);
      return;
    }
    const int32_t ca = Midpoint(t[2], t[0]);
    Cut({t[0], ab, ca}, isInPatch);
    Cut({ab, t[1], bc}, isInPatch);
    Cut({ab, bc, ca}, isInPatch);
    Cut({ca, bc, t[2]}, isInPatch);
  }

  /// Along its shorter diagonal.
  void CutQuad(const std::array<int32_t, 4>& q, bool isInPatch) {
    const float first = LengthSquared(Position(q[0]) - Position(q[2]));
    const float second = LengthSquared(Position(q[1]) - Position(q[3]));
    if (first <= second) {
      Cut({q[0], q[1], q[2]}, isInPatch);
      Cut({q[0], q[2], q[3]}, isInPatch);
    } else {
      Cut({q[0], q[1], q[3]}, isInPatch);
      Cut({q[1], q[2], q[3]}, isInPatch);
    }
  }

  /// False too where numbers are too coarse to halve it: so far from the origin it is long enough.
  bool IsLong(int32_t a, int32_t b, double limitSquared) const {
    const Vec3f &p = Position(a), &q = Position(b), middle = (p + q) * 0.5f;
    const double length = LengthSquared(Vec3d(p) - Vec3d(q));
    const double half =
        std::max(LengthSquared(Vec3d(p) - Vec3d(middle)), LengthSquared(Vec3d(q) - Vec3d(middle)));
    return length > limitSquared && half < 0.5 * length;
  }
  bool HasLongEdge(const Triangle& t, double limitSquared) const {
    return IsLong(t[0], t[1], limitSquared) || IsLong(t[1], t[2], limitSquared) ||
           IsLong(t[2], t[0], limitSquared);
  }

  int32_t Midpoint(int32_t a, int32_t b) {
    const uint64_t key = uint64_t(std::min(a, b)) << 32 | uint32_t(std::max(a, b));
    const auto [found, isNew] = midpoints_.try_emplace(key, int32_t(mesh_.positions.size()));
    if (!isNew) return found->second;
    const size_t i = size_t(a), j = size_t(b);
    mesh_.positions.push_back((mesh_.positions[i] + mesh_.positions[j]) * 0.5f);
    // Not of unit length until the end, so that normals are linear over a face.
    const Vec3f normal = (mesh_.normals[i] + mesh_.normals[j]) * 0.5f;
    mesh_.normals.push_back(LengthSquared(normal) > 0 ? normal : mesh_.normals[i]);
    if (!mesh_.uvs.empty()) mesh_.uvs.push_back((mesh_.uvs[i] + mesh_.uvs[j]) * 0.5f);
    return found->second;
  }

  const Vec3f& Position(int32_t vertex) const { return mesh_.positions[size_t(vertex)]; }

  const double elementSquared_, patchSquared_;  ///< m2, of edges
  UniformMesh mesh_;
  int32_t face_ = 0;
  std::unordered_map<uint64_t, int32_t> midpoints_;  ///< by the ends of an edge
};

}  // namespace

double ResolveElementSize(const Scene& scene, double elementSize) {
  if (!(elementSize >= 0) || !std::isfinite(elementSize)) {
    throw Error("The element size is " + std::to_string(elementSize) +
                " m; give a positive length, or 0 for 1/50 of the scene's diagonal.");
  }
  if (elementSize > 0) return elementSize;
  const Box3f bounds = scene.mesh.Bounds();
  return bounds.IsEmpty() ? 0 : double(bounds.Diagonal()) / 50;
}

UniformMesh MakeUniformMesh(const Scene& scene, double elementSize, double patchSize) {
  const TriangleMesh& mesh = scene.mesh;
  if (mesh.normals.size() != mesh.positions.size()) {
    throw Error("The mesh lacks point normals; make them with CompletePointNormals.");
  }
  // No triangle of such edges has more area than the equilateral one.
  const double size = ResolveElementSize(scene, elementSize);
  double area = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) area += double(mesh.Area(face));
  const double largest = std::sqrt(3.0) / 4 * size * size;
  if (area > largest * double(kMaximumElements)) throw TooManyElements(size);

  MeshCutter cutter(scene, size, patchSize);
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    cutter.CutFace(int32_t(face), mesh.triangles[size_t(face)]);
  }
  return cutter.Finish();
}

}  // namespace lambert
