#include "Classical/Core/ElementCells.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>

#include "Common/Core/DisjointSets.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

constexpr int64_t kMostFragments = 50'000'000;
/// Fragments under this part of a square element are small enough to share a cell.
constexpr double kSmallPart = 0.25;
/// Normals whose components times this round alike face alike: bins of some 25 degrees.
constexpr float kNormalBins = 2.4f;
/// Keeps the borders of the cubes off the round coordinates where planes lie.
constexpr double kCubeShift = 0.3819660113;

int Bin(double x) { return int(std::floor(x)); }

/// Fragments with one key lie in one cube of the element size, on one part, and face alike.
uint64_t GroupKey(int32_t part, const Vec3f& center, const Vec3f& normal, double elementSize) {
  uint64_t key = HashBits(uint64_t(uint32_t(part)));
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t place = uint32_t(Bin(double(center[axis]) / elementSize + kCubeShift));
    const uint32_t facing = uint32_t(Bin(double(normal[axis] * kNormalBins) + 0.5));
    key = HashBits(key, (uint64_t(place) << 32) | facing);
  }
  return key;
}

}  // namespace

ElementCells::ElementCells(const TriangleMesh& mesh, double elementSize) : mesh_(mesh) {
  // Grids.
  const int64_t faces = mesh.FaceCount();
  grids_.resize(size_t(faces));
  int64_t count = 0;
  for (int64_t face = 0; face < faces; ++face) {
    Grid& grid = grids_[size_t(face)];
    grid = MakeGrid(face, elementSize);
    grid.first = int32_t(count);
    count += int64_t(grid.columns) * grid.rows;
    if (count > kMostFragments) {
      throw Error("Elements of " + std::to_string(elementSize) +
                  " m are too small for this scene: they would be over " +
                  std::to_string(kMostFragments / 1'000'000) + " million.");
    }
  }

  // Fragments, and their areas.
  fragments_.resize(size_t(count));
  std::vector<float> areas(size_t(count), -1);
  ParallelForEach(faces, 1024, [&](int64_t face) {
    const Grid& grid = grids_[size_t(face)];
    const double area = double(mesh_.Area(face));
    for (int32_t column = 0; column < grid.columns; ++column) {
      for (int32_t row = 0; row < grid.rows; ++row) {
        const size_t index = size_t(grid.first + column * grid.rows + row);
        fragments_[index] = {int32_t(face), column, row};
        const bool exists = int64_t(column) * grid.rows + int64_t(row) * grid.columns <
                            int64_t(grid.columns) * grid.rows;
        if (exists) areas[index] = float(ShareOfFace(grid, column, row) * area);
      }
    }
  });
  GroupFragments(elementSize, areas);
  ListFragments(areas);
}

ElementCells::Grid ElementCells::MakeGrid(int64_t face, double elementSize) const {
  // The shortest edge joins the origin and its second neighbour.
  std::array<double, 3> length;  // of the edge from corner c to c + 1
  for (int c = 0; c < 3; ++c) {
    length[size_t(c)] = double(Length(mesh_.Corner(face, (c + 1) % 3) - mesh_.Corner(face, c)));
  }
  const int shortest = int(std::min_element(length.begin(), length.end()) - length.begin());
  const int origin = (shortest + 1) % 3;
  Grid grid;
  grid.origin = uint8_t(origin);
  const auto pieces = [elementSize](double edge) {
    return int32_t(std::min(1e6, std::max(1.0, std::ceil(edge / elementSize - 1e-4))));
  };
  grid.columns = pieces(length[size_t(origin)]);
  grid.rows = pieces(length[size_t(shortest)]);
  return grid;
}

int32_t ElementCells::FragmentAt(const Grid& grid, const Vec2f& barycentric) {
  const float weights[3] = {1 - barycentric.x - barycentric.y, barycentric.x, barycentric.y};
  const float a = weights[(grid.origin + 1) % 3], b = weights[(grid.origin + 2) % 3];
  int32_t column = std::min(grid.columns - 1, std::max(0, int32_t(a * float(grid.columns))));
  int32_t row = std::min(grid.rows - 1, std::max(0, int32_t(b * float(grid.rows))));
  // Rounding may lead to just beyond the third edge.
  while (int64_t(column) * grid.rows + int64_t(row) * grid.columns >=
         int64_t(grid.columns) * grid.rows) {
    (column > 0 ? column : row) -= 1;
  }
  return grid.first + column * grid.rows + row;
}

