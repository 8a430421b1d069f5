#include "Radiosity/Core/LinkSolution.h"

namespace lambert {

namespace {

/// Transfers that are kept, at most: so many of each triangle and of each link.
constexpr int64_t kMostOfTriangle = 16, kMostOfLink = 16;

}  // namespace

LinkSolution::LinkSolution(ElementHierarchy* hierarchy, const LinkNetwork& network,
                           const ElementLight& light, const RayScene& rayScene,
                           const std::vector<uint8_t>& litSides, bool keeps)
    : keeps_(keeps),
      reconstruction_(*hierarchy, network, light, rayScene, &room_),
      mesh_(hierarchy, litSides, RefinedMesh::Use::Links),
      atPoints_(&room_) {
  if (!keeps) return;
  room_ = kMostOfTriangle * int64_t(mesh_.Triangles().size()) + kMostOfLink * network.Count();
}

RadiositySolution LinkSolution::Deliver(int64_t* rays, int64_t* made) {
  const int64_t before = reconstruction_.TransfersMade() + atPoints_.Made();
  reconstruction_.LightCorners();
  RadiositySolution solution = mesh_.Deliver(mesh_.Light(reconstruction_, &atPoints_, rays));
  *made += reconstruction_.TransfersMade() + atPoints_.Made() - before;
  return solution;
}

}  // namespace lambert
