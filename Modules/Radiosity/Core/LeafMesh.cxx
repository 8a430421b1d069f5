#include "Radiosity/Core/LeafMesh.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "Common/Core/Error.h"
#include "Radiosity/Core/LeafMeshImplementation.h"

namespace lambert {

namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// A patch is split while it is longer than this fraction of its face, a million roundings of a
// double.
constexpr double kSmallestPatch = 1e-10;
// Parameters of an edge nearer than this, some roundings of a double, are one point.
constexpr double kSameParameter = 1e-15;

}  // namespace

int32_t LeafMesh::Implementation::FacePatch(int32_t face, Side side) {
  int32_t& patch = facePatch[size_t(face) * 2 + side];
  if (patch < 0) {
    patch = int32_t(patches.size());
    Patch& whole = patches.emplace_back();
    whole.face = face;
    whole.side = side;
    whole.corners = {mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2)};
  }
  return patch;
}

std::vector<int32_t> LeafMesh::Implementation::Parts(int32_t id) const {
  const Patch& patch = patches[size_t(id)];
  std::vector<int32_t> parts(size_t(patch.partCount));
  std::iota(parts.begin(), parts.end(), patch.firstPart);
  return parts;
}

std::vector<int32_t> LeafMesh::Implementation::Split(int32_t id) {
  Patch& patch = patches[size_t(id)];
  if (patch.firstPart >= 0) return Parts(id);
  if (patch.meshFace < 0) AddIsland(id);
  BorderOf(patch, &scratch);
  if (PatchExtent(scratch.polygon) < kSmallestPatch * scratch.faceLength) {
    throw Error("A patch of face " + std::to_string(patch.face) +
                " is too small to be split; stop at larger patches.");
  }

  // Triangles in four (3.4.2); what lines of light have left of them, as all else, in two (4.4.2).
  if (options.refinement == PatchRefinement::Quadtree && IsTriangle(scratch.polygon)) {
    return Quarter(id, SideMiddles(scratch.polygon));
  }
  return Halve(id, CutPatch(scratch.polygon, options.snapTolerance));
}

std::vector<int32_t> LeafMesh::Implementation::SplitAlong(int32_t id,
                                                          const std::array<LeafLine, 2>& lines) {
  // The ends of the lines in the plane of the face.
  if (patches[size_t(id)].firstPart >= 0) {
    throw Error("Patch " + std::to_string(id) + " is split already; split one of its leaves.");
  }
  if (patches[size_t(id)].meshFace < 0) AddIsland(id);
  BorderOf(patches[size_t(id)], &scratch);
  std::array<std::array<Vec2d, 2>, 2> ends;
  for (size_t line = 0; line < 2; ++line) {
    for (size_t end = 0; end < 2; ++end) ends[line][end] = PlaceOn(scratch, lines[line][end]);
  }

  // Each line cuts the part that it crosses.
  std::vector<int32_t> leaves = {id};
  for (const auto& [a, b] : ends) {
    for (size_t i = 0; i < leaves.size(); ++i) {
      BorderOf(patches[size_t(leaves[i])], &scratch);
      if (PatchExtent(scratch.polygon) < kSmallestPatch * scratch.faceLength) continue;
      const auto cut = CutPatchAlong(scratch.polygon, a, b);
      if (!cut) continue;
      const std::vector<int32_t> halves = Halve(leaves[i], *cut);
      leaves[i] = halves[0];
      leaves.push_back(halves[1]);
      break;
    }
  }
  return leaves.size() > 1 ? leaves : Split(id);
}

Vec2d LeafMesh::Implementation::PlaceOn(const Border& border, const LeafBorderPlace& place) const {
  const auto position = [&](int32_t number) {
    for (size_t i = 0; i < border.vertices.size(); ++i) {
      if (meshVertices[size_t(border.vertices[i])].number == number)
        return border.polygon[i].position;
    }
    throw Error("Vertex " + std::to_string(number) + " is not on the border of the patch.");
  };
  return position(place.from) * (1 - place.fraction) + position(place.to) * place.fraction;
}

