#include "BenchChart.h"

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGExporter.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "Common/Core/OutputFile.h"
#include "Display/PictureFile.h"

namespace lambert {
namespace {

// Layout in pixels of the picture.
constexpr int kWidth = 800, kHeight = 560;
constexpr int kSupersampling = 2;
constexpr int kTopMargin = 78, kRightMargin = 132, kBottomMargin = 10;
constexpr int kTitleSize = 18, kSubtitleSize = 13, kAxisSize = 13, kTickSize = 13, kLabelSize = 14;
constexpr double kLabelGap = 9, kLabelHeight = 18;
constexpr float kLineWidth = 2.5f, kMarkerSize = 7;

/// Room beyond the outermost points, of the axis.
constexpr double kPadding = 0.04;
/// Decades that an axis shows at least.
constexpr double kLeastSpan = 0.4;

/// Range and ticks of a logarithmic axis; positions are decimal logarithms.
struct LogAxis {
  double low = 0, high = 1;
  std::vector<std::pair<double, std::string>> ticks;
};

std::string TickLabel(double value, ChartUnit unit) {
  char text[32];
  if (unit == ChartUnit::Percent) {
    std::snprintf(text, sizeof text, "%g %%", 100 * value);
  } else if (unit == ChartUnit::Count && value >= 1e6) {
    std::snprintf(text, sizeof text, "%g M", value / 1e6);
  } else if (unit == ChartUnit::Count && value >= 1e3) {
    std::snprintf(text, sizeof text, "%g k", value / 1e3);
  } else {
    std::snprintf(text, sizeof text, "%g", value);
  }
  return text;
}

LogAxis MakeAxis(double least, double most, ChartUnit unit) {
  LogAxis axis;
  const double span = std::log10(most / least);
  const double padding = std::max(kPadding * span, (kLeastSpan - span) / 2);
  axis.low = std::log10(least) - padding;
  axis.high = std::log10(most) + padding;
  // Many steps on short axes; 1, 2, 5; 1, 3 on longer ones; powers of ten on the longest.
  const double decades = axis.high - axis.low;
  const std::vector<double> steps = decades < 1     ? std::vector<double>{1, 1.5, 2, 3, 4, 5, 7}
                                    : decades < 2.6 ? std::vector<double>{1, 2, 5}
                                    : decades < 4.2 ? std::vector<double>{1, 3}
                                                    : std::vector<double>{1};
  for (int power = int(std::floor(axis.low)); power <= int(axis.high) + 1; ++power) {
    for (const double step : steps) {
      const double value = step * std::pow(10.0, power), position = std::log10(value);
      if (position < axis.low || position > axis.high) continue;
      axis.ticks.emplace_back(position, TickLabel(value, unit));
    }
  }
  return axis;
}

bool IsDrawn(const Vec2d& point) {
  return point.x > 0 && point.y > 0 && std::isfinite(point.x) && std::isfinite(point.y);
}

/// The points of a curve that can be drawn, as logarithms.
std::vector<Vec2d> LogPoints(const ChartCurve& curve) {
  std::vector<Vec2d> points;
  for (const Vec2d& p : curve.points) {
    if (IsDrawn(p)) points.push_back({std::log10(p.x), std::log10(p.y)});
  }
  return points;
}

void SetUpAxis(vtkAxis* axis, const LogAxis& range, const ChartAxis& about, int scale) {
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const auto& [position, label] : range.ticks) {
    positions->InsertNextValue(position);
    labels->InsertNextValue(label);
  }
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(range.low, range.high);
  axis->SetCustomTickPositions(positions, labels);
  axis->SetTitle(about.title);
  axis->GetTitleProperties()->SetFontSize(kAxisSize * scale);
  axis->GetTitleProperties()->SetBold(0);
  axis->GetTitleProperties()->SetColor(0.25, 0.25, 0.25);
  axis->GetLabelProperties()->SetFontSize(kTickSize * scale);
  axis->GetLabelProperties()->SetColor(0.25, 0.25, 0.25);
  axis->GetGridPen()->SetColor(228, 228, 228);
  axis->GetGridPen()->SetWidth(float(scale));
  axis->GetPen()->SetColor(150, 150, 150);
  axis->GetPen()->SetWidth(float(scale));
}

/// A rectangle of the picture, pixels.
struct Area {
  Vec2d low, high;

  bool Overlaps(const Area& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
           other.low.y < high.y;
  }
  bool Contains(const Vec2d& p) const {
    return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y;
  }
};

/// Pixels of a polyline within an area.
double LengthWithin(const std::vector<Vec2d>& line, const Area& area) {
  constexpr double kStep = 2;
  double length = 0;
  for (size_t i = 1; i < line.size(); ++i) {
    const Vec2d way = line[i] - line[i - 1];
    const int steps = std::max(1, int(std::hypot(way.x, way.y) / kStep));
    for (int step = 0; step <= steps; ++step) {
      if (area.Contains(line[i - 1] + way * (double(step) / steps))) length += kStep;
    }
  }
  return length;
}

}  // namespace

