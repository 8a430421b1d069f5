// Lamps beside one wall that takes half of their light.
#include "Visibility/Core/LampBalance.h"

#include <gtest/gtest.h>

#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

using namespace testing;

TEST(LampBalance, APointShinesEverywhereAndASpotInItsCone) {
  // A wall so wide that all which goes down meets it, within 1e-3 of the half.
  TriangleMesh mesh;
  AddQuad(&mesh, {-1000, -1000, -1}, {2000, 0, 0}, {0, 2000, 0}, Spectrum(0.5f));
  mesh.Complete();
  const RayScene rays(mesh);
  Light light;
  light.intensity = {1, 2, 3};
  const LampBalance point = MeasureLampBalance(*MakeLightSource(light), rays);
  EXPECT_NEAR(point.emitted.g, 2 * 4 * kPi, 1e-4);
  EXPECT_NEAR(point.escaped.g, 2 * 2 * kPi, 2e-3 * 4 * kPi);

  // Upward, of even intensity within 60 degrees: 1 - cos(60) of a hemisphere; strata along z.
  light.type = LightType::Spot;
  light.direction = {0, 0, 1};
  light.innerConeAngle = light.outerConeAngle = float(kPi / 3);
  const LampBalance spot = MeasureLampBalance(*MakeLightSource(light), rays);
  EXPECT_NEAR(spot.emitted.r, kPi, 2e-3 * kPi);
  EXPECT_EQ(spot.escaped, spot.emitted);
}

}  // namespace
}  // namespace lambert
