#include "Atlas/Core/RadiosityAtlas.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "Atlas/Testing/Unit/AtlasMeshes.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {
namespace {

TriangleMesh Mixed() {
  TriangleMesh mesh;
  for (const TriangleMesh& other : {Sphere(16), Torus(30, 15), FlatGrid(5), SliverGrid(8)}) {
    Append(other, {float(mesh.positions.size()), 0, 0}, &mesh);
  }
  mesh.Complete();
  return mesh;
}

/// Every texel that a triangle touches, by page and place, with its chart.
void ForEachTexel(const RadiosityAtlas& atlas,
                  const std::function<void(std::array<int, 3>, int32_t)>& visit) {
  for (size_t i = 0; i < atlas.set.charts.size(); ++i) {
    const Chart& chart = atlas.set.charts[i];
    for (const int32_t f : atlas.set.FacesOf(chart)) {
      Vec2d p[3];
      for (size_t c = 0; c < 3; ++c) {
        p[c] = Vec2d(atlas.textureCoords[size_t(f)][c]) * double(atlas.pageSize);
      }
      // By a net over the triangle finer than a texel.
      const double size = std::max({std::hypot(p[1].x - p[0].x, p[1].y - p[0].y),
                                    std::hypot(p[2].x - p[0].x, p[2].y - p[0].y), 1.});
      const int steps = int(2 * size) + 1;
      for (int u = 0; u <= steps; ++u) {
        for (int v = 0; u + v <= steps; ++v) {
          const Vec2d q =
              p[0] + (p[1] - p[0]) * (double(u) / steps) + (p[2] - p[0]) * (double(v) / steps);
          visit({atlas.pageOfChart[i], int(q.x), int(q.y)}, int32_t(i));
        }
      }
    }
  }
}

TEST(RadiosityAtlas, ChartsKeepTheirDistance) {
  const Clustered mixed(Mixed());
  AtlasOptions options;
  options.pageSize = 256;
  options.padding = 2;
  const RadiosityAtlas atlas = MakeRadiosityAtlas(mixed.mesh, mixed.tree, options);
  EXPECT_EQ(atlas.pages, 1);
  EXPECT_GT(atlas.utilisation, 0.38);  // Half of so small a page is padding.
  std::map<std::array<int, 3>, int32_t> chartOfTexel;
  ForEachTexel(atlas, [&](std::array<int, 3> texel, int32_t chart) {
    ASSERT_TRUE(texel[1] >= 0 && texel[1] < 256 && texel[2] >= 0 && texel[2] < 256);
    EXPECT_EQ(chartOfTexel.try_emplace(texel, chart).first->second, chart);
  });
  // Between two charts lie the paddings of both.
  for (const auto& [texel, chart] : chartOfTexel) {
    for (int dx = -4; dx <= 4; ++dx) {
      for (int dy = -4; dy <= 4; ++dy) {
        const auto other = chartOfTexel.find({texel[0], texel[1] + dx, texel[2] + dy});
        if (other == chartOfTexel.end()) continue;
        EXPECT_EQ(other->second, chart);
      }
    }
  }
}

TEST(RadiosityAtlas, TexelsHaveTheSizeThatIsAskedFor) {
  const Clustered mixed(Mixed());
  AtlasOptions options;
  options.pageSize = 128;
  options.texelSize = 0.05;
  const RadiosityAtlas atlas = MakeRadiosityAtlas(mixed.mesh, mixed.tree, options);
  EXPECT_GT(atlas.pages, 1);
  EXPECT_DOUBLE_EQ(atlas.texelSize, 0.05);
  const double scale = 128 * 0.05;
  for (int64_t face = 0; face < mixed.mesh.FaceCount(); ++face) {
    for (int c = 0; c < 3; ++c) {
      const Vec2f d = atlas.textureCoords[size_t(face)][size_t((c + 1) % 3)] -
                      atlas.textureCoords[size_t(face)][size_t(c)];
      const double length =
          double(Length(mixed.mesh.Corner(face, (c + 1) % 3) - mixed.mesh.Corner(face, c)));
      EXPECT_LT(std::hypot(double(d.x), double(d.y)) * scale, 2.01 * length + 1e-5);
      EXPECT_GT(std::hypot(double(d.x), double(d.y)) * scale, length / 2.01 - 1e-5);
    }
  }
}

TEST(RadiosityAtlas, MorePagesGiveSmallerTexels) {
  const Clustered mixed(Mixed());
  AtlasOptions options;
  options.pageSize = 64;
  double before = 1e30;
  for (const int pages : {1, 2, 4}) {
    options.pages = pages;
    const RadiosityAtlas atlas = MakeRadiosityAtlas(mixed.mesh, mixed.tree, options);
    EXPECT_LE(atlas.pages, pages);
    EXPECT_LT(atlas.texelSize, before);
    before = atlas.texelSize;
  }
}

TEST(RadiosityAtlas, TwoThreadsPackAsOne) {
  const Clustered mixed(Mixed());
  SetThreadCount(1);
  const RadiosityAtlas one = MakeRadiosityAtlas(mixed.mesh, mixed.tree);
  SetThreadCount(2);
  const RadiosityAtlas two = MakeRadiosityAtlas(mixed.mesh, mixed.tree);
  SetThreadCount(0);
  EXPECT_EQ(one.textureCoords, two.textureCoords);
}

TEST(RadiosityAtlas, NoFacesAndNoArea) {
  TriangleMesh none;
  none.Complete();
  const Clustered empty(none);
  EXPECT_EQ(MakeRadiosityAtlas(empty.mesh, empty.tree).pages, 0);

  TriangleMesh point;
  point.positions = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  point.triangles = {{0, 1, 2}};
  point.Complete();
  const Clustered flat(point);
  const RadiosityAtlas atlas = MakeRadiosityAtlas(flat.mesh, flat.tree);
  EXPECT_EQ(atlas.pages, 1);
  for (const Vec2f& uv : atlas.textureCoords[0]) {
    EXPECT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1);
  }
}

TEST(RadiosityAtlas, OptionsOutOfRangeAndPagesTooFew) {
  const Clustered grid(FlatGrid(2));
  for (const auto& change : std::vector<std::function<void(AtlasOptions*)>>{
           [](AtlasOptions* o) { o->pageSize = 8; }, [](AtlasOptions* o) { o->pages = 0; },
           [](AtlasOptions* o) { o->texelSize = -1; }, [](AtlasOptions* o) { o->padding = 65; },
           [](AtlasOptions* o) { o->stretch = 0; }, [](AtlasOptions* o) { o->texelSize = 1e-4; }}) {
    AtlasOptions options;
    change(&options);
    EXPECT_THROW(MakeRadiosityAtlas(grid.mesh, grid.tree, options), Error);
  }
  const Clustered soup(Soup(1, 300, 2000));
  AtlasOptions options;
  options.pageSize = 16;
  EXPECT_THROW(MakeRadiosityAtlas(soup.mesh, soup.tree, options), Error);
}

}  // namespace
}  // namespace lambert
