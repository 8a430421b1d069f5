// Where the light of a lamp goes.
#pragma once

#include "Scene/Core/LightSource.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// W.
struct LampBalance {
  Spectrum emitted;  ///< all of it
  Spectrum escaped;  ///< the part that meets nothing
};

/// By rays in directions of equal solid angle, of a source that is not far.
LampBalance MeasureLampBalance(const LightSource& lamp, const RayScene& rays);

}  // namespace lambert
