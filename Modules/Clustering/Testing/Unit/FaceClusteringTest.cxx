#include "Clustering/Core/FaceClustering.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <set>

#include "Clustering/Core/ClusterCut.h"
#include "ClusteringMeshes.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {
namespace {

std::vector<Part> OnePart() { return std::vector<Part>(1); }

struct Clustered {
  TriangleMesh mesh;
  ClusterTree tree;
  FaceClusteringStatistics statistics;
};

Clustered Cluster(TriangleMesh mesh, const std::vector<Part>& parts = OnePart(),
                  double balance = 0.01) {
  Clustered result;
  result.mesh = std::move(mesh);
  FaceClusteringOptions options;
  options.balance = balance;
  result.tree = ClusterFaces(&result.mesh, parts, options, &result.statistics);
  return result;
}

/// Depth of every node, from its parent, which stands before it.
std::vector<int> Depths(const ClusterTree& tree) {
  std::vector<int> depth(tree.nodes.size(), 0);
  for (size_t i = 0; i < tree.nodes.size(); ++i) {
    if (tree.nodes[i].parent >= 0) depth[i] = 1 + depth[size_t(tree.nodes[i].parent)];
  }
  return depth;
}

void CheckNodes(const Clustered& c) {
  const auto& nodes = c.tree.nodes;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const ClusterNode& node = nodes[i];
    ASSERT_TRUE(std::isfinite(node.area) && IsFinite(node.vectorArea));
    ASSERT_TRUE(IsFinite(node.bounds.low) && IsFinite(node.bounds.high));
    ASSERT_GE(node.faceCount, 1);
    ASSERT_LT(node.parent, int32_t(i));
    if (node.child < 0) {
      ASSERT_EQ(node.faceCount, 1);
      ASSERT_EQ(node.vectorArea, c.mesh.VectorArea(node.firstFace));
      ASSERT_EQ(node.area, c.mesh.Area(node.firstFace));
      for (int k = 0; k < 3; ++k) {
        Box3f grown = node.bounds;
        grown.Include(c.mesh.Corner(node.firstFace, k));
        ASSERT_EQ(grown.low, node.bounds.low);
        ASSERT_EQ(grown.high, node.bounds.high);
      }
      continue;
    }
    ASSERT_GT(node.child, int32_t(i));
    const ClusterNode &a = nodes[size_t(node.child)], &b = nodes[size_t(node.child) + 1];
    ASSERT_EQ(a.parent, int32_t(i));
    ASSERT_EQ(b.parent, int32_t(i));
    ASSERT_EQ(a.firstFace, node.firstFace);
    ASSERT_EQ(b.firstFace, a.firstFace + a.faceCount);
    ASSERT_EQ(a.faceCount + b.faceCount, node.faceCount);
    ASSERT_EQ(node.area, a.area + b.area);
    ASSERT_EQ(node.vectorArea, a.vectorArea + b.vectorArea);
    ASSERT_EQ(node.bounds.low, Min(a.bounds.low, b.bounds.low));
    ASSERT_EQ(node.bounds.high, Max(a.bounds.high, b.bounds.high));
  }
}

void CheckSurfaces(const Clustered& c) {
  int32_t nextNode = 0, nextFace = 0;
  for (size_t surface = 0; surface < c.tree.surfaceRoots.size(); ++surface) {
    const int32_t root = c.tree.surfaceRoots[surface];
    ASSERT_EQ(root, nextNode);
    const ClusterNode& node = c.tree.nodes[size_t(root)];
    ASSERT_EQ(node.parent, -1);
    ASSERT_EQ(node.firstFace, nextFace);
    for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
      ASSERT_EQ(c.mesh.surfaceId[size_t(face)], int32_t(surface));
      ASSERT_EQ(c.mesh.materialId[size_t(face)], c.mesh.materialId[size_t(node.firstFace)]);
      ASSERT_EQ(c.mesh.partId[size_t(face)], c.mesh.partId[size_t(node.firstFace)]);
    }
    nextNode += 2 * node.faceCount - 1;
    nextFace += node.faceCount;
  }
  ASSERT_EQ(nextNode, int32_t(c.tree.nodes.size()));
  ASSERT_EQ(nextFace, int32_t(c.mesh.FaceCount()));
}

