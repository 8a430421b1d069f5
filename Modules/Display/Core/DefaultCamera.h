// A view of a solved scene where its file brings none.
#pragma once

#include <vector>

#include "Display/Core/UpAxis.h"
#include "Scene/Core/Scene.h"

namespace lambert {

/// Looks into a closed room from within, towards where it is deep and bright; through the open side
/// of a room that has one; else at the whole from the front and a little above. `up` is up.
/// `radiosity` is per point of `mesh`, W/m2; a mesh without triangles gives the default camera.
Camera DefaultCamera(const TriangleMesh& mesh, const std::vector<Spectrum>& radiosity,
                     double aspectRatio = 4. / 3, UpAxis up = UpAxis::Y);

}  // namespace lambert
