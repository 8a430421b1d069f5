// The sides of elements that exchange light.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Classical/Core/ExchangeArea.h"
#include "Classical/Core/UniformMesh.h"

namespace lambert {

/// The modelled sides of all elements that have an area, in the order of the elements.
struct ElementSides {
  std::vector<ExchangeTriangle> triangles;
  /// Where visibility is tried from: a random place in each of the four parts of a triangle, so
  /// that no ray runs along the edges of things that are aligned with the elements.
  std::vector<std::array<Vec3f, kPlacesPerElement>> samples;
  std::vector<int32_t> key;  ///< 2 element + side
  std::vector<Spectrum> reflectance;
  std::vector<Spectrum> emittance;  ///< W/m2
  /// Groups of neighbours, at most 32: first side of each; one more at the end.
  std::vector<int32_t> groupBegin;

  int64_t Count() const { return int64_t(triangles.size()); }
  int64_t GroupCount() const { return std::max<int64_t>(1, int64_t(groupBegin.size())) - 1; }
  /// The corners of every group, each once.
  std::vector<std::vector<Vec3f>> GroupPoints(const UniformMesh& mesh) const;
};

/// `litSides`: per face of the scene, bit 1 front, bit 2 back.
ElementSides CollectElementSides(const Scene& scene, const UniformMesh& mesh,
                                 const std::vector<uint8_t>& litSides);

}  // namespace lambert
