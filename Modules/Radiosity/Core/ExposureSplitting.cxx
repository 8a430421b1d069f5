#include "Radiosity/Core/ExposureSplitting.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Common/Core/PolygonIrradiance.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/LightExchange.h"

namespace lambert {

namespace {

constexpr int kRaysPerPlace = 12;
/// Open fractions of a place's short rays that make an element mixed.
constexpr float kEnclosed = 0.1f, kOpen = 0.5f;
/// Links that bring more than this part of the light are made anew for the children.
constexpr float kStrongPart = 0.01f;
/// Corners are looked at this far toward the middle of their element.
constexpr float kCornerInset = 0.03f;

/// Where an element is looked at: its samples, and the corners that its light is interpolated from.
int Places(const ElementHierarchy& hierarchy, const Element& element, SurfaceSample* places) {
  int count = 0;
  for (const SurfaceSample& sample : element.samples) places[count++] = sample;
  if (!element.IsPolygon()) return count;
  Vec3f corners[kMaximumPolygonCorners];
  const int cornerCount = hierarchy.PolygonCorners(element, corners);
  Vec3f middle;
  for (int i = 0; i < cornerCount; ++i) middle += corners[i] / float(cornerCount);
  for (int i = 0; i < cornerCount; ++i) {
    places[count].position = corners[i] + (middle - corners[i]) * kCornerInset;
    places[count++].normal = element.axis;
  }
  return count;
}

/// Rays of the length of the element's radius from each place: mixed where one is enclosed and
/// another open.
Exposure LookNearby(const ElementHierarchy& hierarchy, int32_t index, const RayScene& rayScene) {
  const Element& element = hierarchy[index];
  SurfaceSample places[kSamplesPerElement + kMaximumPolygonCorners];
  const int count = Places(hierarchy, element, places);
  float least = 1, most = 0;
  Random random(HashBits(uint64_t(index), 0x6578706fu));
  for (int place = 0; place < count; ++place) {
    Vec3f u, v;
    CoordinateSystem(places[place].normal, &u, &v);
    const float shiftU = random.Uniform(), shiftV = random.Uniform();
    int open = 0;
    for (int i = 0; i < kRaysPerPlace; ++i) {
      const Vec3f d = CosineHemisphere((float(i) + shiftU) / kRaysPerPlace,
                                       RadicalInverse(uint32_t(i), shiftV));
      const Vec3f direction = u * d.x + v * d.y + places[place].normal * d.z;
      const Vec3f& x = places[place].position;
      if (!rayScene.Occluded(x, x + direction * element.radius)) ++open;
    }
    least = std::min(least, float(open) / kRaysPerPlace);
    most = std::max(most, float(open) / kRaysPerPlace);
  }
  return least < kEnclosed && most > kOpen ? Exposure::Mixed : Exposure::Even;
}

}  // namespace

void SplitByExposure(double threshold, const RayScene& rayScene, ElementHierarchy* hierarchy,
                     ElementLight* light, LinkNetwork* network, std::vector<Exposure>* exposures) {
  // Leaves that receive enough; children stand for their parent's light until it is exchanged anew.
  std::vector<int32_t> candidates;
  for (int32_t index = 0; index < hierarchy->Size(); ++index) {
    const Element& element = (*hierarchy)[index];
    if (!element.IsLeaf() || element.IsVolume() || !element.canSplit) continue;
    if (hierarchy->IsReceiver(index)) candidates.push_back(index);
  }
  while (!candidates.empty()) {
    exposures->resize(size_t(hierarchy->Size()), Exposure::Unknown);
    const auto received = [&](int32_t index) {
      const Element& element = (*hierarchy)[index];
      return ElementIrradiance(element, light->irradiance[size_t(index)]).MaxBand() * element.area;
    };
    ParallelForEach(int64_t(candidates.size()), 64, [&](int64_t i) {
      const int32_t index = candidates[size_t(i)];
      if ((*exposures)[size_t(index)] != Exposure::Unknown || received(index) <= threshold) return;
      (*exposures)[size_t(index)] = LookNearby(*hierarchy, index, rayScene);
    });

    const int64_t looked = int64_t(candidates.size());

    // Split the mixed ones and look at their children.
    std::vector<int32_t> mixed;
    for (const int32_t index : candidates) {
      if ((*exposures)[size_t(index)] == Exposure::Mixed && received(index) > threshold) {
        mixed.push_back(index);
      }
    }
    network->rays += looked * kSamplesPerElement * kRaysPerPlace;
    hierarchy->Split(mixed);
    light->Grow(*hierarchy);
    mixed.erase(std::remove_if(mixed.begin(), mixed.end(),
                               [&](int32_t i) { return (*hierarchy)[i].IsLeaf(); }),
                mixed.end());
    PushLinksToChildren(mixed, kStrongPart, rayScene, *hierarchy, *light, network);
    candidates.clear();
    for (const int32_t index : mixed) {
      const Element& parent = (*hierarchy)[index];
      for (int32_t i = parent.child; i >= 0 && i < parent.child + parent.childCount; ++i) {
        light->irradiance[size_t(i)] = light->irradiance[size_t(index)];
        if ((*hierarchy)[i].canSplit) candidates.push_back(i);
      }
    }
  }
}

}  // namespace lambert
