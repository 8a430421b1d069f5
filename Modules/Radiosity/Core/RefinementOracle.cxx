#include "Radiosity/Core/RefinementOracle.h"

#include <algorithm>

#include "Radiosity/Core/Shafts.h"
#include "Radiosity/Core/Transfer.h"

namespace lambert {

namespace {

/// Part of the unoccluded transfer that is in doubt where all sample pairs were clear, all blocked,
/// or mixed. Samples of a source that is large for its distance tell little of its near part.
constexpr float kDoubtClear = 0.02f, kDoubtClearNear = 0.1f;
constexpr float kDoubtBlocked = 0.1f, kDoubtBlockedNear = 0.5f;
constexpr float kDoubtPartial = 0.35f;
/// Links with such an end are no more than guesses of the order of the transfer itself.
constexpr float kVolumeSpread = 1.f;
/// Elements flatter than this cone (radians) are treated as planes when sides are told apart.
constexpr float kPlanarCone = 1e-3f;

float Clamp01(float v) { return std::min(1.f, std::max(0.f, v)); }

/// Distance from a point to a box, m.
float Distance(const Vec3f& p, const ClusterFrame& box) {
  const Vec3f offset = p - box.center;
  float squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float beyond =
        std::max(0.f, std::fabs(Dot(offset, box.axes[size_t(axis)])) - box.halfExtent[axis]);
    squared += beyond * beyond;
  }
  return std::sqrt(squared);
}

/// Largest height of a box over the plane through `origin`, m.
float HeightOver(const ClusterFrame& box, const Vec3f& origin, const Vec3f& normal) {
  float height = Dot(box.center - origin, normal);
  for (int axis = 0; axis < 3; ++axis) {
    height += std::fabs(Dot(box.axes[size_t(axis)], normal)) * box.halfExtent[axis];
  }
  return height;
}

/// Largest and middle cosine between an element's normals and the way to another's center.
struct Cosines {
  float largest, middle;
};
Cosines CosinesToward(const Element& element, const Vec3f& direction, float angularSize) {
  if (element.IsVolume()) return {1, 0.5f};
  const float middle = Dot(element.axis, direction);
  const float spread = element.coneAngle + angularSize;
  if (spread >= float(kPi) / 2) return {1, std::max(0.25f, middle)};
  const float angle = std::acos(std::max(-1.f, std::min(1.f, middle)));
  return {std::cos(std::max(0.f, angle - spread)), middle};
}

/// Lights: their kernel at the center, nothing known of it over a receiver that spans its distance.
PairBound BoundLight(const ElementHierarchy& hierarchy, const Element& source,
                     const Element& receiver) {
  PairBound bound;
  const LightSource& light = hierarchy.LightOf(source);
  const LightSample middle = light.Sample(receiver.frame.center, {});
  const float distance = light.IsFar() ? hierarchy.SceneDiagonal() : middle.distance;
  if (!light.FillsSky() && receiver.coneAngle < kPlanarCone) {
    bound.apart = Dot(receiver.axis, middle.direction) <= 0;
  }
  const float nearest = std::max(distance - receiver.radius, 0.1f * receiver.radius);
  bound.formFactor = light.LargestTransfer(nearest);
  bound.receiverSpread = receiver.TurnsToAllSides()
                             ? 1.f
                             : light.Variation(receiver.radius / std::max(nearest, 1e-20f));
  return bound;
}

}  // namespace

PairBound BoundPair(const ElementHierarchy& hierarchy, const Element& source,
                    const Element& receiver) {
  PairBound bound;
  const float noHeight = 1e-6f * hierarchy.SceneDiagonal();

  if (source.kind == ElementKind::Light) return BoundLight(hierarchy, source, receiver);

  // Planes cannot light what lies behind them.
  if (source.coneAngle < kPlanarCone &&
      HeightOver(receiver.frame, source.frame.center, source.axis) <=
          source.frame.halfExtent.z + noHeight) {
    bound.apart = true;
    return bound;
  }
  if (receiver.coneAngle < kPlanarCone &&
      HeightOver(source.frame, receiver.frame.center, receiver.axis) <=
          receiver.frame.halfExtent.z + noHeight) {
    bound.apart = true;
    return bound;
  }

  // Neither can normals that all turn away.
  const Vec3f offset = receiver.frame.center - source.frame.center;
  const float distance = Length(offset);
  const Vec3f direction = distance > 0 ? offset / distance : Vec3f(0, 0, 1);
  const float ratio = (source.radius + receiver.radius) / std::max(distance, 1e-20f);
  const float angularSize = ratio < 1 ? std::asin(ratio) : float(kPi);
  const Cosines atSource = CosinesToward(source, direction, angularSize);
  const Cosines atReceiver = CosinesToward(receiver, -direction, angularSize);
  if (atSource.largest <= 0 || atReceiver.largest <= 0) {
    bound.apart = true;
    return bound;
  }

  // Form factor of a disc of the source's area, with cosines between the middle and the largest.
  const float sourceArea = source.IsVolume() ? source.area / 4 : source.area;
  const float cosine = std::max(0.5f * (atSource.largest + std::max(0.f, atSource.middle)), 1e-3f);
  const float receiverCosine = 0.5f * (atReceiver.largest + std::max(0.f, atReceiver.middle));
  bound.formFactor = receiverCosine * cosine * sourceArea /
                     (float(kPi) * distance * distance + cosine * sourceArea);

  // A polygon's is known at the middle of the receiver.
  if (source.IsPolygon() && !receiver.IsVolume()) {
    const Vec3f horizon = receiver.coneAngle < float(kPi) / 2 ? receiver.axis : Vec3f();
    const Vec3f kernel = UnoccludedTransfer(hierarchy, source, receiver.frame.center, horizon);
    bound.formFactor = std::max(bound.formFactor, Length(kernel));
  }

  // Variation over the receiver, of second order where reconstruction follows the first; shape of
  // the source.
  const float toSource = std::max(Distance(receiver.frame.center, source.frame), 1e-20f);
  const float toReceiver = std::max(Distance(source.frame.center, receiver.frame), 1e-20f);
  const float receiverRatio = Clamp01(receiver.radius / toSource);
  bound.nearness = Clamp01(source.radius / toReceiver);
  bound.receiverSpread = receiver.IsVolume() ? kVolumeSpread : receiverRatio * receiverRatio;
  bound.sourceSpread = source.IsVolume()    ? kVolumeSpread
                       : source.IsPolygon() ? 0.f
                                            : bound.nearness * bound.nearness;
  // Normals over more than a hemisphere: no vector tells what such a cluster receives or sends.
  if (!receiver.IsVolume() && receiver.coneAngle > float(kPi) / 2) bound.receiverSpread = 1;
  if (!source.IsVolume() && source.coneAngle > float(kPi) / 2) bound.sourceSpread = 1;
  return bound;
}

