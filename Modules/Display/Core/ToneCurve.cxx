#include "Display/Core/ToneCurve.h"

namespace lambert {
namespace {

/// Density of film by exposure, before it is scaled to full white (hable2010).
double FilmicResponse(double x) {
  constexpr double kShoulder = 0.15, kLinear = 0.5, kAngle = 0.1;
  constexpr double kToe = 0.2, kToeNumerator = 0.02, kToeDenominator = 0.3;
  return (x * (kShoulder * x + kAngle * kLinear) + kToe * kToeNumerator) /
             (x * (kShoulder * x + kLinear) + kToe * kToeDenominator) -
         kToeNumerator / kToeDenominator;
}

}  // namespace

double PhotographicCurve(double value, double surround, double white) {
  return value * (1 + value / (white * white)) / (1 + surround);
}

double EvaluateToneCurve(ToneCurve curve, double value, double white) {
  switch (curve) {
    case ToneCurve::Linear:
      return value;
    case ToneCurve::Filmic:
      return FilmicResponse(2 * value) / FilmicResponse(2 * white);
    case ToneCurve::Photographic:
      break;
  }
  return PhotographicCurve(value, value, white);
}

}  // namespace lambert
