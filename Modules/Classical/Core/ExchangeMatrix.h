// The exchange areas of all pairs of element sides, visibility included: the form factors of a
// scene, symmetric by construction.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "Classical/Core/ElementSides.h"
#include "Classical/Core/ShaftBlockers.h"
#include "Common/Core/Progress.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

struct ExchangeMatrixOptions {
  int visibilityRays = 4;  ///< rays a pair that something may stand between, [1, 16]; pairs of
                           ///< which one emits take 16
  int64_t memoryLimit = int64_t(4) << 30;  ///< bytes of the matrix
};

class ExchangeMatrix {
 public:
  /// Exchange areas A_i F_ij = A_j F_ji of all pairs, m2: closed form times visible part, so that
  /// 0 <= F <= the unoccluded F. A row whose form factors sum to more than 1 is scaled down to 1,
  /// its column with it. Throws Error, naming elements and bytes, where the matrix would not fit in
  /// the limit; Cancelled.
  ExchangeMatrix(const ElementSides& sides, const ShaftBlockers& shafts, const RayScene& rayScene,
                 const ExchangeMatrixOptions& options = {}, const ProgressCallback& progress = {});
  ~ExchangeMatrix();

  /// Pairs of sides that exchange light.
  int64_t PairCount() const;
  int64_t Rays() const { return rays_; }
  /// Sum of the form factors F_ij of every side, [0, 1].
  const std::vector<float>& RowSums() const { return rowSums_; }
  /// F_ij; 0 for pairs that exchange nothing.
  float FormFactor(int32_t i, int32_t j) const;

  /// One Gauss-Seidel sweep: gathers on all sides in turn, with what was gathered before.
  /// `lightIrradiance`: of lights without geometry, W/m2. Updates `irradiance` and `radiosity`
  /// (W/m2); returns the change of power, relative to the power of all.
  double Sweep(const std::vector<Spectrum>& lightIrradiance, std::vector<Spectrum>* irradiance,
               std::vector<Spectrum>* radiosity) const;

 private:
  struct Storage;
  struct Entry {
    int32_t column;
    float area;
  };
  using Rows = std::vector<std::vector<Entry>>;

  void CheckMemory(const RayScene& rayScene, const ExchangeMatrixOptions& options) const;
  void Refuse(double bytes, const ExchangeMatrixOptions& options) const;
  Rows AssembleRows(const ShaftBlockers& shafts, const RayScene& rayScene,
                    const ExchangeMatrixOptions& options, const ProgressCallback& progress);
  void Store(Rows rows);
  void BoundRows();

  const ElementSides& sides_;
  std::unique_ptr<Storage> storage_;
  std::vector<float> rowSums_;
  int64_t rays_ = 0;
};

}  // namespace lambert
