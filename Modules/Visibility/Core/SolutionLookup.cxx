#include "Visibility/Core/SolutionLookup.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "Common/Core/Error.h"

namespace lambert {

namespace {

constexpr int32_t kLeafSize = 8;

/// Barycentric weights of the point of triangle abc that is nearest to p (Ericson 2005,
/// section 5.1.5).
Vec3d NearestWeights(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = Dot(ab, ap), d2 = Dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = Dot(ab, bp), d4 = Dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = Dot(ab, cp), d6 = Dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

double SquaredDistance(const Box3f& box, const Vec3f& p) {
  const Vec3f outside = Max(Max(box.low - p, p - box.high), Vec3f());
  return double(outside.x) * outside.x + double(outside.y) * outside.y +
         double(outside.z) * outside.z;
}

void Check(const RadiositySolution& solution, int64_t faceCount) {
  const size_t faces = solution.mesh.triangles.size(), points = solution.mesh.positions.size();
  if (solution.inputFaceId.size() != faces || solution.side.size() != faces ||
      solution.irradiance.size() != points || solution.radiosity.size() != points) {
    throw Error("The solution's arrays do not fit its mesh.");
  }
  for (const int64_t face : solution.inputFaceId) {
    if (face < 0 || face >= faceCount) {
      throw Error("The solution names face " + std::to_string(face) + " where the scene has " +
                  std::to_string(faceCount) + "; it belongs to another scene.");
    }
  }
}

}  // namespace

SolutionLookup::SolutionLookup(const RadiositySolution& solution, int64_t faceCount)
    : solution_(solution), begin_(size_t(faceCount) * 2 + 1, 0) {
  // Triangles by face and side, counted.
  Check(solution, faceCount);
  const auto key = [&](size_t triangle) {
    return Key(solution.inputFaceId[triangle], solution.side[triangle] == kBack ? kBack : kFront);
  };
  const size_t count = solution.mesh.triangles.size();
  for (size_t triangle = 0; triangle < count; ++triangle) ++begin_[key(triangle)];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  order_.resize(count);
  for (size_t i = count; i > 0; --i) order_[size_t(--begin_[key(i - 1)])] = int32_t(i - 1);

  // A tree over those that are many.
  for (size_t group = 0; group + 1 < begin_.size(); ++group) {
    const int32_t begin = begin_[group], end = begin_[group + 1];
    if (end - begin > kLeafSize) roots_[group] = Build(begin, end);
  }
}

int32_t SolutionLookup::Build(int32_t begin, int32_t end) {
  const TriangleMesh& mesh = solution_.mesh;
  const int32_t index = int32_t(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.begin = begin, node.end = end;
  for (int32_t i = begin; i < end; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      node.bounds.Include(mesh.Corner(order_[size_t(i)], corner));
    }
  }
  if (end - begin > kLeafSize) {
    // Halves along the longest axis, by centre.
    const Vec3f extent = node.bounds.Extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const auto center = [&](int32_t t) {
      return mesh.Corner(t, 0)[axis] + mesh.Corner(t, 1)[axis] + mesh.Corner(t, 2)[axis];
    };
    const int32_t middle = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int32_t a, int32_t b) {
                       const float ca = center(a), cb = center(b);
                       return ca != cb ? ca < cb : a < b;
                     });
    Build(begin, middle);
    node.second = Build(middle, end);
  }
  nodes_[size_t(index)] = node;
  return index;
}

SolutionLookup::Place SolutionLookup::Find(int64_t face, Side side, const Vec3f& position) const {
  Nearest nearest{{}, std::numeric_limits<double>::infinity()};
  const size_t key = Key(face, side);
  const int32_t begin = begin_[key], end = begin_[key + 1];
  if (end - begin > kLeafSize) {
    Search(roots_.at(key), position, &nearest);
  } else {
    Compare(begin, end, position, &nearest);
  }
  return nearest.place;
}

void SolutionLookup::Search(int32_t root, const Vec3f& position, Nearest* nearest) const {
  std::array<int32_t, 64> stack;
  size_t height = 0;
  stack[height++] = root;
  while (height > 0) {
    const int32_t index = stack[--height];
    const Node& node = nodes_[size_t(index)];
    if (SquaredDistance(node.bounds, position) >= nearest->distance) continue;
    if (node.second < 0) {
      Compare(node.begin, node.end, position, nearest);
      continue;
    }
    const int32_t first = index + 1;
    const bool firstIsNearer = SquaredDistance(nodes_[size_t(first)].bounds, position) <=
                               SquaredDistance(nodes_[size_t(node.second)].bounds, position);
    stack[height++] = firstIsNearer ? node.second : first;
    stack[height++] = firstIsNearer ? first : node.second;
  }
}

void SolutionLookup::Compare(int32_t begin, int32_t end, const Vec3f& position,
                             Nearest* nearest) const {
  const TriangleMesh& mesh = solution_.mesh;
  const Vec3d p(position);
  for (int32_t i = begin; i < end; ++i) {
    const int32_t triangle = order_[size_t(i)];
    const Vec3d a(mesh.Corner(triangle, 0)), b(mesh.Corner(triangle, 1)),
        c(mesh.Corner(triangle, 2));
    const Vec3d weights = NearestWeights(p, a, b, c);
    const double distance = LengthSquared(a * weights.x + b * weights.y + c * weights.z - p);
    if (!(distance < nearest->distance)) continue;
    *nearest = {{triangle, Vec3f(weights)}, distance};
  }
}

Spectrum SolutionLookup::Interpolate(const Place& place,
                                     const std::vector<Spectrum>& values) const {
  if (place.triangle < 0) return {};
  const std::array<int32_t, 3>& corners = solution_.mesh.triangles[size_t(place.triangle)];
  return values[size_t(corners[0])] * place.weights.x +
         values[size_t(corners[1])] * place.weights.y +
         values[size_t(corners[2])] * place.weights.z;
}

}  // namespace lambert
