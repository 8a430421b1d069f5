#include "Atlas/Core/LightMap.h"

#include <gtest/gtest.h>

#include "Clustering/Testing/Unit/ClusteringMeshes.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// The next level of a mip map: pages of half the size, rounded down, each texel the mean of what
/// it covers.
LightMap NextMipLevel(const LightMap& map) {
  LightMap level;
  level.pageSize = std::max(1, map.pageSize / 2);
  const size_t size = size_t(map.pageSize), half = size_t(level.pageSize);
  for (const std::vector<Spectrum>& page : map.pages) {
    std::vector<Spectrum> texels(half * half);
    for (size_t y = 0; y < half; ++y) {
      for (size_t x = 0; x < half; ++x) {
        const size_t right = std::min(size - 1, 2 * x + 1), above = std::min(size - 1, 2 * y + 1);
        texels[y * half + x] = (page[2 * y * size + 2 * x] + page[2 * y * size + right] +
                                page[above * size + 2 * x] + page[above * size + right]) *
                               0.25f;
      }
    }
    level.pages.push_back(std::move(texels));
  }
  return level;
}

struct Lit {
  TriangleMesh mesh;
  ClusterTree tree;
  RadiosityAtlas atlas;
  RadiositySolution solution;

  /// Every face is a triangle of the solution, with light(position) on its front.
  template <class Light>
  Lit(TriangleMesh mesh_, const AtlasOptions& options, const Light& light)
      : mesh(std::move(mesh_)) {
    tree = ClusterFaces(&mesh, {});
    atlas = MakeRadiosityAtlas(mesh, tree, options);
    solution.mesh = mesh;
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
      solution.inputFaceId.push_back(face);
      solution.side.push_back(kFront);
    }
    for (const Vec3f& p : mesh.positions) solution.irradiance.push_back(light(p));
  }
  LightMap Map() const { return MakeLightMap(mesh, atlas, solution); }

  /// A lookup at a place of a face.
  Spectrum At(const LightMap& map, int64_t face, float u, float v) const {
    const auto& t = atlas.textureCoords[size_t(face)];
    const int page = atlas.pageOfChart[size_t(ChartOfFace(atlas.set)[size_t(face)])];
    return Lookup(map, page, t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v);
  }
};

AtlasOptions Pages(int size) {
  AtlasOptions options;
  options.pageSize = size;
  return options;
}

Spectrum Slope(const Vec3f& p) { return {5 + p.x, 5 + p.y, 5 + p.z}; }

TEST(LightMap, AnEvenLightIsEvenEverywhere) {
  const Lit sphere(Sphere(12), Pages(128), [](const Vec3f&) { return Spectrum(3.f); });
  const LightMap map = sphere.Map();
  ASSERT_EQ(map.pages.size(), 1u);
  for (const Spectrum& texel : map.pages[0]) {
    EXPECT_NEAR(texel.r, 3, 1e-4);
    EXPECT_NEAR(texel.b, 3, 1e-4);
  }
  EXPECT_GT(map.seamPoints, 100);
  EXPECT_LT(map.before.largest, 1e-5);
}

// Light that is linear in space comes out as it is within a plane, but for the half texel at the
// border that takes in what was extended.
TEST(LightMap, ASlopeIsKept) {
  const Lit plane(FlatGrid(10), Pages(256), Slope);
  const LightMap map = plane.Map();
  const float texel = float(plane.atlas.texelSize);
  for (int64_t face = 0; face < plane.mesh.FaceCount(); face += 7) {
    const Vec3f &a = plane.mesh.Corner(face, 0), &b = plane.mesh.Corner(face, 1),
                &c = plane.mesh.Corner(face, 2);
    const Vec3f p = a + (b - a) * 0.3f + (c - a) * 0.3f;
    const Spectrum found = plane.At(map, face, 0.3f, 0.3f);
    EXPECT_NEAR(found.r, 5 + p.x, 1e-3);
    EXPECT_NEAR(found.g, 5 + p.y, 1e-3);
    const Spectrum corner = plane.At(map, face, 0, 0);
    EXPECT_NEAR(corner.r, 5 + a.x, texel);
    EXPECT_NEAR(corner.g, 5 + a.y, texel);
  }
}

