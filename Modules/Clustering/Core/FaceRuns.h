// Runs of faces that follow each other in tree order: the points and normals that a large cluster
// reaches to, and how its points spread, are found without a look at each face.
#pragma once

#include <cstdint>
#include <vector>

#include "Clustering/Core/FaceClustering.h"
#include "Clustering/Core/PointSpread.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {

class FaceRuns {
 public:
  static constexpr int32_t kFaces = 256;  ///< of a run

  /// Of all faces of `mesh`, in tree order; kept by reference.
  explicit FaceRuns(const TriangleMesh& mesh);

  const TriangleMesh& Mesh() const { return mesh_; }
  /// Of a face, m2.
  float Area(int32_t face) const { return areas_[size_t(face)]; }

  /// A cluster as whole runs and the faces before and after them: calls visitFaces(face, end) for
  /// faces [face, end), visitRun(run) for the faces from run * kFaces on.
  template <class VisitFaces, class VisitRun>
  static void ForEachPart(const ClusterNode& node, const VisitFaces& visitFaces,
                          const VisitRun& visitRun) {
    const int32_t end = node.firstFace + node.faceCount;
    const int32_t firstRun = (node.firstFace + kFaces - 1) / kFaces, endRun = end / kFaces;
    if (firstRun >= endRun) return visitFaces(node.firstFace, end);
    visitFaces(node.firstFace, firstRun * kFaces);
    for (int32_t run = firstRun; run < endRun; ++run) visitRun(run);
    visitFaces(endRun * kFaces, end);
  }

  /// Calls visit(point) for the points of all faces of a cluster, each at least once, but for runs
  /// whose bounds (Box3f) isWithin tells to lie within what has been visited: first for one of each
  /// run, so that few of them lie farther out.
  template <class Visit, class IsWithin>
  void ForEachOuterPoint(const ClusterNode& node, const Visit& visit,
                         const IsWithin& isWithin) const {
    const auto visitFaces = [&](int32_t face, int32_t end) {
      for (; face < end; ++face) {
        for (int k = 0; k < 3; ++k) visit(mesh_.Corner(face, k));
      }
    };
    ForEachPart(node, visitFaces, [&](int32_t run) { visit(runs_[size_t(run)].points[0]); });
    const auto pass = [](int32_t, int32_t) {};
    ForEachPart(node, pass, [&](int32_t index) {
      const Run& run = runs_[size_t(index)];
      if (isWithin(run.bounds)) return;
      for (const Vec3f& point : run.points) visit(point);
    });
  }

  /// Of the corners of the faces of a cluster.
  PointSpread SpreadOf(const ClusterNode& node) const;

  /// Smallest cosine between the unit vector `axis` and the front normal of a face of a cluster;
  /// faces of up to `negligible` m2 do not count. 1 where none does.
  float LeastCosine(const ClusterNode& node, const Vec3f& axis, float negligible) const;

 private:
  struct Run {
    std::vector<Vec3f> points;  ///< few of them twice
    Box3f bounds;
    Vec3f axis;         ///< unit, among its normals; zero where they turn to all sides
    float cosine = -1;  ///< of the largest angle between the axis and one of them
    PointSpread spread;
  };
  static Run MakeRun(const TriangleMesh& mesh, int64_t face, int64_t end);
  static float LeastCosine(const Run& run, const Vec3f& axis);

  const TriangleMesh& mesh_;
  std::vector<float> areas_;
  std::vector<Run> runs_;
};

}  // namespace lambert
