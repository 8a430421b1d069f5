#include "Classical/Core/ExchangeMatrix.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {

/// Pairs by which the memory is foretold: right to about 2 %.
constexpr int kPairsForMemory = 8192;
constexpr int kPlacePairs = kPlacesPerElement * kPlacesPerElement;
/// Groups whose rows are made between two reports of progress.
constexpr int64_t kGroupsPerReport = 16;

/// Two sides that may exchange light.
struct Pair {
  int32_t row, column;
  float area;       ///< exchange area, m2; before that is known, the visible part
  int32_t segment;  ///< first of its segments
};

/// All pairs of two groups.
class GroupPair {
 public:
  GroupPair(const ElementSides& sides, const ShaftBlockers& shafts, const RayScene& rayScene,
            int visibilityRays)
      : sides_(sides), shafts_(shafts), rayScene_(rayScene), visibilityRays_(visibilityRays) {}

  /// The exchange areas of all pairs that see each other.
  const std::vector<Pair>& Exchange(int32_t rowGroup, int32_t columnGroup) {
    CollectFacing(rowGroup, columnGroup);
    if (pairs_.empty()) return pairs_;
    const ShaftBlockers::Faces faces = shafts_.Between(rowGroup, columnGroup);
    if (!faces.IsOpen()) Shadow(faces);
    for (Pair& pair : pairs_) {
      if (!(pair.area > 0)) continue;
      pair.area *= float(
          ExchangeArea(sides_.triangles[size_t(pair.row)], sides_.triangles[size_t(pair.column)]));
    }
    return pairs_;
  }
  int64_t Rays() const { return rays_; }

 private:
  void CollectFacing(int32_t rowGroup, int32_t columnGroup) {
    pairs_.clear();
    const int32_t rowEnd = sides_.groupBegin[size_t(rowGroup) + 1];
    const int32_t columnBegin = sides_.groupBegin[size_t(columnGroup)];
    const int32_t columnEnd = sides_.groupBegin[size_t(columnGroup) + 1];
    for (int32_t i = sides_.groupBegin[size_t(rowGroup)]; i < rowEnd; ++i) {
      const ExchangeTriangle& a = sides_.triangles[size_t(i)];
      if (!(sides_.exposure[size_t(i)] > 0)) continue;
      for (int32_t j = std::max(i + 1, columnBegin); j < columnEnd; ++j) {
        if (!(sides_.exposure[size_t(j)] > 0)) continue;
        if (CanExchange(a, sides_.triangles[size_t(j)])) pairs_.push_back({i, j, 1, 0});
      }
    }
  }

  /// Casts the rays of all pairs in one batch and takes the visible part of each.
  void Shadow(const ShaftBlockers::Faces& faces) {
    segments_.clear();
    for (Pair& pair : pairs_) {
      pair.segment = int32_t(segments_.size());
      AddSegments(pair);
    }
    occluded_.resize(segments_.size());
    if (faces.IsCrowd()) {
      rayScene_.Occluded(segments_.data(), int(segments_.size()), occluded_.data());
    } else {
      for (size_t s = 0; s < segments_.size(); ++s) {
        occluded_[s] = shafts_.IsBlocked(faces, segments_[s]) ? 1 : 0;
      }
    }
    rays_ += int64_t(segments_.size());
    for (size_t p = 0; p < pairs_.size(); ++p) {
      const int32_t begin = pairs_[p].segment;
      const int32_t end = p + 1 < pairs_.size() ? pairs_[p + 1].segment : int32_t(segments_.size());
      if (begin == end) continue;  // no place sees another: a sliver of light, left as it is
      const auto hidden =
          std::count(occluded_.begin() + begin, occluded_.begin() + end, uint8_t(1));
      pairs_[p].area = 1 - float(hidden) / float(end - begin);
    }
  }

  /// Between places that face each other, in an order that differs from pair to pair, so that no
  /// pattern shows.
  void AddSegments(const Pair& pair) {
    const ExchangeTriangle& a = sides_.triangles[size_t(pair.row)];
    const ExchangeTriangle& b = sides_.triangles[size_t(pair.column)];
    const bool emits = !sides_.emittance[size_t(pair.row)].IsBlack() ||
                       !sides_.emittance[size_t(pair.column)].IsBlack();
    int wanted = emits ? kPlacePairs : visibilityRays_;
    const int turn =
        int(HashBits(uint64_t(pair.row), uint64_t(pair.column)) % uint64_t(kPlacesPerElement));
    for (int k = 0; k < kPlacePairs && wanted > 0; ++k) {
      const int place = k % kPlacesPerElement;
      const int other = (place + k / kPlacesPerElement + turn) % kPlacesPerElement;
      const Vec3f& from = sides_.samples[size_t(pair.row)][size_t(place)];
      const Vec3f& to = sides_.samples[size_t(pair.column)][size_t(other)];
      const Vec3f direction = to - from;
      if (Dot(direction, a.normal) <= 0 || Dot(direction, b.normal) >= 0) continue;
      segments_.push_back({from, to});
      --wanted;
    }
  }

