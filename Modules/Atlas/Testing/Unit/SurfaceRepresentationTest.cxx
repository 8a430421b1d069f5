#include "Atlas/Core/SurfaceRepresentation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "AtlasMeshes.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// Light with a bright strip across, narrower than a cell of the planes.
Spectrum Strip(const Vec3f& p) {
  return Spectrum(1 + 4 * std::exp(-200 * (p.x - 0.6f) * (p.x - 0.6f)));
}

/// Two planes of 32 triangles, one above the other. What lies on the upper one is refined `depth`
/// times, on the lower one not.
struct TwoPlanes {
  TriangleMesh mesh;
  ClusterTree tree;
  RadiositySolution solution;

  explicit TwoPlanes(int depth) {
    mesh = TwoFlatGrids(4);
    tree = ClusterFaces(&mesh, {});
    for (const Vec3f& p : mesh.positions) solution.inputIrradiance.push_back(Strip(p));
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
      AddRefined(face, CornersOf(mesh, face), mesh.Corner(face, 0).z > 1 ? depth : 0, Strip,
                 &solution);
    }
    solution.mesh.Complete();
  }

  size_t Upper() const {
    return size_t(mesh.surfaceId[size_t(mesh.Corner(0, 0).z > 1 ? 0 : mesh.FaceCount() - 1)]);
  }
};

std::vector<SurfaceCost> ChooseRepresentations(const TriangleMesh& mesh,
                                               const RadiositySolution& solution,
                                               const RepresentationOptions& options) {
  std::vector<SurfaceCost> costs = MeasureSurfaces(mesh, solution);
  lambert::ChooseRepresentations(options, &costs);
  return costs;
}

AtlasOptions Page() {
  AtlasOptions options;
  options.pageSize = 256;
  return options;
}

TEST(SurfaceRepresentation, WhatWasRefinedMostGoesIntoTheLightMap) {
  const TwoPlanes planes(2);
  const auto costs = ChooseRepresentations(planes.mesh, planes.solution, {});
  ASSERT_EQ(costs.size(), 2u);
  const SurfaceCost &upper = costs[planes.Upper()], &lower = costs[1 - planes.Upper()];
  EXPECT_EQ(upper.chosen, Representation::LightMap);
  EXPECT_EQ(lower.chosen, Representation::Points);
  EXPECT_EQ(upper.inputTriangles, 32);
  EXPECT_EQ(upper.refinedTriangles, 32 * 16);
  EXPECT_EQ(lower.Introduced(), 0);
  EXPECT_NEAR(upper.area, 1, 1e-5);
}

TEST(SurfaceRepresentation, ABudgetOfTrianglesKeepsPoints) {
  const TwoPlanes planes(2);
  RepresentationOptions options;
  options.introducedTriangles = 32 * 15 - 1;
  EXPECT_EQ(ChooseRepresentations(planes.mesh, planes.solution, options)[planes.Upper()].chosen,
            Representation::LightMap);
  options.introducedTriangles = 32 * 15;
  EXPECT_EQ(ChooseRepresentations(planes.mesh, planes.solution, options)[planes.Upper()].chosen,
            Representation::Points);
}

TEST(SurfaceRepresentation, WhatIsWantedStands) {
  const TwoPlanes planes(2);
  RepresentationOptions options;
  options.wanted.assign(2, Representation::LightMap);
  options.wanted[planes.Upper()] = Representation::Points;
  const auto costs = ChooseRepresentations(planes.mesh, planes.solution, options);
  EXPECT_EQ(costs[planes.Upper()].chosen, Representation::Points);
  EXPECT_EQ(costs[1 - planes.Upper()].chosen, Representation::LightMap);
}

