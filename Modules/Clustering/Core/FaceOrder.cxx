#include "Clustering/Core/FaceOrder.h"

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

template <class T>
void Permute(const std::vector<int32_t>& order, std::vector<T>* values) {
  if (values->empty()) return;
  std::vector<T> permuted(values->size());
  ParallelForEach(int64_t(order.size()), 4096,
                  [&](int64_t i) { permuted[size_t(i)] = (*values)[size_t(order[size_t(i)])]; });
  values->swap(permuted);
}

}  // namespace

void ReorderFaces(const std::vector<int32_t>& order, TriangleMesh* mesh) {
  Permute(order, &mesh->triangles);
  Permute(order, &mesh->reflectance);
  Permute(order, &mesh->emittance);
  Permute(order, &mesh->faceFlags);
  Permute(order, &mesh->materialId);
  Permute(order, &mesh->partId);
  Permute(order, &mesh->sourceCellId);
}

}  // namespace lambert
