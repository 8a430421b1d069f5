#include "Radiosity/Core/LeafLookup.h"

#include <algorithm>
#include <limits>

#include "Common/Core/PolygonIrradiance.h"

namespace lambert {

LeafLookup::LeafLookup(const ElementHierarchy& hierarchy) {
  const size_t faces = hierarchy.GetScene().mesh.triangles.size();
  for (std::vector<int32_t>& element : elementOfFace_) element.assign(faces, -1);
  parts_.resize(size_t(hierarchy.Size()));
  for (int32_t index = 0; index < hierarchy.Size(); ++index) {
    const Element& element = hierarchy[index];
    const bool isCut = !element.IsLeaf() && element.IsPolygon();
    if (isCut) this->FindParts(hierarchy, index);
    if (element.kind != ElementKind::Face || !(element.IsLeaf() || isCut)) continue;
    const ClusterNode& node = hierarchy.Tree().nodes[size_t(element.item)];
    std::fill_n(elementOfFace_[element.side].begin() + node.firstFace, node.faceCount, index);
  }
}

// Of each part but the first, the edge that has all earlier ones behind it.
void LeafLookup::FindParts(const ElementHierarchy& hierarchy, int32_t index) {
  const Element& element = hierarchy[index];
  parts_[size_t(index)].child = element.child;
  parts_[size_t(index)].childCount = element.childCount;
  std::vector<Vec3f> earlier;
  for (int32_t child = element.child; child < element.child + element.childCount; ++child) {
    Vec3f corners[kMaximumPolygonCorners];
    const int count = hierarchy.PolygonCorners(hierarchy[child], corners);
    Part& part = parts_[size_t(child)];
    float least = std::numeric_limits<float>::max();
    for (int i = 0; i < count; ++i) {
      const Vec3f inward = Normalize(Cross(element.axis, corners[(i + 1) % count] - corners[i]));
      float farthest = std::numeric_limits<float>::lowest();
      for (const Vec3f& p : earlier) farthest = std::max(farthest, Dot(inward, p - corners[i]));
      if (inward == Vec3f() || farthest >= least) continue;
      least = farthest;
      part.normal = inward;
      part.offset = -Dot(inward, corners[i]);
    }
    earlier.insert(earlier.end(), corners, corners + count);
  }
}

int32_t LeafLookup::Find(int64_t face, Side side, const Vec3f& position) const {
  int32_t index = elementOfFace_[side][size_t(face)];
  while (index >= 0 && parts_[size_t(index)].child >= 0) {
    const int32_t first = parts_[size_t(index)].child;
    index = first + parts_[size_t(index)].childCount - 1;
    const auto isOutside = [&](const Part& p) { return Dot(p.normal, position) + p.offset < 0; };
    while (index > first && isOutside(parts_[size_t(index)])) --index;
  }
  return index;
}

}  // namespace lambert
