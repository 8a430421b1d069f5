// The report of a run as JSON. Documentation/CommandLine.md lists every field. C++ only.
#ifndef RunReport_h
#define RunReport_h

#include "lambertEngineModule.h"

#include <string>

namespace lambert {
class RadiosityRun;

/// What was read and what clean-up changed: the report of `lambert info`. Load() must be done.
LAMBERTENGINE_EXPORT std::string SceneReportJson(const RadiosityRun& run);
/// All of it: scene, clean-up, stages, solver, balance, error. `version` is the program's.
LAMBERTENGINE_EXPORT std::string RunReportJson(const RadiosityRun& run, const std::string& version);
}  // namespace lambert

#endif
