#include "Radiosity/Core/LightEdges.h"

#include <algorithm>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// A half that holds this part of the change holds the edge.
constexpr float kHeld = 0.75f;
/// Rays of a point over its hemisphere, a power of two, and to the emitters.
constexpr int kBounceRays = 16, kDirectRays = 16;

/// What is known of a segment after some steps.
struct Search {
  size_t segment;
  LightEdge edge;
  Spectrum low, high;  ///< irradiance at the ends of `edge`, W/m2

  float Middle() const { return (edge.low + edge.high) / 2; }
};

GatherPoint PointAt(const LitSegment& segment, float fraction) {
  const GatherPoint &a = segment.from, &b = segment.to;
  GatherPoint at;
  at.position = a.position * (1 - fraction) + b.position * fraction;
  at.normal = Normalize(a.normal * (1 - fraction) + b.normal * fraction);
  at.geometricNormal = Normalize(a.geometricNormal * (1 - fraction) + b.geometricNormal * fraction);
  return at;
}

}  // namespace

std::vector<LightEdge> FindLightEdges(const FinalGather& gather,
                                      const std::vector<LitSegment>& segments, uint64_t seed,
                                      int64_t* rays) {
  std::vector<LightEdge> edges(segments.size());
  std::vector<Search> searches;
  for (size_t i = 0; i < segments.size(); ++i) {
    searches.push_back({i, {}, segments[i].lightFrom, segments[i].lightTo});
  }
  for (int step = 0;; ++step) {
    const auto isDone = [&](const Search& s) { return step >= segments[s.segment].steps; };
    searches.erase(std::remove_if(searches.begin(), searches.end(), isDone), searches.end());
    if (searches.empty()) return edges;

    // Light in the middles.
    std::vector<GatherPoint> middles;
    for (const Search& s : searches) middles.push_back(PointAt(segments[s.segment], s.Middle()));
    BounceRays bounce;
    bounce.count = kBounceRays;
    bounce.seed = HashBits(seed, uint64_t(step));
    const std::vector<BounceSum> bounced = gather.Bounces(middles, bounce, rays);
    std::vector<Spectrum> light(middles.size());
    std::vector<int64_t> cast(middles.size(), 0);
    ParallelForEach(int64_t(middles.size()), 64, [&](int64_t i) {
      light[size_t(i)] = bounced[size_t(i)].Mean() + gather.Direct()
                                                         .Sample(middles[size_t(i)], kDirectRays,
                                                                 HashBits(bounce.seed, uint64_t(i)),
                                                                 &cast[size_t(i)])
                                                         .irradiance;
    });
    for (const int64_t c : cast) *rays += c;

    // The halves that hold the edge.
    std::vector<Search> held;
    for (size_t i = 0; i < searches.size(); ++i) {
      Search s = searches[i];
      const double change = SquaredNorm(s.high - s.low);
      const double below = SquaredNorm(light[i] - s.low), above = SquaredNorm(s.high - light[i]);
      if (!(std::max(below, above) >= kHeld * kHeld * change)) continue;
      const float middle = s.Middle();
      if (below > above) {
        s.edge.high = middle;
        s.high = light[i];
      } else {
        s.edge.low = middle;
        s.low = light[i];
      }
      edges[s.segment] = s.edge;
      held.push_back(s);
    }
    searches = std::move(held);
  }
}

}  // namespace lambert
