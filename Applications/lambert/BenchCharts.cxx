#include <cmath>
#include <cstdio>
#include <map>

#include "BenchChart.h"
#include "BenchMethods.h"
#include "BenchReport.h"
#include "BenchSummary.h"

namespace lambert {
namespace {

constexpr const char *kHierarchical = "hierarchical", *kBake = "reference";
/// The error of the messages.
constexpr double kMessageError = 0.05;

std::string Format(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// A count with commas at the thousands.
std::string Count(double value) {
  std::string digits = Format("%.0f", value);
  for (int64_t at = int64_t(digits.size()) - 3; at > 0; at -= 3) digits.insert(size_t(at), ",");
  return digits;
}

ChartColor ColorOf(const std::string& method) {
  static const std::map<std::string, ChartColor> colors{{kHierarchical, chart_colors::kBlue},
                                                        {kBake, chart_colors::kGrey},
                                                        {"cached", chart_colors::kOrange},
                                                        {"matrix", chart_colors::kGreen},
                                                        {"progressive", chart_colors::kPurple}};
  const auto found = colors.find(method);
  return found == colors.end() ? chart_colors::kYellow : found->second;
}

std::vector<BenchRow> RowsOf(const std::vector<BenchRow>& rows, const std::string& study,
                             const std::string& scene) {
  std::vector<BenchRow> some;
  for (const BenchRow& row : rows) {
    if (row.study == study && row.scene == scene) some.push_back(row);
  }
  return some;
}

/// What the scene is and how it was measured.
std::string Circumstances(const std::vector<BenchRow>& rows) {
  const BenchRow& row = rows.front();
  double runs = 1;
  for (const BenchRow& r : rows) runs = std::fmax(runs, r.run);
  std::string text = Count(row.triangles) + " triangles";
  if (!std::isnan(row.coarseTriangles)) text += " tessellated from " + Count(row.coarseTriangles);
  text += ", " + Count(row.vertices) + " vertices; error at " +
          Count(Median(rows, &BenchRow::receivers)) + " of them; ";
  text += Format("%.0f", row.threads) + " threads, ";
  return text + (runs > 1 ? "median of " + Format("%.0f", runs) + " runs" : "one run");
}

/// A ratio in words: "7.2 times as fast as" or, below one, "1.8 times as slow as".
std::string Times(double ratio, const char* more, const char* less) {
  const double factor = ratio >= 1 ? ratio : 1 / ratio;
  return Format(factor < 10 ? "%.1f" : "%.0f", factor) + " times as " + (ratio >= 1 ? more : less);
}

/// The error of the message, and how it is said: 5 %, or the best of a curve that is not that good.
std::pair<double, std::string> MessageError(const std::vector<BenchPoint>& curve) {
  double best = 1e300;
  for (const BenchPoint& point : curve) best = std::fmin(best, point.error);
  if (best <= kMessageError) return {kMessageError, "at 5 % error, hierarchical"};
  return {best, "at " + Format("%.2g", 100 * best) + " % error, its best here, hierarchical"};
}

std::string SpeedMessage(const std::vector<BenchRow>& rows, const std::string& scene) {
  const std::vector<BenchPoint> curve = SweepCurve(rows, scene, kHierarchical);
  const auto [error, words] = MessageError(curve);
  const EqualError own = SecondsAtError(curve, error, false);
  const EqualError bake = SecondsAtError(SweepCurve(rows, scene, kBake), error, true);
  if (!own.IsReached() || !bake.IsReached()) return scene + ": error against time";
  return scene + ": " + words + " is " +
         Times(bake.cost / own.cost, "fast as the bake", "slow as the bake");
}

/// The speeds at each error, short.
std::string SpeedLine(const std::vector<BenchRow>& rows, const std::string& scene) {
  const std::vector<BenchPoint> curve = SweepCurve(rows, scene, kHierarchical);
  const std::vector<BenchPoint> bake = SweepCurve(rows, scene, kBake);
  std::string line = "hierarchical against the path-traced bake:";
  for (const double error : kEqualErrors) {
    const EqualError own = SecondsAtError(curve, error, false);
    const EqualError other = SecondsAtError(bake, error, true);
    line += Format("   %.0f %%: ", 100 * error);
    line += own.IsReached() && other.IsReached() ? Format("%.2gx", other.cost / own.cost)
                                                 : "not reached";
  }
  return line;
}

void DrawErrorAgainstTime(const std::vector<BenchRow>& rows, const std::string& scene,
                          const std::string& folder) {
  LineChart chart;
  chart.title = SpeedMessage(rows, scene);
  chart.subtitle = {SpeedLine(rows, scene), Circumstances(RowsOf(rows, "sweep", scene))};
  chart.x = {"seconds from the loaded mesh to the light at its vertices", ChartUnit::Seconds};
  chart.y = {ErrorName(rows, scene) + " of irradiance", ChartUnit::Percent};
  for (const std::string& method : MethodsOf(rows, scene)) {
    ChartCurve curve{FindBenchMethod(method).label, ColorOf(method), {}};
    for (const BenchPoint& p : SweepCurve(rows, scene, method)) {
      curve.points.push_back({p.seconds, p.error});
    }
    chart.curves.push_back(curve);
  }
  WriteLineChart(chart, folder + "/ErrorAgainstTime-" + scene);
}

/// Compares elements at equal error with the best method on a uniform mesh.
std::string ElementsMessage(const std::vector<BenchRow>& rows, const std::string& scene) {
  const std::vector<BenchPoint> curve = SweepCurve(rows, scene, kHierarchical);
  const auto [error, words] = MessageError(curve);
  const EqualError own = ElementsAtError(curve, error);
  EqualError uniform;
  for (const std::string& method : MethodsOf(rows, scene)) {
    if (FindBenchMethod(method).knob != std::string("size")) continue;
    const EqualError its = ElementsAtError(SweepCurve(rows, scene, method), error);
    if (its.IsReached() && !(uniform.cost <= its.cost)) uniform = its;
  }
  if (!own.IsReached()) return scene + ": error against elements";
  if (!uniform.IsReached()) {
    return scene + ": no uniform mesh that fits gets to " + Format("%.2g", 100 * error) +
           " % error";
  }
  return scene + ": " + words + " has " +
         Times(uniform.cost / own.cost, "few elements as uniform", "many elements as uniform");
}

void DrawErrorAgainstElements(const std::vector<BenchRow>& rows, const std::string& scene,
                              const std::string& folder) {
  LineChart chart;
  bool hasUniform = false;  // None fits where the scene itself has too many triangles.
  chart.title = ElementsMessage(rows, scene);
  chart.subtitle = {"hierarchical: volumes, clusters and patches; uniform: triangles of one size",
                    Circumstances(RowsOf(rows, "sweep", scene))};
  chart.x = {"elements", ChartUnit::Count};
  chart.y = {ErrorName(rows, scene) + " of irradiance", ChartUnit::Percent};
  for (const std::string& method : MethodsOf(rows, scene)) {
    const BenchMethod& about = FindBenchMethod(method);
    const bool isUniform = about.knob == std::string("size");
    if (method != kHierarchical && !isUniform) continue;
    ChartCurve curve{
        isUniform ? std::string(about.label) + " (uniform)" : about.label, ColorOf(method), {}};
    for (const BenchPoint& p : SweepCurve(rows, scene, method)) {
      curve.points.push_back({p.elements, p.error});
    }
    hasUniform = hasUniform || (isUniform && !curve.points.empty());
    chart.curves.push_back(curve);
  }
  if (hasUniform) WriteLineChart(chart, folder + "/ErrorAgainstElements-" + scene);
}

void DrawTimeAgainstTriangles(const std::vector<BenchRow>& rows, const std::string& folder) {
  const auto groups = TessellationGroups(rows);
  if (groups.empty()) return;
  const auto ratio = [&](double BenchRow::*number) {
    return Median(groups.back(), number) / Median(groups.front(), number);
  };
  double least = 1, most = 0;
  for (const auto& group : groups) {
    least = std::fmin(least, Median(group, &BenchRow::rms));
    most = std::fmax(most, Median(group, &BenchRow::rms));
  }
  LineChart chart;
  chart.title = Format("%.0f", ratio(&BenchRow::triangles)) +
                " times the triangles: iterations take " +
                Format("%.2g", ratio(&BenchRow::iterations)) + " times as long";
  chart.subtitle = {
      "a knot in a room, ever finer; elements " + Format("%.2f", ratio(&BenchRow::elements)) +
          " times, links " + Format("%.2f", ratio(&BenchRow::links)) + " times as many",
      "measured error " + Format("%.1f", 100 * least) + Format(" to %.1f %%; ", 100 * most) +
          Format("%.0f threads", groups.front().front().threads)};
  chart.x = {"triangles", ChartUnit::Count};
  chart.y = {"seconds", ChartUnit::Seconds};
  const struct {
    const char* label;
    ChartColor color;
    double BenchRow::*seconds;
  } stages[] = {{"iterations", chart_colors::kBlue, &BenchRow::iterations},
                {"reconstruction", chart_colors::kOrange, &BenchRow::reconstruction},
                {"clustering", chart_colors::kGreen, &BenchRow::clustering},
                {"BVH", chart_colors::kGrey, &BenchRow::bvh},
                {"output (.vtp)", chart_colors::kPurple, &BenchRow::output}};
  for (const auto& stage : stages) {
    ChartCurve curve{stage.label, stage.color, {}};
    for (const auto& group : groups) {
      curve.points.push_back({Median(group, &BenchRow::triangles), Median(group, stage.seconds)});
    }
    chart.curves.push_back(curve);
  }
  WriteLineChart(chart, folder + "/TimeAgainstTriangles");
}

void DrawConvergence(const std::vector<BenchRow>& rows, const std::string& folder) {
  constexpr ChartColor kColors[] = {
      chart_colors::kBlue, chart_colors::kOrange, chart_colors::kGreen, chart_colors::kPurple,
      chart_colors::kGrey, chart_colors::kSky,    chart_colors::kYellow};
  const std::vector<std::string> scenes = ScenesOf(rows, "convergence");
  if (scenes.empty()) return;
  LineChart chart;
  double slowest = 0;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const bool isRms = ErrorThatCounts(rows, scenes[i]) == &BenchRow::rms;
    ChartCurve curve{
        isRms ? scenes[i] : scenes[i] + " (bounded)", kColors[i % std::size(kColors)], {}};
    for (const BenchPoint& p : ConvergenceCurve(rows, scenes[i])) {
      curve.points.push_back({p.seconds, p.error});
    }
    const EqualError tenth = SecondsAtError(ConvergenceCurve(rows, scenes[i]), 0.1, false);
    slowest = tenth.IsReached() ? std::fmax(slowest, tenth.cost) : INFINITY;
    chart.curves.push_back(curve);
  }
  const char* all = scenes.size() > 1 ? "every scene" : "the scene";
  chart.title = std::isfinite(slowest) ? std::string("What the user sees: ") + all +
                                             " is within 10 % after " + Format("%.2g s", slowest)
                                       : "What the user sees: the error falls as iterations end";
  chart.subtitle = {
      "intermediate solutions of the hierarchical method, reconstruction of each included; " +
      Format("%.0f threads", RowsOf(rows, "convergence", scenes[0])[0].threads)};
  chart.x = {"seconds from the loaded mesh until it is shown", ChartUnit::Seconds};
  chart.y = {"error of irradiance, relative RMS or bounded", ChartUnit::Percent};
  WriteLineChart(chart, folder + "/Convergence");
}

}  // namespace

void DrawBenchCharts(const std::vector<BenchRow>& rows, const std::string& folder) {
  for (const std::string& scene : ScenesOf(rows, "sweep")) {
    DrawErrorAgainstTime(rows, scene, folder);
    DrawErrorAgainstElements(rows, scene, folder);
  }
  DrawTimeAgainstTriangles(rows, folder);
  DrawConvergence(rows, folder);
}

}  // namespace lambert
