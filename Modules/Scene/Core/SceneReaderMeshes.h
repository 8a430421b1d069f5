// From the importer's polygons to triangles with the light properties of each.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "Scene/Core/SceneReaderMaterials.h"

struct aiMesh;

namespace lambert {

/// Triangles of a polygon, as places in it, in its own winding: a fan where it is convex, else by
/// cutting ears. n corners give n - 2 triangles, always; triangles of a polygon that crosses itself
/// may overlap.
std::vector<std::array<int32_t, 3>> TriangulatePolygon(const std::vector<Vec3f>& corners);

/// What the faces of a material were found to need.
struct MaterialUse {
  bool clamped = false;      ///< a face was over kMaximumReflectance in a band
  bool transparent = false;  ///< a face was left out
};

/// The mesh of one `source`, which is taken apart, in object space. `material` is row `materialId`
/// of the scene's table; `keepNormals` is false where the file's normals are those of facets.
/// Transparent triangles are left out and counted. Throws Error for points that are not finite and
/// for indices beyond them.
TriangleMesh ReadMesh(aiMesh* source, const SurfaceMaterial& material, int32_t materialId,
                      bool keepNormals, const std::string& file, const ReadContext& context,
                      MaterialUse* use);

}  // namespace lambert
