// Laws of light that every solver keeps in every scene, as far as the error goes that it is asked
// for. The lines that it prints are those that Documentation/Accuracy.md is made of.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "Common/Core/Random.h"
#include "RandomScenes.h"
#include "Solvers.h"

namespace lambert::testing {
namespace {

/// Errors asked for: coarse, so that many scenes can be solved.
constexpr double kRequest = 0.4;

struct SolverAndSeed {
  const Solver* solver;
  uint64_t seed;
};

std::vector<SolverAndSeed> SolversAndSeeds() {
  std::vector<SolverAndSeed> all;
  const std::vector<uint64_t> seeds = LawSeeds();
  for (const Solver& solver : Solvers()) {
    for (size_t i = 0; i < seeds.size(); i += solver.seedsApart) {
      all.push_back({&solver, seeds[i]});
    }
  }
  return all;
}

std::string NameOf(const ::testing::TestParamInfo<SolverAndSeed>& info) {
  return std::string(info.param.solver->name) + "_" + std::to_string(info.param.seed);
}

class SolverLaws : public ::testing::TestWithParam<SolverAndSeed> {
 protected:
  RadiositySolution Solve(RandomScene* made) {
    return GetParam().solver->solve(kRequest, &made->scene, &statistics_);
  }
  void Print(const char* law, double value) const {
    std::printf("| %s | %s | seed %llu | %.4f |\n", law, GetParam().solver->name,
                static_cast<unsigned long long>(GetParam().seed), value);
  }

  SolverStatistics statistics_;
};

/// The brightest that a place can be: a furnace of the brightest source and the lightest surface of
/// any band.
float BrightestIrradiance(const Scene& scene) {
  float source = 0, reflectance = 0;
  for (const Spectrum& e : scene.mesh.emittance) source = std::max(source, e.MaxBand());
  for (const Spectrum& rho : scene.mesh.reflectance) {
    reflectance = std::max(reflectance, rho.MaxBand());
  }
  for (const Light& light : scene.lights) {
    source = std::max(source, float(kPi) * light.intensity.MaxBand());
  }
  return source / (1 - reflectance);
}

TEST_P(SolverLaws, LightIsFiniteAndWithinBounds) {
  SCOPED_TRACE(HowToRepeat(GetParam().seed));
  RandomScene made = MakeRandomScene(GetParam().seed, Overlaps::Allowed);
  const RadiositySolution solution = Solve(&made);
  const float brightest = 1.0001f * BrightestIrradiance(made.scene);  // of rounding
  for (size_t point = 0; point < solution.irradiance.size(); ++point) {
    const Spectrum &e = solution.irradiance[point], &b = solution.radiosity[point];
    ASSERT_TRUE(e.IsFinite() && b.IsFinite()) << "point " << point;
    for (int band = 0; band < 3; ++band) {
      ASSERT_GE(e[band], 0) << "point " << point;
      ASSERT_GE(b[band], 0) << "point " << point;
      ASSERT_LE(e[band], brightest) << "point " << point;
    }
  }
}

TEST_P(SolverLaws, LightIsAbsorbedOrEscapes) {
  SCOPED_TRACE(HowToRepeat(GetParam().seed));
  RandomScene made = MakeRandomScene(GetParam().seed, Overlaps::None);
  Solve(&made);
  const SolverStatistics& s = statistics_;
  for (int band = 0; band < 3; ++band) {
    ASSERT_GT(s.emitted[band], 0);
    const double kept = double((s.absorbed[band] + s.escaped[band]) / s.emitted[band]);
    // Escape is found by 32768 rays: three standard deviations are under 1 %.
    EXPECT_NEAR(kept, 1, kRequest + 0.01);
    if (band == 1) Print("balance", kept);
  }
}

/// Sum over the triangles of a solution of term(input face, irradiance) x area.
template <class Term>
double Sum(const RadiositySolution& solution, const Term& term) {
  double sum = 0;
  for (int64_t t = 0; t < solution.mesh.FaceCount(); ++t) {
    const double third = double(solution.mesh.Area(t)) / 3;
    for (const int32_t p : solution.mesh.triangles[size_t(t)]) {
      sum +=
          third * term(solution.inputFaceId[size_t(t)], double(solution.irradiance[size_t(p)].g));
    }
  }
  return sum;
}

// Rows of form factors sum to 1 where nothing is open: light is 2 on all sides within the walls.
TEST_P(SolverLaws, AFurnaceIsEven) {
  SCOPED_TRACE(HowToRepeat(GetParam().seed));
  RandomScene made = MakeRandomScene(2 * GetParam().seed + 1, Overlaps::Allowed);
  MakeFurnace(0.5f, &made.scene);
  const RadiositySolution solution = Solve(&made);
  // The walls emit outward too, and are dark there.
  const auto within = [](double e) { return e > 0 ? 1.0 : 0.0; };
  const double area = Sum(solution, [&](int64_t, double e) { return within(e); });
  const double squares =
      Sum(solution, [&](int64_t, double e) { return within(e) * (e / 2 - 1) * (e / 2 - 1); });
  // The request is for what is interpolated; at the corners, which scatter each for themselves, the
  // scatter is up to the root of two larger: the mean square of three weights that sum to 1 is 1/2.
  EXPECT_LE(std::sqrt(squares / area), std::sqrt(2.0) * kRequest);
  Print("furnace, rms", std::sqrt(squares / area));
  Print("furnace, mean", Sum(solution, [](int64_t, double e) { return e / 2; }) / area);
}

// What one half of the faces sends to the other is what it would get from it.
TEST_P(SolverLaws, ExchangeIsMutual) {
  SCOPED_TRACE(HowToRepeat(GetParam().seed));
  double power[2] = {};
  for (const uint64_t half : {0, 1}) {
    RandomScene made = MakeRandomScene(2 * GetParam().seed, Overlaps::None);
    TriangleMesh& mesh = made.scene.mesh;
    std::vector<uint8_t> lit;
    for (size_t face = 0; face < mesh.triangles.size(); ++face) {
      lit.push_back(HashBits(GetParam().seed, face) % 2 == half);
      mesh.materialId[face] = lit.back();
    }
    MakeBlack(lit, &made.scene);
    const RadiositySolution solution = Solve(&made);
    power[half] = Sum(solution, [&](int64_t face, double e) {
      return mesh.emittance[size_t(face)].IsBlack() ? e : 0;
    });
  }
  EXPECT_NEAR(power[0], power[1], kRequest * power[0]);
  Print("mutual", power[1] / power[0]);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SolverLaws, ::testing::ValuesIn(SolversAndSeeds()), NameOf);

}  // namespace
}  // namespace lambert::testing
