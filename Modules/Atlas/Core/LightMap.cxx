#include "Atlas/Core/LightMap.h"

#include <algorithm>

#include "Atlas/Core/LightMapSeams.h"
#include "Atlas/Core/ShownSides.h"
#include "Atlas/Core/TexelRaster.h"
#include "Common/Core/Error.h"

namespace lambert {

namespace {

/// Of a texel, what a triangle covers that has it alone: all but what rounding leaves.
constexpr double kWhole = 1 - 1e-6;
/// Light in the middle of a texel that differs from the mean of what covers it by more than this
/// factor does not stand for it: smooth light changes less, and is best known by its middle.
constexpr float kMostFactor = 1.5f;

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

/// A triangle of the solution on the page of its face.
struct DrawnTriangle {
  std::array<Vec2d, 3> corners;  ///< in texels
  std::array<Spectrum, 3> light;

  Spectrum At(const std::array<double, 3>& w) const {
    return light[0] * float(w[0]) + light[1] * float(w[1]) + light[2] * float(w[2]);
  }
  /// Beside the triangle, of a place on its border.
  Spectrum At(const Vec2d& place) const {
    std::array<double, 3> w = Barycentric(corners, place);
    for (double& part : w) part = std::max(0., part);
    const double sum = w[0] + w[1] + w[2];
    for (double& part : w) part /= sum;
    return this->At(w);
  }
};

DrawnTriangle Draw(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                   const RadiositySolution& solution, size_t triangle) {
  const PlaceInFace placeOf(mesh, atlas, solution.inputFaceId[triangle]);
  DrawnTriangle drawn;
  for (size_t c = 0; c < 3; ++c) {
    const size_t point = size_t(solution.mesh.triangles[triangle][c]);
    drawn.corners[c] = placeOf(solution.mesh.positions[point]);
    drawn.light[c] = solution.irradiance[point];
  }
  return drawn;
}

/// Whether light in the middle of a texel stands for what covers it, of that mean.
bool Stands(const Spectrum& middle, const Spectrum& mean) {
  return middle.Mean() <= kMostFactor * mean.Mean() && mean.Mean() <= kMostFactor * middle.Mean();
}

/// Texels of which several triangles, or the edge of a chart, leave parts alone. They get the light
/// of the triangle that holds the middle, where it stands for the others, or else the mean by area:
/// each part is looked up as far from where it lies as the middle of the texel is from that of all
/// its parts.
class TexelsInParts {
 public:
  TexelsInParts(size_t pages, size_t size)
      : size_(size), numbers_(pages, std::vector<int32_t>(size * size, -1)) {}

  void Add(size_t triangle, size_t page, size_t texel, const TexelCover& cover, bool holdsMiddle) {
    int32_t& number = numbers_[page][texel];
    if (number < 0) {
      number = int32_t(texels_.size());
      texels_.emplace_back();
      texels_.back().page = page;
      texels_.back().texel = texel;
    }
    const Vec2f place(cover.middle - this->MiddleOf(texel));
    parts_.push_back({triangle, number, float(cover.area), place, holdsMiddle});
    texels_[size_t(number)].area += float(cover.area);
    texels_[size_t(number)].moment = texels_[size_t(number)].moment + place * float(cover.area);
  }

  /// Into those that have no light yet; rounding leaves a part of some that a triangle has alone.
  /// Then there are none.
  void DrawInto(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                const RadiositySolution& solution, std::vector<Canvas>* canvases) {
    DrawnTriangle drawn;
    for (size_t i = 0; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      if (i == 0 || part.triangle != parts_[i - 1].triangle) {
        drawn = Draw(mesh, atlas, solution, part.triangle);
      }
      Texel& texel = texels_[size_t(part.texel)];
      const Vec2d middle = this->MiddleOf(texel.texel);
      const Vec2f offset = part.place - texel.moment * (1 / texel.area);
      texel.mean += drawn.At(middle + Vec2d(offset)) * (part.area / texel.area);
      if (!part.holdsMiddle) continue;
      texel.middle = drawn.At(middle);
      texel.hasMiddle = true;
    }
    for (const Texel& texel : texels_) {
      Canvas& canvas = (*canvases)[texel.page];
      if (canvas.isFilled[texel.texel]) continue;
      const bool stands = texel.hasMiddle && Stands(texel.middle, texel.mean);
      canvas.texels[texel.texel] = stands ? texel.middle : texel.mean;
      canvas.isFilled[texel.texel] = 1;
    }
    for (const Texel& texel : texels_) numbers_[texel.page][texel.texel] = -1;
    texels_.clear();
    parts_.clear();
  }

