// A scene that was stored in pieces, each of which can be used alone: what they repeat becomes one
// again.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "Scene/Core/SceneAssembly.h"

namespace lambert {

class PieceJoining {
 public:
  /// Joins the pieces that are added to `assembly` from now on, each told of before it is.
  explicit PieceJoining(SceneAssembly* assembly);

  /// Takes away the lights of a piece where an earlier one has the same.
  void TakeRepeatedLights(Scene* piece);

  /// Tells which rows of the scene's table the materials of a piece are; no more than those are
  /// left to it. None where the piece is a scene of its own: then no materials are joined.
  void NumberMaterials(const std::optional<std::vector<int32_t>>& rows, Scene* piece);

  /// Brings the materials of all pieces into the scene's order; those of one row that do not differ
  /// are one.
  void JoinMaterials();

 private:
  SceneAssembly* assembly_;
  size_t firstMaterial_, firstMesh_;
  bool areNumbered_ = true;
  std::vector<int32_t> rows_;  ///< of the materials that the pieces have, one after the other
  std::vector<std::vector<Light>> lights_;  ///< that differ from each other
};

}  // namespace lambert
