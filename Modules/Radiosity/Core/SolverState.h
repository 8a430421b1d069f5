// What a solver needs to go on where it was stopped, and the file that keeps it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/ExposureSplitting.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// The state of a solver at the end of an iteration of links, by reference. Elements follow from
/// the scene and the splits that made them; bounding volumes and clusters are made again.
struct SolverState {
  ElementHierarchy& hierarchy;
  ElementLight& light;
  LinkNetwork& network;
  std::vector<Exposure>& exposures;
  double& received;  ///< power that the leaves receive, W
  std::vector<IterationRecord>& history;
};

/// Writes `state` to a file, whole or not at all: under another name first. About 75 bytes an
/// element and 19 a link, little endian. Throws Error where it cannot be written; nothing of it is
/// left then.
void SaveSolverState(const SolverState& state, const std::string& fileName);

/// Brings the `state` of a solver that has not iterated yet to that of the file, to the bit. Throws
/// Error where RequireSolverState does, for a file of another scene (other geometry or clusters,
/// other materials, other lights, other options of patches), and where elements do not come out as
/// they were.
void LoadSolverState(const std::string& fileName, SolverState* state);

/// Throws Error where the file cannot be read, is none that SaveSolverState wrote, is of another
/// version of it, was cut short or changed.
void RequireSolverState(const std::string& fileName);

}  // namespace lambert
