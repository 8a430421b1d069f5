#include "Atlas/Core/SurfaceParts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "Atlas/Core/SurfaceRepresentation.h"
#include "AtlasMeshes.h"

namespace lambert {
namespace {

/// Light with a bright strip across x = 0.2, a slope elsewhere.
Spectrum Light(const Vec3f& p) {
  return Spectrum(1 + 3 * p.x + p.y + 3 * std::exp(-300 * (p.x - 0.2f) * (p.x - 0.2f)));
}

/// A floor of 512 triangles in one surface, refined where x < 0.4, shown from its front or back.
struct HalfRefined {
  TriangleMesh mesh;
  ClusterTree tree;
  RadiositySolution solution;

  explicit HalfRefined(uint8_t side = kFront) {
    mesh = FlatGrid(16);
    tree = ClusterFaces(&mesh, {});
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
      AddRefined(face, CornersOf(mesh, face), IsRefined(face) ? 2 : 0, Light, &solution);
    }
    solution.mesh.Complete();
    solution.side.assign(solution.side.size(), side);
  }
  bool IsRefined(int64_t face) const {
    return mesh.Corner(face, 0).x + mesh.Corner(face, 1).x + mesh.Corner(face, 2).x < 1.2f;
  }
};

RepresentationOptions Split() {
  RepresentationOptions options;
  options.splitSurfaces = true;
  return options;
}

AtlasOptions Page() {
  AtlasOptions options;
  options.pageSize = 128;
  return options;
}

TEST(SurfaceParts, AreClustersApartByRefinement) {
  const HalfRefined floor;
  ASSERT_EQ(floor.tree.surfaceRoots.size(), 1u);
  const SurfaceParts parts = CutWhereRefined(floor.mesh, floor.tree, floor.solution, {true});
  ASSERT_GT(parts.surfaceOfPart.size(), 1u);
  ASSERT_EQ(parts.tree.surfaceRoots.size(), parts.surfaceOfPart.size());

  // All faces in their order, each in one part, which is a tree of its own.
  int32_t face = 0;
  double plain = 0, area = 0;
  for (size_t part = 0; part < parts.surfaceOfPart.size(); ++part) {
    const ClusterNode& root = parts.tree.nodes[size_t(parts.tree.surfaceRoots[part])];
    EXPECT_EQ(root.parent, -1);
    EXPECT_EQ(root.firstFace, face);
    face += root.faceCount;
    bool wasRefined = false;
    for (int32_t f = root.firstFace; f < face; ++f) {
      EXPECT_EQ(parts.partOfFace[size_t(f)], int32_t(part));
      wasRefined |= floor.IsRefined(f);
    }
    EXPECT_EQ(parts.surfaceOfPart[part], 0);
    area += double(root.area);
    if (!wasRefined) plain += double(root.area);
  }
  EXPECT_EQ(face, floor.mesh.FaceCount());
  for (size_t node = 0; node < parts.tree.nodes.size(); ++node) {
    const ClusterNode& cluster = parts.tree.nodes[node];
    if (cluster.child < 0) continue;
    const ClusterNode& a = parts.tree.nodes[size_t(cluster.child)];
    const ClusterNode& b = parts.tree.nodes[size_t(cluster.child) + 1];
    EXPECT_EQ(a.parent, int32_t(node));
    EXPECT_EQ(b.parent, int32_t(node));
    EXPECT_EQ(cluster.faceCount, a.faceCount + b.faceCount);
  }
  EXPECT_GT(plain / area, 0.45);  // Of the 0.6 that were not refined.
}

TEST(SurfaceParts, StayWholeWhereTheyMayNotBeCutAndWhereAllIsAlike) {
  const HalfRefined floor;
  const SurfaceParts kept = CutWhereRefined(floor.mesh, floor.tree, floor.solution, {false});
  EXPECT_EQ(kept.surfaceOfPart.size(), 1u);
  EXPECT_EQ(kept.tree.nodes.size(), floor.tree.nodes.size());
  for (const int depth : {0, 1}) {
    RadiositySolution even;
    for (int64_t face = 0; face < floor.mesh.FaceCount(); ++face) {
      AddRefined(face, CornersOf(floor.mesh, face), depth, Light, &even);
    }
    EXPECT_EQ(CutWhereRefined(floor.mesh, floor.tree, even, {true}).surfaceOfPart.size(), 1u);
  }
}

TEST(SurfaceParts, AreCutOnWhereChartsEnd) {
  const HalfRefined floor;
  const SurfaceParts whole = CutWhereRefined(floor.mesh, floor.tree, floor.solution, {false});
  std::vector<int64_t> laid;
  for (int64_t face = 0; face < floor.mesh.FaceCount(); ++face) {
    laid.push_back(floor.IsRefined(face) ? face : -1);
  }
  const SurfaceParts cut = CutWhereLaid(whole, laid);
  ASSERT_GT(cut.surfaceOfPart.size(), 1u);
  for (size_t part = 0; part < cut.surfaceOfPart.size(); ++part) {
    const ClusterNode& root = cut.tree.nodes[size_t(cut.tree.surfaceRoots[part])];
    const bool isLaid = laid[size_t(root.firstFace)] >= 0;
    for (int32_t face = root.firstFace; face < root.firstFace + root.faceCount; ++face) {
      EXPECT_EQ(cut.partOfFace[size_t(face)], int32_t(part));
      EXPECT_EQ(laid[size_t(face)] >= 0, isLaid);
    }
  }
  laid.assign(laid.size(), 0);
  EXPECT_EQ(CutWhereLaid(whole, laid).surfaceOfPart.size(), 1u);
}

// What was chosen once is the same on its own atlas, whatever is cut now.
TEST(SurfaceParts, LieWhereAnEarlierChoiceLaidThem) {
  const HalfRefined floor;
  const RepresentedScene first =
      RepresentSurfaces(floor.mesh, floor.tree, floor.solution, Split(), Page());
  StoredAtlas stored;
  stored.atlas = first.atlas;
  stored.isOfChosen = true;
  stored.inputFace = first.mapped.inputFace;
  for (int64_t face = 0; face < first.mapped.mesh.FaceCount(); ++face) {
    stored.corners.push_back(CornersOf(first.mapped.mesh, face));
  }
  ASSERT_TRUE(IsAtlasOf(stored, floor.mesh, floor.tree));
  RepresentationOptions whole;
  whole.wanted = {Representation::LightMap};
  for (const RepresentationOptions& options : {Split(), whole}) {
    const RepresentedScene again =
        RepresentSurfaces(floor.mesh, floor.tree, floor.solution, options, stored);
    EXPECT_EQ(again.mapped.inputFace, first.mapped.inputFace);
    EXPECT_EQ(again.map.pages, first.map.pages);
    EXPECT_EQ(again.points.inputFaceId, first.points.inputFaceId);
  }
}

TEST(SurfaceParts, ShowBothKindsOnOneSurfaceWithoutAStep) {
  for (const uint8_t side : {uint8_t(kFront), uint8_t(kBack)}) {
    const HalfRefined floor(side);
    const RepresentedScene scene =
        RepresentSurfaces(floor.mesh, floor.tree, floor.solution, Split(), Page());

    // What was refined is in the map, most of the rest is not; nothing is lost.
    int64_t mapped = 0, byPoints = 0;
    for (const SurfaceCost& part : scene.surfaces) {
      EXPECT_EQ(part.surface, 0);
      const bool isMapped = part.chosen == Representation::LightMap;
      (isMapped ? mapped : byPoints) += part.inputTriangles;
      EXPECT_EQ(isMapped, part.Introduced() > 0);
    }
    EXPECT_EQ(mapped + byPoints, floor.mesh.FaceCount());
    EXPECT_GT(byPoints, 512 * 45 / 100);
    const RepresentedMesh joined = JoinRepresentations(scene);
    EXPECT_EQ(joined.mesh.FaceCount(), floor.mesh.FaceCount());

    // Along the border the map shows what the points beyond do, closer than its texels alone.
    const std::vector<BorderPoint> border =
        FindBorders(floor.mesh, floor.solution, scene.mapped, scene.atlas);
    ASSERT_GT(border.size(), 30u);
    const LightMap open = MakeLightMap(scene.mapped.mesh, scene.atlas, scene.mapped.solution);
    double before = 0, after = 0;
    for (const BorderPoint& point : border) {
      const auto step = [&](const LightMap& map) {
        const float found = Lookup(map, point.page, point.textureCoords).r;
        return std::abs(double(found / point.irradiance.r) - 1);
      };
      before = std::max(before, step(open));
      after = std::max(after, step(scene.map));
    }
    EXPECT_GT(before, 3 * after);
    EXPECT_LT(after, 0.001);
  }
}

TEST(SurfaceParts, WhatIsWantedOfASurfaceKeepsItWhole) {
  const HalfRefined floor;
  RepresentationOptions options = Split();
  options.wanted = {Representation::LightMap};
  const RepresentedScene scene =
      RepresentSurfaces(floor.mesh, floor.tree, floor.solution, options, Page());
  EXPECT_EQ(scene.surfaces.size(), 1u);
  EXPECT_EQ(scene.mapped.mesh.FaceCount(), floor.mesh.FaceCount());
  options.wanted.resize(2, Representation::Points);
  EXPECT_THROW(RepresentSurfaces(floor.mesh, floor.tree, floor.solution, options, Page()),
               std::exception);
}

}  // namespace
}  // namespace lambert
