#include "Classical/Core/ExchangeArea.h"

#include <algorithm>

#include "Common/Core/Spectrum.h"

namespace lambert {

namespace {

/// Below this height over its radius a corner counts as on the other's plane: rounding of float
/// coordinates would else make light pass between triangles of one wall.
constexpr float kFlat = 1e-5f;
/// Distance of the centroids over the sum of the radii from which the cubature will do.
constexpr float kFarRatio = 3;

struct Clipped {
  std::array<Vec3d, 4> corners;
  int count = 0;
};

/// The part of `t` above the plane of `plane`.
Clipped ClipAbove(const ExchangeTriangle& t, const ExchangeTriangle& plane) {
  Clipped part;
  const Vec3d normal(plane.normal), origin(plane.centroid);
  std::array<double, 3> height;
  const double flat = double(kFlat) * double(t.radius);
  for (size_t c = 0; c < 3; ++c) {
    height[c] = Dot(Vec3d(t.corners[c]) - origin, normal);
    if (std::abs(height[c]) < flat) height[c] = 0;
  }
  for (size_t c = 0; c < 3; ++c) {
    const size_t next = (c + 1) % 3;
    const Vec3d p(t.corners[c]), q(t.corners[next]);
    if (height[c] >= 0) part.corners[size_t(part.count++)] = p;
    if ((height[c] > 0 && height[next] < 0) || (height[c] < 0 && height[next] > 0)) {
      part.corners[size_t(part.count++)] = p + (q - p) * (height[c] / (height[c] - height[next]));
    }
  }
  return part;
}

/// Edges of a clipped part, as the inner integral needs them.
struct Edge {
  Vec3d origin, direction;  ///< direction: unit
  double length;
};

int EdgesOf(const Clipped& part, std::array<Edge, 4>* edges) {
  int count = 0;
  for (int c = 0; c < part.count; ++c) {
    const Vec3d& p = part.corners[size_t(c)];
    const Vec3d d = part.corners[size_t(c + 1 < part.count ? c + 1 : 0)] - p;
    const double length = Length(d);
    if (length > 0) (*edges)[size_t(count++)] = {p, d / length, length};
  }
  return count;
}

double SafeLog(double x) { return x > 0 ? std::log(x) : 0; }

/// Integral of ln |x - y| over y on the edge, in closed form.
double LogIntegral(const Vec3d& x, const Edge& edge) {
  const Vec3d offset = x - edge.origin;
  const double s = Dot(offset, edge.direction), rest = edge.length - s;
  const double h = std::sqrt(std::max(0.0, LengthSquared(offset) - s * s));
  const double first = 0.5 * SafeLog(s * s + h * h), last = 0.5 * SafeLog(rest * rest + h * h);
  const double angle = std::atan2(h * edge.length, h * h - s * rest);
  return s * first + rest * last - edge.length + h * angle;
}

/// Gauss-Legendre abscissae and weights on [0, 1].
struct Quadrature {
  int count;
  double x[8], w[8];
};
constexpr Quadrature kTwoPoints{2, {0.21132486540518712, 0.78867513459481288}, {0.5, 0.5}};
constexpr Quadrature kFourPoints{
    4,
    {0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
    {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693}};
constexpr Quadrature kEightPoints{
    8,
    {0.019855071751231884, 0.10166676129318664, 0.23723379504183550, 0.40828267875217510,
     0.59171732124782490, 0.76276620495816450, 0.89833323870681336, 0.98014492824876812},
    {0.050614268145188130, 0.11119051722668724, 0.15685332293894364, 0.18134189168918100,
     0.18134189168918100, 0.15685332293894364, 0.11119051722668724, 0.050614268145188130}};

/// Double integral of ln r over two edges. Where they coincide both integrals have a closed form.
double DoubleLogIntegral(const Edge& a, const Edge& b, const Quadrature& outer) {
  const Vec3d aEnd = a.origin + a.direction * a.length, bEnd = b.origin + b.direction * b.length;
  if ((a.origin == b.origin && aEnd == bEnd) || (a.origin == bEnd && aEnd == b.origin)) {
    return a.length * a.length * (std::log(a.length) - 1.5);
  }
  double sum = 0;
  for (int k = 0; k < outer.count; ++k) {
    sum += outer.w[k] * LogIntegral(a.origin + a.direction * (a.length * outer.x[k]), b);
  }
  return sum * a.length;
}

}  // namespace

ExchangeTriangle::ExchangeTriangle(const Vec3f& a, const Vec3f& b, const Vec3f& c)
    : corners{a, b, c}, centroid((a + b + c) / 3.f) {
  const Vec3f vectorArea = Cross(b - a, c - a) * 0.5f;
  area = Length(vectorArea);
  normal = Normalize(vectorArea);
  for (const Vec3f& p : corners) radius = std::max(radius, Length(p - centroid));
  for (size_t axis = 0; axis < 3; ++axis) {
    for (size_t k = 0; k < 3; ++k) {
      places[axis][k] = (corners[k][int(axis)] + centroid[int(axis)]) * 0.5f;
    }
    places[axis][3] = centroid[int(axis)];
  }
}

bool CanExchange(const ExchangeTriangle& a, const ExchangeTriangle& b) {
  const auto above = [](const ExchangeTriangle& t, const ExchangeTriangle& plane) {
    const float flat = kFlat * t.radius;
    return Dot(t.corners[0] - plane.centroid, plane.normal) > flat ||
           Dot(t.corners[1] - plane.centroid, plane.normal) > flat ||
           Dot(t.corners[2] - plane.centroid, plane.normal) > flat;
  };
  return above(b, a) && above(a, b);
}

double ExactExchangeArea(const ExchangeTriangle& a, const ExchangeTriangle& b) {
  if (!(a.area > 0 && b.area > 0)) return 0;
  std::array<Edge, 4> aEdges, bEdges;
  const int aCount = EdgesOf(ClipAbove(a, b), &aEdges), bCount = EdgesOf(ClipAbove(b, a), &bEdges);
  if (aCount < 3 || bCount < 3) return 0;

  // The nearer, the more outer points: 1e-4 at contact, where the integrand has corners.
  const float distance = Length(a.centroid - b.centroid), reach = a.radius + b.radius;
  const Quadrature& outer = distance > 2 * reach      ? kTwoPoints
                            : distance > 1.5f * reach ? kFourPoints
                                                      : kEightPoints;
  double sum = 0;
  for (int i = 0; i < aCount; ++i) {
    for (int j = 0; j < bCount; ++j) {
      const double cosine = Dot(aEdges[size_t(i)].direction, bEdges[size_t(j)].direction);
      sum += cosine * DoubleLogIntegral(aEdges[size_t(i)], bEdges[size_t(j)], outer);
    }
  }
  return std::clamp(sum / (2 * kPi), 0.0, double(std::min(a.area, b.area)));
}

double FarExchangeArea(const ExchangeTriangle& a, const ExchangeTriangle& b) {
  // The three places beside the centroid: exact for polynomials of second degree. The fourth lane
  // fills the registers.
  std::array<float, 4> sum{};
  for (int place = 0; place < 3; ++place) {
    const Vec3f p = a.Place(place);
    for (size_t k = 0; k < 4; ++k) {
      const float x = b.places[0][k] - p.x, y = b.places[1][k] - p.y, z = b.places[2][k] - p.z;
      const float squared = x * x + y * y + z * z;
      const float out = x * a.normal.x + y * a.normal.y + z * a.normal.z;
      const float in = -(x * b.normal.x + y * b.normal.y + z * b.normal.z);
      sum[k] += (out > 0 ? out : 0) * (in > 0 ? in : 0) / (squared * squared);
    }
  }
  return double(sum[0] + sum[1] + sum[2]) * double(a.area) * double(b.area) / (9 * kPi);
}

double ExchangeArea(const ExchangeTriangle& a, const ExchangeTriangle& b) {
  const float far = kFarRatio * (a.radius + b.radius);
  return LengthSquared(a.centroid - b.centroid) > far * far ? FarExchangeArea(a, b)
                                                            : ExactExchangeArea(a, b);
}

}  // namespace lambert
