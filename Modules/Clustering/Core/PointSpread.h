// How points spread about their mean (thesis 4.5 and 4.6), joined from those of parts.
#pragma once

#include "Common/Core/TriangleMesh.h"
#include "Common/Core/Vector.h"

namespace lambert {

struct PointSpread {
  double count = 0;
  Vec3d mean;             ///< m (4.6)
  Vec3d diagonal, mixed;  ///< xx, yy, zz and yz, zx, xy of Z, about the mean, m2 (4.5)

  /// Of the corners of the faces [face, end): a point counts once for every face about it.
  static PointSpread OfCorners(const TriangleMesh& mesh, int64_t face, int64_t end) {
    PointSpread spread;
    spread.count = 3.0 * double(end - face);
    if (!(spread.count > 0)) return {};
    const Vec3d origin(mesh.Corner(face, 0));
    Vec3d sum;
    const auto forEach = [&](const auto& visit) {
      for (int64_t f = face; f < end; ++f) {
        for (int k = 0; k < 3; ++k) visit(Vec3d(mesh.Corner(f, k)));
      }
    };
    forEach([&](const Vec3d& p) { sum += p - origin; });
    spread.mean = origin + sum / spread.count;
    forEach([&](const Vec3d& p) { spread.AddProducts(p - spread.mean, 1); });
    return spread;
  }

  /// Those of both together (Chan, Golub and LeVeque 1983).
  PointSpread& operator+=(const PointSpread& s) {
    if (!(s.count > 0)) return *this;
    const Vec3d offset = s.mean - mean;
    const double all = count + s.count;
    this->AddProducts(offset, count * s.count / all);
    diagonal += s.diagonal, mixed += s.mixed;
    mean += offset * (s.count / all);
    count = all;
    return *this;
  }

 private:
  void AddProducts(const Vec3d& d, double weight) {
    diagonal += Vec3d(d.x * d.x, d.y * d.y, d.z * d.z) * weight;
    mixed += Vec3d(d.y * d.z, d.z * d.x, d.x * d.y) * weight;
  }
};

}  // namespace lambert
