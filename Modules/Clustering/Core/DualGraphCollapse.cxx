#include "Clustering/Core/DualGraphCollapse.h"

#include <algorithm>
#include <numeric>

#include "Clustering/Core/ClusterCost.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// Runs in place where there is too little for a second thread.
template <class Body>
void ForEachIndex(size_t count, const Body& body) {
  constexpr int64_t kGrain = 512;
  if (int64_t(count) <= 2 * kGrain) {
    for (size_t i = 0; i < count; ++i) body(i);
  } else {
    ParallelForEach(int64_t(count), kGrain, [&](int64_t i) { body(size_t(i)); });
  }
}

/// An edge of the dual graph, seen from one end.
struct Link {
  int32_t cluster;  ///< the other end
  CostRank rank;
  double shared;  ///< length of the common border; a multiple of 2^-36 of the surface's diagonal
};

/// Edges are collapsed in rounds. In a round every edge that is the best one of both its ends goes:
/// those are the edges that a priority queue would take before anything around them changes. A
/// cluster lives on in the lower of the two slots. All of a round is done in parallel, each slot
/// written by one iteration.
class DualGraphCollapse {
 public:
  DualGraphCollapse(const SurfaceFaces& surface, double balance);
  MergeTree Run(const std::function<bool(double)>& proceed);

 private:
  struct Group {
    int32_t core;         ///< slot that the cluster lives on in
    int32_t firstMember;  ///< others, in members_, in the order of joining
    int32_t memberCount;
    int32_t firstMerge;
    int64_t linkBegin;  ///< room for the links in links_
  };

  bool ComesFirst(int32_t from, const Link& a, const Link& b) const;
  void ChooseBestEdges();
  void GroupClusters();
  void AddSuitors(int32_t core, int32_t partner);
  void JoinMoments();
  void JoinLinks();
  void FindTouched();
  void RankLinks();
  int32_t JoinParallelLinks(Link* links, int32_t count) const;
  void ReserveLinks(int64_t count);

  // Per slot.
  std::vector<ClusterMoments> clusters_;
  std::vector<int32_t> node_, best_, into_, linkCount_, groupedIn_, touchedIn_;
  std::vector<int64_t> linkBegin_;
  std::vector<Link> links_;

  // Per round.
  int32_t round_ = 0;
  std::vector<int32_t> changed_, members_;
  std::vector<Group> groups_;
  int64_t room_ = 0;  ///< that the links of the groups take at most

  MergeTree tree_;
  double balance_;
};

DualGraphCollapse::DualGraphCollapse(const SurfaceFaces& surface, double balance)
    : balance_(balance) {
  const size_t count = size_t(surface.count);
  tree_.leafCount = surface.count;
  tree_.merges.reserve(count - 1);

  // Everything is measured in diagonals of the surface, from its center.
  Box3f bounds;
  const auto corner = [&](size_t face, int k) {
    return surface.mesh->Corner(surface.faces[face], k);
  };
  for (size_t face = 0; face < count; ++face) {
    for (int k = 0; k < 3; ++k) bounds.Include(corner(face, k));
  }
  const Vec3d center = (Vec3d(bounds.low) + Vec3d(bounds.high)) * 0.5;
  const double diagonal = Length(Vec3d(bounds.high) - Vec3d(bounds.low));
  const double scale = diagonal > 0 ? 1 / diagonal : 1;
  const auto place = [&](size_t face, int k) { return (Vec3d(corner(face, k)) - center) * scale; };

  clusters_.resize(count);
  node_.resize(count), best_.assign(count, -1), into_.resize(count);
  std::iota(node_.begin(), node_.end(), 0);
  into_ = node_;
  linkCount_.assign(count, 0), groupedIn_.assign(count, 0), touchedIn_.assign(count, 0);
  linkBegin_.resize(count);
  links_.resize(3 * count);
  ForEachIndex(count, [&](size_t face) {
    const std::array<Vec3d, 3> p{place(face, 0), place(face, 1), place(face, 2)};
    clusters_[face] = ClusterMoments::OfTriangle(Vec3f(p[0]), Vec3f(p[1]), Vec3f(p[2]));
    linkBegin_[face] = int64_t(3 * face);
    Link* const links = links_.data() + 3 * face;
    for (size_t k = 0; k < 3; ++k) {
      // The same length from either face, as both subtract the same two points.
      const double length =
          std::ldexp(std::round(std::ldexp(Length(p[(k + 1) % 3] - p[k]), 36)), -36);
      clusters_[face].perimeter += length;
      const int32_t neighbour = surface.neighbours[face][k];
      if (neighbour >= 0) links[linkCount_[face]++] = {neighbour, 0, length};
    }
    linkCount_[face] = JoinParallelLinks(links, linkCount_[face]);
  });
  ForEachIndex(count, [&](size_t face) {
    for (int32_t i = 0; i < linkCount_[face]; ++i) {
      Link& link = links_[size_t(linkBegin_[face] + i)];
      link.rank =
          RankOfJoining(clusters_[face], clusters_[size_t(link.cluster)], link.shared, balance_);
    }
  });
  changed_ = node_;
}

