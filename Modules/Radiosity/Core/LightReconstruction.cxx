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

bool IsOpen(const Link& link) { return link.isSampled && link.visibility != 0; }

/// Links, known to be more than nothing, whose transfers are evaluated.
int32_t CountOpen(const std::vector<Link>& links) {
  return int32_t(std::count_if(links.begin(), links.end(), IsOpen));
}

}  // namespace

LightReconstruction::LightReconstruction(const ElementHierarchy& hierarchy,
                                         const LinkNetwork& network, const ElementLight& light,
                                         const RayScene& rayScene, std::atomic<int64_t>* room)
    : hierarchy_(hierarchy),
      network_(network),
      light_(light),
      rayScene_(rayScene),
      transfers_(hierarchy.Levels().size(), KeptTransfers(room)) {
  // Corners are kept for clusters of several faces; triangles and patches are evaluated where they
  // are asked.
  cornerIndex_.assign(size_t(hierarchy.Size()), -1);
  int32_t clusters = 0;
  for (int32_t element = 0; element < hierarchy.Size(); ++element) {
    if (IsCluster(element)) cornerIndex_[size_t(element)] = clusters++;
  }
  corners_.resize(size_t(clusters));
}

void LightReconstruction::LightCorners() {
  for (size_t depth = 0; depth < transfers_.size(); ++depth) {
    const std::vector<int32_t>& level = hierarchy_.Levels()[depth];
    transfers_[depth].ForEachPlace(
        int64_t(level.size()), [&](int64_t i, KeptTransfers::Cursor* transfers) {
          const int32_t index = level[size_t(i)];
          if (!IsCluster(index)) return;
          for (int k = 0; k < 4; ++k) {
            corners_[size_t(cornerIndex_[size_t(index)])][size_t(k)] =
                AtCorner(index, hierarchy_[index].frame.Corner(k), transfers);
          }
        });
  }
}

// The parent's light, interpolated, plus the cluster's own links.
VectorIrradiance LightReconstruction::AtCorner(int32_t index, const Vec3f& x,
                                               KeptTransfers::Cursor* transfers) const {
  const Element& cluster = hierarchy_[index];
  VectorIrradiance sum = FromAbove(index, x, transfers);
  AddLinks(index, cluster, x, transfers, &sum);
  return sum;
}

int64_t LightReconstruction::TransfersMade() const {
  int64_t made = 0;
  for (const KeptTransfers& transfers : transfers_) made += transfers.Made();
  return made;
}

bool LightReconstruction::IsCluster(int32_t element) const {
  const Element& e = hierarchy_[element];
  return e.kind == ElementKind::Face && !e.IsPolygon();
}

VectorIrradiance LightReconstruction::At(const Vec3f& x, const std::vector<Share>& shares,
                                         KeptTransfers::Cursor* transfers, int64_t* rays) const {
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
      if (!within) sum += FromAbove(index, place, transfers) * weight;
    }
  }
  for (const Share& holder : holders) {
    if (!(holder.weight > 0)) continue;
    const Vec3f place = x + (holder.inside / holder.weight - x) * kInset;
    VectorIrradiance own;
    AddLinks(holder.leaf, hierarchy_[holder.leaf], place, transfers, &own, rays);
    sum += own * holder.weight;
  }
  return sum;
}

// What a triangle or cluster has from the clusters or volumes above it, clipped at its plane.
VectorIrradiance LightReconstruction::FromAbove(int32_t element, const Vec3f& x,
                                                KeptTransfers::Cursor* transfers) const {
  const Element& receiver = hierarchy_[element];
  if (hierarchy_[receiver.parent].IsVolume()) return FromVolumes(element, x, transfers);
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

// Where `rays` is given, links are judged by what they bring: what hardly counts is taken as it is,
// and rays are cast for what is partly blocked.
void LightReconstruction::AddLinks(int32_t holder, const Element& receiver, const Vec3f& x,
                                   KeptTransfers::Cursor* transfers, VectorIrradiance* sum,
                                   int64_t* rays) const {
  const Vec3f horizon = receiver.TurnsToAllSides() ? Vec3f() : receiver.axis;
  const float received =
      ElementIrradiance(hierarchy_[holder], light_.irradiance[size_t(holder)]).MaxBand();
  const std::vector<Link>& links = network_.incoming[size_t(holder)];
  KeptTransfers::Transfer* next = transfers->Visit(holder, x, CountOpen(links));
  for (const Link& link : links) {
    if (!IsOpen(link)) continue;
    KeptTransfers::Transfer* transfer = next++;
    const Spectrum& radiosity = light_.radiosity[size_t(link.source)];
    if (radiosity.IsBlack()) continue;
    const Element& source = hierarchy_[link.source];
    const bool isPartial = link.visibility < 255;
    if (source.kind == ElementKind::Light && hierarchy_.LightOf(source).FillsSky()) {
      const Vec3f fromSky = FromSky(link, x, horizon, transfer, rays);
      sum->Add(fromSky, radiosity);
      if (receiver.TurnsToAllSides()) sum->isotropic += radiosity * Length(fromSky);
      continue;
    }
    const float strength = Length(link.transfer) * radiosity.MaxBand();
    if (rays && strength < kFaintPart * received) {
      sum->Add(link.transfer, radiosity);
      continue;
    }

    // The kernel at this place, and how much of the source is seen from here.
    if (transfer->visible == KeptTransfers::kUnknown) {
      *transfer = {UnoccludedTransfer(hierarchy_, source, x, horizon), KeptTransfers::kUnoccluded};
      transfers->CountMade();
    }
    const Vec3f& kernel = transfer->kernel;
    float visible = float(link.visibility) / 255;
    if (rays && isPartial && Length(kernel) * radiosity.MaxBand() > kNegligiblePart * received) {
      if (transfer->visible < 0) {
        transfer->visible = VisibleFraction(hierarchy_, rayScene_, source, x, horizon, rays);
      }
      visible = transfer->visible;
    }
    if (!rays) {
      // A cluster's corner lies beside its faces and may see what none of them does.
      const float most = kMostOfMean * Length(link.transfer);
      visible = std::min(visible, most / std::max(Length(kernel), 1e-30f));
    }
    sum->Add(kernel * visible, radiosity);
    if (receiver.TurnsToAllSides()) sum->isotropic += radiosity * (Length(kernel) * visible);
  }
}

// A sky is nothing but its visibility.
Vec3f LightReconstruction::FromSky(const Link& link, const Vec3f& x, const Vec3f& horizon,
                                   KeptTransfers::Transfer* transfer, int64_t* rays) const {
  if (!rays || link.visibility == 255) return link.transfer;
  if (transfer->visible < 0) {
    const Element& source = hierarchy_[link.source];
    transfer->kernel = SkyTransfer(hierarchy_.LightOf(source), rayScene_, source, x, horizon,
                                   &transfer->visible, rays);
  }
  return transfer->kernel;
}

// Links at volume clusters, pushed to the root of one side of a surface.
VectorIrradiance LightReconstruction::FromVolumes(int32_t surfaceSide, const Vec3f& x,
                                                  KeptTransfers::Cursor* transfers) const {
  const Element& receiver = hierarchy_[surfaceSide];
  VectorIrradiance sum;
  for (int32_t volume = receiver.parent; volume >= 0; volume = hierarchy_[volume].parent) {
    AddLinks(volume, receiver, x, transfers, &sum);
  }
  return sum;
}

}  // namespace lambert
