#include "Radiosity/Core/FinalGather.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Common/Core/SobolPoint.h"
#include "Radiosity/Core/LightExchange.h"

namespace lambert {

namespace {

/// Rays that go out together, those of similar directions one after the other; the points of a
/// batch.
constexpr int kRaysOfBatch = 256, kPointsOfBatch = 32;
constexpr int kDirectionCells = 8;  ///< across the square that the hemisphere is drawn from
constexpr int64_t kBatchesAtOnce = 1024;
/// A leaf nearer than this many of its radii is not taken as one.
constexpr float kNear = 1;
/// A facet that turns within a leaf receives up to this many times what its nearest sample does.
constexpr float kMostTurned = 2;
/// Samples of a leaf one of which receives more than this many times what another does, and
/// reflects this part of the mean radiosity more, may lie on two sides of a wall.
constexpr float kUneven = 3, kUnevenOverMean = 0.5f;
/// A wall is looked for this many times the length that rays skip above a leaf.
constexpr float kAboveLeaf = 2;
/// Normals whose cosine is larger than this look the same way; those of a flat leaf.
constexpr float kSameWay = 0.8f, kFlat = 0.9999f;
/// Bounces between near surfaces that are followed before a leaf is taken as one all the same.
constexpr int kMostBounces = 2;
/// In gaps narrower than this part of a leaf's radius so many are, where it reflects this part of
/// the mean radiosity or more: its samples may lie before the gap. Both sides of a gap face each
/// other: the cosine between their normals is below the negative of the other.
constexpr float kGap = 0.25f, kBrightInGap = 0.5f, kFacing = 0.7f;
constexpr int kMostBouncesInGap = 32;
/// A leaf gathers with at least and at most these multiples of the rays of one of mean area.
constexpr double kLeastRaysOfLeaf = 0.5, kMostRaysOfLeaf = 64;
/// Rays to the emitting faces from a sample of a leaf.
constexpr int kDirectRaysAtLeaves = 12;
/// Tells the rays that look around from those that gather.
constexpr uint64_t kSurvey = 0x737572766579;
/// A facet of a leaf receives up to this many times the mean of its samples.
constexpr float kMostOfMean = 4;
/// Light of which links knew less than this part comes from directions that they do not know.
constexpr float kLeastKnown = 1e-3f;

}  // namespace

/// Band by band.
static Spectrum Larger(const Spectrum& a, const Spectrum& b) {
  return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)};
}

FinalGather::FinalGather(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                         ElementLight* light)
    : hierarchy_(hierarchy),
      rayScene_(rayScene),
      light_(light),
      direct_(hierarchy.GetScene(), rayScene),
      leaves_(hierarchy) {
  received_.resize(size_t(hierarchy.Size()) * kPlacesOfLeaf);
  sampleDirect_.resize(size_t(hierarchy.Size()));
  hasGathered_.resize(size_t(hierarchy.Size()), 0);
  isUneven_.resize(size_t(hierarchy.Size()), 0);
  isUnlit_.resize(size_t(hierarchy.Size()), 0);
  isBright_.resize(size_t(hierarchy.Size()), 0);
  for (int32_t index = 0; index < hierarchy.Size(); ++index) {
    if (!hierarchy[index].IsLeaf()) continue;
    std::fill_n(received_.begin() + int64_t(index) * kPlacesOfLeaf, kPlacesOfLeaf,
                ElementIrradiance(hierarchy[index], light->irradiance[size_t(index)]));
  }
}