/// Each face is there once, with what was its own. `before` numbers its faces in sourceCellId.
void CheckReordering(const TriangleMesh& before, const TriangleMesh& after) {
  ASSERT_EQ(before.FaceCount(), after.FaceCount());
  std::set<int64_t> seen;
  for (size_t face = 0; face < after.triangles.size(); ++face) {
    const size_t old = size_t(after.sourceCellId[face]);
    ASSERT_TRUE(seen.insert(int64_t(old)).second);
    ASSERT_EQ(after.triangles[face], before.triangles[old]);
    ASSERT_EQ(after.materialId[face], before.materialId[old]);
    ASSERT_EQ(after.partId[face], before.partId[old]);
    ASSERT_EQ(after.reflectance[face][0], before.reflectance[old][0]);
    ASSERT_EQ(after.emittance[face][1], before.emittance[old][1]);
    ASSERT_EQ(after.faceFlags[face], before.faceFlags[old]);
  }
}

void CheckDepth(const Clustered& c) {
  const std::vector<int> depth = Depths(c.tree);
  int32_t deepest = 0;
  for (size_t i = 0; i < depth.size(); ++i) {
    const size_t root =
        size_t(c.tree.surfaceRoots[size_t(c.mesh.surfaceId[size_t(c.tree.nodes[i].firstFace)])]);
    const int32_t faces = c.tree.nodes[root].faceCount;
    deepest = std::max(deepest, depth[i]);
    // One face: no depth. Else the promise of four times the even tree's.
    ASSERT_LE(depth[i], faces == 1 ? 0 : int(4 * std::log2(double(faces))));
  }
  EXPECT_EQ(c.statistics.maximumDepth, deepest);
}

Clustered ClusterAndCheck(TriangleMesh mesh, double balance = 0.01) {
  Random random(7);
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    mesh.reflectance[face] = Spectrum(random.Uniform());
    mesh.emittance[face] = Spectrum(random.Uniform());
    mesh.faceFlags[face] = uint8_t(random.Bits() % 8);
  }
  const TriangleMesh before = mesh;
  Clustered c = Cluster(std::move(mesh), OnePart(), balance);
  CheckNodes(c);
  CheckSurfaces(c);
  CheckReordering(before, c.mesh);
  CheckDepth(c);
  EXPECT_EQ(c.statistics.nodes, int64_t(c.tree.nodes.size()));
  EXPECT_EQ(c.statistics.surfaces, int64_t(c.tree.surfaceRoots.size()));
  return c;
}

TEST(FaceClustering, EmptyMeshHasNoTree) {
  const Clustered c = ClusterAndCheck(TriangleMesh());
  EXPECT_TRUE(c.tree.nodes.empty());
  EXPECT_TRUE(c.tree.surfaceRoots.empty());
}

TEST(FaceClustering, OneTriangleIsItsOwnRoot) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.Complete();
  const Clustered c = ClusterAndCheck(mesh);
  ASSERT_EQ(c.tree.nodes.size(), 1u);
  EXPECT_EQ(c.tree.nodes[0].child, -1);
  EXPECT_FLOAT_EQ(c.tree.nodes[0].area, 2);
  EXPECT_EQ(c.tree.nodes[0].vectorArea, Vec3f(0, 0, 2));
}

TEST(FaceClustering, SoupsKeepEveryFace) {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    ClusterAndCheck(Soup(seed, 4 + int(seed * 3), 1 + int(seed * 17)), seed % 3 == 0 ? 0 : 0.05);
  }
}

TEST(FaceClustering, ClosedShapesAreOneSurfaceWithoutVectorArea) {
  for (const TriangleMesh& mesh : {Sphere(20), Torus(60, 24)}) {
    const Clustered c = ClusterAndCheck(mesh);
    ASSERT_EQ(c.statistics.surfaces, 1);
    EXPECT_EQ(c.statistics.nonManifoldEdges, 0);
    // Sums of some thousand float areas.
    EXPECT_LT(Length(c.tree.nodes[0].vectorArea), 1e-5 * c.tree.nodes[0].area);
  }
}

