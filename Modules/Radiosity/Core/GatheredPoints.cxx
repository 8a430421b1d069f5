#include "Radiosity/Core/GatheredPoints.h"

#include <algorithm>
#include <cmath>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {

/// A point tells of places as far as this part of the harmonic mean distance of what it sees.
constexpr float kReach = 0.5f;
/// Rays to emitters that every point casts at first; fewer do not know their groups.
constexpr int kFirstDirectRays = 4;
/// Points that stand for more area than the mean get up to this many times the rays to emitters.
constexpr double kMostByArea = 16;
/// What a point is thought to see of the emitters where no neighbour tells.
constexpr double kUnknownClear = 0.25;
/// Half shadow that scatters so much as a relative variance a ray gets the wanted number of rays;
/// any other one a multiple between these.
constexpr double kUsualScatter = 0.25, kLeastByScatter = 0.25, kMostByScatter = 8;
/// Neighbours whose shadows tell of a point's own, where there are at least the first number: what
/// fewer find in narrow places may all be chance.
constexpr int kLeastShadowNeighbours = 8, kShadowNeighbours = 12;
/// Differences of light are held against the scatter of rays to emitters in this part: counted in
/// full, edges of shadows are taken for scatter.
constexpr float kDirectScatter = 1.f / 3;
/// What the bands together scatter by, up to so many times what their mean does.
constexpr float kMostOfBands = 9;
/// A point's scatter counts in this part by the area that it stands for, else as one of all points.
constexpr double kByArea = 0.75;
/// Bounced light that scatters by more than this part of the light at a point, or of the mean where
/// that is more, is seen as a blotch, however little it adds to the error.
constexpr double kBlotch = 0.2;
/// Rounds of more rays; in one a point gets up to this many times the rays it had.
constexpr int kRounds = 3;
constexpr int kMostGrowth = 16;
/// Numbers of rays are powers of two; above this part of one they are rounded up to it.
constexpr double kRoundUp = 0.7;

}  // namespace

double ErrorWeight(double light, double mean, double meanSquare) {
  const double calm = std::min(1.0, kBlazing * mean / std::max(light, mean));
  const double bound = std::max(light, mean);
  return std::max(calm * calm / meanSquare, 1 / (bound * bound));
}

std::vector<GatheredPoints::Light> GatheredPoints::At(const std::vector<Point>& points,
                                                      int64_t* rays,
                                                      const ProgressCallback& progress) {
  // Which are new.
  const int32_t first = int32_t(records_.size());
  std::vector<int32_t> recordOfPoint(points.size());
  if (records_.empty()) records_.reserve(2 * points.size());  // With room for what is cut later.
  for (size_t p = 0; p < points.size(); ++p) {
    recordOfPoint[p] = this->FindOrAdd(points[p]);
    records_[size_t(recordOfPoint[p])].at.area = points[p].at.area;
  }

  // Their light; then more rays where all of it still scatters.
  if (first < int32_t(records_.size())) {
    this->GatherNew(first, rays, progress);
    this->SampleAll();
    const SampleNeighbours neighbours(samples_, first, &gather_.Rays(), rays);
    this->LookIntoPenumbrae(first, Which::All, neighbours, rays);
    this->ShareDirect(first, neighbours);
    this->GatherWhereItScatters(first, neighbours, rays, progress);
    samples_ = std::vector<IrradianceSample>();
  }
  std::vector<Light> lights(points.size());
  ParallelForEach(int64_t(points.size()), 1024, [&](int64_t p) {
    const int32_t index = recordOfPoint[size_t(p)];
    const Record& record = records_[size_t(index)];
    lights[size_t(p)] = {record.shared + record.bounced.irradiance,
                         record.bounced.variance + kDirectScatter * record.sharedVariance,
                         index >= first};
  });
  return lights;
}