// Puts an irradiance into the vectors that a leaf had: they keep their directions and are as long
// as it asks for.
void FinalGather::Receive(int32_t leaf, const Spectrum& irradiance) {
  const Element& element = hierarchy_[leaf];
  VectorIrradiance& light = light_->irradiance[size_t(leaf)];
  const VectorIrradiance seen = element.TurnsToAllSides() ? light.FromAllAround() : light;
  Spectrum before;
  for (const SurfaceSample& sample : element.samples) {
    before += seen.At(sample.normal) / float(kSamplesPerElement);
  }
  for (int band = 0; band < 3; ++band) {
    Vec3f& vector = light.vector[size_t(band)];
    if (before[band] > kLeastKnown * irradiance[band]) {
      vector *= irradiance[band] / before[band];
      light.isotropic[band] *= irradiance[band] / before[band];
    } else {
      // From where is not known: from all around.
      vector = Vec3f();
      light.isotropic[band] = irradiance[band] * (element.TurnsToAllSides() ? 4.f : 1.f);
    }
  }
  light_->rowScale[size_t(leaf)] = 1;
  light_->radiosity[size_t(leaf)] = element.emittance + element.reflectance * irradiance;
}

Spectrum FinalGather::Furnace() const {
  const Scene& scene = hierarchy_.GetScene();
  const LightSources& lights = direct_.Lights();
  if (lights.HaveSamples()) return Spectrum(std::numeric_limits<float>::infinity());
  Spectrum emittance = lights.LargestRadiance() * float(kPi), reflectance;
  for (const Spectrum& e : scene.mesh.emittance) emittance = Larger(emittance, e);
  for (const Spectrum& r : scene.mesh.reflectance) reflectance = Larger(reflectance, r);
  Spectrum furnace;
  for (int band = 0; band < 3; ++band) furnace[band] = emittance[band] / (1 - reflectance[band]);
  return furnace;
}

Spectrum FinalGather::Brightest() const {
  const Spectrum furnace = this->Furnace();
  if (!furnace.IsFinite()) return furnace;
  Spectrum brightest = direct_.Lights().LargestRadiance() * float(kPi);
  for (const Spectrum& e : hierarchy_.GetScene().mesh.emittance) brightest = Larger(brightest, e);
  for (int32_t leaf = 0; leaf < hierarchy_.Size(); ++leaf) {
    if (!hasGathered_[size_t(leaf)]) continue;
    for (int k = 0; k < kSamplesPerElement; ++k) {
      const Spectrum& e = received_[size_t(leaf) * kPlacesOfLeaf + size_t(k)];
      brightest = Larger(brightest, hierarchy_[leaf].emittance + hierarchy_[leaf].reflectance * e);
    }
  }
  return brightest;
}

// Where light is gathered for a sample: at a place that others see.
GatherPoint FinalGather::PlaceOf(int32_t leaf, size_t sample) const {
  const Vec3f& normal = hierarchy_[leaf].samples[sample].normal;
  return {survey_.places[size_t(leaf)][sample], normal, normal};
}

// Straight from the sources leaves receive the same in every round. Light of which they have much
// in one sample and little in another, as behind walls, is uneven from then on.
void FinalGather::LightLeaves(const LeafRows& rows, uint64_t seed, int64_t* cast) {
  std::vector<int64_t> castBy(rows.leaves.size(), 0);
  ParallelForEach(int64_t(rows.leaves.size()), 16, [&](int64_t row) {
    const int32_t leaf = rows.leaves[size_t(row)];
    if (hasGathered_[size_t(leaf)]) return;
    const uint64_t own = HashBits(seed, uint64_t(leaf));
    for (size_t k = 0; k < kSamplesPerElement; ++k) {
      const DirectSample direct = direct_.Sample(this->PlaceOf(leaf, k), kDirectRaysAtLeaves,
                                                 HashBits(own, k), &castBy[size_t(row)]);
      sampleDirect_[size_t(leaf)][k] = direct.irradiance;
    }
  });
  double area = 0, reflected = 0;
  for (size_t row = 0; row < rows.leaves.size(); ++row) {
    *cast += castBy[row];
    const int32_t leaf = rows.leaves[row];
    Spectrum mean;
    for (const Spectrum& e : sampleDirect_[size_t(leaf)]) mean += e / float(kSamplesPerElement);
    area += rows.areas[row];
    reflected += rows.areas[row] * double((hierarchy_[leaf].reflectance * mean).Mean());
  }
  meanRadiosity_ = std::max(meanRadiosity_, float(reflected / area));
  for (const int32_t leaf : rows.leaves) {
    if (hasGathered_[size_t(leaf)]) continue;
    const auto& direct = sampleDirect_[size_t(leaf)];
    isUneven_[size_t(leaf)] = this->IsUneven(leaf, direct.data());
    isUnlit_[size_t(leaf)] =
        std::all_of(direct.begin(), direct.end(), [](const Spectrum& e) { return e.IsBlack(); });
    isBright_[size_t(leaf)] = this->IsBright(leaf, direct.data());
  }
}

