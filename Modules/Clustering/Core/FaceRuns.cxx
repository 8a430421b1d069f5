#include "Clustering/Core/FaceRuns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// Of as many points as this it is known whether they have been met.
constexpr size_t kRemembered = 1024;
/// More than float arithmetic errs by in the cosine of an angle between unit vectors.
constexpr float kCosineError = 1e-4f;

/// The points of the faces [face, end), but few of them twice.
std::vector<Vec3f> PointsOfFaces(const TriangleMesh& mesh, int64_t face, int64_t end) {
  std::vector<Vec3f> points;
  std::array<int32_t, kRemembered> met;
  met.fill(-1);
  for (; face < end; ++face) {
    for (const int32_t point : mesh.triangles[size_t(face)]) {
      int32_t& last = met[size_t(point) % kRemembered];
      if (last == point) continue;
      last = point;
      points.push_back(mesh.positions[size_t(point)]);
    }
  }
  points.shrink_to_fit();
  return points;
}

float SineOf(float cosine) { return std::sqrt(std::max(0.f, 1 - cosine * cosine)); }

}  // namespace

FaceRuns::FaceRuns(const TriangleMesh& mesh)
    : mesh_(mesh), areas_(mesh.triangles.size()), runs_(mesh.triangles.size() / kFaces) {
  ParallelForEach(mesh.FaceCount(), 4096,
                  [&](int64_t face) { areas_[size_t(face)] = mesh.Area(face); });
  ParallelForEach(int64_t(runs_.size()), 16, [&](int64_t run) {
    runs_[size_t(run)] = MakeRun(mesh, run * kFaces, (run + 1) * kFaces);
  });
}

FaceRuns::Run FaceRuns::MakeRun(const TriangleMesh& mesh, int64_t first, int64_t end) {
  Run run;
  run.points = PointsOfFaces(mesh, first, end);
  for (const Vec3f& point : run.points) run.bounds.Include(point);
  run.spread = PointSpread::OfCorners(mesh, first, end);
  Vec3f sum;
  for (int64_t face = first; face < end; ++face) sum += mesh.FrontNormal(face);
  run.axis = Normalize(sum);
  if (run.axis == Vec3f()) return run;
  run.cosine = 1;
  for (int64_t face = first; face < end; ++face) {
    const Vec3f normal = mesh.FrontNormal(face);
    if (normal != Vec3f()) run.cosine = std::min(run.cosine, Dot(normal, run.axis));
  }
  return run;
}

PointSpread FaceRuns::SpreadOf(const ClusterNode& node) const {
  PointSpread spread;
  ForEachPart(
      node, [&](int32_t face, int32_t end) { spread += PointSpread::OfCorners(mesh_, face, end); },
      [&](int32_t run) { spread += runs_[size_t(run)].spread; });
  return spread;
}

// No normal is farther from `axis` than the run's axis and the farthest from that together.
float FaceRuns::LeastCosine(const Run& run, const Vec3f& axis) {
  const float toAxis = Dot(run.axis, axis);
  if (toAxis <= -run.cosine) return -1;
  return run.cosine * toAxis - SineOf(run.cosine) * SineOf(toAxis) - kCosineError;
}

float FaceRuns::LeastCosine(const ClusterNode& node, const Vec3f& axis, float negligible) const {
  float least = 1;
  const auto look = [&](int32_t face, int32_t end) {
    for (; face < end; ++face) {
      const float area = areas_[size_t(face)];
      if (area > negligible) least = std::min(least, Dot(mesh_.VectorArea(face), axis) / area);
    }
  };
  ForEachPart(node, look, [&](int32_t run) {
    if (LeastCosine(runs_[size_t(run)], axis) >= least) return;
    look(run * kFaces, (run + 1) * kFaces);
  });
  return least;
}

}  // namespace lambert
