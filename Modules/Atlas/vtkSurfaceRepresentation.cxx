#include "vtkSurfaceRepresentation.h"

#include "Atlas/Core/SurfaceRepresentation.h"
#include "Atlas/Core/WantedRepresentations.h"
#include "Clustering/vtkClusterTreeAdapter.h"
#include "vtkAtlasAdapter.h"
#include "vtkCoreShell.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSceneAdapter.h"
#include "vtkTable.h"

#include <map>

struct vtkSurfaceRepresentation::Settings {
  lambert::RepresentationOptions Choice;
  lambert::AtlasOptions Atlas;
  lambert::WantedRepresentations Wanted;
};

/// What the inputs say, their time stamps, and what has been made of them.
struct vtkSurfaceRepresentation::Kept {
  vtkMTimeType MeshTime = 0, TreeTime = 0, SolutionTime = 0;
  lambert::Scene Scene;
  lambert::ClusterTree Tree;
  lambert::RadiositySolution Solution;
  std::unique_ptr<lambert::KeptRepresentation> Representation;
};

namespace {
constexpr const char* kChoice = "A representation is AUTOMATIC, POINTS or LIGHT_MAP";

template <class Name>
int Wanted(const std::map<Name, lambert::Representation>& wanted, const Name& name) {
  const auto found = wanted.find(name);
  return found != wanted.end() ? static_cast<int>(found->second)
                               : vtkSurfaceRepresentation::AUTOMATIC;
}

/// Whether that is new.
template <class Name>
bool Want(const Name& name, int kind, std::map<Name, lambert::Representation>* wanted) {
  if (Wanted(*wanted, name) == kind) return false;
  (*wanted)[name] = static_cast<lambert::Representation>(kind);
  return true;
}

template <class Name>
void PrintWanted(ostream& os, vtkIndent indent, const char* sort,
                 const std::map<Name, lambert::Representation>& wanted) {
  for (const auto& [name, kind] : wanted) {
    os << indent << "Representation of " << sort << " " << name << ": " << static_cast<int>(kind)
       << "\n";
  }
}
}  // namespace

vtkStandardNewMacro(vtkSurfaceRepresentation);

vtkSurfaceRepresentation::vtkSurfaceRepresentation()
    : Options(std::make_unique<Settings>()), Last(std::make_unique<Kept>()) {
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(3);
}

vtkSurfaceRepresentation::~vtkSurfaceRepresentation() = default;

