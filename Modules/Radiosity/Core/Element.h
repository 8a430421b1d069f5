// Elements: the nodes of the hierarchy that exchange light.
#pragma once

#include <array>
#include <cstdint>

#include "Clustering/Core/ClusterFrame.h"
#include "Common/Core/Spectrum.h"
#include "Common/Core/TriangleMesh.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// From coarse to fine. Lights have no geometry and only give.
enum class ElementKind : uint8_t { Volume, Face, Patch, Light };

/// A place on an element from which visibility is sampled.
struct SurfaceSample {
  Vec3f position;
  Vec3f normal;  ///< unit, of the element's side
};

/// Samples an element; pairs of two elements' samples make the transfer estimate (4.23).
constexpr int kSamplesPerElement = 4;

struct Element {
  // Place in the hierarchy. Children stand side by side and after their parent.
  int32_t parent = -1;
  int32_t child = -1;
  int32_t childCount = 0;
  int32_t item = -1;  ///< volume node, cluster node, patch or light source, by kind
  int32_t surface = -1;
  int32_t level = 0;
  ElementKind kind = ElementKind::Volume;
  Side side = kFront;
  bool canSplit = true;  ///< false once it has been found to have no children
  uint8_t polygonCount =
      0;  ///< corners of a planar convex element (triangle or patch); 0 for others

  // Geometry, of the side that it stands for.
  float area = 0;    ///< m2; of volumes both sides of all faces below that exist
  Vec3f vectorArea;  ///< m2 (4.9)
  Vec3f axis;        ///< unit, along vectorArea; zero for volumes
  float coneAngle =
      float(kPi);      ///< largest angle between the axis and a face normal below, radians
  float radius = 0;    ///< of a sphere about frame.center that holds the element
  ClusterFrame frame;  ///< box that holds it
  std::array<SurfaceSample, kSamplesPerElement> samples;

  // Material, area-weighted means.
  Spectrum reflectance;
  Spectrum emittance;  ///< W/m2; of lights their strength, or one band of it

  bool IsLeaf() const { return child < 0; }
  bool IsPolygon() const { return polygonCount > 0; }
  bool IsVolume() const { return kind == ElementKind::Volume; }
  /// Normals over more than a hemisphere: light from opposite sides must not cancel in one vector
  /// here.
  bool TurnsToAllSides() const { return IsVolume() || coneAngle > float(kPi) / 2; }
};

/// Projected area over area of what an element turns toward the unit vector `direction`: by the
/// vector area; where normals span more than a hemisphere, what the vector area hides still shows a
/// quarter of its area, and so does a volume.
inline float FacingFraction(const Element& element, const Vec3f& direction) {
  if (element.IsVolume()) return 0.25f;
  if (!(element.area > 0)) return 0;
  float projected = std::max(0.f, Dot(element.vectorArea, direction));
  if (element.TurnsToAllSides()) {
    projected += 0.25f * std::max(0.f, element.area - Length(element.vectorArea));
  }
  return projected / element.area;
}

/// Light arriving at a place: a vector that any normal may be dotted with (4.12), and what comes
/// from all around alike.
struct VectorIrradiance {
  std::array<Vec3f, 3> vector;  ///< per band, W/m2
  /// What any normal receives, W/m2; at elements that turn to all sides the sum of the lengths of
  /// all vectors instead, of which what the vector sum does not show came from all around alike.
  Spectrum isotropic;

  void Add(const Vec3f& transfer, const Spectrum& radiosity) {
    for (size_t band = 0; band < 3; ++band) vector[band] += transfer * radiosity[int(band)];
  }
  VectorIrradiance& operator+=(const VectorIrradiance& e) {
    for (size_t band = 0; band < 3; ++band) vector[band] += e.vector[band];
    isotropic += e.isotropic;
    return *this;
  }
  VectorIrradiance operator*(float s) const {
    VectorIrradiance scaled = *this;
    for (Vec3f& v : scaled.vector) v *= s;
    scaled.isotropic *= s;
    return scaled;
  }
  /// The same with the isotropic part of a facet, from one with the sum of lengths: over all
  /// normals the mean of the positive cosine is a quarter.
  VectorIrradiance FromAllAround() const {
    VectorIrradiance light = *this;
    for (int band = 0; band < 3; ++band) {
      light.isotropic[band] = 0.25f * std::max(0.f, isotropic[band] - Length(vector[size_t(band)]));
    }
    return light;
  }
  /// Irradiance of a facet with unit normal `n` (4.12), never negative.
  Spectrum At(const Vec3f& n) const {
    Spectrum e;
    for (int band = 0; band < 3; ++band) {
      e[band] = std::max(0.f, Dot(n, vector[size_t(band)])) + isotropic[band];
    }
    return e;
  }
};

/// Light moves along links: from `source` to the element that holds the link.
struct Link {
  int32_t source = -1;
  Vec3f transfer;  ///< irradiance vector per unit radiosity of the source (4.19, 4.20), visibility
                   ///< included
  uint8_t visibility = 0;  ///< visible fraction of the sample pairs, 0 to 255
  bool isSampled = false;  ///< false where the source was dark when the link was made: nothing is
                           ///< known of it yet
  bool isCertain = false;  ///< visible as a whole, not just where it was sampled
};

}  // namespace lambert