// Slivers of a fifth of a texel at most, one in five of them dark.
TEST(LightMap, NoDarkSliverStandsForATexelOfBrightOnes) {
  Lit plane(FlatGrid(1), Pages(64), [](const Vec3f&) { return Spectrum(1.f); });
  plane.solution = {};
  constexpr int kSlivers = 5 * 64;
  for (int64_t face = 0; face < plane.mesh.FaceCount(); ++face) {
    const Vec3f &a = plane.mesh.Corner(face, 0), &b = plane.mesh.Corner(face, 1),
                &c = plane.mesh.Corner(face, 2);
    for (int i = 0; i < kSlivers; ++i) {
      const int32_t first = int32_t(plane.solution.mesh.positions.size());
      for (const Vec3f& p :
           {a, b + (c - b) * (float(i) / kSlivers), b + (c - b) * (float(i + 1) / kSlivers)}) {
        plane.solution.mesh.positions.push_back(p);
        plane.solution.irradiance.push_back(Spectrum(i % 5 == 2 ? 0.f : 10.f));
      }
      plane.solution.mesh.triangles.push_back({first, first + 1, first + 2});
      plane.solution.inputFaceId.push_back(face);
      plane.solution.side.push_back(kFront);
    }
  }
  const LightMap map = plane.Map();
  int texels = 0;
  float darkest = 10;
  const std::vector<int32_t> faces = FacesOfTexels(plane.atlas, 0);
  for (size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] < 0) continue;
    ++texels;
    // Bright slivers stand for themselves and the dark ones among them, no dark one does. A texel
    // at the border holds few.
    darkest = std::min(darkest, map.pages[0][i].g);
  }
  EXPECT_GT(darkest, 5);
  EXPECT_GT(texels, 2000);
}

TEST(LightMap, SeamsAreClosed) {
  const Lit torus(Torus(60, 30), Pages(256), Slope);
  const LightMap map = torus.Map();
  EXPECT_GT(map.seamPoints, 500);
  EXPECT_GT(map.before.rms, 0);
  EXPECT_LT(map.after.rms, 0.2 * map.before.rms);
  EXPECT_LT(map.after.largest, 0.5 * map.before.largest);
  // What it took: no place has moved by more than light changes over two texels.
  const float most = 2 * float(torus.atlas.texelSize);
  for (int64_t face = 0; face < torus.mesh.FaceCount(); ++face) {
    const Vec3f p =
        (torus.mesh.Corner(face, 0) + torus.mesh.Corner(face, 1) + torus.mesh.Corner(face, 2)) /
        3.f;
    EXPECT_NEAR(torus.At(map, face, 1.f / 3, 1.f / 3).r, 5 + p.x, most);
  }
}

// Where faces do not share their points light may jump, and stays as it is.
TEST(LightMap, CreasesAreNoSeams) {
  TriangleMesh tent;
  tent.positions = {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 0, 1}, {2, 0, 0}, {1, 1, 1}};
  tent.triangles = {{0, 1, 2}, {3, 4, 5}};
  tent.materialId = {0, 0};
  tent.Complete();
  const Lit lit(tent, Pages(64), [](const Vec3f& p) { return Spectrum(p.x < 0.5f ? 1.f : 2.f); });
  EXPECT_EQ(lit.Map().seamPoints, 0);
}

TEST(LightMap, TheBrighterSideIsKept) {
  Lit plane(FlatGrid(4), Pages(64), [](const Vec3f&) { return Spectrum(1.f); });
  RadiositySolution& solution = plane.solution;
  const int32_t points = int32_t(solution.mesh.positions.size());
  for (int32_t p = 0; p < points; ++p) {
    solution.mesh.positions.push_back(solution.mesh.positions[size_t(p)]);
    solution.irradiance.push_back(Spectrum(5.f));
  }
  const int64_t faces = plane.mesh.FaceCount();
  for (int64_t face = 0; face < faces; ++face) {
    const auto t = plane.mesh.triangles[size_t(face)];
    solution.mesh.triangles.push_back({t[0] + points, t[2] + points, t[1] + points});
    solution.inputFaceId.push_back(face);
    solution.side.push_back(kBack);
  }
  EXPECT_NEAR(plane.At(plane.Map(), 0, 0.3f, 0.3f).r, 5, 1e-4);
}