// Splits a patch whose border is in `scratch` along one line.
std::vector<int32_t> LeafMesh::Implementation::Halve(int32_t id,
                                                     const std::array<PatchCutEnd, 2>& cut) {
  const Patch& patch = patches[size_t(id)];
  const int32_t from = CutVertex(patch, scratch, cut[0]);
  const int32_t to = CutVertex(patch, scratch, cut[1]);
  const int32_t line = 3 + int32_t(patches.size());
  return MakeParts(id, {patch.meshFace, DrawLine(patch.meshFace, from, to, line)});
}

// Splits a triangle whose border is in `scratch`: lines from middle to middle cut its corners off.
std::vector<int32_t> LeafMesh::Implementation::Quarter(int32_t id,
                                                       const std::array<PatchCutEnd, 3>& middles) {
  const Patch& patch = patches[size_t(id)];
  std::array<int32_t, 3> vertices;
  for (size_t side = 0; side < 3; ++side) {
    vertices[side] = CutVertex(patch, scratch, middles[side]);
  }
  std::vector<int32_t> meshFaces = {patch.meshFace};
  for (size_t side = 0; side < 3; ++side) {
    const int32_t line = 3 + int32_t(patches.size() + side);
    const int32_t before = vertices[(side + 2) % 3];
    meshFaces.push_back(DrawLine(patch.meshFace, vertices[side], before, line));
  }
  return MakeParts(id, meshFaces);
}

// Draws a line across a polygon of the half-edge mesh; what lies left of it becomes a polygon of
// its own.
int32_t LeafMesh::Implementation::DrawLine(int32_t meshFace, int32_t from, int32_t to,
                                           int32_t line) {
  HalfedgeHandle intoFrom, outOfTo;
  for (const HalfedgeHandle halfedge : halfedges.fh_range(FaceHandle(meshFace))) {
    if (halfedges.to_vertex_handle(halfedge).idx() == from) intoFrom = halfedge;
    if (halfedges.from_vertex_handle(halfedge).idx() == to) outOfTo = halfedge;
  }
  const HalfedgeHandle drawn = halfedges.insert_edge(intoFrom, outOfTo);
  lineOfEdge.push_back(line);
  patchOfMeshFace.push_back(-1);
  return halfedges.face_handle(drawn).idx();
}

// The polygons that lines have cut a patch into are its parts.
std::vector<int32_t> LeafMesh::Implementation::MakeParts(int32_t id,
                                                         const std::vector<int32_t>& meshFaces) {
  Patch& patch = patches[size_t(id)];
  patch.firstPart = int32_t(patches.size());
  patch.partCount = int32_t(meshFaces.size());
  patch.meshFace = -1;
  patch.triangles = {};
  for (const int32_t meshFace : meshFaces) {
    patchOfMeshFace[size_t(meshFace)] = int32_t(patches.size());
    Patch& part = patches.emplace_back();
    part.face = patch.face;
    part.side = patch.side;
    part.meshFace = meshFace;
    BorderOf(part, &scratch);
    part.corners = CornersOf(scratch);
  }
  return Parts(id);
}

// Makes the patch of a whole face a triangle of the half-edge mesh, with the points already on its
// edges.
void LeafMesh::Implementation::AddIsland(int32_t id) {
  Patch& patch = patches[size_t(id)];
  std::array<VertexHandle, 3> corners;
  for (int corner = 0; corner < 3; ++corner) {
    Vec3d weights;
    weights[corner] = 1;
    const int32_t point = mesh.triangles[size_t(patch.face)][size_t(corner)];
    corners[size_t(corner)] = VertexHandle(AddMeshVertex(weights, point));
  }
  const int32_t firstEdge = int32_t(halfedges.n_edges());
  patch.meshFace = halfedges.add_face(corners.data(), corners.size()).idx();
  patchOfMeshFace.push_back(id);

  for (uint8_t corner = 0; corner < 3; ++corner) {
    lineOfEdge.push_back(corner);
    const LeafMeshEdges::FaceEdge found = edges.FindOrAdd(patch.face, corner);
    if (size_t(found.edge) >= edgeUses.size()) edgeUses.resize(size_t(found.edge) + 1);
    edgeUses[size_t(found.edge)].push_back(
        {patch.face, patch.side, corner, found.isForward, found.name, {firstEdge + corner}});
  }
  for (uint8_t corner = 0; corner < 3; ++corner) {
    const int32_t edge = edges.Find(patch.face, corner).edge;
    for (EdgeUse& use : edgeUses[size_t(edge)]) {
      if (use.face != patch.face || use.side != patch.side || use.corner != corner) continue;
      const int32_t points = int32_t(edges.Points(edge).size());
      for (int32_t index = 0; index < points; ++index) SplitRim(edge, &use, index);
    }
  }
}