 private:
  struct Texel {
    size_t page = 0, texel = 0;
    float area = 0;         ///< texels, that is covered
    Vec2f moment;           ///< texels, from the middle
    Spectrum mean, middle;  ///< light of what covers it, and light there
    bool hasMiddle = false;
  };
  struct Part {
    size_t triangle;
    int32_t texel;  ///< of `texels_`
    float area;     ///< texels
    Vec2f place;    ///< its middle, texels from that of the texel
    bool holdsMiddle;
  };

  Vec2d MiddleOf(size_t texel) const {
    return {double(texel % size_) + 0.5, double(texel / size_) + 0.5};
  }

  size_t size_;
  std::vector<std::vector<int32_t>> numbers_;  ///< by page and texel: in `texels_`, or -1
  std::vector<Texel> texels_;
  std::vector<Part> parts_;
};

/// Light of the triangles in the texels that they cover; then in those that hold a corner or the
/// middle of a triangle and have none.
void Rasterize(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
               const std::vector<int32_t>& chartOfFace, const RadiositySolution& solution,
               std::vector<Canvas>* canvases) {
  const std::vector<uint8_t> sides = BrighterSidesOfSurfaces(mesh, solution);
  const int size = atlas.pageSize;
  struct Splat {
    size_t page, texel;
    Spectrum light;
  };
  std::vector<Splat> splats;
  TexelsInParts parts(canvases->size(), size_t(size));
  const auto chartOf = [&](size_t t) { return chartOfFace[size_t(solution.inputFaceId[t])]; };
  std::vector<size_t> order;
  for (size_t t = 0; t < solution.mesh.triangles.size(); ++t) {
    const int32_t surface = mesh.surfaceId[size_t(solution.inputFaceId[t])];
    if (solution.side[t] == sides[size_t(surface)]) order.push_back(t);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return chartOf(a) < chartOf(b); });
  for (size_t i = 0; i < order.size(); ++i) {
    // No two charts have parts of one texel.
    const size_t t = order[i];
    if (i > 0 && chartOf(t) != chartOf(order[i - 1])) {
      parts.DrawInto(mesh, atlas, solution, canvases);
    }
    const size_t page = size_t(atlas.pageOfChart[size_t(chartOf(t))]);
    const DrawnTriangle drawn = Draw(mesh, atlas, solution, t);
    Canvas& canvas = (*canvases)[page];
    ForEachTexelCovered(drawn.corners, size, [&](int x, int y, const TexelCover& cover) {
      const size_t texel = size_t(y) * size_t(size) + size_t(x);
      if (cover.area < kWhole) {
        const std::array<double, 3> w = Barycentric(drawn.corners, {x + 0.5, y + 0.5});
        parts.Add(t, page, texel, cover, std::min({w[0], w[1], w[2]}) >= 0);
        return;
      }
      canvas.texels[texel] = drawn.At(cover.middle);
      canvas.isFilled[texel] = 1;
    });
    constexpr double kThird = 1. / 3;
    const std::array<std::array<double, 3>, 4> places = {
        {{kThird, kThird, kThird}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (const std::array<double, 3>& w : places) {
      const Vec2d p = drawn.corners[0] * w[0] + drawn.corners[1] * w[1] + drawn.corners[2] * w[2];
      const int x = std::min(size - 1, std::max(0, int(p.x)));
      const int y = std::min(size - 1, std::max(0, int(p.y)));
      splats.push_back({page, size_t(y) * size_t(size) + size_t(x), drawn.At(w)});
    }
  }
  parts.DrawInto(mesh, atlas, solution, canvases);
  for (const Splat& splat : splats) {
    Canvas& canvas = (*canvases)[splat.page];
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
  std::vector<std::vector<uint8_t>> isDrawn;
  for (size_t page = 0; page < canvases.size(); ++page) {
    Canvas& canvas = canvases[page];
    for (size_t i = 0; i < texels; ++i) {
      if (!canvas.isFilled[i]) continue;
      ++map.coveredTexels;
      mean += double(canvas.texels[i].Mean());
    }
    isDrawn.push_back(canvas.isFilled);
    Extend(atlas.pageSize, atlas.padding, std::move(touched[page]), &canvas);
    map.pages.push_back(std::move(canvas.texels));
  }
  mean /= double(std::max<int64_t>(1, map.coveredTexels));

  // Cuts, and all that lies between the charts.
  if (!Report(progress, 0.5, "closing seams")) throw Cancelled();
  const std::vector<SeamPoint> seams = FindSeams(mesh, atlas, chartOfFace, borders);
  map.seamPoints = int64_t(seams.size());
  map.before = MeasureSeams(seams, map, mean);
  CloseSeams(seams, mean, isDrawn, &map);
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
