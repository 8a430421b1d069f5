#include "Radiosity/Core/LightReconstruction.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Radiosity/Core/LightExchange.h"
#include "Radiosity/Core/Transfer.h"

namespace lambert {

namespace {

/// Points are evaluated this far toward the middle of their element, so that corners do not see
/// through walls.
constexpr float kInset = 1e-3f;
/// Links that give less than this part of a receiver's light keep their stored visibility: no ray
/// is worth it.
constexpr float kNegligiblePart = 2e-2f;
/// A corner of a cluster gets no more from a link than this many times its mean.
constexpr float kMostOfMean = 3;
/// Links that give less than this part are not evaluated anew within their triangle.
constexpr float kFaintPart = 2e-3f;

}  // namespace

LightReconstruction::LightReconstruction(const ElementHierarchy& hierarchy,
                                         const LinkNetwork& network, const ElementLight& light,
                                         const RayScene& rayScene)
    : hierarchy_(hierarchy), network_(network), light_(light), rayScene_(rayScene) {
  // Corners are kept for clusters of several faces; triangles and patches are evaluated where they
  // are asked.
  cornerIndex_.assign(size_t(hierarchy.Size()), -1);
  int32_t clusters = 0;
  for (int32_t element = 0; element < hierarchy.Size(); ++element) {
    if (IsCluster(element)) cornerIndex_[size_t(element)] = clusters++;
  }
  corners_.resize(size_t(clusters));

  // The parent's light, interpolated, plus the cluster's own links.
  for (const std::vector<int32_t>& level : hierarchy.Levels()) {
    ParallelForEach(int64_t(level.size()), 32, [&](int64_t i) {
      const int32_t index = level[size_t(i)];
      if (!IsCluster(index)) return;
      const Element& cluster = hierarchy_[index];
      const Element& parent = hierarchy_[cluster.parent];
      for (int k = 0; k < 4; ++k) {
        const Vec3f x = cluster.frame.Corner(k);
        VectorIrradiance sum =
            parent.IsVolume() ? FromVolumes(index, x)
                              : PushIrradiance(parent, Interpolate(cluster.parent, x), cluster);
        AddLinks(index, cluster, x, false, &sum, nullptr);
        corners_[size_t(cornerIndex_[size_t(index)])][size_t(k)] = sum;
      }
    });
  }
}

bool LightReconstruction::IsCluster(int32_t element) const {
  const Element& e = hierarchy_[element];
  return e.kind == ElementKind::Face && !e.IsPolygon();
}

VectorIrradiance LightReconstruction::At(const Vec3f& x, const std::vector<Share>& shares,
                                         int64_t* rays) const {
  // The elements whose links count here: leaves and what is above them within their triangles.
  // Leaves of one triangle share those, and they are evaluated once.
  VectorIrradiance sum;
  std::vector<Share> holders;
  for (const Share& share : shares) {
    const float weight = share.weight * light_.rowScale[size_t(share.leaf)];
    const Vec3f place = x + (share.inside - x) * kInset;
    if (IsCluster(share.leaf)) {
      const VectorIrradiance leafLight = Interpolate(share.leaf, place);
      sum += (hierarchy_[share.leaf].TurnsToAllSides() ? leafLight.FromAllAround() : leafLight) *
             weight;
      continue;
    }
    int32_t index = share.leaf;
    for (bool within = true; within; index = hierarchy_[index].parent) {
      auto held = std::find_if(holders.begin(), holders.end(),
                               [&](const Share& h) { return h.leaf == index; });
      if (held == holders.end()) held = holders.insert(holders.end(), {index, 0.f, Vec3f()});
      held->weight += weight;
      held->inside += share.inside * weight;
      within = hierarchy_[index].kind == ElementKind::Patch;
      if (!within) sum += FromAbove(index, place) * weight;
    }
  }
  for (const Share& holder : holders) {
    if (!(holder.weight > 0)) continue;
    const Vec3f place = x + (holder.inside / holder.weight - x) * kInset;
    VectorIrradiance own;
    AddLinks(holder.leaf, hierarchy_[holder.leaf], place, true, &own, rays);
    sum += own * holder.weight;
  }
  return sum;
}

// What a single triangle has from the clusters or volumes above it, clipped at its plane.
VectorIrradiance LightReconstruction::FromAbove(int32_t polygon, const Vec3f& x) const {
  const Element& receiver = hierarchy_[polygon];
  if (hierarchy_[receiver.parent].IsVolume()) return FromVolumes(polygon, x);
  return PushIrradiance(hierarchy_[receiver.parent], Interpolate(receiver.parent, x), receiver);
}

// Bilinear between the corners of the cluster's rectangle.
VectorIrradiance LightReconstruction::Interpolate(int32_t cluster, const Vec3f& x) const {
  const ClusterFrame& frame = hierarchy_[cluster].frame;
  const Corners& corners = corners_[size_t(cornerIndex_[size_t(cluster)])];
  const Vec3f offset = x - frame.center;
  const auto place = [&](int axis) {
    const float half = frame.halfExtent[axis];
    if (!(half > 0)) return 0.5f;
    return std::min(1.f, std::max(0.f, Dot(offset, frame.axes[size_t(axis)]) / (2 * half) + 0.5f));
  };
  const float u = place(0), v = place(1);
  VectorIrradiance sum = corners[0] * ((1 - u) * (1 - v));
  sum += corners[1] * (u * (1 - v));
  sum += corners[2] * (u * v);
  sum += corners[3] * ((1 - u) * v);
  return sum;
}

void LightReconstruction::AddLinks(int32_t holder, const Element& receiver, const Vec3f& x,
                                   bool castRays, VectorIrradiance* sum, int64_t* rays) const {
  const Vec3f horizon = receiver.TurnsToAllSides() ? Vec3f() : receiver.axis;
  const float received =
      ElementIrradiance(hierarchy_[holder], light_.irradiance[size_t(holder)]).MaxBand();
  for (const Link& link : network_.incoming[size_t(holder)]) {
    const Spectrum& radiosity = light_.radiosity[size_t(link.source)];
    if (!link.isSampled || link.visibility == 0 || radiosity.IsBlack()) continue;
    const Element& source = hierarchy_[link.source];
    const bool isPartial = link.visibility < 255;

    // A sky is nothing but its visibility.
    if (source.kind == ElementKind::Light && hierarchy_.LightOf(source).FillsSky()) {
      float visible = 0;
      int64_t cast = 0;
      const Vec3f transfer = castRays && isPartial
                                 ? SkyTransfer(hierarchy_.LightOf(source), rayScene_, source, x,
                                               horizon, &visible, &cast)
                                 : link.transfer;
      sum->Add(transfer, radiosity);
      if (receiver.TurnsToAllSides()) sum->isotropic += radiosity * Length(transfer);
      if (rays) *rays += cast;
      continue;
    }
    // What hardly counts is taken as it is.
    const float strength = Length(link.transfer) * radiosity.MaxBand();
    if (castRays && strength < kFaintPart * received) {
      sum->Add(link.transfer, radiosity);
      continue;
    }
    const Vec3f kernel = UnoccludedTransfer(hierarchy_, source, x, horizon);
    float visible = float(link.visibility) / 255;
    if (castRays && isPartial &&
        Length(kernel) * radiosity.MaxBand() > kNegligiblePart * received) {
      visible = VisibleFraction(hierarchy_, rayScene_, source, x, horizon, rays);
    }
    if (!castRays) {
      // A cluster's corner lies beside its faces and may see what none of them does.
      const float most = kMostOfMean * Length(link.transfer);
      visible = std::min(visible, most / std::max(Length(kernel), 1e-30f));
    }
    sum->Add(kernel * visible, radiosity);
    if (receiver.TurnsToAllSides()) sum->isotropic += radiosity * (Length(kernel) * visible);
  }
}

// Links at volume clusters, pushed to the root of one side of a surface.
VectorIrradiance LightReconstruction::FromVolumes(int32_t surfaceSide, const Vec3f& x) const {
  const Element& receiver = hierarchy_[surfaceSide];
  VectorIrradiance sum;
  for (int32_t volume = receiver.parent; volume >= 0; volume = hierarchy_[volume].parent) {
    AddLinks(volume, receiver, x, false, &sum, nullptr);
  }
  return sum;
}

}  // namespace lambert
