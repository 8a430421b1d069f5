#include "Radiosity/Core/ElementHierarchy.h"

#include <algorithm>
#include <numeric>

#include "Common/Core/Parallel.h"
#include "Common/Core/PolygonIrradiance.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {

/// Elements are not split below this part of their surface's diagonal, nor of the scene's.
constexpr float kFloorOfSurface = 1e-3f, kFloorOfSlivers = 5e-5f;
constexpr float kFloorOfScene = 1e-6f;

bool ReflectsNothing(const TriangleMesh& mesh, const ClusterNode& node) {
  for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
    if (!mesh.reflectance[size_t(face)].IsBlack()) return false;
  }
  return true;
}

bool EmitsSomewhere(const TriangleMesh& mesh, const ClusterNode& node) {
  for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
    const bool emits = mesh.Emits(face, kFront) || mesh.Emits(face, kBack);
    if (emits && !mesh.emittance[size_t(face)].IsBlack()) return true;
  }
  return false;
}

Vec3f Oriented(const Vec3f& v, Side side) { return side == kFront ? v : -v; }

/// Stratified places on a convex polygon: one low-discrepancy set, shifted by the element's seed.
void SamplePolygon(const Vec3f* corners, int count, const Vec3f& normal, uint64_t seed,
                   std::array<SurfaceSample, kSamplesPerElement>* samples) {
  Random random(seed);
  const float shiftU = random.Uniform(), shiftV = random.Uniform();
  for (int k = 0; k < kSamplesPerElement; ++k) {
    const float u = (float(k) + shiftU) / kSamplesPerElement;
    const float v = RadicalInverse(uint32_t(k), shiftV);
    (*samples)[size_t(k)] = {PlaceOnPolygon(corners, count, u, v), normal};
  }
}

/// A sphere and box about few points: the frame of a planar polygon.
ClusterFrame PolygonFrame(const Vec3f* corners, int count, const Vec3f& normal) {
  // The longest side gives the first axis.
  Vec3f longest;
  for (int i = 0; i < count; ++i) {
    const Vec3f edge = corners[(i + 1) % count] - corners[i];
    if (LengthSquared(edge) > LengthSquared(longest)) longest = edge;
  }
  ClusterFrame frame;
  frame.axes[2] = normal;
  frame.axes[0] = Normalize(longest - normal * Dot(longest, normal));
  if (frame.axes[0] == Vec3f()) CoordinateSystem(normal, &frame.axes[0], &frame.axes[1]);
  frame.axes[1] = Cross(normal, frame.axes[0]);
  Vec2f low{1e30f, 1e30f}, high{-1e30f, -1e30f};
  for (int i = 0; i < count; ++i) {
    const Vec3f p = corners[i] - corners[0];
    const Vec2f q{Dot(p, frame.axes[0]), Dot(p, frame.axes[1])};
    low = {std::min(low.x, q.x), std::min(low.y, q.y)};
    high = {std::max(high.x, q.x), std::max(high.y, q.y)};
  }
  frame.center =
      corners[0] + frame.axes[0] * ((low.x + high.x) / 2) + frame.axes[1] * ((low.y + high.y) / 2);
  frame.halfExtent = {(high.x - low.x) / 2, (high.y - low.y) / 2, 0};
  return frame;
}

}  // namespace

ElementHierarchy::ElementHierarchy(const Scene& scene, const ClusterTree& tree,
                                   const std::vector<uint8_t>& litSides,
                                   const LeafMeshOptions& options)
    : scene_(scene),
      tree_(tree),
      litSides_(litSides),
      leafMesh_(scene.mesh, options),
      faceRuns_(scene.mesh),
      materialRuns_(faceRuns_),
      lightSources_(scene.lights) {
  // Running sums of area, to pick faces of a cluster by area.
  const TriangleMesh& mesh = scene.mesh;
  diagonal_ = mesh.Bounds().IsEmpty() ? 0 : mesh.Bounds().Diagonal();
  areaBefore_.resize(mesh.triangles.size() + 1, 0);
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    areaBefore_[size_t(face) + 1] = areaBefore_[size_t(face)] + mesh.Area(face);
  }

  // Emitters that do not reflect are clustered apart (4.5.1).
  std::vector<int32_t> reflecting, black;
  for (size_t surface = 0; surface < tree.surfaceRoots.size(); ++surface) {
    if (!litSides[surface]) continue;
    (IsBlackEmitter(int32_t(surface)) ? black : reflecting).push_back(int32_t(surface));
  }
  root_ = BuildVolumes(reflecting);
  emitterRoot_ = BuildVolumes(black);

  // Lights without geometry stand beside the hierarchy.
  int32_t item = 0;
  for (const auto& source : lightSources_) AddLight(*source, item++);
}

