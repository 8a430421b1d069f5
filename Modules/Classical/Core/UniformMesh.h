// A scene's faces cut into elements of like size: what methods on a fixed mesh compute on, and the
// way from their light to a solution.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

/// More elements than this are refused.
constexpr int64_t kMaximumElements = int64_t(1) << 26;

/// Triangles of which no edge is longer than the element size, without t-vertices where the scene's
/// faces share their edges' positions. Elements have two sides, numbered 2 element + side.
struct UniformMesh {
  double elementSize = 0;  ///< m

  // Vertices: first the scene's points, in their order, then those on edges between them.
  std::vector<Vec3f> positions;  ///< m
  std::vector<Vec3f> normals;    ///< unit, interpolated
  std::vector<Vec2f> uvs;        ///< interpolated; empty where the scene has none

  // Elements, in the order of the scene's faces; those of a face and of a patch lie together.
  std::vector<std::array<int32_t, 3>> triangles;  ///< vertices, counter-clockwise from the front
  std::vector<int32_t> face;                      ///< per element: the scene's face

  // Patches: triangles that elements were cut from, no edge longer than the patch size.
  std::vector<std::array<int32_t, 3>> patches;  ///< vertices, counter-clockwise from the front
  std::vector<int32_t> patchBegin;  ///< first element of each patch; one more at the end

  int64_t ElementCount() const { return int64_t(triangles.size()); }
  int64_t PatchCount() const { return int64_t(patches.size()); }
  const Vec3f& Corner(int64_t element, int corner) const {
    return positions[size_t(triangles[size_t(element)][size_t(corner)])];
  }
  Vec3f Centroid(int64_t element) const {
    return (Corner(element, 0) + Corner(element, 1) + Corner(element, 2)) / 3.f;
  }
  /// Area (m2) along the front normal.
  Vec3f VectorArea(int64_t element) const {
    const Vec3f& p = Corner(element, 0);
    return Cross(Corner(element, 1) - p, Corner(element, 2) - p) * 0.5f;
  }
  float Area(int64_t element) const { return Length(VectorArea(element)); }
};

/// The element size that is meant, m: 1/50 of the scene's diagonal for 0. Throws Error for a
/// negative or non-finite size.
double ResolveElementSize(const Scene& scene, double elementSize);

/// Halves edges until none is longer than `elementSize` (m; 0: 1/50 of the scene's diagonal). An
/// edge is cut by its own length alone, so that neighbours agree. Patches are the triangles on the
/// way whose edges first are at most `patchSize` (m; the element size where it is less). Throws
/// Error for a mesh without point normals and for more than kMaximumElements.
UniformMesh MakeUniformMesh(const Scene& scene, double elementSize, double patchSize = 0);

/// The place at an output point from which its light is gathered.
struct ElementReceiver {
  /// Drawn to the middle of the point's elements, on `element`: 1e-3 of the way, 4e-5 of the
  /// scene's diagonal at least, half the way at most.
  Vec3f position;
  Vec3f normal;     ///< unit, the point's: delivered irradiance is for this one
  Vec3f geometric;  ///< unit, of the element's side: only its hemisphere sees light
  int32_t element = -1;
  Side side = kFront;
};

/// What a solution on a uniform mesh delivers, before its light: elements of the modelled sides,
/// and points that are shared neither across sides nor across surfaces (or materials).
struct UniformSolution {
  RadiositySolution solution;              ///< black
  std::vector<int32_t> element;            ///< per output face; its side is solution.side
  std::vector<int32_t> vertex;             ///< per output point: the mesh's vertex
  std::vector<ElementReceiver> receivers;  ///< per output point

  int64_t PointCount() const { return int64_t(vertex.size()); }
};

/// `litSides`: per face of the scene, bit 1 front, bit 2 back; a face that has none is delivered
/// black, by its front.
UniformSolution MakeUniformSolution(const Scene& scene, const UniformMesh& mesh,
                                    const std::vector<uint8_t>& litSides);

/// Irradiance at every output point (W/m2): the mean of the elements about it, weighted by their
/// angles there. `elementIrradiance`: per element side, W/m2.
std::vector<Spectrum> MeanAboutPoints(const UniformSolution& uniform,
                                      const std::vector<Spectrum>& elementIrradiance);

/// The solution with irradiance `irradiance` (per output point, W/m2), and what follows from it:
/// radiosity, and the light of the scene's own points.
RadiositySolution DeliverLight(const Scene& scene, UniformSolution uniform,
                               std::vector<Spectrum> irradiance);

}  // namespace lambert
