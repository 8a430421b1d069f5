// The mean material of clusters, a large one's found without a look at each face.
#pragma once

#include <array>
#include <vector>

#include "Clustering/Core/FaceRuns.h"
#include "Common/Core/Spectrum.h"

namespace lambert {

class MaterialRuns {
 public:
  /// Of the faces of `runs`, kept by reference.
  explicit MaterialRuns(const FaceRuns& runs) : runs_(runs) { this->TakeMaterials(); }

  MaterialRuns(const MaterialRuns&) = delete;

  /// Those that the faces have now.
  void TakeMaterials();

  struct Material {
    Spectrum reflectance, emittance;  ///< emittance in W/m2
  };
  /// Area-weighted means over the faces of a cluster, seen from a side; black where it has no area.
  Material MeanOf(const ClusterNode& node, Side side) const;

 private:
  struct Sum {
    float area = 0;
    Spectrum reflectance;
    std::array<Spectrum, 2> emittance;  ///< by side

    Sum& operator+=(const Sum& other);
  };
  void Add(int32_t face, int32_t end, Sum* sum) const;

  const FaceRuns& runs_;
  std::vector<Sum> sums_;  ///< by run
};

}  // namespace lambert
