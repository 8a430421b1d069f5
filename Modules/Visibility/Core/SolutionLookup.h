// The light that a solution delivers at a place on a face: which refined triangle lies there, and
// its interpolation.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// Finds refined triangles by input face, side and position. Safe to use from several threads.
class SolutionLookup {
 public:
  /// A place in the refined mesh.
  struct Place {
    int32_t triangle = -1;  ///< of the solution's mesh; -1 where that side is not modelled
    Vec3f weights;          ///< of its corners; sum 1
  };

  /// Keeps a reference to `solution`, of a mesh of `faceCount` faces. Throws Error where the
  /// solution names other faces or its arrays do not fit its mesh.
  SolutionLookup(const RadiositySolution& solution, int64_t faceCount);

  /// True where the solution has triangles on that side.
  bool Models(int64_t face, Side side) const {
    const size_t key = Key(face, side);
    return begin_[key] < begin_[key + 1];
  }
  /// The place nearest to `position` among the triangles of that side; a position just outside all
  /// of them by rounding finds the border.
  Place Find(int64_t face, Side side, const Vec3f& position) const;

  /// Interpolated irradiance and radiosity, W/m2; black where nothing is modelled.
  Spectrum Irradiance(const Place& place) const { return Interpolate(place, solution_.irradiance); }
  Spectrum Radiosity(const Place& place) const { return Interpolate(place, solution_.radiosity); }

 private:
  struct Node {
    Box3f bounds;
    int32_t begin = 0, end = 0;  ///< of a leaf, into order_
    int32_t second = -1;  ///< index of the second child; the first follows its parent; -1: a leaf
  };
  static size_t Key(int64_t face, Side side) { return size_t(face) * 2 + size_t(side); }
  /// The nearest place so far, and its squared distance, m2.
  struct Nearest {
    Place place;
    double distance;
  };
  int32_t Build(int32_t begin, int32_t end);
  void Search(int32_t root, const Vec3f& position, Nearest* nearest) const;
  void Compare(int32_t begin, int32_t end, const Vec3f& position, Nearest* nearest) const;
  Spectrum Interpolate(const Place& place, const std::vector<Spectrum>& values) const;

  const RadiositySolution& solution_;
  std::vector<int32_t> order_;  ///< refined triangles, those of one side of one face together
  std::vector<int32_t> begin_;  ///< per face and side, and one more: its first in order_
  std::unordered_map<size_t, int32_t> roots_;  ///< by face and side, where those are many: its node
  std::vector<Node> nodes_;
};

}  // namespace lambert
