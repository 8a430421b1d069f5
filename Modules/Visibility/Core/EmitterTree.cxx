#include "Visibility/Core/EmitterTree.h"

#include "Common/Core/Random.h"
#include "Common/Core/SphericalTriangle.h"

namespace lambert {

namespace {

// Below the first the difference to uniform area is nothing and rounding is much; above the second
// the point lies as good as in the triangle's plane.
constexpr double kSmallestSolidAngle = 3e-4, kLargestSolidAngle = 6.22;

// A triangle of less area than this share of its squared distance is sampled by area: its solid
// angle is less, and its distance varies by some hundredths.
constexpr float kSmallestArea = 3e-3f;
// Of a group within a sphere of this share of its distance, with normals within 26 degrees of its
// axis, one is chosen by power: what they send to a point differs by a small factor, which costs
// less noise than a walk further down costs time.
constexpr float kSmallestGroup = 1 / 3.f;
constexpr float kParallel = 0.9f;

/// A triangle on the sphere about a position; of a small one no more than that it is small.
struct SphericalCorners {
  Vec3d a, b, c;
  double solidAngle = 0;
  template <class Emitter>
  SphericalCorners(const Emitter& emitter, const Vec3f& position) {
    if (emitter.area < kSmallestArea * LengthSquared(emitter.center - position)) return;
    const Vec3f* corners = emitter.corners;
    const Vec3d p(position);
    a = Normalize(Vec3d(corners[0]) - p);
    b = Normalize(Vec3d(corners[1]) - p);
    c = Normalize(Vec3d(corners[2]) - p);
    solidAngle = SolidAngle(a, b, c);
  }
  bool SuitsSampling() const {
    return solidAngle > kSmallestSolidAngle && solidAngle < kLargestSolidAngle;
  }
};

/// Cosine of max(0, a - b) for angles in [0, pi].
float CosineOfDifference(float sinA, float cosA, float sinB, float cosB) {
  return cosA > cosB ? 1 : cosA * cosB + sinA * sinB;
}
float SineOfDifference(float sinA, float cosA, float sinB, float cosB) {
  return cosA > cosB ? 0 : sinA * cosB - cosA * sinB;
}
float SineOf(float cosine) { return std::sqrt(std::max(0.f, 1 - cosine * cosine)); }

}  // namespace

EmitterTree::EmitterTree(const TriangleMesh& mesh) : emitterOfFace_(size_t(mesh.FaceCount()), -1) {
  for (int32_t face = 0; face < int32_t(mesh.FaceCount()); ++face) {
    const bool front = mesh.Emits(face, kFront), back = mesh.Emits(face, kBack);
    Emitter e{};
    e.face = face;
    e.area = mesh.Area(face);
    e.power = e.area * mesh.emittance[size_t(face)].Mean();
    if ((!front && !back) || !(e.power > 0)) continue;
    for (int corner = 0; corner < 3; ++corner) e.corners[corner] = mesh.Corner(face, corner);
    e.normal = front ? mesh.FrontNormal(face) : -mesh.FrontNormal(face);
    e.center = (e.corners[0] + e.corners[1] + e.corners[2]) / 3.f;
    e.twoSided = front && back;
    emitters_.push_back(e);
  }
  if (emitters_.empty()) return;
  nodes_.reserve(2 * emitters_.size());
  Build(0, int32_t(emitters_.size()), 0, 0);
  powerBefore_.assign(1, 0);
  for (const Emitter& e : emitters_) powerBefore_.push_back(powerBefore_.back() + e.power);
  for (size_t i = 0; i < emitters_.size(); ++i) {
    emitterOfFace_[size_t(emitters_[i].face)] = int32_t(i);
  }
}

int32_t EmitterTree::Build(int32_t begin, int32_t end, int depth, uint64_t trail) {
  const int32_t index = int32_t(nodes_.size());
  nodes_.push_back(Enclose(begin, end));
  nodes_[size_t(index)].begin = begin;
  nodes_[size_t(index)].end = end;
  if (end - begin == 1) {
    emitters_[size_t(begin)].trail = trail;
    return index;
  }
  // Halves along the longest axis of the centres: balanced, so that a trail fits into 64 bits.
  Box3f centers;
  for (int32_t i = begin; i < end; ++i) centers.Include(emitters_[size_t(i)].center);
  const Vec3f extent = centers.Extent();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const int32_t middle = (begin + end) / 2;
  std::nth_element(emitters_.begin() + begin, emitters_.begin() + middle, emitters_.begin() + end,
                   [axis](const Emitter& a, const Emitter& b) {
                     return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis]
                                                             : a.face < b.face;
                   });
  Build(begin, middle, depth + 1, trail);
  const int32_t second = Build(middle, end, depth + 1, trail | (uint64_t(1) << depth));
  nodes_[size_t(index)].second = second;
  return index;
}

EmitterTree::Node EmitterTree::Enclose(int32_t begin, int32_t end) const {
  Node node;
  Box3f bounds;
  Vec3f axis;
  for (int32_t i = begin; i < end; ++i) {
    const Emitter& e = emitters_[size_t(i)];
    for (const Vec3f& corner : e.corners) bounds.Include(corner);
    axis += e.normal * e.power;
    node.power += e.power;
    node.twoSided |= e.twoSided;
  }
  node.center = bounds.Center();
  node.radius = 0.5f * bounds.Diagonal();
  node.axis = Normalize(axis);
  for (int32_t i = begin; i < end; ++i) {
    node.cosSpread = std::min(node.cosSpread, Dot(node.axis, emitters_[size_t(i)].normal));
  }
  node.cosSpread = std::max(-1.f, node.cosSpread - 1e-6f);
  node.sinSpread = SineOf(node.cosSpread);
  return node;
}