void ElementHierarchy::AddLight(const LightSource& source, int32_t item) {
  Element light;
  light.kind = ElementKind::Light;
  light.item = item;
  light.canSplit = false;
  light.emittance = source.Strength();
  if (source.IsOneColor()) {
    lights_.push_back(Append(light));
    return;
  }
  for (int band = 0; band < 3; ++band) {
    light.emittance = Spectrum();
    light.emittance[band] = source.Strength()[band];
    if (!light.emittance.IsBlack()) lights_.push_back(Append(light));
  }
}

bool ElementHierarchy::IsBlackEmitter(int32_t surface) const {
  const ClusterNode& node = tree_.nodes[size_t(tree_.surfaceRoots[size_t(surface)])];
  return EmitsSomewhere(scene_.mesh, node) && ReflectsNothing(scene_.mesh, node);
}

bool ElementHierarchy::TakeMaterials() {
  for (const int32_t side : surfaceSides_) {
    if (IsReceiver(side) == IsBlackEmitter(elements_[size_t(side)].surface)) return false;
  }

  // Faces by their clusters, patches by their parents, volumes by their surfaces.
  materialRuns_.TakeMaterials();
  for (const std::vector<int32_t>& level : levels_) {
    ParallelForEach(int64_t(level.size()), 64, [&](int64_t i) {
      Element& element = elements_[size_t(level[size_t(i)])];
      if (element.kind == ElementKind::Face) {
        this->TakeMeanMaterial(&element);
      } else if (element.kind == ElementKind::Patch) {
        element.reflectance = elements_[size_t(element.parent)].reflectance;
        element.emittance = elements_[size_t(element.parent)].emittance;
      }
    });
  }
  if (root_ >= 0) FinishVolumes(root_);
  return true;
}

int32_t ElementHierarchy::Append(const Element& element) {
  const int32_t index = Size();
  elements_.push_back(element);
  if (size_t(element.level) >= levels_.size()) levels_.resize(size_t(element.level) + 1);
  levels_[size_t(element.level)].push_back(index);
  return index;
}

// Volume elements, top down, so that children come after their parents; leaves are single surfaces
// whose modelled sides are their children.
int32_t ElementHierarchy::BuildVolumes(const std::vector<int32_t>& surfaces) {
  std::vector<Box3f> boxes;
  for (const int32_t surface : surfaces) {
    boxes.push_back(tree_.nodes[size_t(tree_.surfaceRoots[size_t(surface)])].bounds);
  }
  const std::vector<VolumeNode> volumes = ClusterVolumes(boxes);
  if (volumes.empty()) return -1;

  Element top;
  top.item = 0;
  const int32_t root = Append(top);
  for (int32_t element = root; element < Size(); ++element) {
    if (elements_[size_t(element)].IsVolume()) LinkVolume(element, volumes, surfaces);
  }
  FinishVolumes(root);
  return root;
}

void ElementHierarchy::LinkVolume(int32_t element, const std::vector<VolumeNode>& volumes,
                                  const std::vector<int32_t>& surfaces) {
  const int32_t level = elements_[size_t(element)].level + 1;
  const VolumeNode& volume = volumes[size_t(elements_[size_t(element)].item)];
  const Box3f& bounds = volume.bounds;
  elements_[size_t(element)].frame.center = bounds.Center();
  elements_[size_t(element)].frame.axes = {Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)};
  elements_[size_t(element)].frame.halfExtent = bounds.Extent() * 0.5f;
  elements_[size_t(element)].radius = bounds.Diagonal() / 2;
  elements_[size_t(element)].child = Size();
  elements_[size_t(element)].canSplit = false;

  if (volume.child >= 0) {
    elements_[size_t(element)].childCount = 2;
    for (int32_t i = 0; i < 2; ++i) {
      Element child;
      child.parent = element;
      child.level = level;
      child.item = volume.child + i;
      Append(child);
    }
    return;
  }
  const int32_t surface = surfaces[size_t(volume.item)];
  for (const Side side : {kFront, kBack}) {
    if (!(litSides_[size_t(surface)] & (1 << side))) continue;
    Element root = MakeFaceElement(tree_.surfaceRoots[size_t(surface)], side, surface);
    root.parent = element;
    root.level = level;
    surfaceSides_.push_back(Append(root));
    ++elements_[size_t(element)].childCount;
  }
}

