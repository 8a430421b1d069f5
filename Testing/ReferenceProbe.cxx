// Path-traced irradiance at one point: lambertReferenceProbe SCENE PATHS x y z nx ny nz. Prints the
// irradiance and its standard error, W/m2 in three bands; the numbers of the baselines come from
// it.
#include "Reference/Core/PathTracedIrradiance.h"
#include "Scene/vtkSceneLoader.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 9) {
    std::fprintf(stderr, "Usage: lambertReferenceProbe SCENE PATHS x y z nx ny nz\n");
    return 2;
  }
  try {
    const lambert::Scene scene = lambert::LoadScene({argv[1]});
    float numbers[6];
    for (int i = 0; i < 6; ++i) numbers[i] = std::strtof(argv[3 + i], nullptr);
    const lambert::Vec3f position(numbers[0], numbers[1], numbers[2]);
    const lambert::Vec3f normal(numbers[3], numbers[4], numbers[5]);
    lambert::PathTracedIrradianceOptions options;
    options.samples = std::atoi(argv[2]);
    const auto at =
        lambert::PathTracedIrradiance(scene).Estimate({{position, normal, normal}}, options).at(0);
    std::printf("%.6g %.6g %.6g\n%.2g %.2g %.2g\n", at.irradiance.r, at.irradiance.g,
                at.irradiance.b, at.standardError.r, at.standardError.g, at.standardError.b);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lambertReferenceProbe: %s\n", error.what());
    return 1;
  }
  return 0;
}
