// Which places on a face lie open, and which are buried in another thing: a floor goes on below a
// box, where no light is. Elements that are buried in part would lose light and darken the contact.
#pragma once

#include <cstdint>
#include <vector>

#include "Scene/Core/Scene.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

class ExposedPlaces {
 public:
  /// Keeps references to all. `litFaces`: per face of the scene, bit 1 where light reaches its
  /// front, bit 2 its back.
  ExposedPlaces(const Scene& scene, const RayScene& rayScene, const std::vector<uint8_t>& litFaces)
      : scene_(scene), rayScene_(rayScene), litFaces_(litFaces) {}

  /// True where one of a few rays meets a side that light reaches, or nothing. Adds the rays to
  /// `rays`.
  bool IsExposed(const Vec3f& position, const Vec3f& normal, uint64_t seed, int64_t* rays) const;

 private:
  const Scene& scene_;
  const RayScene& rayScene_;
  const std::vector<uint8_t>& litFaces_;
};

}  // namespace lambert
