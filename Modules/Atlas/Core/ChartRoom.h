// The room that a chart takes of a page, and with which padding it is worth cutting it apart.
#pragma once

#include <array>
#include <vector>

#include "Common/Core/Vector.h"

namespace lambert {

/// A rectangle by what it takes of a page.
struct Room {
  double area = 0;       ///< m2
  double perimeter = 0;  ///< m
};
/// Of the smallest rectangle about places, m.
Room RoomOf(const std::vector<Vec2d>& places);
/// The widest margin around them, m, with which `parts` take this `fraction`, under 2, of the room
/// of `whole` at most; negative where they do not with any.
double MostMargin(const Room& whole, const std::array<Room, 2>& parts, double fraction);

}  // namespace lambert
