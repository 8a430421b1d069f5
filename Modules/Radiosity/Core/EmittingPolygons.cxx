#include "Radiosity/Core/EmittingPolygons.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

#include "Common/Core/DisjointSets.h"

namespace lambert {

namespace {

/// Corners within this part of a face's size of another's plane lie in it.
constexpr float kFlat = 1e-5f;
/// A corner that turns by less than this sine is none.
constexpr float kStraight = 1e-4f;
/// Faces that overlap or leave holes cover another area than their border, beyond this part of it.
constexpr float kSameArea = 1e-3f;

/// A face as its emitting side shows it.
struct EmittingFace {
  std::array<Vec3f, 3> corners;
  std::array<int32_t, 3> points;  ///< numbers of the corners' positions
  Vec3f normal;
  float area, size;
  Spectrum emittance;
};

std::vector<EmittingFace> EmittingFaces(const TriangleMesh& mesh) {
  std::vector<EmittingFace> faces;
  std::map<std::array<float, 3>, int32_t> numberOfPosition;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    for (const Side side : {kFront, kBack}) {
      if (!mesh.Emits(face, side) || !(mesh.emittance[size_t(face)].Mean() > 0)) continue;
      EmittingFace emitting;
      for (int i = 0; i < 3; ++i) {
        const Vec3f p = mesh.Corner(face, side == kFront ? i : 2 - i);
        emitting.corners[size_t(i)] = p;
        emitting.points[size_t(i)] =
            numberOfPosition.try_emplace({p.x, p.y, p.z}, int32_t(numberOfPosition.size()))
                .first->second;
      }
      const auto& c = emitting.corners;
      const Vec3f doubleArea = Cross(c[1] - c[0], c[2] - c[0]);
      emitting.normal = Normalize(doubleArea);
      emitting.area = 0.5f * Length(doubleArea);
      emitting.size = std::max({Length(c[1] - c[0]), Length(c[2] - c[1]), Length(c[0] - c[2])});
      emitting.emittance = mesh.emittance[size_t(face)];
      if (emitting.area > 0) faces.push_back(emitting);
    }
  }
  return faces;
}

bool LieInOnePlane(const EmittingFace& a, const EmittingFace& b) {
  if (!(Dot(a.normal, b.normal) > 0)) return false;
  const auto isFlat = [](const EmittingFace& plane, const EmittingFace& other) {
    for (const Vec3f& p : other.corners) {
      const float height = std::abs(Dot(plane.normal, p - plane.corners[0]));
      if (height > kFlat * std::max(plane.size, other.size)) return false;
    }
    return true;
  };
  return isFlat(a, b) && isFlat(b, a);
}

uint64_t EdgeKey(int32_t from, int32_t to) { return uint64_t(uint32_t(from)) << 32 | uint32_t(to); }

/// The face at each directed edge; -1 where there are several.
std::unordered_map<uint64_t, int32_t> FacesOfEdges(const std::vector<EmittingFace>& faces) {
  std::unordered_map<uint64_t, int32_t> faceOfEdge;
  for (size_t face = 0; face < faces.size(); ++face) {
    const auto& p = faces[face].points;
    for (size_t i = 0; i < 3; ++i) {
      const auto [found, isNew] =
          faceOfEdge.try_emplace(EdgeKey(p[i], p[(i + 1) % 3]), int32_t(face));
      if (!isNew) found->second = -1;
    }
  }
  return faceOfEdge;
}

/// The border of some faces as one loop of corners; empty where it is none.
std::vector<Vec3f> BorderOf(const std::vector<EmittingFace>& faces,
                            const std::vector<int32_t>& group) {
  struct Edge {
    Vec3f from;
    int32_t to;
  };
  std::unordered_map<uint64_t, bool> isEdge;
  for (const int32_t face : group) {
    const auto& p = faces[size_t(face)].points;
    for (size_t i = 0; i < 3; ++i) isEdge[EdgeKey(p[i], p[(i + 1) % 3])] = true;
  }
  std::map<int32_t, Edge> borderFrom;
  for (const int32_t face : group) {
    const EmittingFace& f = faces[size_t(face)];
    for (size_t i = 0; i < 3; ++i) {
      const int32_t from = f.points[i], to = f.points[(i + 1) % 3];
      if (isEdge.count(EdgeKey(to, from))) continue;
      if (!borderFrom.try_emplace(from, Edge{f.corners[i], to}).second) return {};
    }
  }
  std::vector<Vec3f> loop;
  if (borderFrom.empty()) return loop;
  const int32_t start = borderFrom.begin()->first;
  int32_t at = start;
  do {
    const auto found = borderFrom.find(at);
    if (found == borderFrom.end() || loop.size() == borderFrom.size()) return {};
    loop.push_back(found->second.from);
    at = found->second.to;
  } while (at != start);
  return loop.size() == borderFrom.size() ? loop : std::vector<Vec3f>();
}

/// The corners at which a loop turns.
std::vector<Vec3f> WithoutStraightCorners(const std::vector<Vec3f>& loop) {
  std::vector<Vec3f> corners;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec3f before = loop[i] - loop[(i + loop.size() - 1) % loop.size()];
    const Vec3f after = loop[(i + 1) % loop.size()] - loop[i];
    const bool isStraight =
        Dot(before, after) > 0 &&
        Length(Cross(before, after)) <= kStraight * Length(before) * Length(after);
    if (!isStraight) corners.push_back(loop[i]);
  }
  return corners;
}

