// The sides of elements that exchange light.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Classical/Core/ExchangeArea.h"
#include "Classical/Core/ExposedPlaces.h"
#include "Classical/Core/UniformMesh.h"

namespace lambert {

/// The modelled sides of all elements that have an area, in the order of the elements.
struct ElementSides {
  std::vector<ExchangeTriangle> triangles;
  /// Where visibility is tried from: a random place in each of the four parts of a triangle, so
  /// that no ray runs along the edges of things that are aligned with the elements.
  std::vector<std::array<Vec3f, kPlacesPerElement>> samples;
  std::vector<int32_t> key;  ///< 2 element + side
  /// Part of the side that is not buried in another thing, of the four samples; 1 unless measured.
  std::vector<float> exposure;
  std::vector<Spectrum> reflectance;
  std::vector<Spectrum> emittance;  ///< W/m2
  /// Groups of neighbours, at most 32: first side of each; one more at the end.
  std::vector<int32_t> groupBegin;

  int64_t Count() const { return int64_t(triangles.size()); }
  /// Area that exchanges light, m2.
  float ExposedArea(size_t side) const { return triangles[side].area * exposure[side]; }
  int64_t GroupCount() const { return std::max<int64_t>(1, int64_t(groupBegin.size())) - 1; }
  /// Tries which samples of every side are exposed. Adds the rays to `rays`.
  void MeasureExposure(const ExposedPlaces& places, int64_t* rays);
  /// The corners of every group, each once.
  std::vector<std::vector<Vec3f>> GroupPoints(const UniformMesh& mesh) const;
};

/// `litSides`: per face of the scene, bit 1 front, bit 2 back.
ElementSides CollectElementSides(const Scene& scene, const UniformMesh& mesh,
                                 const std::vector<uint8_t>& litSides);

}  // namespace lambert
