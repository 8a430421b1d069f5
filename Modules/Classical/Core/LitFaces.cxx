#include "Classical/Core/LitFaces.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {

constexpr int64_t kPathsPerSide = 16;
/// A side is dark where no more than this part of its paths find light: rays leak where edges meet
/// within the rounding.
constexpr double kLeaking = 0.002;
constexpr int kBounces = 6;
constexpr int kEmitterRays = 2;  ///< to emitting faces, at every bounce

/// Looks for light from one side of a face.
class LightSeeker {
 public:
  LightSeeker(const Scene& scene, const RayScene& rayScene, const SourceLight& sources)
      : scene_(scene), rayScene_(rayScene), sources_(sources) {}

  /// A path of random bounces from `at`: does light come along it?
  bool FindsLight(LightReceiver at, Random* random, int64_t* rays) const {
    for (int bounce = 0; bounce <= kBounces; ++bounce) {
      if (!sources_.FromLights(at, rays).IsBlack()) return true;
      if (!sources_.FromEmitters(at, kEmitterRays, random, rays).IsBlack()) return true;

      Vec3f u, v;
      CoordinateSystem(at.normal, &u, &v);
      const Vec3f d = CosineHemisphere(random->Uniform(), random->Uniform());
      const Vec3f direction = Normalize(u * d.x + v * d.y + at.normal * d.z);
      const RayHit hit = rayScene_.Closest(at.position, direction);
      ++*rays;
      if (hit.face < 0) return !sources_.Sky().IsBlack();
      const Vec3f front = scene_.mesh.FrontNormal(hit.face);
      const Side side = Dot(front, direction) < 0 ? kFront : kBack;
      if (scene_.mesh.Emits(hit.face, side) && !scene_.mesh.emittance[size_t(hit.face)].IsBlack()) {
        return true;
      }
      if (scene_.mesh.reflectance[size_t(hit.face)].IsBlack()) return false;
      at.normal = at.geometric = side == kFront ? front : -front;
      at.position = at.position + direction * hit.distance + at.normal * rayScene_.Epsilon();
    }
    return false;
  }

 private:
  const Scene& scene_;
  const RayScene& rayScene_;
  const SourceLight& sources_;
};

/// A random place on one side of an element, clear of its neighbours' rounding.
LightReceiver PlaceOn(const UniformMesh& mesh, int64_t element, Side side, float clearance,
                      Random* random) {
  const Vec2f b = UniformTriangle(random->Uniform(), random->Uniform());
  const Vec3f& p = mesh.Corner(element, 0);
  LightReceiver at;
  at.position = p + (mesh.Corner(element, 1) - p) * b.x + (mesh.Corner(element, 2) - p) * b.y;
  at.normal = Normalize(mesh.VectorArea(element)) * (side == kBack ? -1.f : 1.f);
  at.geometric = at.normal;
  at.position += at.normal * clearance;
  return at;
}

/// First element of each face, and one more at the end.
std::vector<int64_t> FirstElements(const UniformMesh& mesh, int64_t faces) {
  std::vector<int64_t> first(size_t(faces) + 1, 0);
  for (const int32_t face : mesh.face) ++first[size_t(face) + 1];
  for (size_t face = 0; face < size_t(faces); ++face) first[face + 1] += first[face];
  return first;
}

}  // namespace

std::vector<uint8_t> FindLitFaces(const Scene& scene, const UniformMesh& mesh,
                                  const RayScene& rayScene, const SourceLight& sources,
                                  int64_t* rays) {
  const int64_t faces = scene.mesh.FaceCount();
  const std::vector<int64_t> first = FirstElements(mesh, faces);
  const LightSeeker seeker(scene, rayScene, sources);
  std::vector<uint8_t> lit(size_t(faces), 0);
  std::vector<int64_t> cast(size_t(faces), 0);
  ParallelForEach(faces, 1, [&](int64_t face) {
    const size_t f = size_t(face);
    const int64_t elements = first[f + 1] - first[f];
    for (const Side side : {kFront, kBack}) {
      bool isLit = scene.mesh.Emits(face, side) && !scene.mesh.emittance[f].IsBlack();
      int found = 0;
      Random random(HashBits(uint64_t(face), uint64_t(side)));
      // A stride that shares no factor with most counts spreads the first paths over the face.
      const int64_t paths = std::max(kPathsPerSide, elements);
      for (int64_t path = 0; path < paths && !isLit; ++path) {
        const int64_t element = first[f] + path * 7919 % elements;
        const LightReceiver at = PlaceOn(mesh, element, side, rayScene.Epsilon(), &random);
        if (LengthSquared(at.normal) == 0) continue;
        found += seeker.FindsLight(at, &random, &cast[f]) ? 1 : 0;
        isLit = found > kLeaking * double(paths);
      }
      if (isLit) lit[f] |= uint8_t(1 << side);
    }
  });
  for (const int64_t count : cast) *rays += count;
  return lit;
}

}  // namespace lambert
