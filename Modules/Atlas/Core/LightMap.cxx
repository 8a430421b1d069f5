#include "Atlas/Core/LightMap.h"

#include <algorithm>

#include "Atlas/Core/LightMapSeams.h"
#include "Atlas/Core/ShownSides.h"
#include "Atlas/Core/TexelRaster.h"
#include "Common/Core/Error.h"

namespace lambert {

namespace {

/// A page while it is filled.
struct Canvas {
  std::vector<Spectrum> texels;
  std::vector<uint8_t> isFilled;
};

/// Where points of the solution lie on the page of their face, by barycentrics (5.2.5).
class PlaceInFace {
 public:
  PlaceInFace(const TriangleMesh& mesh, const RadiosityAtlas& atlas, int64_t face) {
    const Vec3d a(mesh.Corner(face, 0));
    const Vec3d normal = Cross(Vec3d(mesh.Corner(face, 1)) - a, Vec3d(mesh.Corner(face, 2)) - a);
    axis_ = Normalize(normal);
    if (axis_ == Vec3d()) axis_ = {0, 0, 1};
    CoordinateSystem(axis_, &u_, &v_);
    for (size_t c = 0; c < 3; ++c) {
      world_[c] = this->Flat(Vec3d(mesh.Corner(face, int(c))));
      texels_[c] = Vec2d(atlas.textureCoords[size_t(face)][c]) * double(atlas.pageSize);
    }
  }
  /// In texels.
  Vec2d operator()(const Vec3f& position) const {
    const std::array<double, 3> w = Barycentric(world_, this->Flat(Vec3d(position)));
    return texels_[0] * w[0] + texels_[1] * w[1] + texels_[2] * w[2];
  }

 private:
  Vec2d Flat(const Vec3d& p) const { return {Dot(p, u_), Dot(p, v_)}; }