MergeTree DualGraphCollapse::Run(const std::function<bool(double)>& proceed) {
  const size_t wanted = size_t(tree_.leafCount) - 1;
  while (tree_.merges.size() < wanted) {
    if (proceed && !proceed(double(tree_.merges.size()) / double(wanted))) throw Cancelled();
    ++round_;
    ChooseBestEdges();
    GroupClusters();
    JoinMoments();
    JoinLinks();
    FindTouched();
    RankLinks();
  }
  return std::move(tree_);
}

/// A total order of the edges, the same from both ends: cost, then the smaller result, then a
/// shuffle that keeps equal clusters from queueing up in a row.
bool DualGraphCollapse::ComesFirst(int32_t from, const Link& a, const Link& b) const {
  if (a.rank != b.rank) return a.rank < b.rank;
  const int32_t facesA = clusters_[size_t(a.cluster)].faces,
                facesB = clusters_[size_t(b.cluster)].faces;
  if (facesA != facesB) return facesA < facesB;
  const auto shuffle = [&](int32_t to) {
    const uint32_t low = uint32_t(std::min(from, to)), high = uint32_t(std::max(from, to));
    uint32_t hash = low * 0x9e3779b1u ^ (high + 0x7f4a7c15u) * 0x85ebca6bu;
    hash = (hash ^ hash >> 15) * 0x2c1b3c6du;
    return std::make_pair(hash ^ hash >> 13, uint64_t(low) << 32 | high);
  };
  return shuffle(a.cluster) < shuffle(b.cluster);
}

void DualGraphCollapse::ChooseBestEdges() {
  ForEachIndex(changed_.size(), [&](size_t i) {
    const int32_t slot = changed_[i];
    const Link* const links = links_.data() + linkBegin_[size_t(slot)];
    const Link* best = links;
    for (int32_t k = 1; k < linkCount_[size_t(slot)]; ++k) {
      if (ComesFirst(slot, links[k], *best)) best = links + k;
    }
    best_[size_t(slot)] = best->cluster;
  });
}

/// A group a pair that chose each other; near a hub also others that chose one of the two.
void DualGraphCollapse::GroupClusters() {
  groups_.clear();
  members_.clear();
  room_ = 0;
  for (const int32_t slot : changed_) {
    const int32_t partner = best_[size_t(slot)];
    if (groupedIn_[size_t(slot)] == round_ || best_[size_t(partner)] != slot) continue;
    const int32_t core = std::min(slot, partner), other = std::max(slot, partner);
    Group group{core, int32_t(members_.size()), 0, int32_t(tree_.merges.size()), room_};
    members_.push_back(other);
    groupedIn_[size_t(core)] = groupedIn_[size_t(other)] = round_;
    AddSuitors(core, other);
    group.memberCount = int32_t(members_.size()) - group.firstMember;
    room_ += linkCount_[size_t(core)];
    for (size_t m = size_t(group.firstMember); m < members_.size(); ++m) {
      into_[size_t(members_[m])] = core;
      room_ += linkCount_[size_t(members_[m])];
    }
    tree_.merges.resize(tree_.merges.size() + size_t(group.memberCount));
    groups_.push_back(group);
  }
  ReserveLinks(room_);
}

/// A hub with many small neighbours would take them one a round, each time ranking all of them
/// anew. It takes those that want it at up to twice the cost of the pair at once, while they are
/// together no larger than the pair.
void DualGraphCollapse::AddSuitors(int32_t core, int32_t partner) {
  constexpr int32_t kHub = 32;
  constexpr CostRank kOctave = 8;
  struct Suitor {
    CostRank rank;
    int32_t slot;
  };
  std::vector<Suitor> suitors;
  CostRank pairRank = 0;
  for (const int32_t end : {core, partner}) {
    if (linkCount_[size_t(end)] < kHub) continue;
    const Link* const links = links_.data() + linkBegin_[size_t(end)];
    for (int32_t k = 0; k < linkCount_[size_t(end)]; ++k) {
      if (links[k].cluster == core || links[k].cluster == partner) {
        pairRank = links[k].rank;
      } else if (best_[size_t(links[k].cluster)] == end) {
        suitors.push_back({links[k].rank, links[k].cluster});
      }
    }
  }
  std::sort(suitors.begin(), suitors.end(), [](const Suitor& a, const Suitor& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.slot < b.slot;
  });
  float spareArea = clusters_[size_t(core)].area + clusters_[size_t(partner)].area;
  for (const Suitor& suitor : suitors) {
    spareArea -= clusters_[size_t(suitor.slot)].area;
    if (suitor.rank > pairRank + kOctave || spareArea < 0) break;
    groupedIn_[size_t(suitor.slot)] = round_;
    members_.push_back(suitor.slot);
  }
}

