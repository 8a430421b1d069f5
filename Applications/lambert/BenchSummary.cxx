#include "BenchSummary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "BenchMethods.h"

namespace lambert {
namespace {

void AddOnce(const std::string& name, std::vector<std::string>* names) {
  if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
}

/// Medians of the rows of a scene with the same value, by ascending value.
template <class Pick>
std::vector<BenchPoint> MediansByValue(const std::vector<BenchRow>& rows, const std::string& scene,
                                       const Pick& pick) {
  double BenchRow::*error = ErrorThatCounts(rows, scene);
  std::map<double, std::vector<BenchRow>> byValue;
  for (const BenchRow& row : rows) {
    if (row.scene == scene && pick(row) && row.note.empty()) byValue[row.value].push_back(row);
  }
  std::vector<BenchPoint> curve;
  for (const auto& [value, group] : byValue) {
    curve.push_back({value, Median(group, &BenchRow::seconds), Median(group, error),
                     Median(group, &BenchRow::elements)});
  }
  return curve;
}

EqualError CostAtError(std::vector<BenchPoint> curve, double BenchPoint::*cost, double wanted,
                       bool isMonteCarlo) {
  // Ever better for ever more.
  std::sort(curve.begin(), curve.end(),
            [&](const BenchPoint& a, const BenchPoint& b) { return a.*cost < b.*cost; });
  std::vector<BenchPoint> front;
  for (const BenchPoint& point : curve) {
    if (!(point.error > 0) || !(point.*cost > 0)) continue;
    if (front.empty() || point.error < front.back().error) front.push_back(point);
  }
  if (front.empty()) return {};
  if (front.front().error <= wanted) return {EqualErrorKind::AtMost, front.front().*cost};
  for (size_t i = 1; i < front.size(); ++i) {
    const BenchPoint &coarse = front[i - 1], &fine = front[i];
    if (fine.error > wanted) continue;
    const double part = std::log(wanted / coarse.error) / std::log(fine.error / coarse.error);
    return {EqualErrorKind::Interpolated, coarse.*cost * std::pow(fine.*cost / coarse.*cost, part)};
  }
  if (!isMonteCarlo) return {};
  const double shortfall = front.back().error / wanted;
  return {EqualErrorKind::Extrapolated, front.back().*cost * shortfall * shortfall};
}

}  // namespace

double BenchRow::*ErrorThatCounts(const std::vector<BenchRow>& rows, const std::string& scene) {
  constexpr double kLeastError = 0.05, kWidest = 0.3;
  std::vector<BenchRow> widths;
  for (const bool bakeAlone : {true, false}) {
    for (const BenchRow& row : rows) {
      if (row.scene != scene || !(row.rms >= kLeastError)) continue;
      if (bakeAlone && (row.study != "sweep" || row.method != "reference")) continue;
      widths.emplace_back();
      widths.back().rms = (row.rmsHigh - row.rmsLow) / row.rms;
    }
    if (!widths.empty()) break;
  }
  return Median(widths, &BenchRow::rms) > kWidest ? &BenchRow::bounded : &BenchRow::rms;
}

std::string ErrorName(const std::vector<BenchRow>& rows, const std::string& scene) {
  return ErrorThatCounts(rows, scene) == &BenchRow::rms ? "relative RMS error" : "bounded error";
}

std::vector<std::string> ScenesOf(const std::vector<BenchRow>& rows, const std::string& study) {
  std::vector<std::string> names;
  for (const BenchRow& row : rows) {
    if (row.study == study) AddOnce(row.scene, &names);
  }
  return names;
}

std::vector<std::string> MethodsOf(const std::vector<BenchRow>& rows, const std::string& scene) {
  std::vector<std::string> names;
  for (const BenchRow& row : rows) {
    if (row.study == "sweep" && row.scene == scene) AddOnce(row.method, &names);
  }
  return names;
}

std::vector<BenchPoint> SweepCurve(const std::vector<BenchRow>& rows, const std::string& scene,
                                   const std::string& method) {
  std::vector<BenchPoint> curve = MediansByValue(rows, scene, [&](const BenchRow& row) {
    return row.study == "sweep" && row.method == method;
  });
  if (!IsFinerUpward(FindBenchMethod(method).knob)) std::reverse(curve.begin(), curve.end());
  return curve;
}

EqualError SecondsAtError(const std::vector<BenchPoint>& curve, double wanted, bool isMonteCarlo) {
  return CostAtError(curve, &BenchPoint::seconds, wanted, isMonteCarlo);
}

EqualError ElementsAtError(const std::vector<BenchPoint>& curve, double wanted) {
  return CostAtError(curve, &BenchPoint::elements, wanted, false);
}

double Median(const std::vector<BenchRow>& rows, double BenchRow::*number) {
  std::vector<double> values;
  for (const BenchRow& row : rows) {
    if (!std::isnan(row.*number)) values.push_back(row.*number);
  }
  if (values.empty()) return BenchRow::kUnknown;
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::vector<BenchPoint> ConvergenceCurve(const std::vector<BenchRow>& rows,
                                         const std::string& scene) {
  return MediansByValue(rows, scene,
                        [&](const BenchRow& row) { return row.study == "convergence"; });
}

std::vector<std::vector<BenchRow>> TessellationGroups(const std::vector<BenchRow>& rows) {
  std::map<double, std::vector<BenchRow>> byTriangles;
  for (const BenchRow& row : rows) {
    if (row.study == "tessellation") byTriangles[row.triangles].push_back(row);
  }
  std::vector<std::vector<BenchRow>> groups;
  for (const auto& [triangles, group] : byTriangles) groups.push_back(group);
  return groups;
}

}  // namespace lambert
