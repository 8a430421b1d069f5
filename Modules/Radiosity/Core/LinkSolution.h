// The solution by the links alone (thesis 4.5.5), and what of it stays valid under another light.
#pragma once

#include <atomic>

#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/LightReconstruction.h"
#include "Radiosity/Core/RefinedMesh.h"

namespace lambert {

class LinkSolution {
 public:
  /// Triangulates the leaves; it is valid until links are refined or leaves cut. `keeps`: transfers
  /// to points and corners stay, up to what SolverMemory says of them. All by reference.
  LinkSolution(ElementHierarchy* hierarchy, const LinkNetwork& network, const ElementLight& light,
               const RayScene& rayScene, const std::vector<uint8_t>& litSides, bool keeps);

  bool Keeps() const { return keeps_; }
  /// Reflectance and emittance by those that the faces have now.
  void TakeMaterials() { mesh_.TakeMaterials(); }
  /// The solution by the light as it is now. Adds the rays cast to `rays`, and the links
  /// re-evaluated at corners of clusters and at points, less those that were kept, to `made`.
  RadiositySolution Deliver(int64_t* rays, int64_t* made);

 private:
  const bool keeps_;
  std::atomic<int64_t> room_{0};  ///< for transfers to be kept
  LightReconstruction reconstruction_;
  RefinedMesh mesh_;
  KeptTransfers atPoints_;
};

}  // namespace lambert
