#include "Classical/Core/ElementBalance.h"

#include <algorithm>

#include "Classical/Core/LampsAndSky.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Visibility/Core/LampBalance.h"

namespace lambert {

namespace {

constexpr int kEscapeRays = 32768;

/// What leaves the sides and meets nothing, by rays in proportion to it.
void AddEscaping(const ElementSides& sides, const SideLight& light, const RayScene& rayScene,
                 SpectrumSum* escaped) {
  std::vector<double> leavingUpTo(size_t(sides.Count()));
  double leaving = 0;
  for (size_t i = 0; i < leavingUpTo.size(); ++i) {
    leaving += double(light.radiosity[i].Mean()) * double(sides.ExposedArea(i));
    leavingUpTo[i] = leaving;
  }
  if (!(leaving > 0)) return;
  std::vector<int32_t> escapedFrom(kEscapeRays, -1);
  ParallelForEach(kEscapeRays, 256, [&](int64_t ray) {
    Random random(HashBits(uint64_t(ray), 0x65736361u));
    const double target = leaving * (double(ray) + random.UniformDouble()) / kEscapeRays;
    const size_t side =
        std::min(leavingUpTo.size() - 1,
                 size_t(std::upper_bound(leavingUpTo.begin(), leavingUpTo.end(), target) -
                        leavingUpTo.begin()));
    const ExchangeTriangle& triangle = sides.triangles[side];
    const Vec2f b = UniformTriangle(random.Uniform(), random.Uniform());
    const Vec3f x =
        PlaceOnTriangle(triangle.corners[0], triangle.corners[1], triangle.corners[2], b);
    Vec3f u, v;
    CoordinateSystem(triangle.normal, &u, &v);
    const Vec3f d = CosineHemisphere(random.Uniform(), random.Uniform());
    const Vec3f direction = u * d.x + v * d.y + triangle.normal * d.z;
    if (!rayScene.OccludedDirection(x, direction)) escapedFrom[size_t(ray)] = int32_t(side);
  });
  for (const int32_t side : escapedFrom) {
    if (side < 0) continue;
    const Spectrum& radiosity = light.radiosity[size_t(side)];
    escaped->Add(radiosity, leaving / kEscapeRays / double(radiosity.Mean()));
  }
}

}  // namespace

void SideLight::GatherLights(const Scene& scene, const ElementSides& sides,
                             const RayScene& rayScene, int skyRays, int64_t* rays) {
  const LampsAndSky lights(scene, rayScene);
  if (lights.IsEmpty()) return;
  std::vector<int64_t> cast(size_t(sides.Count()), 0);
  const int skyRaysPerPlace = (skyRays + kPlacesPerElement - 1) / kPlacesPerElement;
  ParallelForEach(sides.Count(), 16, [&](int64_t i) {
    const size_t side = size_t(i);
    const ExchangeTriangle& triangle = sides.triangles[side];
    // Samples that are buried are dark, and no part of the mean.
    const float exposed = kPlacesPerElement * sides.exposure[side];
    if (!(exposed > 0)) return;
    for (int place = 0; place < kPlacesPerElement; ++place) {
      const LightReceiver at{sides.samples[side][size_t(place)], triangle.normal, triangle.normal};
      const uint64_t seed = HashBits(uint64_t(i), uint64_t(place));
      fromLamps[side] += lights.FromLamps(at, &cast[side]) / exposed;
      fromFar[side] += lights.FromFar(at, skyRaysPerPlace, seed, &cast[side]) / exposed;
    }
  });
  for (const int64_t count : cast) *rays += count;
}

std::vector<Spectrum> SideLight::IrradianceByKey(const ElementSides& sides, int64_t keys) const {
  std::vector<Spectrum> byKey(static_cast<size_t>(keys));
  for (size_t i = 0; i < irradiance.size(); ++i) {
    byKey[size_t(sides.key[i])] = irradiance[i] * sides.exposure[i];
  }
  return byKey;
}

void MeasureElementBalance(const Scene& scene, const ElementSides& sides, const SideLight& light,
                           const RayScene& rayScene, SolverStatistics* statistics) {
  SpectrumSum emitted, absorbed, escaped;
  for (size_t i = 0; i < sides.triangles.size(); ++i) {
    const double area = double(sides.ExposedArea(i));
    const Spectrum& arriving = light.irradiance[i];
    emitted.Add(sides.emittance[i] + light.fromFar[i], area);
    absorbed.Add(arriving - sides.reflectance[i] * arriving, area);
  }
  AddEscaping(sides, light, rayScene, &escaped);
  for (const auto& lamp : LightSources(SelectLights(scene.lights, false))) {
    const LampBalance balance = MeasureLampBalance(*lamp, rayScene);
    emitted.Add(balance.emitted);
    escaped.Add(balance.escaped);
  }
  statistics->emitted = emitted.Total();
  statistics->absorbed = absorbed.Total();
  statistics->escaped = escaped.Total();
}

}  // namespace lambert