int32_t GatheredPoints::FindOrAdd(const Point& point) {
  const auto placeOf = [&](uint64_t key) {
    size_t place = size_t(HashBits(key)) & (recordOfKey_.size() - 1);
    while (recordOfKey_[place] >= 0 && records_[size_t(recordOfKey_[place])].key != key) {
      place = (place + 1) & (recordOfKey_.size() - 1);
    }
    return place;
  };
  if (2 * records_.size() >= recordOfKey_.size()) {
    recordOfKey_.assign(std::max<size_t>(1024, 2 * recordOfKey_.size()), -1);
    for (size_t i = 0; i < records_.size(); ++i) {
      recordOfKey_[placeOf(records_[i].key)] = int32_t(i);
    }
  }
  int32_t& record = recordOfKey_[placeOf(point.key)];
  if (record < 0) {
    record = int32_t(records_.size());
    if (records_.size() == records_.capacity()) records_.reserve(records_.size() * 5 / 4 + 1024);
    records_.push_back({point.key, point.at, point.isProbe, {}, 0, {}, {}, {}, 0});
    deliveredCount_ += point.isProbe ? 0 : 1;
  }
  return record;
}

IrradianceSample GatheredPoints::SampleOf(const Record& record) const {
  const BounceSum& b = record.bounces;
  // What sees nothing at all sees the same everywhere.
  const float reach = kReach * float(b.rays) / std::max(b.nearness, 1e-30f);
  return {record.at.position, record.at.normal, b.Mean(), b.Variance(), float(b.rays), reach};
}

void GatheredPoints::GatherNew(int32_t first, int64_t* rays, const ProgressCallback& progress) {
  std::vector<GatherPoint> places(records_.size() - size_t(first));
  for (size_t i = 0; i < places.size(); ++i) places[i] = records_[size_t(first) + i].at;
  BounceRays bounce;
  bounce.count = options_.firstRays;
  bounce.first = uint32_t(first);
  bounce.seed = HashBits(options_.seed);
  const std::vector<BounceSum> sums = gather_.Bounces(places, bounce, rays, progress);

  std::vector<int64_t> cast(places.size(), 0);
  ParallelForEach(int64_t(places.size()), 64, [&](int64_t i) {
    Record& record = records_[size_t(first + i)];
    record.bounces = sums[size_t(i)];
    record.direct =
        gather_.Direct().Sample(record.at, kFirstDirectRays,
                                HashBits(options_.seed, uint64_t(first + i)), &cast[size_t(i)]);
  });
  for (const int64_t c : cast) *rays += c;
}

void GatheredPoints::SampleAll() {
  samples_.resize(records_.size());
  ParallelForEach(int64_t(records_.size()), 1024,
                  [&](int64_t i) { samples_[size_t(i)] = this->SampleOf(records_[size_t(i)]); });
}

// Few rays are enough in full light and in full shadow, where all neighbours are there too. Its own
// rays do not decide: those that happened to find a little light would be followed by more that
// find less, those that did not would stay dark, and light would be lost.
bool GatheredPoints::IsInPenumbra(int32_t index, const SampleNeighbours& neighbours) const {
  const int32_t* begin = neighbours.begin(index);
  const int32_t* end = std::min(neighbours.end(index), begin + kShadowNeighbours);
  if (end - begin < kLeastShadowNeighbours) return true;
  float least = 1, most = 0;
  for (const int32_t* other = begin; other != end; ++other) {
    least = std::min(least, records_[size_t(*other)].direct.clear);
    most = std::max(most, records_[size_t(*other)].direct.clear);
  }
  return most > 0 && least < 1;
}

// Relative variance that one ray to the emitters leaves at a point, by what its neighbours see of
// them; light below `mean`, W/m2, counts as that.
double GatheredPoints::ScatterOfShadow(int32_t index, const SampleNeighbours& neighbours,
                                       double mean) const {
  const int32_t* begin = neighbours.begin(index);
  const int32_t* end = std::min(neighbours.end(index), begin + kShadowNeighbours);
  double clear = kUnknownClear;
  for (const int32_t* other = begin; other != end; ++other) {
    clear += double(records_[size_t(*other)].direct.clear);
  }
  clear /= double(end - begin + 1);
  const double unoccluded = double(records_[size_t(index)].direct.unoccluded);
  const double light = std::max(mean, clear * unoccluded);
  return light > 0 ? clear * (1 - clear) * unoccluded * unoccluded / (light * light) : 0;
}

