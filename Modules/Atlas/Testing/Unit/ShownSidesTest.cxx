#include "Atlas/Core/ShownSides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Atlas/Core/LightMap.h"
#include "Atlas/Core/SurfaceRepresentation.h"
#include "AtlasMeshes.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

Spectrum Slope(const Vec3f& p) { return {5 + p.x, 5 + p.y, 5 + p.z}; }

/// A mesh in the order of its clusters, lit on its front and, by `back` of that, on its back.
struct LitOnBothSides : Clustered {
  RadiositySolution solution;

  LitOnBothSides(TriangleMesh mesh_, float front, float back) : Clustered(std::move(mesh_)) {
    for (const auto& [side, part] : {std::pair{kFront, front}, std::pair{kBack, back}}) {
      if (!(part > 0)) continue;
      for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
        const int32_t first = int32_t(solution.mesh.positions.size());
        for (const int corner : {0, side == kFront ? 1 : 2, side == kFront ? 2 : 1}) {
          solution.mesh.positions.push_back(mesh.Corner(face, corner));
          solution.irradiance.push_back(Slope(mesh.Corner(face, corner)) * part);
        }
        solution.mesh.triangles.push_back({first, first + 1, first + 2});
        solution.inputFaceId.push_back(face);
        solution.side.push_back(side);
      }
    }
    solution.mesh.Complete();
  }
};

AtlasOptions Page(int size) {
  AtlasOptions options;
  options.pageSize = size;
  return options;
}

/// The middle of a face in its light map.
Spectrum InTheMiddle(const RadiosityAtlas& atlas, const LightMap& map, int64_t face) {
  const auto& t = atlas.textureCoords[size_t(face)];
  const int page = atlas.pageOfChart[size_t(ChartOfFace(atlas.set)[size_t(face)])];
  return Lookup(map, page, (t[0] + t[1] + t[2]) * (1.f / 3));
}

Vec3f Middle(const TriangleMesh& mesh, int64_t face) {
  return (mesh.Corner(face, 0) + mesh.Corner(face, 1) + mesh.Corner(face, 2)) / 3.f;
}

/// Checks that every face of a light map has the light of its side.
void ExpectLightOfEachSide(const LitOnBothSides& lit, float front, float back) {
  const auto shown = ShowBothSides(lit.mesh, lit.tree, lit.solution);
  ASSERT_TRUE(shown);
  ASSERT_EQ(shown->mesh.FaceCount(), 2 * lit.mesh.FaceCount());
  const RadiosityAtlas atlas = MakeRadiosityAtlas(shown->mesh, shown->tree, Page(256));
  const LightMap map =
      MakeLightMap(shown->mesh, atlas, OntoShownSides(lit.solution, shown->inputFace, shown->side));
  for (int64_t face = 0; face < shown->mesh.FaceCount(); ++face) {
    const bool isFront = shown->side[size_t(face)] == kFront;
    const Vec3f toSide = lit.mesh.FrontNormal(shown->inputFace[size_t(face)]);
    EXPECT_NEAR(Dot(shown->mesh.FrontNormal(face), toSide), isFront ? 1 : -1, 1e-5);
    const Spectrum wanted = Slope(Middle(shown->mesh, face)) * (isFront ? front : back);
    const Spectrum found = InTheMiddle(atlas, map, face);
    EXPECT_NEAR(found.r, wanted.r, 1e-3 * double(wanted.r)) << face;
    EXPECT_NEAR(found.g, wanted.g, 1e-3 * double(wanted.g)) << face;
  }
}

TEST(ShownSides, EachSideOfASheetHasItsOwnLight) {
  ExpectLightOfEachSide({FlatGrid(10), 1, 0.01f}, 1, 0.01f);
  ExpectLightOfEachSide({FlatGrid(10), 0.3f, 1}, 0.3f, 1);
}

// What seeps into a solid is no second side, nor is a side without light.
TEST(ShownSides, WhatIsLitFromOneSideStaysAsItIs) {
  const LitOnBothSides solid(Sphere(12), 1, 0.01f), sheet(FlatGrid(4), 1, 0);
  EXPECT_FALSE(ShowBothSides(solid.mesh, solid.tree, solid.solution));
  EXPECT_FALSE(ShowBothSides(sheet.mesh, sheet.tree, sheet.solution));
}

/// A cloth of 1 x 1 m that hangs down from its middle, as a tent.
TriangleMesh Tent() {
  return GridMesh(16, 16, [](double u, double v) {
    const double beside = std::max(std::abs(u - 0.5), std::abs(v - 0.5));
    return Vec3f(float(u), float(v), -2.2f * float(beside));
  });
}

