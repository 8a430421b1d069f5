#include "SceneSummary.h"

#include "Scene/Core/LightSource.h"

#include <set>

namespace lambert {
namespace {
/// Power of a lamp, W: the intensity integrated over rings about its axis by the midpoint rule.
Spectrum LampPower(const Light& light) {
  constexpr int kRings = 1024;
  const std::unique_ptr<LightSource> source = MakeLightSource(light);
  Vec3f u, v;
  CoordinateSystem(light.direction, &u, &v);
  SpectrumSum power;
  for (int ring = 0; ring < kRings; ++ring) {
    const float z = 1 - 2 * (static_cast<float>(ring) + 0.5f) / kRings;
    power.Add(source->Intensity(light.direction * z + u * std::sqrt(std::max(0.f, 1 - z * z))),
              4 * kPi / kRings);
  }
  return power.Total();
}
}  // namespace

SceneSummary SummarizeScene(const Scene& scene) {
  // Geometry.
  SceneSummary summary;
  const TriangleMesh& mesh = scene.mesh;
  summary.triangles = mesh.FaceCount();
  summary.points = mesh.PointCount();
  summary.parts = static_cast<int64_t>(scene.parts.size());
  summary.materials = static_cast<int64_t>(scene.materials.size());
  std::set<int32_t> meshes;
  for (const Part& part : scene.parts) {
    meshes.insert(part.meshId);
  }
  summary.meshes = static_cast<int64_t>(meshes.size());
  summary.bounds = mesh.Bounds();

  // Emitting faces.
  SpectrumSum power;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const double area = mesh.Area(face);
    const Spectrum& emittance = mesh.emittance[static_cast<size_t>(face)];
    const int sides = (mesh.Emits(face, kFront) ? 1 : 0) + (mesh.Emits(face, kBack) ? 1 : 0);
    summary.area += area;
    summary.emittingFaces += sides > 0 && !emittance.IsBlack();
    power.Add(emittance, sides * area);
  }
  summary.emittedByFaces = power.Total();

  // Lamps.
  for (const Light& light : scene.lights) {
    summary.pointLights += light.type == LightType::Point;
    summary.spotLights += light.type == LightType::Spot;
    summary.directionalLights += light.type == LightType::Directional;
    summary.skies += !light.IsPlaced() && light.type != LightType::Directional;
    if (light.IsPlaced()) {
      summary.emittedByLights += LampPower(light);
    }
  }
  return summary;
}
}  // namespace lambert