int vtkSurfaceRepresentation::FillInputPortInformation(int port, vtkInformation* information) {
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(),
                   port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkSurfaceRepresentation::FillOutputPortInformation(int port, vtkInformation* information) {
  static const char* const types[] = {"vtkPolyData", "vtkMultiBlockDataSet", "vtkTable"};
  information->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
// Options of the algorithms, forwarded.
lambertOptionMacro(vtkSurfaceRepresentation, IntroducedTriangles, vtkIdType,
                   Choice.introducedTriangles);
lambertOptionMacro(vtkSurfaceRepresentation, SplitSurfaces, bool, Choice.splitSurfaces);
lambertOptionMacro(vtkSurfaceRepresentation, Stretch, double, Atlas.stretch);
lambertOptionMacro(vtkSurfaceRepresentation, PageSize, int, Atlas.pageSize);
lambertOptionMacro(vtkSurfaceRepresentation, Pages, int, Atlas.pages);
lambertOptionMacro(vtkSurfaceRepresentation, TexelSize, double, Atlas.texelSize);
lambertOptionMacro(vtkSurfaceRepresentation, Padding, int, Atlas.padding);
lambertOptionMacro(vtkSurfaceRepresentation, MipLevels, int, Atlas.mipLevels);
lambertChoiceMacro(vtkSurfaceRepresentation, TexelDensity, lambert::TexelDensity, Atlas.density,
                   ILLUMINATION, "The density of texels is UNIFORM or ILLUMINATION");

void vtkSurfaceRepresentation::SetRepresentation(const std::string& material, int kind) {
  lambertRequireChoiceMacro(kind, LIGHT_MAP, kChoice);
  if (Want(material, kind, &this->Options->Wanted.byMaterial)) this->Modified();
}

int vtkSurfaceRepresentation::GetRepresentation(const std::string& material) {
  return Wanted(this->Options->Wanted.byMaterial, material);
}

void vtkSurfaceRepresentation::SetPartRepresentation(const std::string& part, int kind) {
  lambertRequireChoiceMacro(kind, LIGHT_MAP, kChoice);
  if (Want(part, kind, &this->Options->Wanted.byPart)) this->Modified();
}

int vtkSurfaceRepresentation::GetPartRepresentation(const std::string& part) {
  return Wanted(this->Options->Wanted.byPart, part);
}

void vtkSurfaceRepresentation::SetSurfaceRepresentation(int surface, int kind) {
  lambertRequireChoiceMacro(kind, LIGHT_MAP, kChoice);
  if (Want(surface, kind, &this->Options->Wanted.bySurface)) this->Modified();
}

int vtkSurfaceRepresentation::GetSurfaceRepresentation(int surface) {
  return Wanted(this->Options->Wanted.bySurface, surface);
}

//------------------------------------------------------------------------------
namespace {
/// A row a surface.
void FillCosts(const std::vector<lambert::SurfaceCost>& surfaces, vtkTable* table) {
  const auto add = [&](auto array, const char* name, const auto& value) {
    array->SetName(name);
    for (const lambert::SurfaceCost& surface : surfaces) {
      array->InsertNextValue(value(surface));
    }
    table->AddColumn(array);
  };
  using Cost = lambert::SurfaceCost;
  add(vtkNew<vtkIdTypeArray>().Get(), "LightMapped",
      [](const Cost& s) { return s.chosen == lambert::Representation::LightMap ? 1 : 0; });
  add(vtkNew<vtkIdTypeArray>().Get(), "InputTriangles",
      [](const Cost& s) { return s.inputTriangles; });
  add(vtkNew<vtkIdTypeArray>().Get(), "RefinedTriangles",
      [](const Cost& s) { return s.refinedTriangles; });
  add(vtkNew<vtkDoubleArray>().Get(), "Area", [](const Cost& s) { return s.area; });
  add(vtkNew<vtkIdTypeArray>().Get(), "Texels", [](const Cost& s) { return s.texels; });
  add(vtkNew<vtkDoubleArray>().Get(), "MapError", [](const Cost& s) { return s.mapError; });
  add(vtkNew<vtkIdTypeArray>().Get(), "Surface", [](const Cost& s) { return s.surface; });
  add(vtkNew<vtkIdTypeArray>().Get(), "Side", [](const Cost& s) { return s.side; });
}
}  // namespace

void vtkSurfaceRepresentation::TakeIn(vtkPolyData* mesh, vtkTable* tree, vtkPolyData* solution) {
  if (this->Last->Representation && this->Last->MeshTime == mesh->GetMTime() &&
      this->Last->TreeTime == tree->GetMTime() &&
      this->Last->SolutionTime == solution->GetMTime()) {
    return;
  }
  this->Last = std::make_unique<Kept>();
  Kept& last = *this->Last;
  last.Scene = lambert::SceneFromPolyData(mesh);
  last.Tree = lambert::ClusterTreeFromTable(tree);
  last.Solution = lambert::SolutionFromPolyData(solution);
  last.Representation =
      std::make_unique<lambert::KeptRepresentation>(last.Scene.mesh, last.Tree, last.Solution);
  last.MeshTime = mesh->GetMTime();
  last.TreeTime = tree->GetMTime();
  last.SolutionTime = solution->GetMTime();
  ++this->NumberOfReadings;
}

int vtkSurfaceRepresentation::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs) {
  return lambert::RunCore(this, [&](const lambert::ProgressCallback& progress) {
    // What is wanted of the surfaces.
    this->TakeIn(vtkPolyData::GetData(inputs[0]), vtkTable::GetData(inputs[1]),
                 vtkPolyData::GetData(inputs[2]));
    const Kept& last = *this->Last;
    lambert::RepresentationOptions choice = this->Options->Choice;
    choice.wanted = lambert::RepresentationsOfSurfaces(last.Scene, last.Tree, this->Options->Wanted,
                                                       lambert::Representation::Automatic);

    // Each in its representation, as far as it is not that of the last run.
    const auto before = last.Representation->HowOften();
    last.Representation->Represent(choice, this->Options->Atlas, progress);
    const auto& after = last.Representation->HowOften();
    this->NumberOfSegmentations += after.segmentations - before.segmentations;
    this->NumberOfPackings += after.packings - before.packings;
    const lambert::RepresentedScene& represented = last.Representation->Scene();
    lambert::PolyDataFromRepresentedScene(represented, last.Scene,
                                          vtkPolyData::GetData(outputs, 0));
    lambert::PagesFromLightMap(represented.map, vtkMultiBlockDataSet::GetData(outputs, 1));
    FillCosts(represented.surfaces, vtkTable::GetData(outputs, 2));
  });
}

void vtkSurfaceRepresentation::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IntroducedTriangles: " << this->GetIntroducedTriangles() << "\n"
     << indent << "SplitSurfaces: " << this->GetSplitSurfaces() << "\n"
     << indent << "PageSize: " << this->GetPageSize() << "\n"
     << indent << "Pages: " << this->GetPages() << "\n"
     << indent << "TexelSize: " << this->GetTexelSize() << "\n"
     << indent << "Padding: " << this->GetPadding() << "\n"
     << indent << "MipLevels: " << this->GetMipLevels() << "\n"
     << indent << "TexelDensity: " << this->GetTexelDensity() << "\n"
     << indent << "Stretch: " << this->GetStretch() << "\n";
  PrintWanted(os, indent, "material", this->Options->Wanted.byMaterial);
  PrintWanted(os, indent, "part", this->Options->Wanted.byPart);
  PrintWanted(os, indent, "surface", this->Options->Wanted.bySurface);
}
