#include "Atlas/Core/StoredAtlas.h"

#include <gtest/gtest.h>

#include "Atlas/Core/LightMap.h"
#include "Atlas/Core/SurfaceRepresentation.h"
#include "AtlasMeshes.h"

namespace lambert {
namespace {

/// By surface and side.
using Light = std::array<std::array<float, 2>, 2>;

float At(const Vec3f& p) { return 5 + p.x + 0.5f * p.y; }

/// Two sheets over each other, in the order of their clusters.
struct TwoSheets : Clustered {
  TwoSheets() : Clustered(TwoFlatGrids(4)) {}

  RadiositySolution Lit(const Light& light) const {
    RadiositySolution solution;
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
      for (const uint8_t side : {kFront, kBack}) {
        const float part = light[size_t(mesh.surfaceId[size_t(face)])][side];
        if (!(part > 0)) continue;
        AddRefined(
            face, CornersOf(mesh, face), 0, [&](const Vec3f& p) { return Spectrum(part * At(p)); },
            &solution);
        solution.side.back() = side;
      }
    }
    solution.mesh.Complete();
    return solution;
  }

  /// On one page, of the sides that show in that light, as a file has it.
  StoredAtlas Laid(const Light& light) const {
    const std::optional<ShownSides> shown = ShowBothSides(mesh, tree, Lit(light));
    const TriangleMesh& laid = shown ? shown->mesh : mesh;
    StoredAtlas stored;
    AtlasOptions options;
    options.pageSize = 256;
    stored.atlas = MakeRadiosityAtlas(laid, shown ? shown->tree : tree, options);
    for (int64_t face = 0; face < laid.FaceCount(); ++face) {
      stored.corners.push_back(CornersOf(laid, face));
    }
    if (shown) stored.inputFace = shown->inputFace, stored.side = shown->side;
    return stored;
  }
};

constexpr Light kFronts = {{{1, 0}, {0.8f, 0}}}, kOneSheet = {{{1, 0.3f}, {0.8f, 0}}};

TEST(StoredAtlas, IsOfItsOwnMesh) {
  const TwoSheets sheets;
  for (const Light& light : {kFronts, kOneSheet}) {
    const StoredAtlas stored = sheets.Laid(light);
    EXPECT_EQ(stored.side.empty(), light == kFronts);
    EXPECT_TRUE(IsAtlasOf(stored, sheets.mesh, sheets.tree));
  }
}

TEST(StoredAtlas, IsOfNoOtherMesh) {
  const TwoSheets sheets;
  for (const Light& light : {kFronts, kOneSheet}) {
    const StoredAtlas stored = sheets.Laid(light);
    TriangleMesh moved = sheets.mesh;
    moved.positions[3].z += 0.01f;
    EXPECT_FALSE(IsAtlasOf(stored, moved, sheets.tree));
    const Clustered larger(TwoFlatGrids(6)), smaller(TwoFlatGrids(2));
    EXPECT_FALSE(IsAtlasOf(stored, larger.mesh, larger.tree));
    EXPECT_FALSE(IsAtlasOf(stored, smaller.mesh, smaller.tree));
  }

  // Nor are faces that cannot be.
  for (const int64_t face : {int64_t(-1), int64_t(1) << 40, int64_t(0)}) {
    StoredAtlas stored = sheets.Laid(kOneSheet);
    stored.inputFace.back() = face;
    EXPECT_FALSE(IsAtlasOf(stored, sheets.mesh, sheets.tree)) << face;
  }
}

TEST(StoredAtlas, ShowsNoSidesWhereItTellsNone) {
  const TwoSheets sheets;
  StoredAtlas stored = sheets.Laid(kFronts);
  EXPECT_FALSE(ShowStoredSides(sheets.mesh, sheets.tree, sheets.Lit(kOneSheet), &stored));
}

TEST(StoredAtlas, IsAsItWasInTheSameLight) {
  const TwoSheets sheets;
  const StoredAtlas before = sheets.Laid(kOneSheet);
  StoredAtlas stored = before;
  const auto shown = ShowStoredSides(sheets.mesh, sheets.tree, sheets.Lit(kOneSheet), &stored);
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->inputFace, before.inputFace);
  EXPECT_EQ(shown->side, before.side);
  EXPECT_EQ(stored.atlas.textureCoords, before.atlas.textureCoords);
}

