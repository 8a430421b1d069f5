// What one element sends another: kernels without occlusion, and sampled estimates with it
// (thesis 4.2.3, 4.5.3).
#pragma once

#include <cstdint>

#include "Radiosity/Core/Element.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Irradiance vector at `x` per unit radiosity of `source` (per unit strength
/// of a light), with nothing in the way. A horizon, a unit normal, clips what lies below
/// it; the zero vector clips nothing. Polygons by closed form, clusters by samples as small discs,
/// so that no term exceeds the form factor of what it stands for.
Vec3f UnoccludedTransfer(const ElementHierarchy& hierarchy, const Element& source, const Vec3f& x,
                         const Vec3f& horizon);

/// Visible part of `source` from `x`, [0, 1]: one ray to each sample of the source that faces `x`
/// above the horizon; 1 where none does. Adds the rays to `rays`. Not for what fills
/// the sky.
float VisibleFraction(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                      const Element& source, const Vec3f& x, const Vec3f& horizon, int64_t* rays);

/// Irradiance vector at `x` per unit strength of the element `source` of a light that fills the
/// sky, by stratified rays over the hemisphere of `horizon`, and rays to its samples; `visible` is
/// the part of what it gives to a facet with that normal that nothing is in the way of.
Vec3f SkyTransfer(const LightSource& sky, const RayScene& rayScene, const Element& source,
                  const Vec3f& x, const Vec3f& horizon, float* visible, int64_t* rays);

/// An estimate of the mean transfer over a receiver (4.23).
struct TransferEstimate {
  Vec3f transfer;        ///< visibility included
  float visibility = 0;  ///< kernel-weighted visible fraction
  int64_t rays = 0;
};

/// Samples of the receiver against samples of the source: one to one, or `thorough`, each against
/// each.
TransferEstimate EstimateTransfer(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                                  const Element& source, const Element& receiver, bool thorough);

}  // namespace lambert
