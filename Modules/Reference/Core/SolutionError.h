// How far a solution is from the truth, as the contract defines it: relative RMS error of delivered
// irradiance.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/Progress.h"
#include "Reference/Core/PathTracedIrradiance.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct SolutionErrorOptions {
  int points = 2000;   ///< receiver points, stratified by area over both sides of every face that
                       ///< does not emit; of every face where all emit
  int samples = 1024;  ///< paths a point, [2, inf)
  uint64_t seed = 1;
  /// Up to so many times the paths, [1, inf), where those do not decide: more a point where the
  /// noise of the reference hides the error, else more points where few of them decide the rms.
  int growth = 1;
  double enough = 0;  ///< no more of them where the error that counts is at most this, [0, inf)
};

/// Errors are fractions; confidence intervals are 95 % bootstrap.
struct SolutionError {
  double rms = 0, rmsLow = 0, rmsHigh = 0;  ///< the reference's own noise estimated and subtracted
  double bounded = 0;                       ///< bounded error of the contract, noise subtracted too
  double bias = 0;                          ///< signed: (mean E - mean Eref) / mean Eref
  /// Of the pointwise relative error |E - Eref| / |Eref|; Eref counts as a thousandth of its mean
  /// where it is less.
  double percentile95 = 0;
  int64_t points = 0;  ///< receiving points, those that counted
  int64_t darkPoints =
      0;  ///< left out: on sides that the solution does not model, and dark in the reference too
  int64_t missedPoints =
      0;             ///< of the receiving ones: lit in the reference, not modelled by the solution
  double noise = 0;  ///< relative RMS noise of the reference, what was subtracted from `rms`

  /// False where few points decide the rms: its interval is wider than 30 % of it.
  bool IsRmsSure() const { return rmsHigh - rmsLow <= 0.3 * rms; }
  /// The error that counts: `rms`, or `bounded` where the first is not sure.
  double Counting() const { return this->IsRmsSure() ? rms : bounded; }
};

/// A place where a solution was compared with the truth.
struct ComparedPoint {
  int32_t face;  ///< of the scene's mesh
  Side side;
  ReceiverPoint receiver;
  Spectrum delivered;            ///< W/m2; 0 on a side that the solution does not model
  IrradianceEstimate reference;  ///< W/m2
  /// What it adds to the mean square that `SolutionError::bounded` is the root of, over that: the
  /// parts sum to 1; below 0 where the reference's noise is more than the error. 0 without error.
  double part = 0;
};

/// A place at barycentric `b` (of corners 1 and 2) on one side of a face: its normal is the
/// interpolated one of the mesh, turned to that side; the face's own where it has none.
ReceiverPoint ReceiverAt(const TriangleMesh& mesh, int64_t face, Side side, const Vec2f& b);

/// Per face, whether it counts as receiving: it does not emit, or all do (a furnace).
std::vector<bool> ReceivingFaces(const TriangleMesh& mesh);

/// Throws Error where triangles of `solution` do not lie on the faces of `scene` that they name, to
/// 1e-3 of the diagonal. Every `inputFaceId` is one of its faces.
void RequireSolutionOf(const Scene& scene, const RadiositySolution& solution);

/// The figures of irradiance `delivered` (W/m2) against its `reference`, one a point, which are the
/// receiving points; none is dark or missed. `seed`: of the bootstraps. No light: no error.
SolutionError SummarizeError(const std::vector<Spectrum>& delivered,
                             const std::vector<IrradianceEstimate>& reference, uint64_t seed = 1);

/// Compares the irradiance that `solution` delivers (interpolated from its vertices) with a path
/// trace of `scene`, whose mesh it solved. A side that the solution does not model counts with 0
/// where the reference finds light there; where the reference finds none within two standard errors
/// it does not count. A scene without light has no error. Throws Error where the solution belongs
/// to another scene or does not lie on the faces that it names, for fewer than 1 point or 2
/// samples; Cancelled. `compared`, where given: the receiving points, the largest part first.
SolutionError MeasureSolutionError(const Scene& scene, const RadiositySolution& solution,
                                   const SolutionErrorOptions& options = {},
                                   const ProgressCallback& progress = {},
                                   std::vector<ComparedPoint>* compared = nullptr);

}  // namespace lambert
