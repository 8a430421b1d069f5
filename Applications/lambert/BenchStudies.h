// The measurements of a bench: error against time and elements over all methods, time against
// triangles, convergence of what is shown.
#pragma once

#include "BenchArguments.h"
#include "BenchReference.h"
#include "BenchScenes.h"
#include "BenchTable.h"

namespace lambert {

/// Every method on the scene, over the values of its knob, `runs` times. In the first round the
/// methods take turns at random and each goes from coarse to fine, so that it ends where a run
/// would take longer than asked for; the others are in random order.
void SweepMethods(const BenchArguments& arguments, const BenchScene& scene,
                  const BenchReference& reference, BenchTableWriter* table);

/// The hierarchical method's intermediate solutions: a row each, `seconds` as it can be shown,
/// `value` its iteration. What measuring takes does not count; what reconstruction takes does.
void WatchConvergence(const BenchArguments& arguments, const BenchScene& scene,
                      const BenchReference& reference, BenchTableWriter* table);

/// The knot in its room, from 20 thousand triangles on, four times as many each, to `largest`.
void TessellateFiner(const BenchArguments& arguments, BenchTableWriter* table);

}  // namespace lambert
