// Hierarchical radiosity.
#include "FindByMethod.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "SurfaceMeans.h"

namespace lambert::testing {

std::vector<Finding> FindByHierarchicalRadiosity(const AccuracyCase& asked) {
  Scene scene = asked.scene();
  const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
  HierarchicalRadiosityOptions options;
  options.error = asked.request;
  HierarchicalRadiosity solver(scene, tree, options);
  solver.Run();
  const RadiositySolution solution = solver.Solution();
  std::vector<Finding> findings;
  for (const Quantity& q : asked.quantities) {
    // The request, as if no place missed more than the whole may in the mean.
    findings.push_back({ReadQuantity(scene, solution, q), asked.request * (q.truth - q.offset)});
  }
  return findings;
}

}  // namespace lambert::testing
