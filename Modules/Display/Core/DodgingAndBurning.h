// The local operator of photographers: every place of a picture is exposed for its surround, as far
// as that reaches without crossing an edge (reinhard2002, 3.2).
#pragma once

#include <vector>

namespace lambert {

/// Luminance of the largest surround of each pixel that has no strong contrast in it, in the unit
/// of `luminance`: `width` x `height` pixels, row after row, 0 or more. Surrounds grow by 1.6 from
/// a pixel to 43 pixels (reinhard2002 eqs. 5 to 8, phi 8, epsilon 0.05). `scale` gives keyed
/// luminance, `key` is what it was keyed to. Throws Error where the sizes do not agree.
std::vector<float> AdaptingSurrounds(const std::vector<float>& luminance, int width, int height,
                                     double scale, double key);

}  // namespace lambert