/// The part of the face's area that lies in a fragment: what is beyond its lower corner, less what
/// is beyond its neighbours', all of them triangles similar to the face.
double ElementCells::ShareOfFace(const Grid& grid, int32_t column, int32_t row) {
  const auto beyond = [&grid](int32_t i, int32_t j) {
    const double rest = std::max(0.0, 1 - double(i) / grid.columns - double(j) / grid.rows);
    return rest * rest;
  };
  return std::max(0.0, beyond(column, row) - beyond(column + 1, row) - beyond(column, row + 1) +
                           beyond(column + 1, row + 1));
}

Vec3f ElementCells::PointAt(int64_t face, double a, double b) const {
  const int origin = grids_[size_t(face)].origin;
  const Vec3f& p = mesh_.Corner(face, origin);
  return p + (mesh_.Corner(face, (origin + 1) % 3) - p) * float(a) +
         (mesh_.Corner(face, (origin + 2) % 3) - p) * float(b);
}

/// Middle of the fragment, or of its lower half where the third edge cuts it.
Vec3f ElementCells::FragmentCenter(const Fragment& fragment) const {
  const Grid& grid = grids_[size_t(fragment.face)];
  double a = (fragment.column + 0.5) / grid.columns, b = (fragment.row + 0.5) / grid.rows;
  if (a + b > 1) {
    const double a0 = double(fragment.column) / grid.columns, b0 = double(fragment.row) / grid.rows;
    const double rest = (1 - a0 - b0) / 3;
    a = a0 + rest, b = b0 + rest;
  }
  return PointAt(fragment.face, a, b);
}

void ElementCells::GroupFragments(double elementSize, const std::vector<float>& areas) {
  // Keys of the small fragments.
  const int64_t count = int64_t(fragments_.size());
  std::vector<std::pair<uint64_t, int32_t>> keyed;
  std::vector<uint64_t> keys(fragments_.size());
  const double smallArea = kSmallPart * elementSize * elementSize;
  ParallelForEach(count, 4096, [&](int64_t i) {
    const int32_t face = fragments_[size_t(i)].face;
    keys[size_t(i)] =
        GroupKey(mesh_.partId.empty() ? 0 : mesh_.partId[size_t(face)],
                 FragmentCenter(fragments_[size_t(i)]), mesh_.FrontNormal(face), elementSize);
  });
  for (int64_t i = 0; i < count; ++i) {
    const float area = areas[size_t(i)];
    if (area >= 0 && double(area) < smallArea) keyed.emplace_back(keys[size_t(i)], int32_t(i));
  }
  std::sort(keyed.begin(), keyed.end());

  // Of one key, those whose faces hang together by their points stand for all under the first.
  std::vector<int32_t> first(fragments_.size());
  std::iota(first.begin(), first.end(), 0);
  std::vector<std::pair<int32_t, int32_t>> points;
  for (size_t begin = 0, end = 0; begin < keyed.size(); begin = end) {
    while (end < keyed.size() && keyed[end].first == keyed[begin].first) ++end;
    if (end - begin == 1) continue;
    points.clear();
    for (size_t i = begin; i < end; ++i) {
      const int32_t face = fragments_[size_t(keyed[i].second)].face;
      for (const int32_t point : mesh_.triangles[size_t(face)]) {
        points.emplace_back(point, int32_t(i - begin));
      }
    }
    std::sort(points.begin(), points.end());
    DisjointSets joined(end - begin);
    for (size_t i = 1; i < points.size(); ++i) {
      if (points[i].first == points[i - 1].first)
        joined.Join(points[i].second, points[i - 1].second);
    }
    for (size_t i = begin; i < end; ++i) {
      first[size_t(keyed[i].second)] =
          keyed[begin + size_t(joined.Find(int32_t(i - begin)))].second;
    }
  }

  // Number the cells in the order of their first fragments: a group's first is its lowest.
  cellOfFragment_.assign(fragments_.size(), -1);
  int32_t cells = 0;
  for (int64_t i = 0; i < count; ++i) {
    if (areas[size_t(i)] < 0) continue;
    cellOfFragment_[size_t(i)] =
        first[size_t(i)] == i ? cells++ : cellOfFragment_[size_t(first[size_t(i)])];
  }
  cellArea_.assign(size_t(cells), 0);
}

