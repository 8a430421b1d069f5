#include "Reference/Core/SolutionError.h"

#include <algorithm>
#include <array>
#include <vector>

#include "Common/Core/Error.h"
#include "Common/Core/Random.h"
#include "Reference/Core/PathTracedIrradiance.h"
#include "Scene/Core/DoubledFaces.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {

namespace {

/// Paths that find out whether a side that the solution leaves out is dark. A point that all of
/// them find black gets at most a few hundredths of its light by ways that they can miss.
constexpr int kDarknessSamples = 64;
constexpr int kBootstraps = 1000;

/// A place on one side of a face.
struct Place {
  int32_t face;
  Side side;
  ReceiverPoint receiver;
};

/// One receiving point, ready to be summed.
struct Comparison {
  double squaredError = 0;          ///< |E - Eref|^2 less the noise of Eref
  double squaredReference = 0;      ///< |Eref|^2 less its noise
  double variance = 0;              ///< of the noise, all bands
  double error = 0, reference = 0;  ///< |E - Eref|, |Eref|
  double delivered = 0, truth = 0;  ///< sums of the bands

  /// Squared, over its light or the mean light, which is more; without light none.
  double BoundedError(double meanReference) const {
    const double scale = std::max(reference, meanReference);
    return scale > 0 ? squaredError / (scale * scale) : 0;
  }
};

/// Places stratified by area over both sides of every face that receives: all fronts, then all
/// backs. Faces that emit do not count, but where there are no others (a furnace); nor do sides
/// that lie under doubled faces.
std::vector<Place> StratifiedPlaces(const TriangleMesh& mesh, const SolutionErrorOptions& options) {
  const int64_t count = mesh.FaceCount();
  const std::vector<bool> receives = ReceivingFaces(mesh);
  const DoubledFaces doubled(mesh);
  std::vector<double> upTo(size_t(count), 0);
  double total = 0;
  for (int64_t face = 0; face < count; ++face) {
    if (receives[size_t(face)]) total += mesh.Area(face);
    upTo[size_t(face)] = total;
  }
  std::vector<Place> places;
  if (!(total > 0)) return places;
  for (int i = 0; i < options.points; ++i) {
    Random random(HashBits(options.seed, uint64_t(i)));
    const double target = 2 * total * (i + random.UniformDouble()) / options.points;
    const Side side = target < total ? kFront : kBack;
    const auto found =
        std::upper_bound(upTo.begin(), upTo.end(), side == kFront ? target : target - total);
    if (found == upTo.end()) continue;
    const int32_t face = int32_t(found - upTo.begin());
    if (doubled.IsHidden(face, side)) continue;
    const float u = random.Uniform(), v = random.Uniform();
    places.push_back({face, side, ReceiverAt(mesh, face, side, UniformTriangle(u, v))});
  }
  return places;
}

std::vector<ReceiverPoint> Receivers(const std::vector<Place>& places) {
  std::vector<ReceiverPoint> receivers;
  receivers.reserve(places.size());
  for (const Place& place : places) receivers.push_back(place.receiver);
  return receivers;
}

/// Leaves out, at little cost, the places that are dark in the solution and in a few paths.
std::vector<Place> WithoutDarkPlaces(const std::vector<Place>& places, const SolutionLookup& lookup,
                                     const PathTracedIrradiance& tracer,
                                     const SolutionErrorOptions& options) {
  std::vector<Place> kept, doubtful;
  for (const Place& place : places) {
    (lookup.Models(place.face, place.side) ? kept : doubtful).push_back(place);
  }
  PathTracedIrradianceOptions few;
  few.samples = std::min(kDarknessSamples, options.samples);
  few.seed = HashBits(options.seed, 0x6461726bull);
  const auto light = tracer.Estimate(Receivers(doubtful), few);
  for (size_t i = 0; i < doubtful.size(); ++i) {
    if (!light[i].irradiance.IsBlack()) kept.push_back(doubtful[i]);
  }
  return kept;
}

/// True where `p` lies on the face, or nearer to it than `far`.
bool LiesOn(const TriangleMesh& mesh, int32_t face, const Vec3f& p, float far) {
  // Near one of its edges: all that needs to be known of a face whose normal is rounding.
  const Vec3f normal = mesh.FrontNormal(face);
  bool isInside = true;
  for (int c = 0; c < 3; ++c) {
    const Vec3f offset = p - mesh.Corner(face, c);
    const Vec3f edge = mesh.Corner(face, (c + 1) % 3) - mesh.Corner(face, c);
    const float square = LengthSquared(edge);
    const float t = square > 0 ? std::min(1.f, std::max(0.f, Dot(offset, edge) / square)) : 0;
    if (LengthSquared(offset - edge * t) <= far * far) return true;
    isInside =
        isInside && std::abs(Dot(offset, normal)) <= far && Dot(Cross(edge, offset), normal) >= 0;
  }
  return isInside;
}

Comparison Compare(const Spectrum& delivered, const IrradianceEstimate& reference) {
  Comparison c;
  const double error = SquaredNorm(delivered - reference.irradiance);
  const double truth = SquaredNorm(reference.irradiance);
  c.variance = SquaredNorm(reference.standardError);
  c.squaredError = error - c.variance;
  c.squaredReference = truth - c.variance;
  c.error = std::sqrt(error);
  c.reference = std::sqrt(truth);
  c.delivered = 3.0 * delivered.Mean();
  c.truth = 3.0 * reference.irradiance.Mean();
  return c;
}

/// Relative RMS error of the comparisons that `pick(i)` names.
template <class Pick>
double RelativeRms(const std::vector<Comparison>& comparisons, const Pick& pick) {
  double error = 0, reference = 0;
  for (size_t i = 0; i < comparisons.size(); ++i) {
    const Comparison& c = comparisons[pick(i)];
    error += c.squaredError;
    reference += c.squaredReference;
  }
  return error > 0 && reference > 0 ? std::sqrt(error / reference) : 0;
}

void Bootstrap(const std::vector<Comparison>& comparisons, uint64_t seed, SolutionError* error) {
  std::vector<double> values(kBootstraps);
  Random random(HashBits(seed, 0x626f6f74ull));
  for (double& value : values) {
    value = RelativeRms(comparisons, [&](size_t) {
      return size_t(random.UniformDouble() * double(comparisons.size()));
    });
  }
  std::sort(values.begin(), values.end());
  error->rmsLow = values[size_t(0.025 * kBootstraps)];
  error->rmsHigh = values[size_t(0.975 * kBootstraps)];
}

}  // namespace

