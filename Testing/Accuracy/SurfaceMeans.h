// Areas and means over the surfaces of a solved scene.
#pragma once

#include "AccuracyCases.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert::testing {

/// m2 of the faces of `material`; -1: of all.
double SurfaceArea(const TriangleMesh& mesh, int material);

/// The factor that makes what is compared of what was asked: lux, or the ratio of areas that turns
/// mean irradiance into a form factor (reciprocity).
double Scale(const TriangleMesh& mesh, const Quantity& quantity);

/// What is compared, read from `solution` of `scene`. Sides that it does not model are dark.
double ReadQuantity(const Scene& scene, const RadiositySolution& solution,
                    const Quantity& quantity);

}  // namespace lambert::testing
