#include "LightMapFile.h"

#include "Atlas/vtkAtlasAdapter.h"
#include "Common/Core/Error.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"

#include <stb_image_write.h>

#include <filesystem>

namespace lambert {
std::vector<std::string> LightMapPageNames(const std::string& fileName, int pages) {
  const std::filesystem::path path(fileName);
  std::vector<std::string> names;
  for (int page = 0; page < pages; ++page) {
    const std::string name = path.stem().string() + "-" + std::to_string(page) + ".hdr";
    names.push_back((path.parent_path() / name).string());
  }
  return names;
}

namespace {
void WriteMesh(vtkPolyData* mesh, const std::string& fileName) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(fileName.c_str());
  if (!writer->Write()) {
    throw Error("The light map " + fileName + " could not be written.");
  }
}

/// The uppermost row first.
void WritePages(const LightMap& map, const std::string& fileName) {
  const std::vector<std::string> names =
      LightMapPageNames(fileName, static_cast<int>(map.pages.size()));
  const size_t size = static_cast<size_t>(map.pageSize);
  std::vector<float> rows(size * size * 3);
  for (size_t page = 0; page < names.size(); ++page) {
    for (size_t y = 0; y < size; ++y) {
      for (size_t x = 0; x < size; ++x) {
        const Spectrum& texel = map.pages[page][(size - 1 - y) * size + x];
        for (int band = 0; band < 3; ++band) {
          rows[(y * size + x) * 3 + static_cast<size_t>(band)] = texel[band];
        }
      }
    }
    if (!stbi_write_hdr(names[page].c_str(), map.pageSize, map.pageSize, 3, rows.data())) {
      throw Error("The page " + names[page] + " could not be written.");
    }
  }
}
}  // namespace

void WriteLightMap(const RadiosityAtlas& atlas, const LightMap& map, const Scene& scene,
                   const std::string& fileName) {
  vtkNew<vtkPolyData> mesh;
  PolyDataFromAtlas(atlas, scene, mesh);
  WriteMesh(mesh, fileName);
  WritePages(map, fileName);
}

void WriteRepresentedScene(const RepresentedScene& represented, const Scene& scene,
                           const std::string& fileName) {
  vtkNew<vtkPolyData> mesh;
  PolyDataFromRepresentedScene(represented, scene, mesh);
  WriteMesh(mesh, fileName);
  WritePages(represented.map, fileName);
}
}  // namespace lambert