ReceiverPoint ReceiverAt(const TriangleMesh& mesh, int64_t face, Side side, const Vec2f& b) {
  const std::array<int32_t, 3>& corners = mesh.triangles[size_t(face)];
  const auto interpolate = [&](const std::vector<Vec3f>& values) {
    return values[size_t(corners[0])] * (1 - b.x - b.y) + values[size_t(corners[1])] * b.x +
           values[size_t(corners[2])] * b.y;
  };
  ReceiverPoint point;
  point.position = interpolate(mesh.positions);
  point.geometricNormal = mesh.FrontNormal(face) * (side == kFront ? 1.f : -1.f);
  const Vec3f normal = mesh.normals.empty() ? Vec3f() : Normalize(interpolate(mesh.normals));
  point.normal = Dot(normal, point.geometricNormal) < 0 ? -normal : normal;
  if (LengthSquared(normal) == 0) point.normal = point.geometricNormal;
  return point;
}

std::vector<bool> ReceivingFaces(const TriangleMesh& mesh) {
  std::vector<bool> receives(mesh.triangles.size());
  bool isAny = false;
  for (size_t face = 0; face < receives.size(); ++face) {
    const bool emits = mesh.Emits(int64_t(face), kFront) || mesh.Emits(int64_t(face), kBack);
    receives[face] = !emits || mesh.emittance[face].IsBlack();
    isAny = isAny || receives[face];
  }
  if (!isAny) receives.assign(receives.size(), true);
  return receives;
}

void RequireSolutionOf(const Scene& scene, const RadiositySolution& solution) {
  constexpr float kFar = 1e-3f;  // of the diagonal; what is refined lies on its face to rounding
  const float far = kFar * scene.mesh.Bounds().Diagonal();
  const TriangleMesh& refined = solution.mesh;
  for (int64_t triangle = 0; triangle < refined.FaceCount(); ++triangle) {
    const Vec3f centre =
        (refined.Corner(triangle, 0) + refined.Corner(triangle, 1) + refined.Corner(triangle, 2)) /
        3.f;
    if (LiesOn(scene.mesh, int32_t(solution.inputFaceId[size_t(triangle)]), centre, far)) continue;
    throw Error(
        "The solution does not lie on the scene's faces; it belongs to another scene, or to the "
        "same one with its faces in another order.");
  }
}

SolutionError SummarizeError(const std::vector<Spectrum>& delivered,
                             const std::vector<IrradianceEstimate>& reference, uint64_t seed) {
  SolutionError error;
  error.points = int64_t(delivered.size());
  std::vector<Comparison> comparisons;
  double arriving = 0, truth = 0, meanReference = 0, variance = 0, squares = 0;
  for (size_t i = 0; i < delivered.size(); ++i) {
    const Comparison c = Compare(delivered[i], reference[i]);
    comparisons.push_back(c);
    arriving += c.delivered, truth += c.truth, variance += c.variance;
    meanReference += c.reference / double(delivered.size());
    squares += c.squaredReference;
  }
  // No light at all: nothing to miss.
  if (!(truth > 0)) return error;
  error.rms = RelativeRms(comparisons, [](size_t i) { return i; });
  error.bias = (arriving - truth) / truth;
  error.noise = squares > 0 ? std::sqrt(variance / squares) : 0;
  Bootstrap(comparisons, seed, &error);

  // Bounded error, and the tail of the pointwise one.
  double bounded = 0;
  std::vector<double> relative;
  for (const Comparison& c : comparisons) {
    bounded += c.BoundedError(meanReference) / double(comparisons.size());
    relative.push_back(c.error / std::max(c.reference, 1e-3 * meanReference));
  }
  error.bounded = std::sqrt(std::max(0.0, bounded));
  const auto rank = relative.begin() + int64_t(0.95 * double(relative.size() - 1));
  std::nth_element(relative.begin(), rank, relative.end());
  error.percentile95 = *rank;
  return error;
}

