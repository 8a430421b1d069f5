#include "Clustering/Core/FaceClustering.h"

#include <algorithm>
#include <cmath>

#include "Clustering/Core/DualGraph.h"
#include "Clustering/Core/DualGraphCollapse.h"
#include "Clustering/Core/FaceOrder.h"
#include "Clustering/Core/PartInstances.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Timer.h"

namespace lambert {

namespace {

/// Surfaces of so many faces are collapsed one after the other, each by all threads; smaller ones
/// side by side.
constexpr int32_t kLargeSurface = 1 << 15;

/// Merge trees of all surfaces; large ones first, then the others side by side.
std::vector<MergeTree> CollapseSurfaces(const TriangleMesh& mesh, const PartFaces& parts,
                                        DualGraph* graph, const Surfaces& surfaces, double balance,
                                        const ProgressCallback& progress) {
  // Faces and their neighbours, numbered within the surface; those of the graph are freed.
  const size_t count = surfaces.slots.size();
  std::vector<int32_t> faces(count), placeOfSlot(parts.faces.size(), -1);
  std::vector<std::array<int32_t, 3>> neighbours(count);
  ParallelForEach(surfaces.Count(), 64, [&](int64_t surface) {
    const int32_t begin = surfaces.begin[size_t(surface)],
                  end = surfaces.begin[size_t(surface) + 1];
    for (int32_t i = begin; i < end; ++i)
      placeOfSlot[size_t(surfaces.slots[size_t(i)])] = i - begin;
    for (int32_t i = begin; i < end; ++i) {
      const size_t slot = size_t(surfaces.slots[size_t(i)]);
      faces[size_t(i)] = parts.faces[slot];
      for (size_t k = 0; k < 3; ++k) {
        const int32_t other = graph->neighbours[slot][k];
        neighbours[size_t(i)][k] = other < 0 ? -1 : placeOfSlot[size_t(other)];
      }
    }
  });
  std::vector<int32_t>().swap(placeOfSlot);
  std::vector<std::array<int32_t, 3>>().swap(graph->neighbours);

  const auto collapse = [&](int32_t surface, const std::function<bool(double)>& proceed) {
    const int32_t begin = surfaces.begin[size_t(surface)];
    const SurfaceFaces dual{&mesh, faces.data() + begin, neighbours.data() + begin,
                            surfaces.begin[size_t(surface) + 1] - begin};
    MergeTree tree = CollapseDualGraph(dual, balance, proceed);
    LimitDepth(&tree, [&](int32_t leaf) {
      const int32_t face = dual.faces[leaf];
      return (mesh.Corner(face, 0) + mesh.Corner(face, 1) + mesh.Corner(face, 2)) / 3.f;
    });
    return tree;
  };

  std::vector<MergeTree> trees(size_t(surfaces.Count()));
  std::vector<int32_t> small;
  double done = 0;
  for (int32_t surface = 0; surface < surfaces.Count(); ++surface) {
    const int32_t size = surfaces.begin[size_t(surface) + 1] - surfaces.begin[size_t(surface)];
    if (size < kLargeSurface) {
      small.push_back(surface);
      continue;
    }
    const double share = double(size) / double(count);
    trees[size_t(surface)] = collapse(surface, [&](double fraction) {
      return Report(progress, done + share * fraction, "Clustering faces");
    });
    done += share;
  }
  // Progress is told by the calling thread, between batches.
  constexpr size_t kBatch = 4096;
  for (size_t first = 0; first < small.size(); first += kBatch) {
    if (!Report(progress, done + (1 - done) * double(first) / double(small.size()),
                "Clustering faces")) {
      throw Cancelled();
    }
    ParallelForEach(int64_t(std::min(kBatch, small.size() - first)), 1, [&](int64_t i) {
      const int32_t surface = small[first + size_t(i)];
      trees[size_t(surface)] = collapse(surface, {});
    });
  }
  return trees;
}

/// Where the nodes and faces of a surface go. Parts follow each other, and in them their surfaces.
struct Placement {
  int32_t modelSurface;  ///< row of the surfaces that were collapsed
  int32_t part, model;   ///< the part, and the one whose tree it takes
  int32_t firstNode, firstFace;
};

std::vector<Placement> PlaceSurfaces(const Surfaces& surfaces,
                                     const std::vector<int32_t>& modelOfPart) {
  std::vector<Placement> placements;
  int32_t firstNode = 0, firstFace = 0;
  for (int32_t part = 0; part < int32_t(modelOfPart.size()); ++part) {
    const int32_t model = modelOfPart[size_t(part)];
    const int32_t end = surfaces.firstOfPart[size_t(model) + 1];
    for (int32_t surface = surfaces.firstOfPart[size_t(model)]; surface < end; ++surface) {
      const int32_t faces = surfaces.begin[size_t(surface) + 1] - surfaces.begin[size_t(surface)];
      placements.push_back({surface, part, model, firstNode, firstFace});
      firstNode += 2 * faces - 1;
      firstFace += faces;
    }
  }
  return placements;
}

/// Lays the tree out depth first, siblings side by side, each cluster a range of faces. Tells every
/// face's new place: order[place] = leaf. Returns the depth.
int32_t LayOutTree(const MergeTree& tree, const Placement& at, ClusterNode* nodes,
                   const std::function<void(int32_t place, int32_t leaf)>& placeFace) {
  // Leaves below every merge; merges may stand in any order, so count on the way back up.
  struct Visit {
    int32_t mergeNode, node, depth;
  };
  std::vector<int32_t> leaves(tree.merges.size(), 0);
  const auto leavesOf = [&](int32_t node) {
    return tree.IsLeaf(node) ? 1 : leaves[size_t(node - tree.leafCount)];
  };
  std::vector<int32_t> path{tree.Root()};
  while (!path.empty()) {
    const int32_t node = path.back();
    if (tree.IsLeaf(node)) {
      path.pop_back();
      continue;
    }
    const auto [a, b] = tree.Children(node);
    if (leavesOf(a) == 0) {
      path.push_back(a);
    } else if (leavesOf(b) == 0) {
      path.push_back(b);
    } else {
      leaves[size_t(node - tree.leafCount)] = leavesOf(a) + leavesOf(b);
      path.pop_back();
    }
  }

  int32_t depth = 0, nextNode = at.firstNode + 1;
  nodes[at.firstNode].firstFace = at.firstFace;
  std::vector<Visit> visits{{tree.Root(), at.firstNode, 0}};
  while (!visits.empty()) {
    const Visit visit = visits.back();
    visits.pop_back();
    ClusterNode& node = nodes[visit.node];
    node.faceCount = leavesOf(visit.mergeNode);
    depth = std::max(depth, visit.depth);
    if (tree.IsLeaf(visit.mergeNode)) {
      placeFace(node.firstFace, visit.mergeNode);
      continue;
    }
    const auto [a, b] = tree.Children(visit.mergeNode);
    node.child = nextNode;
    nextNode += 2;
    nodes[node.child].parent = nodes[node.child + 1].parent = visit.node;
    nodes[node.child].firstFace = node.firstFace;
    nodes[node.child + 1].firstFace = node.firstFace + leavesOf(a);
    visits.push_back({b, node.child + 1, visit.depth + 1});
    visits.push_back({a, node.child, visit.depth + 1});
  }
  return depth;
}

/// Area, vector area (4.9) and bounds: of the leaves from their faces, of the others from their
/// children, which stand behind them.
void MeasureClusters(const TriangleMesh& mesh, int32_t firstNode, int32_t nodeCount,
                     ClusterNode* nodes) {
  for (int32_t i = firstNode + nodeCount - 1; i >= firstNode; --i) {
    ClusterNode& node = nodes[i];
    if (node.child < 0) {
      node.vectorArea = mesh.VectorArea(node.firstFace);
      node.area = Length(node.vectorArea);
      for (int k = 0; k < 3; ++k) node.bounds.Include(mesh.Corner(node.firstFace, k));
    } else {
      const ClusterNode &a = nodes[node.child], &b = nodes[node.child + 1];
      node.vectorArea = a.vectorArea + b.vectorArea;
      node.area = a.area + b.area;
      node.bounds = a.bounds;
      node.bounds.Include(b.bounds);
    }
  }
}

void TellDepths(const std::vector<Placement>& placements, const std::vector<int32_t>& depths,
                const std::vector<ClusterNode>& nodes, FaceClusteringStatistics* statistics) {
  for (const Placement& at : placements) {
    const int32_t depth = depths[size_t(at.modelSurface)];
    const int32_t faces = nodes[size_t(at.firstNode)].faceCount;
    statistics->maximumDepth = std::max(statistics->maximumDepth, depth);
    if (faces >= 64) {
      statistics->maximumDepthOverLog =
          std::max(statistics->maximumDepthOverLog, depth / std::log2(double(faces)));
    }
  }
}

}  // namespace

ClusterTree ClusterFaces(TriangleMesh* mesh, const std::vector<Part>& partTable,
                         const FaceClusteringOptions& options, FaceClusteringStatistics* statistics,
                         const ProgressCallback& progress) {
  if (!(options.balance >= 0) || !std::isfinite(options.balance)) {
    throw Error("The balance of the face clustering must be a number that is not negative.");
  }
  const Timer timer;
  mesh->Complete();

  // Parts, and those among them that are instances of one mesh.
  const PartFaces parts = GroupFacesByPart(*mesh, int32_t(partTable.size()));
  const std::vector<int32_t> modelOfPart = FindInstances(*mesh, parts, partTable);
  std::vector<uint8_t> clustered(modelOfPart.size());
  for (size_t part = 0; part < clustered.size(); ++part)
    clustered[part] = modelOfPart[part] == int32_t(part);

  // Surfaces, and the tree of each.
  DualGraph graph = BuildDualGraph(*mesh, parts, clustered);
  const Surfaces surfaces = FindSurfaces(graph, parts, clustered);
  std::vector<MergeTree> trees =
      CollapseSurfaces(*mesh, parts, &graph, surfaces, options.balance, progress);

  // Every surface's place among nodes and faces; instances take the tree and the order of their
  // model.
  const std::vector<Placement> placements = PlaceSurfaces(surfaces, modelOfPart);
  ClusterTree tree;
  tree.nodes.resize(size_t(2 * mesh->FaceCount()) - placements.size());
  std::vector<int32_t> order(size_t(mesh->FaceCount())), depths(trees.size(), 0);
  ParallelForEach(int64_t(placements.size()), 16, [&](int64_t i) {
    const Placement& at = placements[size_t(i)];
    const int32_t* const slots = surfaces.slots.data() + surfaces.begin[size_t(at.modelSurface)];
    const int32_t toPart = parts.begin[size_t(at.part)] - parts.begin[size_t(at.model)];
    const int32_t depth = LayOutTree(
        trees[size_t(at.modelSurface)], at, tree.nodes.data(), [&](int32_t place, int32_t leaf) {
          order[size_t(place)] = parts.faces[size_t(slots[leaf] + toPart)];
        });
    if (at.part == at.model) depths[size_t(at.modelSurface)] = depth;
  });
  std::vector<MergeTree>().swap(trees);

  // Faces in tree order, and what the clusters measure in the world.
  ReorderFaces(order, mesh);
  mesh->surfaceId.resize(size_t(mesh->FaceCount()));
  tree.surfaceRoots.resize(placements.size());
  ParallelForEach(int64_t(placements.size()), 16, [&](int64_t i) {
    const Placement& at = placements[size_t(i)];
    tree.surfaceRoots[size_t(i)] = at.firstNode;
    const int32_t faces = tree.nodes[size_t(at.firstNode)].faceCount;
    std::fill_n(mesh->surfaceId.begin() + at.firstFace, faces, int32_t(i));
    MeasureClusters(*mesh, at.firstNode, 2 * faces - 1, tree.nodes.data());
  });

  if (statistics) {
    *statistics = {};
    statistics->surfaces = int64_t(placements.size());
    statistics->nodes = int64_t(tree.nodes.size());
    for (size_t part = 0; part < clustered.size(); ++part)
      statistics->sharedTrees += !clustered[part];
    statistics->nonManifoldEdges = graph.nonManifoldEdges;
    statistics->inconsistentEdges = graph.inconsistentEdges;
    TellDepths(placements, depths, tree.nodes, statistics);
    statistics->seconds = timer.Seconds();
  }
  if (!Report(progress, 1, "Clustering faces")) throw Cancelled();
  return tree;
}

}  // namespace lambert
