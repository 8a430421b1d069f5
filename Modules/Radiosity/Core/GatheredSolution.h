// The delivered solution at its best: a final gather at every point of a mesh that is cut further
// where the light between its points is not what they interpolate.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "Common/Core/Progress.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/GatheredPoints.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "Scene/Core/RadiositySolution.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

struct GatheredSolutionOptions {
  /// Rays over the hemisphere of a leaf of mean area, at first; 0: leaves keep what they had.
  int leafRays = 32;
  GatheredPointsOptions points;
};

/// What scatter of rays may leave at a wanted relative error, a relative RMS error.
double NoiseFor(double error);
/// The final gather that usually gives a wanted relative error, (0, 1]; measured
/// (Documentation/Stages).
GatheredSolutionOptions GatherFor(double error);
/// Seconds that gathering at all points for that error will take, by what a few take.
double PredictGatherSeconds(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                            const ElementLight& light, double error);

/// Construct, Gather, Cut as often as wanted, Deliver; or Improve, and Cut again.
class GatheredSolution {
 public:
  /// Gathers at the leaves, so that what points see there is not what links made of it; `light`
  /// keeps that. All by reference. Adds the rays cast to `rays`.
  GatheredSolution(ElementHierarchy* hierarchy, ElementLight* light, const RayScene& rayScene,
                   const std::vector<uint8_t>& litSides, const GatheredSolutionOptions& options,
                   int64_t* rays);
  ~GatheredSolution();

  /// Gathers at the points, once. Throws Cancelled.
  void Gather(const ProgressCallback& progress = {});
  /// Half as many rays as they had at the leaves, then what points that have light lack of what
  /// `options` ask for, as those to come will have. Throws Cancelled.
  void Improve(const GatheredPointsOptions& options, const ProgressCallback& progress = {});
  /// Cuts triangles where interpolation leaves more than about `error`, a relative RMS error, (0,
  /// 1], and gathers at their points; false where it leaves no more, or nothing can be cut. Throws
  /// Cancelled.
  bool Cut(double error, const ProgressCallback& progress = {});
  /// No more triangles can be cut.
  bool IsFull() const;
  RadiositySolution Deliver() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lambert
