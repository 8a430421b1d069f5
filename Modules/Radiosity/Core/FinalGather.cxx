#include "Radiosity/Core/FinalGather.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/PolygonIrradiance.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/LightExchange.h"

namespace lambert {

namespace {

/// Points whose rays go out together, stratum by stratum.
constexpr int kBatch = 32;
constexpr int64_t kBatchesAtOnce = 256;
/// A leaf nearer than this many of its radii is not taken as one.
constexpr float kNear = 1;
/// Points that stand for large areas get up to this many times the rays.
constexpr double kMostOfRays = 16;
/// Light beyond this many times the mean of a batch is rare; points whose normals make a larger
/// cosine than the other look the same way.
constexpr float kRare = 8, kAlike = 0.9f;
/// A place on a leaf is at most this many times as bright as the leaf.
constexpr float kMostOfLeaf = 16;
/// Bounces between near surfaces that are followed before a leaf is taken as one all the same.
constexpr int kMostBounces = 8;
/// A leaf gathers with at least and at most these multiples of the rays of one of mean area.
constexpr double kLeastRaysOfLeaf = 0.5, kMostRaysOfLeaf = 64;
constexpr DirectLightOptions kDirectAtLeaves{4, 8};
/// Where less than this part of the reflected light is lost in a bounce, nothing is known of its
/// balance; one step changes it by no more than this factor.
constexpr double kLeastLost = 0.01, kMostBalance = 2;
/// Light of which links knew less than this part comes from directions that they do not know.
constexpr float kLeastKnown = 1e-3f;

}  // namespace

FinalGather::FinalGather(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                         ElementLight* light)
    : hierarchy_(hierarchy),
      rayScene_(rayScene),
      light_(light),
      direct_(hierarchy.GetScene(), rayScene) {
  for (const Light& source : hierarchy.GetScene().lights) {
    if (source.type == LightType::Sky) sky_ += source.intensity * float(kPi);
  }

  // Where each side of each face lies in the hierarchy.
  const size_t faces = hierarchy.GetScene().mesh.triangles.size();
  for (std::vector<int32_t>& element : elementOfFace_) element.assign(faces, -1);
  polygonIrradiance_.resize(size_t(hierarchy.Size()));
  cuts_.resize(size_t(hierarchy.Size()));
  for (int32_t index = 0; index < hierarchy.Size(); ++index) {
    const Element& element = hierarchy[index];
    if (element.IsPolygon()) {
      polygonIrradiance_[size_t(index)] =
          ElementIrradiance(element, light->irradiance[size_t(index)]);
      if (!element.IsLeaf()) this->FindCut(index);
    }
    if (element.kind != ElementKind::Face || !(element.IsLeaf() || element.IsPolygon())) continue;
    const ClusterNode& node = hierarchy.Tree().nodes[size_t(element.item)];
    std::fill_n(elementOfFace_[element.side].begin() + node.firstFace, node.faceCount, index);
  }
}

// The edge of the first half that has all of the second behind it.
void FinalGather::FindCut(int32_t index) {
  const Element& element = hierarchy_[index];
  Vec3f first[kMaximumPolygonCorners], second[kMaximumPolygonCorners];
  const int count = hierarchy_.PolygonCorners(hierarchy_[element.child], first);
  const int others = hierarchy_.PolygonCorners(hierarchy_[element.child + 1], second);
  float least = std::numeric_limits<float>::max();
  for (int i = 0; i < count; ++i) {
    const Vec3f inward = Normalize(Cross(element.axis, first[(i + 1) % count] - first[i]));
    float farthest = std::numeric_limits<float>::lowest();
    for (int j = 0; j < others; ++j) {
      farthest = std::max(farthest, Dot(inward, second[j] - first[i]));
    }
    if (inward == Vec3f() || farthest >= least) continue;
    least = farthest;
    cuts_[size_t(index)] = {inward, -Dot(inward, first[i])};
  }
}

int32_t FinalGather::LeafAt(int64_t face, Side side, const Vec3f& position) const {
  int32_t index = elementOfFace_[side][size_t(face)];
  if (index < 0) return -1;
  while (!hierarchy_[index].IsLeaf()) {
    const Cut& cut = cuts_[size_t(index)];
    const bool isFirst = Dot(cut.normal, position) + cut.offset >= 0;
    index = hierarchy_[index].child + (isFirst ? 0 : 1);
  }
  return index;
}

// What arrives at the samples of a leaf, in the mean.
GatheredLight FinalGather::GatherAtLeaf(int32_t leaf, int rays, uint64_t seed,
                                        int64_t* cast) const {
  GatherPoint points[kSamplesPerElement];
  GatheredLight gathered[kSamplesPerElement], mean;
  for (size_t k = 0; k < kSamplesPerElement; ++k) {
    const SurfaceSample& sample = hierarchy_[leaf].samples[k];
    points[k] = {sample.position, sample.normal, sample.normal};
  }
  FinalGatherOptions options;
  options.rays = std::max(1, (rays + kSamplesPerElement / 2) / kSamplesPerElement);
  options.direct = kDirectAtLeaves;
  options.seed = seed;
  this->GatherBatch(points, 0, kSamplesPerElement, options, gathered, cast);
  for (const GatheredLight& g : gathered) {
    mean.irradiance += g.irradiance / float(kSamplesPerElement);
    mean.reflected += g.reflected / float(kSamplesPerElement);
  }
  return mean;
}

// What the leaves reflected before, R, may be too much or too little as a whole. With D from the
// sources and I from the leaves, the factor f for which f R is what they reflect of D + f I.
Spectrum FinalGather::BalancingFactor(const std::vector<int32_t>& leaves,
                                      const std::vector<GatheredLight>& gathered) const {
  double before[3] = {}, fromSources[3] = {}, fromLeaves[3] = {};
  for (size_t i = 0; i < leaves.size(); ++i) {
    const Element& e = hierarchy_[leaves[i]];
    const Spectrum had = ElementIrradiance(e, light_->irradiance[size_t(leaves[i])]);
    for (int band = 0; band < 3; ++band) {
      const double weight = double(e.area) * double(e.reflectance[band]);
      const GatheredLight& g = gathered[i];
      before[band] += weight * double(had[band]);
      fromLeaves[band] += weight * double(g.reflected[band]);
      fromSources[band] += weight * double(g.irradiance[band] - g.reflected[band]);
    }
  }
  Spectrum factor(1.f);
  for (int band = 0; band < 3; ++band) {
    const double lost = before[band] - fromLeaves[band];
    if (!(lost > kLeastLost * before[band])) continue;
    factor[band] =
        float(std::min(kMostBalance, std::max(1 / kMostBalance, fromSources[band] / lost)));
  }
  return factor;
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
  polygonIrradiance_[size_t(leaf)] = irradiance;
}

void FinalGather::GatherAtLeaves(int rays, uint64_t seed, int64_t* cast) {
  // The leaves that reflect, and their mean area.
  std::vector<int32_t> leaves;
  double area = 0;
  for (int32_t index = 0; index < hierarchy_.Size(); ++index) {
    const Element& e = hierarchy_[index];
    const bool isSurface = !e.IsVolume() && e.kind != ElementKind::Light;
    if (!e.IsLeaf() || !isSurface || e.reflectance.IsBlack() || !(e.area > 0)) continue;
    leaves.push_back(index);
    area += double(e.area);
  }
  if (leaves.empty()) return;
  const double meanArea = area / double(leaves.size());

  // All gather from what all had before.
  std::vector<GatheredLight> gathered(leaves.size());
  std::vector<int64_t> castBy(leaves.size(), 0);
  ParallelForEach(int64_t(leaves.size()), 16, [&](int64_t i) {
    const int32_t leaf = leaves[size_t(i)];
    const double part = std::min(
        kMostRaysOfLeaf, std::max(kLeastRaysOfLeaf, double(hierarchy_[leaf].area) / meanArea));
    gathered[size_t(i)] = this->GatherAtLeaf(leaf, int(rays * part), HashBits(seed, uint64_t(leaf)),
                                             &castBy[size_t(i)]);
  });

  // As a whole they reflect what they receive.
  const Spectrum factor = this->BalancingFactor(leaves, gathered);
  for (size_t i = 0; i < leaves.size(); ++i) {
    const GatheredLight& g = gathered[i];
    this->Receive(leaves[i], g.irradiance - g.reflected + factor * g.reflected);
    *cast += castBy[i];
  }
}

// Far away a leaf is as bright as it is in the mean. One nearer than its own size may be seen where
// it is not: there light is followed for another bounce.
FinalGather::Radiosity FinalGather::Met(const Vec3f& from, const Vec3f& direction, Random* random,
                                        int bounces, int64_t* rays) const {
  ++*rays;
  const RayHit hit = rayScene_.Closest(from, direction);
  if (hit.face < 0) return {sky_, {}};
  const TriangleMesh& mesh = hierarchy_.GetScene().mesh;
  const Spectrum& reflectance = mesh.reflectance[size_t(hit.face)];
  if (reflectance.IsBlack()) return {};
  const Vec3f front = mesh.FrontNormal(hit.face);
  const Side side = Dot(front, direction) < 0 ? kFront : kBack;
  const Vec3f normal = side == kFront ? front : -front;
  const Vec3f place = from + direction * hit.distance;
  const int32_t leaf = this->LeafAt(hit.face, side, place);
  if (leaf < 0) return {};
  const Element& element = hierarchy_[leaf];
  const VectorIrradiance& vectors = light_->irradiance[size_t(leaf)];
  const Spectrum ofLeaf =
      reflectance *
      (element.IsPolygon()
           ? polygonIrradiance_[size_t(leaf)]
           : (element.TurnsToAllSides() ? vectors.FromAllAround() : vectors).At(normal));
  if (bounces == 0 || hit.distance >= kNear * element.radius) return {{}, ofLeaf};

  // One direction stands for all of them: what it finds is taken up to some times the mean.
  const GatherPoint at{place, normal, normal};
  Vec3f u, v;
  CoordinateSystem(normal, &u, &v);
  const Vec3f d = CosineHemisphere(random->Uniform(), random->Uniform());
  const Spectrum direct = direct_.At(at, {1, 0}, random->Bits(), rays);
  const Radiosity next =
      this->Met(place, u * d.x + v * d.y + normal * d.z, random, bounces - 1, rays);
  Radiosity found{reflectance * (direct + next.fromSources), reflectance * next.fromLeaves};
  const float brightness = (found.fromSources + found.fromLeaves).Mean();
  const float most = kMostOfLeaf * ofLeaf.Mean();
  if (brightness > most) {
    found.fromSources *= most / brightness;
    found.fromLeaves *= most / brightness;
  }
  return found;
}

// What a few rays of a batch found far above its mean is too rare to be told place by place: what
// is beyond some times the mean goes to all points of the batch that look the same way, in equal
// parts.
static void ShareRareLight(const GatherPoint* points, int count, int strata,
                           std::vector<FinalGather::Radiosity>* met) {
  // What is rare.
  float mean = 0;
  for (const FinalGather::Radiosity& m : *met) {
    mean += (m.fromSources + m.fromLeaves).Mean() / float(met->size());
  }
  const float most = kRare * mean;
  for (int i = 0; i < count; ++i) {
    // Who shares it.
    int sharing = 0;
    for (int j = 0; j < count; ++j) sharing += Dot(points[i].normal, points[j].normal) > kAlike;
    if (sharing < 2) continue;
    for (int stratum = 0; stratum < strata; ++stratum) {
      FinalGather::Radiosity& own = (*met)[size_t(i * strata + stratum)];
      const float brightness = (own.fromSources + own.fromLeaves).Mean();
      if (!(brightness > most)) continue;
      const float part = (1 - most / brightness) / float(sharing);
      const FinalGather::Radiosity share{own.fromSources * part, own.fromLeaves * part};
      own.fromSources *= most / brightness;
      own.fromLeaves *= most / brightness;
      for (int j = 0; j < count; ++j) {
        if (!(Dot(points[i].normal, points[j].normal) > kAlike)) continue;
        FinalGather::Radiosity& theirs = (*met)[size_t(j * strata + stratum)];
        theirs.fromSources += share.fromSources;
        theirs.fromLeaves += share.fromLeaves;
      }
    }
  }
}

void FinalGather::GatherBatch(const GatherPoint* points, int64_t first, int count,
                              const FinalGatherOptions& options, GatheredLight* light,
                              int64_t* rays) const {
  // One more bounce: a jittered ray in every stratum of the cosine-weighted hemisphere.
  Vec3f u[kBatch], v[kBatch];
  for (int i = 0; i < count; ++i) CoordinateSystem(points[i].normal, &u[i], &v[i]);
  const int side = std::max(1, int(std::lround(std::sqrt(double(options.rays)))));
  const int strata = side * side;
  std::vector<Radiosity> met(size_t(count * strata));
  for (int stratum = 0; stratum < strata; ++stratum) {
    for (int i = 0; i < count; ++i) {
      const uint64_t bits =
          HashBits(HashBits(options.seed, uint64_t(first + i)), uint64_t(stratum) + 7);
      const float a = (float(stratum / side) + float(bits >> 40) * 0x1p-24f) / float(side);
      const float b = (float(stratum % side) + float(bits & 0xffffff) * 0x1p-24f) / float(side);
      const Vec3f d = CosineHemisphere(a, b);
      const Vec3f direction = u[i] * d.x + v[i] * d.y + points[i].normal * d.z;
      if (Dot(direction, points[i].geometricNormal) <= 0) continue;
      Random random(bits);
      met[size_t(i * strata + stratum)] =
          this->Met(points[i].position, direction, &random, kMostBounces, rays);
    }
  }
  ShareRareLight(points, count, strata, &met);

  // Their sum, and direct light. Two halves of the strata, like the fields of a chessboard, tell
  // how far they scatter.
  for (int i = 0; i < count; ++i) {
    Spectrum halves[2];
    light[i] = {};
    for (int stratum = 0; stratum < strata; ++stratum) {
      const Radiosity& m = met[size_t(i * strata + stratum)];
      halves[(stratum / side + stratum % side) % 2] +=
          (m.fromSources + m.fromLeaves) / float(strata);
      light[i].reflected += m.fromLeaves / float(strata);
    }
    const Spectrum scatter = halves[0] - halves[1];
    light[i].variance = scatter.r * scatter.r + scatter.g * scatter.g + scatter.b * scatter.b;
    light[i].irradiance =
        halves[0] + halves[1] +
        direct_.At(points[i], options.direct, HashBits(options.seed, uint64_t(first + i)), rays);
  }
}

std::vector<GatheredLight> FinalGather::At(const std::vector<GatherPoint>& points,
                                           const FinalGatherOptions& options, int64_t* rays,
                                           const ProgressCallback& progress) const {
  std::vector<GatheredLight> light(points.size());
  const int64_t batches = (int64_t(points.size()) + kBatch - 1) / kBatch;
  std::vector<int64_t> cast(size_t(batches), 0);
  double area = 0;
  for (const GatherPoint& point : points) area += double(point.area) / double(points.size());
  for (int64_t begin = 0; begin < batches; begin += kBatchesAtOnce) {
    if (!Report(progress, double(begin) / double(batches), "gathering")) throw Cancelled();
    ParallelForEach(std::min(kBatchesAtOnce, batches - begin), 1, [&](int64_t i) {
      const int64_t first = (begin + i) * kBatch;
      const int count = int(std::min<int64_t>(kBatch, int64_t(points.size()) - first));
      FinalGatherOptions own = options;
      if (area > 0) {
        double mean = 0;
        for (int p = 0; p < count; ++p) mean += double(points[size_t(first + p)].area) / count;
        const double factor = std::min(kMostOfRays, std::max(1.0, mean / area));
        own.rays = int(options.rays * factor);
        own.direct.rays = int(options.direct.rays * factor);
        own.direct.penumbraRays = int(options.direct.penumbraRays * factor);
      }
      this->GatherBatch(&points[size_t(first)], first, count, own, &light[size_t(first)],
                        &cast[size_t(begin + i)]);
    });
  }
  for (const int64_t c : cast) *rays += c;
  return light;
}

}  // namespace lambert
