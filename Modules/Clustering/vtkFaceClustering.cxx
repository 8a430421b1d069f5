#include "vtkFaceClustering.h"

#include "Clustering/Core/ClusterCut.h"
#include "Clustering/Core/FaceClustering.h"
#include "Clustering/Core/KeptClustering.h"
#include "vtkCellData.h"
#include "vtkClusterTreeAdapter.h"
#include "vtkCoreShell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneAdapter.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkFaceClustering);

vtkFaceClustering::vtkFaceClustering()
    : Options(new lambert::FaceClusteringOptions),
      Statistics(new lambert::FaceClusteringStatistics),
      Clustering(new lambert::KeptClustering) {
  this->SetNumberOfOutputPorts(2);
}

vtkFaceClustering::~vtkFaceClustering() = default;

int vtkFaceClustering::FillOutputPortInformation(int port, vtkInformation* information) {
  information->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

void vtkFaceClustering::SetBalance(double balance) {
  if (this->Options->balance != balance) {
    this->Options->balance = balance;
    this->Modified();
  }
}
double vtkFaceClustering::GetBalance() { return this->Options->balance; }
vtkIdType vtkFaceClustering::GetNumberOfSurfaces() { return this->Statistics->surfaces; }
vtkIdType vtkFaceClustering::GetNumberOfNodes() { return this->Statistics->nodes; }
vtkIdType vtkFaceClustering::GetNumberOfSharedTrees() { return this->Statistics->sharedTrees; }
vtkIdType vtkFaceClustering::GetNumberOfNonManifoldEdges() {
  return this->Statistics->nonManifoldEdges;
}
vtkIdType vtkFaceClustering::GetNumberOfInconsistentEdges() {
  return this->Statistics->inconsistentEdges;
}
int vtkFaceClustering::GetMaximumDepth() { return this->Statistics->maximumDepth; }
double vtkFaceClustering::GetMaximumDepthOverLog() { return this->Statistics->maximumDepthOverLog; }
double vtkFaceClustering::GetClusteringSeconds() { return this->Statistics->seconds; }

namespace {
/// The cluster of every cell at a cut through the tree.
vtkSmartPointer<vtkIntArray> ClusterIds(const lambert::ClusterTree& tree,
                                        const std::vector<int32_t>& cut, vtkIdType cells) {
  auto ids = vtkSmartPointer<vtkIntArray>::New();
  ids->SetName(vtkRadiosityArrays::ClusterId());
  ids->SetNumberOfValues(cells);
  for (const int32_t node : cut) {
    const lambert::ClusterNode& cluster = tree.nodes[static_cast<size_t>(node)];
    std::fill_n(ids->GetPointer(cluster.firstFace), cluster.faceCount, node);
  }
  return ids;
}
}  // namespace

int vtkFaceClustering::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                   vtkInformationVector* outputs) {
  vtkPolyData* mesh = vtkPolyData::GetData(outputs, 0);
  vtkTable* table = vtkTable::GetData(outputs, 1);
  return lambert::RunCore(this, [&](const lambert::ProgressCallback& progress) {
    lambert::Scene scene = lambert::SceneFromPolyData(vtkPolyData::GetData(inputs[0]));
    const lambert::ClusterTree& tree = this->Clustering->Cluster(
        &scene.mesh, scene.parts, *this->Options, this->Statistics.get(), progress);
    lambert::PolyDataFromScene(scene, mesh);
    lambert::TableFromClusterTree(tree, table);

    const std::vector<int32_t> cut = this->ClusterCount > 0
                                         ? lambert::CutToCount(tree, this->ClusterCount)
                                         : lambert::CutAtLevel(tree, this->Level);
    mesh->GetCellData()->AddArray(ClusterIds(tree, cut, mesh->GetNumberOfCells()));
  });
}

void vtkFaceClustering::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Balance: " << this->Options->balance << "\n"
     << indent << "Level: " << this->Level << "\n"
     << indent << "ClusterCount: " << this->ClusterCount << "\n"
     << indent << "Surfaces: " << this->Statistics->surfaces << "\n"
     << indent << "Nodes: " << this->Statistics->nodes << "\n"
     << indent << "MaximumDepth: " << this->Statistics->maximumDepth << "\n";
}
