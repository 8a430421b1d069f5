#include "Radiosity/Core/EnergyBalance.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/LightExchange.h"
#include "Visibility/Core/LampBalance.h"

namespace lambert {

namespace {

constexpr int kRaysForEscape = 32768, kRaysForCover = 32768;

bool IsSurfaceLeaf(const Element& element) {
  return element.IsLeaf() && !element.IsVolume() && element.kind != ElementKind::Light;
}

/// Leaves, drawn in proportion to a power of each.
class LeafDraw {
 public:
  void Add(int32_t leaf, double power) {
    leaves_.push_back(leaf);
    before_.push_back(before_.back() + power);
  }
  double Total() const { return before_.back(); }
  /// The leaf at `target` in [0, Total()).
  int32_t operator()(double target) const {
    const auto next = std::upper_bound(before_.begin(), before_.end(), target);
    return leaves_[std::min(leaves_.size() - 1, size_t(next - before_.begin() - 1))];
  }

 private:
  std::vector<int32_t> leaves_;
  std::vector<double> before_ = {0};
};

/// Whether another face lies over a place, nearer than what rays skip: both receive the same light,
/// and only one of them is seen.
bool IsCovered(const ElementHierarchy::Place& place, const RayScene& rayScene) {
  const Vec3f above = place.at.position + place.at.normal * (2 * rayScene.Epsilon());
  const RayHit hit = rayScene.Closest(above, -place.at.normal);
  return hit.face >= 0 && hit.face != place.face;
}

/// Per surface, 1 where it only emits: none of its sides receives.
std::vector<uint8_t> BlackEmitters(const ElementHierarchy& hierarchy) {
  std::vector<uint8_t> isBlack(hierarchy.Tree().surfaceRoots.size(), 1);
  for (const int32_t side : hierarchy.SurfaceSides()) {
    if (hierarchy.IsReceiver(side)) isBlack[size_t(hierarchy[side].surface)] = 0;
  }
  return isBlack;
}

/// What leaves the leaves and meets nothing, or emitters that are no receivers. Of covered places
/// only what they emit is seen.
void FollowLeaving(const ElementHierarchy& hierarchy, const ElementLight& light,
                   const RayScene& rayScene, SpectrumSum* escaped, SpectrumSum* absorbed) {
  LeafDraw leaving;
  for (int32_t index = 0; index < hierarchy.Size(); ++index) {
    if (!IsSurfaceLeaf(hierarchy[index])) continue;
    leaving.Add(index, double(light.radiosity[size_t(index)].Mean()) * hierarchy[index].area);
  }
  if (!(leaving.Total() > 0)) return;
  const std::vector<uint8_t> isBlackEmitter = BlackEmitters(hierarchy);
  enum class Fate : uint8_t { MeetsElement, Escapes, MeetsBlackEmitter };
  std::vector<Fate> fate(kRaysForEscape, Fate::MeetsElement);
  std::vector<Spectrum> carried(kRaysForEscape);
  ParallelForEach(kRaysForEscape, 256, [&](int64_t i) {
    // From where.
    Random random(HashBits(uint64_t(i), 0x65736361u));
    const double part = (double(i) + random.UniformDouble()) / kRaysForEscape;
    const int32_t leaf = leaving(leaving.Total() * part);
    const ElementHierarchy::Place from = hierarchy.PlaceOn(leaf, &random);
    const Spectrum& radiosity = light.radiosity[size_t(leaf)];
    const Spectrum seen = IsCovered(from, rayScene) ? hierarchy[leaf].emittance : radiosity;
    carried[size_t(i)] = seen * float(leaving.Total() / kRaysForEscape / double(radiosity.Mean()));

    // To what.
    Vec3f u, v;
    CoordinateSystem(from.at.normal, &u, &v);
    const Vec3f d = CosineHemisphere(random.Uniform(), random.Uniform());
    const RayHit hit = rayScene.Closest(from.at.position, u * d.x + v * d.y + from.at.normal * d.z);
    if (hit.face < 0) {
      fate[size_t(i)] = Fate::Escapes;
    } else if (isBlackEmitter[size_t(hierarchy.GetScene().mesh.surfaceId[size_t(hit.face)])]) {
      fate[size_t(i)] = Fate::MeetsBlackEmitter;
    }
  });
  for (size_t i = 0; i < fate.size(); ++i) {
    if (fate[i] == Fate::Escapes) escaped->Add(carried[i]);
    if (fate[i] == Fate::MeetsBlackEmitter) absorbed->Add(carried[i]);
  }
}

/// What the leaves absorb of `irradiance`, W/m2.
Spectrum Absorbed(const Element& leaf, const Spectrum& irradiance) {
  return irradiance - leaf.reflectance * irradiance;
}

/// Of what leaves absorb, the part that falls on covered places, W.
SpectrumSum FindCovered(const ElementHierarchy& hierarchy, const std::vector<Spectrum>& irradiance,
                        const RayScene& rayScene) {
  SpectrumSum covered;
  LeafDraw absorbing;
  for (int32_t index = 0; index < hierarchy.Size(); ++index) {
    const Element& e = hierarchy[index];
    if (!IsSurfaceLeaf(e)) continue;
    absorbing.Add(index, double(Absorbed(e, irradiance[size_t(index)]).Mean()) * double(e.area));
  }
  if (!(absorbing.Total() > 0)) return covered;
  std::vector<Spectrum> found(kRaysForCover);
  ParallelForEach(kRaysForCover, 256, [&](int64_t i) {
    Random random(HashBits(uint64_t(i), 0x636f7665u));
    const double part = (double(i) + random.UniformDouble()) / kRaysForCover;
    const int32_t leaf = absorbing(absorbing.Total() * part);
    if (!IsCovered(hierarchy.PlaceOn(leaf, &random), rayScene)) return;
    const Spectrum absorbed = Absorbed(hierarchy[leaf], irradiance[size_t(leaf)]);
    found[size_t(i)] =
        absorbed * float(absorbing.Total() / kRaysForCover / double(absorbed.Mean()));
  });
  for (const Spectrum& f : found) covered.Add(f);
  return covered;
}

}  // namespace

void MeasureEnergyBalance(const ElementHierarchy& hierarchy, const LinkNetwork& network,
                          const ElementLight& light, const RayScene& rayScene,
                          SolverStatistics* statistics) {
  // Emitted and absorbed, leaf by leaf.
  SpectrumSum emitted, absorbed, escaped;
  std::vector<Spectrum> irradiance(size_t(hierarchy.Size()));
  for (int32_t index = 0; index < hierarchy.Size(); ++index) {
    const Element& element = hierarchy[index];
    if (!IsSurfaceLeaf(element)) continue;
    irradiance[size_t(index)] =
        ElementIrradiance(element, light.irradiance[size_t(index)]) * light.rowScale[size_t(index)];
    emitted.Add(element.emittance, element.area);
    absorbed.Add(Absorbed(element, irradiance[size_t(index)]), element.area);
  }
  FollowLeaving(hierarchy, light, rayScene, &escaped, &absorbed);

  // Lights without geometry: placed ones with all that they give, far ones with what arrives.
  for (const int32_t source : hierarchy.Lights()) {
    const LightSource& lamp = hierarchy.LightOf(hierarchy[source]);
    if (!lamp.IsFar()) {
      const LampBalance balance = MeasureLampBalance(lamp, rayScene);
      emitted.Add(balance.emitted);
      escaped.Add(balance.escaped);
      continue;
    }
    for (int32_t index = 0; index < hierarchy.Size(); ++index) {
      for (const Link& link : network.incoming[size_t(index)]) {
        if (link.source != source) continue;
        const float arrives = std::max(0.f, Dot(hierarchy[index].vectorArea, link.transfer));
        emitted.Add(hierarchy[source].emittance, arrives);
      }
    }
  }
  statistics->emitted = emitted.Total();
  statistics->absorbed = absorbed.Total();
  statistics->escaped = escaped.Total();
  statistics->covered = FindCovered(hierarchy, irradiance, rayScene).Total();
}

}  // namespace lambert
