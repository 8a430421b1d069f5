#include "Classical/Core/LitFaces.h"

#include <algorithm>
#include <numeric>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Scene/Core/DoubledFaces.h"
#include "Scene/Core/MeshTopology.h"

namespace lambert {

namespace {

constexpr int64_t kPathsPerSide = 16;
/// Paths of a side that these found dark though there is a hint of light, and after how many
/// without any it is given up: where 3 paths in a hundred find light, one side in fifty is missed.
constexpr int64_t kPathsOfDoubt = 512;
constexpr int64_t kPathsWithout = 128;
constexpr int kArrivals = 8;  ///< rays from a lit side, to find where its light arrives
/// A side is dark where no more than this part of its paths find light: rays leak where edges meet
/// within the rounding.
constexpr double kLeaking = 0.002;
constexpr int kBounces = 6;
constexpr int kEmitterRays = 2;  ///< to emitting faces, at every bounce

/// A direction about a unit normal, by its cosine.
Vec3f CosineDirection(const Vec3f& normal, Random* random) {
  Vec3f u, v;
  CoordinateSystem(normal, &u, &v);
  const float first = random->Uniform(), second = random->Uniform();
  const Vec3f d = CosineHemisphere(first, second);
  return Normalize(u * d.x + v * d.y + normal * d.z);
}

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

      const Vec3f direction = CosineDirection(at.normal, random);
      const RayHit hit = rayScene_.Closest(at.position, direction);
      ++*rays;
      if (hit.face < 0) return !sources_.Sky(direction).IsBlack();
      const Vec3f front = hit.front;
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
  LightReceiver at;
  at.position =
      PlaceOnTriangle(mesh.Corner(element, 0), mesh.Corner(element, 1), mesh.Corner(element, 2), b);
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

/// A side of a face: 2 face + side.
using SideId = int64_t;

/// The search for light on all sides of a scene's faces.
class LitSideSearch {
 public:
  LitSideSearch(const Scene& scene, const UniformMesh& mesh, const RayScene& rayScene,
                const SourceLight& sources)
      : scene_(scene),
        mesh_(mesh),
        rayScene_(rayScene),
        seeker_(scene, rayScene, sources),
        first_(FirstElements(mesh, scene.mesh.FaceCount())),
        topology_(ConnectFaces(scene.mesh)),
        doubled_(scene.mesh) {}

  /// Those of `sides` that are lit by as many paths, or one from every element; in order.
  std::vector<SideId> Lit(const std::vector<SideId>& sides, int64_t leastPaths,
                          int64_t* rays) const {
    std::vector<uint8_t> isLit(sides.size(), 0);
    std::vector<int64_t> cast(sides.size(), 0);
    ParallelForEach(int64_t(sides.size()), 1, [&](int64_t i) {
      isLit[size_t(i)] = IsLit(sides[size_t(i)], leastPaths, &cast[size_t(i)]) ? 1 : 0;
    });
    std::vector<SideId> lit;
    for (size_t i = 0; i < sides.size(); ++i) {
      if (isLit[i]) lit.push_back(sides[i]);
      *rays += cast[i];
    }
    return lit;
  }

  /// Where there may be light because `lit` sides are: beside them across an edge, and where rays
  /// from them arrive. In order, each once.
  std::vector<SideId> Hints(const std::vector<SideId>& lit, int64_t* rays) const {
    constexpr size_t kPerSide = 3 + kArrivals;
    std::vector<SideId> hints(lit.size() * kPerSide, -1);
    ParallelForEach(int64_t(lit.size()), 64, [&](int64_t i) {
      SideId* hint = &hints[size_t(i) * kPerSide];
      for (int corner = 0; corner < 3; ++corner) *hint++ = Beside(lit[size_t(i)], corner);
      Random random(HashBits(uint64_t(lit[size_t(i)]), 0x61727269u));
      for (int ray = 0; ray < kArrivals; ++ray) *hint++ = Arrival(lit[size_t(i)], &random);
    });
    *rays += int64_t(lit.size()) * kArrivals;
    std::sort(hints.begin(), hints.end());
    hints.erase(std::unique(hints.begin(), hints.end()), hints.end());
    if (!hints.empty() && hints.front() < 0) hints.erase(hints.begin());
    return hints;
  }

