// The triangles that are drawn: patches, and whole faces with the points that their neighbours put
// on their edges.
#include <numeric>
#include <string>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Radiosity/Core/LeafMeshImplementation.h"
#include "Radiosity/Core/PatchTriangulation.h"

namespace lambert {

namespace {

constexpr int64_t kBlock = 8192;  // Faces that one thread emits at a time.

bool IsLit(const std::vector<uint8_t>& litSides, int32_t face, Side side) {
  return (litSides[size_t(face)] & (1 << side)) != 0;
}

}  // namespace

std::vector<LeafTriangle> LeafMesh::Implementation::Triangulate(
    const std::vector<uint8_t>& litSides) {
  if (litSides.size() != mesh.triangles.size()) {
    throw Error("The lit sides have " + std::to_string(litSides.size()) +
                " entries where the mesh has " + std::to_string(mesh.triangles.size()) +
                " faces; give one entry a face.");
  }
  TriangulatePatches(litSides);

  // Find the whole faces with points on their edges, and triangulate those.
  const int64_t faceCount = mesh.FaceCount(), blocks = (faceCount + kBlock - 1) / kBlock;
  std::vector<uint8_t> hasPoints(size_t(faceCount), 0);
  std::vector<std::vector<int32_t>> changed(static_cast<size_t>(blocks));
  ParallelForEach(blocks, 1, [&](int64_t block) {
    const int64_t end = std::min(faceCount, (block + 1) * kBlock);
    for (int32_t face = int32_t(block * kBlock); face < end; ++face) {
      const bool isWhole = (IsLit(litSides, face, kFront) && !IsSplit(face, kFront)) ||
                           (IsLit(litSides, face, kBack) && !IsSplit(face, kBack));
      const size_t points = isWhole ? PointsOnEdges(face) : 0;
      if (points == 0) continue;
      hasPoints[size_t(face)] = 1;
      const auto known = wholeFaces.find(face);
      if (known == wholeFaces.end() || known->second.size() != points + 1) {
        changed[size_t(block)].push_back(face);
      }
    }
  });
  for (const std::vector<int32_t>& faces : changed) TriangulateWholeFaces(faces);

  // Emit in the order of the faces: count, then fill.
  std::vector<size_t> first(size_t(blocks) + 1, 0);
  std::vector<LeafTriangle> triangles;
  const auto emit = [&](int64_t block, LeafTriangle* out) {
    size_t count = 0;
    const int64_t end = std::min(faceCount, (block + 1) * kBlock);
    for (int32_t face = int32_t(block * kBlock); face < end; ++face) {
      for (const Side side : {kFront, kBack}) {
        if (!IsLit(litSides, face, side)) continue;
        count += AppendTriangles(face, side, hasPoints[size_t(face)] != 0, out ? out + count : out);
      }
    }
    return count;
  };
  ParallelForEach(blocks, 1, [&](int64_t b) { first[size_t(b) + 1] = emit(b, nullptr); });
  std::partial_sum(first.begin(), first.end(), first.begin());
  triangles.resize(first.back());
  ParallelForEach(blocks, 1, [&](int64_t b) { emit(b, triangles.data() + first[size_t(b)]); });
  return triangles;
}

// Triangulates the leaf patches of lit sides whose border has changed.
void LeafMesh::Implementation::TriangulatePatches(const std::vector<uint8_t>& litSides) {
  std::vector<Patch*> changed;
  for (Patch& patch : patches) {
    const bool isChanged = patch.meshFace >= 0 && patch.triangles.empty();
    if (isChanged && IsLit(litSides, patch.face, patch.side)) changed.push_back(&patch);
  }
  ParallelForEach(int64_t(changed.size()), 64, [&](int64_t i) {
    Patch& patch = *changed[size_t(i)];
    Border border;
    BorderOf(patch, &border);
    patch.triangles = TriangulatePatch(border.polygon);
    for (auto& triangle : patch.triangles) {
      for (int32_t& v : triangle) v = meshVertices[size_t(border.vertices[size_t(v)])].number;
    }
  });
}

size_t LeafMesh::Implementation::PointsOnEdges(int32_t face) const {
  size_t points = 0;
  for (int corner = 0; corner < 3; ++corner) {
    const int32_t edge = edges.Find(face, corner).edge;
    if (edge >= 0) points += edges.Points(edge).size();
  }
  return points;
}

void LeafMesh::Implementation::TriangulateWholeFaces(const std::vector<int32_t>& faces) {
  // Collect the borders; this names vertices, so it goes one by one.
  std::vector<std::vector<PatchBorderVertex>> borders(faces.size());
  std::vector<std::vector<int32_t>> numbers(faces.size());
  std::vector<Triangles*> results(faces.size());
  for (size_t i = 0; i < faces.size(); ++i) {
    const int32_t face = faces[i];
    results[i] = &wholeFaces[face];
    const auto flat = FlattenTriangle(Vec3d(mesh.Corner(face, 0)), Vec3d(mesh.Corner(face, 1)),
                                      Vec3d(mesh.Corner(face, 2)));
    for (int corner = 0; corner < 3; ++corner) {
      const Vec2d from = flat[size_t(corner)], to = flat[size_t((corner + 1) % 3)];
      borders[i].push_back({from, true});
      numbers[i].push_back(mesh.triangles[size_t(face)][size_t(corner)]);
      if (edges.Find(face, corner).edge < 0) continue;
      const LeafMeshEdges::FaceEdge found = edges.FindOrAdd(face, corner);
      const std::vector<double>& points = edges.Points(found.edge);
      for (size_t k = 0; k < points.size(); ++k) {
        const size_t index = found.isForward ? k : points.size() - 1 - k;
        const double t = found.isForward ? points[index] : 1 - points[index];
        borders[i].push_back({from * (1 - t) + to * t, false});
        numbers[i].push_back(edges.VertexNumber(found.edge, found.name, int32_t(index)));
      }
    }
  }
  ParallelForEach(int64_t(faces.size()), 64, [&](int64_t i) {
    Triangles& triangles = *results[size_t(i)];
    triangles = TriangulatePatch(borders[size_t(i)]);
    for (auto& triangle : triangles) {
      for (int32_t& v : triangle) v = numbers[size_t(i)][size_t(v)];
    }
  });
}

// Writes the triangles of one side of a face where `out` is given; returns how many they are.
size_t LeafMesh::Implementation::AppendTriangles(int32_t face, Side side, bool hasPoints,
                                                 LeafTriangle* out) const {
  const int32_t patch = facePatch[size_t(face) * 2 + side];
  if (IsSplit(face, side)) return AppendLeaves(patch, out);
  if (!hasPoints) {
    if (out) *out = {mesh.triangles[size_t(face)], face, side, patch};
    return 1;
  }
  const Triangles& triangles = wholeFaces.at(face);
  if (out) {
    for (const auto& vertices : triangles) *out++ = {vertices, face, side, patch};
  }
  return triangles.size();
}

size_t LeafMesh::Implementation::AppendLeaves(int32_t id, LeafTriangle* out) const {
  const Patch& patch = patches[size_t(id)];
  if (patch.firstPart >= 0) {
    size_t count = 0;
    for (int32_t part = 0; part < patch.partCount; ++part) {
      count += AppendLeaves(patch.firstPart + part, out ? out + count : out);
    }
    return count;
  }
  if (out) {
    for (const auto& vertices : patch.triangles) *out++ = {vertices, patch.face, patch.side, id};
  }
  return patch.triangles.size();
}

}  // namespace lambert