TEST(FaceClustering, MoebiusBandIsCutWhereFrontMeetsBack) {
  const Clustered c = ClusterAndCheck(MoebiusBand(40, 4));
  EXPECT_EQ(c.statistics.surfaces, 1);
  EXPECT_EQ(c.statistics.inconsistentEdges, 4);
}

TEST(FaceClustering, FacesAboutOneEdgeStayApart) {
  const Clustered c = ClusterAndCheck(NonManifoldFan(5));
  EXPECT_EQ(c.statistics.surfaces, 5);
  EXPECT_EQ(c.statistics.nonManifoldEdges, 1);
}

TEST(FaceClustering, MaterialsCutAndSeamsOfPointsDoNot) {
  // Two triangles that share an edge by position only.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, -0.f}, {1, 1, 0}, {-0.f, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(Cluster(mesh).statistics.surfaces, 1);
  mesh.materialId = {0, 1};
  EXPECT_EQ(Cluster(mesh).statistics.surfaces, 2);
  mesh.materialId.clear();
  mesh.partId = {0, 1};
  EXPECT_EQ(Cluster(mesh, std::vector<Part>(2)).statistics.surfaces, 2);
}

TEST(FaceClustering, DegenerateFacesAreKeptAndFinite) {
  TriangleMesh mesh = FlatGrid(8);
  const int32_t point = mesh.triangles[5][0];
  mesh = FlatGrid(8);
  for (Vec3f& p : mesh.positions) {
    if (p.y > 0.4f) p.y = 0.5f;  // half of the grid has no area
  }
  mesh.triangles.push_back({point, point, point});
  mesh.triangles.push_back({0, 1, 1});
  TriangleMesh bare;
  bare.positions = mesh.positions;
  bare.triangles = mesh.triangles;
  bare.Complete();
  ClusterAndCheck(bare);
  for (Vec3f& p : bare.positions) p = {3, 3, 3};
  ClusterAndCheck(bare);
}

TEST(FaceClustering, TinyAndHugeUnitsGiveTheSameTree) {
  const Clustered metre = Cluster(Torus(30, 12));
  for (const float scale : {0x1p-30f, 0x1p+30f}) {
    TriangleMesh mesh = Torus(30, 12);
    for (Vec3f& p : mesh.positions) p *= scale;
    const Clustered c = ClusterAndCheck(mesh);
    EXPECT_EQ(c.mesh.sourceCellId, metre.mesh.sourceCellId);
  }
}

TEST(FaceClustering, FlatAndSliverGridsStayShallow) {
  const Clustered flat = ClusterAndCheck(FlatGrid(300));
  EXPECT_LT(flat.statistics.maximumDepthOverLog, 2);
  ClusterAndCheck(SliverGrid(150));
  ClusterAndCheck(SliverGrid(150), 0);
}

TEST(FaceClustering, AHubTakesItsRimWithoutAChain) {
  // One triangle whose edges carry a comb of needles each: every needle touches the hub's fan only.
  TriangleMesh mesh;
  constexpr int kTeeth = 20000;
  mesh.positions.push_back({0, 0, 0});
  for (int i = 0; i <= kTeeth; ++i) mesh.positions.push_back(OnTurn(i / (kTeeth + 1.0), 1, 0));
  for (int i = 0; i < kTeeth; ++i) {
    mesh.triangles.push_back({0, i + 1, i + 2});
    mesh.positions.push_back(OnTurn((i + 0.5) / (kTeeth + 1.0), 1.001, 0));
    mesh.triangles.push_back({i + 2, i + 1, int32_t(mesh.positions.size()) - 1});
  }
  mesh.Complete();
  ClusterAndCheck(mesh);
}

TEST(FaceClustering, APlateWithStudsIsBoundInDepth) {
  // The plate is whole first and then takes a thousand studs of many heights one by one: a chain to
  // be rebuilt.
  constexpr int kCells = 128;
  TriangleMesh mesh = FlatGrid(kCells);
  for (int j = 2; j < kCells; j += 4) {
    for (int i = 2; i < kCells; i += 4) {
      mesh.positions[size_t(j * (kCells + 1) + i)].z = float(1 + (i * 7 + j * 13) % 11) / kCells;
    }
  }
  const Clustered c = ClusterAndCheck(mesh);
  EXPECT_EQ(c.statistics.surfaces, 1);
}

