#include "Radiosity/Core/LeafSurvey.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {

/// Of the rays that will gather light, one in so many looks around.
constexpr int64_t kPart = 4;
/// A leaf is seen from afar by what is not nearer to it than this many of its radii, and lies close
/// to what is nearer to it than this many of its own.
constexpr float kAfar = 1, kClose = 1;

/// A place at which a ray from afar meets a leaf, nearest to one of its samples.
struct SeenPlace {
  int32_t leaf;
  int32_t sample;
  Vec3f position;
};

/// What a leaf's samples find.
struct LookAround {
  std::vector<SeenPlace> seen;
  std::array<ClosePlace, kSamplesPerElement> close;
  int64_t rays = 0;
};

int32_t NearestSample(const Element& leaf, const Vec3f& place) {
  int32_t nearest = 0;
  float least = std::numeric_limits<float>::max();
  for (int32_t k = 0; k < kSamplesPerElement; ++k) {
    const float square = LengthSquared(leaf.samples[size_t(k)].position - place);
    if (square < least) nearest = k;
    least = std::min(least, square);
  }
  return nearest;
}

/// What a ray from a leaf's sample meets: a place close to the leaf, or one that it sees from afar.
class Surveyor {
 public:
  Surveyor(const ElementHierarchy& hierarchy, const RayScene& rayScene, const LeafLookup& leaves)
      : hierarchy_(hierarchy), rayScene_(rayScene), leaves_(leaves) {}

  /// `count` rays from each sample.
  LookAround From(int32_t leaf, int64_t count, uint64_t seed) const {
    LookAround look;
    Random random(HashBits(seed, uint64_t(leaf)));
    for (size_t k = 0; k < kSamplesPerElement; ++k) {
      const SurfaceSample& sample = hierarchy_[leaf].samples[k];
      Vec3f u, v;
      CoordinateSystem(sample.normal, &u, &v);
      for (int64_t i = 0; i < count; ++i) {
        const float x = random.Uniform();
        const Vec3f d = CosineHemisphere(x, random.Uniform());
        this->Follow(leaf, k, u * d.x + v * d.y + sample.normal * d.z, &look);
      }
    }
    return look;
  }

 private:
  void Follow(int32_t from, size_t k, const Vec3f& direction, LookAround* look) const {
    // The leaf that it meets.
    const SurfaceSample& sample = hierarchy_[from].samples[k];
    ++look->rays;
    const RayHit hit = rayScene_.Closest(RayStart{sample.position, sample.normal}, direction);
    if (hit.face < 0) return;
    const Side side = Dot(hit.front, direction) < 0 ? kFront : kBack;
    const Vec3f place = sample.position + direction * hit.distance;
    const int32_t leaf = leaves_.Find(hit.face, side, place);
    if (leaf < 0 || leaf == from) return;

    // Close to where the ray came from.
    const float radius = hierarchy_[from].radius;
    if (hit.distance < kClose * radius) {
      const float radii = hit.distance / radius;
      const float cover = std::abs(Dot(hit.front, direction)) / (1 + radii * radii);
      if (cover > look->close[k].cover) look->close[k] = {int32_t(hit.face), side, place, cover};
    }

    // Seen from afar.
    const Element& seen = hierarchy_[leaf];
    if (seen.IsPolygon() && hit.distance >= kAfar * seen.radius) {
      look->seen.push_back({leaf, NearestSample(seen, place), place});
    }
  }

  const ElementHierarchy& hierarchy_;
  const RayScene& rayScene_;
  const LeafLookup& leaves_;
};

}  // namespace

LeafSurvey SurveyLeaves(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                        const LeafRows& rows, const LeafLookup& leaves, uint64_t seed,
                        int64_t* cast) {
  // Around every leaf.
  const Surveyor surveyor(hierarchy, rayScene, leaves);
  std::vector<LookAround> looks(rows.leaves.size());
  ParallelForEach(int64_t(looks.size()), 16, [&](int64_t row) {
    const int64_t room = rows.begin[size_t(row) + 1] - rows.begin[size_t(row)];
    const int64_t count = std::max<int64_t>(1, room / kSamplesPerElement / kPart);
    looks[size_t(row)] = surveyor.From(rows.leaves[size_t(row)], count, seed);
  });

  // What nothing sees keeps its samples; of the places seen by one, each is drawn alike.
  LeafSurvey survey;
  survey.places.resize(size_t(hierarchy.Size()));
  for (int32_t leaf = 0; leaf < hierarchy.Size(); ++leaf) {
    for (size_t k = 0; k < kSamplesPerElement; ++k) {
      survey.places[size_t(leaf)][k] = hierarchy[leaf].samples[k].position;
    }
  }
  std::vector<std::array<int32_t, kSamplesPerElement>> seenBefore(survey.places.size());
  for (const LookAround& look : looks) {
    *cast += look.rays;
    for (const SeenPlace& seen : look.seen) {
      const uint64_t key = uint64_t(seen.leaf) * kSamplesPerElement + uint64_t(seen.sample);
      const int32_t count = ++seenBefore[size_t(seen.leaf)][size_t(seen.sample)];
      Random random(HashBits(HashBits(seed, key), uint64_t(count)));
      if (random.Uniform() * float(count) >= 1) continue;
      survey.places[size_t(seen.leaf)][size_t(seen.sample)] = seen.position;
    }
    for (const ClosePlace& close : look.close) {
      if (close.face >= 0) survey.close.push_back(close);
    }
  }
  return survey;
}

}  // namespace lambert
