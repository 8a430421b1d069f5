#include "Classical/Core/PointFormFactors.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Common/Core/PolygonIrradiance.h"

namespace lambert {

namespace {

constexpr int64_t kGroup = 8;  ///< receivers that share a shaft
/// Nearer than this many radii of its circle, a triangle is cut in four.
constexpr float kNear = 3;
constexpr int kMaximumCuts = 2;
/// Cosine of normals below which a facet and a shooter at no distance are the two sides of one
/// sheet, which do not see each other.
constexpr float kBackToBack = -0.999f;

std::vector<std::vector<Vec3f>> Groups(const std::vector<ElementReceiver>& receivers,
                                       const std::vector<ExchangeTriangle>& shooters) {
  std::vector<std::vector<Vec3f>> groups;
  for (const ExchangeTriangle& shooter : shooters) {
    groups.emplace_back(shooter.corners.begin(), shooter.corners.end());
  }
  for (size_t point = 0; point < receivers.size(); ++point) {
    if (point % size_t(kGroup) == 0) groups.emplace_back();
    groups.back().push_back(receivers[point].position);
  }
  return groups;
}

}  // namespace

PointFormFactors::PointFormFactors(const std::vector<ElementReceiver>& receivers,
                                   const std::vector<ExchangeTriangle>& shooters,
                                   const TriangleMesh& mesh, const RayScene& rayScene)
    : receivers_(receivers),
      shooters_(shooters),
      rayScene_(rayScene),
      shafts_(mesh, rayScene.Epsilon(), Groups(receivers, shooters)) {}

void PointFormFactors::ToShooter(int32_t shooter, std::vector<PointFormFactor>* factors,
                                 int64_t* rays) const {
  const ExchangeTriangle& triangle = shooters_[size_t(shooter)];
  const int64_t points = int64_t(receivers_.size()), groups = (points + kGroup - 1) / kGroup;
  std::vector<int64_t> cast(size_t(groups), 0);
  factors->assign(receivers_.size(), {});
  const float clearance = rayScene_.Epsilon();
  ParallelForEach(groups, 8, [&](int64_t group) {
    ShaftBlockers::Faces faces;
    bool hasFaces = false;
    for (int64_t p = group * kGroup; p < std::min(points, (group + 1) * kGroup); ++p) {
      // Does the point see the front of the shooter, and the shooter rise above its horizon?
      const ElementReceiver& receiver = receivers_[size_t(p)];
      const float height = Dot(receiver.position - triangle.centroid, triangle.normal);
      if (height <= (Dot(receiver.geometric, triangle.normal) < kBackToBack ? clearance : 0)) {
        continue;
      }
      const bool rises =
          std::any_of(triangle.corners.begin(), triangle.corners.end(), [&](const Vec3f& corner) {
            return Dot(corner - receiver.position, receiver.geometric) > 0;
          });
      if (!rises) continue;
      if (!hasFaces) faces = shafts_.Between(int32_t(int64_t(shooters_.size()) + group), shooter);
      hasFaces = true;
      (*factors)[size_t(p)] = Factor(receiver, triangle, faces, 0, &cast[size_t(group)]);
    }
  });
  for (const int64_t count : cast) *rays += count;
}

PointFormFactors::Open PointFormFactors::OpenFactor(const ElementReceiver& receiver,
                                                    const ExchangeTriangle& triangle) {
  const Vec3d vector =
      PolygonIrradianceAbove(triangle.corners.data(), 3, receiver.position, receiver.geometric);
  return {std::max(0.f, float(Dot(vector, Vec3d(receiver.geometric)))),
          std::max(0.f, float(Dot(vector, Vec3d(receiver.normal))))};
}

PointFormFactor PointFormFactors::Factor(const ElementReceiver& receiver,
                                         const ExchangeTriangle& triangle,
                                         const ShaftBlockers::Faces& faces, int cuts,
                                         int64_t* rays) const {
  PointFormFactor factor;
  const Vec3f offset = triangle.centroid - receiver.position;
  const bool isNear = LengthSquared(offset) < kNear * kNear * triangle.radius * triangle.radius;
  if (isNear && cuts < (faces.IsOpen() ? 1 : kMaximumCuts)) {
    // The three corner triangles and the middle one, in the order of the places.
    const auto& [a, b, c] = triangle.corners;
    const Vec3f ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, ca = (c + a) * 0.5f;
    const std::array<ExchangeTriangle, kPlacesPerElement> parts{
        ExchangeTriangle(a, ab, ca), ExchangeTriangle(ab, b, bc), ExchangeTriangle(ca, bc, c),
        ExchangeTriangle(bc, ca, ab)};
    for (size_t part = 0; part < parts.size(); ++part) {
      const PointFormFactor cut = Factor(receiver, parts[part], faces, cuts + 1, rays);
      for (size_t k = 0; k < parts.size(); ++k) {
        factor.facet[part] += cut.facet[k];
        factor.normal[part] += cut.normal[k];
      }
    }
    return factor;
  }

  // The whole, shared among the places above the horizon that are seen.
  const Open open = OpenFactor(receiver, triangle);
  if (!(open.facet > 0)) return factor;
  std::array<bool, kPlacesPerElement> above;
  int count = 0;
  for (int place = 0; place < kPlacesPerElement; ++place) {
    above[size_t(place)] = Dot(triangle.Place(place) - receiver.position, receiver.geometric) > 0;
    count += above[size_t(place)] ? 1 : 0;
  }
  for (int place = 0; place < kPlacesPerElement; ++place) {
    if (count > 0 && !above[size_t(place)]) continue;
    if (!IsSeen(receiver, triangle.Place(place), faces, rays)) continue;
    const float share = 1.f / float(count > 0 ? count : kPlacesPerElement);
    factor.facet[size_t(place)] = open.facet * share;
    factor.normal[size_t(place)] = open.normal * share;
  }
  return factor;
}

bool PointFormFactors::IsSeen(const ElementReceiver& receiver, const Vec3f& place,
                              const ShaftBlockers::Faces& faces, int64_t* rays) const {
  if (faces.IsOpen()) return true;
  ++*rays;
  return faces.IsCrowd() ? !rayScene_.Occluded(receiver.position, place)
                         : !shafts_.IsBlocked(faces, {receiver.position, place});
}

}  // namespace lambert