void DualGraphCollapse::JoinMoments() {
  ForEachIndex(groups_.size(), [&](size_t g) {
    const Group& group = groups_[g];
    const size_t core = size_t(group.core);
    double perimeter = clusters_[core].perimeter;
    for (int32_t i = 0; i < group.memberCount; ++i) {
      const size_t member = size_t(members_[size_t(group.firstMember + i)]);
      const size_t merge = size_t(group.firstMerge + i);
      tree_.merges[merge] = {node_[core], node_[member]};
      node_[core] = tree_.leafCount + int32_t(merge);
      perimeter += clusters_[member].perimeter;
      clusters_[core] = ClusterMoments::Join(clusters_[core], clusters_[member]);
    }
    clusters_[core].perimeter = perimeter;
  });
}

/// The links of a group are those of its members, without those among them, which leave the
/// perimeter.
void DualGraphCollapse::JoinLinks() {
  const int64_t base = int64_t(links_.size());
  links_.resize(links_.size() + size_t(room_));
  ForEachIndex(groups_.size(), [&](size_t g) {
    const Group& group = groups_[g];
    Link* const joined = links_.data() + base + group.linkBegin;
    int32_t count = 0;
    const auto take = [&](int32_t slot) {
      const Link* const links = links_.data() + linkBegin_[size_t(slot)];
      for (int32_t k = 0; k < linkCount_[size_t(slot)]; ++k) {
        const int32_t to = into_[size_t(links[k].cluster)];
        if (to == group.core) {
          clusters_[size_t(group.core)].perimeter -= links[k].shared;
        } else {
          joined[count++] = {to, 0, links[k].shared};
        }
      }
    };
    take(group.core);
    for (int32_t i = 0; i < group.memberCount; ++i) {
      const int32_t member = members_[size_t(group.firstMember + i)];
      take(member);
      linkCount_[size_t(member)] = 0;
    }
    linkBegin_[size_t(group.core)] = base + group.linkBegin;
    linkCount_[size_t(group.core)] = JoinParallelLinks(joined, count);
  });
}

/// Changed clusters: the groups, and whoever stands beside them.
void DualGraphCollapse::FindTouched() {
  changed_.clear();
  for (const Group& group : groups_) {
    changed_.push_back(group.core);
    touchedIn_[size_t(group.core)] = round_;
  }
  for (const Group& group : groups_) {
    const Link* const links = links_.data() + linkBegin_[size_t(group.core)];
    for (int32_t k = 0; k < linkCount_[size_t(group.core)]; ++k) {
      const int32_t neighbour = links[k].cluster;
      if (touchedIn_[size_t(neighbour)] == round_) continue;
      touchedIn_[size_t(neighbour)] = round_;
      changed_.push_back(neighbour);
    }
  }
}

void DualGraphCollapse::RankLinks() {
  ForEachIndex(changed_.size(), [&](size_t i) {
    const size_t slot = size_t(changed_[i]);
    Link* const links = links_.data() + linkBegin_[slot];
    const bool grouped = groupedIn_[slot] == round_;
    if (!grouped) {
      for (int32_t k = 0; k < linkCount_[slot]; ++k) {
        links[k].cluster = into_[size_t(links[k].cluster)];
      }
      linkCount_[slot] = JoinParallelLinks(links, linkCount_[slot]);
    }
    for (int32_t k = 0; k < linkCount_[slot]; ++k) {
      const size_t to = size_t(links[k].cluster);
      if (!grouped && groupedIn_[to] != round_) continue;
      links[k].rank = RankOfJoining(clusters_[slot], clusters_[to], links[k].shared, balance_);
    }
  });
}

/// Sorts links by their other end and adds up those that lead to the same.
int32_t DualGraphCollapse::JoinParallelLinks(Link* links, int32_t count) const {
  std::sort(links, links + count,
            [](const Link& a, const Link& b) { return a.cluster < b.cluster; });
  int32_t kept = 0;
  for (int32_t k = 0; k < count; ++k) {
    if (kept > 0 && links[kept - 1].cluster == links[k].cluster) {
      links[kept - 1].shared += links[k].shared;
    } else {
      links[kept++] = links[k];
    }
  }
  return kept;
}

/// Makes room for `count` links at the end; drops the lists that have been left behind when they
/// are a third of all.
void DualGraphCollapse::ReserveLinks(int64_t count) {
  if (int64_t(links_.size()) + count <= int64_t(links_.capacity())) return;
  int64_t live = 0;
  for (const int32_t n : linkCount_) live += n;
  std::vector<Link> compact;
  compact.reserve(size_t(live + count + live / 2 + tree_.leafCount / 4));
  for (size_t slot = 0; slot < linkCount_.size(); ++slot) {
    if (linkCount_[slot] == 0) continue;
    const auto begin = links_.begin() + linkBegin_[slot];
    linkBegin_[slot] = int64_t(compact.size());
    compact.insert(compact.end(), begin, begin + linkCount_[slot]);
  }
  links_.swap(compact);
}

}  // namespace

MergeTree CollapseDualGraph(const SurfaceFaces& surface, double balance,
                            const std::function<bool(double)>& proceed) {
  if (surface.count == 1) return MergeTree{1, {}};
  return DualGraphCollapse(surface, balance).Run(proceed);
}

}  // namespace lambert
