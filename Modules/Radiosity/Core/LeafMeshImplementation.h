// What stands behind LeafMesh: patches, the half-edge mesh of the split faces, and the input edges
// they share.
#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include <deque>
#include <unordered_map>

#include "Radiosity/Core/LeafMesh.h"
#include "Radiosity/Core/LeafMeshEdges.h"
#include "Radiosity/Core/PatchSplitting.h"

namespace lambert {

/// Every split (face, side) is an island of the half-edge mesh, whose polygons are its leaf
/// patches. A vertex put into an edge inside the island is at once a vertex of both patches there;
/// one put into the island's rim goes through LeafMeshEdges into every island that lies on the same
/// input edge. Faces that are not split are not in the mesh: they take up the points of their edges
/// when they are triangulated.
struct LeafMesh::Implementation {
  using Triangles = std::vector<std::array<int32_t, 3>>;

  struct Patch {
    int32_t face = 0;
    Side side = kFront;
    int32_t meshFace = -1;   // Polygon of a leaf; -1 until the input face is split.
    int32_t firstPart = -1;  // The others follow it; -1 for a leaf.
    int32_t partCount = 0;
    std::vector<Vec3f> corners;
    Triangles triangles;  // Of a leaf, by vertex numbers; empty when its border has changed.
  };
  struct MeshVertex {
    Vec3d weights;  // Barycentric in the island's face.
    int32_t number = 0;
  };
  /// An island's rim along one input edge, as mesh edges from the input edge's first end to its
  /// last.
  struct EdgeUse {
    int32_t face = 0;
    Side side = kFront;
    uint8_t corner = 0;
    bool isForward = true;
    int32_t name = -1;
    std::vector<int32_t> segments;
  };
  /// A patch's polygon, t-vertices included.
  struct Border {
    std::vector<PatchBorderVertex> polygon;
    std::vector<int32_t> vertices;   // Mesh vertices.
    std::vector<int32_t> halfedges;  // Each begins at the vertex of its index.
    double faceLength = 0;           // Longest edge of the face, in the units of the polygon.
  };

  Implementation(const TriangleMesh& mesh_, const LeafMeshOptions& options_)
      : mesh(mesh_), options(options_), edges(mesh_), facePatch(mesh_.triangles.size() * 2, -1) {}

  // Patches.
  int32_t FacePatch(int32_t face, Side side);
  std::vector<int32_t> Split(int32_t patch);
  std::vector<int32_t> SplitAlong(int32_t patch, const std::array<LeafLine, 2>& lines);
  std::vector<int32_t> Parts(int32_t patch) const;
  bool IsSplit(int32_t face, Side side) const {
    const int32_t patch = facePatch[size_t(face) * 2 + side];
    return patch >= 0 && patches[size_t(patch)].firstPart >= 0;
  }

  // The half-edge mesh.
  void AddIsland(int32_t patch);
  std::vector<int32_t> Halve(int32_t patch, const std::array<PatchCutEnd, 2>& cut);
  std::vector<int32_t> Quarter(int32_t patch, const std::array<PatchCutEnd, 3>& middles);
  int32_t DrawLine(int32_t meshFace, int32_t from, int32_t to, int32_t line);
  std::vector<int32_t> MakeParts(int32_t patch, const std::vector<int32_t>& meshFaces);
  int32_t AddMeshVertex(const Vec3d& weights, int32_t number);
  void SplitMeshEdge(int32_t edge, int32_t vertex);
  void SplitRim(int32_t edge, EdgeUse* use, int32_t index);
  int32_t CutVertex(const Patch& patch, const Border& border, const PatchCutEnd& end);
  int32_t RimVertex(const Patch& patch, int32_t line, double fromWeight, double toWeight);
  std::vector<Vec3f> CornersOf(const Border& border) const;
  void BorderOf(const Patch& patch, Border* border) const;
  Vec2d PlaceOn(const Border& border, const LeafBorderPlace& place) const;

  // Triangles.
  std::vector<LeafTriangle> Triangulate(const std::vector<uint8_t>& litSides);
  void TriangulatePatches(const std::vector<uint8_t>& litSides);
  void TriangulateWholeFaces(const std::vector<int32_t>& faces);
  size_t PointsOnEdges(int32_t face) const;
  size_t AppendTriangles(int32_t face, Side side, bool hasPoints, LeafTriangle* out) const;
  size_t AppendLeaves(int32_t patch, LeafTriangle* out) const;

  const TriangleMesh& mesh;
  LeafMeshOptions options;
  LeafMeshEdges edges;
  std::deque<Patch> patches;
  std::vector<int32_t> facePatch;                     // Per face and side; -1 where there is none.
  std::unordered_map<int32_t, Triangles> wholeFaces;  // Unsplit faces with points on their edges.

  OpenMesh::PolyConnectivity halfedges;
  std::vector<MeshVertex> meshVertices;  // Per vertex of the half-edge mesh.
  std::vector<int32_t> lineOfEdge;       // Per mesh edge: 0 to 2 on the rim, else 3 + patch id.
  std::vector<int32_t> patchOfMeshFace;  // Per polygon.
  std::vector<std::vector<EdgeUse>> edgeUses;  // Per stored input edge.
  Border scratch;                              // Of the patch being split.
};

}  // namespace lambert
