// How the user wants surfaces to show their light, whatever refinement did to them (thesis 5.3).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "Atlas/Core/SurfaceRepresentation.h"
#include "Scene/Core/Scene.h"

namespace lambert {

/// By what surfaces are named. The narrowest name counts: that of a surface before that of its
/// part, and this before that of its material. Automatic is no wish.
struct WantedRepresentations {
  std::map<std::string, Representation> byMaterial, byPart;
  std::map<int32_t, Representation> bySurface;  ///< by number in the cluster tree

  bool IsEmpty() const { return byMaterial.empty() && byPart.empty() && bySurface.empty(); }
};

/// Throws Error for a material or a part that the scene does not have.
void RequireMaterialsAndParts(const Scene& scene, const WantedRepresentations& wanted);

/// Throws Error for a surface that is not one of `count`.
void RequireSurfaces(int64_t count, const WantedRepresentations& wanted);

/// By surface of `tree`, whose order the faces of the scene are in, what is wanted of it, else
/// `otherwise`. Names that the scene does not have are of no surface. Throws Error for a surface
/// that is none.
std::vector<Representation> RepresentationsOfSurfaces(const Scene& scene, const ClusterTree& tree,
                                                      const WantedRepresentations& wanted,
                                                      Representation otherwise);

}  // namespace lambert