TEST(ShownSides, TheDimSideOfABentSheetShows) {
  const LitOnBothSides tent(Tent(), 1, 0.01f);
  const ClusterNode& root = tent.tree.nodes[size_t(tent.tree.surfaceRoots[0])];
  EXPECT_LT(Length(root.vectorArea), 0.45f * root.area);
  ExpectLightOfEachSide(tent, 1, 0.01f);
}

// As the blocks of a Cornell box.
TEST(ShownSides, ABlockWithoutABottomIsNoSheet) {
  TriangleMesh cube = Box({1, 1, 1}, false);
  cube.Complete();
  const LitOnBothSides block(cube, 1, 0.04f);
  EXPECT_FALSE(ShowBothSides(block.mesh, block.tree, block.solution));
}

TEST(ShownSides, TheInsideOfASolidNeverShows) {
  TriangleMesh floor = FlatGrid(2), scene;
  for (Vec3f& p : floor.positions) p *= 40.f;
  Append(floor, {0, 0, -20}, &scene);
  Append(Sphere(12), {}, &scene);
  scene.Complete();
  // Half of the light has seeped in.
  const LitOnBothSides lit(scene, 1, 0.5f);
  const std::vector<bool> isSheet = FindSheets(lit.mesh, lit.tree, lit.solution);
  ASSERT_EQ(isSheet.size(), 2u);
  for (size_t s = 0; s < 2; ++s) {
    const ClusterNode& root = lit.tree.nodes[size_t(lit.tree.surfaceRoots[s])];
    EXPECT_EQ(isSheet[s], root.faceCount == 8) << s;
  }
}

TEST(ShownSides, ASideEmitsByItself) {
  LitOnBothSides lamp(FlatGrid(2), 1, 0.5f);
  lamp.mesh.emittance.assign(lamp.mesh.triangles.size(), Spectrum(7));
  lamp.mesh.faceFlags.assign(lamp.mesh.triangles.size(), kEmitsBack);
  const auto shown = ShowBothSides(lamp.mesh, lamp.tree, lamp.solution);
  ASSERT_TRUE(shown);
  for (int64_t face = 0; face < shown->mesh.FaceCount(); ++face) {
    const bool isBack = shown->side[size_t(face)] == kBack;
    EXPECT_EQ(shown->mesh.Emits(face, kFront), isBack);
    EXPECT_EQ(shown->mesh.emittance[size_t(face)].r, isBack ? 7 : 0);
  }
}

TEST(ShownSides, AreRepresentedEachByItself) {
  const LitOnBothSides lit(FlatGrid(4), 1, 0.5f);
  for (const auto kind : {Representation::Points, Representation::LightMap}) {
    RepresentationOptions options;
    options.wanted = {kind};
    const RepresentedScene scene =
        RepresentSurfaces(lit.mesh, lit.tree, lit.solution, options, Page(128));
    ASSERT_EQ(scene.surfaces.size(), 2u);
    EXPECT_EQ(scene.surfaces[0].side, kFront);
    EXPECT_EQ(scene.surfaces[1].side, kBack);
    EXPECT_EQ(scene.surfaces[1].surface, 0);
    EXPECT_EQ(scene.surfaces[1].chosen, kind);

    // Half of the mesh shows each side.
    const RepresentedMesh joined = JoinRepresentations(scene);
    ASSERT_EQ(joined.side.size(), 2 * lit.mesh.triangles.size());
    for (size_t face = 0; face < joined.side.size(); ++face) {
      const size_t point = size_t(joined.mesh.triangles[face][0]);
      const float part = joined.side[face] == kFront ? 1 : 0.5f;
      EXPECT_NEAR(joined.irradiance[point].r, Slope(joined.mesh.positions[point]).r * part, 0.02);
    }
  }
}

TEST(ShownSides, RefusesLightThatNoFaceShows) {
  const LitOnBothSides lit(FlatGrid(2), 1, 0.5f);
  EXPECT_THROW(OntoShownSides(lit.solution, {0}, {kFront}), Error);
}

TEST(ShownSides, RefusesSurfacesAndFacesThatCannotBe) {
  LitOnBothSides lit(FlatGrid(2), 1, 0.5f);
  EXPECT_THROW(OntoShownSides(lit.solution, {-1}, {kFront}), Error);
  ClusterTree other = lit.tree;
  other.surfaceRoots.clear();
  EXPECT_THROW(FindSheets(lit.mesh, other, lit.solution), Error);
  lit.mesh.surfaceId.clear();
  EXPECT_THROW(ShowBothSides(lit.mesh, lit.tree, lit.solution), Error);
}

}  // namespace
}  // namespace lambert
