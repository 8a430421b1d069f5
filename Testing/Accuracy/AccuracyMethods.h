// The methods that the table of known answers is put to, each with the tolerance that follows from
// how it works.
#pragma once

#include <vector>

#include "AccuracyCases.h"

namespace lambert::testing {

/// An answer, and how far from the truth the method may be for reasons of its own.
struct Finding {
  double value = 0, tolerance = 0;
};

struct AccuracyMethod {
  const char* name;
  /// One finding a quantity of the case.
  std::vector<Finding> (*find)(const AccuracyCase&);
  unsigned cannot = 0;    ///< Needs that it does not meet
  double largest = 0;     ///< tolerances above this part of the truth would say nothing
  bool isSmooth = false;  ///< delivers light for the smooth normals of points
};

/// All methods, in the order of Documentation/Accuracy.md.
const std::vector<AccuracyMethod>& AccuracyMethods();

}  // namespace lambert::testing
