#include "Radiosity/Core/RefinedMesh.h"

#include <algorithm>
#include <array>

#include "Common/Core/Parallel.h"

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
  }

  int32_t operator()(const LeafTriangle& triangle) const {
    const size_t patch = size_t(std::max(0, triangle.patch));
    if (triangle.patch >= 0 && patch < ofPatch.size() && ofPatch[patch] >= 0) return ofPatch[patch];
    return ofFace[triangle.side][size_t(triangle.face)];
  }
};

/// A corner of a leaf triangle, by the output point that it becomes: one per vertex, surface and
/// side.
struct Corner {
  uint64_t key;
  int32_t triangle;
  int32_t corner;
  bool operator<(const Corner& c) const {
    return key != c.key             ? key < c.key
           : triangle != c.triangle ? triangle < c.triangle
                                    : corner < c.corner;
  }
};

std::vector<Corner> SortedCorners(const std::vector<LeafTriangle>& triangles,
                                  const std::vector<int32_t>& surfaceId) {
  std::vector<Corner> corners(triangles.size() * 3);
  ParallelForEach(int64_t(triangles.size()), 4096, [&](int64_t t) {
    const LeafTriangle& triangle = triangles[size_t(t)];
    const uint64_t surfaceSide = 2 * uint64_t(surfaceId[size_t(triangle.face)]) + triangle.side;
    for (int c = 0; c < 3; ++c) {
      corners[size_t(3 * t + c)] = {(surfaceSide << 32) | uint32_t(triangle.vertices[size_t(c)]),
                                    int32_t(t), c};
    }
  });
  std::sort(corners.begin(), corners.end());
  return corners;
}

struct Range {
  int64_t begin, end;
};

