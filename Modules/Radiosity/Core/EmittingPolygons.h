// Emitting faces that make up one convex polygon are one source: a lamp is as even however finely
// it is tessellated.
#pragma once

#include <array>
#include <vector>

#include "Common/Core/Spectrum.h"
#include "Common/Core/TriangleMesh.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// Evenly emitting, flat and convex.
struct EmittingPolygon {
  static constexpr int kMostCorners = 8;

  std::array<Vec3f, kMostCorners> corners;  ///< counter-clockwise seen from the emitting side, m
  int count = 3;
  Vec3f normal;  ///< unit, of the emitting side
  float area = 0;
  Spectrum emittance;  ///< W/m2

  Vec3f Center() const;       ///< mean of the corners
  float LargestSize() const;  ///< between two corners, m
  /// Of the triangle of the first corner, that before `corner`, and `corner`, from 2 on, m2.
  float FanArea(int corner) const;
  float DistanceSquared(const Vec3f& place) const;  ///< to the nearest of its points, m2
};

/// Of every side that emits. Faces of one plane and exitance that edges join are one polygon where
/// their border is convex and has few corners, else each is its own. Faces without area are left
/// out.
std::vector<EmittingPolygon> FindEmittingPolygons(const TriangleMesh& mesh);

}  // namespace lambert
