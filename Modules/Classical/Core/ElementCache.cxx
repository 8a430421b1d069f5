#include "Classical/Core/ElementCache.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Timer.h"
#include "Scene/Core/DoubledFaces.h"

namespace lambert {

namespace {

/// Rays that start from one place of a cell, in four quadrants.
constexpr int kRaysPerPlace = 4;
/// Places that find out whether a side is lit.
constexpr int kProbePlaces = 2;
/// Sides whose rays are traced together.
constexpr int64_t kSidesPerBatch = 32;
/// Sweeps end where what is still to come is less than this part of all light.
constexpr double kRemainder = 1e-3;
constexpr int kMostSweeps = 2000;
/// A side is partly buried where at least this part of its places is open.
constexpr float kLeastOpen = 0.25f;
/// Less than this part of the mean irradiance is darkness.
constexpr double kDarkness = 1e-4;

struct Power {
  double r = 0, g = 0, b = 0;
  Power& operator+=(const Power& p) {
    r += p.r, g += p.g, b += p.b;
    return *this;
  }
  Power& Add(const Spectrum& s, double weight) {
    r += double(s.r) * weight, g += double(s.g) * weight, b += double(s.b) * weight;
    return *this;
  }
  Spectrum ToSpectrum() const { return {float(r), float(g), float(b)}; }
};

/// Radical inverse of `i` in base 3 (Halton 1960), with that in base 2 a set whose every beginning
/// is well spread.
float RadicalInverse3(uint32_t i, float shift) {
  float value = shift, digit = 1;
  for (; i > 0; i /= 3) value += float(i % 3) * (digit /= 3);
  return value - std::floor(value);
}

}  // namespace

void ElementCache::PathSet::Resize(size_t items) {
  ends.resize(items * size_t(places) * kRaysPerPlace, kEscaped);
  direct.resize(items * size_t(places));
  seesSource.resize(items * size_t(places), 0);
  fromLights.resize(items);
}

ElementCache::ElementCache(const Scene& scene, const RayScene& rays, const SourceLight& sources,
                           const ElementCells& cells, int paths, uint64_t seed)
    : scene_(scene),
      rays_(rays),
      sources_(sources),
      cells_(cells),
      places_(std::max(kProbePlaces, (paths + kRaysPerPlace - 1) / kRaysPerPlace)),
      seed_(seed),
      lit_(SideCount(), 0),
      irradiance_(SideCount()) {
  paths_.places = places_;
}

void ElementCache::Fill(const ProgressCallback& progress) {
  // A few paths from every side tell which are lit.
  if (!Report(progress, 0, "Finding lit sides")) throw Cancelled();
  const std::vector<int32_t> sides = OrderedSides();
  PathSet probes;
  probes.places = kProbePlaces;
  probes.Resize(sides.size());
  CastPaths(sides, 0, &probes);
  FindLitSides(sides, probes);

  // All paths from those, and from dark ones that they saw.
  if (!Report(progress, 0.2, "Casting paths")) throw Cancelled();
  std::vector<int32_t> litSides;
  for (const int32_t side : sides) {
    if (lit_[size_t(side)]) litSides.push_back(side);
  }
  AddRows(litSides);
  AddRows(DarkSidesInSight());
  PrepareRows();
  Solve(progress);
}

/// By side, whether a face of the cell can be seen there: not where doubled faces hide all.
std::vector<uint8_t> ElementCache::SeenSides() const {
  const DoubledFaces doubled(scene_.mesh);
  if (doubled.IsEmpty()) return std::vector<uint8_t>(SideCount(), 1);
  std::vector<uint8_t> seen(SideCount(), 0);
  for (int64_t face = 0; face < scene_.mesh.FaceCount(); ++face) {
    for (const Side side : {kFront, kBack}) {
      if (doubled.IsHidden(face, side)) continue;
      cells_.ForEachCell(face, [&](int32_t cell) { seen[SideIndex(cell, side)] = 1; });
    }
  }
  return seen;
}

/// Seen sides of all cells that have area; neighbours together.
std::vector<int32_t> ElementCache::OrderedSides() const {
  const std::vector<uint8_t> seen = SeenSides();
  std::vector<Vec3f> positions(SideCount()), normals(SideCount());
  ParallelForEach(cells_.Size(), 1024, [&](int64_t cell) {
    for (const Side side : {kFront, kBack}) {
      const size_t index = SideIndex(int32_t(cell), side);
      positions[index] = cells_.Center(int32_t(cell));
      normals[index] = cells_.Normal(int32_t(cell)) * (side == kFront ? 1.f : -1.f);
    }
  });
  std::vector<int32_t> order = CoherentOrder(positions, normals);
  order.erase(std::remove_if(order.begin(), order.end(),
                             [&](int32_t side) {
                               return !(cells_.Area(side / 2) > 0) || !seen[size_t(side)];
                             }),
              order.end());
  return order;
}

/// Starts the rays of one side, and asks the sources at their places.
void ElementCache::CastFrom(int32_t side, int firstPlace, size_t item, const PathSet& set,
                            RayBatch* batch, Spectrum* direct, Spectrum* fromLights,
                            int64_t* cast) const {
  Random shifts(HashBits(seed_, uint64_t(side)));
  const float shift0 = shifts.Uniform(), shift1 = shifts.Uniform();
  for (int p = 0; p < set.places; ++p) {
    // A place, and the light that comes to it straight.
    const uint32_t place = uint32_t(firstPlace + p);
    Random random(HashBits(HashBits(seed_, uint64_t(side)), uint64_t(place) + 1));
    const SurfacePlace at = cells_.Sample(side / 2, side % 2 ? kBack : kFront, &random);
    const LightReceiver receiver{at.position, at.normal, at.normal};
    const Spectrum lights = sources_.FromLights(receiver, cast);
    direct[item * size_t(set.places) + size_t(p)] =
        sources_.FromEmitters(receiver, 1, &random, cast) + lights;
    *fromLights += lights;

    // Its rays, cosine-weighted, one in each quadrant.
    Vec3f s, t;
    CoordinateSystem(at.normal, &s, &t);
    const float height = RadicalInverse(place, shift0), turn = RadicalInverse3(place, shift1);
    for (int r = 0; r < kRaysPerPlace; ++r) {
      float u = height + float(r) / kRaysPerPlace;
      if (u >= 1) u -= 1;
      const Vec3f local = CosineHemisphere(u, (float(r) + turn) / kRaysPerPlace);
      batch->Add(at.position, Normalize(s * local.x + t * local.y + at.normal * local.z));
    }
  }
}

/// Casts set->places places of every side from the number `firstPlace` on.
void ElementCache::CastPaths(const std::vector<int32_t>& sides, int firstPlace, PathSet* set) {
  const TriangleMesh& mesh = scene_.mesh;
  const int64_t count = int64_t(sides.size());
  const int64_t batches = (count + kSidesPerBatch - 1) / kSidesPerBatch;
  const size_t raysPerSide = size_t(set->places) * kRaysPerPlace;
  std::vector<int64_t> cast(size_t(batches), 0);
  ParallelFor(batches, 1, [&](int64_t firstBatch, int64_t endBatch) {
    RayBatch batch;
    for (int64_t b = firstBatch; b < endBatch; ++b) {
      batch.Clear();
      const int64_t begin = b * kSidesPerBatch, end = std::min(count, begin + kSidesPerBatch);
      for (int64_t i = begin; i < end; ++i) {
        CastFrom(sides[size_t(i)], firstPlace, size_t(i), *set, &batch, set->direct.data(),
                 &set->fromLights[size_t(i)], &cast[size_t(b)]);
      }
      batch.Trace(rays_);
      cast[size_t(b)] += batch.Size();

      // What they met.
      for (int32_t ray = 0; ray < batch.Size(); ++ray) {
        const size_t index = size_t(begin) * raysPerSide + size_t(ray);
        const size_t place = index / kRaysPerPlace;
        const RayHit& hit = batch.Hit(ray);
        if (hit.face < 0) {
          const Spectrum sky = sources_.Sky(batch.Direction(ray)) * (float(kPi) / kRaysPerPlace);
          set->direct[place] += sky;
          set->fromLights[index / raysPerSide] += sky;
        }
        if (!set->direct[place].IsBlack()) set->seesSource[place] = 1;
        if (hit.face < 0) continue;
        const Side side = Dot(mesh.VectorArea(hit.face), batch.Direction(ray)) < 0 ? kFront : kBack;
        set->ends[index] = int32_t(SideIndex(cells_.At(hit.face, hit.barycentric), side));
        if (mesh.Emits(hit.face, side) && !mesh.emittance[size_t(hit.face)].IsBlack()) {
          set->seesSource[place] = 1;
        }
      }
    }
  });
  rayCount_ += std::accumulate(cast.begin(), cast.end(), int64_t(0));
}

/// A side is lit that emits, sees a source, or sees a lit one, directly or over others.
void ElementCache::FindLitSides(const std::vector<int32_t>& sides, const PathSet& probes) {
  const size_t raysPerSide = size_t(probes.places) * kRaysPerPlace;
  for (size_t i = 0; i < sides.size(); ++i) {
    const auto sees = probes.seesSource.begin() + int64_t(i) * probes.places;
    const bool isSource = !Emittance(sides[i]).IsBlack() ||
                          std::any_of(sees, sees + probes.places, [](uint8_t s) { return s != 0; });
    lit_[size_t(sides[i])] = isSource ? 1 : 0;
  }
  for (bool changes = true; changes;) {
    changes = false;
    for (size_t i = 0; i < sides.size(); ++i) {
      if (lit_[size_t(sides[i])]) continue;
      const auto ends = probes.ends.begin() + int64_t(i * raysPerSide);
      const bool seesLit = std::any_of(ends, ends + int64_t(raysPerSide), [this](int32_t end) {
        return end >= 0 && lit_[size_t(end)] != 0;
      });
      if (seesLit) lit_[size_t(sides[i])] = 1, changes = true;
    }
  }
}

void ElementCache::AddRows(const std::vector<int32_t>& sides) {
  PathSet set;
  set.places = places_;
  set.Resize(sides.size());
  CastPaths(sides, 0, &set);
  const auto append = [](auto* all, const auto& more) {
    all->insert(all->end(), more.begin(), more.end());
  };
  append(&sideOfRow_, sides);
  append(&paths_.ends, set.ends);
  append(&paths_.direct, set.direct);
  append(&paths_.seesSource, set.seesSource);
  append(&paths_.fromLights, set.fromLights);
  for (const int32_t side : sides) lit_[size_t(side)] = 1;
}

/// A place of a lit side from which all rays meet dark ones lies within something: the side is
/// partly buried, and no ray from without meets it there.
bool ElementCache::IsBuried(size_t row, int place) const {
  const size_t index = row * size_t(places_) + size_t(place);
  if (paths_.seesSource[index]) return false;
  const auto ends = paths_.ends.begin() + int64_t(index * kRaysPerPlace);
  return std::all_of(ends, ends + kRaysPerPlace,
                     [this](int32_t end) { return end >= 0 && !lit_[size_t(end)]; });
}

/// Dark sides that a place which is not buried saw: they see it too.
std::vector<int32_t> ElementCache::DarkSidesInSight() const {
  std::vector<int32_t> found;
  for (size_t row = 0; row < sideOfRow_.size(); ++row) {
    for (int place = 0; place < places_; ++place) {
      if (IsBuried(row, place)) continue;
      const size_t first = (row * size_t(places_) + size_t(place)) * kRaysPerPlace;
      for (size_t i = first; i < first + kRaysPerPlace; ++i) {
        const int32_t end = paths_.ends[i];
        if (end >= 0 && !lit_[size_t(end)]) found.push_back(end);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Sums up what places have from the sources. Buried places are left out of the mean,
/// but not where nearly all are: that is the inside of something closed, and the others leak.
void ElementCache::PrepareRows() {
  const size_t rows = sideOfRow_.size();
  received_.assign(rows, {});
  perRay_.assign(rows, 0);
  ParallelForEach(int64_t(rows), 1024, [&](int64_t i) {
    const size_t row = size_t(i);
    int open = 0;
    Spectrum sum;
    for (int place = 0; place < places_; ++place) {
      const size_t index = row * size_t(places_) + size_t(place);
      if (IsBuried(row, place)) continue;
      ++open;
      sum += paths_.direct[index];
    }
    if (float(open) < kLeastOpen * float(places_)) open = places_;
    received_[row] = sum / float(open);
    perRay_[row] = 1 / float(open * kRaysPerPlace);
  });
}

/// Jacobi sweeps over the rows: bounce after bounce, each reads the light of the one before.
void ElementCache::Solve(const ProgressCallback& progress) {
  const Timer timer;
  const size_t rows = sideOfRow_.size();
  const size_t raysPerRow = size_t(places_) * kRaysPerPlace;
  std::vector<Spectrum> radiosity(SideCount()), next(rows);
  double before = 0;
  for (int sweep = 1; sweep <= kMostSweeps; ++sweep) {
    if (!Report(progress, 0.6, "Solving bounces")) throw Cancelled();
    // Buried places hold dark ends alone, which add nothing.
    ParallelForEach(int64_t(rows), 256, [&](int64_t row) {
      const int32_t* ends = &paths_.ends[size_t(row) * raysPerRow];
      Spectrum sum;
      for (size_t i = 0; i < raysPerRow; ++i) {
        if (ends[i] >= 0) sum += radiosity[size_t(ends[i])];
      }
      next[size_t(row)] = received_[size_t(row)] + sum * perRay_[size_t(row)];
    });

    // What this sweep added, and by its decline what is still to come.
    Power change, all;
    for (size_t row = 0; row < rows; ++row) {
      const size_t side = size_t(sideOfRow_[row]);
      const double area = double(cells_.Area(int32_t(side / 2)));
      irradiance_[side] = next[row];
      const Spectrum now = cells_.Reflectance(int32_t(side / 2)) * next[row];
      change.Add(now - radiosity[side], area);
      all.Add(now, area);
      radiosity[side] = now;
    }
    const double total = all.r + all.g + all.b;
    const double added = total > 0 ? std::abs(change.r + change.g + change.b) / total : 0;
    const double decline = before > 0 ? std::min(0.99, added / before) : 0.99;
    IterationRecord record;
    record.iteration = sweep;
    record.seconds = timer.Seconds();
    record.elements = int64_t(rows);
    record.rays = rayCount_;
    record.change = added;
    history_.push_back(record);
    before = added;
    if (added * decline / (1 - decline) < kRemainder) break;
  }
  darkness_ = float(kDarkness * MeanIrradiance());
}

/// Of lit sides by area, mean of the bands, W/m2.
double ElementCache::MeanIrradiance() const {
  double sum = 0, area = 0;
  for (const int32_t side : sideOfRow_) {
    sum += double(irradiance_[size_t(side)].Mean()) * double(cells_.Area(side / 2));
    area += double(cells_.Area(side / 2));
  }
  return area > 0 ? sum / area : 0;
}

void ElementCache::Account(SolverStatistics* statistics) const {
  statistics->patchElements = int64_t(sideOfRow_.size());
  statistics->rays += rayCount_;
  statistics->history = history_;

  // Emitted by faces, and arriving from lights and sky; absorbed; escaped.
  Power emitted, absorbed, escaped;
  const TriangleMesh& mesh = scene_.mesh;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const int sides = int(mesh.Emits(face, kFront)) + int(mesh.Emits(face, kBack));
    if (sides > 0) emitted.Add(mesh.emittance[size_t(face)], double(mesh.Area(face)) * sides);
  }
  const size_t raysPerRow = size_t(places_) * kRaysPerPlace;
  for (size_t row = 0; row < sideOfRow_.size(); ++row) {
    const int32_t side = sideOfRow_[row];
    const double area = double(cells_.Area(side / 2));
    const Spectrum& reflectance = cells_.Reflectance(side / 2);
    const Spectrum& irradiance = irradiance_[size_t(side)];
    const auto ends = paths_.ends.begin() + int64_t(row * raysPerRow);
    const double away =
        double(perRay_[row]) * double(std::count(ends, ends + int64_t(raysPerRow), kEscaped));
    absorbed.Add(irradiance - reflectance * irradiance, area);
    escaped.Add(reflectance * irradiance + Emittance(side), area * away);
    emitted.Add(paths_.fromLights[row] * perRay_[row], area * kRaysPerPlace);
  }
  statistics->emitted = emitted.ToSpectrum();
  statistics->absorbed = absorbed.ToSpectrum();
  statistics->escaped = escaped.ToSpectrum();
}

}  // namespace lambert
