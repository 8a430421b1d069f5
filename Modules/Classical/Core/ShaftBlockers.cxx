#include "Classical/Core/ShaftBlockers.h"

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

ShaftBlockers::ShaftBlockers(const TriangleMesh& mesh, float tolerance,
                             const std::vector<std::vector<Vec3f>>& groups)
    : mesh_(mesh),
      tolerance_(tolerance),
      blockers_(mesh.triangles.size()),
      rowLength_((mesh.triangles.size() + 7) / 8 * 8) {
  for (size_t face = 0; face < blockers_.size(); ++face) {
    blockers_[face] = MakeBlocker(int64_t(face));
  }
  if (rowLength_ * groups.size() > kMaximumTable) return;
  bounds_.resize(groups.size());
  sides_.assign(rowLength_ * groups.size(), uint8_t(kAbove | kBelow));
  ParallelForEach(int64_t(groups.size()), 16, [&](int64_t group) {
    for (const Vec3f& p : groups[size_t(group)]) bounds_[size_t(group)].Include(p);
    ClassifyFaces(groups[size_t(group)], &sides_[rowLength_ * size_t(group)]);
  });
}

ShaftBlockers::Blocker ShaftBlockers::MakeBlocker(int64_t face) const {
  // In double: a sliver's maps are steep.
  Blocker blocker;
  const Vec3d p(mesh_.Corner(face, 0)), u = Vec3d(mesh_.Corner(face, 1)) - p;
  const Vec3d v = Vec3d(mesh_.Corner(face, 2)) - p, normal = Cross(u, v);
  const double squared = LengthSquared(normal);
  if (!(squared > 0)) return blocker;
  const Vec3d unit = normal / std::sqrt(squared);
  const Vec3d toU = Cross(v, normal) / squared, toV = Cross(normal, u) / squared;
  blocker.normal = Vec3f(unit), blocker.offset = float(Dot(unit, p));
  blocker.toU = Vec3f(toU), blocker.u0 = float(-Dot(toU, p));
  blocker.toV = Vec3f(toV), blocker.v0 = float(-Dot(toV, p));
  return blocker;
}

void ShaftBlockers::ClassifyFaces(const std::vector<Vec3f>& points, uint8_t* sides) const {
  for (size_t face = 0; face < mesh_.triangles.size(); ++face) {
    const Blocker& blocker = blockers_[face];
    if (blocker.normal == Vec3f()) continue;  // a face without area blocks nothing
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (const Vec3f& p : points) {
      const float height = Dot(p, blocker.normal) - blocker.offset;
      low = std::min(low, height);
      high = std::max(high, height);
    }
    sides[face] = uint8_t((low >= -tolerance_ ? kAbove : 0) | (high <= tolerance_ ? kBelow : 0));
  }
}

bool ShaftBlockers::MayBlock(size_t face, const std::vector<Plane>& planes) const {
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

ShaftBlockers::Faces ShaftBlockers::Between(int32_t a, int32_t b) const {
  Faces faces;
  if (sides_.empty()) {
    faces.count = kCrowd + 1;
    return faces;
  }
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
      if (!MayBlock(face, planes)) continue;
      faces.face[size_t(faces.count++)] = int32_t(face);
      if (faces.IsCrowd()) return faces;
    }
  }
  return faces;
}

bool ShaftBlockers::IsBlocked(const Faces& faces, const Segment& segment) const {
  constexpr float kBorder = 1e-6f;  // neighbours overlap by rounding rather than let light through
  const Vec3f step = segment.to - segment.from;
  const float length = Length(step);
  for (int k = 0; k < faces.count; ++k) {
    const Blocker& blocker = blockers_[size_t(faces.face[size_t(k)])];
    const float from = Dot(segment.from, blocker.normal) - blocker.offset;
    const float fall = -Dot(step, blocker.normal);
    const float t = from / fall;  // not finite along the plane: no comparison below is true
    if (!(t * length > tolerance_ && (1 - t) * length > tolerance_)) continue;
    const Vec3f x = segment.from + step * t;
    const float u = Dot(x, blocker.toU) + blocker.u0, v = Dot(x, blocker.toV) + blocker.v0;
    if (u >= -kBorder && v >= -kBorder && u + v <= 1 + kBorder) return true;
  }
  return false;
}

}  // namespace lambert