int32_t LeafMesh::Implementation::AddMeshVertex(const Vec3d& weights, int32_t number) {
  meshVertices.push_back({weights, number});
  return halfedges.new_vertex().idx();
}

// Puts a vertex into an edge of the half-edge mesh. The new edge is the part on the side of the
// edge's first halfedge's origin; halfedges keep their directions.
void LeafMesh::Implementation::SplitMeshEdge(int32_t edge, int32_t vertex) {
  const EdgeHandle handle(edge);
  for (unsigned i = 0; i < 2; ++i) {
    const FaceHandle face = halfedges.face_handle(halfedges.halfedge_handle(handle, i));
    if (face.is_valid()) patches[size_t(patchOfMeshFace[size_t(face.idx())])].triangles.clear();
  }
  halfedges.split_edge(handle, VertexHandle(vertex));
  lineOfEdge.push_back(lineOfEdge[size_t(edge)]);
}

// Takes a point of an input edge up into one island's rim.
void LeafMesh::Implementation::SplitRim(int32_t edge, EdgeUse* use, int32_t index) {
  const double t = edges.Points(edge)[size_t(index)];
  const int corner = use->corner, next = (corner + 1) % 3;
  Vec3d weights;
  weights[use->isForward ? corner : next] = 1 - t;
  weights[use->isForward ? next : corner] = t;
  const int32_t vertex = AddMeshVertex(weights, edges.VertexNumber(edge, use->name, index));
  SplitMeshEdge(use->segments[size_t(index)], vertex);
  use->segments.insert(use->segments.begin() + index + (use->isForward ? 0 : 1),
                       int32_t(halfedges.n_edges()) - 1);
}

// The mesh vertex where a splitting line ends; made where there is none.
int32_t LeafMesh::Implementation::CutVertex(const Patch& patch, const Border& border,
                                            const PatchCutEnd& end) {
  if (end.to < 0) return border.vertices[size_t(end.from)];
  const int32_t count = int32_t(border.vertices.size());
  const int32_t halfedge =
      border.halfedges[size_t((end.from + 1) % count == end.to ? end.from : end.to)];
  const Vec3d a = meshVertices[size_t(border.vertices[size_t(end.from)])].weights;
  const Vec3d b = meshVertices[size_t(border.vertices[size_t(end.to)])].weights;
  const Vec3d weights = a * (1 - end.fraction) + b * end.fraction;

  const int32_t line = lineOfEdge[size_t(halfedge / 2)];
  if (line < 3) return RimVertex(patch, line, weights[line], weights[(line + 1) % 3]);
  const int32_t vertex = AddMeshVertex(weights, edges.AddInnerVertex(patch.face, weights));
  SplitMeshEdge(halfedge / 2, vertex);
  return vertex;
}

// Puts a point into the input edge that begins at corner `line`, and so into all islands along it.
int32_t LeafMesh::Implementation::RimVertex(const Patch& patch, int32_t line, double fromWeight,
                                            double toWeight) {
  const LeafMeshEdges::FaceEdge found = edges.Find(patch.face, line);
  const double t = (found.isForward ? toWeight : fromWeight) / (fromWeight + toWeight);
  const std::vector<double>& points = edges.Points(found.edge);
  int32_t index =
      int32_t(std::lower_bound(points.begin(), points.end(), t - kSameParameter) - points.begin());
  if (size_t(index) == points.size() || points[size_t(index)] > t + kSameParameter) {
    edges.InsertPoint(found.edge, index, t);
    for (EdgeUse& use : edgeUses[size_t(found.edge)]) SplitRim(found.edge, &use, index);
  }
  for (const EdgeUse& use : edgeUses[size_t(found.edge)]) {
    if (use.face != patch.face || use.side != patch.side || use.corner != line) continue;
    const EdgeHandle segment(use.segments[size_t(index)]);
    const HalfedgeHandle halfedge = halfedges.halfedge_handle(segment, use.isForward ? 0 : 1);
    return halfedges.to_vertex_handle(halfedge).idx();
  }
  throw Error("An edge of face " + std::to_string(patch.face) + " is not in the leaf mesh.");
}

