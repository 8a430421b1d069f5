// One unit normal a point: the file's where it has one, else made from the faces around it.
#pragma once

#include "Scene/Core/MeshTopology.h"

namespace lambert {

/// True where every point has a normal of unit length.
bool HasUnitNormals(const TriangleMesh& mesh);

struct PointNormalCounts {
  int64_t made = 0;      ///< points of the result whose normal was made because the mesh had none
  int64_t repaired = 0;  ///< points of the result whose normal was zero or not finite in the file
};

/// Gives every point of `mesh` a unit normal. A usable one stays (brought to unit length). Where
/// there is none, it is the mean of the faces about the point, weighted by the angles of their
/// corners, over those faces that join across consistently wound manifold edges bent by at most
/// `featureAngle` (degrees); a point whose faces fall apart into several such groups is split: its
/// first group keeps the point, the others get copies at the end of the arrays. `topology` is that
/// of the mesh; its per-point array grows with the copies.
PointNormalCounts CompletePointNormals(double featureAngle, TriangleMesh* mesh,
                                       MeshTopology* topology);

}  // namespace lambert
