#include "Scene/Core/PieceJoining.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace lambert {

namespace {

bool AreSame(const Light& a, const Light& b) {
  const auto all = [](const Light& l) {
    return std::tie(l.type, l.name, l.position, l.direction, l.intensity, l.horizon, l.ground,
                    l.imageFile, l.rotation, l.size, l.innerConeAngle, l.outerConeAngle);
  };
  return all(a) == all(b);
}

bool AreSame(const Material& a, const Material& b) {
  const auto all = [](const Material& m) {
    return std::tie(m.name, m.reflectance, m.emittance, m.twoSidedEmitter);
  };
  return all(a) == all(b);
}

}  // namespace

PieceJoining::PieceJoining(SceneAssembly* assembly)
    : assembly_(assembly),
      firstMaterial_(assembly->materials.size()),
      firstMesh_(assembly->meshes.size()) {}

void PieceJoining::TakeRepeatedLights(Scene* piece) {
  const std::vector<Light>& own = piece->lights;
  const bool isRepeated = std::any_of(lights_.begin(), lights_.end(), [&](const auto& other) {
    return std::equal(other.begin(), other.end(), own.begin(), own.end(),
                      [](const Light& a, const Light& b) { return AreSame(a, b); });
  });
  if (isRepeated) {
    piece->lights.clear();
  } else {
    lights_.push_back(own);
  }
}

void PieceJoining::NumberMaterials(const std::optional<std::vector<int32_t>>& rows, Scene* piece) {
  areNumbered_ = areNumbered_ && rows;
  if (!rows) return;
  piece->materials.resize(rows->size());
  rows_.insert(rows_.end(), rows->begin(), rows->end());
}

void PieceJoining::JoinMaterials() {
  if (!areNumbered_) return;

  // By their rows.
  std::vector<size_t> order(rows_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return rows_[a] < rows_[b]; });

  // Once each.
  std::vector<Material>& all = assembly_->materials;
  std::vector<Material> joined;
  std::vector<int32_t> joinedAs(order.size());
  size_t firstOfRow = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && rows_[order[i]] != rows_[order[i - 1]]) firstOfRow = joined.size();
    const Material& material = all[firstMaterial_ + order[i]];
    const auto same = std::find_if(joined.begin() + std::ptrdiff_t(firstOfRow), joined.end(),
                                   [&](const Material& other) { return AreSame(material, other); });
    joinedAs[order[i]] = int32_t(firstMaterial_) + int32_t(same - joined.begin());
    if (same == joined.end()) joined.push_back(material);
  }
  all.resize(firstMaterial_);
  all.insert(all.end(), joined.begin(), joined.end());

  // Faces name them anew.
  for (size_t mesh = firstMesh_; mesh < assembly_->meshes.size(); ++mesh) {
    for (int32_t& id : assembly_->meshes[mesh].materialId) {
      id = joinedAs[size_t(id) - firstMaterial_];
    }
  }
}

}  // namespace lambert
