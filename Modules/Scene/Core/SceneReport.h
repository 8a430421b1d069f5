// The account of reading and cleaning a scene, for reports.
#pragma once

#include <string>

#include "Scene/Core/SceneCleaning.h"

namespace lambert {

/// A JSON object with "read" and "cleaning", each with every count of its struct under the struct's
/// own names, and "warnings", the sentences of both.
std::string SceneReportJson(const ReadReport& read, const CleaningReport& cleaning);

}  // namespace lambert
