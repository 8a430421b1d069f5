// What the rows of a bench say: curves of medians, and methods at equal error.
#pragma once

#include <string>
#include <vector>

#include "BenchTable.h"

namespace lambert {

/// The median of the runs with one value of a method's knob.
struct BenchPoint {
  double value = 0, seconds = 0, error = 0, elements = 0;
};

/// The error that counts on a scene: rms; bounded where the intervals of the former are wider than
/// 30 % of it. The intervals are those of the path-traced bake, whose error is spread over all
/// vertices (of all methods where it was not run): the median of the runs with an rms of 5 % or
/// more.
double BenchRow::*ErrorThatCounts(const std::vector<BenchRow>& rows, const std::string& scene);
/// "relative RMS error" or "bounded error".
std::string ErrorName(const std::vector<BenchRow>& rows, const std::string& scene);

/// Errors at which methods are compared.
constexpr double kEqualErrors[] = {0.1, 0.05, 0.02, 0.01};

/// How a cost at a wanted error came about.
enum class EqualErrorKind {
  Unreached,     ///< no run is that good
  Interpolated,  ///< between two runs, in logarithms
  AtMost,        ///< the cheapest run is better already
  Extrapolated   ///< by the law of Monte Carlo, error ~ 1 / sqrt(time); the path-traced bake alone
};
struct EqualError {
  EqualErrorKind kind = EqualErrorKind::Unreached;
  double cost = BenchRow::kUnknown;

  bool IsReached() const { return kind != EqualErrorKind::Unreached; }
};

/// Names of the scenes, or of the methods of a scene, in the order of their first rows.
std::vector<std::string> ScenesOf(const std::vector<BenchRow>& rows, const std::string& study);
std::vector<std::string> MethodsOf(const std::vector<BenchRow>& rows, const std::string& scene);

/// The sweep of one method on one scene, coarse runs first; failed ones are left out.
std::vector<BenchPoint> SweepCurve(const std::vector<BenchRow>& rows, const std::string& scene,
                                   const std::string& method);

/// Seconds (or elements) at which the curve first reaches the error `wanted`, [0, 1]. Runs that
/// cost more and err more than another are passed over.
EqualError SecondsAtError(const std::vector<BenchPoint>& curve, double wanted, bool isMonteCarlo);
EqualError ElementsAtError(const std::vector<BenchPoint>& curve, double wanted);

/// The median of one number over the rows; unknown ones are left out.
double Median(const std::vector<BenchRow>& rows, double BenchRow::*number);

/// Medians over runs of the convergence study: seconds and error of every iteration.
std::vector<BenchPoint> ConvergenceCurve(const std::vector<BenchRow>& rows,
                                         const std::string& scene);

/// The rows of the tessellation study, one list for each number of triangles, ascending.
std::vector<std::vector<BenchRow>> TessellationGroups(const std::vector<BenchRow>& rows);

}  // namespace lambert
