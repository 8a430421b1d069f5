#include "vtkAtlasAdapter.h"

#include "Common/Core/Error.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneAdapter.h"
#include "vtkTriangleMeshAdapter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkValueArrays.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace lambert {
namespace {
using Names = vtkRadiosityArrays;

constexpr const char* kSource = "the output of vtkRadiosityAtlas or of lambert atlas";

vtkDataArray* RequireArray(vtkFieldData* data, const char* name, int components, size_t count) {
  return lambert::RequireArray(data, name, components, count, "mesh", kSource);
}

double RequireNumber(vtkFieldData* fields, const char* name, double least, double most) {
  const double number = RequireArray(fields, name, 1, 1)->GetComponent(0, 0);
  if (!(number >= least && number <= most)) {
    throw Error(std::string("The number in the array ") + name + " is none of an atlas; it takes " +
                kSource + " as it is.");
  }
  return number;
}

Error OutOfOrder(size_t face) {
  return Error("The charts of the mesh are out of order at face " + std::to_string(face) +
               "; it takes " + kSource + " as it is.");
}

/// Charts and their pages, and how many faces have them: those that their points light come last.
/// Charts are numbered by their first faces.
size_t ReadCharts(vtkPolyData* input, RadiosityAtlas* atlas) {
  const size_t all = static_cast<size_t>(input->GetNumberOfCells());
  const std::vector<int32_t> charts =
      NumbersFromArray<int32_t>(RequireArray(input->GetCellData(), Names::ChartId(), 1, all));
  const std::vector<int32_t> pages =
      NumbersFromArray<int32_t>(RequireArray(input->GetCellData(), Names::PageId(), 1, all));
  const size_t faces =
      static_cast<size_t>(std::find(charts.begin(), charts.end(), -1) - charts.begin());
  for (size_t face = faces; face < all; ++face) {
    if (charts[face] != -1) throw OutOfOrder(face);
  }
  for (size_t face = 0; face < faces; ++face) {
    const int32_t count = static_cast<int32_t>(atlas->set.charts.size());
    if (charts[face] < 0 || charts[face] > count || pages[face] < 0) {
      throw OutOfOrder(face);
    }
    if (charts[face] == count) {
      atlas->set.charts.emplace_back();
      atlas->pageOfChart.push_back(pages[face]);
      atlas->pages = std::max(atlas->pages, pages[face] + 1);
    } else if (pages[face] != atlas->pageOfChart[static_cast<size_t>(charts[face])]) {
      throw OutOfOrder(face);
    }
    ++atlas->set.charts[static_cast<size_t>(charts[face])].faceCount;
  }

  if (atlas->pages > static_cast<int>(atlas->set.charts.size())) {
    throw Error("The mesh has more pages than charts; it takes " + std::string(kSource) +
                " as it is.");
  }

  // The faces of each, side by side.
  std::vector<int32_t> next;
  int32_t first = 0;
  for (Chart& chart : atlas->set.charts) {
    chart.first = first;
    next.push_back(first);
    first += chart.faceCount;
  }
  atlas->set.faces.resize(faces);
  for (size_t face = 0; face < faces; ++face) {
    atlas->set.faces[static_cast<size_t>(next[static_cast<size_t>(charts[face])]++)] =
        static_cast<int32_t>(face);
  }
  return faces;
}

/// Where the corners of the faces lie on their pages.
void ReadPlaces(vtkPointData* points, const TriangleMesh& mesh, RadiosityAtlas* atlas) {
  const std::vector<Vec2f> coords = TuplesFromArray<Vec2f>(
      RequireArray(points, Names::LightMapTCoords(), 2, mesh.positions.size()),
      Names::LightMapTCoords());
  const auto isOnPage = [](const Vec2f& p) { return p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1; };
  for (const std::array<int32_t, 3>& triangle : mesh.triangles) {
    std::array<Vec2f, 3> places;
    for (size_t c = 0; c < 3; ++c) {
      places[c] = coords[static_cast<size_t>(triangle[c])];
      if (!isOnPage(places[c])) {
        throw Error("Point " + std::to_string(triangle[c]) +
                    " of the mesh lies on no page; it takes " + kSource + " as it is.");
      }
    }
    atlas->textureCoords.push_back(places);
  }
}

/// Points of one number become one.
void JoinPoints(const std::vector<int64_t>& shared, TriangleMesh* mesh) {
  std::vector<Vec3f> positions;
  std::unordered_map<int64_t, int32_t> pointOfNumber;
  for (std::array<int32_t, 3>& triangle : mesh->triangles) {
    for (int32_t& corner : triangle) {
      const auto [point, isNew] = pointOfNumber.try_emplace(shared[static_cast<size_t>(corner)],
                                                            static_cast<int32_t>(positions.size()));
      if (isNew) {
        positions.push_back(mesh->positions[static_cast<size_t>(corner)]);
      }
      corner = point->second;
    }
  }
  mesh->positions = std::move(positions);
  mesh->normals.clear();
  mesh->uvs.clear();
}

/// The atlas that a mesh carries, and its faces that have charts as they lie in it.
RadiosityAtlas ReadAtlas(vtkPolyData* input, TriangleMesh* mesh) {
  constexpr double kLeastPage = 16, kMostPage = 16384, kMostPadding = 64;
  *mesh = TriangleMeshFromPolyData(input);
  vtkFieldData* fields = input->GetFieldData();
  RadiosityAtlas atlas;
  atlas.pageSize =
      static_cast<int>(RequireNumber(fields, Names::AtlasPageSize(), kLeastPage, kMostPage));
  atlas.padding = static_cast<int>(RequireNumber(fields, Names::AtlasPadding(), 0, kMostPadding));
  atlas.texelSize = RequireNumber(fields, Names::AtlasTexelSize(), 0,
                                  static_cast<double>(std::numeric_limits<float>::max()));
  mesh->triangles.resize(ReadCharts(input, &atlas));
  atlas.set.places.resize(mesh->triangles.size());
  ReadPlaces(input->GetPointData(), *mesh, &atlas);
  return atlas;
}

///@{ What the faces of an atlas show, where it tells.
bool HasSides(vtkPolyData* input) { return input->GetCellData()->HasArray(Names::Side()) != 0; }

std::vector<int64_t> InputFaces(vtkPolyData* input) {
  return NumbersFromArray<int64_t>(RequireArray(input->GetCellData(), Names::InputFaceId(), 1,
                                                static_cast<size_t>(input->GetNumberOfCells())));
}

std::vector<uint8_t> Sides(vtkPolyData* input) {
  return SidesFromArray(RequireArray(input->GetCellData(), Names::Side(), 1,
                                     static_cast<size_t>(input->GetNumberOfCells())));
}
///@}

/// What texture coordinates are of.
void AddAtlasFields(const RadiosityAtlas& atlas, vtkFieldData* fields) {
  fields->AddArray(
      ArrayFromNumbers<vtkIntArray>(Names::AtlasPageSize(), std::vector<int>{atlas.pageSize}));
  fields->AddArray(
      ArrayFromNumbers<vtkIntArray>(Names::AtlasPadding(), std::vector<int>{atlas.padding}));
  fields->AddArray(ArrayFromNumbers<vtkDoubleArray>(Names::AtlasTexelSize(),
                                                    std::vector<double>{atlas.texelSize}));
}
}  // namespace