TEST(LightMap, NeedlesAndHeapsHaveLightInEveryTexel) {
  for (const TriangleMesh& mesh : {SliverGrid(12), Soup(3, 40, 120)}) {
    const Lit lit(mesh, Pages(256), [](const Vec3f& p) { return Spectrum(1 + p.x * p.x); });
    const LightMap map = lit.Map();
    for (const Spectrum& texel : map.pages[0]) {
      ASSERT_TRUE(texel.r >= 0.9f && texel.r < 2.2f) << texel.r;
    }
  }
}

TEST(LightMap, NothingAndWhatDoesNotBelongTogether) {
  Lit plane(FlatGrid(2), Pages(64), Slope);
  plane.solution.inputFaceId[0] = 99;
  EXPECT_THROW(plane.Map(), Error);
  Lit other(FlatGrid(3), Pages(64), Slope);
  EXPECT_THROW(MakeLightMap(plane.mesh, other.atlas, other.solution), Error);
  Lit dark(FlatGrid(2), Pages(64), Slope);
  dark.solution = {};
  const LightMap map = dark.Map();
  for (const Spectrum& texel : map.pages[0]) EXPECT_EQ(texel.r, 0);
  const auto cancel = [](double, const char*) { return false; };
  EXPECT_THROW(MakeLightMap(other.mesh, other.atlas, other.solution, cancel), Cancelled);
}

/// Squares of many sizes, no two in one plane, every second one ten times as bright.
struct BrightAndDim : Lit {
  explicit BrightAndDim(const AtlasOptions& options) : Lit(Squares(), options, LightOfSquare) {}

  static TriangleMesh Squares() {
    TriangleMesh mesh;
    for (int i = 0; i < 60; ++i) {
      const int32_t first = int32_t(mesh.positions.size());
      const float size = 1 + float(i % 7);
      for (const Vec3f& p : {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(1, 1, 0), Vec3f(0, 1, 0)}) {
        mesh.positions.push_back(p * size + Vec3f(0, 0, float(i)));
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
    mesh.Complete();
    return mesh;
  }
  static Spectrum LightOfSquare(const Vec3f& p) { return Spectrum(int(p.z) % 2 ? 10.f : 1.f); }

  /// The largest part of the light of its square by which a lookup inside one is off.
  double LargestDeviation(const LightMap& level) const {
    double largest = 0;
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
      const float own = LightOfSquare(mesh.Corner(face, 0)).r;
      for (int i = 0; i <= 8; ++i) {
        for (int j = 0; i + j <= 8; ++j) {
          const float found = At(level, face, float(i) / 8, float(j) / 8).r;
          largest = std::max(largest, double(std::abs(found - own) / own));
        }
      }
    }
    return largest;
  }
};

TEST(LightMap, MipMapsTakeInNothingOfOtherCharts) {
  for (const int levels : {0, 1, 2, 3}) {
    AtlasOptions options = Pages(512);
    options.mipLevels = levels;
    const BrightAndDim squares(options);
    ASSERT_EQ(squares.atlas.set.charts.size(), 60u);
    LightMap map = squares.Map();
    for (int level = 0; level <= levels; ++level) {
      EXPECT_LT(squares.LargestDeviation(map), 1e-5) << level;
      map = NextMipLevel(map);
    }
    // One level more takes in a neighbour; two texels are enough for the first level.
    if (levels == 0) {
      EXPECT_LT(squares.LargestDeviation(map), 1e-5);
    } else {
      EXPECT_GT(squares.LargestDeviation(map), 0.05);
    }
  }
}

TEST(LightMap, PaddingHasTheLightOfItsOwnChart) {
  for (const int padding : {1, 2, 5}) {
    AtlasOptions options = Pages(512);
    options.padding = padding;
    const BrightAndDim squares(options);
    const LightMap map = squares.Map();
    for (int64_t face = 0; face < squares.mesh.FaceCount(); ++face) {
      const float own = BrightAndDim::LightOfSquare(squares.mesh.Corner(face, 0)).r;
      for (const Vec2f& corner : squares.atlas.textureCoords[size_t(face)]) {
        const int x = int(corner.x * 512), y = int(corner.y * 512);
        for (int row = y - padding; row <= y + padding; ++row) {
          for (int column = x - padding; column <= x + padding; ++column) {
            EXPECT_FLOAT_EQ(map.pages[0][size_t(row) * 512 + size_t(column)].r, own);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace lambert
