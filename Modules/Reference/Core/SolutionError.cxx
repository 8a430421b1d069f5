#include "Reference/Core/SolutionError.h"

#include <algorithm>
#include <array>
#include <vector>

#include "Common/Core/Error.h"
#include "Common/Core/Random.h"
#include "Reference/Core/ErrorPoints.h"

namespace lambert {

namespace {

constexpr int kBootstraps = 1000;

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

/// The points by what each adds to the bounded error.
static std::vector<ComparedPoint> ByPart(const ErrorPoints& points) {
  const size_t count = points.Places().size();
  double meanReference = 0;
  std::vector<Comparison> comparisons;
  for (size_t i = 0; i < count; ++i) {
    comparisons.push_back(Compare(points.Delivered()[i], points.Truth()[i]));
    meanReference += comparisons.back().reference / double(count);
  }
  double sum = 0;
  std::vector<ComparedPoint> compared;
  for (size_t i = 0; i < count; ++i) {
    const ErrorPoints::Place& place = points.Places()[i];
    const double part = comparisons[i].BoundedError(meanReference);
    sum += part;
    compared.push_back(
        {place.face, place.side, place.receiver, points.Delivered()[i], points.Truth()[i], part});
  }
  for (ComparedPoint& point : compared) point.part = sum > 0 ? point.part / sum : 0;
  std::stable_sort(compared.begin(), compared.end(),
                   [](const auto& a, const auto& b) { return a.part > b.part; });
  return compared;
}

SolutionError MeasureSolutionError(const Scene& scene, const RadiositySolution& solution,
                                   const SolutionErrorOptions& options,
                                   const ProgressCallback& progress,
                                   std::vector<ComparedPoint>* compared) {
  if (options.points < 1) throw Error("An error needs at least one point to be measured at.");
  RequireSolutionOf(scene, solution);
  ErrorPoints points(scene, options);
  const auto isEnough = [&](const SolutionError& e) {
    return options.enough > 0 && e.Counting() <= options.enough;
  };
  const SolutionError error = points.Measure(solution, options.growth, isEnough, progress);
  if (compared) *compared = ByPart(points);
  return error;
}

}  // namespace lambert
