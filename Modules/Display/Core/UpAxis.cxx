#include "Display/Core/UpAxis.h"

#include <cmath>

namespace lambert {

UpAxis GuessUpAxis(const TriangleMesh& mesh) {
  constexpr double kMargin = 1.3;   // Halls with more of one wall than of floor stay below.
  constexpr double kLevel = 0.985;  // Cosine of ten degrees.
  double levelWithY = 0, levelWithZ = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const Vec3f across = mesh.VectorArea(face);
    const float area = Length(across);
    if (std::abs(across.y) > kLevel * area) levelWithY += area;
    if (std::abs(across.z) > kLevel * area) levelWithZ += area;
  }
  return levelWithZ > kMargin * levelWithY ? UpAxis::Z : UpAxis::Y;
}

Vec3d FromYUp(const Vec3d& v, UpAxis up) {
  if (up == UpAxis::X) return {v.y, -v.x, v.z};
  if (up == UpAxis::Z) return {v.x, -v.z, v.y};
  return v;
}

Vec3d ToYUp(const Vec3d& v, UpAxis up) {
  if (up == UpAxis::X) return {-v.y, v.x, v.z};
  if (up == UpAxis::Z) return {v.x, v.z, -v.y};
  return v;
}

}  // namespace lambert