// Area and samples of the volumes, from the surfaces up; samples are taken from the children by
// area.
void ElementHierarchy::FinishVolumes(int32_t root) {
  for (int32_t index = Size() - 1; index >= root; --index) {
    Element& volume = elements_[size_t(index)];
    if (!volume.IsVolume()) continue;
    float firstArea = elements_[size_t(volume.child)].area;
    volume.area = firstArea;
    volume.reflectance = elements_[size_t(volume.child)].reflectance * firstArea;
    if (volume.childCount == 2) {
      const Element& second = elements_[size_t(volume.child) + 1];
      volume.area += second.area;
      volume.reflectance += second.reflectance * second.area;
    }
    if (volume.area > 0) volume.reflectance *= 1 / volume.area;
    for (int k = 0; k < kSamplesPerElement; ++k) {
      const bool first =
          volume.childCount < 2 || (float(k) + 0.5f) / kSamplesPerElement * volume.area < firstArea;
      volume.samples[size_t(k)] =
          elements_[size_t(volume.child) + (first ? 0 : 1)].samples[size_t(k)];
    }
  }
}

void ElementHierarchy::TakeMeanMaterial(Element* element) const {
  const ClusterNode& node = tree_.nodes[size_t(element->item)];
  const MaterialRuns::Material mean = materialRuns_.MeanOf(node, Side(element->side));
  element->reflectance = mean.reflectance;
  element->emittance = mean.emittance;
}

Element ElementHierarchy::MakeFaceElement(int32_t nodeIndex, Side side, int32_t surface) const {
  const ClusterNode& node = tree_.nodes[size_t(nodeIndex)];
  Element element;
  element.kind = ElementKind::Face;
  element.item = nodeIndex;
  element.surface = surface;
  element.side = side;
  element.area = node.area;
  element.vectorArea = Oriented(node.vectorArea, side);
  element.axis = Normalize(element.vectorArea);

  // Material, and the cone of normals; faces too small to matter do not widen it.
  this->TakeMeanMaterial(&element);
  const float negligible = 1e-4f * node.area / float(node.faceCount);
  const float cosine = faceRuns_.LeastCosine(node, Oriented(element.axis, side), negligible);
  const bool hasAxis = Length(node.vectorArea) > 1e-3f * node.area;
  element.coneAngle = hasAxis ? std::acos(std::max(-1.f, std::min(1.f, cosine))) : float(kPi);

  // A single triangle is a polygon; a cluster is sampled face by face.
  const uint64_t seed = HashBits(uint64_t(nodeIndex), side);
  if (node.faceCount == 1) {
    element.polygonCount = 3;
    element.coneAngle = 0;
    Vec3f corners[3];
    PolygonCorners(element, corners);
    element.frame = PolygonFrame(corners, 3, element.axis);
    SamplePolygon(corners, 3, element.axis, seed, &element.samples);
  } else {
    element.frame = ComputeClusterFrame(faceRuns_, node);
    Random random(seed);
    for (int k = 0; k < kSamplesPerElement; ++k) {
      const double u = (k + random.UniformDouble()) / kSamplesPerElement;
      element.samples[size_t(k)] = this->PlaceInCluster(node, side, u, &random).at;
    }
  }
  element.radius = Length(element.frame.halfExtent);
  return element;
}

// On one of its faces, picked by area with `u` in [0, 1].
ElementHierarchy::Place ElementHierarchy::PlaceInCluster(const ClusterNode& node, Side side,
                                                         double u, Random* random) const {
  const double first = areaBefore_[size_t(node.firstFace)];
  const double last = areaBefore_[size_t(node.firstFace + node.faceCount)];
  const auto begin = areaBefore_.begin() + node.firstFace;
  const int32_t face = int32_t(std::min<int64_t>(
      node.firstFace + node.faceCount - 1,
      std::upper_bound(begin, begin + node.faceCount, first + (last - first) * u) -
          areaBefore_.begin() - 1));
  const TriangleMesh& mesh = scene_.mesh;
  const Vec2f b = UniformTriangle(random->Uniform(), random->Uniform());
  const Vec3f place =
      PlaceOnTriangle(mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2), b);
  return {{place, Oriented(mesh.FrontNormal(face), side)}, face};
}

ElementHierarchy::Place ElementHierarchy::PlaceOn(int32_t index, Random* random) const {
  const Element& element = elements_[size_t(index)];
  const bool isPatch = element.kind == ElementKind::Patch;
  if (!element.IsPolygon()) {
    const ClusterNode& node = tree_.nodes[size_t(element.item)];
    return this->PlaceInCluster(node, element.side, random->UniformDouble(), random);
  }
  Vec3f corners[kMaximumPolygonCorners];
  const int count = this->PolygonCorners(element, corners);
  const float u = random->Uniform(), v = random->Uniform();
  return {
      {PlaceOnPolygon(corners, count, u, v), element.axis},
      isPatch ? leafMesh_.PatchFace(element.item) : tree_.nodes[size_t(element.item)].firstFace};
}

