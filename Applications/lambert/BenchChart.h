// A line chart that is read at a glance: one message, logarithmic axes with units, every curve
// named at its end.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "Common/Core/Vector.h"

namespace lambert {

/// How numbers of an axis are written at its ticks.
enum class ChartUnit {
  Seconds,
  Percent,  ///< of fractions
  Count
};

struct ChartAxis {
  std::string title;  ///< the quantity and its unit
  ChartUnit unit = ChartUnit::Count;
};

using ChartColor = std::array<unsigned char, 3>;

struct ChartCurve {
  std::string label;
  ChartColor color;
  std::vector<Vec2d> points;  ///< by ascending x; those that are not above 0 are not drawn
};

struct LineChart {
  std::string title;                  ///< the message, one sentence
  std::vector<std::string> subtitle;  ///< lines below it: figures, circumstances
  ChartAxis x, y;
  std::vector<ChartCurve> curves;
};

/// Draws to `name`.png, 800 x 560 pixels, and `name`.svg; needs a display. Draws nothing and
/// returns false where no curve has a point. Throws Error where a file cannot be written.
bool WriteLineChart(const LineChart& chart, const std::string& name);

/// Colours that the colour-blind tell apart too (Okabe and Ito), each used for one thing in all
/// charts.
namespace chart_colors {
constexpr ChartColor kBlue{0, 114, 178}, kGrey{90, 90, 90}, kOrange{213, 94, 0},
    kGreen{0, 135, 100}, kPurple{170, 80, 140}, kSky{60, 160, 215}, kYellow{190, 140, 0};
}

}  // namespace lambert
