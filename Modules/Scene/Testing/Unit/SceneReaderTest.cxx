#include "Scene/Core/SceneReader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "Common/Core/Error.h"
#include "Scene/Core/SceneCleaning.h"

namespace lambert {
namespace {

namespace fs = std::filesystem;

// Values go through single precision and one or two products.
constexpr float kRounding = 1e-5f;

void ExpectNear(const Spectrum& value, const Spectrum& expected, float tolerance = kRounding) {
  for (int band = 0; band < 3; ++band) {
    EXPECT_NEAR(value[band], expected[band], tolerance * std::max(1.f, expected[band]))
        << "band " << band;
  }
}

/// A folder of its own for each test, gone afterwards.
class SceneReaderTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("lambert-" + std::string(test->name()) + "-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }

  /// The sentence that reading the file ends with; empty where it is read.
  static std::string Sentence(const std::string& file) {
    try {
      ReadScene({file});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  static void ExpectSentence(const std::string& file, const std::string& part) {
    const std::string sentence = Sentence(file);
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(file), std::string::npos) << sentence;
    EXPECT_EQ(sentence.back(), '.') << sentence;
  }

  fs::path folder_;
};

const Material& Named(const SceneAssembly& scene, const std::string& name) {
  for (const Material& material : scene.materials) {
    if (material.name == name) return material;
  }
  throw Error("no material " + name);
}

/// The mesh whose first face has the material.
const TriangleMesh& MeshOf(const SceneAssembly& scene, const std::string& material) {
  for (const TriangleMesh& mesh : scene.meshes) {
    if (scene.materials[size_t(mesh.materialId[0])].name == material) return mesh;
  }
  throw Error("no mesh of " + material);
}

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

// ---- OBJ ---------------------------------------------------------------------------------------

TEST_F(SceneReaderTest, ObjMaterials) {
  Write("m.mtl",
        "newmtl wall\nKd .2 0.3 .4\nnewmtl lamp\nKd 0 0 0\nKe 1 2 3\nnewmtl bright\nKd 5 0.5 1\n"
        "newmtl glass\nKd 1 1 1\nd .4\nnewmtl none\nKs 1 1 1\n");
  const std::string file =
      Write("s.obj", std::string("mtllib m.mtl\n") + kTriangle +
                         "usemtl wall\nf 1 2 3\nusemtl lamp\nf 1 2 3\nusemtl bright\nf 1 2 3\n"
                         "usemtl glass\nf 1 2 3\nf 3 2 1\nusemtl none\nf 1 2 3\n");
  const SceneAssembly scene = ReadScene({file});
  EXPECT_EQ(scene.parts.size(), 4u);
  ExpectNear(MeshOf(scene, "wall").reflectance[0], {0.2f, 0.3f, 0.4f});
  EXPECT_EQ(MeshOf(scene, "wall").faceFlags[0], 0);

  // Radiance 1, 2, 3 W/(m2 sr) is pi times as much exitance, from the front.
  const TriangleMesh& lamp = MeshOf(scene, "lamp");
  ExpectNear(lamp.emittance[0], {3.14159265f, 6.2831853f, 9.42477796f});
  EXPECT_EQ(lamp.faceFlags[0], kEmitsFront);
  ExpectNear(Named(scene, "lamp").emittance, lamp.emittance[0]);

  // Clamped, transparent and missing.
  ExpectNear(MeshOf(scene, "bright").reflectance[0], {0.98f, 0.5f, 0.98f});
  EXPECT_EQ(scene.report.materialsClamped, 1);
  EXPECT_EQ(scene.report.transparentMaterials, 1);
  EXPECT_EQ(scene.report.transparentFaces, 2);
  EXPECT_EQ(scene.report.faces, 6);
  ExpectNear(MeshOf(scene, "none").reflectance[0], Spectrum(0.5f));
  EXPECT_EQ(scene.report.unit, "m");
}

TEST_F(SceneReaderTest, Options) {
  Write("m.mtl", "newmtl lamp\nKe 1 1 1\nnewmtl glass\nKd .3 .3 .3\nd 0\n");
  const std::string file = Write("s.obj", std::string("mtllib m.mtl\n") + kTriangle +
                                              "usemtl lamp\nf 1 2 3\nusemtl glass\nf 1 2 3\n");
  SceneReaderOptions options;
  options.metresPerUnit = 0.01;
  options.defaultReflectance = Spectrum(0.25f);
  options.twoSidedEmitters = true;
  options.opaqueGlass = true;
  const SceneAssembly scene = ReadScene({file}, options);
  EXPECT_EQ(scene.report.unit, "cm");
  EXPECT_DOUBLE_EQ(scene.report.metresPerUnit, 0.01);
  EXPECT_DOUBLE_EQ(scene.parts[0].objectToWorld[0], 0.01);
  EXPECT_DOUBLE_EQ(scene.parts[0].objectToWorld[15], 1);
  EXPECT_EQ(MeshOf(scene, "lamp").faceFlags[0], kEmitsFront | kEmitsBack);
  ExpectNear(MeshOf(scene, "lamp").reflectance[0], Spectrum(0.25f));
  ExpectNear(MeshOf(scene, "glass").reflectance[0], Spectrum(0.3f));
  EXPECT_EQ(scene.report.transparentFaces, 0);
}

TEST_F(SceneReaderTest, LampsShineThroughTheirGlass) {
  // A lamp in a shell, a millimetre behind its glass, shines through it; where glass is opaque, the
  // lamp faces a surface at no distance.
  Write("m.mtl", "newmtl lamp\nKe 1 1 1\nnewmtl glass\nd .1\nnewmtl shell\nKd .5 .5 .5\n");
  const std::string file =
      Write("s.obj",
            "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 .001\nv 1 0 .001\nv 0 1 .001\n"
            "v 0 0 -.2\nv 1 0 -.2\nv 0 1 -.2\nusemtl lamp\nf 1 2 3\nusemtl glass\nf 4 5 6\n"
            "usemtl shell\nf 7 8 9\n");
  for (const bool opaque : {false, true}) {
    SceneReaderOptions options;
    options.opaqueGlass = opaque;
    CleaningReport report;
    AssembleScene(ReadScene({file}, options), {}, &report);
    EXPECT_EQ(report.invertedEmitters, opaque ? 1 : 0);
  }
}

TEST_F(SceneReaderTest, TransparencyOfMtl) {
  // Tr is 1 - d, and counts where there is no d.
  Write("m.mtl", "newmtl clear\nKd 1 1 1\nTr .9\nnewmtl both\nKd .1 .1 .1\nd 1\nTr 1\n");
  const std::string file = Write("s.obj", std::string("mtllib m.mtl\n") + kTriangle +
                                              "usemtl clear\nf 1 2 3\nusemtl both\nf 1 2 3\n");
  const SceneAssembly scene = ReadScene({file});
  ASSERT_EQ(scene.parts.size(), 1u);
  ExpectNear(MeshOf(scene, "both").reflectance[0], Spectrum(0.1f));
  EXPECT_EQ(scene.report.transparentMaterials, 1);
}

TEST_F(SceneReaderTest, NumbersWithoutALeadingZero) {
  const std::string file = Write("s.obj", "v .25 -.5 +.5\nv 1 0 0\nv 0 1e0 .0\nf 1 2 3\n");
  const TriangleMesh mesh = ReadScene({file}).meshes.at(0);
  EXPECT_EQ(mesh.Corner(0, 0), Vec3f(0.25f, -0.5f, 0.5f));
}

TEST_F(SceneReaderTest, PolygonsKeepTheirNumber) {
  // A square, a segment, an arrow head that a fan would turn over, a triangle.
  const std::string file =
      Write("s.obj",
            "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 1\nv 1 1 1\nv 4 0 1\nv 0 4 1\n"
            "f 1 2 3 4\nl 1 2\nf 8 6 5 7\nf 1 2 3\n");
  const SceneAssembly scene = ReadScene({file});
  EXPECT_EQ(scene.report.faces, 3);
  EXPECT_EQ(scene.report.polygonsTriangulated, 2);
  EXPECT_EQ(scene.report.linesAndPointsIgnored, 1);
  int64_t triangles = 0;
  double area = 0;
  std::vector<int64_t> sources;
  for (const TriangleMesh& mesh : scene.meshes) {
    triangles += mesh.FaceCount();
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
      EXPECT_GE(mesh.FrontNormal(face).z, 0.f);
      area += double(mesh.Area(face));
    }
    sources.insert(sources.end(), mesh.sourceCellId.begin(), mesh.sourceCellId.end());
  }
  EXPECT_EQ(triangles, 5);
  EXPECT_EQ(sources[0], sources[1]);
  EXPECT_NE(sources[1], sources[2]);
  EXPECT_EQ(sources[2], sources[3]);
  // Square 16, the triangle of area 8 less its dent of 2, triangle 8; exact in binary.
  EXPECT_DOUBLE_EQ(area, 16 + 6 + 8);
}

TEST_F(SceneReaderTest, DegenerateFacesAndNormalsAreKept) {
  const std::string file =
      Write("s.obj", std::string(kTriangle) +
                         "vn 0 1 0\nf 1//1 2//1 3//1\nf 1//1 1//1 1//1\nf 1//1 2//1 3//1\n");
  const TriangleMesh mesh = ReadScene({file}).meshes.at(0);
  EXPECT_EQ(mesh.FaceCount(), 3);
  EXPECT_EQ(mesh.normals.at(0), Vec3f(0, 1, 0));
}

TEST_F(SceneReaderTest, ObjTextInEveryDress) {
  // Lines that the importer would drop without a word: the material says whether all were read.
  Write("m.mtl", "newmtl lamp\n\tKd 0.1 0.2 0.3\n\tKe 1 2 3\n");
  const std::string lines = std::string("mtllib m.mtl\n") + kTriangle + "usemtl lamp\nf 1 2 3\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = lines;
    for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
    return text;
  };
  for (const std::string& text : {"\xEF\xBB\xBF" + lines, with("\n", "\r\n"), with("\n", "\r"),
                                  with("\n", "\n  "), "\t" + lines, with("mtllib ", "mtllib\t")}) {
    const SceneAssembly scene = ReadScene({Write("s.obj", text)});
    EXPECT_TRUE(scene.report.warnings.empty()) << text;
    EXPECT_EQ(MeshOf(scene, "lamp").FaceCount(), 1) << text;
    ExpectNear(Named(scene, "lamp").reflectance, {0.1f, 0.2f, 0.3f});
    ExpectNear(Named(scene, "lamp").emittance, Spectrum(1, 2, 3) * 3.14159265f);
  }
}

TEST_F(SceneReaderTest, MissingMaterialLibraryIsAWarning) {
  const std::string file =
      Write("s.obj", std::string("mtllib gone.mtl\n") + kTriangle + "usemtl red\nf 1 2 3\n");
  const SceneAssembly scene = ReadScene({file});
  ASSERT_EQ(scene.report.warnings.size(), 1u);
  EXPECT_NE(scene.report.warnings[0].find("gone.mtl"), std::string::npos);
  ExpectNear(Named(scene, "red").reflectance, Spectrum(0.5f));
}

TEST_F(SceneReaderTest, TexturesBeforeTheFirstMaterialAreNobodys) {
  // The importer would crash at them; a byte order mark hides the first material from it.
  for (const char* before : {"map_Kd gone.png\n", "\xEF\xBB\xBF", "Kd 1 1 1\nmap_d gone.png\n"}) {
    Write("m.mtl", std::string(before) + "newmtl red\nKd 0.1 0 0\nmap_Kd no.png\n");
    const SceneAssembly scene = ReadScene(
        {Write("s.obj", std::string("mtllib m.mtl\n") + kTriangle + "usemtl red\nf 1 2 3\n")});
    ExpectNear(Named(scene, "red").reflectance, {0.1f, 0, 0});
    EXPECT_EQ(scene.report.texturesMissing, 1) << before;
  }
  Write("m.mtl", "map_Kd gone.png\n");
  EXPECT_EQ(ReadScene({(folder_ / "s.obj").string()}).report.texturesMissing, 0);
}

TEST_F(SceneReaderTest, MaterialOfNoLibraryIsAWarning) {
  Write("m.mtl", "newmtl red\nKd 0.1 0 0\n");
  const std::string file =
      Write("s.obj", std::string("mtllib m.mtl\n") + kTriangle +
                         "usemtl red\nf 1 2 3\nusemtl lamp\nf 3 2 1\nusemtl unused\n");
  const SceneAssembly scene = ReadScene({file});
  ASSERT_EQ(scene.report.warnings.size(), 1u);
  EXPECT_NE(scene.report.warnings[0].find("\"lamp\""), std::string::npos);
  ExpectNear(Named(scene, "lamp").reflectance, Spectrum(0.5f));
}

TEST_F(SceneReaderTest, TextureIsTheMeanOverEachTriangle) {
  // 2 x 1 texels: left red 255, right code 128 in all bands; as a binary PPM.
  Write("t.ppm", std::string("P6\n2 1\n255\n") +
                     std::string({char(255), 0, 0, char(128), char(128), char(128)}));
  Write("m.mtl",
        "newmtl t\nKd .5 .5 .5\nmap_Kd t.ppm\nnewmtl gone\nKd .4 .4 .4\nmap_Kd gone.png\n");
  const std::string file =
      Write("s.obj",
            std::string("mtllib m.mtl\n") + kTriangle +
                "vt 0 0\nvt .5 0\nvt 0 1\nvt 1 0\nvt 1 1\nusemtl t\nf 1/1 2/2 3/3\nf 1/1 2/4 3/5\n"
                "usemtl gone\nf 1/1 2/2 3/3\n");
  const SceneAssembly scene = ReadScene({file});
  const TriangleMesh& mesh = MeshOf(scene, "t");
  // Code 128 is 0.21586 linear. The first triangle lies in the red texel.
  EXPECT_FLOAT_EQ(mesh.reflectance[0].r, 0.5f);
  EXPECT_FLOAT_EQ(mesh.reflectance[0].g, 0.f);
  // The second has a quarter of its area in the left texel. Its 8 x 8 samples cut the
  // border: one part in 16.
  ExpectNear(mesh.reflectance[1],
             {0.5f * (0.25f + 0.75f * 0.21586f), 0.5f * 0.75f * 0.21586f, 0.5f * 0.75f * 0.21586f},
             0.03f);
  ExpectNear(MeshOf(scene, "gone").reflectance[0], Spectrum(0.4f));
  EXPECT_EQ(scene.report.texturesMissing, 1);
  ASSERT_EQ(scene.report.warnings.size(), 1u);
  EXPECT_NE(scene.report.warnings[0].find("gone.png"), std::string::npos);
}

// ---- PLY, STL ----------------------------------------------------------------------------------

const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

TEST_F(SceneReaderTest, PlyColoursAreReflectance) {
  const std::string file =
      Write("s.ply", kPlyHeader + "0 0 0 128 0 0\n1 0 0 128 0 0\n0 1 0 128 255 0\n3 0 1 2\n");
  const SceneAssembly scene = ReadScene({file});
  // sRGB code 128 is 0.215861 linear; a third of the corners is 255.
  ExpectNear(scene.meshes.at(0).reflectance.at(0), {0.215861f, 1 / 3.f, 0});
}

TEST_F(SceneReaderTest, StlFacets) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\n";
  const SceneAssembly scene = ReadScene({Write("s.stl", "solid x\n" + facet + "endsolid x\n")});
  EXPECT_EQ(scene.meshes.at(0).FaceCount(), 1);
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  ExpectNear(scene.meshes[0].reflectance[0], Spectrum(0.5f));
  ExpectSentence(Write("cut.stl", "solid x\n" + facet + facet.substr(0, 40)), "cut off");
}

