#include "Scene/Core/SceneReaderGltf.h"

#include "SceneReaderFixture.h"

namespace lambert {
namespace {

using namespace testing;

/// A glTF whose meshes are the triangle (0,0,0) (1,0,0) (0,1,0) with uvs (0,0) (1,0) (0,1) in image
/// coordinates.
class GltfText {
 public:
  std::string materials = "[{}]", nodes = R"([{"mesh":0}])", rest;
  std::string meshes =
      R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}])";

  std::string Text(const std::string& buffer) const {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
           R"(,"meshes":)" + meshes + R"(,"materials":)" + materials + R"(,"buffers":[{)" + buffer +
           R"("byteLength":100}],"bufferViews":[{"buffer":0,"byteLength":36},
        {"buffer":0,"byteOffset":36,"byteLength":24},{"buffer":0,"byteOffset":60,"byteLength":12},
        {"buffer":0,"byteOffset":72,"byteLength":24}],"accessors":[
        {"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
        {"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},
        {"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"},
        {"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"}])" +
           rest + "}";
  }

  /// Positions, uvs, indices and the two instance translations (0,0,5) and (0,0,7).
  static std::string Bytes(uint16_t lastIndex = 2) {
    const float values[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
    const uint16_t indices[] = {0, 1, 2, 0, 1, lastIndex};
    const float translations[] = {0, 0, 5, 0, 0, 7};
    std::string bytes(reinterpret_cast<const char*>(values), sizeof values);
    bytes.append(reinterpret_cast<const char*>(indices), sizeof indices);
    bytes.append(reinterpret_cast<const char*>(translations), sizeof translations);
    return bytes + std::string(4, '\0');
  }
};

class GltfReaderTest : public SceneReaderTest {
 protected:
  std::string WriteGltf(const GltfText& gltf) {
    Write("b.bin", GltfText::Bytes());
    return Write("s.gltf", gltf.Text(R"("uri":"b.bin",)"));
  }
};

TEST_F(GltfReaderTest, EmissiveStrengthInNit) {
  GltfText gltf;
  gltf.materials =
      R"([{"name":"unused"},{"name":"lamp","emissiveFactor":[1,0.5,0],"doubleSided":true,
          "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":683}}}])";
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"material":1}]}])";
  const SceneAssembly scene = ReadScene({WriteGltf(gltf)});
  // 683 nit of one band is 1 W/(m2 sr) of radiance there, so pi W/m2; doubleSided emits from both
  // sides.
  ASSERT_EQ(scene.materials.size(), 1u);
  ExpectNear(Named(scene, "lamp").emittance, {3.14159265f, 1.57079633f, 0});
  EXPECT_EQ(scene.meshes.at(0).faceFlags.at(0), kEmitsFront | kEmitsBack);
  ExpectNear(scene.meshes[0].reflectance[0], Spectrum(0.98f));
  EXPECT_EQ(scene.report.materialsClamped, 1);
}

TEST_F(GltfReaderTest, TransformsAndSharedMeshes) {
  GltfText gltf;
  gltf.nodes =
      R"([{"name":"root","translation":[10,0,0],"children":[1,2]},{"name":"a","mesh":0,"scale":[2,2,2]},
                   {"name":"b","mesh":0,"rotation":[0,0,0.70710678,0.70710678]}])";
  const SceneAssembly scene = ReadScene({WriteGltf(gltf)});
  ASSERT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.parts[0].name, "a");
  EXPECT_EQ(scene.parts[0].meshId, scene.parts[1].meshId);
  const auto& a = scene.parts[0].objectToWorld;
  EXPECT_DOUBLE_EQ(a[0], 2);
  EXPECT_DOUBLE_EQ(a[3], 10);
  // A quarter turn about z takes x to y; the importer keeps rotations in single precision.
  const auto& b = scene.parts[1].objectToWorld;
  EXPECT_NEAR(b[4], 1, 1e-6);
  EXPECT_NEAR(b[0], 0, 1e-6);
  EXPECT_DOUBLE_EQ(b[3], 10);
}

TEST_F(GltfReaderTest, GpuInstances) {
  GltfText gltf;
  gltf.nodes = R"([{"mesh":0,"scale":[2,2,2],
                    "extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":3}}}}])";
  gltf.rest = R"(,"extensionsUsed":["EXT_mesh_gpu_instancing"])";
  const SceneAssembly scene = ReadScene({WriteGltf(gltf)});
  ASSERT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.parts[0].objectToWorld[11], 10);
  EXPECT_DOUBLE_EQ(scene.parts[1].objectToWorld[11], 14);
}

