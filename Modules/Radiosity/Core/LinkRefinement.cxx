#include "Radiosity/Core/LinkRefinement.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Radiosity/Core/LightExchange.h"
#include "Radiosity/Core/Transfer.h"

namespace lambert {

namespace {

/// Transfers that carry more than this many thresholds are sampled each against each.
constexpr float kThoroughAbove = 0.5f;

struct Pair {
  int32_t source, receiver;
};

enum class Verdict : uint8_t { Drop, Keep, KeepAtFloor, SplitSource, SplitReceiver, SplitSelf };

struct Judgement {
  Verdict verdict = Verdict::Drop;
  Link link;
  int32_t rays = 0;
};

/// Visibility as a byte; fractions between none and all stay between.
uint8_t Quantize(float visibility) {
  if (visibility <= 0) return 0;
  if (visibility >= 1) return 255;
  return uint8_t(std::min(254.f, std::max(1.f, visibility * 255 + 0.5f)));
}

/// Looks at pairs of elements without changing anything; safe from several threads.
class Judge {
 public:
  Judge(double threshold, const RefinementOracle& oracle, const ElementHierarchy& hierarchy,
        const ElementLight& light, const RayScene& rayScene)
      : threshold_(float(threshold)),
        oracle_(oracle),
        hierarchy_(hierarchy),
        light_(light),
        rayScene_(rayScene) {}

  /// Whether a link as it stands is in error beyond the threshold, or must be looked at for the
  /// first time.
  bool NeedsWork(const Link& link, int32_t receiver) const {
    const float radiosity = light_.radiosity[size_t(link.source)].MaxBand();
    if (!(radiosity > 0)) return false;
    if (!link.isSampled) return true;
    const Element& source = hierarchy_[link.source];
    const Element& target = hierarchy_[receiver];
    if (!CanSplit(source) && !CanSplit(target)) return false;
    LinkEvidence evidence{source, target, BoundPair(hierarchy_, source, target), radiosity,
                          light_.variation[size_t(link.source)]};
    evidence.reflected = ReflectedLuminance(target, light_.radiosity[size_t(receiver)]);
    Consider(link, &evidence);
    return this->Exceeds(oracle_.Estimate(evidence), target);
  }

  Judgement operator()(const Pair& pair) const {
    Judgement judgement;
    judgement.link.source = pair.source;
    const Element& source = hierarchy_[pair.source];
    const Element& receiver = hierarchy_[pair.receiver];
    const float radiosity = light_.radiosity[size_t(pair.source)].MaxBand();
    if (pair.source == pair.receiver) return JudgeSelf(source, radiosity, judgement);

    // Geometry first: it costs no rays.
    const PairBound bound = BoundPair(hierarchy_, source, receiver);
    if (bound.apart) return judgement;
    judgement.verdict = Verdict::Keep;
    if (!(radiosity > 0)) return judgement;
    LinkEvidence evidence{source, receiver, bound, radiosity,
                          light_.variation[size_t(pair.source)]};
    evidence.reflected = ReflectedLuminance(receiver, light_.radiosity[size_t(pair.receiver)]);
    const TransferError error = oracle_.Estimate(evidence);
    if (this->Exceeds(error, receiver)) {
      judgement.verdict = Choose(error, source, receiver);
      if (judgement.verdict != Verdict::KeepAtFloor) return judgement;
    }

    // Then visibility, as much of it as the transfer is worth.
    const bool isFixed = oracle_.HasFixedSamples();
    const bool thorough =
        !isFixed && bound.formFactor * radiosity * receiver.area > kThoroughAbove * threshold_;
    TransferEstimate estimate = EstimateTransfer(hierarchy_, rayScene_, source, receiver, thorough);
    judgement.rays = int32_t(estimate.rays);
    if (!isFixed && !thorough && estimate.visibility > 0 && estimate.visibility < 1) {
      estimate = EstimateTransfer(hierarchy_, rayScene_, source, receiver, true);
      judgement.rays += int32_t(estimate.rays);
    }
    judgement.link.transfer = estimate.transfer;
    judgement.link.visibility = Quantize(estimate.visibility);
    judgement.link.isSampled = true;
    if (judgement.verdict == Verdict::Keep) {
      judgement.verdict = this->JudgeSampled(evidence, &judgement.link);
    }
    return judgement;
  }