// ---- glTF --------------------------------------------------------------------------------------

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

// ---- Several files, errors, settings -----------------------------------------------------------

TEST_F(SceneReaderTest, FilesAreConcatenated) {
  const std::string a = Write("a.obj", std::string(kTriangle) + "usemtl x\nf 1 2 3\n");
  const std::string b =
      Write("b.ply", kPlyHeader + "0 0 0 0 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n");
  const SceneAssembly scene = ReadScene({a, b});
  ASSERT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.parts[0].source, a);
  EXPECT_EQ(scene.parts[1].source, b);
  EXPECT_EQ(scene.parts[1].meshId, 1);
  EXPECT_EQ(scene.meshes[1].materialId[0], 1);
  EXPECT_EQ(scene.report.files, (std::vector<std::string>{a, b}));
  ExpectNear(scene.meshes[1].reflectance[0], Spectrum(0.f));
}

TEST_F(SceneReaderTest, BrokenFiles) {
  ExpectSentence((folder_ / "gone.obj").string(), "does not exist");
  ExpectSentence(folder_.string(), "is a folder");
  ExpectSentence("/dev/null", "is a device");
  ExpectSentence(Write("empty.obj", ""), "is empty");
  ExpectSentence(Write("big.off", "OFF\n353535235358 6 0\n0 0 0\n"), "more points than");
  ExpectSentence(Write("a.unknown", "hello"), "cannot be read");
  ExpectSentence(Write("points.obj", std::string(kTriangle) + "v 1 1 1\np 1\n"),
                 "holds no triangle");
  ExpectSentence(Write("index.obj", std::string(kTriangle) + "f 1 2 4\n"), "index out of range");
  ExpectSentence(Write("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"),
                 "\"nan\" is not a finite number in line 2");
  ExpectSentence(Write("indented.obj", "v 0 0 0\n  v 1 nan 0\nv 0 1 0\nf 1 2 3\n"),
                 "\"nan\" is not a finite number in line 2");
  ExpectSentence(Write("inf.obj", "v 0 0 0\nv 1 1e99 0\nv 0 1 0\nf 1 2 3\n"),
                 "\"1e99\" is not a finite number");
  ExpectSentence(Write("short.obj", "v 0 0 0\nv 1 1\nv 0 1 0\nf 1 2 3\n"), "is missing in line 2");
  ExpectSentence(
      Write("nan.ply", kPlyHeader + "0 0 0 0 0 0\n1 nan 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n"),
      "not a finite number");
  ExpectSentence(Write("cut.ply", kPlyHeader + "0 0 0 0 0 0\n1 0 0 0 0 0\n"), "cut off");
  ExpectSentence(
      Write("index.ply", kPlyHeader + "0 0 0 0 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 9\n"),
      "names a point that is not there");
  Write("glass.mtl", "newmtl glass\nd 0.1\n");
  ExpectSentence(
      Write("glass.obj", std::string("mtllib glass.mtl\n") + kTriangle + "usemtl glass\nf 1 2 3\n"),
      "opaque glass");
  EXPECT_THROW(ReadScene({}), Error);
}

