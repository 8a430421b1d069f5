// The reference, asked at random points of the surfaces.
#include "AccuracyScenes.h"
#include "Common/Core/Random.h"
#include "FindByMethod.h"
#include "Reference/Core/PathTracedIrradiance.h"
#include "SurfaceMeans.h"

namespace lambert::testing {

namespace {

using Kind = Quantity::Kind;

/// Independent estimates of every quantity; their scatter is the standard error.
constexpr int kBatches = 32;
/// Bounces, a batch: where light bounces long there are fewer paths.
constexpr double kBounces = 8192;
constexpr int kFewestPaths = 1024, kPathsAPoint = 16;

/// Points over the fronts of a surface by area, evenly: a lattice with a random shift, so that the
/// mean over them has no bias.
std::vector<ReceiverPoint> PointsOver(const TriangleMesh& mesh, int material, int count,
                                      Random* random) {
  const double area = SurfaceArea(mesh, material), shift = random->UniformDouble();
  const float second = random->Uniform();
  std::vector<ReceiverPoint> points;
  double before = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    if (material >= 0 && mesh.materialId[size_t(face)] != material) continue;
    const double share = double(mesh.Area(face)) / area * count;
    while (double(points.size()) + shift < before + share) {
      const double u = (double(points.size()) + shift - before) / share;
      const Vec2f b = UniformTriangle(float(u), RadicalInverse(uint32_t(points.size()), second));
      const Vec3f a = mesh.Corner(face, 0), normal = mesh.FrontNormal(face);
      points.push_back({a + (mesh.Corner(face, 1) - a) * b.x + (mesh.Corner(face, 2) - a) * b.y,
                        normal, normal});
    }
    before += share;
  }
  return points;
}

std::vector<ReceiverPoint> PointsOf(const TriangleMesh& mesh, const Quantity& q, int paths,
                                    Random* random) {
  if (q.kind == Kind::At || q.kind == Kind::AtFacet) return {{q.position, q.normal, q.normal}};
  return PointsOver(mesh, q.kind == Kind::FormFactor ? kReceiver : q.material, paths / kPathsAPoint,
                    random);
}

int PathsABatch(const TriangleMesh& mesh) {
  float reflectance = 0;
  for (const Spectrum& rho : mesh.reflectance) reflectance = std::max(reflectance, rho.g);
  return std::max(kFewestPaths, int(kBounces * (1 - double(reflectance))));
}

}  // namespace

std::vector<Finding> FindByPathTracing(const AccuracyCase& asked) {
  const Scene scene = asked.scene();
  const PathTracedIrradiance tracer(scene);
  const int paths = PathsABatch(scene.mesh);
  Random random(1);
  std::vector<Finding> findings;
  for (const Quantity& q : asked.quantities) {
    std::vector<ReceiverPoint> points;
    for (int batch = 0; batch < kBatches; ++batch) {
      for (const ReceiverPoint& p : PointsOf(scene.mesh, q, paths, &random)) points.push_back(p);
    }
    const size_t each = points.size() / kBatches;
    PathTracedIrradianceOptions options;
    options.samples = paths / int(each);
    const std::vector<IrradianceEstimate> estimates = tracer.Estimate(points, options);

    // Mean and standard error over the batches.
    double sum = 0, squares = 0;
    for (int batch = 0; batch < kBatches; ++batch) {
      double mean = 0;
      for (size_t i = 0; i < each; ++i) {
        mean += double(estimates[size_t(batch) * each + i].irradiance.g) / double(each);
      }
      sum += mean, squares += mean * mean;
    }
    const double mean = sum / kBatches;
    const double variance = std::max(0.0, squares / kBatches - mean * mean) / (kBatches - 1);

    double factor = Scale(scene.mesh, q), emitted = 0;
    if (q.kind == Kind::MeanRadiosity) {
      const Material& material = scene.materials[size_t(std::max(0, q.material))];
      factor *= double(material.reflectance.g), emitted = double(material.emittance.g);
    }
    // 4 standard errors: with 32 batches chance misses one quantity in 3000. Seeds are fixed. And
    // single precision, 1e-4 of the light.
    findings.push_back(
        {factor * mean + emitted + q.offset, factor * (4 * std::sqrt(variance) + 1e-4 * mean)});
  }
  return findings;
}

}  // namespace lambert::testing
