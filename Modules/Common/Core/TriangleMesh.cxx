#include "Common/Core/TriangleMesh.h"

#include <numeric>

#include "Common/Core/Error.h"

namespace lambert {

namespace {

template <class T>
void FillOrCheck(std::vector<T>* values, size_t count, const T& value, const char* name) {
  if (values->empty()) values->assign(count, value);
  if (values->size() != count) {
    throw Error(std::string("The array ") + name + " has " + std::to_string(values->size()) +
                " entries where the mesh has " + std::to_string(count) +
                " faces; give one entry a face.");
  }
}

}  // namespace

Box3f TriangleMesh::Bounds() const {
  Box3f bounds;
  for (const Vec3f& p : positions) bounds.Include(p);
  return bounds;
}

void TriangleMesh::Complete() {
  const size_t faces = triangles.size();
  for (size_t face = 0; face < faces; ++face) {
    for (const int32_t point : triangles[face]) {
      if (point < 0 || size_t(point) >= positions.size()) {
        throw Error("Face " + std::to_string(face) + " names point " + std::to_string(point) +
                    " where the mesh has " + std::to_string(positions.size()) + " points.");
      }
    }
  }
  for (size_t point = 0; point < positions.size(); ++point) {
    if (!IsFinite(positions[point])) {
      throw Error("Point " + std::to_string(point) +
                  " has a coordinate that is not a finite number; repair the input.");
    }
  }
  if (!normals.empty() && normals.size() != positions.size()) {
    throw Error("The mesh has normals for only some of its points; give one a point or none.");
  }
  if (!uvs.empty() && uvs.size() != positions.size()) {
    throw Error("The mesh has texture coordinates for only some of its points; give one a point or none.");
  }
  FillOrCheck(&reflectance, faces, Spectrum(0.5f), "Reflectance");
  FillOrCheck(&emittance, faces, Spectrum(0.f), "Emittance");
  if (faceFlags.empty()) {
    faceFlags.assign(faces, 0);
    for (size_t face = 0; face < faces; ++face) {
      if (!emittance[face].IsBlack()) faceFlags[face] = kEmitsFront;
    }
  }
  FillOrCheck(&faceFlags, faces, uint8_t(0), "FaceFlags");
  FillOrCheck(&materialId, faces, 0, "MaterialId");
  FillOrCheck(&partId, faces, 0, "PartId");
  if (sourceCellId.empty()) {
    sourceCellId.resize(faces);
    std::iota(sourceCellId.begin(), sourceCellId.end(), int64_t(0));
  }
  FillOrCheck(&sourceCellId, faces, int64_t(0), "SourceCellId");
  if (!surfaceId.empty()) FillOrCheck(&surfaceId, faces, 0, "SurfaceId");
}

}  // namespace lambert
