#include "AccuracyMethods.h"

#include "FindByMethod.h"

namespace lambert::testing {

const std::vector<AccuracyMethod>& AccuracyMethods() {
  static const std::vector<AccuracyMethod> methods{
      {"closed form", FindByClosedForm, kVisibility | kVaryingLight | kPointLight, 0.01, false},
      {"path traced", FindByPathTracing, kOneValueASurface, 0.02, false},
      {"hierarchical", FindByHierarchicalRadiosity, kOneValueASurface, 0.1, true},
      {"matrix", FindByMatrixRadiosity, kOneValueASurface, 0.2, true},
      {"progressive", FindByProgressiveRadiosity, kOneValueASurface | kLongBounces, 0.2, true},
      {"cached", FindByCachedRadiosity, kOneValueASurface, 0.2, true},
      {"baked", FindByBaking, kOneValueASurface | kVariesOverFaces, 0.1, true},
  };
  return methods;
}

}  // namespace lambert::testing
