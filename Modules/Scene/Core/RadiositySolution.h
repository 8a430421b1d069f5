// What every method delivers: a refined mesh with light at its points, and the account of how it
// came about.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Common/Core/StageSeconds.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// One line of the convergence history; written at the end of every iteration.
struct IterationRecord {
  int iteration = 0;
  double seconds = 0;  ///< since the solver began
  double threshold =
      0;  ///< link error that was refined down to, as a fraction of the power in the scene
  int64_t elements = 0;
  int64_t links = 0;
  int64_t rays = 0;
  double change = 0;  ///< relative change of the radiosity in the last sweep
  double error = -1;  ///< verified error of what was delivered; negative where it was not measured
};

/// The account of a run; the report is written from it.
struct SolverStatistics {
  int64_t volumeElements = 0, faceElements = 0, patchElements = 0;
  /// Links by the kinds of their ends; the coarser kind stands first, whichever end it is.
  int64_t volumeVolume = 0, volumeFace = 0, faceFace = 0, facePatch = 0, volumePatch = 0,
          patchPatch = 0, fromLights = 0;
  int64_t linksAtFloor = 0;  ///< links that the element floor kept from being refined
  int64_t rays = 0;
  /// Of the light of links, wherever it was shown: meshes made, and transfers to their points;
  /// those that were kept are not made again.
  int64_t linkMeshes = 0, linkTransfers = 0;
  Spectrum emitted, absorbed, escaped;  ///< W; emitted = absorbed - covered + escaped
  /// W of the absorbed, on faces under others nearer than what rays skip: there light counts twice.
  /// Of the hierarchical method; others leave it 0 and count it as absorbed.
  Spectrum covered;
  std::vector<IterationRecord> history;
  StageSeconds stages;       ///< wall-clock seconds, those before a stop and go on left out
  std::string stoppedBy;     ///< error | time | iterations | interrupt | memory | floor
  std::string stateFailure;  ///< why the state was not saved; empty: it was, or was not to be

  int64_t Elements() const { return volumeElements + faceElements + patchElements; }
  int64_t Links() const {
    return volumeVolume + volumeFace + faceFace + facePatch + volumePatch + patchPatch + fromLights;
  }
};

/// The refined mesh. Every triangle lies within one face of the solved mesh; a lit back side is a
/// reversed copy.
struct RadiositySolution {
  TriangleMesh mesh;                 ///< all per-face arrays filled; points have normals
  std::vector<int64_t> inputFaceId;  ///< per face: triangle of the solved mesh that it lies in
  std::vector<uint8_t> side;         ///< per face: Side of the solved mesh's winding
  std::vector<int64_t>
      leafId;  ///< per face: leaf element of the hierarchy, for pictures; may be empty
  std::vector<Spectrum> irradiance;  ///< per point, W/m2
  std::vector<Spectrum>
      radiosity;  ///< per point, W/m2: reflectance x irradiance + emittance, of the face it serves
  /// Per point of the solved mesh (not of the refined one): irradiance of its brighter side, W/m2.
  std::vector<Spectrum> inputIrradiance;
};

}  // namespace lambert