Element ElementHierarchy::MakePatchElement(int32_t patch, const Element& parent) const {
  Element element;
  element.kind = ElementKind::Patch;
  element.item = patch;
  element.surface = parent.surface;
  element.side = parent.side;
  element.axis = parent.axis;
  element.coneAngle = 0;
  element.level = parent.level + 1;
  element.reflectance = parent.reflectance;
  element.emittance = parent.emittance;
  element.polygonCount = uint8_t(leafMesh_.Corners(patch).size());
  Vec3f corners[kMaximumPolygonCorners];
  const int count = PolygonCorners(element, corners);
  Vec3f area;
  for (int i = 2; i < count; ++i) {
    area += Cross(corners[i - 1] - corners[0], corners[i] - corners[0]) * 0.5f;
  }
  element.area = Length(area);
  element.vectorArea = element.axis * element.area;
  element.frame = PolygonFrame(corners, count, element.axis);
  element.radius = Length(element.frame.halfExtent);
  SamplePolygon(corners, count, element.axis,
                HashBits(uint64_t(patch), 0x70617463u + uint64_t(element.side)), &element.samples);
  return element;
}

int ElementHierarchy::PolygonCorners(const Element& element, Vec3f* corners) const {
  int count = 0;
  if (element.kind == ElementKind::Patch) {
    for (const Vec3f& p : leafMesh_.Corners(element.item)) corners[count++] = p;
  } else {
    const int32_t face = tree_.nodes[size_t(element.item)].firstFace;
    for (; count < 3; ++count) corners[count] = scene_.mesh.Corner(face, count);
  }
  if (element.side == kBack) std::reverse(corners, corners + count);
  return count;
}

bool ElementHierarchy::BelowFloor(const Element& element) const {
  const Box3f& surface = tree_.nodes[size_t(tree_.surfaceRoots[size_t(element.surface)])].bounds;
  // A sliver is cut across until its pieces have a shape of their own.
  const Vec3f& half = element.frame.halfExtent;
  const float ofSurface = half.x > 2 * half.y ? kFloorOfSlivers : kFloorOfSurface;
  return element.radius < std::max(ofSurface * surface.Diagonal(), kFloorOfScene * diagonal_) ||
         element.polygonCount + 2 > kMaximumPolygonCorners;
}

float ElementHierarchy::Floor(int32_t face) const {
  const int32_t surface = scene_.mesh.surfaceId[size_t(face)];
  const Box3f& bounds = tree_.nodes[size_t(tree_.surfaceRoots[size_t(surface)])].bounds;
  return std::max(kFloorOfSurface * bounds.Diagonal(), kFloorOfScene * diagonal_);
}

void ElementHierarchy::Split(const std::vector<int32_t>& parents) {
  // Where the children come from: the cluster tree, or cuts through the polygon.
  struct Request {
    int32_t parent;
    int32_t item;
    ElementKind kind;
  };
  std::vector<Request> requests;
  for (const int32_t index : parents) {
    Element& parent = elements_[size_t(index)];
    if (!parent.IsLeaf() || !parent.canSplit) continue;
    if (!parent.IsPolygon()) {
      const int32_t child = tree_.nodes[size_t(parent.item)].child;
      for (int32_t k = 0; k < 2; ++k) requests.push_back({index, child + k, ElementKind::Face});
    } else if (BelowFloor(parent)) {
      parent.canSplit = false;
    } else {
      const int32_t patch =
          parent.kind == ElementKind::Patch
              ? parent.item
              : leafMesh_.FacePatch(tree_.nodes[size_t(parent.item)].firstFace, parent.side);
      for (const int32_t part : leafMesh_.Split(patch)) {
        requests.push_back({index, part, ElementKind::Patch});
      }
    }
  }

  // Make them in parallel, number them in order.
  std::vector<Element> children(requests.size());
  ParallelForEach(int64_t(children.size()), 1, [&](int64_t i) {
    const Request& request = requests[size_t(i)];
    const Element& parent = elements_[size_t(request.parent)];
    Element& child = children[size_t(i)];
    child = request.kind == ElementKind::Face
                ? MakeFaceElement(request.item, parent.side, parent.surface)
                : MakePatchElement(request.item, parent);
    child.parent = request.parent;
    child.level = parent.level + 1;
  });
  for (size_t i = 0; i < children.size(); ++i) {
    const int32_t index = Append(children[i]);
    Element& parent = elements_[size_t(requests[i].parent)];
    if (parent.childCount++ == 0) parent.child = index;
  }
}

int ElementHierarchy::MostChildren(const Element& element) const {
  const bool isQuartered =
      element.IsPolygon() && leafMesh_.Options().refinement == PatchRefinement::Quadtree;
  return isQuartered ? 4 : 2;
}

}  // namespace lambert