RadiosityAtlas AtlasFromPolyData(vtkPolyData* input, TriangleMesh* mesh,
                                 RadiositySolution* solution) {
  RadiosityAtlas atlas = ReadAtlas(input, mesh);
  if (mesh->FaceCount() < input->GetNumberOfCells()) {
    throw Error("Face " + std::to_string(mesh->FaceCount()) +
                " of the mesh is lit at its points and has no chart; it takes " + kSource + ".");
  }
  JoinPoints(NumbersFromArray<int64_t>(RequireArray(input->GetPointData(), Names::SharedPointId(),
                                                    1, mesh->positions.size())),
             mesh);
  if (HasSides(input)) {
    *solution = OntoShownSides(std::move(*solution), InputFaces(input), Sides(input));
  }
  return atlas;
}

StoredAtlas StoredAtlasFromPolyData(vtkPolyData* input) {
  StoredAtlas stored;
  TriangleMesh mesh;
  stored.atlas = ReadAtlas(input, &mesh);
  CompleteAtlas(mesh, &stored.atlas);
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    stored.corners.push_back({mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2)});
  }

  // What they are of.
  const size_t faces = mesh.triangles.size();
  stored.isOfChosen = faces < static_cast<size_t>(input->GetNumberOfCells());
  if (stored.isOfChosen || HasSides(input)) {
    stored.inputFace = InputFaces(input);
    stored.inputFace.resize(faces);
  }
  if (HasSides(input)) {
    stored.side = Sides(input);
    stored.side.resize(faces);
  }
  return stored;
}

