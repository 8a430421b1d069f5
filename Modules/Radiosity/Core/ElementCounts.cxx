#include "Radiosity/Core/ElementCounts.h"

#include <algorithm>

namespace lambert {

void CountElementsAndLinks(const ElementHierarchy& hierarchy, const LinkNetwork& network,
                           SolverStatistics* statistics) {
  SolverStatistics& s = *statistics;
  s.volumeElements = s.faceElements = s.patchElements = 0;
  s.volumeVolume = s.volumeFace = s.faceFace = s.facePatch = s.volumePatch = s.patchPatch = 0;
  s.fromLights = 0;
  s.rays = network.rays;
  s.linksAtFloor = network.linksAtFloor;
  for (int32_t index = 0; index < hierarchy.Size(); ++index) {
    const ElementKind kind = hierarchy[index].kind;
    if (kind == ElementKind::Volume) ++s.volumeElements;
    if (kind == ElementKind::Face) ++s.faceElements;
    if (kind == ElementKind::Patch) ++s.patchElements;
    for (const Link& link : network.incoming[size_t(index)]) {
      const ElementKind source = hierarchy[link.source].kind;
      const ElementKind coarse = std::min(kind, source), fine = std::max(kind, source);
      if (source == ElementKind::Light)
        ++s.fromLights;
      else if (fine == ElementKind::Volume)
        ++s.volumeVolume;
      else if (fine == ElementKind::Face)
        ++(coarse == ElementKind::Volume ? s.volumeFace : s.faceFace);
      else if (coarse == ElementKind::Volume)
        ++s.volumePatch;
      else
        ++(coarse == ElementKind::Face ? s.facePatch : s.patchPatch);
    }
  }
}

}  // namespace lambert
