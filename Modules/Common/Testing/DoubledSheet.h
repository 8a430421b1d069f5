// A sheet that is two faces, for tests of every method.
#pragma once

#include "Common/Testing/TestScenes.h"

namespace lambert::testing {

/// A sheet of 2 m x 2 m in mid-air whose sides are two squares in one place: the upper reflects
/// 0.8, the lower 0.5, 0.2 and 0.1 by band. A sun of 1 W/m2 stands over it, one of 4 W/m2 under it.
inline Scene DoubledSheetUnderSuns() {
  Scene scene;
  const Vec3f x(2, 0, 0), y(0, 2, 0);
  AddQuad(&scene.mesh, {-1, -1, 0}, x, y, Spectrum(0.8f), Spectrum(0.f), 1, 0, 0);
  AddQuad(&scene.mesh, {-1, -1, 0}, y, x, {0.5f, 0.2f, 0.1f}, Spectrum(0.f), 1, 1, 1);
  CompleteTables(&scene);
  for (const float up : {1.f, -1.f}) {
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = {0, 0, -up};
    sun.intensity = Spectrum(up > 0 ? 1.f : 4.f);
    scene.lights.push_back(sun);
  }
  return scene;
}

}  // namespace lambert::testing