/// The words of a chart: its message above it, the name of each curve at its end.
class ChartWords : public vtkContextItem {
 public:
  static ChartWords* New();
  vtkTypeMacro(ChartWords, vtkContextItem);

  void Describe(const LineChart* about, vtkChartXY* chart, int scale) {
    about_ = about, chart_ = chart, scale_ = scale;
  }

  bool Paint(vtkContext2D* painter) override {
    PaintHeading(painter);
    PaintLabels(painter);
    return true;
  }

 private:
  void SetText(vtkContext2D* painter, int size, bool bold, const ChartColor& color) const {
    vtkTextProperty* text = painter->GetTextProp();
    text->SetFontFamilyToArial();
    text->SetFontSize(size * scale_);
    text->SetBold(bold);
    text->SetItalic(0);
    text->SetOrientation(0);
    text->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
    text->SetJustificationToLeft();
    text->SetVerticalJustificationToCentered();
  }

  void PaintHeading(vtkContext2D* painter) const {
    const float left = 14.f * float(scale_), top = float(kHeight * scale_);
    int size = kTitleSize;
    for (float bounds[4] = {}; size > kSubtitleSize; --size) {
      SetText(painter, size, true, {20, 20, 20});
      painter->ComputeStringBounds(about_->title, bounds);
      if (bounds[2] <= float(kWidth * scale_) - 2 * left) break;
    }
    painter->DrawString(left, top - 22.f * float(scale_), about_->title);
    SetText(painter, kSubtitleSize, false, {90, 90, 90});
    float height = 46;
    for (const std::string& line : about_->subtitle) {
      painter->DrawString(left, top - height * float(scale_), line);
      height += 18;
    }
  }

  /// Pixel of a point given by its logarithms.
  Vec2d ToPixel(const Vec2d& p) const {
    const vtkAxis* x = chart_->GetAxis(vtkAxis::BOTTOM);
    const vtkAxis* y = chart_->GetAxis(vtkAxis::LEFT);
    const auto along = [](const vtkAxis* axis, double value, double from, double to) {
      auto* a = const_cast<vtkAxis*>(axis);
      return from + (to - from) * (value - a->GetMinimum()) / (a->GetMaximum() - a->GetMinimum());
    };
    const int *low = chart_->GetPoint1(), *high = chart_->GetPoint2();
    return {along(x, p.x, low[0], high[0]), along(y, p.y, low[1], high[1])};
  }

  /// The names beside the ends of their curves, where they cross the least.
  void PaintLabels(vtkContext2D* painter) const {
    std::vector<std::vector<Vec2d>> lines;
    for (const ChartCurve& curve : about_->curves) {
      lines.emplace_back();
      for (const Vec2d& p : LogPoints(curve)) lines.back().push_back(ToPixel(p));
    }
    std::vector<Area> taken;
    for (size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].empty()) continue;
      const ChartCurve& curve = about_->curves[i];
      SetText(painter, kLabelSize, true, curve.color);
      float bounds[4] = {};
      painter->ComputeStringBounds(curve.label, bounds);
      taken.push_back(BestPlace(lines, taken, lines[i].back(), bounds[2]));
      painter->DrawString(float(taken.back().low.x),
                          float(taken.back().low.y + taken.back().high.y) / 2, curve.label);
    }
  }

  /// Of the places about the end of a curve that with the least in it; right of it by preference.
  Area BestPlace(const std::vector<std::vector<Vec2d>>& lines, const std::vector<Area>& taken,
                 const Vec2d& end, double width) const {
    constexpr double kOverlapCost = 1000, kPixelCost = 5;
    const double height = kLabelHeight * scale_, gap = kLabelGap * scale_;
    Area best{};
    double leastCost = std::numeric_limits<double>::max();
    for (const double shift : {0.0, -0.5, 0.5, -1.0, 1.0, -1.6, 1.6, -2.5, 2.5, -3.5, 3.5}) {
      for (const double left : {gap, -width / 2, -width - gap}) {
        const Vec2d low{end.x + left, end.y + (shift - 0.5) * height};
        const Area place{low, low + Vec2d(width, height)};
        double cost = std::abs(shift) * 20 + (left < 0 ? 12 : 0);
        for (const Area& other : taken) cost += place.Overlaps(other) ? kOverlapCost : 0;
        for (const auto& line : lines) cost += kPixelCost * LengthWithin(line, place) / scale_;
        if (place.high.x > kWidth * scale_ || place.low.x < 0) cost += kOverlapCost;
        if (place.low.y < chart_->GetPoint1()[1]) cost += kOverlapCost;
        if (cost < leastCost) leastCost = cost, best = place;
      }
    }
    return best;
  }

  const LineChart* about_ = nullptr;
  vtkChartXY* chart_ = nullptr;
  int scale_ = 1;
};
vtkStandardNewMacro(ChartWords);

