#include "Atlas/Core/LightMap.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "Atlas/Core/ChartMesh.h"
#include "Atlas/Core/ShownSides.h"
#include "Atlas/Core/TexelRaster.h"
#include "Common/Core/Error.h"

namespace lambert {

namespace {

/// What moving a texel costs beside a difference at a point of a seam.
constexpr double kStay = 0.1;
constexpr double kSolverTolerance = 1e-6;
constexpr int kMostSolverSteps = 1000;

/// The four texels around a place and their parts of a lookup there.
struct Footprint {
  std::array<size_t, 4> texels;
  std::array<double, 4> parts;

  Footprint(int size, const Vec2f& textureCoords) {
    const double x = double(textureCoords.x) * size - 0.5, y = double(textureCoords.y) * size - 0.5;
    const int left = int(std::floor(x)), low = int(std::floor(y));
    const double u = x - left, v = y - low;
    const auto texel = [&](int column, int row) {
      column = std::min(size - 1, std::max(0, column));
      row = std::min(size - 1, std::max(0, row));
      return size_t(row) * size_t(size) + size_t(column);
    };
    texels = {texel(left, low), texel(left + 1, low), texel(left, low + 1),
              texel(left + 1, low + 1)};
    parts = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
  }
};

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

/// A point on a cut edge, as it lies on both sides.
struct SeamPoint {
  std::array<int32_t, 2> pages;
  std::array<Footprint, 2> footprints;
};

/// About a point a texel along every cut edge whose faces share its points: what
/// they do not share is creased, and light may differ.
std::vector<SeamPoint> FindSeams(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                                 const std::vector<int32_t>& chartOfFace) {
  std::vector<SeamPoint> seams;
  const std::vector<int32_t> neighbours = FindNeighbours(mesh);
  for (size_t corner = 0; corner < neighbours.size(); ++corner) {
    if (neighbours[corner] <= int32_t(corner)) continue;
    const size_t other = size_t(neighbours[corner]);
    const std::array<size_t, 2> faces = {corner / 3, other / 3};
    const std::array<size_t, 2> charts = {size_t(chartOfFace[faces[0]]),
                                          size_t(chartOfFace[faces[1]])};
    const size_t c = corner % 3, next = (c + 1) % 3, d = other % 3, last = (d + 1) % 3;
    if (mesh.triangles[faces[0]][c] != mesh.triangles[faces[1]][last]) continue;
    if (mesh.triangles[faces[0]][next] != mesh.triangles[faces[1]][d]) continue;
    const std::array<Vec2f, 2> from = {atlas.textureCoords[faces[0]][c],
                                       atlas.textureCoords[faces[1]][last]};
    const std::array<Vec2f, 2> to = {atlas.textureCoords[faces[0]][next],
                                     atlas.textureCoords[faces[1]][d]};
    if (charts[0] == charts[1] && from[0] == from[1] && to[0] == to[1]) continue;
    float length = 0;
    for (size_t side = 0; side < 2; ++side) {
      length = std::max(length, std::hypot(to[side].x - from[side].x, to[side].y - from[side].y));
    }
    const int count = 1 + int(length * float(atlas.pageSize));
    for (int i = 0; i < count; ++i) {
      const float part = (float(i) + 0.5f) / float(count);
      const auto at = [&](size_t side) {
        return Footprint(atlas.pageSize, from[side] + (to[side] - from[side]) * part);
      };
      seams.push_back(
          {{atlas.pageOfChart[charts[0]], atlas.pageOfChart[charts[1]]}, {at(0), at(1)}});
    }
  }
  return seams;
}

Spectrum Sum(const std::vector<Spectrum>& texels, const Footprint& footprint) {
  Spectrum sum;
  for (size_t i = 0; i < 4; ++i) {
    sum += texels[footprint.texels[i]] * float(footprint.parts[i]);
  }
  return sum;
}

double Norm(const Spectrum& s) { return std::sqrt(SquaredNorm(s) / 3); }

SeamDifference MeasureSeams(const std::vector<SeamPoint>& seams, const LightMap& map, double mean) {
  SeamDifference difference;
  if (seams.empty() || !(mean > 0)) return difference;
  for (const SeamPoint& seam : seams) {
    const Spectrum a = Sum(map.pages[size_t(seam.pages[0])], seam.footprints[0]);
    const Spectrum b = Sum(map.pages[size_t(seam.pages[1])], seam.footprints[1]);
    const double part = Norm(a - b) / std::max(mean, Norm((a + b) * 0.5f));
    difference.rms += part * part / double(seams.size());
    difference.largest = std::max(difference.largest, part);
  }
  difference.rms = std::sqrt(difference.rms);
  return difference;
}

/// Moves the texels of seams by as little as may be until lookups on both sides agree; all in parts
/// of the light there or of `mean`, whichever is more, or lamps would have all the say.
void CloseSeams(const std::vector<SeamPoint>& seams, double mean, LightMap* map) {
  if (seams.empty() || !(mean > 0)) return;
  // The texels that are looked up, as unknowns.
  std::unordered_map<uint64_t, int> unknownOfTexel;
  std::vector<Spectrum*> texels;
  const size_t pageTexels = size_t(map->pageSize) * size_t(map->pageSize);
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t s = 0; s < seams.size(); ++s) {
    const Spectrum light = Sum(map->pages[size_t(seams[s].pages[0])], seams[s].footprints[0]) +
                           Sum(map->pages[size_t(seams[s].pages[1])], seams[s].footprints[1]);
    const double weight = 1 / std::max(mean, Norm(light * 0.5f));
    for (size_t side = 0; side < 2; ++side) {
      const Footprint& footprint = seams[s].footprints[side];
      for (size_t i = 0; i < 4; ++i) {
        const size_t page = size_t(seams[s].pages[side]);
        const auto [place, isNew] =
            unknownOfTexel.try_emplace(page * pageTexels + footprint.texels[i], int(texels.size()));
        if (isNew) texels.push_back(&map->pages[page][footprint.texels[i]]);
        entries.emplace_back(int(s), place->second,
                             weight * (side == 0 ? footprint.parts[i] : -footprint.parts[i]));
      }
    }
  }