// The sheet keeps both its sides, the surface that was lit from above is lit from below.
TEST(StoredAtlas, ShowsTheSidesThatAnotherLightFallsOn) {
  const TwoSheets sheets;
  const Light light = {{{0.2f, 1}, {0, 0.6f}}};
  const RadiositySolution solution = sheets.Lit(light);
  StoredAtlas stored = sheets.Laid(kOneSheet);
  const auto shown = ShowStoredSides(sheets.mesh, sheets.tree, solution, &stored);
  ASSERT_TRUE(shown);
  ASSERT_EQ(shown->mesh.FaceCount(), sheets.mesh.FaceCount() / 2 * 3);
  EXPECT_TRUE(IsAtlasOf(stored, sheets.mesh, sheets.tree));
  const LightMap map = MakeLightMap(shown->mesh, stored.atlas,
                                    OntoShownSides(solution, shown->inputFace, shown->side));
  const std::vector<int32_t> charts = ChartOfFace(stored.atlas.set);
  for (int64_t face = 0; face < shown->mesh.FaceCount(); ++face) {
    const int64_t input = shown->inputFace[size_t(face)];
    const uint8_t side = shown->side[size_t(face)];
    EXPECT_GT(light[size_t(sheets.mesh.surfaceId[size_t(input)])][side], 0);
    for (int c = 0; c < 3; ++c) {
      const Vec2f& place = stored.atlas.textureCoords[size_t(face)][size_t(c)];
      const int page = stored.atlas.pageOfChart[size_t(charts[size_t(face)])];
      const float wanted = light[size_t(sheets.mesh.surfaceId[size_t(input)])][side] *
                           At(shown->mesh.Corner(face, c));
      EXPECT_NEAR(Lookup(map, page, place).r, wanted, 0.01 * double(wanted)) << face;
    }
  }

  // Points are split as the charts are.
  TriangleMesh split = shown->mesh;
  const std::vector<Vec2f> places = SplitAtCharts(stored.atlas, &split);
  for (size_t face = 0; face < split.triangles.size(); ++face) {
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(places[size_t(split.triangles[face][c])], stored.atlas.textureCoords[face][c]);
    }
  }
}

RepresentationOptions Wanting(const std::vector<Representation>& wanted) {
  RepresentationOptions options;
  options.wanted = wanted;
  return options;
}

/// What a light map took, as a file has it.
StoredAtlas StoreChosen(const RepresentedScene& scene) {
  StoredAtlas stored;
  stored.atlas = scene.atlas;
  stored.isOfChosen = true;
  stored.inputFace = scene.mapped.inputFace;
  if (scene.hasSheets) stored.side = SidesOfMappedFaces(scene);
  for (int64_t face = 0; face < scene.mapped.mesh.FaceCount(); ++face) {
    stored.corners.push_back(CornersOf(scene.mapped.mesh, face));
  }
  return stored;
}

constexpr Representation kMap = Representation::LightMap, kPoints = Representation::Points;

// Surfaces that are left to their points do not use their charts, whichever sides it was made of.
TEST(StoredAtlas, HoldsWhatIsChosenWhereItLies) {
  const TwoSheets sheets;
  for (const Light& light : {kFronts, kOneSheet}) {
    const StoredAtlas stored = sheets.Laid(light);
    const RepresentedScene scene = RepresentSurfaces(sheets.mesh, sheets.tree, sheets.Lit(light),
                                                     Wanting({kMap, kPoints}), stored);
    const size_t sides = light == kFronts ? 1 : 2, half = sheets.mesh.triangles.size() / 2;
    ASSERT_EQ(scene.mapped.inputFace.size(), sides * half);
    ASSERT_EQ(scene.points.inputFaceId.size(), half);
    EXPECT_EQ(scene.atlas.texelSize, stored.atlas.texelSize);
    EXPECT_LT(scene.atlas.utilisation, stored.atlas.utilisation);
    const std::vector<uint8_t> shows = SidesOfMappedFaces(scene);
    for (size_t face = 0; face < scene.mapped.inputFace.size(); ++face) {
      size_t of = size_t(scene.mapped.inputFace[face]);
      if (!stored.side.empty() && stored.side[of] != shows[face]) of += 2 * half;
      EXPECT_EQ(scene.atlas.textureCoords[face], stored.atlas.textureCoords[of]) << face;
      for (size_t c = 0; c < 3; ++c) {
        const Spectrum found = Lookup(scene.map, 0, scene.atlas.textureCoords[face][c]);
        const float wanted =
            light[0][shows[face]] * At(CornersOf(scene.mapped.mesh, int64_t(face))[c]);
        EXPECT_NEAR(found.r, wanted, 0.01 * double(wanted));
      }
    }
  }
}