// Casts `more` rays for each record from `first` on, and joins what they find to what is known.
void GatheredPoints::CastMoreToEmitters(const std::vector<int>& more, int32_t first,
                                        int64_t* rays) {
  std::vector<int64_t> cast(more.size(), 0);
  ParallelForEach(int64_t(more.size()), 64, [&](int64_t i) {
    if (more[size_t(i)] == 0) return;
    Record& record = records_[size_t(first + i)];
    const uint64_t seed =
        HashBits(HashBits(options_.seed, uint64_t(first + i)), uint64_t(record.directRays));
    const DirectSample rest =
        gather_.Direct().Sample(record.at, more[size_t(i)], seed, &cast[size_t(i)]);
    record.directRays += more[size_t(i)];
    const float part = float(more[size_t(i)]) / float(record.directRays);
    record.direct.irradiance = record.direct.irradiance * (1 - part) + rest.irradiance * part;
    record.direct.fromEmitters = record.direct.fromEmitters * (1 - part) + rest.fromEmitters * part;
    record.direct.squares = record.direct.squares * (1 - part) + rest.squares * part;
    record.direct.clear = record.direct.clear * (1 - part) + rest.clear * part;
  });
  for (const int64_t c : cast) *rays += c;
}

// In half shadow, and where rays pick from groups of emitters, as many as are wanted.
void GatheredPoints::LookIntoPenumbrae(int32_t first, Which which,
                                       const SampleNeighbours& neighbours, int64_t* rays) {
  double area = 0, mean = 0;
  for (const Record& record : records_) {
    area += double(record.at.area) / double(records_.size());
    mean +=
        double((record.direct.irradiance + record.bounces.Mean()).Mean()) / double(records_.size());
  }
  std::vector<int> more(records_.size() - size_t(first), 0);
  ParallelForEach(int64_t(more.size()), 256, [&](int64_t i) {
    const int32_t index = first + int32_t(i);
    const Record& record = records_[size_t(index)];
    if (which == Which::WithoutProbes && record.isProbe) return;
    const bool isPartial = this->IsInPenumbra(index, neighbours);
    const double scatter = this->ScatterOfShadow(index, neighbours, mean) / kUsualScatter;
    int wanted = 0;
    if (isPartial) {
      wanted =
          int(options_.penumbraRays * std::min(kMostByScatter, std::max(kLeastByScatter, scatter)));
    }
    if (isPartial || record.direct.isScattered) wanted += options_.directRays;
    const double part = area > 0 ? double(record.at.area) / area : 1;
    const int lacking =
        int(wanted * std::min(kMostByArea, std::max(1.0, part))) - record.directRays;
    if (lacking >= kFirstDirectRays) more[size_t(i)] = lacking;
  });
  this->CastMoreToEmitters(more, first, rays);
}

void GatheredPoints::Improve(const GatheredPointsOptions& options, int64_t* rays,
                             const ProgressCallback& progress) {
  const uint64_t seed = options_.seed;
  options_ = options;
  options_.seed = seed;
  if (records_.empty()) return;
  ++improved_;
  this->SampleAll();
  const SampleNeighbours neighbours(samples_, 0, &gather_.Rays(), rays);
  this->LookIntoPenumbrae(0, Which::WithoutProbes, neighbours, rays);
  this->ShareDirect(0, neighbours);
  this->GatherWhereItScatters(0, neighbours, rays, progress);
  samples_ = std::vector<IrradianceSample>();
}

