// Makers of the kinds of lights, each in a file of its own.
#pragma once

#include <memory>

#include "Scene/Core/LightSource.h"

namespace lambert {

std::unique_ptr<LightSource> MakeLamp(const Light& light);  ///< point, spot
std::unique_ptr<LightSource> MakeSun(const Light& light);   ///< directional
std::unique_ptr<LightSource> MakeSky(const Light& light);   ///< constant

}  // namespace lambert
