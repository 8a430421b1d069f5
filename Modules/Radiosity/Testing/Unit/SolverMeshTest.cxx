// The mesh that the solver delivers: no point inside another triangle's edge, and patches of good
// shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "Clustering/Core/ClusterFrame.h"
#include "SolverScenes.h"

namespace lambert {
namespace {

using testing::SolvedScene;
using testing::SolveScene;

using Key = std::array<uint32_t, 3>;  ///< bits of a position; points are one where these agree
using Edge = std::pair<Key, Key>;     ///< unordered

Key KeyOf(const Vec3f& p) {
  const float coordinates[3] = {p.x + 0.f, p.y + 0.f, p.z + 0.f};  // -0 is 0
  Key key;
  std::memcpy(key.data(), coordinates, sizeof(coordinates));
  return key;
}
Vec3f PositionOf(const Key& key) {
  float p[3];
  std::memcpy(p, key.data(), sizeof(p));
  return {p[0], p[1], p[2]};
}
Edge EdgeOf(const Vec3f& a, const Vec3f& b) { return std::minmax(KeyOf(a), KeyOf(b)); }

/// Whether `p` lies in the segment's inside: collinear within 1e-6 of its length, or within the
/// rounding of its coordinates where the edge is short.
bool IsInside(const Edge& edge, const Key& key) {
  if (key == edge.first || key == edge.second) return false;
  const Vec3d a(PositionOf(edge.first)), b(PositionOf(edge.second)), p(PositionOf(key));
  const Vec3d along = b - a;
  const double length = Length(along), t = Dot(p - a, along) / (length * length);
  if (!(length > 0) || t <= 0 || t >= 1) return false;
  const double coordinate =
      std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z), std::fabs(a.x), std::fabs(a.y),
                std::fabs(a.z), std::fabs(b.x), std::fabs(b.y), std::fabs(b.z)});
  return Length(Cross(p - a, along)) / length <= std::max(1e-6 * length, 0x1p-23 * coordinate);
}

/// What is drawn of one side of one input face.
struct DrawnSide {
  std::set<Key> points;
  std::map<Edge, int> edges;  ///< how many of its triangles have it
};

/// Edges that contain one of `points`; both lie in one plane, points are sorted along its longer
/// way.
int64_t PointsInsideEdges(const std::map<Edge, int>& edges, const std::set<Key>& points) {
  Box3f box;
  for (const Key& key : points) box.Include(PositionOf(key));
  const Vec3f extent = box.Extent();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  std::vector<std::pair<float, Key>> sorted;
  for (const Key& key : points) sorted.emplace_back(PositionOf(key)[axis], key);
  std::sort(sorted.begin(), sorted.end());
  const float slack = 1e-6f * box.Diagonal();
  int64_t inside = 0;
  for (const auto& [edge, uses] : edges) {
    const auto [low, high] =
        std::minmax(PositionOf(edge.first)[axis], PositionOf(edge.second)[axis]);
    auto at = std::lower_bound(sorted.begin(), sorted.end(), std::pair(low - slack, Key{}));
    for (; at != sorted.end() && at->first <= high + slack; ++at)
      inside += IsInside(edge, at->second);
  }
  return inside;
}

/// Points of the drawn mesh strictly inside edges of its triangles. Points count against the
/// triangles of their own side of their face, and of all faces that share the input edge that they
/// lie on; edges are shared where the positions of their ends are the same. Objects that touch
/// without sharing an edge in the input are two objects: what one's points do to the other's edges
/// is not looked at.
int64_t CountTVertices(const SolvedScene& solved) {
  const TriangleMesh& input = solved.scene.mesh;
  const TriangleMesh& drawn = solved.solution.mesh;
  std::map<std::pair<int64_t, uint8_t>, DrawnSide> sides;
  for (int64_t t = 0; t < drawn.FaceCount(); ++t) {
    DrawnSide& side =
        sides[{solved.solution.inputFaceId[size_t(t)], solved.solution.side[size_t(t)]}];
    for (int corner = 0; corner < 3; ++corner) {
      side.points.insert(KeyOf(drawn.Corner(t, corner)));
      ++side.edges[EdgeOf(drawn.Corner(t, corner), drawn.Corner(t, (corner + 1) % 3))];
    }
  }

  // The points on each input edge, from all that meet there.
  std::map<Edge, std::set<Key>> onEdge;
  const auto inputEdge = [&](int64_t face, int corner) {
    return EdgeOf(input.Corner(face, corner), input.Corner(face, (corner + 1) % 3));
  };
  for (const auto& [place, side] : sides) {
    for (int corner = 0; corner < 3; ++corner) {
      const Edge edge = inputEdge(place.first, corner);
      for (const auto& [drawnEdge, uses] : side.edges) {
        if (uses != 1) continue;
        for (const Key& key : {drawnEdge.first, drawnEdge.second}) {
          if (IsInside(edge, key)) onEdge[edge].insert(key);
        }
      }
    }
  }

  // Each side against its own points and those.
  int64_t count = 0;
  for (const auto& [place, side] : sides) {
    std::set<Key> points = side.points;
    for (int corner = 0; corner < 3; ++corner) {
      const auto found = onEdge.find(inputEdge(place.first, corner));
      if (found != onEdge.end()) points.insert(found->second.begin(), found->second.end());
    }
    count += PointsInsideEdges(side.edges, points);
  }
  return count;
}

