#include "vtkRadiosityAtlas.h"

#include "Atlas/Core/RadiosityAtlas.h"
#include "Clustering/vtkClusterTreeAdapter.h"
#include "Common/Core/Error.h"
#include "vtkAtlasAdapter.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSceneAdapter.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkRadiosityAtlas);

vtkRadiosityAtlas::vtkRadiosityAtlas() : Options(new lambert::AtlasOptions) {
  this->SetNumberOfInputPorts(2);
}

vtkRadiosityAtlas::~vtkRadiosityAtlas() = default;

int vtkRadiosityAtlas::FillInputPortInformation(int port, vtkInformation* information) {
  if (port == 0) return this->Superclass::FillInputPortInformation(port, information);
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  information->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

#define lambertOptionMacro(name, type, member)    \
  void vtkRadiosityAtlas::Set##name(type value) { \
    if (this->Options->member != value) {         \
      this->Options->member = value;              \
      this->Modified();                           \
    }                                             \
  }                                               \
  type vtkRadiosityAtlas::Get##name() { return this->Options->member; }
lambertOptionMacro(Stretch, double, stretch);
lambertOptionMacro(PageSize, int, pageSize);
lambertOptionMacro(Pages, int, pages);
lambertOptionMacro(TexelSize, double, texelSize);
lambertOptionMacro(Padding, int, padding);
#undef lambertOptionMacro

int vtkRadiosityAtlas::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                   vtkInformationVector* outputs) {
  const auto progress = [this](double fraction, const char* stage) {
    this->SetProgressText(stage);
    this->UpdateProgress(fraction);
    return !this->GetAbortExecute();
  };
  try {
    lambert::Scene scene = lambert::SceneFromPolyData(vtkPolyData::GetData(inputs[0]));
    vtkTable* table = vtkTable::GetData(inputs[1]);
    const lambert::ClusterTree tree =
        table && table->GetNumberOfRows() > 0
            ? lambert::ClusterTreeFromTable(table)
            : lambert::ClusterFaces(&scene.mesh, scene.parts, {}, nullptr, progress);
    const lambert::RadiosityAtlas atlas =
        lambert::MakeRadiosityAtlas(scene.mesh, tree, *this->Options, progress);
    this->NumberOfCharts = static_cast<vtkIdType>(atlas.set.charts.size());
    this->NumberOfPages = atlas.pages;
    this->DeliveredTexelSize = atlas.texelSize;
    this->Utilisation = atlas.utilisation;
    lambert::PolyDataFromAtlas(atlas, std::move(scene), vtkPolyData::GetData(outputs));
    return 1;
  } catch (const lambert::Cancelled&) {
    return 1;  // An abort is no error; nothing is delivered.
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkRadiosityAtlas::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Stretch: " << this->GetStretch() << "\n"
     << indent << "PageSize: " << this->GetPageSize() << "\n"
     << indent << "Pages: " << this->GetPages() << "\n"
     << indent << "TexelSize: " << this->GetTexelSize() << "\n"
     << indent << "Padding: " << this->GetPadding() << "\n"
     << indent << "NumberOfCharts: " << this->NumberOfCharts << "\n"
     << indent << "Utilisation: " << this->Utilisation << "\n";
}
