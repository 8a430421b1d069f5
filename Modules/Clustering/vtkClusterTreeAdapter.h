// The bridge between a cluster tree and its table, a row a node. C++ only.
#ifndef vtkClusterTreeAdapter_h
#define vtkClusterTreeAdapter_h

#include "Clustering/Core/FaceClustering.h"
#include "lambertClusteringModule.h"

class vtkTable;

namespace lambert {
/// The tree of a table as vtkFaceClustering makes it. Throws Error where a column is missing or
/// where the rows are no forest whose siblings stand side by side and share out the faces of their
/// parent.
LAMBERTCLUSTERING_EXPORT ClusterTree ClusterTreeFromTable(vtkTable* table);

/// Fills `table` with the columns Parent, Child, FirstFace, FaceCount (int), Area (m2), VectorArea
/// (3, m2) and Bounds (6, m: low and high of x, y, z).
LAMBERTCLUSTERING_EXPORT void TableFromClusterTree(const ClusterTree& tree, vtkTable* table);
}  // namespace lambert

#endif
