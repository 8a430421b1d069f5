// The exchange area A_i F_ij = A_j F_ji of two triangles that nothing stands between, m2.
#pragma once

#include <array>

#include "Common/Core/Vector.h"

namespace lambert {

/// A triangle that sends and receives on the side from which its corners run counter-clockwise.
struct ExchangeTriangle {
  std::array<Vec3f, 3> corners;
  Vec3f centroid;
  Vec3f normal;      ///< unit; zero for a triangle without area, which exchanges nothing
  float area = 0;    ///< m2
  float radius = 0;  ///< of a sphere about the centroid that holds the corners, m
  /// Midway between the centroid and each corner, and the centroid: coordinates of four places.
  std::array<std::array<float, 4>, 3> places{};

  ExchangeTriangle() = default;
  ExchangeTriangle(const Vec3f& a, const Vec3f& b, const Vec3f& c);
  Vec3f Place(int place) const {
    return {places[0][size_t(place)], places[1][size_t(place)], places[2][size_t(place)]};
  }
};

/// Places on a triangle.
constexpr int kPlacesPerElement = 4;

/// True where some part of each lies above the other's plane: light may pass.
bool CanExchange(const ExchangeTriangle& a, const ExchangeTriangle& b);

/// Exact but for rounding and an outer quadrature (1e-4 of the result where the two share an edge,
/// less elsewhere): the double contour integral of ln r (sparrow1978), over the parts
/// that lie above each other's plane; the inner integral in closed form. Never negative, never more
/// than the smaller area.
double ExactExchangeArea(const ExchangeTriangle& a, const ExchangeTriangle& b);

/// The same by a cubature of 3 x 3 points, exact to second order in size over distance; for
/// triangles that are far from each other.
double FarExchangeArea(const ExchangeTriangle& a, const ExchangeTriangle& b);

/// Whichever is accurate to about 1e-3: the exact one where the centroids are nearer than 3 times
/// the sum of the radii.
double ExchangeArea(const ExchangeTriangle& a, const ExchangeTriangle& b);

}  // namespace lambert
