#include "Reference/Core/ErrorMap.h"

#include <algorithm>
#include <vector>

#include "Reference/Core/SolutionError.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {

namespace {

/// Per triangle, whether its face receives.
std::vector<bool> Receiving(const Scene& scene, const RadiositySolution& solution) {
  const std::vector<bool> ofFace = ReceivingFaces(scene.mesh);
  std::vector<bool> receives;
  for (const int64_t face : solution.inputFaceId) receives.push_back(ofFace[size_t(face)]);
  return receives;
}

/// Mean over the receiving area, W/m2, of the bands' mean.
double MeanLight(const TriangleMesh& mesh, const std::vector<bool>& receives,
                 const std::vector<IrradianceEstimate>& light) {
  double power = 0, area = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    if (!receives[size_t(face)]) continue;
    power += double(mesh.Area(face)) * light[size_t(face)].irradiance.Mean();
    area += double(mesh.Area(face));
  }
  return area > 0 ? power / area : 0;
}

}  // namespace

ErrorMap MapError(const Scene& scene, const RadiositySolution& solution,
                  const ErrorMapOptions& options, const ProgressCallback& progress) {
  const TriangleMesh& mesh = solution.mesh;
  const SolutionLookup delivered(solution, scene.mesh.FaceCount());
  RequireSolutionOf(scene, solution);

  // The truth in the middle of every triangle.
  std::vector<ReceiverPoint> receivers;
  receivers.reserve(mesh.triangles.size());
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    // Seen from its front: that is the side which its light is of.
    receivers.push_back(ReceiverAt(mesh, face, kFront, Vec2f(1.f / 3, 1.f / 3)));
  }
  PathTracedIrradianceOptions trace;
  trace.samples = options.samples;
  trace.seed = options.seed;
  ErrorMap map;
  map.reference = PathTracedIrradiance(scene).Estimate(receivers, trace, progress);

  // What is delivered there, against it. In the dark a fraction of the mean light is what counts.
  const std::vector<bool> receives = Receiving(scene, solution);
  const double mean = MeanLight(mesh, receives, map.reference);
  for (int32_t face = 0; face < int32_t(mesh.FaceCount()); ++face) {
    const double light = delivered.Irradiance({face, Vec3f(1, 1, 1) / 3.f}).Mean();
    const double truth = map.reference[size_t(face)].irradiance.Mean();
    const double scale = std::max(truth, mean);
    const bool counts = receives[size_t(face)] && scale > 0;
    map.relativeError.push_back(counts ? float((light - truth) / scale) : 0);
  }
  return map;
}

}  // namespace lambert
