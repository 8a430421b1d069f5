#include "Reference/Core/VertexReceivers.h"

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// The triangles about every point, as ranges of one array.
struct PointFaces {
  std::vector<int64_t> first;  ///< per point, and the end
  std::vector<int32_t> faces;

  explicit PointFaces(const TriangleMesh& mesh) : first(mesh.positions.size() + 1, 0) {
    for (const auto& triangle : mesh.triangles) {
      for (const int32_t point : triangle) ++first[size_t(point) + 1];
    }
    for (size_t point = 1; point < first.size(); ++point) first[point] += first[point - 1];
    faces.resize(3 * mesh.triangles.size());
    std::vector<int64_t> next(first.begin(), first.end() - 1);
    for (size_t face = 0; face < mesh.triangles.size(); ++face) {
      for (const int32_t point : mesh.triangles[face]) {
        faces[size_t(next[size_t(point)]++)] = int32_t(face);
      }
    }
  }
};

/// A triangle as seen from one of its corners: two edges, and its area.
struct Fan {
  int32_t face;
  Vec3d u, v;    ///< m, to the other corners, counter-clockwise
  Vec3d normal;  ///< twice the vector area, m2

  Fan(const TriangleMesh& mesh, int32_t face_, int32_t point) : face(face_) {
    const auto& triangle = mesh.triangles[size_t(face)];
    const int corner = triangle[0] == point ? 0 : triangle[1] == point ? 1 : 2;
    const Vec3d p(mesh.Corner(face, corner));
    u = Vec3d(mesh.Corner(face, (corner + 1) % 3)) - p;
    v = Vec3d(mesh.Corner(face, (corner + 2) % 3)) - p;
    normal = Cross(u, v);
  }
  /// The centroid, from the corner.
  Vec3d Centroid() const { return (u + v) / 3.; }
};

/// A place on a triangle about a point.
struct DrawnPlace {
  int32_t face = -1;
  Vec3d offset;  ///< from the point, m
};

DrawnPlace Draw(const std::vector<Fan>& fans) {
  Vec3d mean;
  for (const Fan& fan : fans) mean += fan.Centroid() / double(fans.size());
  const Vec3d drawn = mean * kVertexDraw;

  // Onto the nearest triangle that it lies over or under.
  DrawnPlace place;
  double nearest = 0;
  for (const Fan& fan : fans) {
    const double square = LengthSquared(fan.normal);
    const double along = Dot(Cross(drawn, fan.v), fan.normal) / square;
    const double across = Dot(Cross(fan.u, drawn), fan.normal) / square;
    // A place on the common edge of two triangles may lie outside both by rounding.
    constexpr double kRounding = 1e-6 * kVertexDraw;
    if (along < -kRounding || across < -kRounding) continue;
    const double height = std::abs(Dot(drawn, fan.normal)) / std::sqrt(square);
    if (place.face >= 0 && height >= nearest) continue;
    nearest = height;
    place = {fan.face, fan.u * std::max(0., along) + fan.v * std::max(0., across)};
  }
  if (place.face >= 0) return place;

  // Else into the largest.
  const Fan* largest = &fans.front();
  for (const Fan& fan : fans) {
    if (LengthSquared(fan.normal) > LengthSquared(largest->normal)) largest = &fan;
  }
  return {largest->face, largest->Centroid() * kVertexDraw};
}

}  // namespace

std::vector<VertexReceiver> VertexReceivers(const TriangleMesh& mesh) {
  // A place for every point.
  const PointFaces about(mesh);
  std::vector<DrawnPlace> places(mesh.positions.size());
  ParallelFor(mesh.PointCount(), 1024, [&](int64_t begin, int64_t end) {
    std::vector<Fan> fans;
    for (int64_t point = begin; point < end; ++point) {
      fans.clear();
      for (int64_t i = about.first[size_t(point)]; i < about.first[size_t(point) + 1]; ++i) {
        const int32_t face = about.faces[size_t(i)];
        if (mesh.FrontNormal(face) == Vec3f()) continue;
        const Fan fan(mesh, face, int32_t(point));
        if (LengthSquared(fan.normal) > 0) fans.push_back(fan);
      }
      if (!fans.empty()) places[size_t(point)] = Draw(fans);
    }
  });

  // Both sides of each.
  std::vector<VertexReceiver> receivers;
  receivers.reserve(2 * mesh.positions.size());
  for (int32_t point = 0; point < int32_t(mesh.PointCount()); ++point) {
    const DrawnPlace& place = places[size_t(point)];
    if (place.face < 0) continue;
    const Vec3f front = mesh.FrontNormal(place.face);
    const Vec3f normal = mesh.normals.empty() ? front : mesh.normals[size_t(point)];
    const bool facesFront = Dot(normal, front) >= 0;
    const Vec3d corner(mesh.positions[size_t(point)]);
    const Vec3f position(corner + place.offset), inside(corner + place.offset / kVertexDraw);
    const Vec3f geometric = facesFront ? front : -front;
    const Side side = facesFront ? kFront : kBack;
    receivers.push_back({point, place.face, side, {position, normal, geometric}, inside});
    receivers.push_back({point,
                         place.face,
                         side == kFront ? kBack : kFront,
                         {position, -normal, -geometric},
                         inside});
  }
  return receivers;
}

}  // namespace lambert
