// The one mesh that flows through the pipeline: triangles in world space, with what light needs to know of each face.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "Common/Core/Spectrum.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// Sides of a face. The front is the side that the stored winding (counter-clockwise) faces.
enum Side : uint8_t { kFront = 0, kBack = 1 };

/// Bits of TriangleMesh::faceFlags.
enum FaceFlag : uint8_t {
  kEmitsFront = 1,  ///< emits `emittance` from the front of the stored winding
  kEmitsBack = 2,   ///< emits `emittance` from the back of the stored winding
  kRewound = 4,     ///< the stored winding is the reverse of the file's; the file's front is our back
};

/// Triangles with materials, as structure of arrays. Lengths in metres. Arrays "per face" have one entry a triangle.
struct TriangleMesh {
  // Points.
  std::vector<Vec3f> positions;  ///< world space, m
  std::vector<Vec3f> normals;    ///< unit, one a point; empty where there are none
  std::vector<Vec2f> uvs;        ///< one a point; empty where there are none

  // Faces.
  std::vector<std::array<int32_t, 3>> triangles;  ///< three point indices, counter-clockwise from the front
  std::vector<Spectrum> reflectance;              ///< per face, [0, 0.98]
  std::vector<Spectrum> emittance;                ///< per face, exitance in W/m2 of each emitting side
  std::vector<uint8_t> faceFlags;                 ///< per face, FaceFlag bits
  std::vector<int32_t> materialId;                ///< per face, row of the material table
  std::vector<int32_t> partId;                    ///< per face, row of the part table
  std::vector<int32_t> surfaceId;     ///< per face, row of the surface table; empty until clustered
  std::vector<int64_t> sourceCellId;  ///< per face, the face of that part as it came in

  int64_t FaceCount() const { return int64_t(triangles.size()); }
  int64_t PointCount() const { return int64_t(positions.size()); }

  const Vec3f& Corner(int64_t face, int corner) const {
    return positions[size_t(triangles[size_t(face)][size_t(corner)])];
  }
  /// Half the cross product of two edges: area (m2) along the front normal.
  Vec3f VectorArea(int64_t face) const {
    const Vec3f& p = Corner(face, 0);
    return Cross(Corner(face, 1) - p, Corner(face, 2) - p) * 0.5f;
  }
  float Area(int64_t face) const { return Length(VectorArea(face)); }
  /// Unit geometric normal of the front; zero for a triangle without area.
  Vec3f FrontNormal(int64_t face) const { return Normalize(VectorArea(face)); }
  bool Emits(int64_t face, Side side) const {
    return (faceFlags[size_t(face)] & (side == kFront ? kEmitsFront : kEmitsBack)) != 0;
  }
  Box3f Bounds() const;

  /// Gives every per-face array its default where it is missing: grey 0.5, no emission, material and part 0, and
  /// numbers of the faces as they stand. Throws Error where an array has another length than its owner, where an
  /// index is out of range or a coordinate is not finite.
  void Complete();
};

}  // namespace lambert