  // Least squares: the differences, and how far texels move.
  const int count = int(texels.size());
  Eigen::SparseMatrix<double> difference(int(seams.size()), count), stay(count, count);
  difference.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd stays(count);
  entries.clear();
  for (int i = 0; i < count; ++i) {
    const double light = std::max(mean, Norm(*texels[size_t(i)]));
    stays[i] = kStay / (light * light);
    entries.emplace_back(i, i, stays[i]);
  }
  stay.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> matrix =
      Eigen::SparseMatrix<double>(difference.transpose()) * difference + stay;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(kSolverTolerance);
  solver.setMaxIterations(kMostSolverSteps);
  solver.compute(matrix);
  for (int band = 0; band < 3; ++band) {
    Eigen::VectorXd was(count);
    for (int i = 0; i < count; ++i) was[i] = double((*texels[size_t(i)])[band]);
    const Eigen::VectorXd is = solver.solveWithGuess(stays.cwiseProduct(was), was);
    if (!is.allFinite()) continue;
    for (int i = 0; i < count; ++i) (*texels[size_t(i)])[band] = float(std::max(0., is[i]));
  }
}

}  // namespace

LightMap MakeLightMap(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                      const RadiositySolution& solution, const ProgressCallback& progress) {
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
  const std::vector<SeamPoint> seams = FindSeams(mesh, atlas, chartOfFace);
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

Spectrum Lookup(const LightMap& map, int page, const Vec2f& textureCoords) {
  return Sum(map.pages[size_t(page)], Footprint(map.pageSize, textureCoords));
}

}  // namespace lambert
