// What every measured run has in common: its row, its order, its memory.
#pragma once

#include <cstdlib>
#include <vector>

#include "BenchMethods.h"
#include "BenchScenes.h"
#include "BenchTable.h"
#include "Common/Core/Random.h"

namespace lambert {

/// A row with what is known before the run.
BenchRow BeginRow(const std::string& study, const BenchScene& scene, const BenchMethod& method,
                  double value);
/// Enters time, work and memory of a run.
void EnterOutcome(const BenchOutcome& outcome, const BenchMethod& method, BenchRow* row);
/// Says a row on stdout.
void Announce(const BenchRow& row);

/// Processor seconds of all threads of this process so far.
double CpuSeconds();

/// Gives back what earlier runs left, and makes PeakMemoryBytes() begin anew where the system can.
void ForgetPeakMemory();

template <class T>
void Shuffle(std::vector<T>* values, Random* random) {
  for (size_t i = values->size(); i > 1; --i) {
    std::swap((*values)[i - 1], (*values)[size_t(random->UniformDouble() * double(i))]);
  }
}

}  // namespace lambert
