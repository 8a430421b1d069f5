#include "Atlas/Core/LightMapSeams.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <unordered_map>

#include "Atlas/Core/ChartMesh.h"

namespace lambert {

namespace {

/// What moving a texel costs beside a difference at a point of a seam; one around a chart, which
/// shows within half a texel of its edge alone; and one that is held at a bound.
constexpr double kStay = 1e-3, kStayAround = 1e-5, kHeld = 1e3;
/// In parts of the mean irradiance, by how much a texel may lie beside its bounds before it is held
/// there.
constexpr double kBeside = 1e-4;
/// Solutions at most, each of which holds more texels.
constexpr int kMostRounds = 10;
/// What texels may be at most, of the brightest around.
constexpr float kBrightest = 1.25f;

double Norm(const Spectrum& s) { return std::sqrt(SquaredNorm(s) / 3); }

Spectrum Brighter(Spectrum a, const Spectrum& b) {
  for (int band = 0; band < 3; ++band) a[band] = std::max(a[band], b[band]);
  return a;
}

/// What a side of a seam shows.
Spectrum LightAt(const SeamPoint& seam, size_t side, const LightMap& map) {
  if (seam.pages[side] < 0) return seam.fixed;
  return seam.footprints[side].Lookup(map.pages[size_t(seam.pages[side])]);
}

/// The brightest of the texels about a point of a seam, band by band, on both sides, and what is
/// fixed.
Spectrum BrightestAround(const SeamPoint& seam, const LightMap& map) {
  Spectrum brightest = seam.pages[1] < 0 ? seam.fixed : Spectrum();
  for (size_t side = 0; side < 2; ++side) {
    if (seam.pages[side] < 0) continue;
    for (const size_t texel : seam.footprints[side].texels) {
      brightest = Brighter(brightest, map.pages[size_t(seam.pages[side])][texel]);
    }
  }
  return brightest;
}

using Matrix = Eigen::SparseMatrix<double>;

/// The texels of seams by least squares, within bounds: `differences` of the two sides, by point of
/// a seam, and how far texels move, weighed by `stays`.
class Closing {
 public:
  Closing(const Matrix& differences, const Eigen::VectorXd& stays, double mean)
      : transposed_(differences.transpose()),
        squares_(transposed_ * differences),
        stays_(stays),
        mean_(mean) {
    solver_.analyzePattern(squares_ + Diagonal(stays));
  }

  /// From the texels as they were, W/m2, the most that each may be, and what is fixed beyond the
  /// points.
  Eigen::VectorXd Solve(const Eigen::VectorXd& was, const Eigen::VectorXd& most,
                        const Eigen::VectorXd& fixed) {
    const Eigen::VectorXd beyond = transposed_ * fixed;
    const double slack = kBeside * mean_;
    Eigen::VectorXd stays = stays_, goal = stays_.cwiseProduct(was);
    if (!isFree_) solver_.factorize(squares_ + Diagonal(stays));
    isFree_ = true;
    Eigen::VectorXd is = solver_.solve(beyond + goal);
    // Those that would have to lie beside are held at the bound, and others make up for it.
    for (int round = 1; round < kMostRounds; ++round) {
      bool areWithin = true;
      for (Eigen::Index i = 0; i < is.size(); ++i) {
        if (is[i] >= -slack && is[i] <= most[i] + slack) continue;
        areWithin = false;
        stays[i] = kHeld / (mean_ * mean_);
        goal[i] = stays[i] * (is[i] < 0 ? 0 : most[i]);
      }
      if (areWithin) break;
      solver_.factorize(squares_ + Diagonal(stays));
      isFree_ = false;
      is = solver_.solve(beyond + goal);
    }
    return is.cwiseMin(most).cwiseMax(0);
  }

 private:
  static Matrix Diagonal(const Eigen::VectorXd& values) {
    Matrix diagonal(values.size(), values.size());
    diagonal.reserve(Eigen::VectorXi::Constant(values.size(), 1));
    for (Eigen::Index i = 0; i < values.size(); ++i) diagonal.insert(i, i) = values[i];
    return diagonal;
  }