  Vec3d axis_, u_, v_;
  std::array<Vec2d, 3> world_, texels_;
};

/// Light of the triangles in the texels whose middles they hold; then in those that hold a corner
/// or the middle of a triangle and have none.
void Rasterize(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
               const std::vector<int32_t>& chartOfFace, const RadiositySolution& solution,
               std::vector<Canvas>* canvases) {
  const std::vector<uint8_t> sides = BrighterSidesOfSurfaces(mesh, solution);
  const int size = atlas.pageSize;
  struct Splat {
    int32_t page;
    size_t texel;
    Spectrum light;
  };
  std::vector<Splat> splats;
  for (size_t t = 0; t < solution.mesh.triangles.size(); ++t) {
    const int64_t face = solution.inputFaceId[t];
    if (solution.side[t] != sides[size_t(mesh.surfaceId[size_t(face)])]) continue;
    const int32_t page = atlas.pageOfChart[size_t(chartOfFace[size_t(face)])];
    const PlaceInFace placeOf(mesh, atlas, face);
    std::array<Vec2d, 3> corners;
    std::array<Spectrum, 3> light;
    for (size_t c = 0; c < 3; ++c) {
      const size_t point = size_t(solution.mesh.triangles[t][c]);
      corners[c] = placeOf(solution.mesh.positions[point]);
      light[c] = solution.irradiance[point];
    }
    const auto at = [&](const std::array<double, 3>& w) {
      return light[0] * float(w[0]) + light[1] * float(w[1]) + light[2] * float(w[2]);
    };
    Canvas& canvas = (*canvases)[size_t(page)];
    ForEachTexelOf(corners, size, [&](int x, int y) {
      std::array<double, 3> w = Barycentric(corners, {x + 0.5, y + 0.5});
      const double sum = std::max(0., w[0]) + std::max(0., w[1]) + std::max(0., w[2]);
      for (double& part : w) part = std::max(0., part) / sum;
      const size_t texel = size_t(y) * size_t(size) + size_t(x);
      canvas.texels[texel] = at(w);
      canvas.isFilled[texel] = 1;
    });
    constexpr double kThird = 1. / 3;
    const std::array<std::array<double, 3>, 4> places = {
        {{kThird, kThird, kThird}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (const std::array<double, 3>& w : places) {
      const Vec2d p = corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
      const int x = std::min(size - 1, std::max(0, int(p.x)));
      const int y = std::min(size - 1, std::max(0, int(p.y)));
      splats.push_back({page, size_t(y) * size_t(size) + size_t(x), at(w)});
    }
  }
  for (const Splat& splat : splats) {
    Canvas& canvas = (*canvases)[size_t(splat.page)];
    if (canvas.isFilled[splat.texel]) continue;
    canvas.texels[splat.texel] = splat.light;
    canvas.isFilled[splat.texel] = 1;
  }
}

/// The mean of the neighbours of a texel that have light; false where none has.
bool MeanAround(const Canvas& canvas, int size, size_t texel, Spectrum* mean) {
  const int x = int(texel % size_t(size)), y = int(texel / size_t(size));
  Spectrum sum;
  int count = 0;
  for (int row = std::max(0, y - 1); row <= std::min(size - 1, y + 1); ++row) {
    for (int column = std::max(0, x - 1); column <= std::min(size - 1, x + 1); ++column) {
      const size_t other = size_t(row) * size_t(size) + size_t(column);
      if (!canvas.isFilled[other]) continue;
      sum += canvas.texels[other];
      ++count;
    }
  }
  *mean = sum * (1.f / float(std::max(1, count)));
  return count > 0;
}

/// Those of `open` that lie beside texels with light get their mean; the others are left in it.
void ExtendInto(int size, std::vector<size_t>* open, Canvas* canvas) {
  std::vector<std::pair<size_t, Spectrum>> found;
  std::vector<size_t> left;
  for (const size_t texel : *open) {
    Spectrum mean;
    if (canvas->isFilled[texel]) continue;
    if (MeanAround(*canvas, size, texel, &mean)) {
      found.emplace_back(texel, mean);
    } else {
      left.push_back(texel);
    }
  }
  for (const auto& [texel, light] : found) {
    canvas->texels[texel] = light;
    canvas->isFilled[texel] = 1;
  }
  *open = std::move(left);
}

/// The texels that charts touch and that have no light, by page.
std::vector<std::vector<size_t>> TouchedInTheDark(const RadiosityAtlas& atlas,
                                                  const std::vector<int32_t>& chartOfFace,
                                                  const std::vector<Canvas>& canvases) {
  std::vector<std::vector<size_t>> texels(canvases.size());
  const int size = atlas.pageSize;
  for (size_t face = 0; face < atlas.textureCoords.size(); ++face) {
    const size_t page = size_t(atlas.pageOfChart[size_t(chartOfFace[face])]);
    std::array<Vec2d, 3> corners;
    for (size_t c = 0; c < 3; ++c) corners[c] = Vec2d(atlas.textureCoords[face][c]) * double(size);
    ForEachColumnNear(corners, 0, size, size, [&](int x, int low, int high) {
      for (int y = low; y < high; ++y) {
        const size_t texel = size_t(y) * size_t(size) + size_t(x);
        if (!canvases[page].isFilled[texel]) texels[page].push_back(texel);
      }
    });
  }
  for (std::vector<size_t>& list : texels) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return texels;
}

/// Light for all texels that charts touch, then for those around them, `rings` times: charts that
/// lie beside each other meet in the middle.
void Extend(int size, int rings, std::vector<size_t> touched, Canvas* canvas) {
  for (size_t before = touched.size() + 1; touched.size() < before;) {
    before = touched.size();
    ExtendInto(size, &touched, canvas);
  }
  std::vector<size_t> dark;
  for (size_t i = 0; i < canvas->texels.size(); ++i) {
    if (!canvas->isFilled[i]) dark.push_back(i);
  }
  for (int ring = 0; ring < rings; ++ring) ExtendInto(size, &dark, canvas);
}

/// Empty texels get the mean of what is filled in the smallest square of a pyramid that has some
/// (gortler1996).
void PullPush(int size, Canvas* canvas) {
  if (size == 1) return;
  // Pull: the mean of each two by two.
  const int half = (size + 1) / 2;
  Canvas coarse{std::vector<Spectrum>(size_t(half) * size_t(half)),
                std::vector<uint8_t>(size_t(half) * size_t(half), 0)};
  std::vector<int> count(coarse.texels.size(), 0);
  const auto parent = [&](int x, int y) { return size_t(y / 2) * size_t(half) + size_t(x / 2); };
  bool isFull = true;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const size_t texel = size_t(y) * size_t(size) + size_t(x);
      if (!canvas->isFilled[texel]) {
        isFull = false;
        continue;
      }
      coarse.texels[parent(x, y)] += canvas->texels[texel];
      ++count[parent(x, y)];
    }
  }
  if (isFull) return;
  for (size_t i = 0; i < count.size(); ++i) {
    if (count[i] == 0) continue;
    coarse.texels[i] = coarse.texels[i] * (1.f / float(count[i]));
    coarse.isFilled[i] = 1;
  }

  // Push.
  PullPush(half, &coarse);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const size_t texel = size_t(y) * size_t(size) + size_t(x);
      if (!canvas->isFilled[texel]) canvas->texels[texel] = coarse.texels[parent(x, y)];
    }
  }
}

}  // namespace

