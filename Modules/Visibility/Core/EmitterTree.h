// Choice of an emitting face as seen from a point, with a probability that can be asked for
// afterwards.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// A binary tree over the emitting faces of a mesh, walked from the root by what each half may send
/// to a point: power over squared distance, the cosine at the receiver and the cone of the
/// emitters' normals (Conty and Kulla 2018); among emitters that are far and turned alike, by power
/// alone. The choice never matters for the mean, only for the noise.
class EmitterTree {
 public:
  /// A place on an emitter and its density over solid angle, 1/sr; density 0 where there is none.
  struct Sample {
    int32_t face = -1;
    Vec3f direction;     ///< unit, from the receiver
    float distance = 0;  ///< m
    float density = 0;
  };

  explicit EmitterTree(const TriangleMesh& mesh);

  bool IsEmpty() const { return emitters_.empty(); }
  /// Picks a direction towards an emitter from `position` with normal `normal`; u in [0,1)^3.
  Sample Pick(const Vec3f& position, const Vec3f& normal, const double u[3]) const;
  /// The density with which Pick returns the place on `face` at `distance` in the unit direction
  /// `direction`.
  float Density(const Vec3f& position, const Vec3f& normal, int32_t face, const Vec3f& direction,
                float distance) const;

 private:
  struct Emitter {
    int32_t face;
    uint64_t trail = 0;  ///< bit k: the way taken from the root at depth k
    Vec3f corners[3];
    Vec3f normal;  ///< of the emitting side
    Vec3f center;
    float area, power;
    bool twoSided;
  };
  struct Node {
    Vec3f center, axis;
    float radius = 0;                    ///< of the bounding sphere, m
    float cosSpread = 1, sinSpread = 0;  ///< half-angle of the cone of normals about the axis
    float power = 0;                     ///< W
    bool twoSided = false;
    int32_t second = -1;         ///< index of the second child; the first follows its parent
    int32_t begin = 0, end = 0;  ///< of its emitters; one of a leaf
  };

  int32_t Build(int32_t begin, int32_t end, int depth, uint64_t trail);
  Node Enclose(int32_t begin, int32_t end) const;
  /// True for a leaf, and where its emitters are chosen from `position` by power alone.
  static bool IsSmall(const Node& node, const Vec3f& position);
  static float Importance(const Node& node, const Vec3f& position, const Vec3f& normal);
  static double PlaceDensity(const Emitter& emitter, const Vec3f& position, const Vec3f& direction,
                             float distance);

  std::vector<Emitter> emitters_;
  std::vector<double> powerBefore_;  ///< of the emitters before each, and of all, W
  std::vector<Node> nodes_;
  std::vector<int32_t> emitterOfFace_;
};

}  // namespace lambert
