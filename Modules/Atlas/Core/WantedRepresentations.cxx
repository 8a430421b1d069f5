#include "Atlas/Core/WantedRepresentations.h"

#include <algorithm>

#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// Throws Error unless every name is that of a row.
template <class Row>
void RequireNames(const std::map<std::string, Representation>& wanted, const std::vector<Row>& rows,
                  const char* kind) {
  for (const auto& [name, representation] : wanted) {
    if (std::none_of(rows.begin(), rows.end(),
                     [&, sought = &name](const Row& row) { return row.name == *sought; })) {
      throw Error(std::string("The scene has no ") + kind + " " + name +
                  ", whose light is to be shown in a way of its own.");
    }
  }
}

/// What stands under `name`; Automatic where nothing does.
template <class Name>
Representation Find(const std::map<Name, Representation>& wanted, const Name& name) {
  const auto found = wanted.find(name);
  return found != wanted.end() ? found->second : Representation::Automatic;
}

}  // namespace

void RequireMaterialsAndParts(const Scene& scene, const WantedRepresentations& wanted) {
  RequireNames(wanted.byMaterial, scene.materials, "material");
  RequireNames(wanted.byPart, scene.parts, "part");
}

void RequireSurfaces(int64_t count, const WantedRepresentations& wanted) {
  for (const auto& [surface, representation] : wanted.bySurface) {
    if (representation == Representation::Automatic) continue;
    if (surface < 0 || surface >= count) {
      throw Error("The scene has the surfaces 0 to " + std::to_string(count - 1) + ", not " +
                  std::to_string(surface) + ", whose light is to be shown in a way of its own.");
    }
  }
}

std::vector<Representation> RepresentationsOfSurfaces(const Scene& scene, const ClusterTree& tree,
                                                      const WantedRepresentations& wanted,
                                                      Representation otherwise) {
  RequireSurfaces(int64_t(tree.surfaceRoots.size()), wanted);
  std::vector<Representation> bySurface;
  for (const int32_t root : tree.surfaceRoots) {
    const size_t face = size_t(tree.nodes[size_t(root)].firstFace);
    const std::string& material = scene.materials[size_t(scene.mesh.materialId[face])].name;
    const std::string& part = scene.parts[size_t(scene.mesh.partId[face])].name;
    Representation chosen = otherwise;
    for (const Representation wish : {Find(wanted.byMaterial, material), Find(wanted.byPart, part),
                                      Find(wanted.bySurface, int32_t(bySurface.size()))}) {
      if (wish != Representation::Automatic) chosen = wish;
    }
    bySurface.push_back(chosen);
  }
  return bySurface;
}

}  // namespace lambert
