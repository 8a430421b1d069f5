#include "Classical/Core/MatrixRadiosity.h"

#include <algorithm>
#include <cmath>

#include "Classical/Core/ElementBalance.h"
#include "Classical/Core/ExchangeMatrix.h"
#include "Classical/Core/LitFaces.h"
#include "Common/Core/Error.h"
#include "Common/Core/Timer.h"

namespace lambert {

namespace {

/// Sweeps that no scene needs: at the largest reflectance 0.98 light falls by 1e-5 in 600.
constexpr int kMaximumSweeps = 1000;

void CheckOptions(const MatrixRadiosityOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1)) {
    throw Error("The tolerance is " + std::to_string(options.tolerance) +
                "; it must lie in (0, 1).");
  }
  if (options.skyRays < 1) throw Error("An element takes at least 1 ray to the sky.");
}

/// Sweeps until what is still to come is less than the tolerance: each sweep leaves at most the
/// largest reflectance of the error before it.
void Solve(const ElementSides& sides, const ExchangeMatrix& matrix,
           const MatrixRadiosityOptions& options, const Timer& timer, SideLight* light,
           SolverStatistics* statistics, const ProgressCallback& progress) {
  std::vector<Spectrum> lamps = light->fromLamps;
  for (size_t i = 0; i < lamps.size(); ++i) lamps[i] += light->fromFar[i];
  float reflectance = 0;
  for (const Spectrum& rho : sides.reflectance) reflectance = std::max(reflectance, rho.MaxBand());
  const double enough = options.tolerance * double(1 - reflectance) /
                        std::max(double(reflectance), options.tolerance);
  for (int sweep = 1; sweep <= kMaximumSweeps; ++sweep) {
    const double change = matrix.Sweep(lamps, &light->irradiance, &light->radiosity);
    statistics->history.push_back(
        {sweep, timer.Seconds(), 0, sides.Count(), matrix.PairCount(), statistics->rays, change});
    // Floats do not settle further than some 1e-7.
    if (change <= std::max(enough, 1e-7)) break;
    if (!Report(progress, 0.9, "bounces")) throw Cancelled();
  }
}

}  // namespace

RadiositySolution SolveMatrixRadiosity(const Scene& scene, const MatrixRadiosityOptions& options,
                                       SolverStatistics* statistics,
                                       const ProgressCallback& progress) {
  CheckOptions(options);
  const Timer timer;
  SolverStatistics account;

  // Elements, and those of their sides that light can reach.
  const UniformMesh mesh = MakeUniformMesh(scene, options.elementSize);
  const RayScene rayScene(scene.mesh);
  const std::vector<uint8_t> litFaces =
      FindLitFaces(scene, mesh, rayScene, SourceLight(scene, rayScene), &account.rays);
  ElementSides sides = CollectElementSides(scene, mesh, litFaces);
  sides.MeasureExposure({scene, rayScene, litFaces}, &account.rays);

  // Form factors.
  ExchangeMatrixOptions matrixOptions;
  matrixOptions.visibilityRays = options.visibilityRays;
  matrixOptions.memoryLimit = options.memoryLimit;
  const ShaftBlockers shafts(scene.mesh, rayScene.Epsilon(), sides.GroupPoints(mesh));
  const ExchangeMatrix matrix(
      sides, shafts, rayScene, matrixOptions,
      [&](double fraction, const char* stage) { return Report(progress, 0.9 * fraction, stage); });
  account.rays += matrix.Rays();

  // Light.
  SideLight light(sides);
  light.GatherLights(scene, sides, rayScene, options.skyRays, &account.rays);
  Solve(sides, matrix, options, timer, &light, &account, progress);

  // Deliver.
  MeasureElementBalance(scene, sides, light, rayScene, &account);
  account.patchElements = sides.Count();
  account.patchPatch = matrix.PairCount();
  account.stoppedBy = "error";
  if (statistics) *statistics = account;
  UniformSolution uniform = MakeUniformSolution(scene, mesh, litFaces);
  std::vector<Spectrum> irradiance =
      MeanAboutPoints(uniform, light.IrradianceByKey(sides, 2 * mesh.ElementCount()));
  return DeliverLight(scene, std::move(uniform), std::move(irradiance));
}

}  // namespace lambert
