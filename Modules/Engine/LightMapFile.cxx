#include "LightMapFile.h"

#include "Atlas/vtkAtlasAdapter.h"
#include "PolyDataFile.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

namespace lambert {
void WriteLightMap(const RadiosityAtlas& atlas, const Scene& scene, const ShownSides* shown,
                   const std::string& fileName) {
  vtkNew<vtkPolyData> mesh;
  PolyDataFromAtlas(atlas, scene, mesh, shown);
  WritePolyData(mesh, fileName);
}

void WriteRepresentedScene(const RepresentedScene& represented, const Scene& scene,
                           const std::string& fileName) {
  vtkNew<vtkPolyData> mesh;
  PolyDataFromRepresentedScene(represented, scene, mesh);
  WritePolyData(mesh, fileName);
}

void WritePages(const LightMap& map, const RadiositySolution& solution,
                const ToneMappingOptions& tone, const std::string& fileName,
                const std::vector<PageFormat>& formats) {
  const ToneMapping toneMapping(LuminanceSamples(solution.mesh, solution.radiosity), tone);
  for (const PageFormat format : formats) {
    WriteLightMapPages(map, fileName, format, [&](const Spectrum& irradiance) {
      return toneMapping.ApplyToBytes(irradiance);
    });
  }
}
}  // namespace lambert