namespace {

class DoubtOracle : public RefinementOracle {
 public:
  TransferError Estimate(const LinkEvidence& evidence) const override {
    // Shape and distance.
    const auto& [source, receiver, bound, radiosity, variation, visibility, sampled, isCertain] =
        evidence;
    TransferError error;
    const float transfer = bound.formFactor * radiosity;
    const float seen = visibility < 0 ? 1.f : std::max(visibility, kDoubtBlocked);
    error.byReceiver = transfer * bound.receiverSpread * seen;
    error.bySource =
        (transfer * bound.sourceSpread + bound.formFactor * variation * bound.nearness) * seen;

    // Visibility: the larger end is what samples miss most of.
    if (visibility >= 0 && !isCertain) {
      const float near = bound.nearness * bound.nearness;
      const float doubt = visibility <= 0
                              ? kDoubtBlocked + (kDoubtBlockedNear - kDoubtBlocked) * near
                          : visibility >= 1 ? kDoubtClear + (kDoubtClearNear - kDoubtClear) * near
                                            : kDoubtPartial;
      const bool splitSource =
          source.radius > 2 * receiver.radius && source.kind != ElementKind::Light;
      (splitSource ? error.bySource : error.byReceiver) += transfer * doubt;
    }
    return error;
  }
};

class GeometricOracle : public DoubtOracle {
 public:
  TransferError Estimate(const LinkEvidence& evidence) const override {
    LinkEvidence unseen = evidence;
    unseen.visibility = -1;
    return DoubtOracle::Estimate(unseen);
  }
};

class BfaOracle : public RefinementOracle {
 public:
  TransferError Estimate(const LinkEvidence& evidence) const override {
    // Nothing is known before the samples.
    TransferError error;
    if (evidence.visibility < 0) return error;
    const Element &source = evidence.source, &receiver = evidence.receiver;
    const float formFactor = SampledFormFactor(evidence);

    // Of the larger end as seen from the other (3.2.2).
    const Vec3f direction = Normalize(receiver.frame.center - source.frame.center);
    const bool isSourceLarger =
        source.kind != ElementKind::Light &&
        ProjectedArea(source, direction) > ProjectedArea(receiver, -direction);
    (isSourceLarger ? error.bySource : error.byReceiver) = formFactor * evidence.radiosity;
    return error;
  }
  bool HasFixedSamples() const override { return true; }

 private:
  // Of bent clusters what a facet that faces the light receives: light may arrive from where their
  // normals cancel. Samples of volumes mostly turn away from each other and tell of nothing.
  static float SampledFormFactor(const LinkEvidence& evidence) {
    const Element& receiver = evidence.receiver;
    if (evidence.source.IsVolume() || receiver.IsVolume()) return evidence.bound.formFactor;
    return receiver.coneAngle < kPlanarCone ? std::max(0.f, Dot(receiver.axis, evidence.transfer))
                                            : Length(evidence.transfer);
  }
  static float ProjectedArea(const Element& element, const Vec3f& direction) {
    const float facing = FacingFraction(element, direction);
    return element.area * (element.coneAngle < kPlanarCone ? facing : std::max(facing, 0.25f));
  }
};

class VisibilityOracle : public DoubtOracle {
 public:
  VisibilityOracle(const ElementHierarchy& hierarchy, const RayScene& rayScene)
      : shafts_(hierarchy, rayScene) {}
  bool IsCertain(const LinkEvidence& evidence) const override {
    if (evidence.visibility >= 1) return shafts_.IsClear(evidence.source, evidence.receiver);
    if (evidence.visibility <= 0) return shafts_.IsBlocked(evidence.source, evidence.receiver);
    return false;
  }

 private:
  const Shafts shafts_;
};

}  // namespace

const char* OracleName(OracleKind kind) {
  constexpr const char* kNames[] = {"doubt", "geometric", "bfa", "visibility"};
  return kNames[size_t(kind)];
}

std::unique_ptr<RefinementOracle> MakeRefinementOracle(OracleKind kind,
                                                       const ElementHierarchy& hierarchy,
                                                       const RayScene& rayScene) {
  switch (kind) {
    case OracleKind::Geometric:
      return std::make_unique<GeometricOracle>();
    case OracleKind::Bfa:
      return std::make_unique<BfaOracle>();
    case OracleKind::Visibility:
      return std::make_unique<VisibilityOracle>(hierarchy, rayScene);
    case OracleKind::Doubt:
      break;
  }
  return std::make_unique<DoubtOracle>();
}

}  // namespace lambert
