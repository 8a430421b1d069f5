// Where light at the vertices of a mesh is asked for: a hair inside their triangles, so that
// corners leak in none.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"
#include "Reference/Core/PathTracedIrradiance.h"

namespace lambert {

/// How far a vertex is drawn toward the mean of its triangles' centroids, as a fraction of the way.
constexpr double kVertexDraw = 1e-3;

/// One side of a vertex.
struct VertexReceiver {
  int32_t point;  ///< of the mesh
  int32_t face;   ///< one of the point's triangles; `receiver` lies on it
  Side side;      ///< of that face, by its stored winding
  ReceiverPoint receiver;
  Vec3f inside;  ///< place on the face of which `receiver` lies kVertexDraw of the way
};

/// The receivers of a mesh, two a point and adjacent: first the side that the point's normal faces,
/// then the other, with the normal reversed. In the order of the points; a point all of whose
/// triangles have no area has none.
///
/// A point is drawn kVertexDraw of the way toward the mean of the centroids of its triangles (those
/// with area) and put onto that one of them over or under which it then lies, the nearest if there
/// are several, the first of equals. Where it lies over none of them (about a reflex corner) it is
/// drawn toward the centroid of the largest. So it never leaves the surface. Its geometric normal
/// is that of the face; a mesh without normals takes it for the point's, too.
std::vector<VertexReceiver> VertexReceivers(const TriangleMesh& mesh);

}  // namespace lambert
