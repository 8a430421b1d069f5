// A page that charts are packed on: what is taken of it, and the holes below its top.
#pragma once

#include <cstdint>
#include <vector>

#include "Atlas/Core/ChartMask.h"
#include "Atlas/Core/ChartPacking.h"
#include "Atlas/Core/PackingBin.h"

namespace lambert {

class PackingPage {
 public:
  /// `waste` as PackingWay::waste.
  PackingPage(int size, double waste);

  /// Looks for holes where much was left empty since that was done; tells whether it did.
  bool RenewHoles();
  /// True, with the place, where the chart fits into a hole: the smallest that has room.
  bool PutIntoHole(const TurnedChart& chart, ChartPlace* place);
  /// The cheapest spot on top, as PackingBin::Find tells it.
  const PackingBin& Top() const { return all_; }
  /// Returns where it came to lie.
  PackingSpot PutOnTop(const TurnedChart& chart, const PackingSpot& spot, ChartPlace* place);

 private:
  void FindHoles();
  std::vector<uint8_t> FreeCells(int cell, int cells) const;
  bool Meets(const PackingBin& bin, const ChartShape& chart, const PackingSpot& spot) const;
  PackingSpot Put(const TurnedChart& chart, PackingSpot spot, PackingBin* bin, ChartPlace* place);

  int size_;
  double waste_;
  PackingBin all_;
  ChartMask taken_;
  std::vector<PackingBin> holes_;  ///< the largest first
  int64_t empty_ = 0;              ///< texels that were left since holes were looked for
};

}  // namespace lambert
