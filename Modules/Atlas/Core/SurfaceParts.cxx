#include "Atlas/Core/SurfaceParts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Atlas/Core/ChartMesh.h"
#include "Atlas/Core/LightMapSeams.h"

namespace lambert {
namespace {

/// Of the area of a surface, the least that a part has: borders cost texels, too.
constexpr float kLeastPart = 1.f / 32;

/// Cuts one surface.
class Cutter {
 public:
  /// `introduced` has the triangles that refinement added before each face.
  Cutter(const ClusterTree& tree, const std::vector<int64_t>& introduced, int32_t root)
      : tree_(tree), introduced_(introduced), least_(kLeastPart * tree.nodes[size_t(root)].area) {}

  /// The nodes of its parts, in the order of their faces.
  std::vector<int32_t> PartsOf(int32_t node) const {
    const ClusterNode& cluster = tree_.nodes[size_t(node)];
    if (!this->WasRefined(cluster) || cluster.child < 0) return {node};
    std::vector<int32_t> parts;
    bool areAllRefined = true;
    for (int32_t child : {cluster.child, cluster.child + 1}) {
      const bool isSmall = tree_.nodes[size_t(child)].area < least_;
      const std::vector<int32_t> below =
          isSmall ? std::vector<int32_t>{child} : this->PartsOf(child);
      for (const int32_t part : below) {
        areAllRefined &= isSmall || this->WasRefined(tree_.nodes[size_t(part)]);
      }
      parts.insert(parts.end(), below.begin(), below.end());
    }
    if (areAllRefined) return {node};
    return parts;
  }

 private:
  bool WasRefined(const ClusterNode& cluster) const {
    return introduced_[size_t(cluster.firstFace + cluster.faceCount)] >
           introduced_[size_t(cluster.firstFace)];
  }

  const ClusterTree& tree_;
  const std::vector<int64_t>& introduced_;
  const float least_;
};

/// Puts a cluster with all below it behind `to`, as a surface.
void AppendCluster(const ClusterTree& tree, int32_t node, ClusterTree* to) {
  const size_t root = to->nodes.size();
  to->surfaceRoots.push_back(int32_t(root));
  to->nodes.push_back(tree.nodes[size_t(node)]);
  to->nodes[root].parent = -1;
  for (size_t next = root; next < to->nodes.size(); ++next) {
    const int32_t child = to->nodes[next].child;
    if (child < 0) continue;
    to->nodes[next].child = int32_t(to->nodes.size());
    for (const int32_t c : {child, child + 1}) {
      to->nodes.push_back(tree.nodes[size_t(c)]);
      to->nodes.back().parent = int32_t(next);
    }
  }
}

/// Makes clusters of `tree`, those of a surface, the next parts.
void AppendParts(const ClusterTree& tree, const std::vector<int32_t>& nodes, int32_t surface,
                 SurfaceParts* parts) {
  for (const int32_t node : nodes) {
    const ClusterNode& cluster = tree.nodes[size_t(node)];
    std::fill_n(parts->partOfFace.begin() + cluster.firstFace, cluster.faceCount,
                int32_t(parts->surfaceOfPart.size()));
    parts->surfaceOfPart.push_back(surface);
    AppendCluster(tree, node, &parts->tree);
  }
}

/// The light of a solution at a place on a face, by the triangle there that holds it, or comes
/// closest to that.
class LightOnFaces {
 public:
  LightOnFaces(const RadiositySolution& solution, int64_t faces) : solution_(solution) {
    first_.assign(size_t(faces) + 1, 0);
    for (const int64_t face : solution.inputFaceId) ++first_[size_t(face) + 1];
    for (size_t f = 0; f < size_t(faces); ++f) first_[f + 1] += first_[f];
    triangles_.resize(solution.inputFaceId.size());
    std::vector<size_t> next(first_.begin(), first_.end() - 1);
    for (size_t t = 0; t < solution.inputFaceId.size(); ++t) {
      triangles_[next[size_t(solution.inputFaceId[t])]++] = t;
    }
  }
  Spectrum At(size_t face, const Vec3f& place) const {
    Spectrum light;
    float most = -std::numeric_limits<float>::max();
    for (size_t i = first_[face]; i < first_[face + 1]; ++i) {
      const size_t t = triangles_[i];
      const auto w = WeightsInFace(solution_.mesh, int64_t(t), place);
      const float least = std::min({w[0], w[1], w[2]});
      if (!(least > most)) continue;
      most = least;
      light = Spectrum();
      for (size_t c = 0; c < 3; ++c) {
        light += solution_.irradiance[size_t(solution_.mesh.triangles[t][c])] *
                 std::min(1.f, std::max(0.f, w[c]));
      }
    }
    return light;
  }