/// Corners of the same point, points in the order in which triangles first name them: vertex
/// numbers depend on when the leaves were triangulated before, this order does not.
std::vector<Range> PointGroups(const std::vector<Corner>& corners) {
  std::vector<Range> groups;
  for (size_t i = 0; i < corners.size(); ++i) {
    if (i > 0 && corners[i].key == corners[i - 1].key) {
      groups.back().end = int64_t(i) + 1;
    } else {
      groups.push_back({int64_t(i), int64_t(i) + 1});
    }
  }
  std::sort(groups.begin(), groups.end(), [&](const Range& a, const Range& b) {
    const Corner &first = corners[size_t(a.begin)], &second = corners[size_t(b.begin)];
    return first.triangle != second.triangle ? first.triangle < second.triangle
                                             : first.corner < second.corner;
  });
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

int32_t VertexOf(const std::vector<Corner>& corners, const Range& group) {
  return int32_t(corners[size_t(group.begin)].key & 0xffffffffu);
}

/// What meets at an output point: leaves by angle, and the means that the point carries.
struct Meeting {
  std::vector<LightReconstruction::Share> shares;
  Vec3f faceNormal;  ///< not normalized
  Spectrum reflectance, emittance;
};

Meeting MeetAt(int32_t vertex, const Range& group, const std::vector<Corner>& corners,
               const std::vector<LeafTriangle>& triangles, const std::vector<int32_t>& leaves,
               const TriangleMesh& input, const VertexReader& vertices) {
  Meeting meeting;
  float total = 0, weight = 0;
  const Vec3f position = vertices.Position(vertex);
  for (int64_t i = group.begin; i < group.end; ++i) {
    // The corner's angle, and what its face adds to the means.
    const Corner& corner = corners[size_t(i)];
    const LeafTriangle& triangle = triangles[size_t(corner.triangle)];
    const Vec3f a = vertices.Position(triangle.vertices[size_t(corner.corner + 1) % 3]);
    const Vec3f b = vertices.Position(triangle.vertices[size_t(corner.corner + 2) % 3]);
    const float angle = std::max(1e-6f, CornerAngle(position, a, b));
    const Vec3f n = input.FrontNormal(triangle.face) * (triangle.side == kBack ? -1.f : 1.f);
    meeting.faceNormal += n * angle;
    meeting.reflectance += input.reflectance[size_t(triangle.face)] * angle;
    if (input.Emits(triangle.face, Side(triangle.side))) {
      meeting.emittance += input.emittance[size_t(triangle.face)] * angle;
    }
    total += angle;

    // Its leaf's share.
    const int32_t leaf = leaves[size_t(corner.triangle)];
    if (leaf < 0) continue;
    const Vec3f inside = (position + a + b) / 3.f;
    auto same = std::find_if(meeting.shares.begin(), meeting.shares.end(),
                             [&](const LightReconstruction::Share& s) { return s.leaf == leaf; });
    if (same == meeting.shares.end()) same = meeting.shares.insert(same, {leaf, 0.f, Vec3f()});
    same->weight += angle;
    same->inside += inside * angle;
    weight += angle;
  }
  for (LightReconstruction::Share& share : meeting.shares) {
    share.inside /= share.weight;
    share.weight /= weight;
  }
  meeting.reflectance *= 1 / total;
  meeting.emittance *= 1 / total;
  return meeting;
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

RadiositySolution MakeRefinedMesh(ElementHierarchy* hierarchy, const LightReconstruction& light,
                                  const std::vector<uint8_t>& litSides, int64_t* rays) {
  // Triangles of all modelled sides.
  const TriangleMesh& input = hierarchy->GetScene().mesh;
  std::vector<uint8_t> faceSides(input.triangles.size());
  for (size_t face = 0; face < faceSides.size(); ++face) {
    const uint8_t sides = litSides[size_t(input.surfaceId[face])];
    faceSides[face] = sides ? sides : uint8_t(1);
  }
  const std::vector<LeafTriangle> triangles = hierarchy->Leaves().Triangulate(faceSides);
  const LeafIndex leafIndex(*hierarchy);
  std::vector<int32_t> leaves(triangles.size());
  for (size_t t = 0; t < triangles.size(); ++t) leaves[t] = leafIndex(triangles[t]);

  // Points: corners that agree in vertex, surface and side.
  const std::vector<Corner> corners = SortedCorners(triangles, input.surfaceId);
  const std::vector<Range> groups = PointGroups(corners);
  const int64_t points = int64_t(groups.size());

  RadiositySolution solution;
  solution.mesh.positions.resize(size_t(points));
  solution.mesh.normals.resize(size_t(points));
  if (!input.uvs.empty()) solution.mesh.uvs.resize(size_t(points));
  solution.mesh.triangles.resize(triangles.size());
  solution.irradiance.resize(size_t(points));
  solution.radiosity.resize(size_t(points));
  const VertexReader vertices{input, hierarchy->Leaves().Vertices()};
  std::vector<int64_t> raysOfPoint(size_t(points), 0);

  // Light at each point: mean over the leaves that meet there, by angle.
  ParallelForEach(points, 64, [&](int64_t point) {
    const Range& group = groups[size_t(point)];
    for (int64_t i = group.begin; i < group.end; ++i) {
      const Corner& corner = corners[size_t(i)];
      solution.mesh.triangles[size_t(corner.triangle)][size_t(corner.corner)] = int32_t(point);
    }
    const int32_t vertex = VertexOf(corners, group);
    const Meeting meeting = MeetAt(vertex, group, corners, triangles, leaves, input, vertices);
    Vec3f normal = Normalize(vertices.Interpolate(input.normals, vertex));
    if (Dot(normal, meeting.faceNormal) < 0) normal = -normal;
    const size_t p = size_t(point);
    solution.mesh.positions[p] = vertices.Position(vertex);
    solution.mesh.normals[p] = normal;
    if (!input.uvs.empty()) solution.mesh.uvs[p] = vertices.Interpolate(input.uvs, vertex);
    solution.irradiance[p] =
        light.At(solution.mesh.positions[p], meeting.shares, &raysOfPoint[p]).At(normal);
    solution.radiosity[p] = meeting.reflectance * solution.irradiance[p] + meeting.emittance;
  });
  for (const int64_t cast : raysOfPoint) *rays += cast;
  FillFaces(input, triangles, leaves, &solution);

  // The input's own points take the brighter of their sides.
  solution.inputIrradiance.assign(input.positions.size(), {});
  for (int64_t point = 0; point < points; ++point) {
    const int32_t vertex = VertexOf(corners, groups[size_t(point)]);
    if (vertex >= input.PointCount()) continue;
    Spectrum& brightest = solution.inputIrradiance[size_t(vertex)];
    const Spectrum& here = solution.irradiance[size_t(point)];
    if (Luminance(here) > Luminance(brightest)) brightest = here;
  }
  return solution;
}

}  // namespace lambert
