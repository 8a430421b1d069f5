#include "Display/Core/DodgingAndBurning.h"

#include <algorithm>
#include <cmath>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Spectrum.h"

namespace lambert {
namespace {

/// Of reinhard2002, section 3.2.
constexpr int kScales = 8;           ///< surrounds of 1, 1.6, ... 43 pixels
constexpr double kScaleRatio = 1.6;  ///< of a surround to its centre, and of the scales
constexpr double kCentre = 0.35355;  ///< alpha_1 = 1 / (2 sqrt 2)
constexpr double kSharpness = 8;     ///< phi
constexpr double kThreshold = 0.05;  ///< epsilon
/// Rows or columns that a thread takes at a time.
constexpr int kGrain = 16;

/// Weights of exp(-x^2 / (alpha_1 s)^2) from the middle outwards, summing to 1 over both sides.
std::vector<float> Profile(double scale) {
  const double width = kCentre * scale;
  std::vector<float> weights(size_t(std::ceil(3 * width)) + 1);
  double sum = 0;
  for (size_t x = 0; x < weights.size(); ++x) {
    weights[x] = float(std::exp(-double(x) * double(x) / (width * width)));
    sum += (x ? 2 : 1) * weights[x];
  }
  for (float& weight : weights) weight = float(weight / sum);
  return weights;
}

/// Blurs every line along its direction and turns the picture over its diagonal; at the borders the
/// outermost pixel goes on.
std::vector<float> BlurredAndTurned(const std::vector<float>& image, int width, int height,
                                    const std::vector<float>& profile) {
  std::vector<float> turned(image.size());
  ParallelForEach(height, kGrain, [&](int64_t y) {
    const float* row = image.data() + y * width;
    for (int x = 0; x < width; ++x) {
      float sum = profile[0] * row[x];
      for (int k = 1; k < int(profile.size()); ++k) {
        sum += profile[size_t(k)] * (row[std::max(0, x - k)] + row[std::min(width - 1, x + k)]);
      }
      turned[size_t(x) * size_t(height) + size_t(y)] = sum;
    }
  });
  return turned;
}

/// Luminance about every pixel at a scale (reinhard2002 eq. 6).
std::vector<float> Surround(const std::vector<float>& image, int width, int height, double scale) {
  const std::vector<float> profile = Profile(scale);
  return BlurredAndTurned(BlurredAndTurned(image, width, height, profile), height, width, profile);
}

}  // namespace

std::vector<float> AdaptingSurrounds(const std::vector<float>& luminance, int width, int height,
                                     double scale, double key) {
  if (width < 1 || height < 1 || luminance.size() != size_t(width) * size_t(height)) {
    throw Error("Dodging and burning needs a luminance for each pixel of the picture.");
  }

  // From small to large, as long as centre and surround agree (eqs. 7 and 8).
  std::vector<float> chosen = Surround(luminance, width, height, 1), centre = chosen;
  std::vector<char> grows(luminance.size(), 1);
  double size = 1;
  for (int i = 0; i < kScales; ++i, size *= kScaleRatio) {
    const auto surround = Surround(luminance, width, height, size * kScaleRatio);
    const double brightness = std::exp2(kSharpness) * key / (size * size);
    for (size_t pixel = 0; pixel < luminance.size(); ++pixel) {
      const double v1 = scale * centre[pixel], v2 = scale * surround[pixel];
      grows[pixel] = grows[pixel] && std::abs(v1 - v2) < kThreshold * (brightness + v1);
      if (grows[pixel]) chosen[pixel] = centre[pixel];
    }
    centre = surround;
  }
  return chosen;
}

}  // namespace lambert
