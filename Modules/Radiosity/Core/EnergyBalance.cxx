#include "Radiosity/Core/EnergyBalance.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/LightExchange.h"

namespace lambert {

namespace {

constexpr int kRaysForEscape = 32768;
constexpr int kRaysPerLight = 4096;

struct Power {
  double r = 0, g = 0, b = 0;
  Power& operator+=(const Power& p) {
    r += p.r, g += p.g, b += p.b;
    return *this;
  }
  void Add(const Spectrum& s, double weight) {
    r += double(s.r) * weight, g += double(s.g) * weight, b += double(s.b) * weight;
  }
  Spectrum ToSpectrum() const { return {float(r), float(g), float(b)}; }
};

bool IsSurfaceLeaf(const Element& element) {
  return element.IsLeaf() && !element.IsVolume() && element.kind != ElementKind::Light;
}

/// Light of a point or spot light: all of it, and the part that meets nothing, over directions of
/// equal solid angle.
void AddPunctualLight(const Light& light, const RayScene& rayScene, Power* emitted,
                      Power* escaped) {
  Random random(7);
  const double solidAngle = 4 * kPi / kRaysPerLight;
  for (int i = 0; i < kRaysPerLight; ++i) {
    const float z = 1 - 2 * (float(i) + random.Uniform()) / kRaysPerLight;
    const float phi = float(2 * kPi) * random.Uniform(), s = std::sqrt(std::max(0.f, 1 - z * z));
    const Vec3f direction(s * std::cos(phi), s * std::sin(phi), z);
    const float factor = light.ConeFactor(direction);
    if (factor <= 0) continue;
    emitted->Add(light.intensity, factor * solidAngle);
    if (rayScene.Closest(light.position, direction).face < 0) {
      escaped->Add(light.intensity, factor * solidAngle);
    }
  }
}

}  // namespace

void MeasureEnergyBalance(const ElementHierarchy& hierarchy, const LinkNetwork& network,
                          const ElementLight& light, const RayScene& rayScene,
                          SolverStatistics* statistics) {
  // Emitted and absorbed, leaf by leaf; all that leaves a leaf, to draw rays by.
  Power emitted, absorbed, escaped;
  std::vector<int32_t> leaves;
  std::vector<double> leavingBefore(1, 0);
  const TriangleMesh& mesh = hierarchy.GetScene().mesh;
  std::vector<uint8_t> isBlackEmitter(hierarchy.Tree().surfaceRoots.size(), 1);
  for (const int32_t side : hierarchy.SurfaceSides()) {
    if (hierarchy.IsReceiver(side)) isBlackEmitter[size_t(hierarchy[side].surface)] = 0;
  }
  for (int32_t index = 0; index < hierarchy.Size(); ++index) {
    const Element& element = hierarchy[index];
    if (!IsSurfaceLeaf(element)) continue;
    const Spectrum irradiance =
        ElementIrradiance(element, light.irradiance[size_t(index)]) * light.rowScale[size_t(index)];
    emitted.Add(element.emittance, element.area);
    absorbed.Add(irradiance - element.reflectance * irradiance, element.area);
    leaves.push_back(index);
    leavingBefore.push_back(leavingBefore.back() +
                            double(light.radiosity[size_t(index)].Mean()) * double(element.area));
  }

  // Rays in proportion to what leaves: some escape, some end on emitters that are no receivers.
  const double leaving = leavingBefore.back();
  if (leaving > 0) {
    enum class Fate : uint8_t { MeetsElement, Escapes, MeetsBlackEmitter };
    std::vector<Fate> fate(kRaysForEscape, Fate::MeetsElement);
    std::vector<int32_t> origin(kRaysForEscape, -1);
    ParallelForEach(kRaysForEscape, 256, [&](int64_t i) {
      Random random(HashBits(uint64_t(i), 0x65736361u));
      const double target = leaving * (double(i) + random.UniformDouble()) / kRaysForEscape;
      const size_t leaf =
          std::min(leaves.size() - 1,
                   size_t(std::upper_bound(leavingBefore.begin(), leavingBefore.end(), target) -
                          leavingBefore.begin() - 1));
      const Element& element = hierarchy[leaves[leaf]];
      const SurfaceSample& sample =
          element.samples[size_t(random.Bits() % uint64_t(kSamplesPerElement))];
      Vec3f u, v;
      CoordinateSystem(sample.normal, &u, &v);
      const Vec3f d = CosineHemisphere(random.Uniform(), random.Uniform());
      const Vec3f direction = u * d.x + v * d.y + sample.normal * d.z;
      const RayHit hit = rayScene.Closest(sample.position, direction);
      origin[size_t(i)] = leaves[leaf];
      if (hit.face < 0) {
        fate[size_t(i)] = Fate::Escapes;
      } else if (isBlackEmitter[size_t(mesh.surfaceId[size_t(hit.face)])]) {
        fate[size_t(i)] = Fate::MeetsBlackEmitter;
      }
    });
    for (size_t i = 0; i < fate.size(); ++i) {
      if (fate[i] == Fate::MeetsElement) continue;
      const Spectrum& radiosity = light.radiosity[size_t(origin[i])];
      (fate[i] == Fate::Escapes ? escaped : absorbed)
          .Add(radiosity, leaving / kRaysForEscape / double(radiosity.Mean()));
    }
  }

  // Lights without geometry.
  for (const int32_t source : hierarchy.Lights()) {
    const Light& item = hierarchy.GetScene().lights[size_t(hierarchy[source].item)];
    if (item.type == LightType::Point || item.type == LightType::Spot) {
      AddPunctualLight(item, rayScene, &emitted, &escaped);
      continue;
    }
    for (int32_t index = 0; index < hierarchy.Size(); ++index) {
      for (const Link& link : network.incoming[size_t(index)]) {
        if (link.source != source) continue;
        const float arrives = std::max(0.f, Dot(hierarchy[index].vectorArea, link.transfer));
        emitted.Add(item.intensity, arrives);
      }
    }
  }
  statistics->emitted = emitted.ToSpectrum();
  statistics->absorbed = absorbed.ToSpectrum();
  statistics->escaped = escaped.ToSpectrum();
}

}  // namespace lambert
