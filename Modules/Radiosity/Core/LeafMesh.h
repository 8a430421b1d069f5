// The leaves below the input triangles: patches split by lines (thesis 4.4) or regularly (3.4.2),
// and the triangles drawn in the end.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// How a patch is split: in halves across its minimum-area rectangle (thesis 4.4.2), or into four
/// triangles at the middles of its sides (3.4.2).
enum class PatchRefinement : uint8_t { Rectangle, Quadtree };
/// "rectangle" or "quadtree".
inline const char* RefinementName(PatchRefinement refinement) {
  return refinement == PatchRefinement::Quadtree ? "quadtree" : "rectangle";
}

struct LeafMeshOptions {
  PatchRefinement refinement = PatchRefinement::Rectangle;
  /// A line across a rectangle moves to a vertex within this fraction of its longer side, [0, 0.5).
  float snapTolerance = 0.15f;
};

/// A point of the output mesh: a place within an input triangle of one side of one surface.
struct LeafVertex {
  Vec3f position;
  std::array<int32_t, 3>
      points;     ///< input points that it interpolates; on an edge the first comes again as third
  Vec3f weights;  ///< of those points; sum 1
};

/// A triangle of the output mesh. Vertex numbers below the mesh's point count are input points;
/// others are LeafMesh::Vertex(number - point count).
struct LeafTriangle {
  std::array<int32_t, 3>
      vertices;      ///< in the stored winding of the input face (also for the back side)
  int32_t face = 0;  ///< input triangle
  uint8_t side = kFront;
  int32_t patch = -1;  ///< leaf patch it lies in; -1 where the face has none
};

/// A place on a patch's border: `fraction` of the way between two of the output vertices on one
/// straight side of it.
struct LeafBorderPlace {
  int32_t from = 0, to = 0;
  double fraction = 0;
};

/// A line across a patch, from one place on its border to another.
using LeafLine = std::array<LeafBorderPlace, 2>;

/// Patches on a half-edge mesh that holds split triangles only; every other triangle finds the
/// points on its edges by the positions of their ends when it is triangulated. Patches may be read
/// from several threads while none splits.
class LeafMesh {
 public:
  LeafMesh(const TriangleMesh& mesh, const LeafMeshOptions& options = {});
  ~LeafMesh();

  const LeafMeshOptions& Options() const;

  /// The patch that is the whole of `face` seen from `side`; made at the first call.
  int32_t FacePatch(int32_t face, Side side);
  /// The same where it has been made; -1 else.
  int32_t FindFacePatch(int32_t face, Side side) const;
  /// Splits a leaf patch across the longer side of its minimum-area rectangle, at its middle,
  /// snapped to vertices where they are near (4.4.2); or regularly, a triangle into four (3.4.2).
  /// Returns the parts, which become leaves in its place. All have area, also in slivers and in
  /// triangles without any. Of a patch that is split already it returns the parts. Throws Error
  /// where the patch is a 1e-10th of its face across.
  std::vector<int32_t> Split(int32_t patch);

  /// Splits a leaf patch along two lines that do not cross within it: into three, or two where one
  /// of the lines only touches it; where both do, as Split. Returns the leaves in its place.
  /// Throws Error where an end of a line names a vertex that is not on the patch's border.
  std::vector<int32_t> SplitAlong(int32_t patch, const std::array<LeafLine, 2>& lines);

  /// What a patch has been split into, in a row; empty for a leaf.
  std::vector<int32_t> Parts(int32_t patch) const;

  /// Patches so far, split ones included; they are numbered from 0 and keep their numbers.
  int32_t PatchCount() const;
  int32_t PatchFace(int32_t patch) const;
  Side PatchSide(int32_t patch) const;
  /// Corners of the patch: a convex polygon counter-clockwise about the face's front normal,
  /// without t-vertices.
  const std::vector<Vec3f>& Corners(int32_t patch) const;

  /// Triangles of every lit side of every face (`litSides`, per face: bit 1 front, bit 2 back),
  /// refined or not, so that no vertex lies inside another triangle's edge: t-vertices are taken up
  /// by constrained Delaunay triangulation (4.4.3), across surfaces and at non-manifold edges too
  /// (matched through positions). Patches whose border has not changed keep their triangulation of
  /// the last call.
  std::vector<LeafTriangle> Triangulate(const std::vector<uint8_t>& litSides);

  const std::vector<LeafVertex>& Vertices() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lambert
