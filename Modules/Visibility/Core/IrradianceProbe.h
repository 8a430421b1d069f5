// Irradiance at free points, as a lux meter would read it in a solved scene.
#pragma once

#include <string>
#include <vector>

#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// A one-sided facet that asks for its irradiance.
struct ProbePoint {
  Vec3f position;  ///< world space, m
  Vec3f normal;    ///< any length but zero
};

enum class ProbeKind {
  Surface,  ///< on a modelled side of a face: reads the delivered solution
  Space,    ///< gathers from the solution
  Inside,   ///< in geometry that no light enters: 0
};
/// "surface", "space" or "inside".
const char* ProbeKindName(ProbeKind kind);

struct ProbeReading {
  ProbeKind kind = ProbeKind::Space;
  Spectrum irradiance;  ///< W/m2
};

struct IrradianceProbeOptions {
  int rays = 256;            ///< gather rays a point, [1, inf)
  int emitterRays = 256;     ///< rays to emitting faces a point, [1, inf)
  bool forceGather = false;  ///< gathers on surfaces too
};

/// Reads `solution` of `scene` at `points`. A point within 1e-5 of the scene diagonal of a modelled
/// side that faces within 60 degrees of its normal reads the delivered irradiance there. Any other
/// gathers: cosine-weighted rays read the radiosity of the sides they hit and the sky, emitting
/// faces and lights are sampled apart. The reading depends on the point and the options alone, for
/// any number of threads. `rays` holds the scene's mesh. Throws Error for a coordinate or normal
/// that is not finite and for a zero normal, naming the row (the first is 1); Cancelled.
std::vector<ProbeReading> ReadIrradianceProbes(const Scene& scene, const RayScene& rays,
                                               const RadiositySolution& solution,
                                               const std::vector<ProbePoint>& points,
                                               const IrradianceProbeOptions& options = {},
                                               const ProgressCallback& progress = {});

}  // namespace lambert
