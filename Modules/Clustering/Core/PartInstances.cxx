#include "Clustering/Core/PartInstances.h"

#include <Eigen/Dense>
#include <map>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

/// From the one part to the other; false where it is no similarity.
bool FindSimilarity(const Part& from, const Part& to, Matrix* similarity) {
  const Eigen::Map<const Matrix> a(from.objectToWorld.data()), b(to.objectToWorld.data());
  *similarity = b * a.inverse();
  if (!similarity->allFinite()) return false;
  const Eigen::Matrix3d linear = similarity->topLeftCorner<3, 3>();
  const Eigen::Matrix3d square = linear.transpose() * linear;
  const double scale = square.trace() / 3;
  constexpr double kSkew = 1e-4;  // files give matrices in single precision
  return scale > 0 && (square - scale * Eigen::Matrix3d::Identity()).norm() < kSkew * scale;
}

/// True where the faces [0, count) of both parts have the same materials, and the same corners
/// under the similarity.
bool SameFaces(const TriangleMesh& mesh, const int32_t* from, const int32_t* to, int32_t count,
               const Matrix& similarity) {
  // Single-precision points of a part, moved twice: a few units in the last place of the largest
  // coordinate.
  float largest = 0;
  for (int32_t i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vec3f& p = mesh.Corner(to[i], k);
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  const double tolerance = 1e-5 * largest;
  for (int32_t i = 0; i < count; ++i) {
    if (mesh.materialId[size_t(from[i])] != mesh.materialId[size_t(to[i])]) return false;
    for (int k = 0; k < 3; ++k) {
      const Vec3f &p = mesh.Corner(from[i], k), &q = mesh.Corner(to[i], k);
      const Eigen::Vector4d moved = similarity * Eigen::Vector4d(p.x, p.y, p.z, 1);
      if (!((moved.head<3>() - Eigen::Vector3d(q.x, q.y, q.z)).norm() <= tolerance)) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<int32_t> FindInstances(const TriangleMesh& mesh, const PartFaces& parts,
                                   const std::vector<Part>& partTable) {
  // Candidates: parts of the same mesh with as many faces; the first of them is the model.
  std::vector<int32_t> model(size_t(parts.PartCount()));
  std::map<std::pair<int32_t, int32_t>, int32_t> firstOfMesh;
  for (int32_t part = 0; part < parts.PartCount(); ++part) {
    model[size_t(part)] = part;
    if (size_t(part) >= partTable.size() || parts.Count(part) == 0) continue;
    const auto key = std::make_pair(partTable[size_t(part)].meshId, parts.Count(part));
    model[size_t(part)] = firstOfMesh.emplace(key, part).first->second;
  }

  ParallelForEach(parts.PartCount(), 1, [&](int64_t part) {
    const size_t first = size_t(model[size_t(part)]);
    Matrix similarity;
    if (int64_t(first) == part) return;
    if (!FindSimilarity(partTable[first], partTable[size_t(part)], &similarity) ||
        !SameFaces(mesh, parts.faces.data() + parts.begin[first],
                   parts.faces.data() + parts.begin[size_t(part)], parts.Count(int32_t(part)),
                   similarity)) {
      model[size_t(part)] = int32_t(part);
    }
  });
  return model;
}

}  // namespace lambert
