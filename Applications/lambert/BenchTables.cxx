#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "BenchMethods.h"
#include "BenchReport.h"
#include "BenchSummary.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

constexpr const char* kBake = "reference";
constexpr double kShownAfter[] = {1, 2, 5, 10, 20};

std::string Format(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Seconds or other positive numbers, three digits.
std::string Number(double value) {
  if (std::isnan(value)) return "-";
  if (value >= 1e6) return Format("%.3g", value / 1e6) + " M";
  if (value >= 1e3) return Format("%.3g", value / 1e3) + " k";
  return Format("%.3g", value);
}

std::string Percent(double fraction) { return Format("%.3g %%", 100 * fraction); }

std::string Label(const std::string& method) { return FindBenchMethod(method).label; }

const char* Mark(EqualErrorKind kind) {
  return kind == EqualErrorKind::AtMost ? "<= " : kind == EqualErrorKind::Extrapolated ? "~ " : "";
}

const char* KindName(EqualErrorKind kind) {
  switch (kind) {
    case EqualErrorKind::Interpolated:
      return "interpolated";
    case EqualErrorKind::AtMost:
      return "at most";
    case EqualErrorKind::Extrapolated:
      return "extrapolated";
    case EqualErrorKind::Unreached:
      break;
  }
  return "not reached";
}

/// One method on one scene at each of kEqualErrors.
struct MethodAtErrors {
  std::string method;
  std::vector<EqualError> seconds, bake, elements;

  /// Times as fast as the bake; unknown where either is.
  double Speed(size_t error) const { return bake[error].cost / seconds[error].cost; }
};

std::vector<MethodAtErrors> AtErrors(const std::vector<BenchRow>& rows, const std::string& scene) {
  const std::vector<BenchPoint> bake = SweepCurve(rows, scene, kBake);
  std::vector<MethodAtErrors> all;
  for (const std::string& name : MethodsOf(rows, scene)) {
    const std::vector<BenchPoint> curve = SweepCurve(rows, scene, name);
    MethodAtErrors at{name, {}, {}, {}};
    for (const double error : kEqualErrors) {
      at.seconds.push_back(SecondsAtError(curve, error, name == kBake));
      at.bake.push_back(SecondsAtError(bake, error, true));
      at.elements.push_back(ElementsAtError(curve, error));
    }
    all.push_back(at);
  }
  return all;
}

void WriteEqualErrorCsv(const std::vector<BenchRow>& rows, std::ostream& out) {
  out << "scene,method,measure,error,seconds,how,times_as_fast_as_bake,bake_how,elements,elements_"
         "how\n";
  const auto field = [](double value) { return std::isnan(value) ? "" : Format("%.4g", value); };
  for (const std::string& scene : ScenesOf(rows, "sweep")) {
    for (const MethodAtErrors& at : AtErrors(rows, scene)) {
      for (size_t i = 0; i < at.seconds.size(); ++i) {
        out << scene << ',' << at.method << ',' << ErrorName(rows, scene) << ',' << kEqualErrors[i]
            << ',' << field(at.seconds[i].cost) << ',' << KindName(at.seconds[i].kind) << ','
            << field(at.Speed(i)) << ',' << KindName(at.bake[i].kind) << ','
            << field(at.elements[i].cost) << ',' << KindName(at.elements[i].kind) << '\n';
      }
    }
  }
}

/// Header of a table whose columns are the errors.
void WriteErrorHeader(const char* first, std::ostream& out) {
  out << "| " << first << " |";
  for (const double error : kEqualErrors) out << ' ' << Percent(error) << " |";
  out << "\n|---|";
  for (size_t i = 0; i < std::size(kEqualErrors); ++i) out << "---|";
  out << '\n';
}

void WriteScene(const std::vector<BenchRow>& rows, const std::string& scene, std::ostream& out) {
  const std::vector<MethodAtErrors> all = AtErrors(rows, scene);
  out << "\n## " << scene << "\n\nSeconds at equal " << ErrorName(rows, scene)
      << " (times as fast as the path-traced bake):\n\n";
  WriteErrorHeader("method", out);
  for (const MethodAtErrors& at : all) {
    out << "| " << Label(at.method) << " |";
    for (size_t i = 0; i < at.seconds.size(); ++i) {
      const EqualError& seconds = at.seconds[i];
      if (!seconds.IsReached()) {
        out << " not reached |";
        continue;
      }
      out << ' ' << Mark(seconds.kind) << Number(seconds.cost) << " s";
      if (at.method != kBake && at.bake[i].IsReached()) {
        out << " (" << Number(at.Speed(i)) << "x)";
      }
      out << " |";
    }
    out << '\n';
  }

  out << "\nElements at the same:\n\n";
  WriteErrorHeader("method", out);
  for (const MethodAtErrors& at : all) {
    if (!FindBenchMethod(at.method).hasElements) continue;
    out << "| " << Label(at.method) << " |";
    for (const EqualError& elements : at.elements) {
      out << ' '
          << (elements.IsReached() ? Mark(elements.kind) + Number(elements.cost) : "not reached")
          << " |";
    }
    out << '\n';
  }
}

void WriteConvergence(const std::vector<BenchRow>& rows, std::ostream& out) {
  const std::vector<std::string> scenes = ScenesOf(rows, "convergence");
  if (scenes.empty()) return;
  out << "\n## Error of what is shown\n\n| scene |";
  for (const double seconds : kShownAfter) out << ' ' << seconds << " s |";
  out << " first shown |\n|---|---|";
  for (size_t i = 0; i < std::size(kShownAfter); ++i) out << "---|";
  out << '\n';
  for (const std::string& scene : scenes) {
    const std::vector<BenchPoint> curve = ConvergenceCurve(rows, scene);
    out << "| " << scene << " |";
    for (const double seconds : kShownAfter) {
      const BenchPoint* shown = nullptr;
      for (const BenchPoint& point : curve) {
        if (point.seconds <= seconds) shown = &point;
      }
      out << ' ' << (shown ? Percent(shown->error) : "nothing") << " |";
    }
    out << ' ' << Number(curve.front().seconds) << " s, " << Percent(curve.front().error) << " |\n";
  }
}

void WriteTessellation(const std::vector<BenchRow>& rows, std::ostream& out) {
  const auto groups = TessellationGroups(rows);
  if (groups.empty()) return;
  out << "\n## One shape, ever finer\n\n"
         "| triangles | clustering s | setup s | of which BVH s | iterations s | reconstruction s "
         "| "
         "output s | all but output s | elements | links | peak MB | error |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& group : groups) {
    out << "| " << Number(group.front().triangles) << " |";
    for (double BenchRow::*number :
         {&BenchRow::clustering, &BenchRow::setup, &BenchRow::bvh, &BenchRow::iterations,
          &BenchRow::reconstruction, &BenchRow::output, &BenchRow::seconds, &BenchRow::elements,
          &BenchRow::links, &BenchRow::peakMegabytes}) {
      out << ' ' << Number(Median(group, number)) << " |";
    }
    out << ' ' << Percent(Median(group, &BenchRow::rms)) << " |\n";
  }
  const auto ratio = [&](double BenchRow::*number) {
    return Number(Median(groups.back(), number) / Median(groups.front(), number));
  };
  out << "\nFrom " << Number(groups.front().front().triangles) << " to "
      << Number(groups.back().front().triangles) << " triangles: iterations take "
      << ratio(&BenchRow::iterations) << " times as long, elements are "
      << ratio(&BenchRow::elements) << " times as many, links " << ratio(&BenchRow::links)
      << " times.\n";
}

std::ofstream Open(const std::string& name) {
  std::ofstream file(name);
  if (!file) throw Error("The table " + name + " could not be written.");
  return file;
}

}  // namespace

void WriteBenchTables(const std::vector<BenchRow>& rows, const std::string& folder) {
  std::ofstream csv = Open(folder + "/EqualError.csv");
  WriteEqualErrorCsv(rows, csv);
  std::ofstream tables = Open(folder + "/Tables.md");
  tables << "# Measurements\n\nMedians over runs. `<=`: the cheapest run is better already. `~`: "
            "extrapolated by the law of Monte Carlo.\n";
  for (const std::string& scene : ScenesOf(rows, "sweep")) WriteScene(rows, scene, tables);
  WriteTessellation(rows, tables);
  WriteConvergence(rows, tables);
  if (!csv.flush() || !tables.flush()) {
    throw Error("The tables in " + folder + " could not be written.");
  }
}

}  // namespace lambert
