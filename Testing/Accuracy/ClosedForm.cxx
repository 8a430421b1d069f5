// Form factors by cubature of the closed form of a polygon's irradiance, and one value of light a
// surface: exact wherever nothing stands between and light does not vary over a surface.
#include "AccuracyMethods.h"
#include "AccuracyScenes.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/PolygonIrradiance.h"
#include "FindByMethod.h"
#include "SurfaceMeans.h"

namespace lambert::testing {

namespace {

using Kind = Quantity::Kind;

/// Irradiance at a point by each surface at unit radiosity; `own` is the face that the point is on.
std::vector<double> FactorsAt(const TriangleMesh& mesh, const Vec3f& position, const Vec3f& normal,
                              int64_t own, size_t surfaces) {
  std::vector<double> factors(surfaces, 0);
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    if (face == own) continue;
    const Vec3f corners[3] = {mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2)};
    factors[size_t(mesh.materialId[size_t(face)])] +=
        Dot(PolygonIrradianceAbove(corners, 3, position, normal), Vec3d(normal));
  }
  return factors;
}

/// Form factors of the surfaces: mean over the cells of every face, n x n of them, of the closed
/// form at their centroids.
std::vector<std::vector<double>> FormFactors(const TriangleMesh& mesh, size_t surfaces, int n) {
  std::vector<std::vector<double>> byFace(size_t(mesh.FaceCount()));
  ParallelForEach(mesh.FaceCount(), 1, [&](int64_t face) {
    std::vector<double>& sum = byFace[size_t(face)];
    sum.assign(surfaces, 0);
    const Vec3f a = mesh.Corner(face, 0), u = (mesh.Corner(face, 1) - a) / float(n),
                v = (mesh.Corner(face, 2) - a) / float(n);
    for (int cell = 0; cell < 2 * n * n; ++cell) {
      const int i = cell / 2 % n, j = cell / 2 / n, upper = cell % 2;
      if (i + j + upper >= n) continue;
      const float third = upper ? 2 / 3.f : 1 / 3.f;
      const Vec3f x = a + u * (float(i) + third) + v * (float(j) + third);
      const std::vector<double> at = FactorsAt(mesh, x, mesh.FrontNormal(face), face, surfaces);
      for (size_t s = 0; s < surfaces; ++s) sum[s] += at[s] / n / n;
    }
  });
  std::vector<std::vector<double>> factors(surfaces, std::vector<double>(surfaces, 0));
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const size_t i = size_t(mesh.materialId[size_t(face)]);
    const double share = double(mesh.Area(face)) / SurfaceArea(mesh, int(i));
    for (size_t j = 0; j < surfaces; ++j) factors[i][j] += share * byFace[size_t(face)][j];
  }
  return factors;
}

/// Irradiance and radiosity of every surface: bounces until they are settled.
struct SurfaceLight {
  std::vector<double> irradiance, radiosity;
};
SurfaceLight Solve(const Scene& scene, const std::vector<std::vector<double>>& factors) {
  const size_t count = scene.materials.size();
  SurfaceLight light{std::vector<double>(count), std::vector<double>(count)};
  // At the largest reflectance 0.98 what is left after 2000 bounces is 1e-17.
  for (int bounce = 0; bounce < 2000; ++bounce) {
    for (size_t i = 0; i < count; ++i) {
      light.irradiance[i] = 0;
      for (size_t j = 0; j < count; ++j) light.irradiance[i] += factors[i][j] * light.radiosity[j];
    }
    for (size_t i = 0; i < count; ++i) {
      const Material& material = scene.materials[i];
      light.radiosity[i] =
          double(material.emittance.g) + double(material.reflectance.g) * light.irradiance[i];
    }
  }
  return light;
}

/// Mean over the surfaces that are asked for, by area.
double Mean(const Scene& scene, const std::vector<double>& light, int material) {
  if (material >= 0) return light[size_t(material)];
  double sum = 0;
  for (size_t i = 0; i < light.size(); ++i) sum += light[i] * SurfaceArea(scene.mesh, int(i));
  return sum / SurfaceArea(scene.mesh, -1);
}

std::vector<double> Answers(const Scene& scene, const std::vector<Quantity>& quantities, int n) {
  const SurfaceLight light = Solve(scene, FormFactors(scene.mesh, scene.materials.size(), n));
  std::vector<double> answers;
  for (const Quantity& q : quantities) {
    double asked = 0;
    if (q.kind == Kind::At || q.kind == Kind::AtFacet) {
      const std::vector<double> at =
          FactorsAt(scene.mesh, q.position, q.normal, -1, scene.materials.size());
      for (size_t i = 0; i < at.size(); ++i) asked += at[i] * light.radiosity[i];
    } else if (q.kind == Kind::MeanRadiosity) {
      asked = Mean(scene, light.radiosity, q.material);
    } else {
      asked = Mean(scene, light.irradiance, q.kind == Kind::FormFactor ? kReceiver : q.material);
    }
    answers.push_back(Scale(scene.mesh, q) * asked + q.offset);
  }
  return answers;
}

}  // namespace

std::vector<Finding> FindByClosedForm(const AccuracyCase& asked) {
  const Scene scene = asked.scene();
  // About as many kernels for every scene.
  const int n = std::clamp(int(1000 / scene.mesh.FaceCount()), 1, 64);
  const std::vector<double> coarse = Answers(scene, asked.quantities, n);
  const std::vector<double> fine = Answers(scene, asked.quantities, 2 * n);
  std::vector<Finding> findings;
  for (size_t i = 0; i < fine.size(); ++i) {
    // A rule of first order or better is nearer to the truth than to the same rule at twice the
    // step; and single precision of the corners.
    findings.push_back({fine[i], std::abs(fine[i] - coarse[i]) + 1e-6 * std::abs(fine[i])});
  }
  return findings;
}

}  // namespace lambert::testing
