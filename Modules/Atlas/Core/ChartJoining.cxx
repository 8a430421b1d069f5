#include "Atlas/Core/ChartJoining.h"

#include <algorithm>
#include <complex>
#include <map>
#include <tuple>
#include <unordered_map>

#include "Atlas/Core/ChartMesh.h"
#include "Common/Core/DisjointSets.h"

namespace lambert {

namespace {

/// Rounds after which borders are left as they are.
constexpr int kMostRounds = 64;

/// Several between the same charts become one.
void Merge(std::vector<ChartBorder>* borders) {
  std::sort(borders->begin(), borders->end(), [](const ChartBorder& p, const ChartBorder& q) {
    return std::tie(p.a, p.b, p.length) < std::tie(q.a, q.b, q.length);
  });
  std::vector<ChartBorder> merged;
  for (const ChartBorder& border : *borders) {
    if (merged.empty() || merged.back().a != border.a || merged.back().b != border.b) {
      merged.push_back(border);
    } else {
      merged.back().length += border.length;
    }
  }
  *borders = std::move(merged);
}

/// Borders that are the longest of both their charts.
std::vector<size_t> LongestOfBoth(const std::vector<ChartBorder>& borders) {
  std::unordered_map<int32_t, size_t> longest;
  for (size_t i = 0; i < borders.size(); ++i) {
    for (const int32_t chart : {borders[i].a, borders[i].b}) {
      const auto [place, isNew] = longest.try_emplace(chart, i);
      if (!isNew && borders[i].length > borders[place->second].length) place->second = i;
    }
  }
  std::vector<size_t> both;
  for (size_t i = 0; i < borders.size(); ++i) {
    if (longest[borders[i].a] == i && longest[borders[i].b] == i) both.push_back(i);
  }
  return both;
}

}  // namespace

std::vector<ChartBorder> SmoothBorders(const TriangleMesh& mesh,
                                       const std::vector<int32_t>& neighbours,
                                       const std::vector<int32_t>& chartOfFace) {
  std::vector<ChartBorder> borders;
  ForEachSharedEdge(mesh, neighbours, [&](const SharedEdge& edge) {
    const auto [a, b] = std::minmax(chartOfFace[edge.faces[0]], chartOfFace[edge.faces[1]]);
    if (a == b) return;
    const auto end = [&](size_t corner) {
      return Vec3d(mesh.Corner(int64_t(edge.faces[0]), int(corner)));
    };
    borders.push_back({a, b, Length(end(edge.to[0]) - end(edge.from[0]))});
  });
  Merge(&borders);
  return borders;
}

CommonLines LinesBetween(const TriangleMesh& mesh, const std::vector<int32_t>& neighbours,
                         const std::vector<int32_t>& faces, const std::vector<int32_t>& beyond) {
  // Edges with an end in common are one line.
  std::vector<int32_t> corners;
  std::map<std::array<float, 3>, int32_t> edgeAtEnd;
  for (const int32_t face : faces) {
    for (int32_t corner = 3 * face; corner < 3 * face + 3; ++corner) {
      const int32_t other = neighbours[size_t(corner)];
      if (other < 0 || !std::binary_search(beyond.begin(), beyond.end(), other / 3)) continue;
      corners.push_back(corner);
    }
  }
  DisjointSets lines{corners.size()};
  std::vector<double> length(corners.size(), 0);
  const auto end = [&](size_t i, int32_t side) {
    return mesh.Corner(corners[i] / 3, (corners[i] % 3 + side) % 3);
  };
  for (size_t i = 0; i < corners.size(); ++i) {
    for (const int32_t side : {0, 1}) {
      const Vec3f p = end(i, side);
      lines.Join(edgeAtEnd.try_emplace({p.x, p.y, p.z}, int32_t(i)).first->second, int32_t(i));
    }
  }
  for (size_t i = 0; i < corners.size(); ++i) {
    length[size_t(lines.Find(int32_t(i)))] += Length(Vec3d(end(i, 1)) - Vec3d(end(i, 0)));
  }
  const int32_t longest = int32_t(std::max_element(length.begin(), length.end()) - length.begin());
  CommonLines found;
  for (size_t i = 0; i < corners.size(); ++i) {
    (lines.Find(int32_t(i)) == longest ? found.longest : found.others).push_back(corners[i]);
  }
  return found;
}

SideBySide LaySideBySide(const std::array<const std::vector<int32_t>*, 2>& charts,
                         const std::vector<std::array<Vec2f, 3>>& places,
                         const std::vector<int32_t>& neighbours, const std::vector<int32_t>& line) {
  // The middles of the edges on both sides, and the turn between them, as complex numbers.
  using Complex = std::complex<double>;
  const auto placeOf = [&](int32_t face, int32_t corner) {
    const Vec2f& p = places[size_t(face)][size_t(corner % 3)];
    return Complex(double(p.x), double(p.y));
  };
  Complex here, there, turn;
  for (const int32_t corner : line) {
    const int32_t other = neighbours[size_t(corner)];
    here += (placeOf(corner / 3, corner) + placeOf(corner / 3, corner % 3 + 1)) /
            (2. * double(line.size()));
    there += (placeOf(other / 3, other) + placeOf(other / 3, other % 3 + 1)) /
             (2. * double(line.size()));
    turn -= (placeOf(corner / 3, corner % 3 + 1) - placeOf(corner / 3, corner)) *
            std::conj(placeOf(other / 3, other % 3 + 1) - placeOf(other / 3, other));
  }
  turn = std::abs(turn) > 0 ? turn / std::abs(turn) : 1;

  SideBySide both;
  for (const size_t chart : {0, 1}) {
    for (const int32_t face : *charts[chart]) {
      std::array<Vec2d, 3> corners;
      for (int32_t c = 0; c < 3; ++c) {
        Complex p = placeOf(face, c);
        if (chart == 1) p = (p - there) * turn + here;
        corners[size_t(c)] = {p.real(), p.imag()};
      }
      both.faces.push_back(face);
      both.places.push_back(corners);
    }
  }
  return both;
}

void JoinAlongBorders(std::vector<ChartBorder> borders, const TryToJoin& tryToJoin) {
  for (int round = 0; round < kMostRounds && !borders.empty(); ++round) {
    const std::vector<size_t> offered = LongestOfBoth(borders);
    std::vector<std::array<int32_t, 2>> pairs;
    for (const size_t i : offered) pairs.push_back({borders[i].a, borders[i].b});
    const std::vector<uint8_t> isJoined = tryToJoin(pairs);

    // What was tried is no border any more; those of b become those of a.
    std::unordered_map<int32_t, int32_t> now;
    for (size_t i = 0; i < pairs.size(); ++i) {
      borders[offered[i]].length = -1;
      if (isJoined[i]) now[pairs[i][1]] = pairs[i][0];
    }
    const auto chartNow = [&](int32_t chart) {
      const auto found = now.find(chart);
      return found == now.end() ? chart : found->second;
    };
    std::vector<ChartBorder> left;
    for (const ChartBorder& border : borders) {
      const auto [a, b] = std::minmax({chartNow(border.a), chartNow(border.b)});
      if (border.length >= 0 && a != b) left.push_back({a, b, border.length});
    }
    borders = std::move(left);
    Merge(&borders);
  }
}

}  // namespace lambert
