#include "Radiosity/Core/VisibilityFilter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Common/Core/Random.h"

namespace lambert {
namespace {

/// A floor of 40 by 40 places, at each of which `rays` told what of a lamp is visible there.
struct Floor {
  std::vector<VisibilitySample> samples;
  std::vector<IrradianceSample> places;

  template <class Visible>
  Floor(int rays, const Visible& visible) {
    Random random(7);
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        const Vec3f position(float(x) / 40, float(y) / 40, 0), normal(0, 0, 1);
        int clear = 0;
        for (int ray = 0; ray < rays; ++ray) clear += random.Uniform() < visible(position);
        const float part = float(clear) / float(rays);
        samples.push_back({Spectrum(1.2f, 0.6f, 1.2f) * part, part, float(rays)});
        places.push_back({position, normal, Spectrum(), 0, 1, 1});
      }
    }
  }
  /// What neighbours make of it.
  std::vector<FilteredVisibility> Filtered() {
    const SampleNeighbours neighbours(places, 0);
    std::vector<float> apart;
    for (size_t i = 0; i < samples.size(); ++i) {
      apart.push_back(StandsApart(samples, places, neighbours, int32_t(i)));
    }
    for (size_t i = 0; i < samples.size(); ++i) samples[i].apart = apart[i];
    std::vector<FilteredVisibility> filtered;
    for (size_t i = 0; i < samples.size(); ++i) {
      filtered.push_back(FilterVisibility(samples, places, neighbours, int32_t(i)));
      EXPECT_NEAR(filtered.back().visible.g, filtered.back().visible.r / 2, 1e-5);
      EXPECT_GE(filtered.back().visible.r, 0);
    }
    return filtered;
  }
  /// The visible part of it alone, mean of the bands.
  std::vector<float> Shared() {
    std::vector<float> shared;
    for (const FilteredVisibility& f : this->Filtered()) shared.push_back(f.visible.Mean());
    return shared;
  }
  /// Root of the mean squared error of what was seen, and of what is shared.
  template <class Visible>
  std::array<double, 2> Errors(const Visible& visible) {
    const std::vector<float> shared = this->Shared();
    std::array<double, 2> squares = {0, 0};
    for (size_t i = 0; i < samples.size(); ++i) {
      const double truth = double(visible(places[i].position));
      squares[0] += std::pow(double(samples[i].visible.Mean()) - truth, 2) / double(samples.size());
      squares[1] += std::pow(double(shared[i]) - truth, 2) / double(samples.size());
    }
    return {std::sqrt(squares[0]), std::sqrt(squares[1])};
  }
};

TEST(VisibilityFilter, TakesTheScatterOutOfAPenumbra) {
  const auto penumbra = [](const Vec3f& p) { return 0.1f + 0.8f * p.x; };
  const auto [seen, shared] = Floor(8, penumbra).Errors(penumbra);
  EXPECT_GT(seen, 0.14);
  EXPECT_LT(shared, 0.5 * seen);  // Some that are unlucky stand apart.
}

TEST(VisibilityFilter, KeepsTheEdgeOfAShadow) {
  const auto edge = [](const Vec3f& p) { return p.x < 0.49f ? 0.f : 1.f; };
  const auto [seen, shared] = Floor(16, edge).Errors(edge);
  EXPECT_EQ(seen, 0);
  EXPECT_LT(shared, 0.03);  // Of places on the edge, which 40 of 1600 are on either side.
}

TEST(VisibilityFilter, KeepsAPlaceThatIsInTheShadeAlone) {
  const auto screw = [](const Vec3f& p) {
    return std::abs(p.x - 0.5f) < 0.01f && std::abs(p.y - 0.5f) < 0.01f ? 0.f : 1.f;
  };
  const std::vector<float> shared = Floor(16, screw).Shared();
  EXPECT_LT(shared[20 * 40 + 20], 0.05);
  EXPECT_GT(shared[20 * 40 + 21], 0.9);
}

// Where nearly all of a lamp is visible those that saw less stand apart, and nobody sees more.
TEST(VisibilityFilter, KeepsTheMean) {
  for (const float part : {0.03f, 0.5f, 0.97f}) {
    Floor floor(8, [&](const Vec3f&) { return part; });
    const std::vector<float> shared = floor.Shared();
    double before = 0, after = 0;
    for (size_t i = 0; i < shared.size(); ++i) {
      before += double(floor.samples[i].visible.Mean()) / double(shared.size());
      after += double(shared[i]) / double(shared.size());
    }
    EXPECT_NEAR(after, before, 0.002) << part;
  }
}

// The mean of what is thought of the squared errors is that of the squared errors: where planes
// fit, and at an edge where what stands apart keeps its own.
TEST(VisibilityFilter, KnowsHowFarItIsOff) {
  const auto penumbra = [](const Vec3f& p) { return 0.1f + 0.8f * p.x; };
  const auto edge = [](const Vec3f& p) { return p.x < 0.49f ? 0.1f : 0.9f; };
  const auto ratio = [](const auto& visible) {
    Floor floor(16, visible);
    const std::vector<FilteredVisibility> filtered = floor.Filtered();
    double thought = 0, found = 0;
    for (size_t i = 0; i < filtered.size(); ++i) {
      const double truth = double(visible(floor.places[i].position));
      thought += double(filtered[i].variance);
      found += std::pow(double(filtered[i].visible.Mean()) - truth, 2);
    }
    return thought / found;
  };
  EXPECT_GT(ratio(penumbra), 0.6);
  EXPECT_LT(ratio(penumbra), 1.6);
  EXPECT_GT(ratio(edge), 0.4);
  EXPECT_LT(ratio(edge), 2.5);
}

TEST(VisibilityFilter, KeepsWhatFewNeighboursTell) {
  Floor floor(8, [](const Vec3f&) { return 0.5f; });
  floor.samples.resize(6);
  floor.places.resize(6);
  const std::vector<float> shared = floor.Shared();
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(shared[i], floor.samples[i].visible.Mean());
}

}  // namespace
}  // namespace lambert
