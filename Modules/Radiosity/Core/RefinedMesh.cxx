#include "Radiosity/Core/RefinedMesh.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "Common/Core/Parallel.h"
#include "Reference/Core/VertexReceivers.h"

namespace lambert {

namespace {

/// Which leaf element stands for each side of a face, and for each patch.
struct LeafIndex {
  std::array<std::vector<int32_t>, 2> ofFace;
  std::vector<int32_t> ofPatch;

  explicit LeafIndex(const ElementHierarchy& hierarchy) {
    const size_t faces = hierarchy.GetScene().mesh.triangles.size();
    ofFace[0].assign(faces, -1);
    ofFace[1].assign(faces, -1);
    for (int32_t index = 0; index < hierarchy.Size(); ++index) {
      const Element& element = hierarchy[index];
      if (!element.IsLeaf() || element.IsVolume() || element.kind == ElementKind::Light) continue;
      if (element.kind == ElementKind::Patch) {
        if (size_t(element.item) >= ofPatch.size()) ofPatch.resize(size_t(element.item) + 1, -1);
        ofPatch[size_t(element.item)] = index;
        continue;
      }
      const ClusterNode& node = hierarchy.Tree().nodes[size_t(element.item)];
      std::fill_n(ofFace[element.side].begin() + node.firstFace, node.faceCount, index);
    }
    // Patches that were cut for the display alone belong to the leaf that they were cut from.
    const LeafMesh& leaves = hierarchy.Leaves();
    ofPatch.resize(size_t(leaves.PatchCount()), -1);
    for (int32_t patch = 0; patch < leaves.PatchCount(); ++patch) {
      if (ofPatch[size_t(patch)] < 0) continue;
      for (const int32_t part : leaves.Parts(patch)) ofPatch[size_t(part)] = ofPatch[size_t(patch)];
    }
  }