TEST_F(SceneReaderTest, BinaryPlyThatIsCutOff) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float "
      "y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const float points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t indices[] = {0, 1, 2};
  bytes.append(reinterpret_cast<const char*>(points), sizeof points);
  bytes += char(3);
  bytes.append(reinterpret_cast<const char*>(indices), sizeof indices);
  EXPECT_EQ(ReadScene({Write("s.ply", bytes)}).meshes.at(0).FaceCount(), 1);
  for (const size_t missing : {1u, 13u, 30u}) {
    ExpectSentence(Write("cut.ply", bytes.substr(0, bytes.size() - missing)), "cut off");
  }
}

TEST_F(SceneReaderTest, CancelThrows) {
  const std::string file = Write("s.obj", std::string(kTriangle) + "f 1 2 3\n");
  EXPECT_THROW(ReadScene({file}, {}, [](double, const char*) { return false; }), Cancelled);
  double last = -1;
  ReadScene({file, file}, {}, [&](double fraction, const char*) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  });
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST_F(SceneReaderTest, MaterialSettings) {
  const std::string file =
      Write("s.obj", std::string(kTriangle) + "usemtl a:x\nf 1 2 3\nusemtl b\nf 1 2 3\n");
  SceneAssembly scene = ReadScene({file});
  ApplyMaterialSetting("a:x:reflectance=0.1,0.2,0.3|a:x:emission=1,2,0|b:reflectance=0.7|two-sided",
                       &scene);
  const TriangleMesh &a = MeshOf(scene, "a:x"), &b = MeshOf(scene, "b");
  ExpectNear(a.reflectance[0], {0.1f, 0.2f, 0.3f});
  ExpectNear(a.emittance[0], {3.14159265f, 6.2831853f, 0});
  EXPECT_EQ(a.faceFlags[0], kEmitsFront);
  ExpectNear(b.reflectance[0], Spectrum(0.7f));
  EXPECT_EQ(b.faceFlags[0], 0);
  EXPECT_TRUE(Named(scene, "b").twoSidedEmitter);
  ApplyMaterialSetting("b:emission=1", &scene);
  EXPECT_EQ(b.faceFlags[0], kEmitsFront | kEmitsBack);
  ApplyMaterialSetting("b:emission=0", &scene);
  EXPECT_EQ(b.faceFlags[0], 0);
  ApplyMaterialSetting("b:reflectance=2", &scene);
  ExpectNear(b.reflectance[0], Spectrum(0.98f));
  EXPECT_EQ(scene.report.materialsClamped, 1);
  for (const char* wrong : {"c:reflectance=1", "b:reflectance=1,2", "b:reflectance=-1",
                            "b:reflectance=x", "b:colour=1", "b:emission=nan", "two-sided", ""}) {
    EXPECT_THROW(ApplyMaterialSetting(wrong, &scene), Error) << wrong;
  }
}

}  // namespace
}  // namespace lambert