  const Matrix transposed_, squares_;
  const Eigen::VectorXd& stays_;
  const double mean_;
  Eigen::SimplicialLDLT<Matrix> solver_;
  bool isFree_ = false;  ///< it was last factored with no texel held
};

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
    ForEachPlaceAlong(length * float(atlas.pageSize), [&](float part, bool isClosed) {
      const auto at = [&](size_t side) {
        return Footprint(atlas.pageSize, from[side] + (to[side] - from[side]) * part);
      };
      seams.push_back({{atlas.pageOfChart[charts[0]], atlas.pageOfChart[charts[1]]},
                       {at(0), at(1)},
                       {},
                       isClosed});
    });
  });

  // And what they border on.
  for (const BorderPoint& point : borders) {
    const Footprint footprint(atlas.pageSize, point.textureCoords);
    seams.push_back({{point.page, -1}, {footprint, footprint}, point.irradiance, point.isClosed});
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

void CloseSeams(const std::vector<SeamPoint>& seams, double mean,
                const std::vector<std::vector<uint8_t>>& isDrawn, LightMap* map) {
  if (seams.empty() || !(mean > 0)) return;
  // The texels that are looked up, as unknowns.
  std::unordered_map<uint64_t, int> unknownOfTexel;
  std::vector<Spectrum*> texels;
  std::vector<double> costs;
  std::vector<Spectrum> brightest;
  const size_t pageTexels = size_t(map->pageSize) * size_t(map->pageSize);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> weights(seams.size());
  for (size_t s = 0; s < seams.size(); ++s) {
    if (!seams[s].isClosed) continue;
    const Spectrum light = LightAt(seams[s], 0, *map) + LightAt(seams[s], 1, *map);
    weights[s] = 1 / std::max(mean, Norm(light * 0.5f));
    const Spectrum around = BrightestAround(seams[s], *map);
    for (size_t side = 0; side < 2; ++side) {
      if (seams[s].pages[side] < 0) continue;
      const Footprint& footprint = seams[s].footprints[side];
      for (size_t i = 0; i < 4; ++i) {
        const size_t page = size_t(seams[s].pages[side]);
        const auto [place, isNew] =
            unknownOfTexel.try_emplace(page * pageTexels + footprint.texels[i], int(texels.size()));
        if (isNew) {
          texels.push_back(&map->pages[page][footprint.texels[i]]);
          costs.push_back(isDrawn[page][footprint.texels[i]] ? kStay : kStayAround);
          brightest.push_back(around);
        }
        brightest[size_t(place->second)] = Brighter(brightest[size_t(place->second)], around);
        entries.emplace_back(int(s), place->second,
                             weights[s] * (side == 0 ? footprint.parts[i] : -footprint.parts[i]));
      }
    }
  }

  // Those that agree, band after band.
  const Eigen::Index count = Eigen::Index(texels.size());
  Matrix differences(Eigen::Index(seams.size()), count);
  differences.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd stays(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double light = std::max(mean, Norm(*texels[size_t(i)]));
    stays[i] = costs[size_t(i)] / (light * light);
  }
  Closing closing(differences, stays, mean);
  for (int band = 0; band < 3; ++band) {
    Eigen::VectorXd was(count), most(count), fixed(Eigen::Index(seams.size()));
    for (Eigen::Index i = 0; i < count; ++i) {
      was[i] = double((*texels[size_t(i)])[band]);
      most[i] = double(kBrightest * brightest[size_t(i)][band]);
    }
    for (size_t s = 0; s < seams.size(); ++s) {
      fixed[Eigen::Index(s)] =
          seams[s].pages[1] < 0 ? weights[s] * double(seams[s].fixed[band]) : 0;
    }
    const Eigen::VectorXd is = closing.Solve(was, most, fixed);
    if (!is.allFinite()) continue;
    for (Eigen::Index i = 0; i < count; ++i) (*texels[size_t(i)])[band] = float(is[i]);
  }
}

}  // namespace lambert
