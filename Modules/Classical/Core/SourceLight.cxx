#include "Classical/Core/SourceLight.h"

#include "Classical/Core/LampPlace.h"
#include "Common/Core/PolygonIrradiance.h"

namespace lambert {

namespace {

/// So many emitting sides are evaluated in closed form at every point; more are chosen from by the
/// tree.
constexpr size_t kFewEmitters = 32;
/// Pieces that an emitter's closed form may be taken at, for one point.
constexpr size_t kMostPieces = 512;
/// Shorter edges, relative to their distance from the origin, are not halved: their middles would
/// be rounded onto corners, and the halves be nothing and the whole, for ever.
constexpr float kShortestEdge = 1e-5f;
/// Rays to a light whose samples differ, at most.
constexpr int kRaysPerLight = 16;
/// Additive recurrence after the generalized golden ratio of 2 dimensions (Roberts 2018).
constexpr double kPlane[2] = {0.7548776662466927, 0.5698402909980532};

double Fraction(double x) { return x - std::floor(x); }

/// What of a triangle lies above the horizon of a receiver: the number of its corners, 0, 3 or 4.
int ClipAtHorizon(const Vec3f* triangle, const LightReceiver& at, Vec3f* corners) {
  double height[3];
  for (int c = 0; c < 3; ++c) {
    height[c] = Dot(Vec3d(triangle[c]) - Vec3d(at.position), Vec3d(at.normal));
  }
  return ClipAbove(triangle, height, 3, corners);
}

}  // namespace

Spectrum FromSamples(const LightSources& lights, const LightReceiver& at, const RayScene& rays,
                     int64_t* cast) {
  return lights.Irradiance(at, kRaysPerLight, SeedOfPlace(at.position),
                           [&](const LightSample& sample) {
                             ++*cast;
                             return !rays.Occluded(at.position, sample.direction, sample.distance);
                           });
}

SourceLight::SourceLight(const Scene& scene, const RayScene& rays)
    : scene_(scene), rays_(rays), tree_(scene.mesh), lights_(scene.lights) {
  // Emitting sides, as long as they are few.
  const TriangleMesh& mesh = scene.mesh;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    if (mesh.emittance[size_t(face)].IsBlack() || !(mesh.Area(face) > 0)) continue;
    for (const Side side : {kFront, kBack}) {
      if (!mesh.Emits(face, side)) continue;
      Emitter emitter;
      for (int c = 0; c < 3; ++c)
        emitter.corners[c] = mesh.Corner(face, side == kFront ? c : 2 - c);
      emitter.exitance = mesh.emittance[size_t(face)];
      if (emitters_.size() <= kFewEmitters) emitters_.push_back(emitter);
    }
  }
  if (emitters_.size() > kFewEmitters) emitters_.clear();
}

Spectrum SourceLight::FromEmitters(const LightReceiver& at, int count, Random* random,
                                   int64_t* cast) const {
  if (!emitters_.empty()) return FromFewEmitters(at, count, random, cast);
  return tree_.IsEmpty() ? Spectrum() : FromManyEmitters(at, count, random, cast);
}

bool SourceLight::Unblocked(const LightReceiver& at, const Vec3f& place, int64_t* cast) const {
  if (Dot(place - at.position, at.geometric) <= 0) return false;
  ++*cast;
  return !rays_.Occluded(at.position, place);
}

void SourceLight::Evaluate(const LightReceiver& at, Piece* piece) const {
  const Vec3d kernel = PolygonIrradianceAbove(piece->corners, 3, at.position, at.normal);
  piece->factor = float(std::max(0.0, Dot(kernel, Vec3d(at.normal))));
  piece->irradiance = emitters_[size_t(piece->emitter)].exitance * piece->factor;
  piece->strength = piece->irradiance.Mean();
}