// Pages that nothing is left on are none.
TEST(StoredAtlas, LeavesOutEmptyPages) {
  const TwoSheets sheets;
  StoredAtlas stored = sheets.Laid(kFronts);
  const std::vector<int32_t> charts = ChartOfFace(stored.atlas.set);
  for (size_t face = 0; face < charts.size(); ++face) {
    stored.atlas.pageOfChart[size_t(charts[face])] = sheets.mesh.surfaceId[face] == 0 ? 1 : 2;
  }
  stored.atlas.pages = 3;
  const RepresentedScene scene = RepresentSurfaces(sheets.mesh, sheets.tree, sheets.Lit(kFronts),
                                                   Wanting({kPoints, kMap}), stored);
  EXPECT_EQ(scene.atlas.pages, 1);
  EXPECT_EQ(scene.map.pages.size(), 1u);
  for (const int32_t page : scene.atlas.pageOfChart) EXPECT_EQ(page, 0);
}

TEST(StoredAtlas, OfChosenSurfacesLeavesTheOthersToTheirPoints) {
  const TwoSheets sheets;
  for (const Light& light : {kFronts, kOneSheet}) {
    const RadiositySolution solution = sheets.Lit(light);
    AtlasOptions page;
    page.pageSize = 256;
    const RepresentedScene first =
        RepresentSurfaces(sheets.mesh, sheets.tree, solution, Wanting({kMap, kPoints}), page);
    const StoredAtlas stored = StoreChosen(first);
    ASSERT_TRUE(IsAtlasOf(stored, sheets.mesh, sheets.tree));
    EXPECT_EQ(FindLaidSurfaces(stored, sheets.mesh), (std::vector<bool>{true, false}));
    const RepresentedScene again =
        RepresentSurfaces(sheets.mesh, sheets.tree, solution, Wanting({kMap, kMap}), stored);
    EXPECT_EQ(again.mapped.inputFace, first.mapped.inputFace);
    EXPECT_EQ(again.atlas.textureCoords, first.atlas.textureCoords);
    EXPECT_EQ(again.map.pages, first.map.pages);
    EXPECT_EQ(again.points.inputFaceId, first.points.inputFaceId);
  }
}

// The chart of a side goes to the one that is lit now, unless both show.
TEST(StoredAtlas, OfChosenSurfacesFollowsTheLight) {
  const TwoSheets sheets;
  AtlasOptions page;
  page.pageSize = 256;
  const StoredAtlas stored = StoreChosen(RepresentSurfaces(
      sheets.mesh, sheets.tree, sheets.Lit(kFronts), Wanting({kMap, kPoints}), page));
  const Light fromBelow = {{{0, 1}, {0, 0.6f}}}, onBoth = {{{0.4f, 1}, {0.6f, 0}}};
  for (const Light& light : {fromBelow, onBoth}) {
    const RepresentedScene scene = RepresentSurfaces(sheets.mesh, sheets.tree, sheets.Lit(light),
                                                     Wanting({kMap, kMap}), stored);
    ASSERT_EQ(scene.mapped.inputFace.size(), stored.corners.size());
    for (size_t face = 0; face < stored.corners.size(); ++face) {
      for (size_t c = 0; c < 3; ++c) {
        const float wanted = At(CornersOf(scene.mapped.mesh, int64_t(face))[c]);
        EXPECT_NEAR(Lookup(scene.map, 0, scene.atlas.textureCoords[face][c]).r, wanted,
                    0.01 * double(wanted));
      }
    }
  }
}

TEST(StoredAtlas, OfChosenSurfacesIsOfNoOtherMesh) {
  const TwoSheets sheets;
  AtlasOptions page;
  page.pageSize = 256;
  StoredAtlas stored = StoreChosen(RepresentSurfaces(sheets.mesh, sheets.tree, sheets.Lit(kFronts),
                                                     Wanting({kPoints, kMap}), page));
  TriangleMesh moved = sheets.mesh;
  moved.positions[size_t(moved.triangles.back()[0])].z += 0.01f;
  EXPECT_FALSE(IsAtlasOf(stored, moved, sheets.tree));
  for (const int64_t face : {int64_t(-1), int64_t(1) << 40, stored.inputFace[1]}) {
    StoredAtlas wrong = stored;
    wrong.inputFace[0] = face;
    EXPECT_FALSE(IsAtlasOf(wrong, sheets.mesh, sheets.tree)) << face;
  }
}

}  // namespace
}  // namespace lambert
