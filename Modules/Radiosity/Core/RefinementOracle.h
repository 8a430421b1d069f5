// How wrong a link may be: by default from geometry and visibility, never from the spread of its
// own samples: that would keep the links that miss what they should see.
#pragma once

#include <cstdint>
#include <memory>

#include "Radiosity/Core/Element.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

struct ElementLight;

/// Geometry of a pair of elements, for unit radiosity of the source.
struct PairBound {
  bool apart = false;    ///< neither can light the other: no link at all
  float formFactor = 0;  ///< irradiance on the receiver with nothing in the way, a mid estimate in
                         ///< [0, 1]; lights: W/m2
  float receiverSpread =
      0;  ///< relative variation over the receiver that reconstruction cannot follow, [0, 1]
  float sourceSpread = 0;  ///< relative error of the source's shape, [0, 1]; 0 for polygons
  float nearness =
      0;  ///< size of the source over its distance, [0, 1]: how much its own variation counts
};

PairBound BoundPair(const ElementHierarchy& hierarchy, const Element& source,
                    const Element& receiver);

/// Error of a transfer, W/m2 on the receiver, split by whose refinement lessens it.
struct TransferError {
  float byReceiver = 0, bySource = 0;
  float Sum() const { return byReceiver + bySource; }
};

/// What is known of a link when it is judged.
struct LinkEvidence {
  const Element& source;
  const Element& receiver;
  PairBound bound;
  float radiosity = 0;     ///< of the source, its largest band, W/m2; of lights as in ElementLight
  float variation = 0;     ///< standard deviation of it within the source, W/m2
  float visibility = -1;   ///< sampled, in [0, 1]; negative where it is not known yet
  Vec3f transfer{};        ///< sampled (4.23), visibility included, per unit radiosity
  bool isCertain = false;  ///< the visibility holds for all pairs of points, not just the sampled
  float reflected = 0;     ///< luminance of what the receiver reflects as it is lit now, W/m2
};

/// Luminance of what an element of that radiosity does not emit but reflect, W/m2.
float ReflectedLuminance(const Element& element, const Spectrum& radiosity);

/// A strategy that judges links: how wrong each is held to be. Asked by many threads at once.
class RefinementOracle {
 public:
  virtual ~RefinementOracle() = default;
  /// Called before links are refined, with the light as it is then.
  virtual void Adapt(const ElementHierarchy&, const ElementLight&) {}
  virtual TransferError Estimate(const LinkEvidence& evidence) const = 0;
  /// Whether what samples have found, all clear or all blocked, is certain. Asked only of links
  /// that would be refined otherwise.
  virtual bool IsCertain(const LinkEvidence&) const { return false; }
  /// Whether every transfer is sampled alike, however much light it carries.
  virtual bool HasFixedSamples() const { return false; }
};

/// Doubt: geometry bounds the error, and visibility is in doubt however many samples agree.
/// Geometric: the same, with nothing said of visibility. Bfa: radiosity x sampled form factor x
/// area, of a fixed count of sample pairs (thesis 4.5.3). Visibility: as Doubt, but without doubt
/// where a transfer is known to be clear; known to be blocked it is no link (9.2.2). Perceptual: as
/// Doubt, but weighed by how much of it a tone-mapped picture shows (9.2.2).
enum class OracleKind : uint8_t { Doubt, Geometric, Bfa, Visibility, Perceptual };
/// All of them, in the order of their making.
constexpr OracleKind kOracleKinds[] = {OracleKind::Doubt, OracleKind::Geometric, OracleKind::Bfa,
                                       OracleKind::Visibility, OracleKind::Perceptual};

/// "doubt", "geometric", "bfa", "visibility", "perceptual".
const char* OracleName(OracleKind kind);

/// Keeps references to both.
std::unique_ptr<RefinementOracle> MakeRefinementOracle(OracleKind kind,
                                                       const ElementHierarchy& hierarchy,
                                                       const RayScene& rayScene);

}  // namespace lambert