// What is visible of the emitting faces, all neighbours heard.
void GatheredPoints::ShareDirect(int32_t first, const SampleNeighbours& neighbours) {
  visibility_.resize(records_.size());
  const auto forNew = [&](const auto& call) {
    ParallelForEach(int64_t(records_.size()) - first, 256,
                    [&](int64_t i) { call(int32_t(first + i), &records_[size_t(first + i)]); });
  };
  forNew([&](int32_t i, const Record* record) {
    const DirectSample& direct = record->direct;
    if (!(direct.unoccluded > 0)) return;
    visibility_[size_t(i)] = {direct.fromEmitters / direct.unoccluded, direct.squares,
                              float(record->directRays)};
  });

  // All judge what their neighbours saw before any of it is told.
  std::vector<float> apart(records_.size() - size_t(first));
  forNew([&](int32_t i, const Record*) {
    apart[size_t(i - first)] = StandsApart(visibility_, samples_, neighbours, i);
  });
  forNew(
      [&](int32_t i, const Record*) { visibility_[size_t(i)].apart = apart[size_t(i - first)]; });
  forNew([&](int32_t i, Record* record) {
    const FilteredVisibility filtered = FilterVisibility(visibility_, samples_, neighbours, i);
    const Spectrum visible = filtered.visible;
    const float unoccluded = record->direct.unoccluded;
    for (int band = 0; band < 3; ++band) {
      const float fromLights = record->direct.irradiance[band] - record->direct.fromEmitters[band];
      record->shared[band] =
          std::min(brightest_[band], std::max(0.f, fromLights) + visible[band] * unoccluded);
    }

    // Bands scatter as they are bright.
    const float mean = visible.Mean();
    float ofBands = 3;
    if (mean > 0) ofBands = std::min(kMostOfBands, float(SquaredNorm(visible)) / (mean * mean));
    record->sharedVariance = filtered.variance * unoccluded * unoccluded * ofBands;
  });
}

// What the bounced light is, all neighbours heard.
void GatheredPoints::Share(int32_t first, const SampleNeighbours& neighbours) {
  double usual = 0;
  for (const IrradianceSample& s : samples_) {
    usual += std::sqrt(SquaredNorm(s.irradiance)) / double(samples_.size());
  }
  const int64_t count = int64_t(records_.size()) - first;
  ParallelForEach(count, 256, [&](int64_t i) {
    const int32_t index = int32_t(first + i);
    Record& record = records_[size_t(index)];
    record.bounced = FilterIrradiance(samples_, neighbours, index, float(usual));
    // Few rays may all find the brightest of all, beside direct light from much of the hemisphere.
    for (int band = 0; band < 3; ++band) {
      const float most = std::max(0.f, brightest_[band] - record.shared[band]);
      record.bounced.irradiance[band] = std::min(most, record.bounced.irradiance[band]);
    }
  });
}

// What each new point adds to the squared relative error, by its area and as one of all points, and
// by how much its rays have to grow until its scatter is no blotch. Probes need nothing.
GatheredPoints::Scatter GatheredPoints::ScatterOfNew(int32_t first,
                                                     const SampleNeighbours& neighbours) const {
  std::vector<double> lights(records_.size());
  std::vector<float> ofRay(records_.size());
  ParallelForEach(int64_t(records_.size()), 1024, [&](int64_t i) {
    const Record& r = records_[size_t(i)];
    lights[size_t(i)] = std::sqrt(SquaredNorm(r.direct.irradiance + r.bounced.irradiance));
    ofRay[size_t(i)] = r.bounced.ofRay;
  });
  double area = 0, mean = 0, meanSquare = 0;
  for (const Record& r : records_) area += r.isProbe ? 0 : double(r.at.area);
  const double each = 1 / double(std::max<int64_t>(1, deliveredCount_));
  const auto share = [&](const Record& r) {
    if (r.isProbe) return 0.;
    return area > 0 ? kByArea * double(r.at.area) / area + (1 - kByArea) * each : each;
  };
  for (size_t i = 0; i < records_.size(); ++i) mean += share(records_[i]) * lights[i];
  Scatter scatter;
  scatter.noise.resize(records_.size(), 0);
  scatter.growth.resize(records_.size(), 1);
  if (!(mean > 0)) return scatter;
  for (size_t i = 0; i < records_.size(); ++i) {
    const double light = std::min(lights[i], kBlazing * mean);
    meanSquare += share(records_[i]) * light * light;
  }

  // Rays of a point scatter as those of its neighbours do, where that is more: if each asked itself
  // alone, those that happened to find nothing would stay dark.
  ParallelForEach(int64_t(records_.size()) - first, 256, [&](int64_t i) {
    const int32_t index = first + int32_t(i);
    const Record& r = records_[size_t(index)];
    if (r.isProbe) return;
    const int32_t* const begin = neighbours.begin(index);
    const int32_t* const end = neighbours.end(index);
    double around = 0;
    for (const int32_t* other = begin; other != end; ++other) {
      around += double(ofRay[size_t(*other)]) / double(end - begin);
    }
    const double own = double(r.bounced.ofRay), light = lights[size_t(index)];
    const double scatters =
        double(r.bounced.variance) * (own > 0 ? std::max(1.0, around / own) : 1);
    scatter.noise[size_t(index)] = share(r) * scatters * ErrorWeight(light, mean, meanSquare);
    const double unseen = kBlotch * std::max(light, mean);
    scatter.growth[size_t(index)] =
        std::min(double(kMostGrowth), std::max(1.0, scatters / (unseen * unseen)));
  });
  return scatter;
}

