#include "vtkRadiosityAtlas.h"

#include "Atlas/Core/RadiosityAtlas.h"
#include "Atlas/Core/TexelDensity.h"
#include "Clustering/vtkClusterTreeAdapter.h"
#include "vtkAtlasAdapter.h"
#include "vtkCoreShell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSceneAdapter.h"
#include "vtkTable.h"

#include <optional>

/// The steps before packing, and the time stamps of what they were made of.
struct vtkRadiosityAtlas::Kept {
  vtkMTimeType MeshTime = 0, TreeTime = 0, SolutionTime = 0;
  lambert::Scene Scene;
  lambert::ClusterTree Tree;
  std::optional<lambert::ShownSides> Shown;  ///< of a scene that is solved and has sheets
  lambert::ChartSet Charts;
};

vtkStandardNewMacro(vtkRadiosityAtlas);

vtkRadiosityAtlas::vtkRadiosityAtlas()
    : Options(new lambert::AtlasOptions), Last(std::make_unique<Kept>()) {
  this->SetNumberOfInputPorts(3);
}

vtkRadiosityAtlas::~vtkRadiosityAtlas() = default;

int vtkRadiosityAtlas::FillInputPortInformation(int port, vtkInformation* information) {
  if (port == 0) return this->Superclass::FillInputPortInformation(port, information);
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(),
                   port == 1 ? "vtkTable" : "vtkPolyData");
  information->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

lambertOptionMacro(vtkRadiosityAtlas, Stretch, double, stretch);
lambertOptionMacro(vtkRadiosityAtlas, PageSize, int, pageSize);
lambertOptionMacro(vtkRadiosityAtlas, Pages, int, pages);
lambertOptionMacro(vtkRadiosityAtlas, TexelSize, double, texelSize);
lambertOptionMacro(vtkRadiosityAtlas, Padding, int, padding);
lambertOptionMacro(vtkRadiosityAtlas, MipLevels, int, mipLevels);
lambertChoiceMacro(vtkRadiosityAtlas, TexelDensity, lambert::TexelDensity, density, ILLUMINATION,
                   "The density of texels is UNIFORM or ILLUMINATION");

void vtkRadiosityAtlas::TakeIn(vtkPolyData* mesh, vtkTable* tree, const Progress& progress) {
  const bool hasTree = tree && tree->GetNumberOfRows() > 0;
  const vtkMTimeType treeTime = hasTree ? tree->GetMTime() : 0;
  if (this->Last->MeshTime == mesh->GetMTime() && this->Last->TreeTime == treeTime) {
    return;
  }
  *this->Last = Kept();
  Kept kept;
  kept.Scene = lambert::SceneFromPolyData(mesh);
  kept.Tree =
      hasTree ? lambert::ClusterTreeFromTable(tree)
              : lambert::ClusterFaces(&kept.Scene.mesh, kept.Scene.parts, {}, nullptr, progress);
  kept.MeshTime = mesh->GetMTime();
  kept.TreeTime = treeTime;
  *this->Last = std::move(kept);
  ++this->NumberOfReadings;
}

void vtkRadiosityAtlas::FindSides(const lambert::RadiositySolution* solution, vtkMTimeType time) {
  Kept& last = *this->Last;
  if (last.SolutionTime == time) {
    return;
  }
  std::optional<lambert::ShownSides> shown;
  if (solution) {
    shown = lambert::ShowBothSides(last.Scene.mesh, last.Tree, *solution);
  }
  const bool areSame = shown ? last.Shown && shown->inputFace == last.Shown->inputFace &&
                                   shown->side == last.Shown->side
                             : !last.Shown;
  if (!areSame) {
    last.Shown = std::move(shown);
    last.Charts = lambert::ChartSet();
  }
  last.SolutionTime = time;
}

int vtkRadiosityAtlas::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                   vtkInformationVector* outputs) {
  return lambert::RunCore(this, [&](const lambert::ProgressCallback& progress) {
    // Faces and charts, where they are not those of the last run.
    this->TakeIn(vtkPolyData::GetData(inputs[0]), vtkTable::GetData(inputs[1]), progress);
    vtkPolyData* solved = vtkPolyData::GetData(inputs[2]);
    std::optional<lambert::RadiositySolution> solution;
    if (solved) {
      solution = lambert::SolutionFromPolyData(solved);
    }
    this->FindSides(solution ? &*solution : nullptr, solved ? solved->GetMTime() : 0);
    Kept& last = *this->Last;
    const lambert::ClusterTree& tree = last.Shown ? last.Shown->tree : last.Tree;
    const lambert::TriangleMesh& mesh = last.Shown ? last.Shown->mesh : last.Scene.mesh;
    const lambert::ChartOptions wanted = lambert::ChartOptionsOf(tree, *this->Options);
    if (!last.Charts.IsOf(wanted)) {
      last.Charts = lambert::CutIntoCharts(mesh, tree, wanted, progress);
      ++this->NumberOfSegmentations;
    }

    // Their places.
    lambert::RadiosityAtlas atlas = lambert::PackAtlas(last.Charts, *this->Options, progress);
    if (solution) {
      if (last.Shown) {
        solution =
            lambert::OntoShownSides(*std::move(solution), last.Shown->inputFace, last.Shown->side);
      }
      atlas = lambert::WithTexelDensity(
          mesh, std::move(atlas), *solution, *this->Options,
          [&](double, const char* stage) { return lambert::Report(progress, 1, stage); });
    }
    ++this->NumberOfPackings;
    this->NumberOfCharts = static_cast<vtkIdType>(atlas.set.charts.size());
    this->NumberOfPages = atlas.pages;
    this->DeliveredTexelSize = atlas.texelSize;
    this->Utilisation = atlas.utilisation;
    lambert::Scene scene = last.Scene;
    scene.mesh = mesh;
    lambert::PolyDataFromAtlas(atlas, std::move(scene), vtkPolyData::GetData(outputs),
                               last.Shown ? &*last.Shown : nullptr);
  });
}

void vtkRadiosityAtlas::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Stretch: " << this->GetStretch() << "\n"
     << indent << "PageSize: " << this->GetPageSize() << "\n"
     << indent << "Pages: " << this->GetPages() << "\n"
     << indent << "TexelSize: " << this->GetTexelSize() << "\n"
     << indent << "Padding: " << this->GetPadding() << "\n"
     << indent << "MipLevels: " << this->GetMipLevels() << "\n"
     << indent << "TexelDensity: " << this->GetTexelDensity() << "\n"
     << indent << "NumberOfCharts: " << this->NumberOfCharts << "\n"
     << indent << "Utilisation: " << this->Utilisation << "\n";
}
