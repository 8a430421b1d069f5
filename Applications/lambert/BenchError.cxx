#include "BenchError.h"

#include <algorithm>
#include <cmath>

#include "Common/Core/Random.h"

namespace lambert {
namespace {

constexpr int kBootstraps = 1000;
constexpr uint64_t kBootstrapSeed = 1;

double SquaredNorm(const Spectrum& s) {
  return double(s.r) * s.r + double(s.g) * s.g + double(s.b) * s.b;
}

/// Squares at one point, the noise of the reference taken off.
struct Squares {
  double error = 0, reference = 0;
};

double RelativeRms(const Squares& sum) {
  return sum.error > 0 && sum.reference > 0 ? std::sqrt(sum.error / sum.reference) : 0;
}

void Bootstrap(const std::vector<Squares>& squares, SolutionError* error) {
  std::vector<double> values(kBootstraps);
  Random random(kBootstrapSeed);
  for (double& value : values) {
    Squares sum;
    for (size_t i = 0; i < squares.size(); ++i) {
      const Squares& s = squares[size_t(random.UniformDouble() * double(squares.size()))];
      sum.error += s.error, sum.reference += s.reference;
    }
    value = RelativeRms(sum);
  }
  std::sort(values.begin(), values.end());
  error->rmsLow = values[size_t(0.025 * kBootstraps)];
  error->rmsHigh = values[size_t(0.975 * kBootstraps)];
}

}  // namespace

SolutionError SummarizeError(const std::vector<Spectrum>& delivered,
                             const std::vector<IrradianceEstimate>& reference) {
  SolutionError error;
  error.points = int64_t(delivered.size());
  if (delivered.empty()) return error;

  // Relative RMS error and bias.
  std::vector<Squares> squares;
  Squares sum;
  double given = 0, truth = 0, variances = 0, meanNorm = 0;
  for (size_t i = 0; i < delivered.size(); ++i) {
    const Spectrum& exact = reference[i].irradiance;
    const double variance = SquaredNorm(reference[i].standardError);
    squares.push_back(
        {SquaredNorm(delivered[i] - exact) - variance, SquaredNorm(exact) - variance});
    sum.error += squares.back().error, sum.reference += squares.back().reference;
    given += delivered[i].Mean(), truth += exact.Mean(), variances += variance;
    meanNorm += std::sqrt(SquaredNorm(exact)) / double(delivered.size());
  }
  if (!(truth > 0)) return error;
  error.rms = RelativeRms(sum);
  error.bias = (given - truth) / truth;
  error.noise = sum.reference > 0 ? std::sqrt(variances / sum.reference) : 0;
  Bootstrap(squares, &error);

  // Bounded error, and the tail of the pointwise one.
  double bounded = 0;
  std::vector<double> relative;
  for (size_t i = 0; i < delivered.size(); ++i) {
    const double norm = std::sqrt(SquaredNorm(reference[i].irradiance));
    const double scale = std::max(norm, meanNorm);
    bounded += squares[i].error / (scale * scale) / double(delivered.size());
    relative.push_back(std::sqrt(SquaredNorm(delivered[i] - reference[i].irradiance)) /
                       std::max(norm, 1e-3 * meanNorm));
  }
  error.bounded = std::sqrt(std::max(0.0, bounded));
  const auto rank = relative.begin() + int64_t(0.95 * double(relative.size() - 1));
  std::nth_element(relative.begin(), rank, relative.end());
  error.percentile95 = *rank;
  return error;
}

}  // namespace lambert
