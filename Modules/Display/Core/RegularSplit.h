// Places spread evenly over a triangle.
#pragma once

#include "Common/Core/Vector.h"

namespace lambert {

/// Calls visit(b) with the barycentrics, of corners 1 and 2, of the middles of the n x n like
/// triangles that a triangle is split into.
template <class Visit>
void ForEachMiddleOfSplit(int n, const Visit& visit) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < 2 * (n - i) - 1; ++j) {
      const float third = j % 2 ? 2 / 3.f : 1 / 3.f;
      visit(Vec2f((float(i) + third) / float(n), (float(j / 2) + third) / float(n)));
    }
  }
}

}  // namespace lambert
