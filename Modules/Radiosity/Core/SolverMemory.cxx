#include "Radiosity/Core/SolverMemory.h"

#include <algorithm>

namespace lambert {

namespace {

static_assert(sizeof(Link) == 20 && sizeof(Element) == 244 && sizeof(VectorIrradiance) == 48,
              "measure kElementBytes and kLinkBytes anew, and state what they are");

/// Bytes that a triangle takes on its way from links to the file, in the final gather, and in a
/// round of cuts.
constexpr double kDeliveryBytes = 320, kGatherBytes = 480, kCutBytes = 700;
/// Triangles that a patch becomes with the points on its border.
constexpr double kTrianglesOfPatch = 1.2;
/// Elements and links of an iteration over those of the last, where there are no two to compare;
/// and at most.
constexpr double kUsualGrowth = 3, kMostGrowth = 4;

/// By how much what has grown from `before` to `last` grows again.
double NextGrowth(int64_t before, int64_t last) {
  const double growth = double(last) / double(std::max<int64_t>(1, before));
  return (std::min(growth, kMostGrowth) - 1) * double(last);
}

}  // namespace

SolverMemory::SolverMemory(double megabytes, const ElementHierarchy& hierarchy,
                           const std::vector<uint8_t>& litSides)
    : ceiling_(megabytes), hierarchy_(hierarchy) {
  // A triangle for every lit side of a face; a face that has none is delivered black.
  const ClusterTree& tree = hierarchy.Tree();
  for (size_t surface = 0; surface < litSides.size(); ++surface) {
    const bool isDouble = litSides[surface] == ((1 << kFront) | (1 << kBack));
    unrefinedTriangles_ +=
        (isDouble ? 2 : 1) * tree.nodes[size_t(tree.surfaceRoots[surface])].faceCount;
  }
}

double SolverMemory::Triangles() const {
  return double(unrefinedTriangles_) + kTrianglesOfPatch * hierarchy_.Leaves().PatchCount();
}

bool SolverMemory::HasRoomFor(double elements, double links) const {
  // While elements move to a larger place there are two of each.
  const double size = double(hierarchy_.Size());
  const bool moves = size + elements > double(hierarchy_.Capacity());
  const double moving = moves ? size * double(sizeof(Element)) : 0;
  const double delivery = kDeliveryBytes * (this->Triangles() + kTrianglesOfPatch * elements);
  return ceiling_.HasRoomFor(double(kElementBytes) * elements + double(kLinkBytes) * links +
                             std::max(moving, delivery));
}

bool SolverMemory::HasRoomForIteration(const IterationRecord* before,
                                       const IterationRecord& last) const {
  if (!before) {
    return this->HasRoomFor((kUsualGrowth - 1) * double(last.elements),
                            (kUsualGrowth - 1) * double(last.links));
  }
  return this->HasRoomFor(NextGrowth(before->elements, last.elements),
                          NextGrowth(before->links, last.links));
}

bool SolverMemory::HasRoomToKeep(int64_t links) const {
  return ceiling_.HasRoomFor((kDeliveryBytes + double(kKeptTriangleBytes)) * this->Triangles() +
                             double(kKeptLinkBytes) * double(links));
}

bool SolverMemory::HasRoomForGather() const {
  return ceiling_.HasRoomFor(kGatherBytes * this->Triangles());
}

bool SolverMemory::HasRoomForCuts(const RadiositySolution& delivered) const {
  return ceiling_.HasRoomFor(kCutBytes * double(delivered.mesh.FaceCount()));
}

}  // namespace lambert
