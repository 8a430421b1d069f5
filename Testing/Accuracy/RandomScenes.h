// Scenes by seed, as bad as real files hold them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Scene/Core/Scene.h"

namespace lambert::testing {

struct RandomScene {
  Scene scene;
  bool isClosed = false;  ///< in a room: nothing escapes
  bool hasSky = false;
};

/// Of two faces in one place each is lit as if the other were not there, and only one is seen:
/// light doubles. Laws that add up power do without such faces.
enum class Overlaps { Allowed, None };

/// 100 to 250 triangles within 2 m of the origin: loose ones that cross one another; ones that
/// touch the last along an edge or at a corner, lie in its plane and overlap it, repeat it in
/// either winding, or run nearly parallel to it at a hair's distance; slivers; faces without area;
/// welded strips. Some emit, from either side or from both, some of these reflect too. Odd seeds
/// are closed; one in three of the even ones has a sky.
RandomScene MakeRandomScene(uint64_t seed, Overlaps overlaps);

/// All sides of all faces emit 1 W/m2 and reflect `rho`, without other lights: in a closed scene
/// light is 1 / (1 - rho) everywhere.
void MakeFurnace(float rho, Scene* scene);

/// Faces emit 1 W/m2 from both sides where `lit` says so, and reflect nothing; without other
/// lights.
void MakeBlack(const std::vector<uint8_t>& lit, Scene* scene);

/// Seeds that laws are put to: a dozen, or as many (LAMBERT_LAWS_COUNT) from any one on
/// (LAMBERT_LAWS_SEED) as the environment says.
std::vector<uint64_t> LawSeeds();
/// How to have a failure again.
std::string HowToRepeat(uint64_t seed);

}  // namespace lambert::testing