// What the rays of its samples see.
void FinalGather::CastFromLeaf(size_t row, uint64_t seed, LeafRows* rows, int64_t* cast) {
  const int32_t leaf = rows->leaves[row];
  GatherPoint points[kSamplesPerElement];
  for (size_t k = 0; k < kSamplesPerElement; ++k) {
    points[k] = this->PlaceOf(leaf, k);
    rows->fromSources[row][k] = sampleDirect_[size_t(leaf)][k];
  }
  const int64_t begin = rows->begin[row];
  BounceRays bounce;
  bounce.count = int(rows->begin[row + 1] - begin) / kSamplesPerElement;
  bounce.seed = seed;
  this->CastBatch(points, kSamplesPerElement, bounce, cast, [&](int ray, const Seen& seen) {
    rows->fromSources[row][size_t(ray / bounce.count)] += seen.fromSources / float(bounce.count);
    if (seen.place < 0) return;
    rows->rays[size_t(begin + ray)] = {int32_t(seen.place / kPlacesOfLeaf),
                                       int32_t(seen.place % kPlacesOfLeaf), seen.part};
  });
}

// From the leaves that reflect, in proportion to their area.
LeafRows FinalGather::CastFromLeaves(int rays, uint64_t seed, int64_t* cast) {
  LeafRows rows;
  double area = 0;
  for (int32_t index = 0; index < hierarchy_.Size(); ++index) {
    const Element& e = hierarchy_[index];
    const bool isSurface = !e.IsVolume() && e.kind != ElementKind::Light;
    if (!e.IsLeaf() || !isSurface || e.reflectance.IsBlack() || !(e.area > 0)) continue;
    rows.leaves.push_back(index);
    rows.areas.push_back(e.area);
    area += double(e.area);
  }
  const double meanArea = area / double(rows.leaves.size());
  rows.begin = {0};
  for (const int32_t leaf : rows.leaves) {
    const double part = std::min(
        kMostRaysOfLeaf, std::max(kLeastRaysOfLeaf, double(hierarchy_[leaf].area) / meanArea));
    int count = 1;
    while (count * kSamplesPerElement < int(rays * part)) count *= 2;
    rows.begin.push_back(rows.begin.back() + count * kSamplesPerElement);
  }
  rows.rays.resize(size_t(rows.begin.back()));
  rows.fromSources.resize(rows.leaves.size());

  if (survey_.places.empty()) {
    survey_ = SurveyLeaves(hierarchy_, rayScene_, rows, leaves_, HashBits(seed, kSurvey), cast);
  }
  this->LightLeaves(rows, seed, cast);
  std::vector<int64_t> castBy(rows.leaves.size(), 0);
  ParallelForEach(int64_t(rows.leaves.size()), 16, [&](int64_t row) {
    this->CastFromLeaf(size_t(row), HashBits(seed, uint64_t(rows.leaves[size_t(row)])), &rows,
                       &castBy[size_t(row)]);
  });
  for (const int64_t c : castBy) *cast += c;
  return rows;
}

