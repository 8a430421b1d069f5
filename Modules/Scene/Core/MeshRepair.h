// Repairs that change no surface: points that coincide, triangles without area, triangles that
// repeat another.
#pragma once

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// Joins points where position, normal and texture coordinates agree exactly, and leaves out points
/// of no face.
struct WeldCounts {
  int64_t welded = 0;  ///< points joined to another
  int64_t unused = 0;  ///< points of no face, left out
};
WeldCounts WeldPoints(TriangleMesh* mesh);

/// Leaves out points of no face; returns how many.
int64_t RemoveUnusedPoints(TriangleMesh* mesh);

/// True where a triangle's height is below 1e-7 of its longest edge: float coordinates cannot say
/// where it faces.
bool HasNoArea(const Vec3f& a, const Vec3f& b, const Vec3f& c);

/// Drops the triangles without area; returns how many.
int64_t RemoveZeroAreaFaces(TriangleMesh* mesh);

struct RepeatCounts {
  int64_t removed = 0;
  int64_t otherMaterial = 0;  ///< of these, with another material than the copy that stays
};
/// Drops polygons of the file (runs of one sourceCellId) and then triangles that have the positions
/// and the outline of another, in either winding. The first copy stays, or the first that emits;
/// where copies of one emittance emit to both sides, it emits to both. Two copies that emit
/// differently to either side both stay.
RepeatCounts RemoveRepeatedFaces(TriangleMesh* mesh);

/// Keeps the faces with keep[face] != 0, in their order.
void KeepFaces(const std::vector<uint8_t>& keep, TriangleMesh* mesh);

}  // namespace lambert