void ElementCells::ListFragments(const std::vector<float>& areas) {
  // Fragments by cell.
  firstOfCell_.assign(cellArea_.size() + 1, 0);
  for (const int32_t cell : cellOfFragment_) {
    if (cell >= 0) ++firstOfCell_[size_t(cell) + 1];
  }
  std::partial_sum(firstOfCell_.begin(), firstOfCell_.end(), firstOfCell_.begin());
  fragmentsOfCell_.resize(size_t(firstOfCell_.back()));
  std::vector<int32_t> next(firstOfCell_.begin(), firstOfCell_.end() - 1);
  for (size_t i = 0; i < cellOfFragment_.size(); ++i) {
    const int32_t cell = cellOfFragment_[i];
    if (cell >= 0) fragmentsOfCell_[size_t(next[size_t(cell)]++)] = int32_t(i);
  }

  // The largest first; areas summed up to choose places by; means.
  areaUpTo_.resize(fragmentsOfCell_.size());
  cellReflectance_.resize(cellArea_.size());
  cellEmittance_.resize(2 * cellArea_.size());
  ParallelForEach(Size(), 1024, [&](int64_t cell) {
    const auto begin = fragmentsOfCell_.begin() + firstOfCell_[size_t(cell)];
    const auto end = fragmentsOfCell_.begin() + firstOfCell_[size_t(cell) + 1];
    std::iter_swap(begin, std::max_element(begin, end, [&](int32_t a, int32_t b) {
                     return areas[size_t(a)] < areas[size_t(b)];
                   }));
    float sum = 0;
    Spectrum reflected, emitted[2];
    for (auto i = begin; i != end; ++i) {
      const int32_t face = fragments_[size_t(*i)].face;
      const float area = areas[size_t(*i)];
      sum += area;
      reflected += mesh_.reflectance[size_t(face)] * area;
      for (const Side side : {kFront, kBack}) {
        if (mesh_.Emits(face, side)) emitted[side] += mesh_.emittance[size_t(face)] * area;
      }
      areaUpTo_[size_t(i - fragmentsOfCell_.begin())] = sum;
    }
    cellArea_[size_t(cell)] = sum;
    if (!(sum > 0)) return;
    cellReflectance_[size_t(cell)] = reflected / sum;
    for (const Side side : {kFront, kBack}) {
      cellEmittance_[2 * size_t(cell) + size_t(side)] = emitted[side] / sum;
    }
  });
}

SurfacePlace ElementCells::Sample(int32_t cell, Side side, Random* random) const {
  // A fragment by area.
  const int32_t begin = firstOfCell_[size_t(cell)], end = firstOfCell_[size_t(cell) + 1];
  int32_t chosen = begin;
  if (end - begin > 1) {
    const float target = random->Uniform() * cellArea_[size_t(cell)];
    chosen = int32_t(std::upper_bound(areaUpTo_.begin() + begin, areaUpTo_.begin() + end, target) -
                     areaUpTo_.begin());
    chosen = std::min(chosen, end - 1);
  }
  const Fragment& fragment = fragments_[size_t(fragmentsOfCell_[size_t(chosen)])];

  // A place in it, before the third edge of the face; its lower corner always is.
  const Grid& grid = grids_[size_t(fragment.face)];
  constexpr int kTries = 16;
  double a = double(fragment.column) / grid.columns, b = double(fragment.row) / grid.rows;
  const double a0 = a, b0 = b;
  for (int i = 0; i < kTries; ++i) {
    const double u = a0 + random->UniformDouble() / grid.columns;
    const double v = b0 + random->UniformDouble() / grid.rows;
    if (u + v >= 1) continue;
    a = u, b = v;
    break;
  }
  SurfacePlace place;
  place.face = fragment.face;
  place.side = side;
  place.position = PointAt(fragment.face, a, b);
  place.normal = mesh_.FrontNormal(fragment.face) * (side == kFront ? 1.f : -1.f);
  return place;
}

Vec3f ElementCells::Center(int32_t cell) const {
  return FragmentCenter(fragments_[size_t(fragmentsOfCell_[size_t(firstOfCell_[size_t(cell)])])]);
}

Vec3f ElementCells::Normal(int32_t cell) const {
  return mesh_.FrontNormal(
      fragments_[size_t(fragmentsOfCell_[size_t(firstOfCell_[size_t(cell)])])].face);
}

}  // namespace lambert
