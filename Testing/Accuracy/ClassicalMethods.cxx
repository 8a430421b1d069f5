// The methods on fixed meshes: their answers on elements of one size and of twice that size tell
// how far they are from the truth.
#include <cmath>

#include "Classical/Core/CachedRadiosity.h"
#include "Classical/Core/MatrixRadiosity.h"
#include "Classical/Core/ProgressiveRadiosity.h"
#include "FindByMethod.h"
#include "Reference/Core/PathTracedBake.h"
#include "SurfaceMeans.h"

namespace lambert::testing {

namespace {

using Answers = std::vector<double>;

/// Elements of a scene, or so.
constexpr double kElements = 600;
constexpr int kSeeds = 8;

double ElementSize(const Scene& scene) {
  return std::sqrt(2 * SurfaceArea(scene.mesh, -1) / kElements);
}

Answers ReadAll(const AccuracyCase& asked, const Scene& scene, const RadiositySolution& solution) {
  Answers answers;
  for (const Quantity& q : asked.quantities) answers.push_back(ReadQuantity(scene, solution, q));
  return answers;
}

/// How often light bounces: 1 / (1 - reflectance).
double Bounces(const Scene& scene) {
  float reflectance = 0;
  for (const Spectrum& rho : scene.mesh.reflectance) reflectance = std::max(reflectance, rho.g);
  return 1 / (1 - double(reflectance));
}

/// `fine`, an answer on elements of half the size of those of `coarse`, by a method of first order
/// is as far from the truth as from `coarse`; twice that is allowed. `own` is what the method may
/// miss besides, relative to the light.
Finding FirstOrder(const Quantity& q, double coarse, double fine, double own) {
  return {fine, 2 * std::abs(fine - coarse) + own * std::abs(q.truth - q.offset)};
}

/// Means and standard errors over independent seeds.
struct Means {
  Answers value, error;
  template <class Solve>
  Means(size_t quantities, const Solve& solve) : value(quantities), error(quantities) {
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const Answers answers = solve(uint64_t(seed));
      for (size_t i = 0; i < quantities; ++i) {
        value[i] += answers[i] / kSeeds, error[i] += answers[i] * answers[i] / kSeeds;
      }
    }
    for (size_t i = 0; i < quantities; ++i) {
      error[i] = std::sqrt(std::max(0.0, error[i] - value[i] * value[i]) / (kSeeds - 1));
    }
  }
};

/// 5 standard errors of 8 seeds: chance misses one quantity in 600; the seeds are fixed.
constexpr double kErrors = 5;

}  // namespace

std::vector<Finding> FindByMatrixRadiosity(const AccuracyCase& asked) {
  const Scene scene = asked.scene();
  const auto solve = [&](double size) {
    MatrixRadiosityOptions options;
    options.elementSize = size;
    return ReadAll(asked, scene, SolveMatrixRadiosity(scene, options));
  };
  const double size = ElementSize(scene);
  const Answers coarse = solve(2 * size), fine = solve(size);
  std::vector<Finding> findings;
  for (size_t i = 0; i < fine.size(); ++i) {
    // Form factors are good to 1e-3, and count as often as light bounces.
    findings.push_back(FirstOrder(asked.quantities[i], coarse[i], fine[i], 1e-3 * Bounces(scene)));
  }
  return findings;
}

std::vector<Finding> FindByProgressiveRadiosity(const AccuracyCase& asked) {
  const Scene scene = asked.scene();
  ProgressiveRadiosityOptions options;
  // Without reflection every patch is shot once, all of them.
  const double bounces = Bounces(scene);
  options.unshot = bounces > 1 ? 0.005 : 1e-6;
  const auto solve = [&](double size) {
    options.elementSize = size;
    return ReadAll(asked, scene, SolveProgressiveRadiosity(scene, options));
  };
  const double size = ElementSize(scene);
  const Answers coarse = solve(2 * size), fine = solve(size);
  std::vector<Finding> findings;
  for (size_t i = 0; i < fine.size(); ++i) {
    // What stays unshot is missing, and all that it would have lit. And single precision.
    findings.push_back(
        FirstOrder(asked.quantities[i], coarse[i], fine[i], options.unshot * bounces + 1e-4));
  }
  return findings;
}

std::vector<Finding> FindByCachedRadiosity(const AccuracyCase& asked) {
  const Scene scene = asked.scene();
  const auto solve = [&](double size) {
    return Means(asked.quantities.size(), [&](uint64_t seed) {
      CachedRadiosityOptions options;
      options.elementSize = size;
      options.paths = options.gatherRays = 16;
      options.emitterRays = 64;
      options.seed = seed;
      return ReadAll(asked, scene, SolveCachedRadiosity(scene, options));
    });
  };
  const double size = ElementSize(scene);
  const Means coarse = solve(2 * size), fine = solve(size);
  std::vector<Finding> findings;
  for (size_t i = 0; i < fine.value.size(); ++i) {
    // Points are drawn 1e-3 of the way into their elements, at every bounce.
    findings.push_back(
        FirstOrder(asked.quantities[i], coarse.value[i], fine.value[i], 1e-3 * Bounces(scene)));
    findings.back().tolerance += kErrors * fine.error[i];
  }
  return findings;
}

std::vector<Finding> FindByBaking(const AccuracyCase& asked) {
  const Scene scene = asked.scene();
  const Means means(asked.quantities.size(), [&](uint64_t seed) {
    PathTracedBakeOptions options;
    options.samples = std::max(8, int(64 / Bounces(scene)));
    options.seed = seed;
    return ReadAll(asked, scene, BakePathTraced(scene, options));
  });
  std::vector<Finding> findings;
  for (size_t i = 0; i < means.value.size(); ++i) {
    // And single precision, 1e-4 of the light.
    const Quantity& q = asked.quantities[i];
    findings.push_back(
        {means.value[i], kErrors * means.error[i] + 1e-4 * std::abs(q.truth - q.offset)});
  }
  return findings;
}

}  // namespace lambert::testing