// Rays in proportion to the root of what they may gain, until what is left is what may be left; and
// where it would be seen all the same, more.
void GatheredPoints::GatherWhereItScatters(int32_t first, const SampleNeighbours& neighbours,
                                           int64_t* rays, const ProgressCallback& progress) {
  const double allowed = options_.noise * options_.noise;
  for (int round = 0; round < kRounds; ++round) {
    this->Share(first, neighbours);
    const Scatter scatter = this->ScatterOfNew(first, neighbours);
    double total = 0;
    std::vector<double> noises;
    for (size_t i = size_t(first); i < records_.size(); ++i) {
      if (!(scatter.noise[i] > 0)) continue;
      total += scatter.noise[i];
      noises.push_back(scatter.noise[i]);
    }

    // By which factor the rays of a point with one unit of noise grow; one that has no more than
    // its share of what may be left has enough, however much there is elsewhere.
    double low = std::sqrt(allowed / double(std::max<int64_t>(1, deliveredCount_))), high = low;
    for (const double n : noises) high = std::max(high, std::sqrt(n));
    const auto growth = [&](double n, double unit) {
      return std::min(double(kMostGrowth), std::max(1.0, std::sqrt(n) / unit));
    };
    for (int step = 0; step < 30 && total > allowed; ++step) {
      const double unit = (low + high) / 2;
      double left = 0;
      for (const double n : noises) left += n / growth(n, unit);
      (left > allowed ? high : low) = unit;
    }

    // Those that get the same number go out together; those that want the most of all get as many
    // as there are at once, and the rest in the next round.
    std::vector<double> wanted(records_.size());
    for (size_t i = size_t(first); i < records_.size(); ++i) {
      const int had = records_[i].bounces.rays;
      const double byError = total > allowed ? growth(scatter.noise[i], low) : 1;
      const double grown = std::max(byError, scatter.growth[i]);
      const double most = std::min(grown, double(options_.mostRays) / had);
      wanted[i] = std::min(had * (most - 1), double(options_.mostRays) / 2);
    }
    bool isAny = false;
    for (int count = fewestMore_; count < options_.mostRays; count *= 2) {
      std::vector<int32_t> chosen;
      std::vector<GatherPoint> places;
      for (size_t i = size_t(first); i < records_.size(); ++i) {
        if (!(wanted[i] > kRoundUp * count && wanted[i] <= 2 * kRoundUp * count)) continue;
        chosen.push_back(int32_t(i));
        places.push_back(records_[i].at);
      }
      if (chosen.empty()) continue;
      isAny = true;
      BounceRays bounce;
      bounce.count = count;
      bounce.seed =
          HashBits(HashBits(options_.seed, records_.size() + improved_), uint64_t(count + round));
      const std::vector<BounceSum> sums = gather_.Bounces(places, bounce, rays, progress);
      for (size_t k = 0; k < chosen.size(); ++k) {
        Record& record = records_[size_t(chosen[k])];
        record.bounces += sums[k];
        samples_[size_t(chosen[k])] = this->SampleOf(record);
      }
    }
    if (!isAny) return;
  }
  this->Share(first, neighbours);
}

}  // namespace lambert
