#include "LightArguments.h"

#include "ArgumentChecks.h"
#include "Scene/Core/Compass.h"

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
  return lights;
}

}  // namespace lambert
