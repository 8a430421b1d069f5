// The element hierarchy: volume clusters over face clusters over patches, made on demand
// (thesis 4.5.1).
#pragma once

#include <vector>

#include "Clustering/Core/FaceClustering.h"
#include "Clustering/Core/FaceRuns.h"
#include "Clustering/Core/VolumeClustering.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/Element.h"
#include "Radiosity/Core/LeafMesh.h"
#include "Radiosity/Core/MaterialRuns.h"
#include "Scene/Core/LightSource.h"
#include "Scene/Core/Scene.h"

namespace lambert {

class ElementHierarchy {
 public:
  /// `litSides`: per surface, bit 1 front, bit 2 back; only those sides are modelled. All by
  /// reference.
  ElementHierarchy(const Scene& scene, const ClusterTree& tree,
                   const std::vector<uint8_t>& litSides, const LeafMeshOptions& options);

  const std::vector<Element>& Elements() const { return elements_; }
  const Element& operator[](int32_t element) const { return elements_[size_t(element)]; }
  int32_t Size() const { return int32_t(elements_.size()); }
  /// Elements for which there is room before all move to another place.
  size_t Capacity() const { return elements_.capacity(); }

  int32_t Root() const { return root_; }  ///< over all surfaces but black emitters; -1 for none
  int32_t EmitterRoot() const {
    return emitterRoot_;
  }  ///< over emitters that do not reflect; -1 for none
  /// One element a light, or one a band where its colour depends on the direction.
  const std::vector<int32_t>& Lights() const { return lights_; }
  const LightSource& LightOf(const Element& element) const {
    return **(lightSources_.begin() + element.item);
  }
  /// Root elements of the modelled sides of the surfaces, in the order of their making.
  const std::vector<int32_t>& SurfaceSides() const { return surfaceSides_; }
  /// False for elements of emitters that do not reflect: they only give.
  bool IsReceiver(int32_t element) const {
    while (elements_[size_t(element)].parent >= 0) element = elements_[size_t(element)].parent;
    return element == root_;
  }

  /// Gives children to each of `parents` (sorted, unique) that has none and can have some. An
  /// element at the floor is marked canSplit = false instead.
  void Split(const std::vector<int32_t>& parents);
  /// Children that splitting an element makes, at most.
  int MostChildren(const Element& element) const;

  /// Reflectance and emittance of all elements by those that the faces of the scene have now.
  /// False, with nothing changed, where other surfaces than before emit and do not reflect: these
  /// are clustered apart.
  bool TakeMaterials();

  /// Corners of a polygon element, counter-clockwise seen from its side; returns their count.
  int PolygonCorners(const Element& element, Vec3f* corners) const;
  /// A place on a face.
  struct Place {
    SurfaceSample at;
    int32_t face = -1;
  };
  /// A place on a surface element, uniform in area.
  Place PlaceOn(int32_t element, Random* random) const;
  /// Elements by level, root level first, each in order of index: for sweeps up and down.
  const std::vector<std::vector<int32_t>>& Levels() const { return levels_; }

  LeafMesh& Leaves() { return leafMesh_; }
  const LeafMesh& Leaves() const { return leafMesh_; }
  const Scene& GetScene() const { return scene_; }
  const ClusterTree& Tree() const { return tree_; }
  /// Size below which what lies in a face is not split: 1e-3 of its surface, never under 1e-6 of
  /// the scene, m.
  float Floor(int32_t face) const;
  float SceneDiagonal() const { return diagonal_; }

 private:
  int32_t Append(const Element& element);
  void AddLight(const LightSource& source, int32_t item);
  int32_t BuildVolumes(const std::vector<int32_t>& surfaces);
  void LinkVolume(int32_t element, const std::vector<VolumeNode>& volumes,
                  const std::vector<int32_t>& surfaces);
  void TakeMeanMaterial(Element* element) const;
  Element MakeFaceElement(int32_t node, Side side, int32_t surface) const;
  Place PlaceInCluster(const ClusterNode& node, Side side, double u, Random* random) const;
  Element MakePatchElement(int32_t patch, const Element& parent) const;
  bool IsBlackEmitter(int32_t surface) const;
  bool BelowFloor(const Element& element) const;
  void FinishVolumes(int32_t root);

  const Scene& scene_;
  const ClusterTree& tree_;
  const std::vector<uint8_t>& litSides_;
  LeafMesh leafMesh_;
  FaceRuns faceRuns_;
  MaterialRuns materialRuns_;
  std::vector<double> areaBefore_;  ///< area of all faces before each face: picks faces by area
  std::vector<Element> elements_;
  std::vector<std::vector<int32_t>> levels_;
  LightSources lightSources_;
  std::vector<int32_t> lights_, surfaceSides_;
  int32_t root_ = -1, emitterRoot_ = -1;
  float diagonal_ = 0;
};

}  // namespace lambert
