#include "LightArguments.h"

#include <filesystem>

#include "ArgumentChecks.h"
#include "Scene/Core/Compass.h"
#include "Scene/Core/EnvironmentImage.h"

namespace lambert {
namespace {

double Radians(float degrees) { return double(degrees) * kPi / 180; }

Light NamedLight(LightType type, const std::string& name, const Spectrum& intensity) {
  Light light;
  light.type = type;
  light.name = name;
  light.intensity = intensity;
  return light;
}

}  // namespace

void LightArguments::AddTo(CLI::App* command) {
  CLI::Option* sunOption =
      command
          ->add_option("--sun", sun,
                       "AZIMUTH ELEVATION R G B: degrees from north by east and over the horizon; "
                       "irradiance of a facet that faces it, W/m2")
          ->expected(5)
          ->check(Within(-360, std::numeric_limits<float>::max(), "of -360 or more"));
  command->add_option("--sun-diameter", sunDiameter, "Angle across the sun, degrees")
      ->needs(sunOption)
      ->check(Within(0, 90, "from 0 to 90"))
      ->capture_default_str();
  command->add_option("--sky", sky, "Radiance R G B of a constant sky, W/(m2 sr)")
      ->expected(3)
      ->check(NotNegative());
  CLI::Option* gradientOption =
      command
          ->add_option("--sky-gradient", skyGradient,
                       "Radiances R G B R G B of a sky in the zenith and at the horizon, W/(m2 sr)")
          ->expected(6)
          ->check(NotNegative());
  command->add_option("--ground", ground, "Radiance R G B below the horizon of --sky-gradient")
      ->expected(3)
      ->needs(gradientOption)
      ->check(NotNegative());

  // Surroundings from an image.
  CLI::Option* environmentOption = command->add_option(
      "--environment", environment, "Equirectangular image of the surroundings, Radiance .hdr");
  command
      ->add_option("--environment-scale", environmentScale, "Radiance of a texel of 1, W/(m2 sr)")
      ->needs(environmentOption)
      ->check(NotNegative())
      ->capture_default_str();
  command
      ->add_option("--environment-rotation", environmentRotation,
                   "Degrees by which the image is turned, clockwise as seen from above")
      ->needs(environmentOption)
      ->check(Within(-360, 360, "from -360 to 360"))
      ->capture_default_str();
}

void LightArguments::Check() const {
  if (sun.empty()) return;
  if (std::abs(sun[0]) > 360 || std::abs(sun[1]) > 90) {
    throw CLI::ValidationError(
        "--sun", "needs an azimuth from -360 to 360 and an elevation from -90 to 90 degrees");
  }
  if (std::min({sun[2], sun[3], sun[4]}) < 0) {
    throw CLI::ValidationError("--sun", "needs an irradiance of 0 or more");
  }
}

std::vector<Light> LightArguments::Lights(const Vec3f& up) const {
  std::vector<Light> lights;
  const Compass compass(up);
  if (!sun.empty()) {
    Light light = NamedLight(LightType::Directional, "sun", {sun[2], sun[3], sun[4]});
    light.direction = -compass.Direction(Radians(sun[0]), Radians(sun[1]));
    light.size = float(Radians(sunDiameter));
    lights.push_back(light);
  }
  if (!sky.empty()) lights.push_back(NamedLight(LightType::Sky, "sky", ToSpectrum(sky)));
  if (!skyGradient.empty()) {
    const std::vector<float>& g = skyGradient;
    Light light = NamedLight(LightType::GradientSky, "sky gradient", ToSpectrum(g));
    light.direction = -up;
    light.horizon = {g[3], g[4], g[5]};
    if (!ground.empty()) light.ground = ToSpectrum(ground);
    lights.push_back(light);
  }
  if (!environment.empty()) {
    Light light = NamedLight(LightType::Environment, "environment", Spectrum(environmentScale));
    light.direction = -up;
    light.rotation = float(Radians(environmentRotation));
    light.imageFile = std::filesystem::absolute(environment).string();
    light.image = ReadEnvironmentImage(environment);
    lights.push_back(light);
  }
  return lights;
}

}  // namespace lambert