/// What a solution delivers at receiving points, and the truth there.
struct ErrorSample {
  std::vector<Place> places;
  std::vector<Spectrum> delivered;
  std::vector<IrradianceEstimate> truth;
  int64_t drawn = 0, missed = 0;
};

/// Draws places and adds them to the sample.
static void DrawPlaces(const Scene& scene, const SolutionLookup& lookup,
                       const PathTracedIrradiance& tracer, const SolutionErrorOptions& options,
                       ErrorSample* sample, const ProgressCallback& progress) {
  // Places that may receive light, and the truth there.
  const std::vector<Place> all = StratifiedPlaces(scene.mesh, options);
  const std::vector<Place> places = WithoutDarkPlaces(all, lookup, tracer, options);
  PathTracedIrradianceOptions trace;
  trace.samples = options.samples;
  trace.seed = options.seed;
  const auto reference = tracer.Estimate(Receivers(places), trace, progress);

  // What the solution delivers there; a side that it leaves out counts where light is sure.
  sample->drawn += int64_t(all.size());
  for (size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    if (!lookup.Models(place.face, place.side)) {
      const double noise = SquaredNorm(reference[i].standardError);
      if (SquaredNorm(reference[i].irradiance) <= 4 * noise) continue;
      ++sample->missed;
    }
    sample->places.push_back(place);
    sample->delivered.push_back(
        lookup.Irradiance(lookup.Find(place.face, place.side, place.receiver.position)));
    sample->truth.push_back(reference[i]);
  }
}

/// The points of a sample by what each adds to its bounded error.
static std::vector<ComparedPoint> ByPart(const ErrorSample& sample) {
  double meanReference = 0;
  std::vector<Comparison> comparisons;
  for (size_t i = 0; i < sample.places.size(); ++i) {
    comparisons.push_back(Compare(sample.delivered[i], sample.truth[i]));
    meanReference += comparisons.back().reference / double(sample.places.size());
  }
  double sum = 0;
  std::vector<ComparedPoint> points;
  for (size_t i = 0; i < sample.places.size(); ++i) {
    const Place& place = sample.places[i];
    const double part = comparisons[i].BoundedError(meanReference);
    sum += part;
    points.push_back(
        {place.face, place.side, place.receiver, sample.delivered[i], sample.truth[i], part});
  }
  for (ComparedPoint& point : points) point.part = sum > 0 ? point.part / sum : 0;
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.part > b.part; });
  return points;
}

SolutionError MeasureSolutionError(const Scene& scene, const RadiositySolution& solution,
                                   const SolutionErrorOptions& options,
                                   const ProgressCallback& progress,
                                   std::vector<ComparedPoint>* compared) {
  if (options.points < 1) throw Error("An error needs at least one point to be measured at.");
  const SolutionLookup lookup(solution, scene.mesh.FaceCount());
  RequireSolutionOf(scene, solution);
  const PathTracedIrradiance tracer(scene);
  const int64_t mostPaths = int64_t(options.growth) * options.points * options.samples;
  SolutionErrorOptions draw = options;
  ErrorSample sample;
  SolutionError error;
  double done = 0;
  for (uint64_t batch = 1;; ++batch) {
    const ProgressCallback half = [&](double fraction, const char* stage) {
      return Report(progress, done + (1 - done) / 2 * fraction, stage);
    };
    DrawPlaces(scene, lookup, tracer, draw, &sample, half);
    done += (1 - done) / 2;
    error = SummarizeError(sample.delivered, sample.truth, options.seed);
    error.darkPoints = sample.drawn - error.points;
    error.missedPoints = sample.missed;
    if (options.enough > 0 && error.Counting() <= options.enough) break;

    // More paths a point where their noise is more than the error, else as many points again where
    // few of them decide.
    draw.seed = HashBits(options.seed, batch);
    if (error.noise > error.Counting() && 4 * draw.samples * sample.drawn <= mostPaths) {
      draw.samples *= 4;
      draw.points = int(sample.drawn);
      sample = {};
    } else if (!error.IsRmsSure() && 2 * draw.samples * sample.drawn <= mostPaths) {
      draw.points = int(sample.drawn);
    } else {
      break;
    }
  }
  if (compared) *compared = ByPart(sample);
  return error;
}

}  // namespace lambert
