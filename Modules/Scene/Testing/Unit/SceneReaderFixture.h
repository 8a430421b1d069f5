// What the tests of the reader share: files of their own, and the sentences that bad ones end with.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "Common/Core/Error.h"
#include "Scene/Core/SceneReader.h"

namespace lambert::testing {

namespace fs = std::filesystem;

// Values go through single precision and one or two products.
constexpr float kRounding = 1e-5f;

inline void ExpectNear(const Spectrum& value, const Spectrum& expected,
                       float tolerance = kRounding) {
  for (int band = 0; band < 3; ++band) {
    EXPECT_NEAR(value[band], expected[band], tolerance * std::max(1.f, expected[band]))
        << "band " << band;
  }
}

/// A folder of its own for each test, gone afterwards.
class SceneReaderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
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

inline const Material& Named(const SceneAssembly& scene, const std::string& name) {
  for (const Material& material : scene.materials) {
    if (material.name == name) return material;
  }
  throw Error("no material " + name);
}

/// The mesh whose first face has the material.
inline const TriangleMesh& MeshOf(const SceneAssembly& scene, const std::string& material) {
  for (const TriangleMesh& mesh : scene.meshes) {
    if (scene.materials[size_t(mesh.materialId[0])].name == material) return mesh;
  }
  throw Error("no mesh of " + material);
}

}  // namespace lambert::testing