void FinalGather::GatherAtLeaves(int rays, double share, uint64_t seed, int64_t* cast) {
  const LeafRows rows = this->CastFromLeaves(rays, seed, cast);
  if (rows.leaves.empty()) return;
  const std::vector<Spectrum> balanced = BalanceLeaves(rows, received_, this->Furnace());
  double area = 0, reflected = 0;
  for (const int32_t leaf : rows.leaves) {
    for (size_t k = 0; k < kPlacesOfLeaf; ++k) {
      Spectrum& e = received_[size_t(leaf) * kPlacesOfLeaf + k];
      e = e * float(1 - share) + balanced[size_t(leaf) * kPlacesOfLeaf + k] * float(share);
    }
    const Element& element = hierarchy_[leaf];
    const Spectrum& mean = received_[size_t(leaf) * kPlacesOfLeaf + kMean];
    this->Receive(leaf, mean);
    hasGathered_[size_t(leaf)] = 1;
    area += double(element.area);
    reflected += double(element.area) * double((element.reflectance * mean).Mean());
  }
  meanRadiosity_ = float(reflected / area);
  for (const int32_t leaf : rows.leaves) {
    const Spectrum* const atSamples = &received_[size_t(leaf) * kPlacesOfLeaf];
    isUneven_[size_t(leaf)] = this->IsUneven(leaf, atSamples);
    isBright_[size_t(leaf)] = this->IsBright(leaf, atSamples);
  }
}

// How much more a facet of a leaf receives when it turns, by the leaf's irradiance vectors.
float FinalGather::TurnedTo(int32_t leaf, const Vec3f& from, const Vec3f& to) const {
  const Element& element = hierarchy_[leaf];
  if (element.IsPolygon()) return 1;
  const VectorIrradiance& vectors = light_->irradiance[size_t(leaf)];
  const VectorIrradiance light = element.TurnsToAllSides() ? vectors.FromAllAround() : vectors;
  const float before = light.At(from).Mean(), after = light.At(to).Mean();
  return before > 0 ? std::min(kMostTurned, after / before) : 1;
}

// Some of its samples are much brighter than others; not of a leaf that bends, which hides itself.
bool FinalGather::IsUneven(int32_t leaf, const Spectrum* atSamples) const {
  const Element& element = hierarchy_[leaf];
  for (const SurfaceSample& sample : element.samples) {
    if (Dot(sample.normal, element.samples[0].normal) < kFlat) return false;
  }
  float least = std::numeric_limits<float>::max(), most = 0;
  for (size_t k = 0; k < kSamplesPerElement; ++k) {
    const float irradiance = atSamples[k].Mean();
    least = std::min(least, irradiance);
    most = std::max(most, irradiance);
  }
  const float reflected = element.reflectance.Mean() * (most - least);
  return most > kUneven * least && reflected > kUnevenOverMean * meanRadiosity_;
}

bool FinalGather::IsBright(int32_t leaf, const Spectrum* atSamples) const {
  float most = 0;
  for (size_t k = 0; k < kSamplesPerElement; ++k) {
    most = std::max(most, (hierarchy_[leaf].reflectance * atSamples[k]).Mean());
  }
  return most >= kBrightInGap * meanRadiosity_;
}

// The nearest sample of a leaf that looks the same way, -1 where none does. One behind a wall that
// stands on the leaf tells nothing of this place; where all do, the darkest is taken.
int FinalGather::TellingSample(int32_t leaf, const Vec3f& place, const Vec3f& normal,
                               int64_t* rays) const {
  const Element& element = hierarchy_[leaf];
  const bool asks = isUneven_[size_t(leaf)];
  const Vec3f above = normal * (kAboveLeaf * rayScene_.Epsilon());
  std::array<bool, kSamplesPerElement> isHidden{};
  int darkest = -1;
  for (;;) {
    // The nearest that is left.
    int nearest = -1;
    float least = std::numeric_limits<float>::max();
    for (int k = 0; k < kSamplesPerElement; ++k) {
      const SurfaceSample& sample = element.samples[size_t(k)];
      const float distance = LengthSquared(sample.position - place);
      if (isHidden[size_t(k)] || distance >= least || Dot(sample.normal, normal) < kSameWay) {
        continue;
      }
      nearest = k;
      least = distance;
    }
    if (nearest < 0 || !asks) return nearest < 0 ? darkest : nearest;

    // Whether it lies behind a wall.
    const Vec3f& position = survey_.places[size_t(leaf)][size_t(nearest)];
    ++*rays;
    if (!rayScene_.Occluded(place + above, position + above)) return nearest;
    isHidden[size_t(nearest)] = true;
    const Spectrum* const atSample = &received_[size_t(leaf) * kPlacesOfLeaf];
    if (darkest < 0 || atSample[nearest].Mean() < atSample[darkest].Mean()) {
      darkest = nearest;
    }
  }
}

