// One function a method; AccuracyMethods.cxx lists them.
#pragma once

#include "AccuracyMethods.h"

namespace lambert::testing {

std::vector<Finding> FindByClosedForm(const AccuracyCase& asked);
std::vector<Finding> FindByPathTracing(const AccuracyCase& asked);
std::vector<Finding> FindByHierarchicalRadiosity(const AccuracyCase& asked);
std::vector<Finding> FindByMatrixRadiosity(const AccuracyCase& asked);
std::vector<Finding> FindByProgressiveRadiosity(const AccuracyCase& asked);
std::vector<Finding> FindByCachedRadiosity(const AccuracyCase& asked);
std::vector<Finding> FindByBaking(const AccuracyCase& asked);

}  // namespace lambert::testing
