// Atlases from files: what `lambert atlas` and light maps leave. C++ only.
#ifndef AtlasFile_h
#define AtlasFile_h

#include "Atlas/Core/StoredAtlas.h"
#include "lambertEngineModule.h"

#include <string>
#include <vector>

namespace lambert {
/// The atlas in a .vtp, or in the pieces of a .vtpc, whose names go to `pieces` if given. Throws
/// Error, one clear sentence, where there is none.
LAMBERTENGINE_EXPORT StoredAtlas ReadAtlas(const std::string& fileName,
                                           std::vector<std::string>* pieces = nullptr);
}  // namespace lambert

#endif