// The same from the mean of its samples on.
Spectrum FinalGather::TurnedFromMean(int32_t leaf, const Vec3f& to) const {
  const Element& element = hierarchy_[leaf];
  if (element.IsPolygon()) return Spectrum(1.f);
  const VectorIrradiance& vectors = light_->irradiance[size_t(leaf)];
  const VectorIrradiance light = element.TurnsToAllSides() ? vectors.FromAllAround() : vectors;
  const Spectrum before = ElementIrradiance(element, vectors), after = light.At(to);
  Spectrum turned(1.f);
  for (int band = 0; band < 3; ++band) {
    if (before[band] > 0) turned[band] = std::min(kMostOfMean, after[band] / before[band]);
  }
  return turned;
}

// As a ray meets it, after so many bounces that were followed; `facing`: the cosine between the
// normals of both ends.
bool FinalGather::IsTakenAsOne(int32_t leaf, const RayHit& hit, float facing, int followed) const {
  const Element& element = hierarchy_[leaf];
  if (hit.distance >= kNear * element.radius) return true;
  if (followed < kMostBounces) return false;
  const bool isInGap = hit.distance < kGap * element.radius && facing < -kFacing;
  if (!isInGap || followed >= kMostBouncesInGap) return true;
  return !isBright_[size_t(leaf)];
}

// Far away a leaf is as bright as it is in the mean. One nearer than its own size may be seen where
// it is not: there light is followed for another bounce, and straight from the sources where it has
// any.
FinalGather::Seen FinalGather::Met(const RayStart& from, const Vec3f& direction, Random* random,
                                   int followed, int64_t* rays) const {
  ++*rays;
  Seen seen;
  const RayHit hit = rayScene_.Closest(from, direction);
  if (hit.face < 0) {
    seen.fromSources = direct_.Lights().Radiance(direction) * float(kPi);
    return seen;
  }
  seen.distance = hit.distance;
  const Spectrum& reflectance = hierarchy_.GetScene().mesh.reflectance[size_t(hit.face)];
  if (reflectance.IsBlack()) return seen;
  const Side side = Dot(hit.front, direction) < 0 ? kFront : kBack;
  const Vec3f normal = side == kFront ? hit.front : -hit.front;
  const Vec3f place = from.position + direction * hit.distance;
  const int32_t leaf = leaves_.Find(hit.face, side, place);
  if (leaf < 0) return seen;
  const Element& element = hierarchy_[leaf];
  if (this->IsTakenAsOne(leaf, hit, Dot(from.normal, normal), followed)) {
    // The sample that tells of the place.
    const int k = this->TellingSample(leaf, place, normal, rays);
    seen.place = int64_t(leaf) * kPlacesOfLeaf + (k < 0 ? kMean : k);
    seen.part = reflectance;
    seen.turned = k < 0 ? this->TurnedFromMean(leaf, normal)
                        : Spectrum(this->TurnedTo(leaf, element.samples[size_t(k)].normal, normal));
    return seen;
  }

  // One direction stands for all of them; deep in a gap some stand for all that come as far.
  Spectrum reflected = reflectance;
  if (followed >= kMostBounces) {
    const float most = reflectance.MaxBand();
    if (random->Uniform() >= most) return seen;
    reflected = reflectance / most;
  }
  const GatherPoint at{place, normal, normal};
  Vec3f u, v;
  CoordinateSystem(normal, &u, &v);
  const Vec3f d = CosineHemisphere(random->Uniform(), random->Uniform());
  const uint64_t seed = random->Bits();
  const Spectrum direct =
      isUnlit_[size_t(leaf)] ? Spectrum() : direct_.Sample(at, 1, seed, rays).irradiance;
  const Seen next =
      this->Met({place, normal}, u * d.x + v * d.y + normal * d.z, random, followed + 1, rays);
  seen.fromSources = reflected * (direct + next.fromSources);
  seen.part = reflected * next.part;
  seen.turned = next.turned;
  seen.place = next.place;
  return seen;
}