class DrawnMeshTest : public ::testing::TestWithParam<const char*> {};

TEST_P(DrawnMeshTest, NoPointLiesInsideAnEdge) {
  SolvedScene solved = SolveScene(testing::DataScene(GetParam()), 0.2);
  ASSERT_GT(solved.statistics.patchElements, 500);
  EXPECT_EQ(CountTVertices(solved), 0);

  // The count sees them: a triangle whose longest edge is cut for the neighbours alone.
  TriangleMesh& mesh = solved.solution.mesh;
  const Vec3f a = mesh.Corner(0, 0), b = mesh.Corner(0, 1), c = mesh.Corner(0, 2);
  const int32_t middle = testing::AddPoint(&mesh, (a + b) * 0.5f, mesh.FrontNormal(0));
  testing::AddPoint(&mesh, (a + b + c) / 3.f, mesh.FrontNormal(0));
  testing::AddFace(&mesh, {mesh.triangles[0][0], middle, middle + 1}, Spectrum(0.f), Spectrum(0.f));
  solved.solution.inputFaceId.push_back(solved.solution.inputFaceId[0]);
  solved.solution.side.push_back(solved.solution.side[0]);
  EXPECT_GT(CountTVertices(solved), 0);
}
INSTANTIATE_TEST_SUITE_P(Scenes, DrawnMeshTest, ::testing::Values("CornellBox", "Sliver"));

/// Longer over shorter side of the smallest rectangle about points of a plane with normal `n`.
double Aspect(const std::vector<Vec3f>& points, const Vec3f& n) {
  Vec3f u, v;
  CoordinateSystem(n, &u, &v);
  std::vector<Vec2f> flat;
  for (const Vec3f& p : points) flat.push_back({Dot(p - points[0], u), Dot(p - points[0], v)});
  const Vec2f half = MinimumAreaRectangle(flat).halfExtent;
  return double(half.x) / std::max(double(half.y), 1e-30);
}

// A panel over a floor, and a lamp close over its back. What emits does not count in the error on
// either side: its back is left as links cut it.
TEST(SolverMesh, FacesThatEmitAreNotCut) {
  const auto onPanel = [](float exitance) {
    Scene scene;
    testing::AddQuad(&scene.mesh, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, Spectrum(0.5f));
    testing::AddQuad(&scene.mesh, {-0.5f, -0.5f, 1}, {0, 1, 0}, {1, 0, 0}, Spectrum(0.f),
                     Spectrum(exitance), 1, 1);
    testing::AddQuad(&scene.mesh, {0, 0, 1.02f}, {0, 0.02f, 0}, {0.02f, 0, 0}, Spectrum(0.f),
                     Spectrum(1000.f), 2, 2);
    testing::CompleteTables(&scene);
    const SolvedScene solved = SolveScene(scene, 0.1);
    int64_t count = 0;
    for (const int64_t face : solved.solution.inputFaceId) {
      count += solved.scene.mesh.materialId[size_t(face)] == 1;
    }
    return count;
  };
  EXPECT_GT(onPanel(0), 50 * onPanel(1));
}

// One right-angled sliver, 1 m by 1 mm, and half a millimetre over it a lamp as long: near light
// asks for patches as small as the sliver is wide, everywhere along it. Elements are not split
// below a thousandth of their surface, which is that width.
TEST(SolverMesh, SliversEndInPatchesOfGoodShape) {
  Scene scene;
  testing::AddTriangle(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1e-3f, 0}, Spectrum(0.5f));
  testing::AddQuad(&scene.mesh, {0, 0, 5e-4f}, {0, 1e-3f, 0}, {1, 0, 0}, Spectrum(0.f),
                   Spectrum(100.f), 1, 1);
  testing::CompleteTables(&scene);
  const SolvedScene solved = SolveScene(scene, 0.02);
  const RadiositySolution& solution = solved.solution;

  // Leaves of the sliver's front, by their points.
  struct Leaf {
    std::vector<Vec3f> points;
    double area = 0, begin = 1;
  };
  std::map<int64_t, Leaf> leaves;
  for (int64_t t = 0; t < solution.mesh.FaceCount(); ++t) {
    if (solved.scene.mesh.materialId[size_t(solution.inputFaceId[size_t(t)])] != 0) continue;
    if (solution.side[size_t(t)] != kFront) continue;
    Leaf& leaf = leaves[solution.leafId[size_t(t)]];
    leaf.area += double(solution.mesh.Area(t));
    for (int k = 0; k < 3; ++k) {
      leaf.points.push_back(solution.mesh.Corner(t, k));
      leaf.begin = std::min(leaf.begin, double(solution.mesh.Corner(t, k).x));
    }
  }
  double total = 0, bad = 0, largest = 0;
  int64_t patches = 0;
  for (const auto& [id, leaf] : leaves) {
    const double aspect = Aspect(leaf.points, {0, 0, 1});
    total += leaf.area;
    if (aspect < 4) {
      ++patches;
    } else {
      bad += leaf.area;
      largest = std::max(largest, 1 - leaf.begin);
    }
  }
  RecordProperty("patches", std::to_string(patches));
  EXPECT_GT(patches, 100);
  EXPECT_LT(bad, 0.01 * total) << "up to " << largest << " m from the tip, of " << leaves.size()
                               << " patches";
}

}  // namespace
}  // namespace lambert
