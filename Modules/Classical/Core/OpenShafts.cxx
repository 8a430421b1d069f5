#include "Classical/Core/OpenShafts.h"

#include <cstring>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

constexpr size_t kMaximumTable = size_t(1) << 28;  ///< bytes

using Plane = std::array<float, 4>;  ///< x, y, z of the outward normal, and the offset along it

/// Planes that hold two boxes on their inner side: those of the box around both, and those that
/// touch both along edges parallel to an axis.
std::vector<Plane> ShaftPlanes(const Box3f& a, const Box3f& b) {
  std::vector<Plane> planes;
  Box3f both = a;
  both.Include(b);
  for (size_t axis = 0; axis < 3; ++axis) {
    Plane low{0, 0, 0, -both.low[int(axis)]}, high{0, 0, 0, both.high[int(axis)]};
    low[axis] = -1, high[axis] = 1;
    planes.push_back(low);
    planes.push_back(high);
  }
  for (int u = 0; u < 3; ++u) {
    const int v = (u + 1) % 3;
    for (int corner = 0; corner < 4; ++corner) {
      // The line through the same corner of both rectangles, seen along the third axis.
      const auto at = [&](const Box3f& box, int which) {
        return Vec2f(which & 1 ? box.high[u] : box.low[u], which & 2 ? box.high[v] : box.low[v]);
      };
      const Vec2f p = at(a, corner), d = at(b, corner) - p;
      const float length = std::sqrt(d.x * d.x + d.y * d.y);
      if (!(length > 0)) continue;
      Vec2f n(d.y / length, -d.x / length);

      // It touches both where all corners lie on one side.
      float low = 0, high = 0;
      for (int other = 0; other < 4; ++other) {
        for (const Box3f* box : {&a, &b}) {
          const Vec2f q = at(*box, other) - p;
          low = std::min(low, q.x * n.x + q.y * n.y);
          high = std::max(high, q.x * n.x + q.y * n.y);
        }
      }
      const float rounding = 1e-6f * both.Diagonal();
      if (low < -rounding && high > rounding) continue;
      if (high > rounding) n = Vec2f(-n.x, -n.y);
      Plane plane{0, 0, 0, p.x * n.x + p.y * n.y + rounding};
      plane[size_t(u)] = n.x, plane[size_t(v)] = n.y;
      planes.push_back(plane);
    }
  }
  return planes;
}

}  // namespace

OpenShafts::OpenShafts(const TriangleMesh& mesh, float tolerance,
                       const std::vector<std::vector<Vec3f>>& groups)
    : mesh_(mesh), rowLength_((mesh.triangles.size() + 7) / 8 * 8) {
  if (rowLength_ * groups.size() > kMaximumTable) return;
  bounds_.resize(groups.size());
  sides_.assign(rowLength_ * groups.size(), uint8_t(kAbove | kBelow));
  ParallelForEach(int64_t(groups.size()), 1, [&](int64_t group) {
    for (const Vec3f& p : groups[size_t(group)]) bounds_[size_t(group)].Include(p);
    ClassifyFaces(groups[size_t(group)], tolerance, &sides_[rowLength_ * size_t(group)]);
  });
}

void OpenShafts::ClassifyFaces(const std::vector<Vec3f>& points, float tolerance,
                               uint8_t* sides) const {
  for (size_t face = 0; face < mesh_.triangles.size(); ++face) {
    // A face without area blocks nothing.
    const Vec3f normal = mesh_.FrontNormal(int64_t(face));
    if (normal == Vec3f()) continue;
    const Vec3f& origin = mesh_.Corner(int64_t(face), 0);
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (const Vec3f& p : points) {
      const float height = Dot(p - origin, normal);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    sides[face] = uint8_t((low >= -tolerance ? kAbove : 0) | (high <= tolerance ? kBelow : 0));
  }
}

bool OpenShafts::MayBlock(size_t face, const std::vector<Plane>& planes) const {
  for (const Plane& plane : planes) {
    bool isOutside = true;
    for (int corner = 0; corner < 3 && isOutside; ++corner) {
      const Vec3f& p = mesh_.Corner(int64_t(face), corner);
      isOutside = p.x * plane[0] + p.y * plane[1] + p.z * plane[2] >= plane[3];
    }
    if (isOutside) return false;
  }
  return true;
}

bool OpenShafts::IsOpen(int32_t a, int32_t b) const {
  if (sides_.empty()) return false;
  const uint8_t* first = &sides_[rowLength_ * size_t(a)];
  const uint8_t* second = &sides_[rowLength_ * size_t(b)];
  std::vector<Plane> planes;
  for (size_t begin = 0; begin < rowLength_; begin += 8) {
    // Eight faces at a time: does one have the groups on both of its sides?
    uint64_t p, q;
    std::memcpy(&p, first + begin, 8);
    std::memcpy(&q, second + begin, 8);
    constexpr uint64_t kOnes = 0x0101010101010101ull;
    const uint64_t onOneSide = (p & q) | ((p & q) >> 1);
    if ((onOneSide & kOnes) == kOnes) continue;
    for (size_t face = begin; face < begin + 8; ++face) {
      if (first[face] & second[face]) continue;
      if (planes.empty()) planes = ShaftPlanes(bounds_[size_t(a)], bounds_[size_t(b)]);
      if (MayBlock(face, planes)) return false;
    }
  }
  return true;
}

}  // namespace lambert