// Each point has an aligned block of the sequence, so that neighbours fill the gaps between each
// other's rays.
template <class Use>
void FinalGather::CastBatch(const GatherPoint* points, int count, const BounceRays& rays,
                            int64_t* cast, const Use& use) const {
  // Directions, sorted.
  struct Ray {
    Vec2f place;
    int point;
    uint32_t index;
    int next;
  };
  std::array<Ray, kRaysOfBatch> batch;
  std::array<Vec3f, kPointsOfBatch> u, v;
  for (int i = 0; i < count; ++i) {
    CoordinateSystem(points[i].normal, &u[size_t(i)], &v[size_t(i)]);
  }
  const int all = count * rays.count;
  for (int begin = 0; begin < all; begin += kRaysOfBatch) {
    std::array<int, kDirectionCells * kDirectionCells> cells;
    cells.fill(-1);
    const int size = std::min(kRaysOfBatch, all - begin);
    for (int r = size - 1; r >= 0; --r) {
      Ray& ray = batch[size_t(r)];
      ray.point = (begin + r) / rays.count;
      ray.index = rays.first * uint32_t(rays.count) + uint32_t(begin + r);
      ray.place = SobolPoint(ray.index, rays.seed);
      const int row = int(ray.place.y * kDirectionCells),
                column = int(ray.place.x * kDirectionCells);
      int& cell =
          cells[size_t(row * kDirectionCells + (row % 2 ? kDirectionCells - 1 - column : column))];
      ray.next = cell;
      cell = r;
    }

    // What they meet.
    for (int r : cells) {
      for (; r >= 0; r = batch[size_t(r)].next) {
        const Ray& ray = batch[size_t(r)];
        const GatherPoint& at = points[ray.point];
        const Vec3f d = CosineHemisphere(ray.place.x, ray.place.y);
        const Vec3f direction =
            u[size_t(ray.point)] * d.x + v[size_t(ray.point)] * d.y + at.normal * d.z;
        if (Dot(direction, at.geometricNormal) <= 0) continue;
        Random random(HashBits(rays.seed, ray.index));
        use(begin + r, this->Met({at.position, at.geometricNormal}, direction, &random, 0, cast));
      }
    }
  }
}

std::vector<BounceSum> FinalGather::Bounces(const std::vector<GatherPoint>& points,
                                            const BounceRays& rays, int64_t* cast,
                                            const ProgressCallback& progress) const {
  std::vector<BounceSum> sums(points.size());
  const int64_t batches = (int64_t(points.size()) + kPointsOfBatch - 1) / kPointsOfBatch;
  std::vector<int64_t> castBy(size_t(batches), 0);
  for (int64_t begin = 0; begin < batches; begin += kBatchesAtOnce) {
    if (!Report(progress, double(begin) / double(batches), "gathering")) throw Cancelled();
    ParallelForEach(std::min(kBatchesAtOnce, batches - begin), 1, [&](int64_t i) {
      const int64_t first = (begin + i) * kPointsOfBatch;
      const int count = int(std::min<int64_t>(kPointsOfBatch, int64_t(points.size()) - first));
      BounceRays own = rays;
      own.first += uint32_t(first);
      BounceSum* const sum = &sums[size_t(first)];
      for (int p = 0; p < count; ++p) sum[p].rays = rays.count;
      this->CastBatch(&points[size_t(first)], count, own, &castBy[size_t(begin + i)],
                      [&](int ray, const Seen& seen) {
                        const Spectrum light = this->RadiosityOf(seen);
                        BounceSum& of = sum[ray / rays.count];
                        of.radiosity += light;
                        of.squares += light.r * light.r + light.g * light.g + light.b * light.b;
                        if (seen.distance > 0) of.nearness += 1 / seen.distance;
                      });
    });
  }
  for (const int64_t c : castBy) *cast += c;
  return sums;
}

}  // namespace lambert