void LeafMesh::Implementation::BorderOf(const Patch& patch, Border* border) const {
  border->polygon.clear();
  border->vertices.clear();
  border->halfedges.clear();
  const auto flat =
      FlattenTriangle(Vec3d(mesh.Corner(patch.face, 0)), Vec3d(mesh.Corner(patch.face, 1)),
                      Vec3d(mesh.Corner(patch.face, 2)));
  border->faceLength = std::max({flat[0].x, flat[1].x, flat[2].x});
  const HalfedgeHandle start = halfedges.halfedge_handle(FaceHandle(patch.meshFace));
  HalfedgeHandle halfedge = start;
  int32_t lineBefore = lineOfEdge[size_t(halfedges.prev_halfedge_handle(start).idx() / 2)];
  do {
    const int32_t vertex = halfedges.from_vertex_handle(halfedge).idx();
    const int32_t line = lineOfEdge[size_t(halfedge.idx() / 2)];
    const Vec3d& w = meshVertices[size_t(vertex)].weights;
    border->polygon.push_back({flat[0] * w.x + flat[1] * w.y + flat[2] * w.z, line != lineBefore});
    border->vertices.push_back(vertex);
    border->halfedges.push_back(halfedge.idx());
    lineBefore = line;
    halfedge = halfedges.next_halfedge_handle(halfedge);
  } while (halfedge != start);
}

std::vector<Vec3f> LeafMesh::Implementation::CornersOf(const Border& border) const {
  const auto count = std::count_if(border.polygon.begin(), border.polygon.end(),
                                   [](const PatchBorderVertex& v) { return v.isCorner; });
  std::vector<Vec3f> corners;
  corners.reserve(size_t(count));
  for (size_t i = 0; i < border.vertices.size(); ++i) {
    if (!border.polygon[i].isCorner) continue;
    corners.push_back(edges.Position(meshVertices[size_t(border.vertices[i])].number));
  }
  return corners;
}

LeafMesh::LeafMesh(const TriangleMesh& mesh, const LeafMeshOptions& options)
    : implementation_(std::make_unique<Implementation>(mesh, options)) {
  if (!(options.snapTolerance >= 0 && options.snapTolerance < 0.5f)) {
    throw Error("The snap tolerance of patches must lie in [0, 0.5).");
  }
}

LeafMesh::~LeafMesh() = default;

const LeafMeshOptions& LeafMesh::Options() const { return implementation_->options; }
int32_t LeafMesh::FacePatch(int32_t face, Side side) {
  return implementation_->FacePatch(face, side);
}
std::vector<int32_t> LeafMesh::Split(int32_t patch) { return implementation_->Split(patch); }
std::vector<int32_t> LeafMesh::SplitAlong(int32_t patch, const std::array<LeafLine, 2>& lines) {
  return implementation_->SplitAlong(patch, lines);
}
int32_t LeafMesh::FindFacePatch(int32_t face, Side side) const {
  return implementation_->facePatch[size_t(face) * 2 + side];
}
std::vector<int32_t> LeafMesh::Parts(int32_t patch) const { return implementation_->Parts(patch); }
int32_t LeafMesh::PatchCount() const { return int32_t(implementation_->patches.size()); }
int32_t LeafMesh::PatchFace(int32_t patch) const {
  return implementation_->patches[size_t(patch)].face;
}
Side LeafMesh::PatchSide(int32_t patch) const {
  return implementation_->patches[size_t(patch)].side;
}
const std::vector<Vec3f>& LeafMesh::Corners(int32_t patch) const {
  return implementation_->patches[size_t(patch)].corners;
}
std::vector<LeafTriangle> LeafMesh::Triangulate(const std::vector<uint8_t>& litSides) {
  return implementation_->Triangulate(litSides);
}
const std::vector<LeafVertex>& LeafMesh::Vertices() const {
  return implementation_->edges.Vertices();
}

}  // namespace lambert