TEST_F(GltfReaderTest, LightsAndCamera) {
  GltfText gltf;
  gltf.nodes =
      R"([{"mesh":0,"children":[1,2,3,4]},
          {"name":"p","translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},
          {"rotation":[0.70710678,0,0,0.70710678],"extensions":{"KHR_lights_punctual":{"light":1}}},
          {"extensions":{"KHR_lights_punctual":{"light":2}}},
          {"translation":[0,0,4],"camera":0}])";
  gltf.rest =
      R"(,"extensionsUsed":["KHR_lights_punctual"],"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],
         "extensions":{"KHR_lights_punctual":{"lights":[
         {"type":"point","color":[1,0.5,0.25],"intensity":683},
         {"type":"spot","intensity":1366,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}},
         {"type":"directional","name":"sun","intensity":68300}]}})";
  SceneReaderOptions options;
  options.metresPerUnit = 0.5;
  const SceneAssembly scene = ReadScene({WriteGltf(gltf)}, options);
  ASSERT_EQ(scene.lights.size(), 3u);
  // Candela and lux over 683: W/sr and W/m2, colour kept; the unit scales places, not intensities.
  const Light &point = scene.lights[0], &spot = scene.lights[1], &sun = scene.lights[2];
  EXPECT_EQ(point.type, LightType::Point);
  EXPECT_EQ(point.name, "p");
  ExpectNear(point.intensity, {1, 0.5f, 0.25f});
  EXPECT_EQ(point.position, Vec3f(0.5f, 1, 1.5f));
  EXPECT_EQ(spot.type, LightType::Spot);
  ExpectNear(spot.intensity, Spectrum(2.f));
  EXPECT_FLOAT_EQ(spot.innerConeAngle, 0.1f);
  EXPECT_FLOAT_EQ(spot.outerConeAngle, 0.2f);
  EXPECT_NEAR(spot.direction.y, 1, kRounding);  // -z turned a quarter about x
  EXPECT_EQ(sun.type, LightType::Directional);
  EXPECT_EQ(sun.name, "sun");
  ExpectNear(sun.intensity, Spectrum(100.f));
  EXPECT_EQ(sun.direction, Vec3f(0, 0, -1));
  ASSERT_TRUE(scene.camera);
  EXPECT_DOUBLE_EQ(scene.camera->position.z, 2);
  EXPECT_NEAR(scene.camera->verticalFieldOfView, 57.29577951, 1e-6);  // One radian.
}

TEST_F(GltfReaderTest, TransparencyAndMetals) {
  GltfText gltf;
  const char* const primitive = R"({"attributes":{"POSITION":0},"material":)";
  gltf.meshes = "[{\"primitives\":[";
  for (int i = 0; i < 6; ++i) gltf.meshes += (i ? "," : "") + (primitive + std::to_string(i)) + "}";
  gltf.meshes += "]}]";
  gltf.materials =
      R"([{"name":"blend","alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.4]}},
          {"name":"thick","alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,0.6],"metallicFactor":0}},
          {"name":"opaque","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,0.1],"metallicFactor":0}},
          {"name":"mask","alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,0.7],"metallicFactor":0}},
          {"name":"glass","extensions":{"KHR_materials_transmission":{"transmissionFactor":0.9}}},
          {"name":"metal","pbrMetallicRoughness":{"baseColorFactor":[0.8,0.4,0.2,1],"metallicFactor":0.75}}])";
  const std::string file = WriteGltf(gltf);
  const SceneAssembly scene = ReadScene({file});
  EXPECT_EQ(scene.parts.size(), 4u);
  EXPECT_EQ(scene.report.transparentMaterials, 2);
  EXPECT_EQ(scene.report.maskedMaterials, 1);
  for (const char* name : {"thick", "opaque", "mask"}) {
    ExpectNear(MeshOf(scene, name).reflectance[0], Spectrum(0.5f));
  }
  ExpectNear(MeshOf(scene, "metal").reflectance[0], {0.8f, 0.4f, 0.2f});

  SceneReaderOptions black;
  black.blackMetals = true;
  ExpectNear(MeshOf(ReadScene({file}, black), "metal").reflectance[0], {0.2f, 0.1f, 0.05f});
}