  int32_t operator()(const LeafTriangle& triangle) const {
    if (triangle.patch >= 0 && ofPatch[size_t(triangle.patch)] >= 0) {
      return ofPatch[size_t(triangle.patch)];
    }
    return ofFace[triangle.side][size_t(triangle.face)];
  }
};

using Corner = RefinedMesh::Corner;
using Range = RefinedMesh::Range;

/// Of the point that a corner becomes: its vertex, surface and side.
uint64_t KeyOf(const LeafTriangle& triangle, int32_t corner,
               const std::vector<int32_t>& surfaceId) {
  const uint64_t surfaceSide = 2 * uint64_t(surfaceId[size_t(triangle.face)]) + triangle.side;
  return (surfaceSide << 32) | uint32_t(triangle.vertices[size_t(corner)]);
}

/// All corners by their vertices, those of a vertex by surface and side, then in the order of the
/// triangles: counted, as vertices are numbered.
std::vector<Corner> SortedCorners(const std::vector<LeafTriangle>& triangles, size_t vertexCount,
                                  const std::vector<int32_t>& surfaceId) {
  std::vector<int32_t> begin(vertexCount + 1, 0);
  for (const LeafTriangle& triangle : triangles) {
    for (const int32_t vertex : triangle.vertices) ++begin[size_t(vertex) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<int32_t> end(begin.begin(), begin.end() - 1);
  std::vector<Corner> corners(triangles.size() * 3);
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (int32_t c = 0; c < 3; ++c) {
      corners[size_t(end[size_t(triangles[t].vertices[size_t(c)])]++)] = {int32_t(t), c};
    }
  }
  const auto keyOf = [&](const Corner& c) {
    return KeyOf(triangles[size_t(c.triangle)], c.corner, surfaceId);
  };
  ParallelForEach(int64_t(vertexCount), 4096, [&](int64_t v) {
    std::stable_sort(corners.begin() + begin[size_t(v)], corners.begin() + begin[size_t(v) + 1],
                     [&](const Corner& a, const Corner& b) { return keyOf(a) < keyOf(b); });
  });
  return corners;
}

/// Corners of the same point, points in the order in which triangles first name them: vertex
/// numbers depend on when the leaves were triangulated before, this order does not.
std::vector<Range> PointGroups(const std::vector<Corner>& corners,
                               const std::vector<LeafTriangle>& triangles,
                               const std::vector<int32_t>& surfaceId) {
  const auto keyOf = [&](size_t i) {
    return KeyOf(triangles[size_t(corners[i].triangle)], corners[i].corner, surfaceId);
  };
  const auto endFrom = [&](size_t begin) {
    size_t end = begin + 1;
    while (end < corners.size() && keyOf(end) == keyOf(begin)) ++end;
    return end;
  };

  // Where the group lies that begins with a corner; -1 where none does.
  std::vector<int32_t> groupFrom(corners.size(), -1);
  size_t count = 0;
  for (size_t begin = 0; begin < corners.size(); begin = endFrom(begin), ++count) {
    const Corner& first = corners[begin];
    groupFrom[size_t(first.triangle) * 3 + size_t(first.corner)] = int32_t(begin);
  }
  std::vector<Range> groups;
  groups.reserve(count);
  for (const int32_t begin : groupFrom) {
    if (begin >= 0) groups.push_back({begin, int32_t(endFrom(size_t(begin)))});
  }
  return groups;
}

/// Position, normal and texture coordinate of a vertex number.
struct VertexReader {
  const TriangleMesh& mesh;
  const std::vector<LeafVertex>& added;

  const LeafVertex* Added(int32_t vertex) const {
    return vertex < mesh.PointCount() ? nullptr : &added[size_t(vertex - mesh.PointCount())];
  }
  Vec3f Position(int32_t vertex) const {
    const LeafVertex* v = Added(vertex);
    return v ? v->position : mesh.positions[size_t(vertex)];
  }
  template <class T>
  T Interpolate(const std::vector<T>& values, int32_t vertex) const {
    const LeafVertex* v = Added(vertex);
    if (!v) return values[size_t(vertex)];
    return values[size_t(v->points[0])] * v->weights.x +
           values[size_t(v->points[1])] * v->weights.y +
           values[size_t(v->points[2])] * v->weights.z;
  }
};

float CornerAngle(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const Vec3f u = a - p, v = b - p;
  return std::atan2(Length(Cross(u, v)), Dot(u, v));
}

int32_t VertexOf(const RefinedMesh::Point& point) { return int32_t(point.key & 0xffffffffu); }

/// Angle of a triangle at one of its corners, never quite zero.
float AngleAt(const VertexReader& vertices, const LeafTriangle& triangle, int32_t corner) {
  const Vec3f p = vertices.Position(triangle.vertices[size_t(corner)]);
  const Vec3f a = vertices.Position(triangle.vertices[size_t(corner + 1) % 3]);
  const Vec3f b = vertices.Position(triangle.vertices[size_t(corner + 2) % 3]);
  return std::max(1e-6f, CornerAngle(p, a, b));
}

Vec3f Centroid(const VertexReader& vertices, const LeafTriangle& triangle) {
  return (vertices.Position(triangle.vertices[0]) + vertices.Position(triangle.vertices[1]) +
          vertices.Position(triangle.vertices[2])) /
         3.f;
}

/// Fills the per-face arrays from the faces that the triangles lie in; back sides are wound the
/// other way round.
void FillFaces(const TriangleMesh& input, const std::vector<LeafTriangle>& triangles,
               const std::vector<int32_t>& leaves, RadiositySolution* solution) {
  const size_t count = triangles.size();
  TriangleMesh& mesh = solution->mesh;
  mesh.reflectance.resize(count);
  mesh.emittance.resize(count);
  mesh.faceFlags.resize(count);
  mesh.materialId.resize(count);
  mesh.partId.resize(count);
  mesh.surfaceId.resize(count);
  mesh.sourceCellId.resize(count);
  solution->inputFaceId.resize(count);
  solution->side.resize(count);
  solution->leafId.resize(count);
  ParallelForEach(int64_t(count), 4096, [&](int64_t i) {
    const size_t t = size_t(i), face = size_t(triangles[t].face);
    const Side side = Side(triangles[t].side);
    const bool emits = input.Emits(int64_t(face), side);
    const uint8_t rewound = (input.faceFlags[face] & kRewound) ? 1 : 0;
    mesh.reflectance[t] = input.reflectance[face];
    mesh.emittance[t] = emits ? input.emittance[face] : Spectrum();
    mesh.faceFlags[t] = uint8_t((emits ? kEmitsFront : 0) | (rewound != side ? kRewound : 0));
    mesh.materialId[t] = input.materialId[face];
    mesh.partId[t] = input.partId[face];
    mesh.surfaceId[t] = input.surfaceId[face];
    mesh.sourceCellId[t] = input.sourceCellId[face];
    solution->inputFaceId[t] = int64_t(face);
    solution->side[t] = side;
    solution->leafId[t] = leaves[t];
    if (side == kBack) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  });
}

}  // namespace

RefinedMesh::RefinedMesh(ElementHierarchy* hierarchy, const std::vector<uint8_t>& litSides, Use use)
    : hierarchy_(hierarchy), use_(use) {
  const TriangleMesh& input = hierarchy->GetScene().mesh;
  faceSides_.resize(input.triangles.size());
  for (size_t face = 0; face < faceSides_.size(); ++face) {
    const uint8_t sides = litSides[size_t(input.surfaceId[face])];
    faceSides_[face] = sides ? sides : uint8_t(1);
  }
  insideOfPoint_.resize(input.positions.size());
  for (const VertexReceiver& r : VertexReceivers(input)) {
    insideOfPoint_[size_t(r.point)] = {r.inside, input.FrontNormal(r.face)};
  }
  this->Triangulate();
}

void RefinedMesh::Triangulate() {
  // Triangles of all modelled sides, and the leaves that they lie in.
  triangles_ = hierarchy_->Leaves().Triangulate(faceSides_);
  const LeafIndex leafIndex(*hierarchy_);
  leaves_.resize(triangles_.size());
  for (size_t t = 0; t < triangles_.size(); ++t) leaves_[t] = leafIndex(triangles_[t]);

  // Points: corners that agree in vertex, surface and side.
  const TriangleMesh& input = hierarchy_->GetScene().mesh;
  const size_t vertices = input.positions.size() + hierarchy_->Leaves().Vertices().size();
  corners_ = SortedCorners(triangles_, vertices, input.surfaceId);
  groups_ = PointGroups(corners_, triangles_, input.surfaceId);
  points_.resize(groups_.size());
  pointsOfTriangle_.resize(triangles_.size());
  ParallelForEach(int64_t(groups_.size()), 256, [&](int64_t p) {
    const Range& group = groups_[size_t(p)];
    for (int64_t i = group.begin; i < group.end; ++i) {
      const Corner& corner = corners_[size_t(i)];
      pointsOfTriangle_[size_t(corner.triangle)][size_t(corner.corner)] = int32_t(p);
    }
    points_[size_t(p)] = this->MakePoint(group);
  });
  if (use_ == Use::Links) return;
  corners_ = std::vector<Corner>();
  groups_ = std::vector<Range>();
}

// Means over the triangles that meet at a point, by angle.
RefinedMesh::Point RefinedMesh::MakePoint(const Range& group) const {
  const TriangleMesh& input = hierarchy_->GetScene().mesh;
  const VertexReader vertices{input, hierarchy_->Leaves().Vertices()};
  const Corner& first = corners_[size_t(group.begin)];
  Point point;
  point.key = KeyOf(triangles_[size_t(first.triangle)], first.corner, input.surfaceId);
  const int32_t vertex = VertexOf(point);
  point.position = vertices.Position(vertex);
  Vec3f faceNormal;
  float largest = -1;
  for (int64_t i = group.begin; i < group.end; ++i) {
    const Corner& corner = corners_[size_t(i)];
    const LeafTriangle& triangle = triangles_[size_t(corner.triangle)];
    const float angle = AngleAt(vertices, triangle, corner.corner);
    faceNormal += input.FrontNormal(triangle.face) * (triangle.side == kBack ? -angle : angle);
    const Vec3f p = vertices.Position(triangle.vertices[0]);
    const float area = Length(Cross(vertices.Position(triangle.vertices[1]) - p,
                                    vertices.Position(triangle.vertices[2]) - p));
    if (area > largest) {
      largest = area;
      point.inside = Centroid(vertices, triangle);
      point.insideNormal = input.FrontNormal(triangle.face) * (triangle.side == kBack ? -1.f : 1.f);
    }
  }
  if (vertex < input.PointCount() && insideOfPoint_[size_t(vertex)].frontNormal != Vec3f()) {
    const Inside& inside = insideOfPoint_[size_t(vertex)];
    const bool isBack = triangles_[size_t(corners_[size_t(group.begin)].triangle)].side == kBack;
    point.inside = inside.position;
    point.insideNormal = isBack ? -inside.frontNormal : inside.frontNormal;
  }
  point.normal = Normalize(vertices.Interpolate(input.normals, vertex));
  if (Dot(point.normal, Normalize(faceNormal)) < 0) point.normal = -point.normal;
  if (!input.uvs.empty()) point.uv = vertices.Interpolate(input.uvs, vertex);
  this->AverageMaterial(group, &point);
  return point;
}

// By angle, as all that is averaged at a point.
void RefinedMesh::AverageMaterial(const Range& group, Point* point) const {
  const TriangleMesh& input = hierarchy_->GetScene().mesh;
  const VertexReader vertices{input, hierarchy_->Leaves().Vertices()};
  float total = 0;
  Spectrum reflectance, emittance;
  for (int64_t i = group.begin; i < group.end; ++i) {
    const Corner& corner = corners_[size_t(i)];
    const LeafTriangle& triangle = triangles_[size_t(corner.triangle)];
    const float angle = AngleAt(vertices, triangle, corner.corner);
    reflectance += input.reflectance[size_t(triangle.face)] * angle;
    if (input.Emits(triangle.face, Side(triangle.side))) {
      emittance += input.emittance[size_t(triangle.face)] * angle;
    }
    total += angle;
  }
  point->reflectance = reflectance * (1 / total);
  point->emittance = emittance * (1 / total);
}

void RefinedMesh::TakeMaterials() {
  ParallelForEach(int64_t(points_.size()), 256, [&](int64_t p) {
    this->AverageMaterial(groups_[size_t(p)], &points_[size_t(p)]);
  });
}

std::vector<LightReconstruction::Share> RefinedMesh::Shares(int64_t point) const {
  const VertexReader vertices{hierarchy_->GetScene().mesh, hierarchy_->Leaves().Vertices()};
  const Range& group = groups_[size_t(point)];
  std::vector<LightReconstruction::Share> shares;
  float weight = 0;
  for (int64_t i = group.begin; i < group.end; ++i) {
    const Corner& corner = corners_[size_t(i)];
    const int32_t leaf = leaves_[size_t(corner.triangle)];
    if (leaf < 0) continue;
    const LeafTriangle& triangle = triangles_[size_t(corner.triangle)];
    const float angle = AngleAt(vertices, triangle, corner.corner);
    auto same = std::find_if(shares.begin(), shares.end(),
                             [&](const LightReconstruction::Share& s) { return s.leaf == leaf; });
    if (same == shares.end()) same = shares.insert(same, {leaf, 0.f, Vec3f()});
    same->weight += angle;
    same->inside += Centroid(vertices, triangle) * angle;
    weight += angle;
  }
  for (LightReconstruction::Share& share : shares) {
    share.inside /= share.weight;
    share.weight /= weight;
  }
  return shares;
}

std::vector<Spectrum> RefinedMesh::Light(const LightReconstruction& light, KeptTransfers* transfers,
                                         int64_t* rays) const {
  std::vector<Spectrum> irradiance(points_.size());
  std::vector<int64_t> raysOfPoint(points_.size(), 0);
  const auto lightPoint = [&](int64_t p, KeptTransfers::Cursor* cursor) {
    const Point& point = points_[size_t(p)];
    irradiance[size_t(p)] =
        light.At(point.position, this->Shares(p), cursor, &raysOfPoint[size_t(p)]).At(point.normal);
  };
  transfers->ForEachPlace(int64_t(points_.size()), lightPoint);
  for (const int64_t cast : raysOfPoint) *rays += cast;
  return irradiance;
}

RadiositySolution RefinedMesh::Deliver(const std::vector<Spectrum>& irradiance) const {
  // Points.
  const TriangleMesh& input = hierarchy_->GetScene().mesh;
  RadiositySolution solution;
  TriangleMesh& mesh = solution.mesh;
  mesh.positions.resize(points_.size());
  mesh.normals.resize(points_.size());
  if (!input.uvs.empty()) mesh.uvs.resize(points_.size());
  solution.irradiance = irradiance;
  solution.radiosity.resize(points_.size());
  for (size_t p = 0; p < points_.size(); ++p) {
    const Point& point = points_[p];
    mesh.positions[p] = point.position;
    mesh.normals[p] = point.normal;
    if (!input.uvs.empty()) mesh.uvs[p] = point.uv;
    solution.radiosity[p] = point.reflectance * irradiance[p] + point.emittance;
  }

  // Faces.
  mesh.triangles = pointsOfTriangle_;
  FillFaces(input, triangles_, leaves_, &solution);

  // The input's own points take the brighter of their sides.
  solution.inputIrradiance.assign(input.positions.size(), {});
  for (size_t p = 0; p < points_.size(); ++p) {
    const int32_t vertex = VertexOf(points_[p]);
    if (vertex >= input.PointCount()) continue;
    Spectrum& brightest = solution.inputIrradiance[size_t(vertex)];
    if (Luminance(irradiance[p]) > Luminance(brightest)) brightest = irradiance[p];
  }
  return solution;
}

}  // namespace lambert
