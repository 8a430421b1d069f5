#include "Atlas/Core/TexelDensity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Atlas/Core/ShownSides.h"

namespace lambert {
namespace {

/// Texels a metre at most, and by one over it at least, in parts of what even texels have.
constexpr double kMostDensity = 4;
/// Squared error to density: the sixth root, as what falls with the fourth power of a texel asks
/// for.
constexpr double kExponent = 1. / 6;
/// Steps towards the number of texels that there were, with densities that reach their ends.
constexpr int kBalancingSteps = 50;
/// The part of a page that a chart which is scaled up may be long.
constexpr double kLongest = 0.8;

/// Places of a triangle that stand for its area.
constexpr std::array<std::array<float, 3>, 4> kPlaces = {{{1 / 3.f, 1 / 3.f, 1 / 3.f},
                                                          {2 / 3.f, 1 / 6.f, 1 / 6.f},
                                                          {1 / 6.f, 2 / 3.f, 1 / 6.f},
                                                          {1 / 6.f, 1 / 6.f, 2 / 3.f}}};

template <class T>
T Blend(const std::vector<T>& values, const std::array<int32_t, 3>& corners,
        const std::array<float, 3>& w) {
  return values[size_t(corners[0])] * w[0] + values[size_t(corners[1])] * w[1] +
         values[size_t(corners[2])] * w[2];
}

/// The longer side of the box about the places of a chart, m.
double LengthOf(const ChartSet& set, const Chart& chart) {
  Vec2f low = set.places[size_t(*set.FacesOf(chart).begin())][0], high = low;
  for (const int32_t f : set.FacesOf(chart)) {
    for (const Vec2f& p : set.places[size_t(f)]) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  return double(std::max(high.x - low.x, high.y - low.y));
}

}  // namespace

std::vector<ChartError> ErrorsOfCharts(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                                       const LightMap& map, const RadiositySolution& solution) {
  const std::vector<int32_t> chartOfFace = ChartOfFace(atlas.set);
  const std::vector<uint8_t> sides = BrighterSidesOfSurfaces(mesh, solution);
  std::vector<ChartError> errors(atlas.set.charts.size());
  for (size_t t = 0; t < solution.inputFaceId.size(); ++t) {
    const int64_t face = solution.inputFaceId[t];
    if (solution.side[t] != sides[size_t(mesh.surfaceId[size_t(face)])]) continue;
    const size_t chart = size_t(chartOfFace[size_t(face)]);
    ChartError& error = errors[chart];
    const double area = double(solution.mesh.Area(int64_t(t))) / double(kPlaces.size());
    for (const auto& w : kPlaces) {
      const auto& corners = solution.mesh.triangles[t];
      const Spectrum wanted = Blend(solution.irradiance, corners, w);
      const Spectrum found =
          Lookup(map, atlas.pageOfChart[chart],
                 PlaceOnPage(mesh, atlas, face, Blend(solution.mesh.positions, corners, w)));
      error.area += area;
      error.squares += area * SquaredNorm(found - wanted);
      error.light += area * SquaredNorm(wanted);
    }
  }
  return errors;
}

double RelativeError(const std::vector<ChartError>& errors) {
  ChartError all;
  for (const ChartError& error : errors) {
    all.squares += error.squares;
    all.light += error.light;
  }
  return all.light > 0 ? std::sqrt(all.squares / all.light) : 0;
}

std::vector<double> DensitiesByError(const std::vector<ChartError>& errors) {
  double area = 0, squares = 0;
  for (const ChartError& error : errors) {
    area += error.area;
    squares += error.squares;
  }
  std::vector<double> wanted(errors.size(), 1);
  if (!(squares > 0)) return wanted;
  for (size_t i = 0; i < errors.size(); ++i) {
    if (!(errors[i].area > 0)) continue;
    wanted[i] = std::pow(errors[i].squares / errors[i].area / (squares / area), kExponent);
  }

  // As many texels as before.
  const auto within = [](double density) {
    return std::min(kMostDensity, std::max(1 / kMostDensity, density));
  };
  double scale = 1;
  for (int step = 0; step < kBalancingSteps; ++step) {
    double texels = 0;
    for (size_t i = 0; i < errors.size(); ++i) {
      const double density = within(scale * wanted[i]);
      texels += errors[i].area * density * density;
    }
    scale *= std::sqrt(area / texels);
  }
  for (double& density : wanted) density = within(scale * density);
  return wanted;
}

RadiosityAtlas WithTexelDensity(const TriangleMesh& mesh, RadiosityAtlas atlas,
                                const RadiositySolution& solution, const AtlasOptions& options,
                                const ProgressCallback& progress) {
  if (options.density == TexelDensity::Uniform || atlas.pages == 0) return atlas;
  const LightMap map = MakeLightMap(mesh, atlas, solution, [&](double fraction, const char* stage) {
    return Report(progress, 0.5 * fraction, stage);
  });
  const std::vector<double> densities =
      DensitiesByError(ErrorsOfCharts(mesh, atlas, map, solution));

  // Charts of more texels are larger ones of even texels, none of them longer than a page.
  ChartSet set = atlas.set;
  const double longest =
      std::min(kLongest * atlas.pageSize, double(LongestChart(options))) * atlas.texelSize;
  for (size_t i = 0; i < set.charts.size(); ++i) {
    const Chart& chart = set.charts[i];
    const double room = std::max(1., longest / std::max(1e-30, LengthOf(set, chart)));
    const float scale = float(std::min(densities[i], room));
    for (const int32_t f : set.FacesOf(chart)) {
      for (Vec2f& place : set.places[size_t(f)]) place = place * scale;
    }
  }
  RadiosityAtlas followed =
      PackAtlas(std::move(set), options, [&](double fraction, const char* stage) {
        return Report(progress, 0.5 + 0.5 * fraction, stage);
      });
  followed.set.places = atlas.set.places;
  followed.chartSeconds = atlas.chartSeconds;
  followed.packSeconds += atlas.packSeconds;
  return followed;
}

}  // namespace lambert