TEST(FaceClustering, FlatFacesOfABoxAreWholeBeforeTheyMeet) {
  // A cube of 6 x 2 x 15 x 15 faces: the cut to six clusters finds its sides.
  TriangleMesh cube;
  for (int side = 0; side < 6; ++side) {
    const TriangleMesh grid = FlatGrid(15);
    const int32_t first = int32_t(cube.positions.size());
    for (const Vec3f& p : grid.positions) {
      const bool far = side % 2;
      const Vec3f q = far ? Vec3f(p.x, p.y, 1) : Vec3f(p.y, p.x, 0);
      const int turn = side / 2;
      cube.positions.push_back({q[turn], q[(turn + 1) % 3], q[(turn + 2) % 3]});
    }
    for (const auto& t : grid.triangles)
      cube.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  cube.Complete();
  const Clustered c = ClusterAndCheck(cube);
  ASSERT_EQ(c.statistics.surfaces, 1);
  int flat = 0;
  for (const ClusterNode& node : c.tree.nodes) {
    // Exact but for float sums of 450 areas.
    flat += node.faceCount == 450 && Length(node.vectorArea) > (1 - 1e-5f) * node.area;
  }
  EXPECT_EQ(flat, 6);
}

TEST(FaceClustering, ClustersOfASphereAreCompactCaps) {
  const Clustered c = Cluster(Sphere(100));
  for (const int32_t index : CutToCount(c.tree, 64)) {
    const ClusterNode& node = c.tree.nodes[size_t(index)];
    // A round cap of 1/64 of the sphere has 1 - S/A = 1/64; the largest clusters are some times as
    // large and no rounder than squares.
    EXPECT_GT(Length(node.vectorArea), 0.9 * node.area);
    EXPECT_LT(node.bounds.Diagonal() * node.bounds.Diagonal(), 8 * node.area);
  }
}

TEST(FaceClustering, AnswerDoesNotDependOnThreads) {
  const int threads = ThreadCount();
  for (const TriangleMesh& mesh : {Torus(400, 100), Soup(3, 200, 3000), SliverGrid(100)}) {
    SetThreadCount(1);
    const Clustered one = Cluster(mesh);
    SetThreadCount(2);
    const Clustered two = Cluster(mesh);
    ASSERT_EQ(one.mesh.sourceCellId, two.mesh.sourceCellId);
    ASSERT_EQ(one.tree.surfaceRoots, two.tree.surfaceRoots);
    ASSERT_EQ(one.tree.nodes.size(), two.tree.nodes.size());
    ASSERT_EQ(0, std::memcmp(one.tree.nodes.data(), two.tree.nodes.data(),
                             one.tree.nodes.size() * sizeof(ClusterNode)));
  }
  SetThreadCount(threads);
}

TEST(FaceClustering, CancelThrows) {
  TriangleMesh mesh = FlatGrid(40);
  EXPECT_THROW(
      ClusterFaces(&mesh, OnePart(), {}, nullptr, [](double, const char*) { return false; }),
      Cancelled);
}

TEST(FaceClustering, RejectsABalanceThatIsNoNumber) {
  TriangleMesh mesh = FlatGrid(2);
  for (const double balance : {-1.0, std::nan("")}) {
    FaceClusteringOptions options;
    options.balance = balance;
    EXPECT_THROW(ClusterFaces(&mesh, OnePart(), options), Error);
  }
}

/// Copies of `mesh`, each a part, under the matrices of `parts`.
TriangleMesh Instances(const TriangleMesh& mesh, const std::vector<Part>& parts) {
  TriangleMesh all;
  for (size_t part = 0; part < parts.size(); ++part) {
    const auto& m = parts[part].objectToWorld;
    const int32_t first = int32_t(all.positions.size());
    for (const Vec3f& p : mesh.positions) {
      Vec3f q;
      for (int row = 0; row < 3; ++row) {
        const size_t r = size_t(4 * row);
        q[row] = float(m[r] * p.x + m[r + 1] * p.y + m[r + 2] * p.z + m[r + 3]);
      }
      all.positions.push_back(q);
    }
    for (const auto& t : mesh.triangles) {
      all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      all.partId.push_back(int32_t(part));
      all.sourceCellId.push_back(int64_t(all.sourceCellId.size()));
    }
  }
  all.Complete();
  return all;
}

Part PlacedPart(double scale, double turn, double x, double stretch = 1) {
  const double c = scale * std::cos(turn), s = scale * std::sin(turn);
  Part part;
  part.objectToWorld = {c, -s, 0, x, s, c, 0, -x, 0, 0, scale * stretch, 1, 0, 0, 0, 1};
  return part;
}

TEST(FaceClustering, InstancesShareTheTreeAndMeasureTheirOwn) {
  std::vector<Part> parts;
  for (int i = 0; i < 1000; ++i) parts.push_back(PlacedPart(1 + 0.01 * (i % 7), 0.1 * i, 10.0 * i));
  const TriangleMesh before = Instances(Torus(12, 8), parts);
  const Clustered c = Cluster(before, parts);
  EXPECT_EQ(c.statistics.sharedTrees, 999);
  EXPECT_EQ(c.statistics.surfaces, 1000);
  CheckNodes(c);
  CheckSurfaces(c);
  CheckReordering(before, c.mesh);
  const size_t faces = size_t(c.mesh.FaceCount()) / 1000;
  for (size_t face = 0; face < c.mesh.triangles.size(); ++face) {
    ASSERT_EQ(c.mesh.sourceCellId[face] % int64_t(faces), c.mesh.sourceCellId[face % faces]);
  }
  const float area = c.tree.nodes[0].area;
  for (int i = 0; i < 1000; ++i) {
    const double scale = 1 + 0.01 * (i % 7);
    // Coordinates up to 1e4 m in float: 1e-3 m of a metre's edge.
    EXPECT_NEAR(c.tree.nodes[size_t(c.tree.surfaceRoots[size_t(i)])].area, area * scale * scale,
                1e-2 * area);
  }
}

TEST(FaceClustering, PartsThatDoNotFitTheirMeshAreClusteredOnTheirOwn) {
  // A stretched copy, one whose points have been moved, and one of another material.
  std::vector<Part> parts{PlacedPart(1, 0, 0), PlacedPart(1, 1, 9, 2), PlacedPart(2, 1, 20),
                          PlacedPart(1, 0, 40)};
  TriangleMesh mesh = Instances(Torus(12, 8), parts);
  mesh.positions[2 * mesh.positions.size() / 4 + 5].z += 0.3f;
  const size_t faces = mesh.triangles.size() / 4;
  for (size_t face = 3 * faces; face < 4 * faces; ++face) mesh.materialId[face] = 1;
  const Clustered c = Cluster(mesh, parts);
  EXPECT_EQ(c.statistics.sharedTrees, 0);
  CheckNodes(c);
  CheckSurfaces(c);
}

TEST(ClusterCut, HoldsEveryFaceOnce) {
  const Clustered c = Cluster(Soup(9, 60, 400));
  const auto check = [&](const std::vector<int32_t>& cut) {
    int32_t next = 0;
    for (const int32_t node : cut) {
      ASSERT_EQ(c.tree.nodes[size_t(node)].firstFace, next);
      next += c.tree.nodes[size_t(node)].faceCount;
    }
    ASSERT_EQ(next, 400);
  };
  EXPECT_EQ(CutAtLevel(c.tree, 0), c.tree.surfaceRoots);
  check(CutAtLevel(c.tree, 1));
  EXPECT_EQ(CutAtLevel(c.tree, 1000).size(), 400u);
  EXPECT_EQ(CutToCount(c.tree, 0), c.tree.surfaceRoots);
  const int64_t wanted = c.statistics.surfaces + 5;
  check(CutToCount(c.tree, wanted));
  EXPECT_EQ(int64_t(CutToCount(c.tree, wanted).size()), wanted);
  EXPECT_EQ(CutToCount(c.tree, 100000).size(), 400u);
  EXPECT_THROW(CutAtLevel(c.tree, -1), Error);
}

}  // namespace
}  // namespace lambert
