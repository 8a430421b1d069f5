#include "Scene/Core/PieceJoining.h"

#include <gtest/gtest.h>

namespace lambert::testing {
namespace {

using Rows = std::vector<int32_t>;

Material MaterialOf(const std::string& name, float reflectance = 0.5f) {
  Material material;
  material.name = name;
  material.reflectance = Spectrum(reflectance);
  return material;
}

/// Pieces that stand for their materials alone, with a face of each.
class Pieces {
 public:
  void Add(const std::vector<Material>& materials, const std::optional<Rows>& rows) {
    Scene piece;
    piece.materials = materials;
    joining_.NumberMaterials(rows, &piece);
    TriangleMesh mesh;
    for (const Material& material : piece.materials) {
      mesh.materialId.push_back(int32_t(assembly_.materials.size()));
      assembly_.materials.push_back(material);
    }
    assembly_.meshes.push_back(mesh);
  }
  void Join() { joining_.JoinMaterials(); }

  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const Material& material : assembly_.materials) names.push_back(material.name);
    return names;
  }
  const Rows& IdsOf(size_t piece) const { return assembly_.meshes[1 + piece].materialId; }
  const SceneAssembly& Assembly() const { return assembly_; }

 private:
  /// Behind a scene that is there already.
  SceneAssembly assembly_ = [] {
    SceneAssembly before;
    before.materials.push_back(MaterialOf("before"));
    before.meshes.emplace_back().materialId = {0};
    return before;
  }();
  PieceJoining joining_{&assembly_};
};

TEST(PieceJoining, MaterialsComeInTheOrderOfTheScene) {
  Pieces pieces;
  pieces.Add({MaterialOf("unused"), MaterialOf("red")}, Rows{0, 3});
  pieces.Add({MaterialOf("grey"), MaterialOf("red")}, Rows{1, 3});
  pieces.Add({}, Rows{});
  pieces.Add({MaterialOf("grey")}, Rows{2});
  pieces.Join();
  EXPECT_EQ(pieces.Names(), (std::vector<std::string>{"before", "unused", "grey", "grey", "red"}));
  EXPECT_EQ(pieces.Assembly().meshes[0].materialId, Rows{0});
  EXPECT_EQ(pieces.IdsOf(0), (Rows{1, 4}));
  EXPECT_EQ(pieces.IdsOf(1), (Rows{2, 4}));
  EXPECT_EQ(pieces.IdsOf(3), Rows{3});
}

TEST(PieceJoining, PiecesOfTwoScenesKeepTheirMaterials) {
  Pieces pieces;
  pieces.Add({MaterialOf("white", 0.8f)}, Rows{0});
  pieces.Add({MaterialOf("white", 0.7f), MaterialOf("red")}, Rows{0, 1});
  pieces.Add({MaterialOf("white", 0.8f)}, Rows{0});
  pieces.Join();
  EXPECT_EQ(pieces.Names(), (std::vector<std::string>{"before", "white", "white", "red"}));
  EXPECT_EQ(pieces.IdsOf(0), Rows{1});
  EXPECT_EQ(pieces.IdsOf(1), (Rows{2, 3}));
  EXPECT_EQ(pieces.IdsOf(2), Rows{1});
  EXPECT_EQ(pieces.Assembly().materials[2].reflectance, Spectrum(0.7f));
}

TEST(PieceJoining, LeavesMaterialsThatHaveNoRows) {
  Pieces pieces;
  pieces.Add({MaterialOf("a"), MaterialOf("b")}, Rows{1, 0});
  pieces.Add({MaterialOf("a")}, {});
  pieces.Join();
  EXPECT_EQ(pieces.Names(), (std::vector<std::string>{"before", "a", "b", "a"}));
  EXPECT_EQ(pieces.IdsOf(0), (Rows{1, 2}));
}

TEST(PieceJoining, APieceHasNoMaterialsBeyondItsRows) {
  Pieces pieces;
  pieces.Add({Material()}, Rows{});  // What a reader makes of an empty table.
  pieces.Join();
  EXPECT_EQ(pieces.Names(), std::vector<std::string>{"before"});
}

TEST(PieceJoining, LightsAreThereOnce) {
  SceneAssembly assembly;
  PieceJoining joining(&assembly);
  Scene scene;
  scene.lights.resize(2);
  scene.lights[1].name = "lamp";
  Scene first = scene, second = scene, other = scene, fewer = scene;
  other.lights[1].position.x = 1;
  fewer.lights.pop_back();
  Scene otherAgain = other;
  for (Scene* piece : {&first, &second, &other, &fewer, &otherAgain}) {
    joining.TakeRepeatedLights(piece);
  }
  EXPECT_EQ(first.lights.size(), 2u);
  EXPECT_TRUE(second.lights.empty());
  EXPECT_EQ(other.lights.size(), 2u);
  EXPECT_EQ(fewer.lights.size(), 1u);
  EXPECT_TRUE(otherAgain.lights.empty());
}

}  // namespace
}  // namespace lambert::testing