/// Faces as one polygon; false where they are none.
bool JoinFaces(const std::vector<EmittingFace>& faces, const std::vector<int32_t>& group,
               EmittingPolygon* polygon) {
  const std::vector<Vec3f> corners = WithoutStraightCorners(BorderOf(faces, group));
  if (corners.size() < 3 || corners.size() > size_t(EmittingPolygon::kMostCorners)) return false;
  polygon->count = int(corners.size());
  std::copy(corners.begin(), corners.end(), polygon->corners.begin());

  // It turns the same way at every corner, and covers what the faces do.
  Vec3f doubleArea;
  for (size_t i = 2; i < corners.size(); ++i) {
    doubleArea += Cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  polygon->normal = Normalize(doubleArea);
  polygon->area = 0.5f * Length(doubleArea);
  float area = 0;
  for (const int32_t face : group) area += faces[size_t(face)].area;
  if (!(std::abs(area - polygon->area) <= kSameArea * area)) return false;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3f& b = corners[(i + 1) % corners.size()];
    const Vec3f turn = Cross(b - corners[i], corners[(i + 2) % corners.size()] - b);
    if (!(Dot(turn, polygon->normal) > 0)) return false;
  }
  polygon->emittance = faces[size_t(group[0])].emittance;
  return true;
}

}  // namespace

Vec3f EmittingPolygon::Center() const {
  Vec3f sum;
  for (int i = 0; i < count; ++i) sum += corners[size_t(i)];
  return sum / float(count);
}

float EmittingPolygon::LargestSize() const {
  float largest = 0;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < i; ++j) {
      largest = std::max(largest, Length(corners[size_t(i)] - corners[size_t(j)]));
    }
  }
  return largest;
}

float EmittingPolygon::FanArea(int corner) const {
  const size_t c = size_t(corner);
  return Length(Cross(corners[c - 1] - corners[0], corners[c] - corners[0])) / 2;
}

float EmittingPolygon::DistanceSquared(const Vec3f& place) const {
  bool isInside = true;
  float least = std::numeric_limits<float>::max();
  for (int i = 0; i < count; ++i) {
    const Vec3f& corner = corners[size_t(i)];
    const Vec3f edge = corners[size_t((i + 1) % count)] - corner, offset = place - corner;
    if (Dot(Cross(normal, edge), offset) < 0) isInside = false;
    const float along = Dot(offset, edge) / std::max(LengthSquared(edge), 1e-30f);
    const Vec3f nearest = corner + edge * std::min(1.f, std::max(0.f, along));
    least = std::min(least, LengthSquared(place - nearest));
  }
  const float height = Dot(place - corners[0], normal);
  return isInside ? height * height : least;
}

std::vector<EmittingPolygon> FindEmittingPolygons(const TriangleMesh& mesh) {
  // Faces of one plane and exitance that edges join.
  const std::vector<EmittingFace> faces = EmittingFaces(mesh);
  const std::unordered_map<uint64_t, int32_t> faceOfEdge = FacesOfEdges(faces);
  DisjointSets sets(faces.size());
  for (size_t face = 0; face < faces.size(); ++face) {
    const EmittingFace& own = faces[face];
    for (size_t i = 0; i < 3; ++i) {
      const auto found = faceOfEdge.find(EdgeKey(own.points[(i + 1) % 3], own.points[i]));
      if (found == faceOfEdge.end() || found->second < 0) continue;
      const EmittingFace& other = faces[size_t(found->second)];
      if (other.emittance == own.emittance && LieInOnePlane(own, other)) {
        sets.Join(int32_t(face), found->second);
      }
    }
  }
  std::vector<std::vector<int32_t>> groups(faces.size());
  for (size_t face = 0; face < faces.size(); ++face) {
    groups[size_t(sets.Find(int32_t(face)))].push_back(int32_t(face));
  }

  // Those that make up a polygon, and those that do not.
  std::vector<EmittingPolygon> polygons;
  for (const std::vector<int32_t>& group : groups) {
    EmittingPolygon joined;
    if (group.size() > 1 && JoinFaces(faces, group, &joined)) {
      polygons.push_back(joined);
      continue;
    }
    for (const int32_t number : group) {
      const EmittingFace& face = faces[size_t(number)];
      EmittingPolygon polygon;
      std::copy(face.corners.begin(), face.corners.end(), polygon.corners.begin());
      polygon.normal = face.normal;
      polygon.area = face.area;
      polygon.emittance = face.emittance;
      polygons.push_back(polygon);
    }
  }
  return polygons;
}

}  // namespace lambert