  const ElementSides& sides_;
  const ShaftBlockers& shafts_;
  const RayScene& rayScene_;
  const int visibilityRays_;
  std::vector<Pair> pairs_;
  std::vector<Segment> segments_;
  std::vector<uint8_t> occluded_;
  int64_t rays_ = 0;
};

Eigen::Array4f Lanes(const Spectrum& s) { return {s.r, s.g, s.b, 0}; }
Spectrum FromLanes(const Eigen::Array4f& a) { return {a[0], a[1], a[2]}; }

}  // namespace

/// Only the pairs i < j are stored.
struct ExchangeMatrix::Storage {
  Eigen::SparseMatrix<float, Eigen::RowMajor, int32_t> upper;

  template <class Visit>
  void VisitPairs(const Visit& visit) {
    for (int32_t row = 0; row < int32_t(upper.rows()); ++row) {
      for (int32_t k = upper.outerIndexPtr()[row]; k < upper.outerIndexPtr()[row + 1]; ++k) {
        visit(size_t(row), size_t(upper.innerIndexPtr()[k]), &upper.valuePtr()[k]);
      }
    }
  }
};

ExchangeMatrix::~ExchangeMatrix() = default;
int64_t ExchangeMatrix::PairCount() const { return storage_->upper.nonZeros(); }

ExchangeMatrix::ExchangeMatrix(const ElementSides& sides, const ShaftBlockers& shafts,
                               const RayScene& rayScene, const ExchangeMatrixOptions& options,
                               const ProgressCallback& progress)
    : sides_(sides), storage_(new Storage) {
  if (options.visibilityRays < 1 || options.visibilityRays > kPlacePairs) {
    throw Error("A pair of elements takes 1 to 16 visibility rays, not " +
                std::to_string(options.visibilityRays) + ".");
  }
  CheckMemory(rayScene, options);
  Store(AssembleRows(shafts, rayScene, options, progress));
  BoundRows();
}

void ExchangeMatrix::Refuse(double bytes, const ExchangeMatrixOptions& options) const {
  throw Error("The form factors of " + std::to_string(sides_.Count()) +
              " element sides would take " + std::to_string(int64_t(bytes)) +
              " bytes where the limit is " + std::to_string(options.memoryLimit) +
              "; ask for larger elements or a higher limit.");
}

// Before any work: from the part of random pairs that see each other.
void ExchangeMatrix::CheckMemory(const RayScene& rayScene,
                                 const ExchangeMatrixOptions& options) const {
  const double sides = double(sides_.Count()), most = sides * (sides - 1) / 2 * sizeof(Entry);
  if (most <= double(options.memoryLimit)) return;
  const int seeing = OrderedSum<int>(kPairsForMemory, [&](int64_t k) {
    Random random(HashBits(uint64_t(k), 0x6d656d6f7279ull));
    const auto pick = [&] { return size_t(random.UniformDouble() * sides); };
    const ExchangeTriangle& a = sides_.triangles[pick()];
    const ExchangeTriangle& b = sides_.triangles[pick()];
    return CanExchange(a, b) && !rayScene.Occluded(a.centroid, b.centroid) ? 1 : 0;
  });
  const double bytes = most * seeing / kPairsForMemory;
  if (bytes > double(options.memoryLimit)) Refuse(bytes, options);
}

ExchangeMatrix::Rows ExchangeMatrix::AssembleRows(const ShaftBlockers& shafts,
                                                  const RayScene& rayScene,
                                                  const ExchangeMatrixOptions& options,
                                                  const ProgressCallback& progress) {
  Rows rows(size_t(sides_.Count()));
  const int64_t groups = sides_.GroupCount();
  std::vector<int64_t> rays(size_t(groups), 0), entries(size_t(groups), 0);
  int64_t total = 0;
  for (int64_t begin = 0; begin < groups; begin += kGroupsPerReport) {
    // Rows of one group: its pairs with all later groups.
    const int64_t end = std::min(groups, begin + kGroupsPerReport);
    ParallelForEach(end - begin, 1, [&](int64_t offset) {
      const int64_t rowGroup = begin + offset;
      GroupPair pairs(sides_, shafts, rayScene, options.visibilityRays);
      for (int64_t group = rowGroup; group < groups; ++group) {
        for (const Pair& pair : pairs.Exchange(int32_t(rowGroup), int32_t(group))) {
          if (!(pair.area > 0)) continue;
          rows[size_t(pair.row)].push_back({pair.column, pair.area});
          ++entries[size_t(rowGroup)];
        }
      }
      rays[size_t(rowGroup)] = pairs.Rays();
    });

    // Does it still fit?
    for (int64_t group = begin; group < end; ++group) {
      total += entries[size_t(group)];
      rays_ += rays[size_t(group)];
    }
    const double bytes = double(total) * sizeof(Entry);
    const double pairsDone = 1 - std::pow(1 - double(end) / double(groups), 2);
    if (bytes > double(options.memoryLimit) || total > std::numeric_limits<int32_t>::max()) {
      Refuse(bytes / pairsDone, options);
    }
    if (!Report(progress, pairsDone, "form factors")) throw Cancelled();
  }
  return rows;
}