 private:
  const RadiositySolution& solution_;
  std::vector<size_t> first_, triangles_;  ///< by face, those on it
};

}  // namespace

SurfaceParts CutWhereRefined(const TriangleMesh& mesh, const ClusterTree& tree,
                             const RadiositySolution& solution, const std::vector<bool>& mayBeCut) {
  // Triangles that refinement added, summed up over the faces.
  std::vector<int64_t> introduced(mesh.triangles.size() + 1, 0);
  for (const int64_t face : solution.inputFaceId) ++introduced[size_t(face) + 1];
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    introduced[face + 1] = introduced[face] + std::max<int64_t>(0, introduced[face + 1] - 1);
  }

  SurfaceParts parts;
  parts.partOfFace.resize(mesh.triangles.size());
  for (size_t surface = 0; surface < tree.surfaceRoots.size(); ++surface) {
    const int32_t root = tree.surfaceRoots[surface];
    const std::vector<int32_t> nodes = mayBeCut[surface]
                                           ? Cutter(tree, introduced, root).PartsOf(root)
                                           : std::vector<int32_t>{root};
    AppendParts(tree, nodes, int32_t(surface), &parts);
  }
  return parts;
}

SurfaceParts CutWhereLaid(const SurfaceParts& parts, const std::vector<int64_t>& laidFaces) {
  std::vector<int32_t> laid(laidFaces.size() + 1, 0);  // Before each face.
  for (size_t face = 0; face < laidFaces.size(); ++face) {
    laid[face + 1] = laid[face] + (laidFaces[face] >= 0);
  }
  SurfaceParts cut;
  cut.partOfFace.resize(parts.partOfFace.size());
  for (size_t part = 0; part < parts.surfaceOfPart.size(); ++part) {
    std::vector<int32_t> nodes, open = {parts.tree.surfaceRoots[part]};
    while (!open.empty()) {
      const int32_t node = open.back();
      open.pop_back();
      const ClusterNode& cluster = parts.tree.nodes[size_t(node)];
      const int32_t count =
          laid[size_t(cluster.firstFace + cluster.faceCount)] - laid[size_t(cluster.firstFace)];
      if (count == 0 || count == cluster.faceCount) {
        nodes.push_back(node);
      } else {
        open.push_back(cluster.child + 1);
        open.push_back(cluster.child);
      }
    }
    AppendParts(parts.tree, nodes, parts.surfaceOfPart[part], &cut);
  }
  return cut;
}

std::vector<BorderPoint> FindBorders(const TriangleMesh& mesh, const RadiositySolution& solution,
                                     const SurfaceSubset& mapped, const RadiosityAtlas& atlas) {
  std::vector<int64_t> mappedFace(mesh.triangles.size(), -1);
  for (size_t i = 0; i < mapped.inputFace.size(); ++i) {
    mappedFace[size_t(mapped.inputFace[i])] = int64_t(i);
  }
  const std::vector<int32_t> chartOfFace = ChartOfFace(atlas.set);
  const LightOnFaces light(solution, mesh.FaceCount());
  std::vector<BorderPoint> borders;
  ForEachSharedEdge(mesh, FindNeighbours(mesh), [&](const SharedEdge& edge) {
    // Mapped on one side alone.
    const size_t in = mappedFace[edge.faces[0]] >= 0 ? 0 : 1, out = 1 - in;
    const int64_t face = mappedFace[edge.faces[in]];
    if (face < 0 || mappedFace[edge.faces[out]] >= 0) return;
    const auto& corners = atlas.textureCoords[size_t(face)];
    const Vec2f from = corners[edge.from[in]], to = corners[edge.to[in]];
    const Vec3f begin = mesh.Corner(int64_t(edge.faces[in]), int(edge.from[in]));
    const Vec3f end = mesh.Corner(int64_t(edge.faces[in]), int(edge.to[in]));

    // What the other side shows along it.
    const float length = std::hypot(to.x - from.x, to.y - from.y) * float(atlas.pageSize);
    ForEachPlaceAlong(length, [&](float part, bool isClosed) {
      borders.push_back({atlas.pageOfChart[size_t(chartOfFace[size_t(face)])],
                         from + (to - from) * part,
                         light.At(edge.faces[out], begin + (end - begin) * part), isClosed});
    });
  });
  return borders;
}

}  // namespace lambert