 private:
  bool IsLit(SideId id, int64_t leastPaths, int64_t* cast) const {
    const int64_t face = id / 2;
    const Side side = id % 2 ? kBack : kFront;
    if (doubled_.IsHidden(face, side)) return false;
    if (scene_.mesh.Emits(face, side) && !scene_.mesh.emittance[size_t(face)].IsBlack())
      return true;
    int found = 0;
    Random random(HashBits(HashBits(uint64_t(face), uint64_t(side)), uint64_t(leastPaths)));
    const int64_t paths = std::max(leastPaths, ElementCount(face));
    const int64_t without = std::max(kPathsWithout, ElementCount(face));
    for (int64_t path = 0; path < paths && (found > 0 || path < without); ++path) {
      const LightReceiver at = Place(face, side, path, &random);
      if (LengthSquared(at.normal) == 0) continue;
      found += seeker_.FindsLight(at, &random, cast) ? 1 : 0;
      if (found > kLeaking * double(paths)) return true;
    }
    return false;
  }

  /// The side of the face across an edge on which one comes out that walks over it; -1: none.
  SideId Beside(SideId id, int corner) const {
    const int64_t edge = 3 * (id / 2) + corner;
    const int32_t across = topology_.neighbor[size_t(edge)];
    if (across < 0) return -1;
    // Alike where the two faces run along their edge in opposite directions.
    const bool isAlike = Position(edge) != Position(across);
    return 2 * (across / 3) + (isAlike ? id % 2 : 1 - id % 2);
  }
  int32_t Position(int64_t halfEdge) const {
    const auto& corners = scene_.mesh.triangles[size_t(halfEdge / 3)];
    return topology_.positionId[size_t(corners[size_t(halfEdge % 3)])];
  }

  /// The side that a ray from a lit one meets; -1: none.
  SideId Arrival(SideId id, Random* random) const {
    const LightReceiver at =
        Place(id / 2, id % 2 ? kBack : kFront, int64_t(random->Bits() >> 1), random);
    if (LengthSquared(at.normal) == 0) return -1;
    const Vec3f direction = CosineDirection(at.normal, random);
    const RayHit hit = rayScene_.Closest(at.position, direction);
    if (hit.face < 0) return -1;
    return 2 * int64_t(hit.face) + (Dot(hit.front, direction) < 0 ? 0 : 1);
  }

  int64_t ElementCount(int64_t face) const {
    return first_[size_t(face) + 1] - first_[size_t(face)];
  }
  /// A stride that shares no factor with most counts spreads the first paths over the face.
  LightReceiver Place(int64_t face, Side side, int64_t path, Random* random) const {
    const int64_t count = ElementCount(face);
    const int64_t element = first_[size_t(face)] + path % count * 7919 % count;
    return PlaceOn(mesh_, element, side, rayScene_.Epsilon(), random);
  }

  const Scene& scene_;
  const UniformMesh& mesh_;
  const RayScene& rayScene_;
  const LightSeeker seeker_;
  const std::vector<int64_t> first_;  ///< element of each face
  const MeshTopology topology_;
  const DoubledFaces doubled_;
};

}  // namespace

std::vector<uint8_t> FindLitFaces(const Scene& scene, const UniformMesh& mesh,
                                  const RayScene& rayScene, const SourceLight& sources,
                                  int64_t* rays) {
  const size_t faces = size_t(scene.mesh.FaceCount());
  std::vector<uint8_t> lit(faces, 0), doubted(faces, 0);
  std::vector<SideId> sides(2 * faces);
  std::iota(sides.begin(), sides.end(), 0);

  // What few paths find; then, from there, what they missed, until light spreads no farther.
  const LitSideSearch search(scene, mesh, rayScene, sources);
  std::vector<SideId> fresh = search.Lit(sides, kPathsPerSide, rays);
  while (!fresh.empty()) {
    for (const SideId id : fresh) lit[size_t(id / 2)] |= uint8_t(1 << id % 2);
    std::vector<SideId> doubtful;
    for (const SideId id : search.Hints(fresh, rays)) {
      const uint8_t bit = uint8_t(1 << id % 2);
      if ((lit[size_t(id / 2)] | doubted[size_t(id / 2)]) & bit) continue;
      doubted[size_t(id / 2)] |= bit;
      doubtful.push_back(id);
    }
    fresh = search.Lit(doubtful, kPathsOfDoubt, rays);
  }
  return lit;
}

}  // namespace lambert
