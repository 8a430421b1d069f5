#include "Radiosity/Core/RefinementOracle.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Radiosity/Core/LinkRefinement.h"
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
    const Element &source = evidence.source, &receiver = evidence.receiver;
    const PairBound& bound = evidence.bound;
    const float visibility = evidence.visibility;
    TransferError error;
    const float transfer = bound.formFactor * evidence.radiosity;
    const float seen = visibility < 0 ? 1.f : std::max(visibility, kDoubtBlocked);
    error.byReceiver = transfer * bound.receiverSpread * seen;
    error.bySource =
        (transfer * bound.sourceSpread + bound.formFactor * evidence.variation * bound.nearness) *
        seen;

    // Visibility: the larger end is what samples miss most of.
    if (visibility >= 0 && !evidence.isCertain) {
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

/// What is displayed of luminance: keyed to the log-average of what is lit (reinhard2002 eqs. 1 to
/// 3), then encoded for a screen. An error counts by the change that it makes there.
class PerceptualOracle : public DoubtOracle {
 public:
  void Adapt(const ElementHierarchy& hierarchy, const ElementLight& light) override {
    // What leaves reflect, by area, but for shadow without light.
    const Sums all = SumOver(hierarchy, light, 0);
    if (!(all.luminance > 0)) return;
    const Sums lit = SumOver(hierarchy, light, kBlack * all.luminance / all.area);
    adaptation_ = float(std::exp(lit.logarithm / lit.area));
    reflectance_ = float(lit.reflectance / lit.area);
  }

  TransferError Estimate(const LinkEvidence& evidence) const override {
    TransferError error = DoubtOracle::Estimate(evidence);
    const float weight = Weight(evidence.receiver, evidence.reflected);
    error.byReceiver *= weight;
    error.bySource *= weight;
    return error;
  }

 private:
  struct Sums {
    double area = 0, luminance = 0, logarithm = 0, reflectance = 0;
    Sums& operator+=(const Sums& s) {
      area += s.area, luminance += s.luminance;
      logarithm += s.logarithm, reflectance += s.reflectance;
      return *this;
    }
  };
  /// Over the leaves that reflect more than `least`.
  static Sums SumOver(const ElementHierarchy& hierarchy, const ElementLight& light, double least) {
    return OrderedSum<Sums>(hierarchy.Size(), [&](int64_t i) {
      const Element& element = hierarchy[int32_t(i)];
      const double luminance = double(ReflectedLuminance(element, light.radiosity[size_t(i)]));
      if (!element.IsLeaf() || element.kind == ElementKind::Light || !(luminance > least)) {
        return Sums();
      }
      const double area = double(element.area);
      return Sums{area, area * luminance, area * std::log(luminance),
                  area * double(Luminance(element.reflectance))};
    });
  }

  /// Change of displayed values for a change of irradiance, relative to that where a surface of
  /// mean reflectance is as bright as the eye is adapted to: there, and where what is reflected
  /// arrives next, which is as bright as that in the mean.
  float Weight(const Element& receiver, float reflected) const {
    if (!(adaptation_ > 0)) return 1;
    const float slope = DisplaySlope(kKey * reflected / adaptation_) / DisplaySlope(kKey);
    const float reflectance = Luminance(receiver.reflectance);
    return slope * reflectance / reflectance_ + reflectance;
  }
  /// d/dL of (L / (1 + L))^(1 / gamma): photographic curve and screen.
  static float DisplaySlope(float keyed) {
    const float l = std::max(keyed, kDarkest), curve = l / (1 + l);
    return std::pow(curve, 1 / kGamma - 1) / (kGamma * (1 + l) * (1 + l));
  }

  static constexpr float kKey = 0.18f, kGamma = 2.2f;
  /// Keyed luminance below which no less light is told from less: a twentieth of the key.
  static constexpr float kDarkest = kKey / 20;
  /// Leaves this much darker than the mean are shadow without light.
  static constexpr double kBlack = 1e-5;
  float adaptation_ = 0;   ///< log-average luminance of what is lit, W/m2; 0 before there is light
  float reflectance_ = 1;  ///< luminance of its mean reflectance
};

}  // namespace

float ReflectedLuminance(const Element& element, const Spectrum& radiosity) {
  return std::max(0.f, Luminance(radiosity - element.emittance));
}

const char* OracleName(OracleKind kind) {
  constexpr const char* kNames[] = {"doubt", "geometric", "bfa", "visibility", "perceptual"};
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
    case OracleKind::Perceptual:
      return std::make_unique<PerceptualOracle>();
    case OracleKind::Doubt:
      break;
  }
  return std::make_unique<DoubtOracle>();
}

}  // namespace lambert
