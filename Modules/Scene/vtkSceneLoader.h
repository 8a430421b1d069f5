// From files to one cleaned scene; what the reader class and the command line share. C++ only.
#ifndef vtkSceneLoader_h
#define vtkSceneLoader_h

#include "Scene/Core/SceneCleaning.h"
#include "Scene/Core/SceneReader.h"
#include "lambertSceneModule.h"

namespace lambert {
/// Reads `files` in the given order (VTP and VTPC by VTK, after all others), applies
/// `materialSettings` (see ApplyMaterialSetting), cleans and places. A VTP keeps its parts,
/// materials, lights and camera, and a VTPC those of all its pieces, with what they repeat once;
/// the first camera found counts. The reports may be null. Throws Error, one clear sentence, and
/// Cancelled.
LAMBERTSCENE_EXPORT Scene LoadScene(const std::vector<std::string>& files,
                                    const SceneReaderOptions& readerOptions = {},
                                    const CleaningOptions& cleaningOptions = {},
                                    const std::vector<std::string>& materialSettings = {},
                                    ReadReport* readReport = nullptr,
                                    CleaningReport* cleaningReport = nullptr,
                                    const ProgressCallback& progress = {});
}  // namespace lambert

#endif