 private:
  /// Of a link that has its samples; none where all of it is blocked for certain (9.2.2).
  Verdict JudgeSampled(LinkEvidence evidence, Link* link) const {
    const Element &source = evidence.source, &receiver = evidence.receiver;
    Consider(*link, &evidence);
    TransferError error = oracle_.Estimate(evidence);
    if (this->Exceeds(error, receiver) && oracle_.IsCertain(evidence)) {
      if (evidence.visibility <= 0) return Verdict::Drop;
      evidence.isCertain = link->isCertain = true;
      error = oracle_.Estimate(evidence);
    }
    return this->Exceeds(error, receiver) ? Choose(error, source, receiver) : Verdict::Keep;
  }

  static void Consider(const Link& link, LinkEvidence* evidence) {
    evidence->visibility = float(link.visibility) / 255;
    evidence->transfer = link.transfer;
    evidence->isCertain = link.isCertain;
  }
  bool Exceeds(const TransferError& error, const Element& receiver) const {
    return error.Sum() * receiver.area > threshold_;
  }
  bool CanSplit(const Element& element) const { return !element.IsLeaf() || element.canSplit; }

  /// An element and itself: nothing within a plane, all pairs of its children where its own light
  /// matters.
  Judgement JudgeSelf(const Element& element, float radiosity, Judgement judgement) const {
    if (element.IsPolygon() || element.coneAngle < 1e-3f) return judgement;
    const float bent =
        element.IsVolume()
            ? 1.f
            : std::max(0.f, 1 - Length(element.vectorArea) / std::max(element.area, 1e-30f));
    const bool split = bent * radiosity * element.area > threshold_ && CanSplit(element);
    judgement.verdict = split ? Verdict::SplitSelf : Verdict::Keep;
    return judgement;
  }

  Verdict Choose(const TransferError& error, const Element& source, const Element& receiver) const {
    const bool canSource = CanSplit(source), canReceiver = CanSplit(receiver);
    if (!canSource && !canReceiver) return Verdict::KeepAtFloor;
    if (!canSource) return Verdict::SplitReceiver;
    if (!canReceiver) return Verdict::SplitSource;
    // By what each contributes; of a larger source more: a small receiver split further and further
    // would in the end take the mean of it for the part of it that it sees.
    const float size = std::max(1.f, source.radius / std::max(receiver.radius, 1e-20f));
    if (error.bySource * size == error.byReceiver) {
      return source.radius > receiver.radius ? Verdict::SplitSource : Verdict::SplitReceiver;
    }
    return error.bySource * size > error.byReceiver ? Verdict::SplitSource : Verdict::SplitReceiver;
  }

  const float threshold_;
  const RefinementOracle& oracle_;
  const ElementHierarchy& hierarchy_;
  const ElementLight& light_;
  const RayScene& rayScene_;
};

/// The links that need work, taken out of the network, and what it takes to put them back.
struct TakenLinks {
  std::vector<std::vector<Link>> byReceiver;
  std::vector<size_t> keptCount;  ///< links that stayed, which stand first

