// What elements, links and the delivery of their light take in memory, and whether that stays below
// a ceiling.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/MemoryCeiling.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// Bytes that an element takes with its light, its place among others and its patch, and a link
/// with the head of its list; both with what vectors keep free (Documentation/Stages).
constexpr int64_t kElementBytes = 720, kLinkBytes = 40;
/// Bytes that are kept of a delivered triangle and of a link for another light of the same links,
/// at most: the mesh, and the transfers to its points and to the corners of clusters.
constexpr int64_t kKeptTriangleBytes = 600, kKeptLinkBytes = 256;

class SolverMemory {
 public:
  /// `megabytes` of 1e6 bytes of the process; 0: no ceiling. `litSides` as given to the hierarchy,
  /// which is kept by reference.
  SolverMemory(double megabytes, const ElementHierarchy& hierarchy,
               const std::vector<uint8_t>& litSides);

  /// Whether there is room for so many more elements and links, and for delivering what they bring.
  bool HasRoomFor(double elements, double links) const;
  /// Whether there is likely to be for another iteration of links: by how they grew in the `last`,
  /// from the one `before` it; null where it was the first.
  bool HasRoomForIteration(const IterationRecord* before, const IterationRecord& last) const;
  /// Whether there is for delivering the light of so many links and keeping the mesh and the
  /// transfers to its points.
  bool HasRoomToKeep(int64_t links) const;
  /// Whether there is for a final gather; for a round of cuts of the mesh that came out of one.
  bool HasRoomForGather() const;
  bool HasRoomForCuts(const RadiositySolution& delivered) const;

 private:
  double Triangles() const;

  const MemoryCeiling ceiling_;
  const ElementHierarchy& hierarchy_;
  int64_t unrefinedTriangles_ = 0;
};

}  // namespace lambert
