// The displayable mesh: leaf triangles and the points at which light is asked for, in the terms of
// the contract.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/LightReconstruction.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

class RefinedMesh {
 public:
  /// One per vertex, surface and side.
  struct Point {
    uint64_t key = 0;  ///< of its vertex, surface and side: the same after another triangulation
    Vec3f position;
    Vec3f normal;        ///< unit; irradiance is for it
    Vec3f inside;        ///< light is asked for a little toward it: for an input point as
                         ///< VertexReceivers says, else the middle of the largest triangle here
    Vec3f insideNormal;  ///< unit, of the face that lies there
    Vec2f uv;
    Spectrum reflectance, emittance;  ///< means over the faces that meet here
  };
  /// A corner of a leaf triangle.
  struct Corner {
    int32_t triangle, corner;
  };
  struct Range {
    int32_t begin, end;
  };
  /// What is asked of a mesh beside its points and triangles.
  enum class Use : uint8_t {
    Links,  ///< light from the links, other materials: who meets at a point stays known
    Gather  ///< neither
  };

  /// Triangulates the leaves. `litSides` as given to the hierarchy, per surface; a face that has no
  /// lit side is delivered black, by its front.
  RefinedMesh(ElementHierarchy* hierarchy, const std::vector<uint8_t>& litSides, Use use);

  /// Again, after patches were split.
  void Triangulate();
  /// Reflectance and emittance of the points by those that the faces have now.
  void TakeMaterials();

  const std::vector<Point>& Points() const { return points_; }
  const std::vector<LeafTriangle>& Triangles() const { return triangles_; }
  /// Per triangle, in the winding of its face's front.
  const std::vector<std::array<int32_t, 3>>& PointsOfTriangles() const { return pointsOfTriangle_; }

  /// Irradiance at the points from the links, W/m2: mean over the leaves that meet there, by angle.
  /// Adds the transfers to the points that `transfers` does not know, a place a point, and the rays
  /// cast to `rays`.
  std::vector<Spectrum> Light(const LightReconstruction& light, KeptTransfers* transfers,
                              int64_t* rays) const;
  /// The solution that has `irradiance` (W/m2) at its points.
  RadiositySolution Deliver(const std::vector<Spectrum>& irradiance) const;

 private:
  Point MakePoint(const Range& group) const;
  void AverageMaterial(const Range& group, Point* point) const;
  std::vector<LightReconstruction::Share> Shares(int64_t point) const;

  ElementHierarchy* hierarchy_;
  const Use use_;
  std::vector<uint8_t> faceSides_;
  /// What lies inside of an input point, and the front normal of the face that does.
  struct Inside {
    Vec3f position, frontNormal;
  };
  std::vector<Inside> insideOfPoint_;
  std::vector<LeafTriangle> triangles_;
  std::vector<int32_t> leaves_;  ///< per triangle: its leaf element; -1 for none
  std::vector<Corner> corners_;  ///< by vertex, surface and side; kept for links
  std::vector<Range> groups_;    ///< per point: of corners_; kept for links
  std::vector<Point> points_;
  std::vector<std::array<int32_t, 3>> pointsOfTriangle_;
};

}  // namespace lambert