TEST(SurfaceRepresentation, ShowsTheLightOfTheSolutionEitherWay) {
  const TwoPlanes planes(3);
  const RepresentedScene scene =
      RepresentSurfaces(planes.mesh, planes.tree, planes.solution, {}, Page());

  // The lower plane as it is.
  EXPECT_EQ(scene.points.mesh.FaceCount(), 32);
  for (size_t p = 0; p < scene.points.mesh.positions.size(); ++p) {
    EXPECT_EQ(scene.points.mesh.positions[p].z, 0);
    EXPECT_TRUE(scene.points.irradiance[p] == Strip(scene.points.mesh.positions[p]));
  }

  // The upper one on a page of its own, far truer than its 25 points, whose strip falls between.
  const SurfaceCost& upper = scene.surfaces[planes.Upper()];
  EXPECT_EQ(scene.mapped.mesh.FaceCount(), 32);
  EXPECT_EQ(scene.mapped.tree.surfaceRoots.size(), 1u);
  EXPECT_EQ(scene.atlas.pages, 1);
  EXPECT_NEAR(double(upper.texels), 1 / (scene.atlas.texelSize * scene.atlas.texelSize), 1);
  EXPECT_GT(upper.inputPointError, 0.2);
  EXPECT_LT(upper.mapError, 0.02);  // Cells of the solution are seven texels wide.

  // The lower one would take as many texels; what they would show nobody has drawn.
  const SurfaceCost& lower = scene.surfaces[1 - planes.Upper()];
  EXPECT_NEAR(double(lower.texels), double(upper.texels), 1);
  EXPECT_EQ(lower.mapError, -1);
}

TEST(SurfaceRepresentation, NothingIsMappedWhereNothingWasRefined) {
  const TwoPlanes planes(0);
  const RepresentedScene scene =
      RepresentSurfaces(planes.mesh, planes.tree, planes.solution, {}, Page());
  EXPECT_EQ(scene.points.mesh.FaceCount(), 64);
  EXPECT_EQ(scene.mapped.mesh.FaceCount(), 0);
  EXPECT_EQ(scene.atlas.pages, 0);
  EXPECT_EQ(scene.surfaces[0].texels, -1);  // Of no size

  AtlasOptions sized = Page();
  sized.texelSize = 0.01;
  EXPECT_NEAR(double(RepresentSurfaces(planes.mesh, planes.tree, planes.solution, {}, sized)
                         .surfaces[0]
                         .texels),
              1e4, 1);
}

TEST(SurfaceRepresentation, RefusesOptionsThatDoNotFit) {
  const TwoPlanes planes(0);
  RepresentationOptions options;
  options.wanted.assign(3, Representation::Points);
  EXPECT_THROW(ChooseRepresentations(planes.mesh, planes.solution, options), Error);
  EXPECT_THROW(ChooseRepresentations(planes.mesh, planes.solution, {-1, {}}), Error);
  TriangleMesh unclustered = planes.mesh;
  unclustered.surfaceId.clear();
  EXPECT_THROW(ChooseRepresentations(unclustered, planes.solution, {}), Error);
}

// Two halves of a floor, of two materials, meet at x = 1; the light is smooth over both.
TEST(SurfaceRepresentation, NeighboursOfBothKindsMeetWithoutAStep) {
  TriangleMesh mesh;
  const TriangleMesh half = FlatGrid(8);
  for (const int32_t side : {0, 1}) {
    const int32_t first = int32_t(mesh.positions.size());
    for (const Vec3f& p : half.positions) {
      mesh.positions.push_back(p + Vec3f(float(side), 0, 0));
    }
    for (const auto& t : half.triangles) {
      mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
      mesh.materialId.push_back(side);
    }
  }
  mesh.Complete();
  const Clustered floor(mesh);
  RadiositySolution solution;
  solution.mesh = floor.mesh;
  for (int64_t face = 0; face < floor.mesh.FaceCount(); ++face) {
    solution.inputFaceId.push_back(face);
    solution.side.push_back(kFront);
  }
  const auto light = [](const Vec3f& p) { return Spectrum(2 + p.x + p.y * p.y); };
  for (const Vec3f& p : floor.mesh.positions) solution.irradiance.push_back(light(p));
  RepresentationOptions options;
  options.wanted = {Representation::Points, Representation::LightMap};
  const RepresentedMesh joined =
      JoinRepresentations(RepresentSurfaces(floor.mesh, floor.tree, solution, options, Page()));

  // At the points of the border, by themselves and by lookups.
  int byPoints = 0, byMap = 0;
  double largest = 0;
  for (size_t p = 0; p < joined.mesh.positions.size(); ++p) {
    if (joined.mesh.positions[p].x != 1) continue;
    const double wanted = double(light(joined.mesh.positions[p]).r);
    largest = std::max(largest, std::abs(double(joined.irradiance[p].r) / wanted - 1));
    ++(joined.lightMapCoords[p].x < 0 ? byPoints : byMap);
  }
  EXPECT_EQ(byPoints, 9);
  EXPECT_GE(byMap, 9);
  EXPECT_LT(largest, 0.003);  // Half a texel of 4 mm, of light that grows by a third a metre.
}

}  // namespace
}  // namespace lambert
