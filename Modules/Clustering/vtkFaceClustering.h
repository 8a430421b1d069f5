/**
 * @class vtkFaceClustering
 * @brief A binary tree of face clusters over the triangles of every surface.
 *
 * Input: vtkPolyData of triangles in world space, with the arrays of vtkRadiosityArrays that it
 * has. Output port 0: the mesh with its faces in tree order, so that a cluster is a range of cells.
 * Cell array `SurfaceId`; `ClusterId`, the row of the cluster table that the cell lies in at the
 * chosen cut; the other mesh arrays and the tables in the field data pass through in the new order.
 * Output port 1: vtkTable, the cluster tree, a row a node: Parent, Child (siblings stand side by
 * side), FirstFace, FaceCount, Area (m2), VectorArea (3, m2), Bounds (6, m).
 */
#ifndef vtkFaceClustering_h
#define vtkFaceClustering_h

#include "lambertClusteringModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>  // for the options

namespace lambert {
struct FaceClusteringOptions;
struct FaceClusteringStatistics;
class KeptClustering;
}  // namespace lambert

class LAMBERTCLUSTERING_EXPORT vtkFaceClustering : public vtkPolyDataAlgorithm {
 public:
  static vtkFaceClustering* New();
  vtkTypeMacro(vtkFaceClustering, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{ k of the cost: small values make planar clusters, large ones compact and even ones. Range
  ///[0,
  /// inf), default 0.01.
  void SetBalance(double balance);
  double GetBalance();
  ///@}
  ///@{ Steps below the roots at which `ClusterId` cuts the tree; default 0, the surfaces. Counts
  /// only
  /// where ClusterCount is 0.
  vtkSetClampMacro(Level, int, 0, VTK_INT_MAX);
  vtkGetMacro(Level, int);
  ///@}
  ///@{ Clusters that `ClusterId` tells apart, the largest split first; never fewer than there are
  /// surfaces. Default 0: cut at Level.
  vtkSetClampMacro(ClusterCount, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(ClusterCount, vtkIdType);
  ///@}

  ///@{ What the last clustering met. Input that comes with other materials alone, or another cut,
  /// is not clustered again.
  vtkIdType GetNumberOfSurfaces();
  vtkIdType GetNumberOfNodes();
  /// Parts that took the tree of another part of the same mesh.
  vtkIdType GetNumberOfSharedTrees();
  /// Edges of three faces or more; clusters do not cross them.
  vtkIdType GetNumberOfNonManifoldEdges();
  /// Edges whose two faces wind against each other; clusters do not cross them.
  vtkIdType GetNumberOfInconsistentEdges();
  int GetMaximumDepth();
  /// Largest depth / log2(faces) over the surfaces of 64 faces or more.
  double GetMaximumDepthOverLog();
  double GetClusteringSeconds();
  ///@}

 protected:
  vtkFaceClustering();
  ~vtkFaceClustering() override;
  int FillOutputPortInformation(int port, vtkInformation* information) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkFaceClustering(const vtkFaceClustering&) = delete;
  void operator=(const vtkFaceClustering&) = delete;

  std::unique_ptr<lambert::FaceClusteringOptions> Options;
  std::unique_ptr<lambert::FaceClusteringStatistics> Statistics;
  std::unique_ptr<lambert::KeptClustering> Clustering;
  int Level = 0;
  vtkIdType ClusterCount = 0;
};

#endif
