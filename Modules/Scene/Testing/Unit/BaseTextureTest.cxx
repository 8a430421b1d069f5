#include "Scene/Core/BaseTexture.h"

#include "SceneReaderFixture.h"

namespace lambert {
namespace {

using namespace testing;

constexpr float kCode128 = 0.21586f;  ///< linear

/// A square of 1 m in two faces under an image of two texels, the left white, the right of code
/// 128; and a face that emits.
struct TexturedSquare {
  Scene scene;

  TexturedSquare() {
    scene.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    scene.mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}};
    scene.mesh.faceFlags = {0, 0, kEmitsFront};
    scene.mesh.Complete();
    auto source = std::make_shared<TextureSource>();
    source->name = "two";
    source->bytes =
        std::string("P6\n2 1\n255\n") + std::string(3, char(255)) + std::string(3, char(128));
    BaseTexture texture;
    texture.source = source;
    texture.factor = {0.5f, 1, 2};
    scene.materials.resize(1);
    scene.materials[0].baseTexture = std::make_shared<BaseTexture>(texture);
  }
};

TEST(BaseTexture, ReflectanceIsFactorTimesTexelAtTheirMiddles) {
  const TexturedSquare square;
  const BaseTextures textures(square.scene);
  ASSERT_TRUE(textures.IsTextured(0));
  // Barycentrics of the places (0.75, 0.5) and (0.25, 0.5).
  ExpectNear(textures.Reflectance(0, {0.25, 0.25, 0.5}, 0),
             {0.5f * kCode128, kCode128, 2 * kCode128}, 1e-4f);
  ExpectNear(textures.Reflectance(1, {0.5, 0.25, 0.25}, 0), {0.5f, 0.98f, 0.98f});
}

TEST(BaseTexture, LookupsAreBilinearAndTheMeanFromAfar) {
  const TexturedSquare square;
  const BaseTextures textures(square.scene);
  const float mean = 0.5f * (1 + kCode128);
  ExpectNear(textures.Reflectance(0, {0.5, 0, 0.5}, 0), {0.5f * mean, mean, 0.98f}, 1e-4f);
  ExpectNear(textures.Reflectance(0, {0.25, 0.25, 0.5}, 1), {0.5f * mean, mean, 0.98f}, 1e-4f);
  ExpectNear(textures.MeanReflectance(0), {0.5f * mean, mean, 0.98f}, 1e-4f);
}

TEST(BaseTexture, LampsShowTheirLight) {
  const TexturedSquare square;
  EXPECT_FALSE(BaseTextures(square.scene).IsTextured(2));
}

TEST(BaseTexture, ImagesRepeatOrEnd) {
  TexturedSquare square;
  for (Vec2f& uv : square.scene.mesh.uvs) uv.x += 1;
  const std::array<double, 3> left = {0.75, 0.125, 0.125};  // (0.25, 0.125) of the square
  ExpectNear(BaseTextures(square.scene).Reflectance(0, left, 0), {0.5f, 0.98f, 0.98f});
  BaseTexture clamped = *square.scene.materials[0].baseTexture;
  clamped.map.wrapU = TextureWrap::Clamp;
  square.scene.materials[0].baseTexture = std::make_shared<BaseTexture>(clamped);
  ExpectNear(BaseTextures(square.scene).Reflectance(0, left, 0),
             {0.5f * kCode128, kCode128, 2 * kCode128}, 1e-4f);
}

// What the reader keeps of a file: images that the mesh can be looked up in.
class KeptTextureTest : public SceneReaderTest {
 protected:
  Material ReadMaterial(const std::string& faces, const std::string& setting = "") {
    Write("two.ppm", std::string("P6\n2 1\n255\n") + std::string(6, char(200)));
    Write("m.mtl", "newmtl cloth\nKd .5 .5 .5\nmap_Kd two.ppm\n");
    SceneAssembly assembly = ReadScene({Write(
        "s.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl cloth\n" + faces)});
    if (!setting.empty()) ApplyMaterialSetting(setting, &assembly);
    return Named(assembly, "cloth");
  }
};

TEST_F(KeptTextureTest, OfAMeshWithTextureCoordinates) {
  const Material cloth = ReadMaterial("f 1/1 2/1 3/1\n");
  ASSERT_NE(cloth.baseTexture, nullptr);
  ExpectNear(cloth.baseTexture->factor, Spectrum(0.5f));
  EXPECT_EQ(cloth.baseTexture->source->bytes.substr(0, 2), "P6");
  EXPECT_NE(cloth.baseTexture->source->name.find("two.ppm"), std::string::npos);
}

TEST_F(KeptTextureTest, NotWhereNothingTellsThePlace) {
  EXPECT_EQ(ReadMaterial("f 1 2 3\n").baseTexture, nullptr);
}

TEST_F(KeptTextureTest, NotWhereAnotherReflectanceIsAskedFor) {
  EXPECT_EQ(ReadMaterial("f 1/1 2/1 3/1\n", "cloth:reflectance=.1,.1,.1").baseTexture, nullptr);
  EXPECT_NE(ReadMaterial("f 1/1 2/1 3/1\n", "cloth:two-sided").baseTexture, nullptr);
}

}  // namespace
}  // namespace lambert