namespace {

/// Takes the clipping out of an SVG: the exporter mirrors the rectangles, and no curve leaves its
/// axes. False where not all of it could be written.
bool RemoveClipping(const std::string& name) {
  std::ifstream in(name);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::string begin = " clip-path=\"";
  for (size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    text.erase(at, text.find('"', at + begin.size()) + 1 - at);
  }
  std::ofstream out(name);
  out << text;
  return out.flush() && !text.empty();
}

/// A chart in a window of its own, `scale` times as large as the picture.
class ChartWindow {
 public:
  ChartWindow(const LineChart& about, int scale) : scale_(scale) {
    SetUpAxes(about);
    for (const ChartCurve& curve : about.curves) AddCurve(curve);
    chart_->SetAutoSize(false);
    chart_->SetSize(vtkRectf(0, float(kBottomMargin * scale),
                             float((kWidth - kRightMargin) * scale),
                             float((kHeight - kTopMargin - kBottomMargin) * scale)));
    view_->GetScene()->AddItem(chart_);
    words_->Describe(&about, chart_, scale);
    view_->GetScene()->AddItem(words_);
    view_->GetRenderer()->SetBackground(1, 1, 1);
    vtkRenderWindow* window = view_->GetRenderWindow();
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(kWidth * scale, kHeight * scale);
    window->Render();
  }

  void WritePng(const std::string& name) {
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(view_->GetRenderWindow());
    grab->ReadFrontBufferOff();
    vtkNew<vtkImageShrink3D> average;
    average->SetInputConnection(grab->GetOutputPort());
    average->SetShrinkFactors(scale_, scale_, 1);
    average->AveragingOn();
    average->Update();
    WritePicture(average->GetOutput(), name);
  }

  void WriteSvg(const std::string& name, const std::string& title) {
    WriteOutput(name, [&](const std::string& place) {
      vtkNew<vtkSVGExporter> exporter;
      exporter->SetRenderWindow(view_->GetRenderWindow());
      exporter->SetTitle(title.c_str());
      exporter->SetFileName(place.c_str());
      exporter->Write();
      return RemoveClipping(place);
    });
  }

 private:
  void SetUpAxes(const LineChart& about) {
    Vec2d least{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()}, most;
    for (const ChartCurve& curve : about.curves) {
      for (const Vec2d& p : curve.points) {
        if (!IsDrawn(p)) continue;
        least = {std::min(least.x, p.x), std::min(least.y, p.y)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y)};
      }
    }
    SetUpAxis(chart_->GetAxis(vtkAxis::BOTTOM), MakeAxis(least.x, most.x, about.x.unit), about.x,
              scale_);
    SetUpAxis(chart_->GetAxis(vtkAxis::LEFT), MakeAxis(least.y, most.y, about.y.unit), about.y,
              scale_);
  }

  void AddCurve(const ChartCurve& curve) {
    const std::vector<Vec2d> points = LogPoints(curve);
    if (points.empty()) return;
    vtkNew<vtkDoubleArray> x, y;
    x->SetName("x");
    y->SetName("y");
    for (const Vec2d& p : points) {
      x->InsertNextValue(p.x);
      y->InsertNextValue(p.y);
    }
    // A line needs two points.
    if (points.size() == 1) {
      x->InsertNextValue(points[0].x);
      y->InsertNextValue(points[0].y);
    }
    vtkNew<vtkTable> table;
    table->AddColumn(x);
    table->AddColumn(y);
    auto* line = vtkPlotLine::SafeDownCast(chart_->AddPlot(vtkChart::LINE));
    line->SetInputData(table, 0, 1);
    line->SetColor(curve.color[0], curve.color[1], curve.color[2], 255);
    line->SetWidth(kLineWidth * float(scale_));
    line->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    line->SetMarkerSize(kMarkerSize * float(scale_));
  }

  int scale_;
  vtkNew<vtkContextView> view_;
  vtkNew<vtkChartXY> chart_;
  vtkNew<ChartWords> words_;
};

}  // namespace

bool WriteLineChart(const LineChart& chart, const std::string& name) {
  const bool hasPoints = std::any_of(
      chart.curves.begin(), chart.curves.end(),
      [](const ChartCurve& c) { return std::any_of(c.points.begin(), c.points.end(), IsDrawn); });
  if (!hasPoints) return false;
  ChartWindow(chart, kSupersampling).WritePng(name + ".png");
  ChartWindow(chart, 1).WriteSvg(name + ".svg", chart.title);
  return true;
}

}  // namespace lambert
