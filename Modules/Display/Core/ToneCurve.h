// How keyed luminance becomes the luminance of a display.
#pragma once

#include "Common/Core/Spectrum.h"

namespace lambert {

enum class ToneCurve {
  Photographic,  ///< L (1 + L / white^2) / (1 + L) (reinhard2002 eq. 4); bands keep their ratios
  Linear,        ///< L as it is; a band over 1 clips
  Filmic         ///< toe and shoulder of film (hable2010), by band: what is bright loses its colour
};

/// Keyed luminance that reaches full white where none is wanted: of film the 11.2 of hable2010,
/// whose curve is given twice the light.
constexpr double kFilmicWhite = 11.2 / 2;

/// Display luminance, 1 at full white, of keyed luminance `value` of 0 or more. `white` above 0 is
/// the keyed luminance that reaches 1; Linear has no use for it.
double EvaluateToneCurve(ToneCurve curve, double value, double white);

/// The photographic curve where the eye adapts to `surround`, keyed luminance about the place, and
/// not to the place itself (reinhard2002 eq. 9, with the white of eq. 4).
double PhotographicCurve(double value, double surround, double white);

}  // namespace lambert
