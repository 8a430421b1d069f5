#include "vtkClusterTreeAdapter.h"

#include "Common/Core/Error.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include <array>
#include <string>

namespace lambert {
namespace {
vtkDataArray* Column(vtkTable* table, const char* name, int components) {
  vtkDataArray* column = vtkDataArray::SafeDownCast(table->GetColumnByName(name));
  if (!column || column->GetNumberOfComponents() != components) {
    throw Error(std::string("The cluster table has no numeric column ") + name + " of " +
                std::to_string(components) + " components; give port 1 of vtkFaceClustering.");
  }
  return column;
}

/// Adds a column of `components` values a node, taken by value(node, component).
template <class Array, class Value>
void AddColumn(const ClusterTree& tree, const char* name, int components, vtkTable* table,
               const Value& value) {
  vtkNew<Array> column;
  column->SetName(name);
  column->SetNumberOfComponents(components);
  column->SetNumberOfTuples(static_cast<vtkIdType>(tree.nodes.size()));
  for (size_t node = 0; node < tree.nodes.size(); ++node) {
    for (int k = 0; k < components; ++k) {
      column->SetTypedComponent(static_cast<vtkIdType>(node), k, value(tree.nodes[node], k));
    }
  }
  table->AddColumn(column);
}

/// Every node is a root or one of the two children of the node before it that it names, whose faces
/// the two share out.
void CheckForest(const ClusterTree& tree) {
  const int64_t count = static_cast<int64_t>(tree.nodes.size());
  int32_t nextFace = 0;
  for (int64_t i = 0; i < count; ++i) {
    const ClusterNode& node = tree.nodes[static_cast<size_t>(i)];
    bool fits = node.parent >= -1 && node.parent < i && node.faceCount > 0;
    if (node.parent >= 0) {
      const int32_t first = tree.nodes[static_cast<size_t>(node.parent)].child;
      fits = fits && (i == first || i == first + 1);
    } else {
      fits = fits && node.firstFace == nextFace;
      nextFace += node.faceCount;
    }
    if (node.child < 0) {
      fits = fits && node.faceCount == 1;
    } else if (node.child <= i || node.child >= count - 1) {
      fits = false;
    } else {
      const ClusterNode& a = tree.nodes[static_cast<size_t>(node.child)];
      const ClusterNode& b = tree.nodes[static_cast<size_t>(node.child) + 1];
      fits = fits && a.parent == i && b.parent == i && a.firstFace == node.firstFace &&
             b.firstFace == a.firstFace + a.faceCount &&
             a.faceCount + b.faceCount == node.faceCount;
    }
    if (!fits) {
      throw Error("Row " + std::to_string(i) +
                  " of the cluster table does not fit the others; give port 1 of "
                  "vtkFaceClustering as it came.");
    }
  }
}
}  // namespace

ClusterTree ClusterTreeFromTable(vtkTable* table) {
  vtkDataArray* const parent = Column(table, "Parent", 1);
  vtkDataArray* const child = Column(table, "Child", 1);
  vtkDataArray* const firstFace = Column(table, "FirstFace", 1);
  vtkDataArray* const faceCount = Column(table, "FaceCount", 1);
  vtkDataArray* const area = Column(table, "Area", 1);
  vtkDataArray* const vectorArea = Column(table, "VectorArea", 3);
  vtkDataArray* const bounds = Column(table, "Bounds", 6);

  ClusterTree tree;
  tree.nodes.resize(static_cast<size_t>(table->GetNumberOfRows()));
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row) {
    ClusterNode& node = tree.nodes[static_cast<size_t>(row)];
    node.parent = static_cast<int32_t>(parent->GetComponent(row, 0));
    node.child = static_cast<int32_t>(child->GetComponent(row, 0));
    node.firstFace = static_cast<int32_t>(firstFace->GetComponent(row, 0));
    node.faceCount = static_cast<int32_t>(faceCount->GetComponent(row, 0));
    node.area = static_cast<float>(area->GetComponent(row, 0));
    for (int axis = 0; axis < 3; ++axis) {
      node.vectorArea[axis] = static_cast<float>(vectorArea->GetComponent(row, axis));
      node.bounds.low[axis] = static_cast<float>(bounds->GetComponent(row, 2 * axis));
      node.bounds.high[axis] = static_cast<float>(bounds->GetComponent(row, 2 * axis + 1));
    }
    if (node.parent < 0) {
      tree.surfaceRoots.push_back(static_cast<int32_t>(row));
    }
  }
  CheckForest(tree);
  return tree;
}

void TableFromClusterTree(const ClusterTree& tree, vtkTable* table) {
  using Node = ClusterNode;
  table->Initialize();
  AddColumn<vtkIntArray>(tree, "Parent", 1, table, [](const Node& n, int) { return n.parent; });
  AddColumn<vtkIntArray>(tree, "Child", 1, table, [](const Node& n, int) { return n.child; });
  AddColumn<vtkIntArray>(tree, "FirstFace", 1, table,
                         [](const Node& n, int) { return n.firstFace; });
  AddColumn<vtkIntArray>(tree, "FaceCount", 1, table,
                         [](const Node& n, int) { return n.faceCount; });
  AddColumn<vtkFloatArray>(tree, "Area", 1, table, [](const Node& n, int) { return n.area; });
  AddColumn<vtkFloatArray>(tree, "VectorArea", 3, table,
                           [](const Node& n, int axis) { return n.vectorArea[axis]; });
  AddColumn<vtkFloatArray>(tree, "Bounds", 6, table, [](const Node& n, int k) {
    return k % 2 == 0 ? n.bounds.low[k / 2] : n.bounds.high[k / 2];
  });
}
}  // namespace lambert