  std::vector<Pair> Pairs() const {
    std::vector<Pair> pairs;
    for (size_t receiver = 0; receiver < byReceiver.size(); ++receiver) {
      for (const Link& link : byReceiver[receiver])
        pairs.push_back({link.source, int32_t(receiver)});
    }
    return pairs;
  }
};

TakenLinks TakeLinksInError(const Judge& judge, LinkNetwork* network) {
  const size_t receivers = network->incoming.size();
  TakenLinks taken;
  taken.byReceiver.resize(receivers);
  taken.keptCount.resize(receivers);
  ParallelForEach(int64_t(receivers), 64, [&](int64_t receiver) {
    std::vector<Link>& links = network->incoming[size_t(receiver)];
    size_t kept = 0;
    for (const Link& link : links) {
      if (judge.NeedsWork(link, int32_t(receiver))) {
        taken.byReceiver[size_t(receiver)].push_back(link);
      } else {
        links[kept++] = link;
      }
    }
    links.resize(kept);
    taken.keptCount[size_t(receiver)] = kept;
  });
  return taken;
}

/// The network as it was before its links were taken; elements made since stay, without links of
/// their own and with their part of what their parents receive.
void PutBack(const TakenLinks& taken, const ElementHierarchy& hierarchy, ElementLight* light,
             LinkNetwork* network) {
  for (size_t receiver = 0; receiver < network->incoming.size(); ++receiver) {
    std::vector<Link>& links = network->incoming[receiver];
    if (receiver >= taken.byReceiver.size()) {
      links.clear();
      continue;
    }
    links.resize(taken.keptCount[receiver]);
    links.insert(links.end(), taken.byReceiver[receiver].begin(), taken.byReceiver[receiver].end());
  }
  for (size_t index = taken.byReceiver.size(); index < network->incoming.size(); ++index) {
    const Element& element = hierarchy[int32_t(index)];
    const size_t parent = size_t(element.parent);
    light->irradiance[index] =
        PushIrradiance(hierarchy[element.parent], light->irradiance[parent], element);
    light->rowScale[index] = light->rowScale[parent];
  }
}

/// The elements that the verdicts ask to split, sorted and unique.
std::vector<int32_t> ElementsToSplit(const std::vector<Pair>& pairs,
                                     const std::vector<Judgement>& judgements) {
  std::vector<int32_t> elements;
  for (size_t i = 0; i < pairs.size(); ++i) {
    switch (judgements[i].verdict) {
      case Verdict::SplitSource:
        elements.push_back(pairs[i].source);
        break;
      case Verdict::SplitReceiver:
      case Verdict::SplitSelf:
        elements.push_back(pairs[i].receiver);
        break;
      default:
        break;
    }
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

/// Children of an element once it is split, at most.
int64_t ChildrenToCome(const ElementHierarchy& hierarchy, int32_t index) {
  const Element& element = hierarchy[index];
  return element.IsLeaf() ? hierarchy.MostChildren(element) : element.childCount;
}

/// Elements that are made where those named are split, at most.
int64_t ElementsToCome(const std::vector<int32_t>& split, const ElementHierarchy& hierarchy) {
  int64_t count = 0;
  for (const int32_t index : split) {
    if (hierarchy[index].IsLeaf()) count += hierarchy.MostChildren(hierarchy[index]);
  }
  return count;
}

/// Pairs that the verdicts keep or put in the place of others.
int64_t PairsToCome(const std::vector<Pair>& pairs, const std::vector<Judgement>& judgements,
                    const ElementHierarchy& hierarchy) {
  int64_t count = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Verdict verdict = judgements[i].verdict;
    const int32_t split = verdict == Verdict::SplitSource ? pairs[i].source : pairs[i].receiver;
    const int64_t children = ChildrenToCome(hierarchy, split);
    if (verdict == Verdict::SplitSelf) count += children * children;
    if (verdict == Verdict::SplitSource || verdict == Verdict::SplitReceiver) count += children;
    if (verdict == Verdict::Keep || verdict == Verdict::KeepAtFloor) ++count;
  }
  return count;
}

/// The pairs that take the place of one: with the children of the end that was split.
void AppendChildPairs(const Pair& pair, Verdict verdict, const ElementHierarchy& hierarchy,
                      std::vector<Pair>* next) {
  const int32_t split = verdict == Verdict::SplitSource ? pair.source : pair.receiver;
  const Element& element = hierarchy[split];
  if (element.IsLeaf()) {  // Found to be at the floor: look at the pair again, it will not be split
                           // there.
    next->push_back(pair);
    return;
  }
  for (int32_t i = element.child; i < element.child + element.childCount; ++i) {
    if (verdict == Verdict::SplitSelf) {
      for (int32_t j = element.child; j < element.child + element.childCount; ++j)
        next->push_back({i, j});
    } else {
      next->push_back(verdict == Verdict::SplitSource ? Pair{i, pair.receiver}
                                                      : Pair{pair.source, i});
    }
  }
}

}  // namespace

void ElementLight::Grow(const ElementHierarchy& hierarchy) {
  const size_t old = radiosity.size(), size = size_t(hierarchy.Size());
  radiosity.resize(size);
  variation.resize(size, 0);
  irradiance.resize(size);
  rowScale.resize(size, 1);
  for (size_t i = old; i < size; ++i) {
    const Element& element = hierarchy[int32_t(i)];
    radiosity[i] = element.emittance;
    if (element.parent < 0 || size_t(element.parent) >= old) continue;
    const Element& parent = hierarchy[element.parent];
    if (parent.IsVolume()) continue;
    radiosity[i] += radiosity[size_t(element.parent)] - parent.emittance;
  }
}

int64_t LinkNetwork::Count() const {
  int64_t count = 0;
  for (const std::vector<Link>& links : incoming) count += int64_t(links.size());
  return count;
}

void MakeInitialLinks(const ElementHierarchy& hierarchy, LinkNetwork* network) {
  network->incoming.resize(size_t(hierarchy.Size()));
  if (hierarchy.Root() < 0) return;
  std::vector<Link>& links = network->incoming[size_t(hierarchy.Root())];
  Link link;
  link.source = hierarchy.Root();
  links.push_back(link);
  if (hierarchy.EmitterRoot() >= 0) {
    link.source = hierarchy.EmitterRoot();
    links.push_back(link);
  }
  for (const int32_t source : hierarchy.Lights()) {
    link.source = source;
    links.push_back(link);
  }
}

bool RefineLinks(double threshold, const RefinementOracle& oracle, const RayScene& rayScene,
                 ElementHierarchy* hierarchy, ElementLight* light, LinkNetwork* network,
                 const ProgressCallback& progress, const RoomCallback& hasRoom) {
  const Judge judge(threshold, oracle, *hierarchy, *light, rayScene);
  network->linksAtFloor = 0;
  const TakenLinks taken = TakeLinksInError(judge, network);
  std::vector<Pair> pairs = taken.Pairs();
  std::vector<Judgement> judgements;
  for (int round = 0; !pairs.empty(); ++round) {
    if (!Report(progress, round / (round + 8.0), "refining links")) {
      PutBack(taken, *hierarchy, light, network);
      return false;
    }

    // Judge all pairs; what is asked to be split then gets its children, where there is room.
    judgements.assign(pairs.size(), {});
    ParallelForEach(int64_t(pairs.size()), 32,
                    [&](int64_t i) { judgements[size_t(i)] = judge(pairs[size_t(i)]); });
    const std::vector<int32_t> split = ElementsToSplit(pairs, judgements);
    if (hasRoom &&
        !hasRoom(ElementsToCome(split, *hierarchy), PairsToCome(pairs, judgements, *hierarchy))) {
      PutBack(taken, *hierarchy, light, network);
      return false;
    }
    hierarchy->Split(split);
    light->Grow(*hierarchy);
    network->incoming.resize(size_t(hierarchy->Size()));

    // Keep the good ones, go on with the others.
    std::vector<Pair> next;
    for (size_t i = 0; i < pairs.size(); ++i) {
      const Judgement& judgement = judgements[i];
      network->rays += judgement.rays;
      if (judgement.verdict == Verdict::Drop) continue;
      if (judgement.verdict == Verdict::KeepAtFloor) ++network->linksAtFloor;
      if (judgement.verdict == Verdict::Keep || judgement.verdict == Verdict::KeepAtFloor) {
        network->incoming[size_t(pairs[i].receiver)].push_back(judgement.link);
      } else {
        AppendChildPairs(pairs[i], judgement.verdict, *hierarchy, &next);
      }
    }
    pairs.swap(next);
  }
  return true;
}

void PushLinksToChildren(const std::vector<int32_t>& parents, float part, const RayScene& rayScene,
                         const ElementHierarchy& hierarchy, const ElementLight& light,
                         LinkNetwork* network) {
  network->incoming.resize(size_t(hierarchy.Size()));
  std::vector<int64_t> rays(parents.size(), 0);
  ParallelForEach(int64_t(parents.size()), 4, [&](int64_t i) {
    // The parent keeps its faint links; children are its alone, so that no other thread writes to
    // them.
    const int32_t index = parents[size_t(i)];
    const Element& parent = hierarchy[index];
    const float received = ElementIrradiance(parent, light.irradiance[size_t(index)]).MaxBand();
    std::vector<Link>& links = network->incoming[size_t(index)];
    size_t kept = 0;
    for (const Link& link : links) {
      const float radiosity = light.radiosity[size_t(link.source)].MaxBand();
      const PairBound bound = BoundPair(hierarchy, hierarchy[link.source], parent);
      if (!link.isSampled || bound.formFactor * radiosity <= part * received) {
        links[kept++] = link;
        continue;
      }
      for (int32_t child = parent.child; child < parent.child + parent.childCount; ++child) {
        const Element& source = hierarchy[link.source];
        if (BoundPair(hierarchy, source, hierarchy[child]).apart) continue;
        const TransferEstimate estimate =
            EstimateTransfer(hierarchy, rayScene, source, hierarchy[child], true);
        rays[size_t(i)] += estimate.rays;
        Link pushed = link;
        pushed.transfer = estimate.transfer;
        pushed.visibility = Quantize(estimate.visibility);
        network->incoming[size_t(child)].push_back(pushed);
      }
    }
    links.resize(kept);
  });
  for (const int64_t cast : rays) network->rays += cast;
}

}  // namespace lambert