/// All emitters in closed form, cut until each piece is worth no more than one ray; then rays at
/// even steps over the sum of the pieces, each for its step, to where its piece sends light from.
Spectrum SourceLight::FromFewEmitters(const LightReceiver& at, int count, Random* random,
                                      int64_t* cast) const {
  // Where nothing is in the way.
  thread_local std::vector<Piece> pieces;
  pieces.clear();
  float total = 0;
  for (size_t i = 0; i < emitters_.size(); ++i) {
    Vec3f seen[4];
    const int corners = ClipAtHorizon(emitters_[i].corners, at, seen);
    for (int c = 2; c < corners; ++c) {
      Piece piece;
      piece.corners[0] = seen[0], piece.corners[1] = seen[c - 1], piece.corners[2] = seen[c];
      piece.emitter = int32_t(i);
      Evaluate(at, &piece);
      if (!(piece.strength > 0)) continue;
      total += piece.strength;
      pieces.push_back(piece);
    }
  }
  if (!(total > 0)) return {};

  // Halve the longest edge of what is worth more than a ray. One half takes the place of the whole,
  // the other goes behind.
  const float worthARay = total / float(count);
  for (size_t i = 0; i < pieces.size(); ++i) {
    while (pieces[i].strength > worthARay && pieces.size() < kMostPieces) {
      Piece& whole = pieces[i];
      int longest = 0;
      float length = -1;
      for (int c = 0; c < 3; ++c) {
        const float l = LengthSquared(whole.corners[(c + 1) % 3] - whole.corners[c]);
        if (l > length) length = l, longest = c;
      }
      const int next = (longest + 1) % 3;
      const Vec3f middle = (whole.corners[longest] + whole.corners[next]) * 0.5f;
      if (length < kShortestEdge * kShortestEdge * LengthSquared(middle)) break;
      Piece half = whole;
      half.corners[longest] = middle;
      whole.corners[next] = middle;
      Evaluate(at, &whole);
      Evaluate(at, &half);
      if (half.strength > 0) pieces.push_back(half);
    }
  }

  // Rays. Rounding at points near a lamp's plane lets its pieces sum up to other than the whole.
  float all = 0;
  for (const Piece& piece : pieces) all += piece.strength;
  const float step = all / float(count), first = random->Uniform();
  Spectrum sum;
  float below = 0;
  int ray = 0;
  for (const Piece& piece : pieces) {
    below += piece.strength;
    for (; ray < count && (float(ray) + first) * step < below; ++ray) {
      const Vec3f place =
          PickLampPlace(piece.corners, at.position, at.normal, double(piece.factor), random);
      if (Unblocked(at, place, cast)) sum += piece.irradiance * (step / piece.strength);
    }
  }
  return sum;
}

/// Places chosen by the tree, stratified over its order.
Spectrum SourceLight::FromManyEmitters(const LightReceiver& at, int count, Random* random,
                                       int64_t* cast) const {
  Spectrum sum;
  const double shift[3] = {random->UniformDouble(), random->UniformDouble(),
                           random->UniformDouble()};
  for (int i = 0; i < count; ++i) {
    const double u[3] = {(i + shift[0]) / count, Fraction(shift[1] + i * kPlane[0]),
                         Fraction(shift[2] + i * kPlane[1])};
    const EmitterTree::Sample sample = tree_.Pick(at.position, at.normal, u);
    if (sample.face < 0 || !(sample.density > 0)) continue;
    const float cosine = Dot(at.normal, sample.direction);
    const Vec3f front = scene_.mesh.VectorArea(sample.face);
    const Side side = Dot(front, sample.direction) < 0 ? kFront : kBack;
    if (cosine <= 0 || !scene_.mesh.Emits(sample.face, side)) continue;
    if (!Unblocked(at, at.position + sample.direction * sample.distance, cast)) continue;
    sum += scene_.mesh.emittance[size_t(sample.face)] *
           (cosine / (float(kPi) * sample.density * float(count)));
  }
  return sum;
}

}  // namespace lambert