bool EmitterTree::IsSmall(const Node& node, const Vec3f& position) {
  if (node.end - node.begin == 1) return true;
  constexpr float kShare = kSmallestGroup * kSmallestGroup;
  return node.cosSpread > kParallel &&
         node.radius * node.radius < kShare * LengthSquared(position - node.center);
}

float EmitterTree::Importance(const Node& node, const Vec3f& position, const Vec3f& normal) {
  const Vec3f offset = position - node.center;
  const float distance = Length(offset);
  if (distance <= node.radius) return node.power / (node.radius * node.radius);
  const Vec3f d = offset / distance;
  const float sinBound = node.radius / distance, cosBound = SineOf(sinBound);

  // The smallest angles that any place in the bounding sphere may make, at the emitter and at the
  // receiver.
  float cosEmitter = Dot(node.axis, d);
  if (node.twoSided) cosEmitter = std::abs(cosEmitter);
  const float sinEmitter = SineOf(cosEmitter);
  const float cosLess = CosineOfDifference(sinEmitter, cosEmitter, node.sinSpread, node.cosSpread);
  const float sinLess = SineOfDifference(sinEmitter, cosEmitter, node.sinSpread, node.cosSpread);
  const float atEmitter = CosineOfDifference(sinLess, cosLess, sinBound, cosBound);
  const float cosReceiver = -Dot(normal, d);
  const float atReceiver = CosineOfDifference(SineOf(cosReceiver), cosReceiver, sinBound, cosBound);
  if (atEmitter <= 0 || atReceiver <= 0) return 0;
  return node.power * atEmitter * atReceiver / (distance * distance);
}

EmitterTree::Sample EmitterTree::Pick(const Vec3f& position, const Vec3f& normal,
                                      const double u[3]) const {
  // Down the tree; the choice leaves a fresh uniform number behind.
  Sample sample;
  double choice = u[0], probability = 1;
  int32_t index = 0;
  while (!IsSmall(nodes_[size_t(index)], position)) {
    const int32_t first = index + 1, second = nodes_[size_t(index)].second;
    const double one = Importance(nodes_[size_t(first)], position, normal);
    const double two = Importance(nodes_[size_t(second)], position, normal);
    if (!(one + two > 0)) return sample;
    const double p = one / (one + two);
    if (choice < p) {
      choice /= p, probability *= p, index = first;
    } else {
      choice = (choice - p) / (1 - p), probability *= 1 - p, index = second;
    }
  }

  // One of the group, by power.
  const Node& group = nodes_[size_t(index)];
  const auto begin = powerBefore_.begin() + group.begin, end = powerBefore_.begin() + group.end;
  const auto found = std::upper_bound(begin + 1, end, *begin + choice * (*end - *begin));
  const Emitter& e = emitters_[size_t(found - powerBefore_.begin() - 1)];
  probability *= double(e.power) / (*end - *begin);

  // A place on it, uniform over solid angle where that is more than a speck.
  if (const SphericalCorners corners(e, position); corners.SuitsSampling()) {
    const Vec3d w = SphericalTriangle(corners.a, corners.b, corners.c).Sample(u[1], u[2]);
    sample.direction = Vec3f(Normalize(w));
    const double height = Dot(Vec3d(e.normal), Vec3d(e.corners[0]) - Vec3d(position));
    sample.distance = float(height / Dot(Vec3d(e.normal), w));
  } else {
    const Vec2f b = UniformTriangle(float(u[1]), float(u[2]));
    const Vec3f offset = PlaceOnTriangle(e.corners[0], e.corners[1], e.corners[2], b) - position;
    sample.distance = Length(offset);
    sample.direction = Normalize(offset);
  }
  if (!(sample.distance > 0) || !std::isfinite(sample.distance)) return sample;
  sample.face = e.face;
  sample.density =
      float(probability * PlaceDensity(e, position, sample.direction, sample.distance));
  return sample;
}

double EmitterTree::PlaceDensity(const Emitter& emitter, const Vec3f& position,
                                 const Vec3f& direction, float distance) {
  const SphericalCorners corners(emitter, position);
  if (corners.SuitsSampling()) return 1 / corners.solidAngle;
  const double cosine = std::abs(Dot(emitter.normal, direction));
  return cosine > 0 ? double(distance) * distance / (cosine * emitter.area) : 0;
}

float EmitterTree::Density(const Vec3f& position, const Vec3f& normal, int32_t face,
                           const Vec3f& direction, float distance) const {
  const int32_t number = emitterOfFace_[size_t(face)];
  if (number < 0) return 0;
  const Emitter& e = emitters_[size_t(number)];
  double probability = 1;
  int32_t index = 0;
  for (int depth = 0; !IsSmall(nodes_[size_t(index)], position); ++depth) {
    const int32_t first = index + 1, second = nodes_[size_t(index)].second;
    const double one = Importance(nodes_[size_t(first)], position, normal);
    const double two = Importance(nodes_[size_t(second)], position, normal);
    if (!(one + two > 0)) return 0;
    const bool takeSecond = (e.trail >> depth) & 1;
    probability *= (takeSecond ? two : one) / (one + two);
    index = takeSecond ? second : first;
  }
  const Node& group = nodes_[size_t(index)];
  probability *=
      double(e.power) / (powerBefore_[size_t(group.end)] - powerBefore_[size_t(group.begin)]);
  return float(probability * PlaceDensity(e, position, direction, distance));
}

}  // namespace lambert
