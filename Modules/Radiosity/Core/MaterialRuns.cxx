#include "Radiosity/Core/MaterialRuns.h"

#include "Common/Core/Parallel.h"

namespace lambert {

MaterialRuns::Sum& MaterialRuns::Sum::operator+=(const Sum& other) {
  area += other.area;
  reflectance += other.reflectance;
  for (const Side side : {kFront, kBack}) emittance[side] += other.emittance[side];
  return *this;
}

void MaterialRuns::Add(int32_t face, int32_t end, Sum* sum) const {
  const TriangleMesh& mesh = runs_.Mesh();
  for (; face < end; ++face) {
    const float area = runs_.Area(face);
    sum->area += area;
    sum->reflectance += mesh.reflectance[size_t(face)] * area;
    for (const Side side : {kFront, kBack}) {
      if (mesh.Emits(face, side)) sum->emittance[side] += mesh.emittance[size_t(face)] * area;
    }
  }
}

void MaterialRuns::TakeMaterials() {
  sums_.assign(size_t(runs_.Mesh().FaceCount() / FaceRuns::kFaces), {});
  ParallelForEach(int64_t(sums_.size()), 16, [&](int64_t run) {
    const int32_t face = int32_t(run) * FaceRuns::kFaces;
    this->Add(face, face + FaceRuns::kFaces, &sums_[size_t(run)]);
  });
}

MaterialRuns::Material MaterialRuns::MeanOf(const ClusterNode& node, Side side) const {
  Sum sum;
  FaceRuns::ForEachPart(
      node, [&](int32_t face, int32_t end) { this->Add(face, end, &sum); },
      [&](int32_t run) { sum += sums_[size_t(run)]; });
  if (!(sum.area > 0)) return {};
  return {sum.reflectance / sum.area, sum.emittance[side] / sum.area};
}

}  // namespace lambert
