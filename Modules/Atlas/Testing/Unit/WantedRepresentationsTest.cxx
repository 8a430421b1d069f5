#include "Atlas/Core/WantedRepresentations.h"

#include <gtest/gtest.h>

#include "AtlasMeshes.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

using Kinds = std::vector<Representation>;
constexpr Representation kAutomatic = Representation::Automatic, kPoints = Representation::Points,
                         kLightMap = Representation::LightMap;

/// Four planes: walls of the parts hall and porch, floors of the same.
struct FourPlanes {
  Scene scene;
  ClusterTree tree;

  FourPlanes() {
    for (const char* name : {"wall", "floor"}) {
      scene.materials.emplace_back();
      scene.materials.back().name = name;
    }
    for (const char* name : {"hall", "porch"}) {
      scene.parts.emplace_back();
      scene.parts.back().name = name;
    }
    for (const int32_t part : {0, 1}) {
      for (const int32_t material : {0, 1}) {
        Append(FlatGrid(1), {3 * float(part), 0, 3 * float(material)}, &scene.mesh);
        scene.mesh.partId.resize(scene.mesh.triangles.size(), part);
        scene.mesh.materialId.resize(scene.mesh.triangles.size(), material);
      }
    }
    scene.mesh.Complete();
    tree = ClusterFaces(&scene.mesh, scene.parts);
  }

  /// Number of the surface of that material and part.
  int32_t Surface(int32_t material, int32_t part) const {
    size_t face = 0;
    while (scene.mesh.materialId[face] != material || scene.mesh.partId[face] != part) ++face;
    return scene.mesh.surfaceId[face];
  }
};

TEST(WantedRepresentations, TheNarrowestNameCounts) {
  const FourPlanes planes;
  ASSERT_EQ(planes.tree.surfaceRoots.size(), 4u);
  WantedRepresentations wanted;
  EXPECT_TRUE(wanted.IsEmpty());
  EXPECT_EQ(RepresentationsOfSurfaces(planes.scene, planes.tree, wanted, kAutomatic),
            Kinds(4, kAutomatic));
  wanted.byMaterial["floor"] = kPoints;
  wanted.byPart["porch"] = kLightMap;
  const int32_t hallWall = planes.Surface(0, 0), hallFloor = planes.Surface(1, 0),
                porchWall = planes.Surface(0, 1), porchFloor = planes.Surface(1, 1);
  Kinds kinds = RepresentationsOfSurfaces(planes.scene, planes.tree, wanted, kAutomatic);
  EXPECT_EQ(kinds[size_t(hallWall)], kAutomatic);
  EXPECT_EQ(kinds[size_t(hallFloor)], kPoints);
  EXPECT_EQ(kinds[size_t(porchWall)], kLightMap);
  EXPECT_EQ(kinds[size_t(porchFloor)], kLightMap);

  wanted.bySurface[porchFloor] = kPoints;
  wanted.bySurface[porchWall] = kAutomatic;  // No wish
  kinds = RepresentationsOfSurfaces(planes.scene, planes.tree, wanted, kAutomatic);
  EXPECT_EQ(kinds[size_t(porchFloor)], kPoints);
  EXPECT_EQ(kinds[size_t(porchWall)], kLightMap);
}

TEST(WantedRepresentations, RefusesWhatTheSceneDoesNotHave) {
  const FourPlanes planes;
  WantedRepresentations wanted;
  wanted.byMaterial["floor"] = wanted.byPart["hall"] = wanted.bySurface[3] = kPoints;
  EXPECT_NO_THROW(RequireMaterialsAndParts(planes.scene, wanted));
  EXPECT_NO_THROW(RequireSurfaces(4, wanted));
  EXPECT_THROW(RequireSurfaces(3, wanted), Error);
  wanted.bySurface[4] = kPoints;
  EXPECT_THROW(RepresentationsOfSurfaces(planes.scene, planes.tree, wanted, kAutomatic), Error);
  wanted.byPart["floor"] = kPoints;
  EXPECT_THROW(RequireMaterialsAndParts(planes.scene, wanted), Error);
}

}  // namespace
}  // namespace lambert
