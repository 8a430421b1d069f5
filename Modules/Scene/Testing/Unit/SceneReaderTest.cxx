#include "Scene/Core/SceneReader.h"

#include "Scene/Core/SceneCleaning.h"
#include "SceneReaderFixture.h"

namespace lambert {
namespace {

using namespace testing;

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

TEST_F(SceneReaderTest, ObjLinesThatAreChangedAmongThoseThatAreNot) {
  const std::string file = Write("s.obj",
                                 "v 0 0 0\nv 1 0 0\n  v 0 1 .5\nv 0 0 .25\n# .5\nv 2 0 0\n"
                                 "f 1 2 3\n\tf 1 2 4\nf 1 5 3");
  const SceneAssembly scene = ReadScene({file});
  ASSERT_EQ(scene.meshes.size(), 1u);
  const TriangleMesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.FaceCount(), 3);
  EXPECT_EQ(mesh.Corner(0, 2), Vec3f(0, 1, 0.5f));
  EXPECT_EQ(mesh.Corner(1, 2), Vec3f(0, 0, 0.25f));
  EXPECT_EQ(mesh.Corner(2, 1), Vec3f(2, 0, 0));
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
