#include "Atlas/Core/LightMapSeams.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <unordered_map>

#include "Atlas/Core/ChartMesh.h"

namespace lambert {

namespace {

/// What moving a texel costs beside a difference at a point of a seam.
constexpr double kStay = 0.1;
constexpr double kSolverTolerance = 1e-6;
constexpr int kMostSolverSteps = 1000;

double Norm(const Spectrum& s) { return std::sqrt(SquaredNorm(s) / 3); }

/// What a side of a seam shows.
Spectrum LightAt(const SeamPoint& seam, size_t side, const LightMap& map) {
  if (seam.pages[side] < 0) return seam.fixed;
  return seam.footprints[side].Lookup(map.pages[size_t(seam.pages[side])]);
}

}  // namespace

std::vector<SeamPoint> FindSeams(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                                 const std::vector<int32_t>& chartOfFace,
                                 const std::vector<BorderPoint>& borders) {
  // Along cuts.
  std::vector<SeamPoint> seams;
  ForEachSharedEdge(mesh, FindNeighbours(mesh), [&](const SharedEdge& edge) {
    const std::array<size_t, 2> charts = {size_t(chartOfFace[edge.faces[0]]),
                                          size_t(chartOfFace[edge.faces[1]])};
    std::array<Vec2f, 2> from, to;
    float length = 0;
    for (size_t side = 0; side < 2; ++side) {
      from[side] = atlas.textureCoords[edge.faces[side]][edge.from[side]];
      to[side] = atlas.textureCoords[edge.faces[side]][edge.to[side]];
    }
    if (charts[0] == charts[1] && from[0] == from[1] && to[0] == to[1]) return;
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
          {{atlas.pageOfChart[charts[0]], atlas.pageOfChart[charts[1]]}, {at(0), at(1)}, {}});
    }
  });

  // And what they border on.
  for (const BorderPoint& point : borders) {
    const Footprint footprint(atlas.pageSize, point.textureCoords);
    seams.push_back({{point.page, -1}, {footprint, footprint}, point.irradiance});
  }
  return seams;
}

SeamDifference MeasureSeams(const std::vector<SeamPoint>& seams, const LightMap& map, double mean) {
  SeamDifference difference;
  if (seams.empty() || !(mean > 0)) return difference;
  for (const SeamPoint& seam : seams) {
    const Spectrum a = LightAt(seam, 0, map), b = LightAt(seam, 1, map);
    const double part = Norm(a - b) / std::max(mean, Norm((a + b) * 0.5f));
    difference.rms += part * part / double(seams.size());
    difference.largest = std::max(difference.largest, part);
  }
  difference.rms = std::sqrt(difference.rms);
  return difference;
}

void CloseSeams(const std::vector<SeamPoint>& seams, double mean, LightMap* map) {
  if (seams.empty() || !(mean > 0)) return;
  // The texels that are looked up, as unknowns.
  std::unordered_map<uint64_t, int> unknownOfTexel;
  std::vector<Spectrum*> texels;
  const size_t pageTexels = size_t(map->pageSize) * size_t(map->pageSize);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> weights(seams.size());
  for (size_t s = 0; s < seams.size(); ++s) {
    const Spectrum light = LightAt(seams[s], 0, *map) + LightAt(seams[s], 1, *map);
    weights[s] = 1 / std::max(mean, Norm(light * 0.5f));
    for (size_t side = 0; side < 2; ++side) {
      if (seams[s].pages[side] < 0) continue;
      const Footprint& footprint = seams[s].footprints[side];
      for (size_t i = 0; i < 4; ++i) {
        const size_t page = size_t(seams[s].pages[side]);
        const auto [place, isNew] =
            unknownOfTexel.try_emplace(page * pageTexels + footprint.texels[i], int(texels.size()));
        if (isNew) texels.push_back(&map->pages[page][footprint.texels[i]]);
        entries.emplace_back(int(s), place->second,
                             weights[s] * (side == 0 ? footprint.parts[i] : -footprint.parts[i]));
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
    Eigen::VectorXd fixed(int(seams.size()));
    for (size_t s = 0; s < seams.size(); ++s) {
      fixed[int(s)] = seams[s].pages[1] < 0 ? weights[s] * double(seams[s].fixed[band]) : 0;
    }
    const Eigen::VectorXd wanted = difference.transpose() * fixed + stays.cwiseProduct(was);
    const Eigen::VectorXd is = solver.solveWithGuess(wanted, was);
    if (!is.allFinite()) continue;
    for (int i = 0; i < count; ++i) (*texels[size_t(i)])[band] = float(std::max(0., is[i]));
  }
}

}  // namespace lambert
