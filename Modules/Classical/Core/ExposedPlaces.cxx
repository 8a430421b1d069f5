#include "Classical/Core/ExposedPlaces.h"

#include "Common/Core/Random.h"

namespace lambert {

bool ExposedPlaces::IsExposed(const Vec3f& position, const Vec3f& normal, uint64_t seed,
                              int64_t* rays) const {
  constexpr int kRays = 8;
  Random random(seed);
  Vec3f u, v;
  CoordinateSystem(normal, &u, &v);
  for (int ray = 0; ray < kRays; ++ray) {
    const Vec3f d = CosineHemisphere((float(ray) + random.Uniform()) / kRays, random.Uniform());
    const Vec3f direction = Normalize(u * d.x + v * d.y + normal * d.z);
    const RayHit hit = rayScene_.Closest(position, direction);
    ++*rays;
    if (hit.face < 0) return true;
    const bool isFront = Dot(scene_.mesh.VectorArea(hit.face), direction) < 0;
    if (litFaces_[size_t(hit.face)] & (isFront ? 1 : 2)) return true;
  }
  return false;
}

}  // namespace lambert