void ExchangeMatrix::Store(Rows rows) {
  auto& upper = storage_->upper;
  const int64_t sides = sides_.Count();
  int64_t entries = 0;
  for (const auto& row : rows) entries += int64_t(row.size());
  upper.resize(sides, sides);
  upper.resizeNonZeros(entries);
  int32_t next = 0;
  for (size_t row = 0; row < rows.size(); ++row) {
    upper.outerIndexPtr()[row] = next;
    for (const Entry& entry : rows[row]) {
      upper.innerIndexPtr()[next] = entry.column;
      upper.valuePtr()[next++] = entry.area;
    }
    rows[row] = {};
  }
  upper.outerIndexPtr()[rows.size()] = next;
}

// Quadrature and sampled visibility let rows sum to a little more than 1. Scaling a pair by the
// smaller of its two factors keeps the matrix symmetric and brings every row to 1 at most.
void ExchangeMatrix::BoundRows() {
  const size_t sides = size_t(sides_.Count());
  const auto sumRows = [&] {
    std::vector<double> sums(sides, 0);
    storage_->VisitPairs([&](size_t row, size_t column, const float* area) {
      sums[row] += double(*area);
      sums[column] += double(*area);
    });
    for (size_t i = 0; i < sides; ++i) {
      sums[i] = sides_.exposure[i] > 0 ? sums[i] / double(sides_.ExposedArea(i)) : 0;
    }
    return sums;
  };
  const std::vector<double> sums = sumRows();
  std::vector<float> scale(sides, 1);
  for (size_t i = 0; i < sides; ++i) scale[i] = sums[i] > 1 ? float(1 / sums[i]) : 1.f;
  storage_->VisitPairs([&](size_t row, size_t column, float* area) {
    *area *= std::min(scale[row], scale[column]);
  });
  const std::vector<double> bounded = sumRows();
  rowSums_.assign(bounded.begin(), bounded.end());
}

float ExchangeMatrix::FormFactor(int32_t i, int32_t j) const {
  const float area = sides_.ExposedArea(size_t(i));
  return area > 0 ? storage_->upper.coeff(std::min(i, j), std::max(i, j)) / area : 0;
}

double ExchangeMatrix::Sweep(const std::vector<Spectrum>& lightIrradiance,
                             std::vector<Spectrum>* irradiance,
                             std::vector<Spectrum>* radiosity) const {
  using Eigen::Array4f;
  const auto& upper = storage_->upper;
  const size_t sides = size_t(sides_.Count());
  std::vector<Array4f, Eigen::aligned_allocator<Array4f>> leaving(sides);
  std::vector<Array4f, Eigen::aligned_allocator<Array4f>> power(sides, Array4f::Zero());
  for (size_t i = 0; i < sides; ++i) leaving[i] = Lanes((*radiosity)[i]);
  double change = 0, total = 0;
  for (size_t i = 0; i < sides; ++i) {
    // Power from the sides before, given out below, and from those behind as they were.
    const int32_t begin = upper.outerIndexPtr()[i], end = upper.outerIndexPtr()[i + 1];
    const int32_t* column = upper.innerIndexPtr();
    const float* area = upper.valuePtr();
    Array4f sum = power[i];
    for (int32_t k = begin; k < end; ++k) sum += area[k] * leaving[size_t(column[k])];
    const float exposed = sides_.ExposedArea(i);
    if (!(exposed > 0)) continue;
    const Spectrum arriving = lightIrradiance[i] + FromLanes(sum) / exposed;
    const Spectrum now = sides_.emittance[i] + sides_.reflectance[i] * arriving;

    const Array4f step = (Lanes(now) - leaving[i]).abs() * exposed;
    change += double(step.sum());
    total += 3.0 * double(now.Mean()) * double(exposed);
    (*irradiance)[i] = arriving;
    (*radiosity)[i] = now;
    leaving[i] = Lanes(now);
    for (int32_t k = begin; k < end; ++k) power[size_t(column[k])] += area[k] * leaving[i];
  }
  return total > 0 ? change / total : 0;
}

}  // namespace lambert