void PagesFromLightMap(const LightMap& map, vtkMultiBlockDataSet* output) {
  output->SetNumberOfBlocks(static_cast<unsigned>(map.pages.size()));
  for (size_t page = 0; page < map.pages.size(); ++page) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(map.pageSize, map.pageSize, 1);
    image->GetPointData()->SetScalars(ArrayFromTuples(Names::Irradiance(), map.pages[page]));
    output->SetBlock(static_cast<unsigned>(page), image);
  }
}

void PolyDataFromRepresentedScene(const RepresentedScene& represented, Scene scene,
                                  vtkPolyData* output) {
  RepresentedMesh joined = JoinRepresentations(represented);
  for (const int64_t face : joined.inputFace) {
    joined.mesh.surfaceId.push_back(scene.mesh.surfaceId[static_cast<size_t>(face)]);
  }
  scene.mesh = std::move(joined.mesh);
  PolyDataFromScene(scene, output);
  vtkPointData* points = output->GetPointData();
  points->AddArray(ArrayFromTuples(Names::LightMapTCoords(), joined.lightMapCoords));
  points->AddArray(ArrayFromTuples(Names::Irradiance(), joined.irradiance));
  points->AddArray(ArrayFromNumbers<vtkIdTypeArray>(Names::SharedPointId(), joined.sharedPoint));
  vtkCellData* cells = output->GetCellData();
  cells->AddArray(ArrayFromNumbers<vtkIntArray>(Names::ChartId(), joined.chart));
  cells->AddArray(ArrayFromNumbers<vtkIntArray>(Names::PageId(), joined.page));
  cells->AddArray(ArrayFromNumbers<vtkIdTypeArray>(Names::InputFaceId(), joined.inputFace));
  if (!joined.side.empty()) {
    cells->AddArray(ArrayFromNumbers<vtkUnsignedCharArray>(Names::Side(), joined.side));
  }
  AddAtlasFields(represented.atlas, output->GetFieldData());
}

void PolyDataFromAtlas(const RadiosityAtlas& atlas, Scene scene, vtkPolyData* output,
                       const ShownSides* shown) {
  std::vector<int64_t> shared;
  const std::vector<Vec2f> coordinates = SplitAtCharts(atlas, &scene.mesh, &shared);
  PolyDataFromScene(scene, output);
  vtkPointData* points = output->GetPointData();
  points->AddArray(ArrayFromTuples(Names::LightMapTCoords(), coordinates));
  points->AddArray(ArrayFromNumbers<vtkIdTypeArray>(Names::SharedPointId(), shared));
  AddAtlasFields(atlas, output->GetFieldData());

  vtkNew<vtkIntArray> charts, pages;
  charts->SetName(Names::ChartId());
  pages->SetName(Names::PageId());
  charts->SetNumberOfValues(scene.mesh.FaceCount());
  pages->SetNumberOfValues(scene.mesh.FaceCount());
  for (size_t i = 0; i < atlas.set.charts.size(); ++i) {
    const Chart& chart = atlas.set.charts[i];
    for (const int32_t face : atlas.set.FacesOf(chart)) {
      charts->SetValue(face, static_cast<int>(i));
      pages->SetValue(face, atlas.pageOfChart[i]);
    }
  }
  output->GetCellData()->AddArray(charts);
  output->GetCellData()->AddArray(pages);
  if (shown) {
    output->GetCellData()->AddArray(
        ArrayFromNumbers<vtkIdTypeArray>(Names::InputFaceId(), shown->inputFace));
    output->GetCellData()->AddArray(
        ArrayFromNumbers<vtkUnsignedCharArray>(Names::Side(), shown->side));
  }
}
}  // namespace lambert
