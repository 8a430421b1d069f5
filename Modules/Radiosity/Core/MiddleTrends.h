// How light in the middle of triangles differs, in the mean, from what their corners interpolate:
// told by triangles that are alike and were asked.
#pragma once

#include <array>
#include <map>

namespace lambert {

/// Add all that were asked, then ask for the trend of others.
class MiddleTrends {
 public:
  /// Triangles are alike in an octave of area and of what their corners tell of their error, and in
  /// whether they come from the last cut.
  using Kind = std::array<int, 3>;
  /// `area` in m2; `error` relative and squared.
  static Kind KindOf(double area, double error, bool isNew);

  /// One whose middle has that irradiance, where its corners interpolate `expected`.
  void Add(const Kind& kind, double irradiance, double expected);
  /// By which part the middles of its kind together have more than what is expected, [-1, inf),
  /// drawn to 0 as far as that may be chance.
  double Of(const Kind& kind) const;

 private:
  struct Sum {
    double count = 0, irradiance = 0, expected = 0;
    double irradianceSquares = 0, expectedSquares = 0, products = 0;
  };
  std::map<Kind, Sum> sums_;
};

}  // namespace lambert
