// The light of every cell of a scene's surfaces, found by paths from the cells: their rays are cast
// once, and all bounces are solved over what they met.
#pragma once

#include <cstdint>
#include <vector>

#include "Classical/Core/ElementCells.h"
#include "Classical/Core/RayBatch.h"
#include "Classical/Core/SourceLight.h"
#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

class ElementCache {
 public:
  /// Keeps references to all four. `paths`: of each lit side of a cell, [1, inf), rounded up to a
  /// multiple of 4 that is no less than 8.
  ElementCache(const Scene& scene, const RayScene& rays, const SourceLight& sources,
               const ElementCells& cells, int paths, uint64_t seed);

  /// Casts the paths and solves for the light; the same for any number of threads. Throws
  /// Cancelled.
  void Fill(const ProgressCallback& progress = {});

  /// True where a side has more than a ten-thousandth of the mean irradiance: less is what leaks
  /// through the seams of closed things, and black in any picture.
  bool IsLit(int32_t cell, Side side) const {
    return irradiance_[SideIndex(cell, side)].Mean() > darkness_;
  }
  /// Reflected radiosity (W/m2) of the side of a face that a ray met; its own emission is not in.
  Spectrum Reflected(int32_t face, Side side, const Vec2f& barycentric) const {
    const size_t index = SideIndex(cells_.At(face, barycentric), side);
    return scene_.mesh.reflectance[size_t(face)] * irradiance_[index];
  }
  /// Adds elements, rays, bounces and the balance of power.
  void Account(SolverStatistics* statistics) const;

 private:
  /// What paths met, by item of a list of sides, place and ray.
  struct PathSet {
    int places = 0;
    std::vector<int32_t> ends;         ///< side of a cell; kEscaped
    std::vector<Spectrum> direct;      ///< by place: straight from the sources, W/m2
    std::vector<Spectrum> fromLights;  ///< by item: the part of lights without geometry, summed
    std::vector<uint8_t> seesSource;   ///< by place
    void Resize(size_t items);
  };
  static constexpr int32_t kEscaped = -1;

  static size_t SideIndex(int32_t cell, Side side) { return size_t(cell) * 2 + size_t(side); }
  size_t SideCount() const { return size_t(cells_.Size()) * 2; }
  std::vector<uint8_t> SeenSides() const;
  std::vector<int32_t> OrderedSides() const;
  void CastPaths(const std::vector<int32_t>& sides, int firstPlace, PathSet* set);
  void CastFrom(int32_t side, int firstPlace, size_t item, const PathSet& set, RayBatch* batch,
                Spectrum* direct, Spectrum* fromLights, int64_t* cast) const;
  void FindLitSides(const std::vector<int32_t>& sides, const PathSet& probes);
  void AddRows(const std::vector<int32_t>& sides);
  std::vector<int32_t> DarkSidesInSight() const;
  bool IsBuried(size_t row, int place) const;
  void PrepareRows();
  void Solve(const ProgressCallback& progress);
  double MeanIrradiance() const;
  const Spectrum& Emittance(int32_t side) const {
    return cells_.Emittance(side / 2, side % 2 ? kBack : kFront);
  }

  const Scene& scene_;
  const RayScene& rays_;
  const SourceLight& sources_;
  const ElementCells& cells_;
  const int places_;  ///< a side, that paths start from
  const uint64_t seed_;

  std::vector<uint8_t> lit_;          ///< by side
  std::vector<Spectrum> irradiance_;  ///< by side, W/m2
  // Rows: the lit sides.
  std::vector<int32_t> sideOfRow_;
  PathSet paths_;
  std::vector<Spectrum> received_;  ///< by row: mean light from sources and sky, W/m2
  std::vector<float> perRay_;       ///< by row: what one ray counts
  float darkness_ = 0;              ///< W/m2
  int64_t rayCount_ = 0;
  std::vector<IterationRecord> history_;
};

}  // namespace lambert
