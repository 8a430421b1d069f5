#include "SurfaceMeans.h"

#include "AccuracyScenes.h"
#include "Common/Core/Error.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert::testing {

namespace {

using Kind = Quantity::Kind;

/// Mean over the fronts of the faces of a material; the light between vertices is linear.
double MeanOverSurface(const Scene& scene, const RadiositySolution& solution,
                       const std::vector<Spectrum>& light, int material) {
  double sum = 0;
  for (int64_t t = 0; t < solution.mesh.FaceCount(); ++t) {
    const size_t face = size_t(solution.inputFaceId[size_t(t)]);
    if (solution.side[size_t(t)] != kFront) continue;
    if (material >= 0 && scene.mesh.materialId[face] != material) continue;
    const double third = double(solution.mesh.Area(t)) / 3;
    for (const int32_t p : solution.mesh.triangles[size_t(t)]) {
      sum += double(light[size_t(p)].g) * third;
    }
  }
  return sum / SurfaceArea(scene.mesh, material);
}

/// Delivered at a place on the front of a face.
double AtPlace(const Scene& scene, const RadiositySolution& solution, const Quantity& quantity) {
  const SolutionLookup lookup(solution, scene.mesh.FaceCount());
  for (int64_t face = 0; face < scene.mesh.FaceCount(); ++face) {
    if (Dot(scene.mesh.FrontNormal(face), quantity.normal) < 0.999f) continue;
    const Vec3f a = scene.mesh.Corner(face, 0), b = scene.mesh.Corner(face, 1),
                c = scene.mesh.Corner(face, 2);
    if (std::abs(Dot(quantity.position - a, quantity.normal)) > 1e-5f) continue;
    const auto inside = [&](const Vec3f& p, const Vec3f& q) {
      return Dot(Cross(q - p, quantity.position - p), quantity.normal) >= -1e-6f;
    };
    if (!inside(a, b) || !inside(b, c) || !inside(c, a)) continue;
    return double(lookup.Irradiance(lookup.Find(face, kFront, quantity.position)).g);
  }
  throw Error("No face holds the place of \"" + quantity.label + "\".");
}

}  // namespace

double SurfaceArea(const TriangleMesh& mesh, int material) {
  double area = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    if (material < 0 || mesh.materialId[size_t(face)] == material) area += double(mesh.Area(face));
  }
  return area;
}

double Scale(const TriangleMesh& mesh, const Quantity& quantity) {
  if (quantity.kind != Kind::FormFactor) return quantity.scale;
  return SurfaceArea(mesh, kReceiver) / SurfaceArea(mesh, kSource);
}

double ReadQuantity(const Scene& scene, const RadiositySolution& solution,
                    const Quantity& quantity) {
  const auto asked = [&] {
    switch (quantity.kind) {
      case Kind::At:
        return AtPlace(scene, solution, quantity);
      case Kind::FormFactor:
      case Kind::AtFacet:
        return MeanOverSurface(scene, solution, solution.irradiance, kReceiver);
      case Kind::MeanIrradiance:
        return MeanOverSurface(scene, solution, solution.irradiance, quantity.material);
      default:
        return MeanOverSurface(scene, solution, solution.radiosity, quantity.material);
    }
  };
  return Scale(scene.mesh, quantity) * asked() + quantity.offset;
}

}  // namespace lambert::testing