LightMap MakeLightMap(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                      const RadiositySolution& solution, const ProgressCallback& progress,
                      const std::vector<BorderPoint>& borders) {
  // The three belong together.
  if (atlas.textureCoords.size() != mesh.triangles.size()) {
    throw Error("The atlas holds " + std::to_string(atlas.textureCoords.size()) +
                " faces, the mesh " + std::to_string(mesh.triangles.size()) + ".");
  }
  RequireSameFaces(mesh, solution);
  const std::vector<int32_t> chartOfFace = ChartOfFace(atlas.set);

  // Light where triangles are, and around them.
  if (!Report(progress, 0, "drawing light")) throw Cancelled();
  const size_t texels = size_t(atlas.pageSize) * size_t(atlas.pageSize);
  std::vector<Canvas> canvases(size_t(atlas.pages),
                               {std::vector<Spectrum>(texels), std::vector<uint8_t>(texels, 0)});
  Rasterize(mesh, atlas, chartOfFace, solution, &canvases);
  std::vector<std::vector<size_t>> touched = TouchedInTheDark(atlas, chartOfFace, canvases);
  LightMap map;
  map.pageSize = atlas.pageSize;
  double mean = 0;
  for (size_t page = 0; page < canvases.size(); ++page) {
    Canvas& canvas = canvases[page];
    for (size_t i = 0; i < texels; ++i) {
      if (!canvas.isFilled[i]) continue;
      ++map.coveredTexels;
      mean += double(canvas.texels[i].Mean());
    }
    Extend(atlas.pageSize, atlas.padding, std::move(touched[page]), &canvas);
    map.pages.push_back(std::move(canvas.texels));
  }
  mean /= double(std::max<int64_t>(1, map.coveredTexels));

  // Cuts, and all that lies between the charts.
  if (!Report(progress, 0.5, "closing seams")) throw Cancelled();
  const std::vector<SeamPoint> seams = FindSeams(mesh, atlas, chartOfFace, borders);
  map.seamPoints = int64_t(seams.size());
  map.before = MeasureSeams(seams, map, mean);
  CloseSeams(seams, mean, &map);
  map.after = MeasureSeams(seams, map, mean);
  if (!Report(progress, 0.8, "filling between charts")) throw Cancelled();
  for (size_t page = 0; page < map.pages.size(); ++page) {
    Canvas canvas{std::move(map.pages[page]), std::move(canvases[page].isFilled)};
    PullPush(atlas.pageSize, &canvas);
    map.pages[page] = std::move(canvas.texels);
  }
  return map;
}

Spectrum Lookup(const LightMap& map, int page, const Vec2f& textureCoords) {
  return Footprint(map.pageSize, textureCoords).Lookup(map.pages[size_t(page)]);
}

}  // namespace lambert
