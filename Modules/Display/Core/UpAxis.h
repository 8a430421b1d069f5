// Which way is up: formats but glTF do not say.
#pragma once

#include "Common/Core/TriangleMesh.h"

namespace lambert {

enum class UpAxis { X, Y, Z };

/// Z where clearly more area lies level with it up, 1.3 times as much as with y up; else Y. Floors,
/// ceilings and tables are level; walls face two ways and share.
UpAxis GuessUpAxis(const TriangleMesh& mesh);

/// A vector of a frame whose y is up, in the frame whose `up` is; ToYUp the other way. Rotations.
Vec3d FromYUp(const Vec3d& v, UpAxis up);
Vec3d ToYUp(const Vec3d& v, UpAxis up);

}  // namespace lambert