// 2 x 2 texels: left column white, right black; alpha 255 above, 0 below.
const char* const kPng =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFElEQVR42mP4DwQMDAz/"
    "GSA0AwMAXLUH+fA8sroAAAAASUVORK5CYII=";

TEST_F(GltfReaderTest, TexturesOfEmissionAndMasks) {
  GltfText gltf;
  // The second primitive looks at the left upper texel alone, the third at the lower row.
  gltf.materials =
      R"([{"name":"screen","emissiveFactor":[1,1,1],"emissiveTexture":{"index":0},
           "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":683}}},
          {"name":"leaf","alphaMode":"MASK","pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.5,0.5,0.5,1],
           "baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"scale":[0.4,0.4]}}}}},
          {"name":"cut","alphaMode":"MASK","pbrMetallicRoughness":{
           "baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"scale":[0.4,0.4],"offset":[0,0.55]}}}}}])";
  gltf.meshes = "[{\"primitives\":[";
  for (int i = 0; i < 3; ++i) {
    gltf.meshes +=
        (i ? "," : "") +
        (R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":)" + std::to_string(i)) + "}";
  }
  gltf.meshes += "]}]";
  gltf.rest = R"(,"textures":[{"source":0}],"images":[{"mimeType":"image/png","uri":")" +
              std::string(kPng) + "\"}]";
  const SceneAssembly scene = ReadScene({WriteGltf(gltf)});
  // Three quarters of the triangle lie in the white column: 0.75 pi W/m2, to one part in 16 (8
  // samples an edge).
  ExpectNear(MeshOf(scene, "screen").emittance[0], Spectrum(2.35619449f), 0.0625f);
  ExpectNear(MeshOf(scene, "leaf").reflectance[0], Spectrum(0.5f));
  EXPECT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.report.maskedMaterials, 2);
  EXPECT_EQ(scene.report.transparentFaces, 1);
}

TEST_F(GltfReaderTest, BinaryFile) {
  GltfText gltf;
  gltf.materials = R"([{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1]}}])";
  std::string json = gltf.Text("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string bin = GltfText::Bytes();
  const auto word = [](size_t value) {
    const uint32_t bits = uint32_t(value);
    return std::string(reinterpret_cast<const char*>(&bits), 4);
  };
  const std::string glb = "glTF" + word(2) + word(12 + 8 + json.size() + 8 + bin.size()) +
                          word(json.size()) + "JSON" + json + word(bin.size()) +
                          std::string("BIN\0", 4) + bin;
  const SceneAssembly scene = ReadScene({Write("s.glb", glb)});
  EXPECT_EQ(scene.meshes.at(0).Corner(0, 1), Vec3f(1, 0, 0));
  ExpectNear(scene.meshes[0].reflectance[0], {0.1f, 0.2f, 0.3f});
  for (const size_t length : {size_t(10), size_t(60), glb.size() - 20}) {
    ExpectSentence(Write("cut.glb", glb.substr(0, length)), "cut off");
  }
}

TEST_F(GltfReaderTest, BrokenFiles) {
  const GltfText gltf;
  const std::string text = gltf.Text(R"("uri":"b.bin",)");
  ExpectSentence(Write("cut.gltf", text.substr(0, text.size() / 2)), "cut off");
  ExpectSentence(Write("nobuffer.gltf", text), "b.bin");
  Write("b.bin", GltfText::Bytes().substr(0, 40));
  ExpectSentence(Write("shortbuffer.gltf", text), "cannot be read");
  Write("b.bin", GltfText::Bytes(99));
  ExpectSentence(Write("index.gltf", text), "names a point that is not there");

  Write("b.bin", GltfText::Bytes());
  GltfText broken;
  broken.nodes = R"([{"mesh":0,"children":[0]}])";
  ExpectSentence(Write("loop.gltf", broken.Text(R"("uri":"b.bin",)")), "no tree");
  broken = {};
  broken.rest = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])";
  ExpectSentence(Write("draco.gltf", broken.Text(R"("uri":"b.bin",)")),
                 "KHR_draco_mesh_compression");
  broken = {};
  broken.nodes = R"([{"mesh":"zero"}])";
  ExpectSentence(Write("type.gltf", broken.Text(R"("uri":"b.bin",)")), "");
  broken = {};
  broken.nodes = R"([{"mesh":7}])";
  EXPECT_NE(Sentence(Write("row.gltf", broken.Text(R"("uri":"b.bin",)"))), "");
}

}  // namespace
}  // namespace lambert
